// Types, initial values and variables as PLCopen XML.
#include "compiler/export/plcopen_parts.hpp"

#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stc::exporting {

using namespace ast;

namespace {

/// Elements of elementary types; the others have none and are named as derived types are.
constexpr std::array<std::string_view, 19> kElementary = {
    "BOOL", "BYTE",  "WORD",  "DWORD", "LWORD", "SINT", "INT",  "DINT", "LINT", "USINT",
    "UINT", "UDINT", "ULINT", "REAL",  "LREAL", "TIME", "DATE", "DT",   "TOD"};

std::string_view elementOf(std::string_view name) {
  if (equalIgnoringCase(name, "date_and_time"))
    return "DT";
  if (equalIgnoringCase(name, "time_of_day"))
    return "TOD";
  for (const std::string_view each : kElementary)
    if (equalIgnoringCase(each, name))
      return each;
  return {};
}

bool isUnsigned(std::string_view type) {
  const std::string lower = lowerCase(type);
  return lower.starts_with("u") || lower == "byte" || lower.ends_with("word");
}

void append(Node parent, std::string_view name) { parent.append_child(std::string(name).c_str()); }

Node derived(Node parent, const std::string &name) {
  Node node = parent.append_child("derived");
  node.append_attribute("name") = name.c_str();
  return node;
}

} // namespace

void Writer::enumeration(Node parent, const EnumTypeExpr &type) const {
  Node node = parent.append_child("enum");
  Node values = node.append_child("values");
  for (const EnumeratorDecl &each : type.enumerators) {
    Node value = values.append_child("value");
    value.append_attribute("name") = std::string(each.name.text).c_str();
    if (each.value != nullptr)
      value.append_attribute("value") = textOf(each.value->span).c_str();
  }
  if (type.base != nullptr)
    this->type(node.append_child("baseType"), type.base);
}

void Writer::type(Node parent, const TypeExpr *type) const {
  switch (type->kind) {
  case TypeExprKind::Named: {
    const auto *named = as<NamedTypeExpr>(type);
    const std::string name = pathOf(named->path);
    if (const std::string_view element = elementOf(name); !element.empty())
      append(parent, element);
    else
      derived(parent, name);
    return;
  }
  case TypeExprKind::Array: {
    const auto *array = as<ArrayTypeExpr>(type);
    Node node = parent.append_child("array");
    for (const ArrayRange &range : array->ranges) {
      Node dimension = node.append_child("dimension");
      const auto bound = [&](const Expr *value) {
        return value == nullptr ? std::string("*") : textOf(value->span);
      };
      dimension.append_attribute("lower") = bound(range.low).c_str();
      dimension.append_attribute("upper") = bound(range.high).c_str();
    }
    return this->type(node.append_child("baseType"), array->element);
  }
  case TypeExprKind::String: {
    const auto *string = as<StringTypeExpr>(type);
    Node node = parent.append_child(string->wide ? "wstring" : "string");
    if (string->length != nullptr)
      node.append_attribute("length") = textOf(string->length->span).c_str();
    return;
  }
  case TypeExprKind::Pointer: {
    const auto *pointer = as<PointerTypeExpr>(type);
    if (pointer->refTo)
      derived(parent, textOf(type->span));
    else
      this->type(parent.append_child("pointer").append_child("baseType"), pointer->pointee);
    return;
  }
  case TypeExprKind::Subrange: {
    const auto *range = as<SubrangeTypeExpr>(type);
    const bool noSign = isUnsigned(textOf(range->base->span));
    Node node = parent.append_child(noSign ? "subrangeUnsigned" : "subrangeSigned");
    Node bounds = node.append_child("range");
    bounds.append_attribute("lower") = textOf(range->low->span).c_str();
    bounds.append_attribute("upper") = textOf(range->high->span).c_str();
    return this->type(node.append_child("baseType"), range->base);
  }
  case TypeExprKind::Enumeration:
    return enumeration(parent, *as<EnumTypeExpr>(type));
  case TypeExprKind::Reference:
  case TypeExprKind::Inferred:
  case TypeExprKind::Error:
    derived(parent, textOf(type->span));
    return;
  }
}

/// False: the value has a form that the format does not know; nothing has been added.
bool Writer::composite(Node parent, const AggregateExpr &value) const {
  const bool simple =
      std::all_of(value.items.begin(), value.items.end(), [&](const AggregateItem &item) {
        return item.value != nullptr && item.values.empty() && (!value.isStruct || item.field);
      });
  if (!simple || value.items.empty())
    return false;
  Node list = parent.append_child(value.isStruct ? "structValue" : "arrayValue");
  for (const AggregateItem &item : value.items) {
    Node one = list.append_child("value");
    if (item.repeat != nullptr)
      one.append_attribute("repetitionValue") = textOf(item.repeat->span).c_str();
    if (value.isStruct)
      one.append_attribute("member") = std::string(item.field.text).c_str();
    const bool whole =
        item.value->kind == ExprKind::Aggregate && composite(one, *as<AggregateExpr>(item.value));
    if (!whole)
      one.append_child("simpleValue").append_attribute("value") = textOf(item.value->span).c_str();
  }
  return true;
}

void Writer::initialValue(Node parent, const Expr *value) const {
  if (value == nullptr)
    return;
  Node node = parent.append_child("initialValue");
  if (value->kind == ExprKind::Aggregate && composite(node, *as<AggregateExpr>(value)))
    return;
  node.append_child("simpleValue").append_attribute("value") = textOf(value->span).c_str();
}

void Writer::variable(Node list, const VarDecl &variable) const {
  Node node = list.append_child("variable");
  node.append_attribute("name") = std::string(variable.name.text).c_str();
  if (variable.address != nullptr)
    node.append_attribute("address") = std::string(variable.address->text).c_str();
  type(node.append_child("type"), variable.type);
  initialValue(node, variable.init);
  addAttributes(node, variable.attributes);
  if (variable.type->kind == TypeExprKind::Named) {
    const auto *named = as<NamedTypeExpr>(variable.type);
    if (named->hasArguments && named->elements.empty()) {
      Node inputs = addData(node, kCodesys, "inputassignments").append_child("InputAssignments");
      for (const Argument &each : named->arguments) {
        Node one = inputs.append_child("InputAssignment");
        if (each.name)
          one.append_child("Name").text() = std::string(each.name.text).c_str();
        one.append_child("Value").text() =
            each.value == nullptr ? "" : textOf(each.value->span).c_str();
      }
    }
  }
  addDocumentation(node, variable.doc);
}

void Writer::dataType(Node dataTypes, Node project, const Decl &decl, const DeclarationText &text,
                      bool whole) const {
  const bool isUnion = decl.kind == DeclKind::Structure && as<StructDecl>(&decl)->isUnion;
  Node node = isUnion ? addData(project, kCodesys, "union").append_child("union")
                      : dataTypes.append_child("dataType");
  node.append_attribute("name") = std::string(decl.name.text).c_str();
  const TypeExpr *type = nullptr;
  if (decl.kind == DeclKind::Structure) {
    Node fields = isUnion ? node : node.append_child("baseType").append_child("struct");
    for (const VarDecl *each : as<StructDecl>(&decl)->fields)
      variable(fields, *each);
  } else if (decl.kind == DeclKind::Enumeration) {
    enumeration(node.append_child("baseType"), *as<EnumDecl>(&decl)->type);
    initialValue(node, as<EnumDecl>(&decl)->init);
  } else {
    type = as<AliasDecl>(&decl)->type;
    this->type(node.append_child("baseType"), type);
    initialValue(node, as<AliasDecl>(&decl)->init);
  }
  if (decl.kind == DeclKind::Structure && !isUnion && !as<StructDecl>(&decl)->base.empty())
    addData(node, kCodesys, "datatypeinheritance")
        .append_child("Inheritance")
        .append_child("Extends")
        .text() = pathOf(as<StructDecl>(&decl)->base).c_str();
  addAttributes(node, decl.attributes);
  if (whole)
    addData(node, kStride, "insource").append_child("InSource");
  else
    addPlainDeclaration(node, fmt::format("{}TYPE {}\nEND_TYPE\n{}", trimmedLines(text.leading),
                                          text.declaration, trimmedLines(text.tail)));
  addDocumentation(node, decl.doc);
}

} // namespace stc::exporting
