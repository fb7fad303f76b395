#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_REPETITION_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_REPETITION_HPP
// Which code runs many times in a call of a program: it is worth the C++ compiler's time.

#include "compiler/semantics/program.hpp"

#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc::codegen {

/// Follows the calls of a whole program. What cannot be followed counts as repeated: bodies and
/// methods of blocks that extend others or implement interfaces, accessors, checks of the
/// project's own, and all of a library whose callers are not known.
class Repetition {
public:
  /// `own`: whose code is generated.
  Repetition(const Program &program, const Library *own) : program_(program), own_(own) {}
  /// Follows them now, so that copies need not do it.
  void prepare() {
    if (!known_)
      find();
  }

  /// The POU is called in a loop (by its own caller, or by one further up), or calls itself.
  [[nodiscard]] bool isRepeated(const PouSymbol *pou);
  /// Calls of `callee` in the code of `caller` (null: in that of no POU) are run many times.
  [[nodiscard]] bool callsOften(const PouSymbol *caller, const PouSymbol *callee);
  /// The body has no loop and is not repeated: each statement runs once in a call of a program.
  [[nodiscard]] bool runsOnce(const PouSymbol *pou);

private:
  /// What the code of a POU calls.
  struct Calls {
    bool hasLoop = false;
    std::unordered_set<const PouSymbol *> all;
    std::unordered_set<const PouSymbol *> inLoops;
  };

  void find();
  void look(const PouSymbol *pou);
  void block(ast::Block block, bool inLoop, Calls &calls);
  static void expression(ast::Expr *expr, bool inLoop, Calls &calls);
  void repeat(const PouSymbol *pou);
  void findCircles();

  const Program &program_;
  const Library *own_;
  bool known_ = false;
  std::unordered_map<const PouSymbol *, Calls> calls_;
  std::vector<const PouSymbol *> order_; ///< the keys of `calls_`, as the program has them
  std::unordered_set<const PouSymbol *> repeated_;
  std::vector<const PouSymbol *> found_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_REPETITION_HPP
