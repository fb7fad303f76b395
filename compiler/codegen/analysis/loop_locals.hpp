#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_LOOP_LOCALS_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_LOOP_LOCALS_HPP
// Which variables of a block or program a loop may keep in C++ locals: those that nothing but the
// loop's own statements can reach while it runs. Registers are the difference between generated and
// hand-written loops.

#include "compiler/codegen/analysis/analysis.hpp"
#include "compiler/codegen/analysis/typed_pointers.hpp"

#include <unordered_map>
#include <vector>

namespace stc::codegen {

class LoopLocals {
public:
  LoopLocals(Analysis &analysis, TypedPointers &pointers)
      : analysis_(analysis), pointers_(pointers) {}

  /// The elementary variables and pointers of `pou` that the loop writes and nothing else touches
  /// during it; in the order of their first write.
  [[nodiscard]] std::vector<const VarSymbol *> of(const ast::Stmt *loop, const PouSymbol *pou);
  /// Nothing in the body of the loop changes its variable, whatever it calls.
  [[nodiscard]] bool countsAlone(const ast::ForStmt *loop, const PouSymbol *pou);

private:
  /// What a piece of code touches.
  struct Facts {
    /// It calls, jumps or follows pointers that may lead anywhere: anything may happen.
    bool opaque = false;
    /// It follows pointers.
    bool follows = false;
    /// Variables named directly on the left of an assignment.
    std::vector<const VarSymbol *> written;
    /// Members of other instances (perhaps of this one by another way).
    std::vector<const Symbol *> foreign;
    /// Types of the variables behind in-outs, references and pointers.
    std::vector<const Type *> indirect;
    /// The blocks whose bodies and methods are called: their variables are in reach.
    std::vector<const PouSymbol *> called;
  };

  void block(ast::Block block, Facts &facts);
  void statement(const ast::Stmt *statement, Facts &facts);
  void expression(const ast::Expr *expr, Facts &facts);
  void name(const Symbol *symbol, Facts &facts);
  void call(const ast::CallExpr *call, Facts &facts);
  void arguments(const ast::CallExpr *call, Facts &facts);
  void instanceCall(const ast::CallExpr *call, Facts &facts);
  void deref(const ast::DerefExpr *expr, Facts &facts);
  [[nodiscard]] bool canBeLocal(const VarSymbol *v, const PouSymbol *pou, const Facts &facts);
  void target(const ast::Expr *expr, Facts &facts);
  const Facts &body(const PouSymbol *pou);

  Analysis &analysis_;
  TypedPointers &pointers_;
  std::unordered_map<const PouSymbol *, Facts> bodies_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_LOOP_LOCALS_HPP
