// Assignments, IF chains and CASE statements that are probably not meant as they stand.

#include "compiler/semantics/lint/internal.hpp"

#include <algorithm>

namespace stc::lint {

using namespace ast;

static void dangling(Context &c, const AssignStmt *stmt);

namespace {

constexpr size_t kLongestChain = 64; ///< conditions that are compared with each other
constexpr size_t kMostListed = 6;
constexpr size_t kLongEnumeration = 32;

/// Reading the same volatile place twice is a way to wait for hardware; a variable is not volatile.
bool isPlainRead(const Expr *expr) {
  return expr->kind == ExprKind::Name || expr->kind == ExprKind::Member ||
         expr->kind == ExprKind::Index || expr->kind == ExprKind::Deref;
}

} // namespace

void assignment(Context &c, AssignStmt *stmt) {
  if (stmt->op == AssignOp::Reference) {
    takeAddress(c, stmt->value);
    for (Expr *target : stmt->targets)
      write(c, target);
    dangling(c, stmt);
    return;
  }
  read(c, stmt->value);
  for (size_t i = stmt->targets.size(); i-- > 0;) {
    Expr *target = stmt->targets[i];
    write(c, target);
    if (stmt->op == AssignOp::Set || stmt->op == AssignOp::Reset) { // keeps its value otherwise
      if (VarSymbol *root = rootVariable(target))
        markUse(c, root, kUseRead);
    }
    const Expr *value = i + 1 == stmt->targets.size() ? stmt->value : stmt->targets[i + 1];
    if (stmt->op == AssignOp::Assign && isPlainRead(value) && sameExpr(target, value))
      report(c, Code::SelfAssignment, stmt->span,
             "`" + text(c, target->span) + "` is assigned to itself", "this changes nothing");
  }
  dangling(c, stmt);
}

static void dangling(Context &c, const AssignStmt *stmt) {
  const Expr *place = stmt->op == AssignOp::Reference ? stmt->value : addressed(stmt->value);
  if (place == nullptr)
    return;
  const VarSymbol *local = rootVariable(place);
  if (local == nullptr || !isOwnLocal(c, local) || local->isResult ||
      local->section == Section::InOut)
    return;
  const PouDecl *decl = c.bodies[c.current].decl;
  const auto dies = [decl](const VarSymbol *v) {
    return v->section == Section::Temp ||
           ((decl->kind == DeclKind::Function || decl->kind == DeclKind::Method) &&
            v->section != Section::Stat && v->section != Section::Instance && !v->isConstant);
  };
  if (!dies(local) || local->type == nullptr || local->type->kind == TypeKind::Reference)
    return;
  for (const Expr *target : stmt->targets) {
    const VarSymbol *root = rootVariable(target);
    if (root != nullptr && isOwnLocal(c, root) && !root->isResult &&
        root->section != Section::Output && root->section != Section::InOut && dies(root))
      continue;
    report(c, Code::DanglingAddress, place->span,
           "`" + text(c, target->span) + "` keeps the address of `" +
               std::string(local->name.text) + "`, which is gone after the call",
           local->section == Section::Temp ? "a VAR_TEMP lives for one call only"
                                           : "a local variable of a function lives for one call "
                                             "only")
        .label(local->name.span, "declared here")
        .help("let it refer to a variable that stays: a global one, or a VAR of a program or "
              "function block");
  }
}

void ifChain(Context &c, const IfStmt *stmt) {
  const auto &branches = stmt->branches;
  const size_t count = std::min(branches.size(), kLongestChain);
  for (size_t i = 1; i < count; ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (isLiteral(branches[i].condition) ||
          !sameExpr(branches[i].condition, branches[j].condition))
        continue;
      report(c, Code::DuplicateCondition, branches[i].condition->span,
             "this condition was already asked", "this branch never runs")
          .label(branches[j].condition->span, "asked here first");
      break;
    }
  }
  if (!stmt->hasElse || stmt->elseBody.empty())
    return;
  const bool identical = std::all_of(branches.begin(), branches.end(), [&](const IfBranch &branch) {
    return sameBlock(branch.body, stmt->elseBody);
  });
  if (identical)
    report(c, Code::IdenticalBranches, {stmt->span.file, stmt->span.begin, stmt->span.begin + 2},
           "all branches of this IF do the same", "the condition makes no difference")
        .label(branches[0].body.front()->span, "this …")
        .label(stmt->elseBody.front()->span, "… and this are the same");
}

namespace {

bool handles(const CaseLabel &label, int64_t value) {
  if (label.low->constant == nullptr || (label.high != nullptr && label.high->constant == nullptr))
    return false;
  const int64_t low = label.low->constant->integer;
  const int64_t high = label.high == nullptr ? low : label.high->constant->integer;
  return low <= value && value <= high;
}

/// The enumerators without a branch; two names of one value are one.
std::vector<const EnumeratorSymbol *> unhandled(const CaseStmt *stmt, const EnumType *enumeration) {
  std::vector<const EnumeratorSymbol *> missing;
  for (const EnumeratorSymbol *e : enumeration->enumerators) {
    const bool handled =
        std::any_of(stmt->branches.begin(), stmt->branches.end(), [e](const CaseBranch &branch) {
          return std::any_of(branch.labels.begin(), branch.labels.end(),
                             [e](const CaseLabel &label) { return handles(label, e->value); });
        });
    const bool known = std::any_of(missing.begin(), missing.end(),
                                   [e](const auto *other) { return other->value == e->value; });
    if (!handled && !known)
      missing.push_back(e);
  }
  return missing;
}

/// "`a`, `b` and `c`"
std::string listOf(const std::vector<const EnumeratorSymbol *> &missing) {
  std::string list;
  for (size_t i = 0; i < std::min(missing.size(), kMostListed); ++i)
    list += (i == 0                    ? "`"
             : i + 1 == missing.size() ? " and `"
                                       : ", `") +
            std::string(missing[i]->name.text) + "`";
  if (missing.size() > kMostListed)
    list += " and " + std::to_string(missing.size() - kMostListed) + " more";
  return list;
}

} // namespace

/// Says how a branch for them is written.
static void suggestBranch(Context &c, Diagnostic &d, const CaseStmt *stmt,
                          const std::vector<const EnumeratorSymbol *> &missing) {
  std::string labels;
  for (const EnumeratorSymbol *e : missing)
    labels += (labels.empty() ? "" : ", ") + typeName(stmt->selector->type) + "." +
              std::string(e->name.text);
  const std::string help = "add `" + (labels.size() > 60 ? std::string("ELSE ;") : labels + ": ;") +
                           "`, or an ELSE, to say that nothing is to be done";
  constexpr std::string_view kEnd = "END_CASE";
  if (c.program.sources.text(stmt->span).size() > kEnd.size()) {
    const uint32_t at = stmt->span.end - static_cast<uint32_t>(kEnd.size());
    d.suggest(help, {stmt->span.file, at, at}, labels + ": ;\n");
  } else {
    d.help(help);
  }
}

void missingCases(Context &c, const CaseStmt *stmt) {
  const Type *type = stmt->selector->type;
  if (stmt->hasElse || stmt->selector->constant != nullptr || type == nullptr ||
      type->kind != TypeKind::Enumeration)
    return;
  const auto *enumeration = typeAs<EnumType>(type);
  const std::vector<const EnumeratorSymbol *> missing = unhandled(stmt, enumeration);
  // Of a long list, or a library's, some values are picked on purpose.
  const bool foreign = enumeration->symbol != nullptr && !enumeration->symbol->library->isUser;
  const bool picks = missing.size() > enumeration->enumerators.size() / 2;
  if (missing.empty() || (picks && (foreign || enumeration->enumerators.size() > kLongEnumeration)))
    return;
  auto &d = report(c, Code::MissingCase, stmt->selector->span,
                   "this CASE does not handle " + listOf(missing) + " of `" + typeName(type) + "`",
                   missing.size() == 1 ? "one value has no branch"
                                       : std::to_string(missing.size()) + " values have no branch");
  if (enumeration->symbol != nullptr && enumeration->symbol->decl != nullptr)
    d.label(enumeration->symbol->name.span, "the enumeration");
  suggestBranch(c, d, stmt, missing);
}

void unreachableCases(Context &c, const CaseStmt *stmt) {
  std::optional<ValueRange> range = valueRange(stmt->selector);
  const ConstValue *constant = stmt->selector->constant;
  // The name of a constant may be a switch that is meant to be turned.
  const bool fixed =
      constant != nullptr && constant->kind == ConstKind::Integer && isLiteral(stmt->selector);
  if (fixed)
    range = ValueRange{constant->integer, constant->integer};
  if (!range)
    return;
  for (const CaseBranch &branch : stmt->branches) {
    for (const CaseLabel &label : branch.labels) {
      if (label.low->constant == nullptr || label.low->type == nullptr ||
          label.low->type->kind == TypeKind::Ulint ||
          (label.high != nullptr && label.high->constant == nullptr))
        continue;
      const int64_t low = label.low->constant->integer;
      const int64_t high = label.high == nullptr ? low : label.high->constant->integer;
      if (low > high || (low <= range->high && high >= range->low))
        continue;
      report(c, Code::UnreachableCase, label.span, "this CASE value never occurs",
             "the selector is never " + text(c, label.span))
          .label(stmt->selector->span, fixed ? "is always " + text(c, stmt->selector->span)
                                             : "gives " + std::to_string(range->low) + " to " +
                                                   std::to_string(range->high));
    }
  }
}

} // namespace stc::lint
