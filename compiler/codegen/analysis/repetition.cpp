#include "compiler/codegen/analysis/repetition.hpp"

#include "compiler/syntax/visit.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace stc::codegen {

using namespace ast;

namespace {

bool isLoop(const Stmt *s) {
  return s->kind == StmtKind::For || s->kind == StmtKind::While || s->kind == StmtKind::RepeatS;
}

/// Somebody may call it whom no call in the program names.
bool isReachedOtherwise(const PouSymbol *pou) {
  const PouSymbol *block = pou->owner != nullptr ? pou->owner : pou;
  return pou->property != nullptr || block->base != nullptr || block->extended ||
         !block->interfaces.empty();
}

} // namespace

bool Repetition::isRepeated(const PouSymbol *pou) {
  if (!own_->isUser && !own_->isBuilt)
    return true;
  prepare();
  return repeated_.contains(pou);
}

bool Repetition::callsOften(const PouSymbol *caller, const PouSymbol *callee) {
  if (isRepeated(callee) && caller == nullptr)
    return true;
  const auto calls = calls_.find(caller);
  return isRepeated(caller) || (calls != calls_.end() && calls->second.inLoops.contains(callee));
}

bool Repetition::runsOnce(const PouSymbol *pou) {
  if (isRepeated(pou))
    return false;
  const auto calls = calls_.find(pou);
  return calls != calls_.end() && !calls->second.hasLoop;
}

void Repetition::find() {
  known_ = true;
  for (const auto &library : program_.libraries) {
    for (const PouSymbol *pou : library->pous) {
      look(pou);
      for (const PouSymbol *method : pou->methods)
        look(method);
    }
  }
  for (const PouSymbol *check : program_.implicitChecks)
    if (check != nullptr)
      repeat(check);
  for (const PouSymbol *pou : order_) {
    if (isReachedOtherwise(pou))
      repeat(pou);
    for (const PouSymbol *callee : calls_[pou].inLoops)
      repeat(callee);
  }
  findCircles();
  while (!found_.empty()) {
    const PouSymbol *pou = found_.back();
    found_.pop_back();
    if (const auto calls = calls_.find(pou); calls != calls_.end())
      for (const PouSymbol *callee : calls->second.all)
        repeat(callee);
  }
}

void Repetition::look(const PouSymbol *pou) {
  Calls &calls = calls_[pou];
  order_.push_back(pou);
  if (pou->checked && !pou->decl->external)
    block(pou->decl->body, false, calls);
}

void Repetition::block(Block block, bool inLoop, Calls &calls) {
  // A label may be jumped back to.
  const bool jumps = std::any_of(block.begin(), block.end(),
                                 [](const Stmt *s) { return s->kind == StmtKind::Label; });
  const bool here = inLoop || jumps;
  calls.hasLoop = calls.hasLoop || jumps;
  for (const Stmt *s : block) {
    const bool within = here || isLoop(s);
    calls.hasLoop = calls.hasLoop || within;
    forEachChild(
        s, [&](Expr *e) { expression(e, within, calls); },
        [&](Block inner) { this->block(inner, within, calls); });
  }
}

void Repetition::expression(Expr *expr, bool inLoop, Calls &calls) {
  walk(expr, [&](const Expr *e) {
    if (e->kind != ExprKind::Call || as<CallExpr>(e)->pou == nullptr)
      return;
    calls.all.insert(as<CallExpr>(e)->pou);
    if (inLoop)
      calls.inLoops.insert(as<CallExpr>(e)->pou);
  });
}

void Repetition::repeat(const PouSymbol *pou) {
  if (repeated_.insert(pou).second)
    found_.push_back(pou);
}

/// What calls itself over others: POUs that are never without a caller among those left.
void Repetition::findCircles() {
  std::unordered_map<const PouSymbol *, size_t> callers;
  for (const PouSymbol *pou : order_)
    for (const PouSymbol *callee : calls_[pou].all)
      ++callers[callee];
  std::vector<const PouSymbol *> free;
  for (const PouSymbol *pou : order_)
    if (callers[pou] == 0)
      free.push_back(pou);
  while (!free.empty()) {
    const PouSymbol *pou = free.back();
    free.pop_back();
    for (const PouSymbol *callee : calls_[pou].all)
      if (--callers[callee] == 0 && calls_.contains(callee))
        free.push_back(callee);
  }
  for (const PouSymbol *pou : order_)
    if (callers[pou] != 0)
      repeat(pou);
}

} // namespace stc::codegen
