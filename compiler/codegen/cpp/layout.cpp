#include "compiler/codegen/cpp/layout.hpp"

#include "compiler/semantics/held.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>
#include <cmath>

namespace stc::codegen {

using namespace ast;

Hash &Hash::add(std::string_view text) {
  hash_.add(text).add(0xFF); // an end mark: "ab" + "c" is not "a" + "bc"
  return *this;
}

Hash &Hash::add(uint64_t value) {
  for (int i = 0; i < 8; ++i) {
    hash_.add(static_cast<unsigned char>(value & 0xFFU));
    value >>= 8U;
  }
  return *this;
}

std::vector<const VarSymbol *> initialisedFields(const StructType *type) {
  if (!type->isUnion || type->fields.empty())
    return {type->fields.begin(), type->fields.end()};
  for (const VarSymbol *v : type->fields) {
    if (v->decl->init != nullptr)
      return {v};
  }
  return {type->fields.front()};
}

int64_t subrangeDefault(const SubrangeType *type) {
  return type->low > 0 ? type->low : type->high < 0 ? type->high : 0;
}

bool isZero(const Expr *init) {
  const ConstValue *c = init->constant;
  if (c == nullptr)
    return false;
  switch (c->kind) {
  case ConstKind::Integer:
    return c->integer == 0;
  case ConstKind::Real:
    return c->real == 0 && !std::signbit(c->real);
  case ConstKind::String:
    return c->text.empty();
  }
  return false;
}

Layouts::Layouts(const Program &program, const Library *own) : own_(own) {
  for (const auto &library : program.libraries) {
    for (const TypeSymbol *t : library->types) {
      if (t->decl == nullptr || t->decl->kind != DeclKind::Alias)
        continue;
      aliases_[t->name.id].push_back(t);
      anyDefault_ = anyDefault_ || (t->init != nullptr && t->init->type != nullptr);
    }
  }
}

Written Layouts::written(const VarSymbol *variable) {
  return {variable->decl == nullptr ? nullptr : variable->decl->type, 0, variable->library};
}

const TypeSymbol *Layouts::alias(const Written &written, const Type *type) const {
  if (!anyDefault_ || written.expr == nullptr || written.expr->kind != TypeExprKind::Named)
    return nullptr;
  const auto found = aliases_.find(as<NamedTypeExpr>(written.expr)->path.back().id);
  if (found == aliases_.end())
    return nullptr;
  const TypeSymbol *best = nullptr;
  for (const TypeSymbol *t : found->second) {
    if (t->type == type && (best == nullptr || t->library == written.library))
      best = t;
  }
  return best;
}

const Expr *Layouts::aliasDefault(const Written &written, const Type *type) const {
  const TypeSymbol *symbol = alias(written, type);
  while (symbol != nullptr) {
    if (symbol->init != nullptr && symbol->init->type != nullptr)
      return symbol->init;
    symbol = alias({as<AliasDecl>(symbol->decl)->type, 0, symbol->library},
                   type); // an alias of an alias
  }
  return nullptr;
}

Written Layouts::elementOf(const Written &written, const Type *type) const {
  Written at = written;
  while (const TypeSymbol *symbol = alias(at, type))
    at = {as<AliasDecl>(symbol->decl)->type, 0, symbol->library};
  if (at.expr == nullptr || at.expr->kind != TypeExprKind::Array)
    return {};
  const auto *array = as<ArrayTypeExpr>(at.expr);
  if (at.dimension + 1 < array->ranges.size())
    return {at.expr, at.dimension + 1, at.library};
  return {array->element, 0, at.library};
}

bool Layouts::elementsHaveDefaults(const Written &written, const Type *type) const {
  Written at = written;
  while (anyDefault_ && type->kind == TypeKind::Array) {
    at = elementOf(at, type);
    type = typeAs<ArrayType>(type)->element;
    if (aliasDefault(at, type) != nullptr)
      return true;
  }
  return false;
}

const Expr *Layouts::initOf(const VarSymbol *variable) {
  if (variable->decl == nullptr)
    return nullptr;
  if (variable->decl->init != nullptr)
    return variable->decl->init;
  return variable->section == Section::InOut ? nullptr
                                             : aliasDefault(written(variable), variable->type);
}

const ast::Attribute *softMotion3Default(const VarSymbol *variable) {
  return variable->decl == nullptr
             ? nullptr
             : attributeOf(variable->decl->attributes, AttributeId::SoftMotion3);
}

bool Layouts::needsInit(const VarSymbol *variable) {
  if (variable->section == Section::InOut)
    return false;
  if (softMotion3Default(variable) != nullptr)
    return true;
  const Expr *init = initOf(variable);
  if (variable->location != nullptr && init != nullptr)
    return true; // a zero may stand against the value of another variable there
  // A zero may stand against a default that is not.
  return (init != nullptr && !isZero(init)) || needsInit(variable->type) ||
         elementsHaveDefaults(written(variable), variable->type);
}

bool Layouts::needsInit(const Type *type) {
  const auto found = needsInit_.find(type);
  if (found != needsInit_.end())
    return found->second;
  const bool result = computeNeedsInit(type);
  needsInit_.emplace(type, result);
  return result;
}

bool Layouts::computeNeedsInit(const Type *type) {
  switch (type->kind) {
  case TypeKind::Enumeration: {
    const EnumeratorSymbol *initial = typeAs<EnumType>(type)->initial;
    return initial != nullptr && initial->value != 0;
  }
  case TypeKind::Subrange:
    return subrangeDefault(typeAs<SubrangeType>(type)) != 0;
  case TypeKind::Array:
    return needsInit(typeAs<ArrayType>(type)->element);
  case TypeKind::Structure: {
    const auto *s = typeAs<StructType>(type);
    if (s->symbol->library != own_)
      return true;
    if (s->base != nullptr && needsInit(s->base))
      return true;
    for (const VarSymbol *v : initialisedFields(s)) {
      if (needsInit(v))
        return true;
    }
    return false;
  }
  case TypeKind::FunctionBlock:
  case TypeKind::Program: {
    const PouSymbol *pou = typeAs<PouType>(type)->symbol;
    return computeNeedsInit(pou);
  }
  default:
    return false;
  }
}

bool Layouts::computeNeedsInit(const PouSymbol *pou) {
  if (pou->library != own_ || hasTypeId(pou) || findInit(pou) != nullptr ||
      !afterInitMethods(pou).empty())
    return true;
  if (pou->base != nullptr && needsInit(pou->base->type))
    return true;
  for (const VarSymbol *v : pou->variables) {
    if (isOwn(v) && needsInit(v))
      return true;
  }
  return false;
}

bool Layouts::hasLifecycle(const Type *type, std::string_view lowerName) {
  return anyHeld(type, [&](const Type *t, const VarSymbol *v) {
    if (v != nullptr && (v->section == Section::InOut || !isField(v)))
      return Held::Over;
    if (!isInstance(t) || !typeAs<PouType>(t)->symbol->isBlock())
      return Held::Inside;
    const auto &methods = typeAs<PouType>(t)->symbol->methods;
    const bool has = std::any_of(methods.begin(), methods.end(), [&](const PouSymbol *m) {
      return m->property == nullptr && m->name.id->lower == lowerName;
    });
    return has ? Held::Found : Held::Inside;
  });
}

uint64_t Layouts::hash(const Type *type) {
  const auto found = hashes_.find(type);
  if (found != hashes_.end())
    return found->second;
  const uint64_t result = computeHash(type);
  hashes_.emplace(type, result);
  return result;
}

void Layouts::addMember(Hash &hash, const VarSymbol *v) {
  // Case does not matter in ST, so it is no change of layout.
  hash.add(v->storage.empty() ? v->name.id->lower : v->storage);
  if (isSlot(v)) {
    hash.add("slot");
    return;
  }
  if (v->isBit)
    hash.add("bit");
  if (v->section == Section::InOut) {
    hash.add("in-out").add(typeName(v->type));
    return;
  }
  hash.add(this->hash(v->type));
}

void Layouts::addStructure(Hash &hash, const StructType *type) {
  hash.add(typeName(type));
  if (type->pack != 0)
    hash.add("pack").add(uint64_t{type->pack});
  if (type->isUnion)
    hash.add("union");
  if (type->base != nullptr)
    hash.add("base").add(this->hash(type->base));
  for (const VarSymbol *v : type->fields)
    addMember(hash, v);
}

void Layouts::addInstance(Hash &hash, const PouType *type) {
  const PouSymbol *pou = type->symbol;
  hash.add(typeName(type));
  if (pou->base != nullptr)
    hash.add("base").add(this->hash(pou->base->type));
  if (carriesTypeId(pou))
    hash.add("type id");
  if (type->pack != 0)
    hash.add("pack").add(uint64_t{type->pack});
  for (const VarSymbol *v : pou->variables) {
    if (isField(v))
      addMember(hash, v);
  }
}

uint64_t Layouts::computeHash(const Type *type) {
  Hash h;
  h.add(static_cast<uint64_t>(type->kind));
  switch (type->kind) {
  case TypeKind::String:
  case TypeKind::Wstring:
    h.add(uint64_t{typeAs<StringType>(type)->length});
    break;
  case TypeKind::Enumeration:
    h.add(typeName(type)).add(hash(typeAs<EnumType>(type)->base));
    break;
  case TypeKind::Subrange:
    return hash(typeAs<SubrangeType>(type)->base);
  case TypeKind::Array: {
    const auto *a = typeAs<ArrayType>(type);
    h.add(static_cast<uint64_t>(a->low)).add(static_cast<uint64_t>(a->high)).add(hash(a->element));
    break;
  }
  case TypeKind::Interface:
    h.add(typeName(type));
    break;
  case TypeKind::Pointer:
  case TypeKind::Reference: // by name only: types may point to themselves
    h.add(typeName(typeAs<PointerType>(type)->pointee));
    break;
  case TypeKind::Structure:
    addStructure(h, typeAs<StructType>(type));
    break;
  case TypeKind::FunctionBlock:
  case TypeKind::Program:
    addInstance(h, typeAs<PouType>(type));
    break;
  default:
    break;
  }
  return h.value();
}

bool Layouts::hasBindings(const Type *type) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (type->kind != TypeKind::Structure && !isInstance(type))
    return false;
  const auto [it, fresh] = hasBindings_.try_emplace(type, false);
  if (!fresh)
    return it->second;
  bool result = false;
  if (type->kind == TypeKind::Structure) {
    const auto *s = typeAs<StructType>(type);
    result = s->base != nullptr && hasBindings(s->base);
    for (const VarSymbol *v : s->fields)
      result = result || isSlot(v) || hasBindings(v->type);
  } else {
    const PouSymbol *pou = typeAs<PouType>(type)->symbol;
    result = hasTypeId(pou) || (pou->base != nullptr && hasBindings(pou->base->type));
    for (const VarSymbol *v : pou->variables)
      result = result ||
               (isField(v) && (v->section == Section::InOut || isSlot(v) || hasBindings(v->type)));
  }
  hasBindings_[type] = result;
  return result;
}

bool Layouts::hasAddress(const Type *type) {
  switch (type->kind) {
  case TypeKind::Pointer:
  case TypeKind::Reference:
  case TypeKind::Interface:
    return true;
  case TypeKind::Array:
    return hasAddress(typeAs<ArrayType>(type)->element);
  case TypeKind::Structure:
  case TypeKind::FunctionBlock:
  case TypeKind::Program:
    break;
  default:
    return false;
  }
  const auto found = hasAddress_.find(type);
  if (found != hasAddress_.end())
    return found->second;
  bool result = false;
  if (type->kind == TypeKind::Structure) {
    const auto *s = typeAs<StructType>(type);
    result = s->base != nullptr && hasAddress(s->base);
    for (const VarSymbol *v : s->fields)
      result = result || hasAddress(v->type);
  } else {
    const PouSymbol *pou = typeAs<PouType>(type)->symbol;
    result = pou->base != nullptr && hasAddress(pou->base->type);
    for (const VarSymbol *v : pou->variables)
      result = result || (isField(v) && (v->section == Section::InOut || hasAddress(v->type)));
  }
  hasAddress_.emplace(type, result);
  return result;
}

} // namespace stc::codegen
