#ifndef STRIDE_COMPILER_CODEGEN_GENERATED_SOURCE_HPP
#define STRIDE_COMPILER_CODEGEN_GENERATED_SOURCE_HPP
// One source that is generated: the functions in it, each with what its body has turned out to
// need.

#include "compiler/codegen/codegen.hpp"
#include "compiler/codegen/context/context.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc::codegen {

/// What every generated source includes and switches off.
[[nodiscard]] std::string_view sourcePrelude();
/// First line of each generated file.
[[nodiscard]] std::string banner(std::string_view what);

class GeneratedSource {
public:
  /// The source of `pou`, or (null) of types and variable lists.
  GeneratedSource(Context &context, const PouSymbol *pou, std::string path)
      : cx_(context, pou), path_(std::move(path)) {}

  /// `void X::init__(…) { … }` for the given variables; nothing when they are zero.
  void init(std::string_view name, const std::vector<const VarSymbol *> &variables,
            const Type *base = nullptr, const PouSymbol *block = nullptr);
  /// `void X::assign__(…) { … }`: everything but the bindings of in-outs.
  void assignment(std::string_view name, const std::vector<const VarSymbol *> &variables,
                  const Type *base);
  /// `void configure__(…)`: the initial values that VAR_CONFIG gives.
  void configured();
  /// `void X::body__(…)`
  void blockBody(const PouSymbol *pou, std::string_view name);
  /// A function or method.
  void functionBody(const PouSymbol *pou);
  /// `void X::exit__(…) { … }` or reinit__ of what the variables hold; `block` comes with its base.
  void lifecycle(std::string_view name, const std::vector<const VarSymbol *> &variables,
                 std::string_view what, const Type *base, const PouSymbol *block);

  /// The header of something that the file is about.
  void include(const Symbol *symbol) { cx_.includes.symbol(symbol); }
  /// Nothing has been written.
  [[nodiscard]] bool empty() const { return pieces_.empty(); }

  /// The bodies once more, for those who call them.
  [[nodiscard]] GeneratedFile inlined(const PouSymbol *own) const;
  /// The file; `own`: whose header it includes first.
  [[nodiscard]] GeneratedFile finish(const Symbol *own, std::string_view what) const;

private:
  struct Piece {
    Writer text;
    bool isBody = false; ///< of the POU that the file is about
  };

  /// What comes before a function's statements.
  struct Head {
    std::string signature;
    Span start = {}; ///< where in the ST it counts as standing
  };

  /// `void name(…)` whose statements `write` writes into `cx_`.
  template <class Write> void plainFunction(const std::string &name, Write &&write);
  Writer open(const Head &head);
  void close(Writer text, bool isBody);
  void prologue(Writer &text, const Head &head);
  void initialValues(std::string_view name, const std::vector<const VarSymbol *> &variables);
  void generatedLine(std::string_view text);
  void inOutReference(Writer &out, const VarSymbol *v);
  Writer inOutReferences(const PouSymbol *pou);
  Writer edgeInputs(const PouSymbol *pou);
  Writer functionLocals(const PouSymbol *pou);
  std::string signatureOf(const PouSymbol *pou);

  EmitContext cx_;
  std::string path_;
  std::vector<Piece> pieces_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_GENERATED_SOURCE_HPP
