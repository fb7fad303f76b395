// CASE.

#include "compiler/semantics/statements/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"

#include <map>

namespace stc::sema {

using namespace ast;

void checkCase(Context &c, CaseStmt *stmt) {
  const Type *type = check(c, stmt->selector);
  bool ok = !isError(type);
  if (ok && !isInteger(underlying(type)) && type->kind != TypeKind::anyInteger) {
    auto &d = c.report(Code::caseSelector, stmt->selector->span,
                       "CASE selects by an integer or an enumeration, not by " + typeName(type),
                       "cannot select by this");
    if (type->kind == TypeKind::boolean)
      d.help("use IF … ELSE for a BOOL");
    ok = false;
  }
  if (ok && type->kind == TypeKind::anyInteger)
    type = settle(stmt->selector);
  struct Seen {
    std::int64_t high;
    Span span;
  };
  std::map<std::int64_t, Seen> seen; // by lower bound; ranges that do not overlap
  for (CaseBranch &branch : stmt->branches) {
    for (CaseLabel &label : branch.labels) {
      bool known = true;
      for (Expr *bound : {label.low, label.high}) {
        if (bound == nullptr)
          continue;
        const Type *boundType = check(c, bound, ok ? type : nullptr);
        known = known && ok && !isError(boundType);
        if (!known)
          continue;
        if (bound->constant == nullptr) {
          c.report(Code::caseLabelNotConstant, bound->span, "a CASE label must be a constant",
                   "its value is only known at run time")
              .help("use IF … ELSIF for values that change");
          known = false;
          continue;
        }
        if (boundType->kind == TypeKind::enumeration && !typeAs<EnumType>(boundType)->strict &&
            type->kind != TypeKind::enumeration && isInteger(type))
          setTarget(bound, type);
        else
          coerce(c, bound, type, "the CASE label");
        known = known && bound->constant->kind == ConstKind::integer;
      }
      if (!known)
        continue;
      const std::int64_t low = label.low->constant->integer;
      const std::int64_t high = label.high == nullptr ? low : label.high->constant->integer;
      const bool wide =
          bitWidth(type) == 64 && !isSignedInteger(underlying(type)); // compare as ULINT
      const auto before = [wide](std::int64_t a, std::int64_t b) {
        return wide ? static_cast<std::uint64_t>(a) < static_cast<std::uint64_t>(b) : a < b;
      };
      if (before(high, low)) {
        c.report(Code::emptyRange, label.span, "this range holds no value",
                 "the upper bound is below the lower one");
        continue;
      }
      auto other = seen.upper_bound(high); // the first range behind this one
      if (other != seen.begin() && (--other)->second.high >= low) {
        auto &d = c.report(Code::duplicateLabel, label.span, "this CASE value is already handled",
                           "handled again here");
        d.label(other->second.span, "first handled here");
      } else {
        seen.emplace(low, Seen{high, label.span});
      }
    }
    checkBlock(c, branch.body);
  }
  checkBlock(c, stmt->elseBody);
}

} // namespace stc::sema
