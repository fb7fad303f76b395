#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_PLAIN_CALLS_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_PLAIN_CALLS_HPP
// Which bodies of blocks always come to their end. A loop that keeps variables in C++ locals has to
// put them back before it calls code that may leave the cycle; before these it need not.

#include "compiler/codegen/analysis/addressed.hpp"
#include "compiler/codegen/analysis/analysis.hpp"

#include <unordered_map>

namespace stc::codegen {

class PlainCalls {
public:
  PlainCalls(const Program &program, Addressed &addressed);

  /// No check in the body of the block can fail, whether checks are on or not, if its in-outs are
  /// bound; no loop of it can use up the loop budget, and it calls nothing but built-in functions.
  /// The variables of its caller are not its concern: LoopLocals knows whether it reaches them.
  [[nodiscard]] bool alwaysEnds(const PouSymbol *block);
  /// The loop calls such a block that reads the clock.
  [[nodiscard]] bool readsClock(const ast::Stmt *loop);

private:
  bool find(const PouSymbol *block);
  bool block(ast::Block block, const PouSymbol *pou);
  bool statement(const ast::Stmt *s, const PouSymbol *pou);
  bool isPlainTarget(const ast::Expr *target, const PouSymbol *pou);

  Analysis analysis_;
  Addressed &addressed_;
  bool hasOwnChecks_; ///< The project has checks of its own, which may do anything.
  std::unordered_map<const PouSymbol *, bool> known_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_PLAIN_CALLS_HPP
