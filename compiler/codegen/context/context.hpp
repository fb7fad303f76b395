#ifndef STRIDE_COMPILER_CODEGEN_CONTEXT_CONTEXT_HPP
#define STRIDE_COMPILER_CODEGEN_CONTEXT_CONTEXT_HPP
// What emission holds while it writes the C++ of one file, and the few operations that all of it
// needs. What writes statements, expressions, initial values … are functions by topic.

#include "compiler/codegen/analysis/addressed.hpp"
#include "compiler/codegen/analysis/analysis.hpp"
#include "compiler/codegen/analysis/inner_sums.hpp"
#include "compiler/codegen/analysis/loop_locals.hpp"
#include "compiler/codegen/analysis/plain_calls.hpp"
#include "compiler/codegen/analysis/repetition.hpp"
#include "compiler/codegen/analysis/typed_pointers.hpp"
#include "compiler/codegen/cpp/layout.hpp"
#include "compiler/codegen/cpp/names.hpp"
#include "compiler/codegen/cpp/roots.hpp"
#include "compiler/codegen/cpp/scoped.hpp"
#include "compiler/codegen/cpp/writer.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace stc::codegen {

/// What all files of one run share; of several threads each has a copy.
struct Context {
  const Program &program;
  const Library *own; ///< the library (or project) whose files are generated
  Names names;
  Layouts layouts;
  Analysis analysis;
  TypedPointers pointers;
  LoopLocals loopLocals;
  Addressed addressed;
  PlainCalls plainCalls;
  Repetition repetition;

  Context(const Program &p, const Library *library)
      : program(p), own(library), names(p), layouts(p, library), analysis(p), pointers(p, library),
        loopLocals(analysis, pointers), addressed(p, library), plainCalls(p, addressed),
        repetition(p, library) {}
  /// Goes on with the names that `whole` has given and what it has found out.
  Context(const Context &whole)
      : program(whole.program), own(whole.own), names(whole.names), layouts(whole.layouts),
        analysis(whole.program), pointers(whole.pointers), loopLocals(analysis, pointers),
        addressed(whole.addressed), plainCalls(whole.program, addressed),
        repetition(whole.repetition) {}
  Context &operator=(const Context &) = delete;
};

/// What the call's context is called in the code of POUs.
inline constexpr std::string_view kContext = "ctx__";

/// What the code of one function needs around it, gathered while it is written.
struct Uses {
  struct RootUse {
    Root root;
    std::string reference; ///< the local name
  };

  bool context = false;       ///< the call's context
  bool budget = false;        ///< the loop budget
  unsigned areas = 0;         ///< of the process image: bits by Area
  std::vector<FileId> files;  ///< whose names are needed, as constants fileConstant()
  std::vector<RootUse> roots; ///< what is found by a reference

  [[nodiscard]] bool has(const VarSymbol *variable) const { return variables_.contains(variable); }
  void add(const VarSymbol *variable) {
    if (variable != last_)
      variables_.insert(variable);
    last_ = variable;
  }
  /// `file__`, the constant with the name of a source file.
  std::string fileName(FileId file);
  static std::string fileConstant(size_t index) {
    return index == 0 ? "file__" : "file__" + std::to_string(index + 1);
  }

private:
  std::unordered_set<const VarSymbol *> variables_;
  const VarSymbol *last_ = nullptr;
};

/// What has been found before its use: places, objects, interfaces, by their expression.
using FoundPlaces = std::unordered_map<const ast::Expr *, std::string>;

/// A loop around the place that is written.
struct Loop {
  unsigned id;
  bool isDouble;         ///< two C++ loops, so that `break` leaves only the inner one
  unsigned switches = 0; ///< CASE statements around the place, within the loop
  bool labelled = false; ///< an EXIT jumps to the label after it
};

/// The loops around the place, and what the outermost one keeps in C++ locals meanwhile.
struct Loops {
  std::vector<Loop> around;
  std::vector<const VarSymbol *> locals;
  /// So many rounds do the loops around make at most that take nothing from the loop budget, up to
  /// the first that does.
  int64_t uncounted = 1;
  std::string context{kContext}; ///< what stands for the context: a loop's own where it has locals
  /// The same for calls that always end: a loop's copy where these read the clock in it.
  std::string plain{kContext};
};

/// A __TRY with __FINALLY whose statements are being written.
struct Try {
  unsigned id;
  const ast::TryStmt *stmt;
  size_t loops;                          ///< how many loops are around it
  std::vector<const ast::Stmt *> leaves; ///< RETURN, EXIT, JMP … that lead out of it
};

/// The variable whose initial value is written.
struct Initialised {
  Span span;          ///< where it is declared
  bool zeroed = true; ///< its memory is zero: it has no default that a zero replaces
};

/// What decides how code is written at a place; each changes for a scope (Scoped).
struct Modes {
  bool writing = false; ///< the place is about to be written
  Initialised init;
  Loops loops;
  std::vector<Try> tries;
  ast::Block before; ///< the statements before this one in its block
};

/// The C++ of one file: what is written into, what it needs around it, and where in the ST it is.
struct EmitContext {
  /// `body`: a POU of the file, or null for one of types and variable lists.
  EmitContext(Context &context, const PouSymbol *body);

  Context &run;
  const PouSymbol *pou; ///< whose code is written
  Writer out;
  Includes includes;
  Uses uses;
  Modes modes;
  FoundPlaces found;

  /// Run-time checks are made here: not with --unchecked or {attribute 'no_check'}.
  [[nodiscard]] bool checks() const { return run.program.settings.checks && !noCheck_; }
  /// It is the body of a check of the project's own: no check calls itself.
  [[nodiscard]] bool isCheck() const { return isCheck_; }
  /// Several tasks use the place: it is read and written atomically.
  [[nodiscard]] bool isShared(const ast::Expr *e) const { return run.program.sharing.holds(e); }
  /// The same of a member of an instance.
  [[nodiscard]] bool isShared(const VarSymbol *member) const {
    return run.program.sharing.variables.contains(member);
  }
  [[nodiscard]] unsigned effects(const ast::Expr *e) const { return run.analysis.effects(e); }

  /// Begins a statement (or a later part of one) that stands at `span`.
  void begin(Span span);
  /// Goes on with the statement at `span`: on the same line if it is the same line of the ST.
  void next(Span span);
  void end() { out.endLine(); }
  void open() { out.indent(); }
  void close() { out.outdent(); }
  /// A line of its own that counts as the ST's line before it.
  void line(std::string_view text) {
    out.line() << text;
    out.endLine();
  }

  /// `name__5`, for something that the ST does not name.
  std::string temporary(std::string_view stem);
  [[nodiscard]] unsigned number() { return ++counter_; }
  /// What stands for the call's context.
  std::string_view ctx() {
    uses.context = true;
    return modes.loops.context;
  }
  /// The same for a body that always ends (PlainCalls).
  std::string_view plainContext() {
    uses.context = true;
    return modes.loops.plain;
  }
  /// `file__, 12, 3` of a check.
  void position(Span span);
  /// The local name of a root.
  std::string_view root(const Root &root);
  /// The base of an area of the process image.
  std::string_view area(Area area);
  /// The name of a type that is complete here.
  std::string_view type(const Type *type) {
    includes.complete(type);
    return run.names.type(type);
  }

  /// What `write` writes within a line, not to stand where it would.
  template <class Write> [[nodiscard]] std::string text(Write &&write) {
    return out.aside(std::forward<Write>(write));
  }
  /// The lines that `write` writes, indented once.
  template <class Write> [[nodiscard]] Writer lines(Write &&write) {
    const Scoped<Writer> aside(out, Writer(run.program.sources));
    out.indent();
    write();
    return std::move(out);
  }
  /// Statements within an expression, gathered on its line.
  template <class Write> void inlined(Write &&write) {
    const Scoped<Modes> plain(modes, {});
    const Scoped<unsigned> names(counter_, counter_ + kInlinedNames);
    const Scoped<uint32_t> here(line_, line_);
    const Writer::Gathered oneLine(out);
    write();
  }

private:
  /// Names of temporaries begin so much later in statements within an expression.
  static constexpr unsigned kInlinedNames = 100;

  bool noCheck_ = false; ///< {attribute 'no_check'}
  bool isCheck_ = false;
  unsigned counter_ = 0;
  uint32_t line_ = 0; ///< of the ST, for next()
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CONTEXT_CONTEXT_HPP
