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

std::string_view elementaryName(TypeKind kind) {
  switch (kind) {
  case TypeKind::Error:
    return "<error>";
  case TypeKind::None:
    return "<no value>";
  case TypeKind::Boolean:
    return "BOOL";
  case TypeKind::Sint:
    return "SINT";
  case TypeKind::Int:
    return "INT";
  case TypeKind::Dint:
    return "DINT";
  case TypeKind::Lint:
    return "LINT";
  case TypeKind::Usint:
    return "USINT";
  case TypeKind::Uint:
    return "UINT";
  case TypeKind::Udint:
    return "UDINT";
  case TypeKind::Ulint:
    return "ULINT";
  case TypeKind::Byte:
    return "BYTE";
  case TypeKind::Word:
    return "WORD";
  case TypeKind::Dword:
    return "DWORD";
  case TypeKind::Lword:
    return "LWORD";
  case TypeKind::Real:
    return "REAL";
  case TypeKind::Lreal:
    return "LREAL";
  case TypeKind::Time:
    return "TIME";
  case TypeKind::Ltime:
    return "LTIME";
  case TypeKind::Date:
    return "DATE";
  case TypeKind::Ldate:
    return "LDATE";
  case TypeKind::Tod:
    return "TIME_OF_DAY";
  case TypeKind::Ltod:
    return "LTIME_OF_DAY";
  case TypeKind::Dt:
    return "DATE_AND_TIME";
  case TypeKind::Ldt:
    return "LDATE_AND_TIME";
  case TypeKind::Char:
    return "CHAR";
  case TypeKind::Wchar:
    return "WCHAR";
  case TypeKind::AnyInteger:
    return "integer constant";
  case TypeKind::AnyReal:
    return "real constant";
  default:
    return "";
  }
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
