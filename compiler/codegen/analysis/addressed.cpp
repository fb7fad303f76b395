#include "compiler/codegen/analysis/addressed.hpp"

#include "compiler/codegen/analysis/analysis.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

bool Addressed::holdsBlock(const Type *type) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (type->kind != TypeKind::Structure)
    return type->kind == TypeKind::FunctionBlock;
  for (const auto *s = typeAs<StructType>(type); s != nullptr; s = s->base) {
    if (std::any_of(s->fields.begin(), s->fields.end(),
                    [](const VarSymbol *field) { return holdsBlock(field->type); }))
      return true;
  }
  return false;
}

bool Addressed::onDataStack(const VarSymbol *variable) {
  if (holdsBlock(variable->type))
    return true;
  const bool isPassed = variable->section == Section::Input || variable->section == Section::InOut;
  if (!isPassed && storage_.of(variable->type).size > kLarge)
    return true;
  prepare();
  return exposed_.contains(variable);
}

void Addressed::find() {
  known_ = true;
  for (const auto &library : program_.libraries) {
    for (const PouSymbol *p : library->pous)
      pou(p);
  }
  while (!found_.empty()) {
    const VarSymbol *variable = found_.back();
    found_.pop_back();
    if (!exposed_.insert(variable).second)
      continue;
    if (const auto it = bound_.find(variable); it != bound_.end())
      found_.insert(found_.end(), it->second.begin(), it->second.end());
  }
}

void Addressed::pou(const PouSymbol *pou) {
  parameters(pou);
  for (const VarSymbol *v : pou->variables)
    declaration(v);
  if (pou->checked && !pou->decl->external)
    block(pou->decl->body);
  for (const PouSymbol *m : pou->methods)
    this->pou(m);
  if (pou->isBlock() || pou->isInterface())
    replacements(pou);
}

/// Who cannot be looked at takes the address of everything.
void Addressed::parameters(const PouSymbol *pou) {
  const bool isOpen = pou->isMethod() && !own_->isUser && !pou->isFinal() && !pou->owner->isFinal();
  const bool isAsked = pou->isMethod() && (pou->owner->isInterface() || pou->isAbstract());
  if (!isOpen && (isAsked || (pou->checked && !pou->decl->external)))
    return;
  for (const VarSymbol *p : pou->variables) {
    if (p->section == Section::InOut || p->section == Section::Output)
      expose(p);
  }
}

/// A call of a method may run the one that replaces it.
void Addressed::replacements(const PouSymbol *block) {
  for (const PouSymbol *m : block->methods) {
    for (const PouSymbol *old = m->overrides; old != nullptr; old = old->overrides)
      link(old, m);
  }
  if (!block->isBlock())
    return;
  for (const PouSymbol *interface : allInterfaces(block)) {
    for (const PouSymbol *demanded : demandedMethods(interface)) {
      if (const PouSymbol *m = implementation(block, demanded))
        link(demanded, m);
    }
  }
}

void Addressed::link(const PouSymbol *method, const PouSymbol *replacement) {
  const std::vector<VarSymbol *> from = method->parameters();
  const std::vector<VarSymbol *> to = replacement->parameters();
  for (size_t i = 0; i < std::min(from.size(), to.size()); ++i)
    bound_[to[i]].push_back(from[i]);
}

void Addressed::declaration(const VarSymbol *variable) {
  if (variable->decl == nullptr || variable->type == nullptr)
    return;
  if (variable->decl->init != nullptr)
    initial(variable, variable->decl->init);
  forEachConstruction(variable->decl,
                      [this](std::span<const Argument> list) { constructing(list); });
}

void Addressed::initial(const VarSymbol *variable, Expr *init) {
  if (init->kind != ExprKind::Aggregate) {
    if (variable->type->kind == TypeKind::Reference)
      expose(init);
    expression(init);
    return;
  }
  for (const AggregateItem &item : as<AggregateExpr>(init)->items) {
    const VarSymbol *to = item.symbol != nullptr ? item.symbol : variable;
    if (item.value != nullptr)
      initial(to, item.value);
    for (const AggregateItem &inner : item.values) {
      if (inner.value != nullptr)
        initial(to, inner.value);
    }
  }
}

void Addressed::block(Block block) {
  walkStatements(block, [this](const Stmt *s) {
    if (s->kind == StmtKind::Assign && as<AssignStmt>(s)->op == AssignOp::Reference)
      expose(as<AssignStmt>(s)->value);
    forEachChild(
        s, [this](Expr *e) { expression(e); }, [](Block) {});
  });
}

void Addressed::expression(Expr *expr) {
  walk(expr, [this](const Expr *e) {
    // An instance where an interface or a reference is wanted gives its address.
    if (e->target != nullptr && e->target != e->type &&
        (e->target->kind == TypeKind::Interface || e->target->kind == TypeKind::Reference))
      expose(e);
    if (e->kind == ExprKind::Call)
      call(as<CallExpr>(e));
    if (e->kind == ExprKind::Aggregate) {
      for (const AggregateItem &item : as<AggregateExpr>(e)->items)
        if (item.symbol != nullptr && item.value != nullptr &&
            item.symbol->type->kind == TypeKind::Reference)
          expose(item.value);
    }
  });
}

/// The result of a built-in function may be the address of its first argument.
static bool keepsAddress(BuiltinTakes takes) {
  return takes == BuiltinTakes::Address || takes == BuiltinTakes::Query;
}

void Addressed::call(const CallExpr *e) {
  if (e->resolved == Callee::Builtin && keepsAddress(builtinRow(e->builtin).takes.what) &&
      !e->arguments.empty() && e->arguments[0].value != nullptr)
    expose(e->arguments[0].value);
  arguments(e->arguments);
}

/// What is passed by its address.
void Addressed::arguments(std::span<const Argument> arguments) {
  for (const Argument &a : arguments) {
    if (a.value == nullptr || a.output || a.parameter == nullptr || a.parameter->type == nullptr)
      continue;
    if (a.parameter->section == Section::InOut)
      bind(a.value, a.parameter);
    else if (a.parameter->type->kind == TypeKind::Reference)
      expose(a.value);
  }
}

/// Those of FB_Init, which stand in no call.
void Addressed::constructing(std::span<const Argument> list) {
  for (const Argument &a : list)
    if (a.value != nullptr)
      expression(a.value);
  arguments(list);
}

void Addressed::expose(const Expr *place) {
  if (const VarSymbol *variable = holder(place))
    expose(variable);
}

void Addressed::bind(const Expr *place, const VarSymbol *parameter) {
  if (const VarSymbol *variable = holder(place))
    bound_[parameter].push_back(variable);
}

const VarSymbol *Addressed::holder(const Expr *place) {
  while (place != nullptr) {
    const Symbol *symbol = nullptr;
    switch (place->kind) {
    case ExprKind::Name:
      symbol = as<NameExpr>(place)->symbol;
      break;
    case ExprKind::Member:
      symbol = as<MemberExpr>(place)->symbol;
      break;
    case ExprKind::Index:
      if (followsAddress(as<IndexExpr>(place)))
        return nullptr;
      place = as<IndexExpr>(place)->base;
      continue;
    default:
      return nullptr;
    }
    const auto *variable = symbol != nullptr && symbol->kind == SymbolKind::Variable
                               ? static_cast<const VarSymbol *>(symbol)
                               : nullptr;
    if (variable != nullptr && variable->type->kind == TypeKind::Reference)
      return nullptr; // where it leads was exposed when it was set
    if (place->kind == ExprKind::Name || isNamespace(as<MemberExpr>(place)->base) ||
        (variable != nullptr && variable->section == Section::InOut))
      return variable;
    place = as<MemberExpr>(place)->base;
  }
  return nullptr;
}

} // namespace stc::codegen
