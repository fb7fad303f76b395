#ifndef STRIDE_COMPILER_CODEGEN_ANALYSIS_ANALYSIS_HPP
#define STRIDE_COMPILER_CODEGEN_ANALYSIS_ANALYSIS_HPP
// What evaluating an expression can do besides giving a value. It decides where C++ must be told
// the order.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/program.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stc::codegen {

/// Bits of an effect.
enum Effect : unsigned {
  kEffectNone = 0,
  kEffectReads = 1,  ///< its value depends on variables
  kEffectRaises = 2, ///< a check in it may end the cycle
  kEffectCalls = 4,  ///< calls code that may change variables
  kEffectStrays = 8, ///< follows an address or index that may lead nowhere, checked or not
};

class Analysis {
public:
  explicit Analysis(const Program &program) : Analysis(program, program.settings.checks) {}
  /// `checks`: run-time checks are made, whatever the program's settings say.
  Analysis(const Program &program, bool checks)
      : checks_(checks), ownChecks_(program.implicitChecks), sharing_(program.sharing) {}

  /// Effect bits of evaluating the expression with its conversion.
  [[nodiscard]] unsigned effects(const ast::Expr *expr);
  /// Effect bits of finding where the place is, in the code of `body`: none for a variable,
  /// `kEffectReads` for `a[i]`.
  [[nodiscard]] unsigned placeEffects(const ast::Expr *place, const PouSymbol *body);
  /// The same of the target of an assignment: of a property that is set, of finding its object.
  [[nodiscard]] unsigned targetEffects(const ast::Expr *target, const PouSymbol *body);
  /// The same of the instance or interface whose method is called.
  [[nodiscard]] unsigned objectEffects(const ast::Expr *object, const PouSymbol *body);
  /// The in-outs of the block are known to be bound: nothing raises where they are followed.
  void assumeBound(const PouSymbol *block) { bound_ = block; }
  /// A FUNCTION that only computes: it changes nothing but its own variables.
  [[nodiscard]] bool pure(const PouSymbol *function);
  /// Evaluating `first` before `second` or after it makes a difference for their values.
  [[nodiscard]] static bool orderMatters(unsigned first, unsigned second) {
    return ((first & kEffectCalls) != 0 && second != kEffectNone) ||
           ((second & kEffectCalls) != 0 && first != kEffectNone);
  }
  /// It makes one for their values, or for which of two exceptions comes.
  [[nodiscard]] static bool orderShows(unsigned first, unsigned second) {
    return orderMatters(first, second) || (first & second & kEffectRaises) != 0;
  }
  /// The FOR loop and those in it end after at most kShortLoop rounds altogether, whatever happens;
  /// nothing but the loop changes its variable.
  [[nodiscard]] bool shortLoop(const ast::ForStmt *loop);
  /// Another task may change the loop's variable.
  [[nodiscard]] bool sharedVariable(const ast::ForStmt *loop) const {
    return sharing_.holds(loop->variable);
  }
  /// Several tasks use the variable, or what it leads to.
  [[nodiscard]] bool isShared(const VarSymbol *variable) const {
    return sharing_.variables.contains(variable) || sharing_.contents.contains(variable);
  }
  /// Its bounds are constant, and the first value past the end is one of the variable's type.
  [[nodiscard]] bool endsInside(const ast::ForStmt *loop) const;

  /// How often a FOR loop with constant bounds runs at most; huge for others.
  [[nodiscard]] int64_t ownRounds(const ast::ForStmt *loop) const;
  /// At most kShortLoop rounds of its own.
  [[nodiscard]] bool fewRounds(const ast::ForStmt *loop) const {
    return ownRounds(loop) <= kShortLoop;
  }

  static constexpr int64_t kShortLoop = int64_t{1} << 21;

  /// Within the body of a FOR loop with constant bounds its variable has a known range, if nothing
  /// else can change it; `countsAlone` says that this is known.
  void enterLoop(const ast::ForStmt *loop, bool countsAlone = false);
  /// The variable that the end of the body counts up or down, and that the condition limits; null:
  /// there is none.
  [[nodiscard]] static const VarSymbol *steppedVariable(const ast::WhileStmt *loop);
  /// Within the body of a WHILE loop it has a known range up to there, if the statements `before`
  /// the loop in its block give it a value of a known one. Nothing but the loop's own statements
  /// changes the variable while it runs.
  void enterWhile(const ast::WhileStmt *loop, ast::Block before);
  /// So often such a loop runs at most, whose body only computes; huge for others.
  [[nodiscard]] int64_t whileRounds(const ast::WhileStmt *loop, ast::Block before);
  /// So often a FOR loop with a constant step runs at most whose bounds have known ranges (of 31
  /// bits); huge for others.
  [[nodiscard]] int64_t roundsAtMost(const ast::ForStmt *loop) const;
  /// A WHILE loop of which nothing is known.
  void enterUnknown() { ranges_.push_back({nullptr, 0, 0}); }
  void leaveLoop();
  /// The index needs no check: a constant, or computed from constants and from variables of loops
  /// so that it stays within the bounds.
  [[nodiscard]] bool provenIndex(const ast::Expr *index, const ArrayType *array) const;

private:
  [[nodiscard]] bool followsSlot(const Symbol *symbol) const;
  unsigned checkedBy(ImplicitCheck first, ImplicitCheck last);
  unsigned following();
  unsigned indexing(const ast::IndexExpr *e);
  unsigned dividing(const ast::BinaryExpr *e);
  unsigned calling(const ast::CallExpr *e);
  using MayWrite = const std::function<bool(const ast::Expr *target)> &;
  /// Nothing is called but what only computes, and only what `mayWrite` allows is written.
  bool computes(ast::Block block, MayWrite mayWrite);
  bool computes(const ast::Stmt *s, MayWrite mayWrite);
  int64_t rounds(ast::Block block);
  bool unchanged(ast::Block body, const VarSymbol *variable);

  static constexpr int64_t kHuge = int64_t{1} << 62;

  struct Range {
    const VarSymbol *variable; ///< null: nothing is known
    int64_t low;
    int64_t high;
  };

  struct Interval {
    int64_t low;
    int64_t high;
  };
  struct WhileFacts {
    Range range{nullptr, 0, 0};
    int64_t rounds = kHuge;
  };
  [[nodiscard]] WhileFacts whileFacts(const ast::WhileStmt *loop, ast::Block before);
  /// The values that the expression can have here, or nothing.
  [[nodiscard]] std::optional<Interval> interval(const ast::Expr *e, unsigned depth = 0) const;
  /// The values of `e - variable`, where `e` is a sum that begins with the variable and none of its
  /// parts can wrap.
  [[nodiscard]] std::optional<Interval> distance(const ast::Expr *e,
                                                 const VarSymbol *variable) const;
  [[nodiscard]] std::optional<Interval> intervalOf(const ast::BinaryExpr *e, unsigned depth) const;

  bool checks_;
  const PouSymbol *bound_ = nullptr;
  const ImplicitChecks &ownChecks_;
  const Sharing &sharing_;
  std::vector<Range> ranges_;
  /// Functions that call functions are looked at so many levels deep.
  static constexpr unsigned kMaxCalls = 64;
  unsigned calls_ = 0;
  std::unordered_map<const PouSymbol *, bool> pure_;
};

/// The bounds within which a constant index needs no check.
[[nodiscard]] inline bool inBounds(const ast::Expr *index, const ArrayType *array) {
  return index->constant != nullptr && index->constant->kind == ConstKind::Integer &&
         index->constant->integer >= array->low && index->constant->integer <= array->high;
}

/// Integer division by this expression needs no check.
[[nodiscard]] inline bool safeDivisor(const ast::Expr *divisor) {
  return divisor->constant != nullptr && divisor->constant->kind == ConstKind::Integer &&
         divisor->constant->integer != 0 && divisor->constant->integer != -1;
}

/// A pointer or a reference lies on the way to the element.
[[nodiscard]] bool followsAddress(const ast::IndexExpr *e);
/// The list has it.
template <class T> [[nodiscard]] bool contains(const std::vector<T> &all, T one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}
/// Values that fit a register. Texts and aggregates stay where they are.
[[nodiscard]] bool isScalar(const Type *type);
/// The variable an expression names directly (`x`, `GVL.x`, not `a.x`); null for all others.
[[nodiscard]] const VarSymbol *namedVariable(const ast::Expr *expr);
/// What the place is a bit, a part or a field of, with no address followed in between: `a[i]` of
/// `a[i].w.3`.
[[nodiscard]] const ast::Expr *containerOf(const ast::Expr *place);
/// What a name or member stands for; null for all other expressions.
[[nodiscard]] const Symbol *symbolAt(const ast::Expr *place);
/// The property that an assignment to the target sets; null where it sets a variable.
[[nodiscard]] const PropertySymbol *writtenProperty(const ast::Expr *target);
/// The name before the dot is a namespace: a library, a variable list, an enumeration.
[[nodiscard]] bool isNamespace(const ast::Expr *expr);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_ANALYSIS_ANALYSIS_HPP
