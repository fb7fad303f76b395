#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_ADDRESSED_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_ADDRESSED_HPP
// Which variables of a call lie on the task's data stack: those whose address ST may get hold of,
// and large ones. The others are C++ locals.

#include "compiler/semantics/program.hpp"
#include "compiler/semantics/storage.hpp"

#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc::codegen {

/// Follows the ways on which an address comes into the hands of ST: ADR, REFERENCE and interfaces,
/// and from one POU to another VAR_IN_OUT and the VAR_OUTPUT of functions and methods. What is not
/// known (native code, what may replace a method of a library) takes the address of what it gets.
class Addressed {
public:
  /// `own`: whose code is generated.
  Addressed(const Program &program, const Library *own) : program_(program), own_(own) {}
  /// Follows them now, so that copies need not do it.
  void prepare() {
    if (!known_)
      find();
  }

  /// A local variable, input or result of a function or method, a VAR_TEMP: it lies on the data
  /// stack. An output or in-out: so does the temporary that a caller gives for it.
  [[nodiscard]] bool onDataStack(const VarSymbol *variable);
  /// The same of a temporary value of the type: its methods may take its address.
  [[nodiscard]] static bool holdsBlock(const Type *type);

private:
  void find();
  void pou(const PouSymbol *pou);
  void parameters(const PouSymbol *pou);
  void replacements(const PouSymbol *block);
  void link(const PouSymbol *method, const PouSymbol *replacement);
  void declaration(const VarSymbol *variable);
  void initial(const VarSymbol *variable, ast::Expr *init);
  void block(ast::Block block);
  void expression(ast::Expr *expr);
  void call(const ast::CallExpr *e);
  void arguments(std::span<const ast::Argument> arguments);
  void constructing(std::span<const ast::Argument> list);
  /// Somebody gets the address of the place.
  void expose(const ast::Expr *place);
  void expose(const VarSymbol *variable) { found_.push_back(variable); }
  /// If the parameter's address is taken, so is the place's.
  void bind(const ast::Expr *place, const VarSymbol *parameter);
  /// The variable in which a place lies; null: an address leads there.
  [[nodiscard]] static const VarSymbol *holder(const ast::Expr *place);

  /// Larger variables are on the data stack, whose end is looked at: one frame on the stack of C++
  /// must not reach past the pages without access below that.
  static constexpr uint64_t kLarge = 16384;

  const Program &program_;
  const Library *own_;
  bool known_ = false;
  std::unordered_set<const VarSymbol *> exposed_;
  std::vector<const VarSymbol *> found_;
  /// By parameter: what is bound to it.
  std::unordered_map<const VarSymbol *, std::vector<const VarSymbol *>> bound_;
  Storage storage_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_ADDRESSED_HPP
