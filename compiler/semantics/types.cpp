#include "compiler/semantics/types.hpp"

#include "compiler/semantics/symbols.hpp"
#include "compiler/semantics/type_table.hpp"

namespace stc {

bool isSignedInteger(const Type *t) {
  return t->kind >= TypeKind::Sint && t->kind <= TypeKind::Lint;
}
bool isUnsignedInteger(const Type *t) {
  return t->kind >= TypeKind::Usint && t->kind <= TypeKind::Ulint;
}
bool isBitString(const Type *t) { return t->kind >= TypeKind::Byte && t->kind <= TypeKind::Lword; }
bool isUnsigned64(const Type *t) {
  t = underlying(t);
  return t->kind == TypeKind::Ulint || t->kind == TypeKind::Lword;
}
bool isInteger(const Type *t) { return t->kind >= TypeKind::Sint && t->kind <= TypeKind::Lword; }
bool isReal(const Type *t) { return t->kind == TypeKind::Real || t->kind == TypeKind::Lreal; }
bool isTimeOrDate(const Type *t) { return t->kind >= TypeKind::Time && t->kind <= TypeKind::Ldt; }
bool isString(const Type *t) { return t->kind == TypeKind::String || t->kind == TypeKind::Wstring; }
bool isCharacter(const Type *t) { return t->kind == TypeKind::Char || t->kind == TypeKind::Wchar; }
bool isElementary(const Type *t) {
  return (t->kind >= TypeKind::Boolean && t->kind <= TypeKind::Subrange) ||
         t->kind == TypeKind::AnyInteger || t->kind == TypeKind::AnyReal;
}
bool isInstance(const Type *t) {
  return t->kind == TypeKind::FunctionBlock || t->kind == TypeKind::Program;
}

const Type *underlying(const Type *t) {
  while (true) {
    if (t->kind == TypeKind::Enumeration)
      t = typeAs<EnumType>(t)->base;
    else if (t->kind == TypeKind::Subrange)
      t = typeAs<SubrangeType>(t)->base;
    else
      return t;
  }
}

unsigned bitWidth(const Type *t) {
  switch (underlying(t)->kind) {
  case TypeKind::Boolean:
    return 1;
  case TypeKind::Sint:
  case TypeKind::Usint:
  case TypeKind::Byte:
  case TypeKind::Char:
    return 8;
  case TypeKind::Int:
  case TypeKind::Uint:
  case TypeKind::Word:
  case TypeKind::Wchar:
    return 16;
  case TypeKind::Dint:
  case TypeKind::Udint:
  case TypeKind::Dword:
  case TypeKind::Real:
  case TypeKind::Time:
  case TypeKind::Date:
  case TypeKind::Tod:
  case TypeKind::Dt:
    return 32;
  default:
    return 64;
  }
}

namespace {

struct KindName {
  TypeKind kind;
  std::string_view name;
};

constexpr KindName kKindNames[] = {
    {TypeKind::Error, "<error>"},
    {TypeKind::None, "<no value>"},
    {TypeKind::Boolean, "BOOL"},
    {TypeKind::Sint, "SINT"},
    {TypeKind::Int, "INT"},
    {TypeKind::Dint, "DINT"},
    {TypeKind::Lint, "LINT"},
    {TypeKind::Usint, "USINT"},
    {TypeKind::Uint, "UINT"},
    {TypeKind::Udint, "UDINT"},
    {TypeKind::Ulint, "ULINT"},
    {TypeKind::Byte, "BYTE"},
    {TypeKind::Word, "WORD"},
    {TypeKind::Dword, "DWORD"},
    {TypeKind::Lword, "LWORD"},
    {TypeKind::Real, "REAL"},
    {TypeKind::Lreal, "LREAL"},
    {TypeKind::Time, "TIME"},
    {TypeKind::Ltime, "LTIME"},
    {TypeKind::Date, "DATE"},
    {TypeKind::Ldate, "LDATE"},
    {TypeKind::Tod, "TIME_OF_DAY"},
    {TypeKind::Ltod, "LTIME_OF_DAY"},
    {TypeKind::Dt, "DATE_AND_TIME"},
    {TypeKind::Ldt, "LDATE_AND_TIME"},
    {TypeKind::Char, "CHAR"},
    {TypeKind::Wchar, "WCHAR"},
    {TypeKind::AnyInteger, "integer constant"},
    {TypeKind::AnyReal, "real constant"},
};

std::string_view elementaryName(TypeKind kind) {
  for (const KindName &row : kKindNames)
    if (row.kind == kind)
      return row.name;
  return "";
}

} // namespace

namespace {

/// `A.B.Name` of a type in a namespace.
std::string nameInSpace(const Symbol *symbol) {
  const std::string name(symbol->name.text);
  return symbol->space == nullptr ? name : symbol->space->path + "." + name;
}

} // namespace

std::string typeName(const Type *t) {
  switch (t->kind) {
  case TypeKind::String:
  case TypeKind::Wstring: {
    const auto length = typeAs<StringType>(t)->length;
    std::string name = t->kind == TypeKind::String ? "STRING" : "WSTRING";
    return length == 80 ? name : name + "(" + std::to_string(length) + ")";
  }
  case TypeKind::Enumeration:
    return nameInSpace(typeAs<EnumType>(t)->symbol);
  case TypeKind::Structure:
    return nameInSpace(typeAs<StructType>(t)->symbol);
  case TypeKind::FunctionBlock:
  case TypeKind::Program:
  case TypeKind::Interface:
    return nameInSpace(typeAs<PouType>(t)->symbol);
  case TypeKind::Subrange: {
    const auto *s = typeAs<SubrangeType>(t);
    return typeName(s->base) + " (" + std::to_string(s->low) + ".." + std::to_string(s->high) + ")";
  }
  case TypeKind::Array: {
    std::string bounds;
    const Type *element = t;
    while (element->kind == TypeKind::Array) {
      const auto *a = typeAs<ArrayType>(element);
      bounds +=
          (bounds.empty() ? "" : ", ") + std::to_string(a->low) + ".." + std::to_string(a->high);
      element = a->element;
    }
    return "ARRAY [" + bounds + "] OF " + typeName(element);
  }
  case TypeKind::OpenArray: {
    const auto *a = typeAs<OpenArrayType>(t);
    std::string stars = "*";
    for (uint32_t i = 1; i < a->dimensions; ++i)
      stars += ", *";
    return "ARRAY [" + stars + "] OF " + typeName(a->element);
  }
  case TypeKind::Pointer:
    if (typeAs<PointerType>(t)->pointee->kind == TypeKind::None)
      return "POINTER TO VOID";
    return "POINTER TO " + typeName(typeAs<PointerType>(t)->pointee);
  case TypeKind::Reference:
    return "REFERENCE TO " + typeName(typeAs<PointerType>(t)->pointee);
  default:
    return std::string(elementaryName(t->kind));
  }
}

bool isUntyped(const Type *t) {
  return t->kind == TypeKind::AnyInteger || t->kind == TypeKind::AnyReal;
}
bool isNumber(const Type *t) {
  const Type *u = underlying(t);
  return isInteger(u) || isReal(u) || isUntyped(u);
}
bool isDuration(const Type *t) { return t->kind == TypeKind::Time || t->kind == TypeKind::Ltime; }

bool isByteView(const Type *pointee) {
  return pointee->kind == TypeKind::None || pointee->kind == TypeKind::Byte ||
         pointee->kind == TypeKind::Usint || pointee->kind == TypeKind::Sint;
}

const Type *indexStep(const Type *type) {
  if (type->kind == TypeKind::Reference)
    type = typeAs<PointerType>(type)->pointee;
  switch (type->kind) {
  case TypeKind::Array:
    return typeAs<ArrayType>(type)->element;
  case TypeKind::OpenArray:
    return typeAs<OpenArrayType>(type)->rest;
  case TypeKind::String:
    return elementaryType(TypeKind::Byte);
  case TypeKind::Wstring:
    return elementaryType(TypeKind::Word);
  case TypeKind::Pointer: {
    const Type *pointee = typeAs<PointerType>(type)->pointee;
    if (pointee->kind == TypeKind::None)
      return nullptr;
    return isString(pointee) ? indexStep(pointee) : pointee;
  }
  default:
    return nullptr;
  }
}

} // namespace stc
