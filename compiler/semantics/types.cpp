#include "compiler/semantics/types.hpp"

#include "compiler/semantics/symbols.hpp"
#include "compiler/semantics/type_table.hpp"

namespace stc {

bool isSignedInteger(const Type *t) {
  return t->kind >= TypeKind::sint && t->kind <= TypeKind::lint;
}
bool isUnsignedInteger(const Type *t) {
  return t->kind >= TypeKind::usint && t->kind <= TypeKind::ulint;
}
bool isBitString(const Type *t) { return t->kind >= TypeKind::byte && t->kind <= TypeKind::lword; }
bool isUnsigned64(const Type *t) {
  t = underlying(t);
  return t->kind == TypeKind::ulint || t->kind == TypeKind::lword;
}
bool isInteger(const Type *t) { return t->kind >= TypeKind::sint && t->kind <= TypeKind::lword; }
bool isReal(const Type *t) { return t->kind == TypeKind::real || t->kind == TypeKind::lreal; }
bool isTimeOrDate(const Type *t) { return t->kind >= TypeKind::time && t->kind <= TypeKind::ldt; }
bool isString(const Type *t) { return t->kind == TypeKind::string || t->kind == TypeKind::wstring; }
bool isCharacter(const Type *t) {
  return t->kind == TypeKind::charT || t->kind == TypeKind::wcharT;
}
bool isElementary(const Type *t) {
  return (t->kind >= TypeKind::boolean && t->kind <= TypeKind::subrange) ||
         t->kind == TypeKind::anyInteger || t->kind == TypeKind::anyReal;
}
bool isInstance(const Type *t) {
  return t->kind == TypeKind::functionBlock || t->kind == TypeKind::program;
}

const Type *underlying(const Type *t) {
  while (true) {
    if (t->kind == TypeKind::enumeration)
      t = typeAs<EnumType>(t)->base;
    else if (t->kind == TypeKind::subrange)
      t = typeAs<SubrangeType>(t)->base;
    else
      return t;
  }
}

unsigned bitWidth(const Type *t) {
  switch (underlying(t)->kind) {
  case TypeKind::boolean:
    return 1;
  case TypeKind::sint:
  case TypeKind::usint:
  case TypeKind::byte:
  case TypeKind::charT:
    return 8;
  case TypeKind::intT:
  case TypeKind::uint:
  case TypeKind::word:
  case TypeKind::wcharT:
    return 16;
  case TypeKind::dint:
  case TypeKind::udint:
  case TypeKind::dword:
  case TypeKind::real:
  case TypeKind::time:
  case TypeKind::date:
  case TypeKind::tod:
  case TypeKind::dt:
    return 32;
  default:
    return 64;
  }
}

namespace {

std::string_view elementaryName(TypeKind kind) {
  switch (kind) {
  case TypeKind::error:
    return "<error>";
  case TypeKind::none:
    return "<no value>";
  case TypeKind::boolean:
    return "BOOL";
  case TypeKind::sint:
    return "SINT";
  case TypeKind::intT:
    return "INT";
  case TypeKind::dint:
    return "DINT";
  case TypeKind::lint:
    return "LINT";
  case TypeKind::usint:
    return "USINT";
  case TypeKind::uint:
    return "UINT";
  case TypeKind::udint:
    return "UDINT";
  case TypeKind::ulint:
    return "ULINT";
  case TypeKind::byte:
    return "BYTE";
  case TypeKind::word:
    return "WORD";
  case TypeKind::dword:
    return "DWORD";
  case TypeKind::lword:
    return "LWORD";
  case TypeKind::real:
    return "REAL";
  case TypeKind::lreal:
    return "LREAL";
  case TypeKind::time:
    return "TIME";
  case TypeKind::ltime:
    return "LTIME";
  case TypeKind::date:
    return "DATE";
  case TypeKind::ldate:
    return "LDATE";
  case TypeKind::tod:
    return "TIME_OF_DAY";
  case TypeKind::ltod:
    return "LTIME_OF_DAY";
  case TypeKind::dt:
    return "DATE_AND_TIME";
  case TypeKind::ldt:
    return "LDATE_AND_TIME";
  case TypeKind::charT:
    return "CHAR";
  case TypeKind::wcharT:
    return "WCHAR";
  case TypeKind::anyInteger:
    return "integer constant";
  case TypeKind::anyReal:
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
  case TypeKind::string:
  case TypeKind::wstring: {
    const auto length = typeAs<StringType>(t)->length;
    std::string name = t->kind == TypeKind::string ? "STRING" : "WSTRING";
    return length == 80 ? name : name + "(" + std::to_string(length) + ")";
  }
  case TypeKind::enumeration:
    return nameInSpace(typeAs<EnumType>(t)->symbol);
  case TypeKind::structure:
    return nameInSpace(typeAs<StructType>(t)->symbol);
  case TypeKind::functionBlock:
  case TypeKind::program:
  case TypeKind::interface:
    return nameInSpace(typeAs<PouType>(t)->symbol);
  case TypeKind::subrange: {
    const auto *s = typeAs<SubrangeType>(t);
    return typeName(s->base) + " (" + std::to_string(s->low) + ".." + std::to_string(s->high) + ")";
  }
  case TypeKind::array: {
    std::string bounds;
    const Type *element = t;
    while (element->kind == TypeKind::array) {
      const auto *a = typeAs<ArrayType>(element);
      bounds +=
          (bounds.empty() ? "" : ", ") + std::to_string(a->low) + ".." + std::to_string(a->high);
      element = a->element;
    }
    return "ARRAY [" + bounds + "] OF " + typeName(element);
  }
  case TypeKind::openArray: {
    const auto *a = typeAs<OpenArrayType>(t);
    std::string stars = "*";
    for (std::uint32_t i = 1; i < a->dimensions; ++i)
      stars += ", *";
    return "ARRAY [" + stars + "] OF " + typeName(a->element);
  }
  case TypeKind::pointer:
    if (typeAs<PointerType>(t)->pointee->kind == TypeKind::none)
      return "POINTER TO VOID";
    return "POINTER TO " + typeName(typeAs<PointerType>(t)->pointee);
  case TypeKind::reference:
    return "REFERENCE TO " + typeName(typeAs<PointerType>(t)->pointee);
  default:
    return std::string(elementaryName(t->kind));
  }
}

bool isUntyped(const Type *t) {
  return t->kind == TypeKind::anyInteger || t->kind == TypeKind::anyReal;
}
bool isNumber(const Type *t) {
  const Type *u = underlying(t);
  return isInteger(u) || isReal(u) || isUntyped(u);
}
bool isDuration(const Type *t) { return t->kind == TypeKind::time || t->kind == TypeKind::ltime; }

bool isByteView(const Type *pointee) {
  return pointee->kind == TypeKind::none || pointee->kind == TypeKind::byte ||
         pointee->kind == TypeKind::usint || pointee->kind == TypeKind::sint;
}

const Type *indexStep(const Type *type) {
  if (type->kind == TypeKind::reference)
    type = typeAs<PointerType>(type)->pointee;
  switch (type->kind) {
  case TypeKind::array:
    return typeAs<ArrayType>(type)->element;
  case TypeKind::openArray:
    return typeAs<OpenArrayType>(type)->rest;
  case TypeKind::string:
    return elementaryType(TypeKind::byte);
  case TypeKind::wstring:
    return elementaryType(TypeKind::word);
  case TypeKind::pointer: {
    const Type *pointee = typeAs<PointerType>(type)->pointee;
    if (pointee->kind == TypeKind::none)
      return nullptr;
    return isString(pointee) ? indexStep(pointee) : pointee;
  }
  default:
    return nullptr;
  }
}

} // namespace stc
