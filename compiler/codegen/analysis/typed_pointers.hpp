#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_TYPED_POINTERS_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_TYPED_POINTERS_HPP
// Whether a POINTER TO T leads to a T, or may lead anywhere. A loop may keep a DINT in a register
// while it writes what a POINTER TO Node leads to, if no Node is made of that DINT.

#include "compiler/semantics/program.hpp"

#include <unordered_set>
#include <vector>

namespace stc::codegen {

/// Looks at every place of a whole program where an address comes from. All pointers are typed
/// where each is 0, or the address of a variable of just that type that lives as long as the
/// application, or another pointer's. One address that is computed, converted or handed to what
/// cannot be looked at, and none is: whoever has it may write any pointer with it.
class TypedPointers {
public:
  /// `own`: whose code is generated.
  TypedPointers(const Program &program, const Library *own) : program_(program), own_(own) {}
  /// Looks now, so that copies need not do it.
  void prepare() {
    if (!known_)
      find();
  }

  /// No pointer of the program leads to anything but 0 or a variable of its type, except those of
  /// native code.
  [[nodiscard]] bool areTyped() {
    prepare();
    return typed_;
  }
  /// A POINTER TO `pointee` leads to a variable of that type.
  [[nodiscard]] bool leadTo(const Type *pointee) {
    return areTyped() && !native_.contains(pointee);
  }

private:
  void find();
  void library(const Library &library);
  void types(const Library &library);
  void pou(const PouSymbol *pou, bool isOpen);
  void declaration(const VarSymbol *variable);
  void initial(ast::Expr *init);
  void constructing(std::span<const ast::Argument> list);
  void block(ast::Block block);
  void assignment(const ast::AssignStmt *s);
  void expression(ast::Expr *expr);
  void node(const ast::Expr *e);
  void conversion(const ast::Expr *e);
  void binary(const ast::BinaryExpr *e);
  void index(const ast::IndexExpr *e);
  void call(const ast::CallExpr *e);
  void builtin(const ast::CallExpr *e);
  void arguments(std::span<const ast::Argument> arguments);
  void native(const Type *type);
  /// Something makes addresses of which nothing is known.
  void giveUp() { typed_ = false; }

  const Program &program_;
  const Library *own_;
  bool known_ = false;
  bool typed_ = true;
  /// What pointers of native code lead to.
  std::unordered_set<const Type *> native_;
  std::unordered_set<const Type *> seen_;
  /// Operands of comparisons: what they become goes nowhere.
  std::unordered_set<const ast::Expr *> compared_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_TYPED_POINTERS_HPP
