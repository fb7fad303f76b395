// CASE.

#include "compiler/semantics/statements/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

#include <map>

namespace stc::sema {

using namespace ast;

namespace {

/// The values that have a branch: by lower bound, ranges that do not overlap.
struct SeenRange {
  int64_t high;
  Span span;
};
using SeenRanges = std::map<int64_t, SeenRange>;

} // namespace

/// The type of the selector; null (reported): nothing can be selected by it.
static const Type *checkSelector(Context &c, Expr *selector) {
  const Type *type = check(c, selector);
  if (isError(type))
    return nullptr;
  if (type->kind == TypeKind::AnyInteger)
    return settle(selector);
  if (isInteger(underlying(type)))
    return type;
  auto &d = c.report(Code::CaseSelector, selector->span,
                     "CASE selects by an integer or an enumeration, not by " + typeName(type),
                     "cannot select by this");
  if (type->kind == TypeKind::Boolean)
    d.help("use IF … ELSE for a BOOL");
  return nullptr;
}

/// Checks one bound of a label; true: its value is known. `type` of the selector; null: wrong.
static bool checkLabelBound(Context &c, Expr *bound, const Type *type) {
  const Type *boundType = check(c, bound, type);
  if (type == nullptr || isError(boundType))
    return false;
  if (bound->constant == nullptr) {
    c.report(Code::CaseLabelNotConstant, bound->span, "a CASE label must be a constant",
             "its value is only known at run time")
        .help("use IF … ELSIF for values that change");
    return false;
  }
  const bool isEnumerator = boundType->kind == TypeKind::Enumeration;
  const bool ofEnumeration = type->kind == TypeKind::Enumeration;
  if (isEnumerator && !ofEnumeration && isInteger(type))
    setTarget(bound, type);
  else if (!isEnumerator && ofEnumeration && constantFits(*bound->constant, boundType, type))
    setTarget(bound, type); // even where the enumeration is strict
  else
    coerce(c, bound, type, "the CASE label");
  return bound->constant->kind == ConstKind::Integer;
}

/// Reports a label whose range is empty, or that holds what another one holds.
static void checkRange(Context &c, const CaseLabel &label, const Type *type, SeenRanges &seen) {
  const int64_t low = label.low->constant->integer;
  const int64_t high = label.high == nullptr ? low : label.high->constant->integer;
  const bool wide = bitWidth(type) == 64 && !isSignedInteger(underlying(type)); // compare as ULINT
  const bool isEmpty = wide ? static_cast<uint64_t>(high) < static_cast<uint64_t>(low) : high < low;
  if (isEmpty) {
    c.report(Code::EmptyRange, label.span, "this range holds no value",
             "the upper bound is below the lower one");
    return;
  }
  auto other = seen.upper_bound(high); // the first range after this one
  if (other != seen.begin() && (--other)->second.high >= low) {
    auto &d = c.report(Code::DuplicateLabel, label.span, "this CASE value is already handled",
                       "handled again here");
    d.label(other->second.span, "first handled here");
  } else {
    seen.emplace(low, SeenRange{high, label.span});
  }
}

void checkCase(Context &c, CaseStmt *stmt) {
  const Type *type = checkSelector(c, stmt->selector);
  SeenRanges seen;
  for (const CaseBranch &branch : stmt->branches) {
    for (const CaseLabel &label : branch.labels) {
      bool known = checkLabelBound(c, label.low, type);
      if (label.high != nullptr && known)
        known = checkLabelBound(c, label.high, type);
      else if (label.high != nullptr)
        check(c, label.high, type);
      if (known)
        checkRange(c, label, type, seen);
    }
    checkBlock(c, branch.body);
  }
  checkBlock(c, stmt->elseBody);
}

} // namespace stc::sema
