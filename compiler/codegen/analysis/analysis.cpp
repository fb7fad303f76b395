#include "compiler/codegen/analysis/analysis.hpp"

#include "compiler/semantics/held.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include "compiler/semantics/fold.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>
#include <optional>

namespace stc::codegen {

using namespace ast;

namespace {

/// A variable of the type calls methods when it comes into being or goes away (FB_Init, FB_Exit).
bool runsMethods(const Type *type) {
  return anyHeld(type, [](const Type *t, const VarSymbol *v) {
    if ((v != nullptr && v->section == Section::InOut) || t->kind == TypeKind::Program)
      return Held::Over;
    return t->kind == TypeKind::FunctionBlock && !typeAs<PouType>(t)->symbol->methods.empty()
               ? Held::Found
               : Held::Inside;
  });
}

/// A variable of the function itself, or a part of it.
bool isLocal(const Expr *target, const PouSymbol *function) {
  while (true) {
    switch (target->kind) {
    case ExprKind::Name: {
      const VarSymbol *v = namedVariable(target);
      return v != nullptr && v->owner == function;
    }
    case ExprKind::Member:
      if (isNamespace(as<MemberExpr>(target)->base))
        return false;
      target = as<MemberExpr>(target)->base;
      continue;
    case ExprKind::Index:
      if (followsAddress(as<IndexExpr>(target)))
        return false;
      target = as<IndexExpr>(target)->base;
      continue;
    default:
      return false;
    }
  }
}

} // namespace

bool Analysis::pure(const PouSymbol *function) {
  const auto [it, fresh] = pure_.try_emplace(function, false); // a recursive one counts as not pure
  if (!fresh)
    return it->second;
  if (calls_ >= kMaxCalls) // nor does one that calls others, which call others …
    return false;
  ++calls_;
  bool result = function->isFunction();
  for (const VarSymbol *v : function->variables) {
    if (v->section == Section::InOut || v->section == Section::Output ||
        v->section == Section::Stat || v->type->kind == TypeKind::Pointer ||
        v->type->kind == TypeKind::Reference || v->type->kind == TypeKind::Interface ||
        runsMethods(v->type))
      result = false;
  }
  // What a native function does is not known: it may write through an address or to a file.
  result =
      result && !function->decl->external && function->checked &&
      computes(function->decl->body, [&](const Expr *target) { return isLocal(target, function); });
  pure_[function] = result;
  --calls_;
  return result;
}

namespace {

/// Assigning to `target` may change `variable`.
bool mayChange(const Expr *target, const Symbol *variable) {
  while (true) {
    switch (target->kind) {
    case ExprKind::Name:
      // An in-out or a reference may stand for any variable.
      if (const VarSymbol *v = namedVariable(target))
        return v == variable || v->section == Section::InOut ||
               v->type->kind == TypeKind::Reference;
      return false;
    case ExprKind::Member: {
      const auto *m = as<MemberExpr>(target);
      if (m->symbol != nullptr && m->symbol->kind == SymbolKind::Variable) {
        const auto *v = static_cast<const VarSymbol *>(m->symbol);
        if (v == variable || v->section == Section::InOut || v->type->kind == TypeKind::Reference)
          return true;
      }
      if (isNamespace(m->base))
        return false;
      target = m->base;
      continue;
    }
    case ExprKind::Index:
      if (followsAddress(as<IndexExpr>(target)))
        return true;
      target = as<IndexExpr>(target)->base;
      continue;
    default:
      return true;
    }
  }
}

} // namespace

bool Analysis::computes(Block block, MayWrite mayWrite) {
  return std::all_of(block.begin(), block.end(),
                     [&](const Stmt *s) { return computes(s, mayWrite); });
}

bool Analysis::computes(const Stmt *s, MayWrite mayWrite) {
  switch (s->kind) {
  case StmtKind::Call:
  case StmtKind::Jump:
  case StmtKind::Label:
  case StmtKind::Try:
    return false;
  case StmtKind::Assign: {
    const auto &targets = as<AssignStmt>(s)->targets;
    if (!std::all_of(targets.begin(), targets.end(), mayWrite))
      return false;
    break;
  }
  case StmtKind::For:
    if (!mayWrite(as<ForStmt>(s)->variable))
      return false;
    break;
  default:
    break;
  }
  bool plain = true;
  forEachChild(
      s, [&](const Expr *e) { plain = plain && (effects(e) & kEffectCalls) == 0; },
      [&](Block inner) { plain = plain && computes(inner, mayWrite); });
  return plain;
}

namespace {

/// The constant bounds of a FOR loop whose variable is named directly, or nothing.
struct Bounds {
  int64_t from;
  int64_t to;
  int64_t step;
};

std::optional<Bounds> constantBounds(const ForStmt *loop) {
  const VarSymbol *variable = namedVariable(loop->variable);
  if (variable == nullptr || variable->section == Section::InOut ||
      variable->type->kind == TypeKind::Reference || variable->location != nullptr)
    return std::nullopt;
  if (loop->from->constant == nullptr || loop->to->constant == nullptr ||
      (loop->by != nullptr && loop->by->constant == nullptr))
    return std::nullopt;
  const Bounds b{loop->from->constant->integer, loop->to->constant->integer,
                 loop->by == nullptr ? 1 : loop->by->constant->integer};
  const Type *type = underlying(variable->type);
  const bool fits = wrapTo(type, b.from) == b.from && wrapTo(type, b.to) == b.to;
  // Beyond these a difference could wrap, or the 64 bits mean an unsigned number.
  constexpr int64_t kFar = int64_t{1} << 62;
  const bool isNegative = b.from < 0 || b.to < 0;
  if (b.step == 0 || !fits || b.from < -kFar || b.from > kFar || b.to < -kFar || b.to > kFar ||
      b.step < -kFar || b.step > kFar || (isNegative && !isSignedInteger(type)))
    return std::nullopt;
  return b;
}

/// `a * b`, or a number that is too large for every limit.
int64_t times(int64_t a, int64_t b) {
  constexpr int64_t kHuge = int64_t{1} << 62;
  int64_t product = 0;
  return __builtin_mul_overflow(a, b, &product) || product > kHuge ? kHuge : product;
}

} // namespace

/// How often the most repeated statement of the block runs; huge when that is not known.
int64_t Analysis::rounds(Block block) {
  int64_t most = 1;
  const auto nested = [&](Block inner, int64_t factor) {
    most = std::max(most, times(rounds(inner), factor));
  };
  for (const Stmt *s : block) {
    switch (s->kind) {
    case StmtKind::While:
    case StmtKind::RepeatS:
    case StmtKind::Call:
    case StmtKind::Jump:
    case StmtKind::Label:
    case StmtKind::Try:
      return kHuge;
    case StmtKind::For: {
      const auto *inner = as<ForStmt>(s);
      const auto bounds = constantBounds(inner);
      if (!bounds || sharedVariable(inner) ||
          !unchanged(inner->body, namedVariable(inner->variable)))
        return kHuge;
      nested(inner->body, std::max<int64_t>((bounds->to - bounds->from) / bounds->step + 1, 1));
      break;
    }
    default:
      forEachChild(
          s, [](const Expr *) {}, [&](Block inner) { nested(inner, 1); });
      break;
    }
  }
  return most;
}

int64_t Analysis::ownRounds(const ForStmt *loop) const {
  const auto bounds = constantBounds(loop);
  if (!bounds || sharedVariable(loop))
    return kHuge;
  return std::max<int64_t>((bounds->to - bounds->from) / bounds->step + 1, 0);
}

bool Analysis::shortLoop(const ForStmt *loop) {
  const auto bounds = constantBounds(loop);
  if (!bounds || sharedVariable(loop))
    return false;
  const int64_t own = (bounds->to - bounds->from) / bounds->step + 1;
  if (times(rounds(loop->body), std::max<int64_t>(own, 1)) > kShortLoop)
    return false;
  return unchanged(loop->body, namedVariable(loop->variable));
}

bool Analysis::endsInside(const ForStmt *loop) const {
  const auto bounds = constantBounds(loop);
  if (!bounds)
    return false;
  const Type *type = underlying(loop->variable->type);
  const int64_t after = bounds->to + bounds->step;
  return wrapTo(type, after) == after && (after >= 0 || isSignedInteger(type));
}

/// Inner loops over the same variable are in it: they change it.
bool Analysis::unchanged(Block body, const VarSymbol *variable) {
  return computes(body, [&](const Expr *target) { return !mayChange(target, variable); });
}

} // namespace stc::codegen
