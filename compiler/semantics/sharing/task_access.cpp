#include "compiler/semantics/sharing/task_access_names.hpp"

#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>
#include <utility>

namespace stc::access {

using namespace ast;

static void statement(Reader &r, const Stmt *s);
static void flowPlace(Reader &r, const VarSymbol *target, const Expr *place);

namespace {

/// The expression that names the global variable in which a place lies: `GVL.list` of
/// `GVL.list[3].x`. Null if an address leads there, or it is none.
const Expr *namedGlobal(const Expr *e) {
  while (e->kind == ExprKind::Index ||
         (e->kind == ExprKind::Member && !isNamespaceName(as<MemberExpr>(e)->base))) {
    e = e->kind == ExprKind::Index ? as<IndexExpr>(e)->base : as<MemberExpr>(e)->base;
    if (e->type == nullptr || isAddress(e->type))
      return nullptr;
  }
  const Symbol *symbol = symbolOf(e);
  return symbol != nullptr && symbol->kind == SymbolKind::Variable &&
                 static_cast<const VarSymbol *>(symbol)->globals != nullptr
             ? e
             : nullptr;
}

} // namespace

void initialValue(Reader &r, const VarSymbol *variable, const Expr *init) {
  if (init->kind == ExprKind::Aggregate) {
    for (const AggregateItem &item : as<AggregateExpr>(init)->items) {
      const VarSymbol *to = item.symbol != nullptr ? item.symbol : variable;
      if (to->type == nullptr)
        continue;
      if (item.value != nullptr)
        initialValue(r, to, item.value);
      for (const AggregateItem &inner : item.values) {
        if (inner.value != nullptr)
          initialValue(r, to, inner.value);
      }
    }
    return;
  }
  if (variable->type->kind == TypeKind::Reference)
    flowPlace(r, variable, init);
  else
    flow(r, variable, init);
}

/// What the declaration of an instance gives to its FB_Init.
static void construction(Reader &r, const TypeExpr *type) {
  while (type != nullptr && type->kind == TypeExprKind::Array)
    type = as<ArrayTypeExpr>(type)->element;
  if (type == nullptr || type->kind != TypeExprKind::Named)
    return;
  const auto give = [&](std::span<const Argument> arguments) {
    for (const Argument &a : arguments)
      if (a.parameter != nullptr && a.parameter->type != nullptr && a.value != nullptr)
        initialValue(r, a.parameter, a.value);
  };
  const auto *named = as<NamedTypeExpr>(type);
  give(named->arguments);
  for (const std::span<Argument> element : named->elements)
    give(element);
}

/// The FB_Init of the base gets what the one of the block gets, by name.
static void constructionOfBase(Reader &r, const VarSymbol *input) {
  const PouSymbol *init = input->owner;
  if (init == nullptr || init->owner == nullptr || init->owner->base == nullptr ||
      input->section != Section::Input || init->name.id->lower != "fb_init")
    return;
  const PouSymbol *base = findInit(init->owner->base);
  if (base == nullptr)
    return;
  for (const VarSymbol *own : base->variables)
    if (own->section == Section::Input && own->name.id == input->name.id)
      r.out.flows.push_back({own, {}, input});
}

static void block(Reader &r, Block block) {
  for (const Stmt *s : block)
    statement(r, s);
}

static void assignment(Reader &r, const AssignStmt *a) {
  if (a->op == AssignOp::Reference) {
    if (const VarSymbol *v = addressVariable(a->targets.back()))
      flowPlace(r, v, a->value);
    place(r, a->value, true);
    return;
  }
  value(r, a->value);
  for (const Expr *t : a->targets) {
    target(r, t);
    if (!isAddress(t->type))
      escape(r, a->value);
    else if (const VarSymbol *v = addressVariable(t))
      flow(r, v, a->value);
  }
}

static void statement(Reader &r, const Stmt *s) {
  switch (s->kind) {
  case StmtKind::Assign:
    return assignment(r, as<AssignStmt>(s));
  case StmtKind::For: {
    const auto *f = as<ForStmt>(s);
    for (const Expr *bound : {f->from, f->to, f->by})
      value(r, bound);
    access(r, f->variable, kAccessRead | kAccessWrite, kAccessWholeRead | kAccessWholeWrite);
    return block(r, f->body);
  }
  case StmtKind::Try: // what it names takes the exception
    return forEachChild(
        s, [&r](Expr *e) { target(r, e); }, [&r](Block inner) { block(r, inner); });
  default: // expressions are read
    return forEachChild(
        s, [&r](Expr *e) { value(r, e); }, [&r](Block inner) { block(r, inner); });
  }
}

void value(Reader &r, const Expr *e) {
  while (e != nullptr && e->constant == nullptr) {
    switch (e->kind) {
    case ExprKind::Literal:
    case ExprKind::EnumLiteral:
    case ExprKind::TypeName:
    case ExprKind::Error:
      return;
    case ExprKind::Aggregate:
      for (const AggregateItem &item : as<AggregateExpr>(e)->items) {
        value(r, item.value);
        for (const AggregateItem &inner : item.values)
          value(r, inner.value);
      }
      return;
    case ExprKind::Unary:
      e = as<UnaryExpr>(e)->operand;
      continue;
    case ExprKind::Binary:
      value(r, as<BinaryExpr>(e)->left);
      e = as<BinaryExpr>(e)->right;
      continue;
    case ExprKind::Call:
      call(r, as<CallExpr>(e));
      return;
    default:
      // An instance becomes an interface: its address is taken, nothing is read.
      if (isInstance(e->type) && e->target != nullptr && e->target->kind == TypeKind::Interface)
        place(r, e, true);
      else
        access(r, e, kAccessRead, kAccessWholeRead);
      return;
    }
  }
}

void target(Reader &r, const Expr *e) { access(r, e, kAccessWrite, kAccessWholeWrite); }

void access(Reader &r, const Expr *e, unsigned scalar, unsigned whole) {
  const bool writes = (scalar & kAccessWrite) != 0;
  if (e->kind == ExprKind::Call) {
    call(r, as<CallExpr>(e));
    return;
  }
  if (const Symbol *symbol = symbolOf(e);
      symbol != nullptr && symbol->kind == SymbolKind::Property) {
    const Expr *object = e->kind == ExprKind::Member ? as<MemberExpr>(e)->base : nullptr;
    if (object != nullptr)
      place(r, object, true);
    accessor(r, object, symbol, writes, e->span);
    return;
  }
  const Expr *owner = e;
  while (owner->kind == ExprKind::Member && as<MemberExpr>(owner)->bit >= 0) {
    owner = as<MemberExpr>(owner)->base;
    if (writes)
      scalar |= kAccessRead; // the other bits stay
  }
  image(r, owner, writes);
  const bool scalarValue = isScalarValue(owner->type);
  note(r, place(r, owner, true), scalarValue ? scalar : whole, e->span,
       writes ? nullptr : namedGlobal(owner));
}

void note(Reader &r, PlacePath place, unsigned flags, Span span, const Expr *named) {
  constexpr unsigned kWrites = kAccessWrite | kAccessWholeWrite | kAccessUnknown | kAccessCall;
  const bool asked = r.detail == AccessDetail::Places
                         ? place.base != PlacePath::Base::None
                         : place.base == PlacePath::Base::Root && (flags & kWrites) != 0;
  if (asked)
    r.out.accesses.push_back({std::move(place), flags, span, named});
}

/// A place in the process image, also an element or member of a located variable.
void image(Reader &r, const Expr *e, bool writes) {
  while (true) {
    if (const Location *at = locationOf(e)) {
      ImageAccess access{at, at->isSlot ? locatedVariable(e) : nullptr, 1, writes, e->span};
      if (at->bit < 0)
        access.bytes = r.storage.of(e->type).size;
      const Type *type = underlying(e->type);
      access.isNumber = isReal(type) || isSignedInteger(type);
      r.out.image.push_back(access);
      return;
    }
    if (e->kind == ExprKind::Index)
      e = as<IndexExpr>(e)->base;
    else if (e->kind == ExprKind::Member && !isNamespaceName(as<MemberExpr>(e)->base))
      e = as<MemberExpr>(e)->base;
    else
      return;
  }
}

static PlacePath placeOf(const VarSymbol *v) {
  using Base = PlacePath::Base;
  if (v->isConstant && v->section != Section::InOut)
    return {};
  if (isAlias(v))
    return {Base::Address, v, {}};
  if (v->location != nullptr)
    return {};
  if (v->globals != nullptr || v->section == Section::Stat)
    return {Base::Root, v, {}};
  if (v->section == Section::Temp || v->owner == nullptr || v->isResult)
    return {};
  const bool onStack =
      v->owner->isFunction() || (v->owner->isMethod() && v->section != Section::Instance);
  return onStack ? PlacePath{} : PlacePath{Base::Self, v, {}};
}

static PlacePath namedPlace(Reader &r, const NameExpr *e, bool walk) {
  const Symbol *symbol = e->symbol;
  if (symbol == nullptr)
    return {};
  if (symbol->kind == SymbolKind::Pou)
    return {PlacePath::Base::Root, symbol, {}};
  if (symbol->kind == SymbolKind::Property && walk)
    accessor(r, nullptr, symbol, false, e->span);
  if (symbol->kind != SymbolKind::Variable)
    return {};
  return placeOf(static_cast<const VarSymbol *>(symbol));
}

static PlacePath memberPlace(Reader &r, const MemberExpr *m, bool walk) {
  if (m->symbol == nullptr)
    return m->bit >= 0 ? place(r, m->base, walk) : PlacePath{};
  if (isNamespaceName(m->base)) {
    if (m->symbol->kind == SymbolKind::Pou)
      return {PlacePath::Base::Root, m->symbol, {}};
    return m->symbol->kind == SymbolKind::Variable
               ? placeOf(static_cast<const VarSymbol *>(m->symbol))
               : PlacePath{};
  }
  PlacePath base = place(r, m->base, walk);
  if (m->symbol->kind == SymbolKind::Property && walk)
    accessor(r, m->base, m->symbol, false, m->span);
  if (m->symbol->kind != SymbolKind::Variable)
    return {};
  const auto *v = static_cast<const VarSymbol *>(m->symbol);
  if (isAlias(v))
    return {PlacePath::Base::Address, v, {}};
  if (v->section == Section::Stat)
    return {PlacePath::Base::Root, v, {}};
  if (v->location != nullptr || v->isConstant || base.base == PlacePath::Base::None)
    return {};
  if (base.base == PlacePath::Base::Self && base.symbol == nullptr) // THIS^.v
    return {PlacePath::Base::Self, v, {}};
  if (!isUnionType(m->base->type)) // its members share their bytes
    enter(r, base, {v, 0});
  return base;
}

static PlacePath elementPlace(Reader &r, const IndexExpr *x, bool walk) {
  PlacePath at = place(r, x->base, walk);
  const Type *t = x->base->type;
  for (const Expr *i : x->indices) {
    if (walk)
      value(r, i);
    if (t != nullptr && t->kind == TypeKind::Reference) {
      at = behind(addressVariable(x->base));
      t = typeAs<PointerType>(t)->pointee;
    }
    if (t != nullptr && t->kind == TypeKind::Pointer) {
      if (walk)
        note(r, at, kAccessRead, x->span);
      at = behind(addressVariable(x->base));
    } else if (at.base != PlacePath::Base::None) {
      enter(r, at, {nullptr, i->constant != nullptr ? i->constant->integer : kAnyElement});
    }
    t = t == nullptr ? nullptr : indexStep(t);
  }
  if (elementBeforeReference(x) != nullptr &&
      elementBeforeReference(x)->kind == TypeKind::Reference)
    return behind(addressVariable(x->base));
  return at;
}

static PlacePath followedPlace(Reader &r, const Expr *pointer, bool walk) {
  if (const Symbol *symbol = symbolOf(pointer);
      symbol != nullptr && symbol->kind == SymbolKind::Self)
    return {PlacePath::Base::Self, nullptr, {}};
  if (walk)
    value(r, pointer);
  if (pointer->kind != ExprKind::Call)
    return behind(addressVariable(pointer));
  if (const Expr *at = addressed(pointer))
    return place(r, at, false);
  const auto *c = as<CallExpr>(pointer);
  return c->pou != nullptr ? behind(c->pou->result) : PlacePath{};
}

PlacePath place(Reader &r, const Expr *e, bool walk) {
  switch (e->kind) {
  case ExprKind::Name:
    return namedPlace(r, as<NameExpr>(e), walk);
  case ExprKind::Member:
    return memberPlace(r, as<MemberExpr>(e), walk);
  case ExprKind::Index:
    return elementPlace(r, as<IndexExpr>(e), walk);
  case ExprKind::Deref:
    return followedPlace(r, as<DerefExpr>(e)->base, walk);
  case ExprKind::Call: {
    const auto *c = as<CallExpr>(e);
    if (walk)
      call(r, c);
    return c->pou != nullptr && c->pou->result != nullptr &&
                   c->pou->result->type->kind == TypeKind::Reference
               ? behind(c->pou->result)
               : PlacePath{};
  }
  default:
    return {};
  }
}

// ----------------------------------------------------------------------------------------------------
// addresses

static void flowPlace(Reader &r, const VarSymbol *to, const Expr *e) {
  PlacePath at = place(r, e, false);
  if (at.base != PlacePath::Base::None)
    r.out.flows.push_back({to, std::move(at), nullptr});
}

/// Every address inside of the value may be the one that `to` gets.
void flow(Reader &r, const VarSymbol *to, const Expr *e) {
  if (e == nullptr || e->constant != nullptr || to == nullptr)
    return;
  switch (e->kind) {
  case ExprKind::Unary:
    flow(r, to, as<UnaryExpr>(e)->operand);
    return;
  case ExprKind::Binary:
    flow(r, to, as<BinaryExpr>(e)->left);
    flow(r, to, as<BinaryExpr>(e)->right);
    return;
  case ExprKind::Call: {
    const auto *c = as<CallExpr>(e);
    if (c->resolved != Callee::Builtin) {
      if (c->pou != nullptr && c->pou->result != nullptr)
        r.out.flows.push_back({to, {}, c->pou->result});
      return;
    }
    if (const Expr *at = addressed(c)) {
      flowPlace(r, to, at);
      return;
    }
    if (builtinRow(c->builtin).takes.what == BuiltinTakes::Name && // __NEW
        c->type->kind == TypeKind::Pointer) {
      r.out.flows.push_back({to, {PlacePath::Base::Made, nullptr, {}, c}, nullptr});
      return;
    }
    for (const Argument &a : c->arguments)
      flow(r, to, a.value);
    return;
  }
  default:
    if (e->type == nullptr)
      return;
    if (isInstance(e->type))
      flowPlace(r, to, e);
    else if (const VarSymbol *v = addressVariable(e); v != nullptr && isAddress(e->type))
      r.out.flows.push_back({to, {}, v});
    return;
  }
}

/// An address goes where nobody can follow it (native code, a DWORD): anything may happen there.
void escape(Reader &r, const Expr *e) {
  if (e->constant != nullptr || e->kind == ExprKind::Name || e->kind == ExprKind::Member)
    return;
  const size_t before = r.out.flows.size();
  static const VarSymbol nowhere{};
  flow(r, &nowhere, e);
  std::vector<AddressFlow> taken(
      std::make_move_iterator(r.out.flows.begin() + static_cast<ptrdiff_t>(before)),
      std::make_move_iterator(r.out.flows.end()));
  r.out.flows.resize(before);
  for (AddressFlow &f : taken)
    note(r, std::move(f.place), kAccessUnknown | kAccessRead | kAccessWrite, e->span);
}

} // namespace stc::access

namespace stc {

PouAccess readAccess(Storage &storage, const PouSymbol *pou, AccessDetail detail) {
  access::Reader reader{storage, {}, detail};
  access::block(reader, pou->decl->body);
  return std::move(reader.out);
}

PouAccess readInitial(Storage &storage, const std::vector<const VarSymbol *> &variables) {
  access::Reader reader{storage, {}};
  for (const VarSymbol *v : variables) {
    if (v->decl == nullptr || v->type == nullptr)
      continue;
    const size_t first = reader.out.flows.size();
    if (v->decl->init != nullptr)
      access::initialValue(reader, v, v->decl->init);
    access::construction(reader, v->decl->type);
    for (AddressFlow &flow : std::span(reader.out.flows).subspan(first))
      flow.declared = v->owner != nullptr ? static_cast<const Symbol *>(blockOf(v->owner)) : v;
    access::constructionOfBase(reader, v);
  }
  return {
      {}, std::move(reader.out.flows), {}, {}, std::move(reader.out.axes)}; // only addresses count
}

} // namespace stc
