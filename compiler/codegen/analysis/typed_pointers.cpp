#include "compiler/codegen/analysis/typed_pointers.hpp"

#include "compiler/codegen/analysis/addressed.hpp"
#include "compiler/codegen/analysis/analysis.hpp"
#include "compiler/codegen/cpp/layout.hpp"
#include "compiler/semantics/held.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

bool isPointer(const Type *type) { return type != nullptr && type->kind == TypeKind::Pointer; }

const Type *pointee(const Type *pointer) { return typeAs<PointerType>(pointer)->pointee; }

bool holdsPointer(const Type *type) {
  return anyHeld(type, [](const Type *t, const VarSymbol *) {
    return isPointer(t) ? Held::Found : Held::Inside;
  });
}

bool isNull(const Expr *e) {
  return e->constant != nullptr && e->constant->kind == ConstKind::Integer &&
         e->constant->integer == 0;
}

const Type *given(const Expr *e) { return e->target != nullptr ? e->target : e->type; }

/// An address of the first type is one of the second, too: a derived instance begins with its base,
/// an array with its first element.
bool isAlso(const Type *from, const Type *to) {
  if (isInstance(from) && isInstance(to))
    return derivesFrom(typeAs<PouType>(from)->symbol, typeAs<PouType>(to)->symbol);
  while (from != to && from->kind == TypeKind::Array)
    from = typeAs<ArrayType>(from)->element;
  return from == to;
}

/// A value of the first type becomes one of the second, whose pointers then lead elsewhere.
bool changesPointers(const Type *from, const Type *to) {
  if (from == to || from == nullptr || to == nullptr)
    return false;
  if (isInstance(from) && isInstance(to))
    return false; // the one is the base of the other
  const Type *whole = to->kind == TypeKind::OpenArray ? typeAs<OpenArrayType>(to)->element : to;
  return holdsPointer(from) || holdsPointer(whole);
}

/// It ends with a call.
bool isOfCall(const VarSymbol *v) {
  if (v->section == Section::Temp)
    return true;
  const bool isKept = v->section == Section::Stat || v->section == Section::Instance;
  return v->owner != nullptr && (v->owner->isFunction() || v->owner->isMethod()) && !isKept;
}

/// The place may end before a pointer to it does, or lies where nobody knows: it is of a call, or
/// behind an in-out or a reference.
bool isPassing(const Expr *place) {
  while (true) {
    const Symbol *symbol = symbolAt(place);
    const auto *v = symbol != nullptr && symbol->kind == SymbolKind::Variable
                        ? static_cast<const VarSymbol *>(symbol)
                        : nullptr;
    if (v != nullptr && isIndirect(v))
      return true;
    switch (place->kind) {
    case ExprKind::Name:
      return v != nullptr && isOfCall(v);
    case ExprKind::Member:
      if (isNamespace(as<MemberExpr>(place)->base))
        return false;
      place = as<MemberExpr>(place)->base;
      continue;
    case ExprKind::Index:
      if (followsAddress(as<IndexExpr>(place)))
        return true;
      place = as<IndexExpr>(place)->base;
      continue;
    case ExprKind::Deref:
      return false; // it lives as long as what that pointer leads to
    default:
      return true;
    }
  }
}

bool isUnion(const Type *type) {
  return type != nullptr && type->kind == TypeKind::Structure && typeAs<StructType>(type)->isUnion;
}

} // namespace

// Nobody knows what calls a library that is compiled by itself. A check of the project's own gives
// each pointer anew.
void TypedPointers::find() {
  known_ = true;
  const auto isOpen = [](const AccessPath &path) {
    return path.type != nullptr && holdsPointer(path.type);
  };
  if ((!own_->isUser && !own_->isBuilt) ||
      program_.implicitChecks[static_cast<size_t>(ImplicitCheck::Pointer)] != nullptr ||
      std::any_of(program_.accessPaths.begin(), program_.accessPaths.end(), isOpen))
    giveUp();
  for (const auto &one : program_.libraries)
    if (typed_)
      library(*one);
  for (const SlotPlace &slot : program_.slotPlaces) // VAR_CONFIG
    if (typed_ && slot.decl != nullptr && slot.decl->init != nullptr)
      expression(slot.decl->init);
}

void TypedPointers::library(const Library &library) {
  types(library);
  for (const PouSymbol *p : library.pous) {
    if (!typed_)
      return;
    pou(p, library.isUser || library.isBuilt);
  }
  for (const GlobalsSymbol *list : library.globals)
    for (const VarSymbol *v : list->variables)
      declaration(v);
}

/// The fields of a union are each other's bytes.
void TypedPointers::types(const Library &library) {
  for (const TypeSymbol *type : library.types) {
    if (type->init != nullptr)
      initial(type->init);
    if (isUnion(type->type) && holdsPointer(type->type))
      giveUp();
    if (type->type != nullptr && type->type->kind == TypeKind::Structure)
      for (const VarSymbol *field : typeAs<StructType>(type->type)->fields)
        declaration(field);
  }
}

/// Of Stride's libraries and of native code only the types of their pointers are known; they get no
/// address of other types that the program has not converted.
void TypedPointers::pou(const PouSymbol *pou, bool isOpen) {
  const bool isDemanded =
      pou->isInterface() || pou->isAbstract() || (pou->isMethod() && pou->owner->isInterface());
  const bool isKnown = isDemanded || (isOpen && pou->checked && !pou->decl->external);
  for (const VarSymbol *v : pou->variables) {
    declaration(v);
    if (!isKnown && v->type != nullptr)
      native(v->type);
  }
  if (pou->result != nullptr) {
    declaration(pou->result);
    if (!isKnown)
      native(pou->result->type);
  }
  if (isKnown && pou->checked && !isDemanded)
    block(pou->decl->body);
  for (const PouSymbol *m : pou->methods)
    this->pou(m, isOpen);
}

/// All that can be reached from there.
void TypedPointers::native(const Type *type) {
  std::vector<const Type *> pending{type};
  while (!pending.empty()) {
    const Type *at = pending.back();
    pending.pop_back();
    if (!seen_.insert(at).second)
      continue;
    anyHeld(at, [&](const Type *t, const VarSymbol *) {
      const bool leads = isPointer(t) || t->kind == TypeKind::Reference;
      if (isPointer(t))
        native_.insert(pointee(t));
      if (leads)
        pending.push_back(pointee(t));
      return leads ? Held::Over : Held::Inside;
    });
  }
}

/// What lies in the process image is written from elsewhere, what is of type ANY by its address; a
/// block that ends with a call may have given its own address away.
void TypedPointers::declaration(const VarSymbol *v) {
  if (v->type == nullptr)
    return;
  const bool isPlaced =
      v->location != nullptr || (v->decl != nullptr && v->decl->address != nullptr);
  if (v->any != AnyGroup::None || (isPlaced && holdsPointer(v->type)) ||
      (isOfCall(v) && !isIndirect(v) && Addressed::holdsBlock(v->type)))
    giveUp();
  if (v->decl == nullptr)
    return;
  if (v->decl->init != nullptr)
    initial(v->decl->init);
  forEachConstruction(v->decl, [this](std::span<const Argument> list) { constructing(list); });
}

void TypedPointers::initial(Expr *init) {
  if (typed_)
    expression(init);
}

/// The arguments of FB_Init, which stand in no call.
void TypedPointers::constructing(std::span<const Argument> list) {
  for (const Argument &a : list)
    if (a.value != nullptr)
      expression(a.value);
  arguments(list);
}

void TypedPointers::block(Block block) {
  if (!typed_)
    return;
  walkStatements(block, [this](const Stmt *s) {
    if (s->kind == StmtKind::Assign)
      assignment(as<AssignStmt>(s));
    forEachChild(
        s, [this](Expr *e) { expression(e); }, [](Block) {});
  });
}

void TypedPointers::assignment(const AssignStmt *s) {
  if (isNull(s->value))
    return;
  for (const Expr *target : s->targets)
    if (changesPointers(given(s->value), target->type))
      giveUp();
}

void TypedPointers::expression(Expr *expr) {
  walk(expr, [this](const Expr *e) { node(e); });
}

void TypedPointers::node(const Expr *e) {
  conversion(e);
  if (e->kind == ExprKind::Binary)
    binary(as<BinaryExpr>(e));
  else if (e->kind == ExprKind::Index)
    index(as<IndexExpr>(e));
  else if (e->kind == ExprKind::Call)
    call(as<CallExpr>(e));
}

void TypedPointers::conversion(const Expr *e) {
  if (e->target == nullptr || e->type == nullptr || e->target == e->type || isNull(e) ||
      compared_.contains(e))
    return;
  if (isPointer(e->target) && isPointer(e->type) && isAlso(pointee(e->type), pointee(e->target)))
    return;
  if (changesPointers(e->type, e->target))
    giveUp();
}

void TypedPointers::binary(const BinaryExpr *e) {
  if (!isPointer(e->left->type) && !isPointer(e->right->type))
    return;
  if (!isComparison(e->op))
    return giveUp();
  compared_.insert(e->left);
  compared_.insert(e->right);
}

/// `p[1]` is a variable only where an array lies.
void TypedPointers::index(const IndexExpr *e) {
  const Type *t = e->base->type;
  for (size_t i = 0; i < e->indices.size() && t != nullptr; ++i) {
    if (isPointer(t) || (t->kind == TypeKind::Reference && isPointer(pointee(t))))
      giveUp();
    t = indexStep(t);
  }
}

void TypedPointers::call(const CallExpr *e) {
  if (e->resolved == Callee::Builtin)
    builtin(e);
  else
    arguments(e->arguments);
}

/// ADR and __NEW give addresses of their types; SEL and MUX one of those that they get. __DELETE
/// leaves pointers that lead to the next object there.
void TypedPointers::builtin(const CallExpr *e) {
  const BuiltinRow &row = builtinRow(e->builtin);
  if (row.takes.what == BuiltinTakes::TypeOf)
    return;
  if (row.takes.what == BuiltinTakes::Address) {
    if (e->arguments.empty() || e->arguments[0].value == nullptr ||
        isPassing(e->arguments[0].value))
      giveUp();
    return;
  }
  const bool isNew = row.takes.what == BuiltinTakes::Name;
  const bool selects = (row.does & BuiltinRow::kSelects) != 0;
  if (isPointer(e->type) && !isNew && !selects)
    giveUp();
  for (const Argument &a : e->arguments)
    if (a.value != nullptr && isPointer(a.value->type) && (!selects || given(a.value) != e->type))
      giveUp();
}

/// What in-outs stand for, and what outputs go to.
void TypedPointers::arguments(std::span<const Argument> arguments) {
  for (const Argument &a : arguments) {
    if (a.value == nullptr || a.parameter == nullptr || a.parameter->type == nullptr)
      continue;
    if (a.parameter->any != AnyGroup::None)
      giveUp();
    const bool isReference = a.parameter->type->kind == TypeKind::Reference;
    const Type *to = isReference ? pointee(a.parameter->type) : a.parameter->type;
    if (!isNull(a.value) &&
        changesPointers(a.output || isIndirect(a.parameter) ? a.value->type : given(a.value), to))
      giveUp();
  }
}

} // namespace stc::codegen
