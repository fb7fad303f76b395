// Values and places: names, members, elements, pointers.

#include "compiler/codegen/consistent_copies.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>
#include <cmath>

namespace stc::codegen {

using namespace ast;

namespace {

const Symbol *symbolOf(const Expr *e) {
  switch (e->kind) {
  case ExprKind::name:
    return as<NameExpr>(e)->symbol;
  case ExprKind::member:
    return as<MemberExpr>(e)->symbol;
  case ExprKind::enumLiteral:
    return as<EnumLiteralExpr>(e)->symbol;
  default:
    return nullptr;
  }
}

} // namespace

void Emitter::value(const Expr *e) { valueAs(e, e->target != nullptr ? e->target : e->type); }

void Emitter::valueAs(const Expr *e, const Type *type) {
  if (e->constant != nullptr) {
    literal(*e->constant, e->type, type, symbolOf(e));
  } else if (isInstance(e->type) && type->kind == TypeKind::interface) {
    w_ << '&';
    typeIdOf(e);
  } else if ((isInstance(e->type) && isInstance(type)) ||
             (e->type == type && holdsInOut(type) && type->kind != TypeKind::openArray)) {
    copyOf(e, type);
  } else if (isString(type) ? e->type == type : implicitStore(e->type, type)) {
    raw(e);
  } else {
    convertedExpr(e, e->type, type);
  }
}

void Emitter::raw(const Expr *e) {
  e = shown(e);
  if (e->constant != nullptr) {
    literal(*e->constant, e->type, e->type, symbolOf(e));
    return;
  }
  if (isBitPlace(e) && !isBitField(e)) {
    bitValue(e);
    return;
  }
  switch (e->kind) {
  case ExprKind::unary:
    unary(as<UnaryExpr>(e));
    break;
  case ExprKind::binary:
    binary(as<BinaryExpr>(e));
    break;
  case ExprKind::call: {
    const auto *call = as<CallExpr>(e);
    if (call->resolved == Callee::builtin) {
      builtin(call);
    } else {
      const std::size_t start = w_.size();
      functionCall(call, false);
      if (call->pou->result != nullptr && call->pou->result->type->kind == TypeKind::reference)
        followReference(start, call->type, e->span);
    }
    break;
  }
  default: {
    const bool byOthers = e->type->kind == TypeKind::boolean && locationOf(e) != nullptr;
    const bool shared = isShared(e);
    w_ << (byOthers ? "::stride::truth(" : "") << (shared ? "::stride::load(" : "");
    place(e);
    w_ << (shared ? ")" : "") << (byOthers ? ")" : "");
    break;
  }
  }
}

void Emitter::operand(const Expr *e, const Type *type, const Expr *other, bool comparison) {
  if (type->kind == TypeKind::interface)
    valueAs(e, type);
  else if (e->constant != nullptr)
    literal(*e->constant, e->type, type, symbolOf(e));
  else if (implicitOperand(e, type, other, comparison))
    raw(e);
  else
    convertedExpr(e, e->type, type);
}

void Emitter::text(const Expr *e) {
  if (e->constant == nullptr) {
    raw(e);
    return;
  }
  w_ << "::stride::lit(";
  quoted(*e->constant, e->type->kind == TypeKind::wstring);
  w_ << ')';
}

// ---------------------------------------------------------------------------------------------------------
// places

const VarSymbol *Emitter::indirectVariable(const Expr *e) {
  const Symbol *symbol = isBitPlace(e) ? nullptr : symbolOf(e);
  if (symbol == nullptr || symbol->kind != SymbolKind::variable)
    return nullptr;
  const auto *v = static_cast<const VarSymbol *>(symbol);
  return isIndirect(v) ? v : nullptr;
}

std::string Emitter::placeText(const Expr *e) {
  const std::size_t start = w_.size();
  place(e);
  return w_.cut(start);
}

std::string Emitter::writableText(const Expr *e) {
  const std::string text = placeText(e);
  return isShared(e) ? "::stride::shared(" + text + ")" : text;
}

void Emitter::place(const Expr *e) {
  if (const auto found = found_.find(e); found != found_.end()) {
    w_ << found->second;
    return;
  }
  if (c_.program.sharing.copies.contains(e)) {
    const Symbol *v =
        e->kind == ExprKind::name ? as<NameExpr>(e)->symbol : as<MemberExpr>(e)->symbol;
    const auto *variable = static_cast<const VarSymbol *>(v);
    includes_.symbol(variable->globals);
    w_ << "::stride::seen<" << type(variable->type) << ">(" << ctx() << ", "
       << copiesPlace(c_.names, variable) << ')';
    return;
  }
  switch (e->kind) {
  case ExprKind::name: {
    const Symbol *symbol = as<NameExpr>(e)->symbol;
    if (symbol->kind == SymbolKind::pou) {
      includes_.symbol(symbol);
      w_ << root({symbol, false});
      return;
    }
    if (symbol->kind == SymbolKind::property) {
      propertyGet(nullptr, static_cast<const PropertySymbol *>(symbol), e->span);
      return;
    }
    if (symbol->kind == SymbolKind::self) {
      self(static_cast<const SelfSymbol *>(symbol));
      return;
    }
    // An in-out is declared with the name of its type only.
    if (e->type->kind == TypeKind::array || e->type->kind == TypeKind::structure)
      includes_.complete(e->type);
    variable(static_cast<const VarSymbol *>(symbol), e->span);
    return;
  }
  case ExprKind::member:
    member(as<MemberExpr>(e), false);
    return;
  case ExprKind::index:
    index(as<IndexExpr>(e), false);
    return;
  case ExprKind::direct:
    located(*as<DirectExpr>(e)->location, e->type, [] {});
    return;
  case ExprKind::deref: {
    const Expr *pointer = as<DerefExpr>(e)->base;
    includes_.complete(e->type);
    if (pointer->kind == ExprKind::name &&
        as<NameExpr>(pointer)->symbol->kind == SymbolKind::self) { // never null
      w_ << (static_cast<const SelfSymbol *>(as<NameExpr>(pointer)->symbol)->isSuper
                 ? "this->base__"
                 : "(*this)");
      return;
    }
    if (!checks()) {
      w_ << "(*";
      value(pointer);
      w_ << ')';
      return;
    }
    w_ << "::stride::deref(" << ctx() << ", ";
    checkedPointer(pointer);
    w_ << ", ";
    position(e->span);
    w_ << ')';
    return;
  }
  default: { // a value that is looked into: `f().x`
    const std::size_t start = w_.size();
    raw(e);
    if (e->kind == ExprKind::call)
      placeValue(start, e->type, as<CallExpr>(e)->pou);
    return;
  }
  }
}

/// The value that has been written since `start`, which `from` returns, as a place: methods of it
/// may take its address.
void Emitter::placeValue(std::size_t start, const Type *type, const PouSymbol *from) {
  if (from == nullptr || from->result == nullptr ||
      from->result->type->kind == TypeKind::reference || !Addressed::holdsBlock(type))
    return;
  includes_.complete(type);
  const std::string value = w_.cut(start);
  w_ << "::stride::OnDataStack<" << this->type(type) << ">(" << ctx() << ", " << value
     << ").value()";
}

void Emitter::slot(const Expr *e) {
  if (e->kind == ExprKind::index) {
    index(as<IndexExpr>(e), true);
    return;
  }
  if (e->kind == ExprKind::member && !isNamespace(as<MemberExpr>(e)->base)) {
    member(as<MemberExpr>(e), true);
    return;
  }
  const VarSymbol *v = indirectVariable(e);
  if (v->globals != nullptr) {
    w_ << root({v->globals, false}) << '.' << mangle(v->name.text);
    return;
  }
  if (v->section == Section::stat)
    w_ << root({v->owner, true}) << '.';
  else
    used_.insert(v);
  ownField(v);
}

void Emitter::ownField(const VarSymbol *v) {
  if (v->section != Section::stat && v->owner != nullptr && pou_ != nullptr &&
      v->owner->type != nullptr && v->owner != blockOf(pou_) && v->owner->isBlock())
    w_ << pathToBase(blockOf(pou_), v->owner);
  w_ << fieldName(v);
}

void Emitter::address(const Expr *e) {
  if (e->type->kind == TypeKind::openArray) { // its first element
    place(e);
    w_ << ".data";
    return;
  }
  if (const VarSymbol *v = indirectVariable(e)) {
    // An in-out of the POU itself has become a C++ reference.
    if (v->section == Section::inOut && v->owner == pou_ && e->kind == ExprKind::name) {
      w_ << '&';
      place(e);
      return;
    }
    slot(e);
    return;
  }
  if (e->kind == ExprKind::deref) {
    value(as<DerefExpr>(e)->base);
    return;
  }
  if (e->constant != nullptr && e->target != nullptr) { // 0: nothing
    value(e);
    return;
  }
  if (e->kind == ExprKind::index &&
      elementBeforeReference(as<IndexExpr>(e))->kind == TypeKind::reference) {
    slot(e);
    return;
  }
  if (e->kind == ExprKind::call && as<CallExpr>(e)->resolved == Callee::function &&
      as<CallExpr>(e)->pou->result->type->kind == TypeKind::reference) {
    functionCall(as<CallExpr>(e), false);
    return;
  }
  w_ << '&';
  place(e);
}

void Emitter::variable(const VarSymbol *v, Span span) {
  if (std::find(loopLocals_.begin(), loopLocals_.end(), v) != loopLocals_.end()) {
    w_ << mangle(v->name.text);
    return;
  }
  if (v->location != nullptr) {
    located(*v->location, v->type, [&] { field(v); });
    return;
  }
  // A VAR_IN_OUT of the block is a C++ reference in its body only, not in methods and derived ones.
  const bool slot = v->section == Section::inOut && v->owner != nullptr &&
                    v->owner->type != nullptr && v->owner != pou_;
  const bool indirect = v->type->kind == TypeKind::reference || slot;
  if (indirect) {
    includes_.complete(slot ? v->type : typeAs<PointerType>(v->type)->pointee);
    w_ << (!checks() ? "(*" : slot ? "::stride::bound(" : "::stride::deref(");
    if (checks())
      w_ << ctx() << ", ";
  }
  field(v);
  if (indirect && checks()) {
    w_ << ", ";
    position(span);
  }
  if (indirect)
    w_ << ')';
}

/// What is stored under the variable's name.
void Emitter::field(const VarSymbol *v) {
  if (v->globals != nullptr) {
    w_ << root({v->globals, false}) << '.' << mangle(v->name.text);
  } else if (v->section == Section::stat) {
    w_ << root({v->owner, true}) << '.' << mangle(v->name.text);
  } else {
    if (v != lastUsed_) {
      used_.insert(v);
      lastUsed_ = v;
    }
    ownField(v);
  }
}

void Emitter::basePath(const Type *base, const VarSymbol *field) {
  if (isInstance(base) && field->owner != nullptr)
    w_ << pathToBase(typeAs<PouType>(base)->symbol, blockOf(field->owner));
  if (base->kind != TypeKind::structure)
    return;
  for (const auto *s = typeAs<StructType>(base); s->base != nullptr; s = s->base) {
    for (const VarSymbol *own : s->fields) {
      if (own == field)
        return;
    }
    w_ << "base__.";
  }
}

void Emitter::member(const MemberExpr *e, bool slotOnly) {
  if (e->symbol->kind == SymbolKind::property) {
    propertyGet(e->base, static_cast<const PropertySymbol *>(e->symbol), e->span);
    return;
  }
  const auto *field = static_cast<const VarSymbol *>(e->symbol);
  if (isNamespace(e->base)) {
    if (e->symbol->kind == SymbolKind::pou) {
      includes_.symbol(e->symbol);
      w_ << root({e->symbol, false});
    } else {
      variable(field, e->span);
    }
    return;
  }
  if (field->location != nullptr) {
    located(*field->location, field->type, [&] { slotOf(e); });
    return;
  }
  const bool indirect = isIndirect(field) && !slotOnly;
  if (indirect) {
    const Type *pointee =
        field->section == Section::inOut ? field->type : typeAs<PointerType>(field->type)->pointee;
    includes_.complete(pointee);
    if (checks())
      w_ << (field->section == Section::inOut ? "::stride::bound(" : "::stride::deref(") << ctx()
         << ", ";
    else if (field->type->kind != TypeKind::openArray)
      w_ << "(*";
    else
      w_ << '(';
  }
  if (field->section == Section::stat && field->owner != nullptr) {
    w_ << root({field->owner, true}) << '.';
  } else {
    slotOf(e);
    memberEnd(e, indirect);
    return;
  }
  w_ << fieldName(field);
  memberEnd(e, indirect);
}

/// The member itself, in its instance.
void Emitter::slotOf(const MemberExpr *e) {
  const auto *field = static_cast<const VarSymbol *>(e->symbol);
  includes_.complete(e->base->type);
  place(e->base);
  w_ << '.';
  basePath(e->base->type, field);
  w_ << fieldName(field);
}

void Emitter::memberEnd(const MemberExpr *e, bool indirect) {
  if (indirect && checks()) {
    w_ << ", ";
    position(e->span);
  }
  if (indirect)
    w_ << ')';
}

void Emitter::openArray(const Expr *e, const OpenArrayType *wanted) {
  if (e->type->kind == TypeKind::openArray) {
    place(e);
    return;
  }
  w_ << "::stride::open<" << type(wanted->element) << ", " << wanted->dimensions << ">(";
  includes_.complete(wanted);
  includes_.complete(e->type);
  place(e);
  w_ << ')';
}

void Emitter::followReference(std::size_t start, const Type *pointee, Span span) {
  includes_.complete(pointee);
  const std::string reference = w_.cut(start);
  if (!checks()) {
    w_ << "(*" << reference << ')';
    return;
  }
  w_ << "::stride::deref(" << ctx() << ", " << reference << ", ";
  position(span);
  w_ << ')';
}

// ----------------------------------------------------------------------------------------------------
// parentheses

/// What is written for the expression: `+x` is x, pairs of one operator cancel (NOT NOT x).
const Expr *Emitter::shown(const Expr *e) {
  const auto plain = [](const Expr *x) {
    return x->kind == ExprKind::unary && x->constant == nullptr &&
           as<UnaryExpr>(x)->operand->target == nullptr;
  };
  while (plain(e)) {
    const auto *outer = as<UnaryExpr>(e);
    if (outer->op == UnaryOp::plus) {
      e = outer->operand;
      continue;
    }
    if (!plain(outer->operand) || as<UnaryExpr>(outer->operand)->op != outer->op ||
        outer->operand->type != e->type)
      break;
    e = as<UnaryExpr>(outer->operand)->operand;
  }
  return e;
}

int Emitter::level(const Expr *e) const {
  e = shown(e);
  if (e->constant != nullptr) {
    const ConstValue &c = *e->constant;
    const bool negative = c.kind == ConstKind::integer
                              ? c.integer < 0
                              : c.kind == ConstKind::real && std::signbit(c.real);
    return negative ? kUnary : kPostfix;
  }
  if (e->kind == ExprKind::unary)
    return kUnary;
  if (e->kind == ExprKind::binary) {
    const Infix op = infix(as<BinaryExpr>(e));
    return op.op.empty() ? kPostfix : op.level;
  }
  return kPostfix;
}

} // namespace stc::codegen
