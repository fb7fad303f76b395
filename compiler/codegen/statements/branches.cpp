#include "compiler/codegen/statements/branches.hpp"

#include "compiler/codegen/expressions/constants.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/statements/statements.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// Ranges of CASE up to this size are written as single labels.
constexpr int64_t kMaxRange = 32;
constexpr int64_t kMaxLabels = 1024;
/// g++ nests `else if`; longer chains of ELSIF are flattened.
constexpr size_t kMaxElseIf = 64;

/// `if … else if …`, or many of `if (…) { …; goto after; }`.
class Chain {
public:
  Chain(EmitContext &cx, size_t branches, std::string_view stem)
      : cx_(cx), isFlat_(branches > kMaxElseIf),
        behind_(isFlat_ ? cx.temporary(stem) : std::string()) {}

  [[nodiscard]] bool isFlat() const { return isFlat_; }

  template <class Condition> void branch(Span span, Condition &&condition, Block body) {
    cx_.begin(span);
    cx_.out << (first_ || isFlat_ ? "if (" : "} else if (");
    first_ = false;
    condition();
    cx_.out << ") {";
    cx_.end();
    cx_.open();
    emitBlock(cx_, body);
    if (isFlat_)
      cx_.line("goto " + behind_ + ";");
    cx_.close();
    if (isFlat_)
      cx_.line("}");
  }

  /// ELSE, and the end of a chain that is not flat.
  void otherwise(Block body) {
    if (isFlat_) {
      emitBlock(cx_, body);
      return;
    }
    if (!body.empty()) {
      cx_.line("} else {");
      cx_.open();
      emitBlock(cx_, body);
      cx_.close();
    }
    cx_.line("}");
  }

  /// What comes after a flat chain.
  void label() { cx_.line(behind_ + ":;"); }

private:
  EmitContext &cx_;
  bool isFlat_;
  std::string behind_;
  bool first_ = true;
};

/// A block that ends the switch.
void emitSwitchBlock(EmitContext &cx, Block body) {
  cx.open();
  emitBlock(cx, body);
  cx.line("break;");
  cx.close();
  cx.line("}");
}

/// `case 1:` … of one label; the last one opens the block.
void emitSwitchLabel(EmitContext &cx, const CaseLabel &label, const Type *type, bool isLast) {
  const int64_t low = label.low->constant->integer;
  const int64_t high = label.high == nullptr ? low : label.high->constant->integer;
  for (int64_t v = low;; ++v) {
    cx.begin(label.span);
    cx.out << "case ";
    if (v == low)
      emitValueAs(cx, label.low, type);
    else
      emitNumber(cx, v, type);
    cx.out << (isLast && v == high ? ": {" : ":");
    cx.end();
    if (v == high)
      break;
  }
}

void emitSwitch(EmitContext &cx, const CaseStmt *s) {
  std::vector<Loop> &loops = cx.modes.loops.around;
  cx.begin(s->span);
  cx.out << "switch (";
  emitValue(cx, s->selector);
  cx.out << ") {";
  cx.end();
  if (!loops.empty())
    ++loops.back().switches;
  for (const CaseBranch &branch : s->branches) {
    for (const CaseLabel &label : branch.labels)
      emitSwitchLabel(cx, label, s->selector->type, &label == &branch.labels.back());
    emitSwitchBlock(cx, branch.body);
  }
  cx.line("default: {");
  emitSwitchBlock(cx, s->elseBody);
  cx.line("}");
  if (!loops.empty())
    --loops.back().switches;
}

/// `selector == 1 || (selector >= 5 && selector <= 9)`
void emitLabels(EmitContext &cx, const CaseBranch &branch, const std::string &selector,
                const Type *type) {
  for (const CaseLabel &label : branch.labels) {
    if (&label != &branch.labels.front())
      cx.out << " || ";
    if (label.high == nullptr) {
      cx.out << selector << " == ";
      emitValueAs(cx, label.low, type);
      continue;
    }
    cx.out << '(' << selector << " >= ";
    emitValueAs(cx, label.low, type);
    cx.out << " && " << selector << " <= ";
    emitValueAs(cx, label.high, type);
    cx.out << ')';
  }
}

void emitCaseChain(EmitContext &cx, const CaseStmt *s) {
  const Type *type = s->selector->type;
  const std::string selector = cx.temporary("selector");
  cx.begin(s->span);
  cx.out << "const " << cx.type(type) << ' ' << selector << " = ";
  emitValueAs(cx, s->selector, type);
  cx.out << ';';
  cx.end();
  Chain chain(cx, s->branches.size(), "endcase");
  if (chain.isFlat()) { // its label must not lie in the scope of the selector's declaration
    cx.line("{");
    cx.open();
  }
  for (const CaseBranch &branch : s->branches)
    chain.branch(
        branch.labels.empty() ? s->span : branch.labels.front().span,
        [&] { emitLabels(cx, branch, selector, type); }, branch.body);
  chain.otherwise(s->elseBody);
  if (chain.isFlat()) {
    cx.close();
    cx.line("}");
    chain.label();
  }
}

/// The labels are few enough for a `switch`.
bool fitsSwitch(const CaseStmt *s) {
  int64_t labels = 0;
  for (const CaseBranch &branch : s->branches) {
    for (const CaseLabel &label : branch.labels) {
      int64_t width = 0;
      if (label.high != nullptr && __builtin_sub_overflow(label.high->constant->integer,
                                                          label.low->constant->integer, &width))
        return false;
      if (width < 0 || width >= kMaxRange) // negative: an empty or a huge range
        return false;
      labels += width + 1;
    }
  }
  return labels <= kMaxLabels || labels <= 4 * static_cast<int64_t>(s->branches.size());
}

} // namespace

void emitIf(EmitContext &cx, const IfStmt *s) {
  Chain chain(cx, s->branches.size(), "endif");
  for (const IfBranch &branch : s->branches)
    chain.branch(
        &branch == &s->branches.front() ? s->span : branch.condition->span,
        [&] { emitValue(cx, branch.condition); }, branch.body);
  chain.otherwise(s->elseBody);
  if (chain.isFlat()) {
    cx.close();
    chain.label();
    cx.open();
  }
}

void emitCase(EmitContext &cx, const CaseStmt *s) {
  if (fitsSwitch(s))
    emitSwitch(cx, s);
  else
    emitCaseChain(cx, s);
}

} // namespace stc::codegen
