// Assignments, IF chains and CASE statements that are probably not meant as they stand.

#include "compiler/semantics/lint/lint.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

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

void Linter::assignment(AssignStmt *stmt) {
  if (stmt->op == AssignOp::Reference) {
    takeAddress(stmt->value);
    for (Expr *target : stmt->targets)
      write(target);
    dangling(stmt);
    return;
  }
  read(stmt->value);
  for (size_t i = stmt->targets.size(); i-- > 0;) {
    Expr *target = stmt->targets[i];
    write(target);
    if (stmt->op == AssignOp::Set || stmt->op == AssignOp::Reset) { // keeps its value otherwise
      if (VarSymbol *root = rootVariable(target))
        root->uses |= kUseRead;
    }
    const Expr *value = i + 1 == stmt->targets.size() ? stmt->value : stmt->targets[i + 1];
    if (stmt->op == AssignOp::Assign && isPlainRead(value) && sameExpr(target, value))
      report(Code::SelfAssignment, stmt->span, "`" + text(target->span) + "` is assigned to itself",
             "this changes nothing");
  }
  dangling(stmt);
}

void Linter::dangling(const AssignStmt *stmt) {
  const Expr *place = stmt->op == AssignOp::Reference ? stmt->value : addressed(stmt->value);
  if (place == nullptr)
    return;
  const VarSymbol *local = rootVariable(place);
  if (local == nullptr || !isOwnLocal(local) || local->isResult || local->section == Section::InOut)
    return;
  const PouDecl *decl = bodies_[current_].decl;
  const auto dies = [decl](const VarSymbol *v) {
    return v->section == Section::Temp ||
           ((decl->kind == DeclKind::Function || decl->kind == DeclKind::Method) &&
            v->section != Section::Stat && v->section != Section::Instance && !v->isConstant);
  };
  if (!dies(local) || local->type == nullptr || local->type->kind == TypeKind::Reference)
    return;
  for (const Expr *target : stmt->targets) {
    const VarSymbol *root = rootVariable(target);
    if (root != nullptr && isOwnLocal(root) && !root->isResult &&
        root->section != Section::Output && root->section != Section::InOut && dies(root))
      continue;
    report(Code::DanglingAddress, place->span,
           "`" + text(target->span) + "` keeps the address of `" + std::string(local->name.text) +
               "`, which is gone after the call",
           local->section == Section::Temp ? "a VAR_TEMP lives for one call only"
                                           : "a local variable of a function lives for one call "
                                             "only")
        .label(local->name.span, "declared here")
        .help("let it refer to a variable that stays: a global one, or a VAR of a program or "
              "function block");
  }
}

void Linter::ifChain(const IfStmt *stmt) {
  const auto &branches = stmt->branches;
  const size_t count = std::min(branches.size(), kLongestChain);
  for (size_t i = 1; i < count; ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (isLiteral(branches[i].condition) ||
          !sameExpr(branches[i].condition, branches[j].condition))
        continue;
      report(Code::DuplicateCondition, branches[i].condition->span,
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
    report(Code::IdenticalBranches, {stmt->span.file, stmt->span.begin, stmt->span.begin + 2},
           "all branches of this IF do the same", "the condition makes no difference")
        .label(branches[0].body.front()->span, "this …")
        .label(stmt->elseBody.front()->span, "… and this are the same");
}

void Linter::missingCases(const CaseStmt *stmt) {
  const Type *type = stmt->selector->type;
  if (stmt->hasElse || stmt->selector->constant != nullptr || type == nullptr ||
      type->kind != TypeKind::Enumeration)
    return;
  const auto *enumeration = typeAs<EnumType>(type);
  std::vector<const EnumeratorSymbol *> missing;
  for (const EnumeratorSymbol *e : enumeration->enumerators) {
    const bool handled =
        std::any_of(stmt->branches.begin(), stmt->branches.end(), [&](const CaseBranch &branch) {
          return std::any_of(
              branch.labels.begin(), branch.labels.end(), [&](const CaseLabel &label) {
                if (label.low->constant == nullptr ||
                    (label.high != nullptr && label.high->constant == nullptr))
                  return false;
                const int64_t low = label.low->constant->integer;
                const int64_t high = label.high == nullptr ? low : label.high->constant->integer;
                return low <= e->value && e->value <= high;
              });
        });
    // Two names of one value are one case.
    const bool known = std::any_of(missing.begin(), missing.end(),
                                   [&](const auto *other) { return other->value == e->value; });
    if (!handled && !known)
      missing.push_back(e);
  }
  // Of a long list, or a library's, some values are picked on purpose.
  const bool foreign = enumeration->symbol != nullptr && !enumeration->symbol->library->isUser;
  const bool picks = missing.size() > enumeration->enumerators.size() / 2;
  if (missing.empty() || (picks && (foreign || enumeration->enumerators.size() > kLongEnumeration)))
    return;
  std::string list;
  std::string labels;
  for (size_t i = 0; i < missing.size(); ++i) {
    const std::string name = typeName(type) + "." + std::string(missing[i]->name.text);
    labels += (i == 0 ? "" : ", ") + name;
    if (i < kMostListed)
      list += (i == 0                    ? "`"
               : i + 1 == missing.size() ? " and `"
                                         : ", `") +
              std::string(missing[i]->name.text) + "`";
  }
  if (missing.size() > kMostListed)
    list += " and " + std::to_string(missing.size() - kMostListed) + " more";
  const std::string_view source = program_.sources.text(stmt->span);
  constexpr std::string_view kEnd = "END_CASE";
  auto &d = report(Code::MissingCase, stmt->selector->span,
                   "this CASE does not handle " + list + " of `" + typeName(type) + "`",
                   missing.size() == 1 ? "one value has no branch"
                                       : std::to_string(missing.size()) + " values have no branch");
  if (enumeration->symbol != nullptr && enumeration->symbol->decl != nullptr)
    d.label(enumeration->symbol->name.span, "the enumeration");
  const std::string help = "add `" + (labels.size() > 60 ? std::string("ELSE ;") : labels + ": ;") +
                           "`, or an ELSE, to say that nothing is to be done";
  if (source.size() > kEnd.size()) {
    const uint32_t at = stmt->span.end - static_cast<uint32_t>(kEnd.size());
    d.suggest(help, {stmt->span.file, at, at}, labels + ": ;\n");
  } else {
    d.help(help);
  }
}

void Linter::unreachableCases(const CaseStmt *stmt) {
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
      report(Code::UnreachableCase, label.span, "this CASE value never occurs",
             "the selector is never " + text(label.span))
          .label(stmt->selector->span, fixed ? "is always " + text(stmt->selector->span)
                                             : "gives " + std::to_string(range->low) + " to " +
                                                   std::to_string(range->high));
    }
  }
}

} // namespace stc
