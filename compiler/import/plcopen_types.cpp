// Types and initial values of PLCopen XML.
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/plcopen_context.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stc::import::plcopen {

using stride::common::upperCase;

namespace {

std::string arrayText(Context &context, const Node &node, const std::string &owner) {
  std::string ranges;
  for (const Node &each : children(node, "dimension")) {
    const std::string lower = attribute(each, "lower");
    const std::string upper = attribute(each, "upper");
    const bool open = lower == "*" || upper == "*" || (lower.empty() && upper.empty());
    ranges += fmt::format("{}{}", ranges.empty() ? "" : ", ",
                          open ? std::string("*") : fmt::format("{}..{}", lower, upper));
  }
  context.leaveOutUnknown(node, {"dimension", "baseType"});
  return fmt::format("ARRAY[{}] OF {}", ranges, typeText(context, child(node, "baseType"), owner));
}

/// Comments of enumerators, which CODESYS keeps apart from them.
std::string enumeratorComment(const Node &documented, const std::string &name) {
  for (const Node &each : children(extra(documented, "EnumValueDocumentation"), "EnumValue"))
    if (textOf(child(each, "Name")) == name)
      return commentLines(linesOf(child(each, "Documentation")), "  ");
  return {};
}

/// `(a, b := 5)`; a line for each when `documented`, the type, is given.
std::string enumText(Context &context, const Node &node, const Node &documented,
                     const std::string &owner) {
  std::string text;
  const std::vector<Node> values = children(child(node, "values"), "value");
  for (size_t i = 0; i < values.size(); ++i) {
    const std::string name = attribute(values[i], "name");
    const std::string value = attribute(values[i], "value");
    if (documented)
      text += enumeratorComment(documented, name) + documentationLines(values[i], "  ") + "  ";
    text += name + (value.empty() ? "" : " := " + value);
    if (i + 1 != values.size())
      text += documented ? ",\n" : ", ";
  }
  context.leaveOutUnknown(node, {"values", "baseType"});
  const Node base = child(node, "baseType");
  const std::string suffix = base ? " " + typeText(context, base, owner) : std::string();
  return documented ? fmt::format("(\n{}\n){}", text, suffix) : fmt::format("({}){}", text, suffix);
}

std::string rangeText(Context &context, const Node &node, const std::string &owner) {
  const Node range = child(node, "range");
  return fmt::format("{} ({}..{})", typeText(context, child(node, "baseType"), owner),
                     attribute(range, "lower"), attribute(range, "upper"));
}

std::string structText(Context &context, const Node &node, const std::string &owner) {
  return fmt::format("STRUCT\n{}END_STRUCT", variableLines(context, node, owner));
}

std::string stringText(const Node &node, std::string_view keyword) {
  const std::string length = attribute(node, "length");
  return length.empty() ? std::string(keyword) : fmt::format("{}({})", keyword, length);
}

/// A literal's text; a text without its quotes gets them.
std::string simpleText(const std::string &value, std::string_view type) {
  const std::string upper = upperCase(type.substr(0, 7));
  const char quote = upper.starts_with("STRING") ? '\'' : upper.starts_with("WSTRING") ? '"' : '\0';
  const std::string_view text = trimmed(value);
  if (quote == '\0' || (!text.empty() && (text.front() == '\'' || text.front() == '"')) ||
      (isName(text)) || text.find('(') != std::string_view::npos ||
      text.find('.') != std::string_view::npos)
    return value;
  std::string quoted(1, quote);
  for (const char c : value)
    quoted += c == '$' ? "$$" : c == quote ? std::string("$") + c : std::string(1, c);
  return quoted + quote;
}

std::string valueText(Context &context, const Node &node, std::string_view type) {
  const Node value = firstElement(node);
  const std::string_view kind = localName(value);
  if (kind == "simpleValue")
    return simpleText(attribute(value, "value"), type);
  if (kind != "arrayValue" && kind != "structValue") {
    context.leftOut(node, "initial value", fmt::format("its form `{}` is not known", kind));
    return {};
  }
  const bool isArray = kind == "arrayValue";
  std::string text;
  for (const Node &each : children(value, "value")) {
    if (!text.empty())
      text += ", ";
    const std::string inner = valueText(context, each, {});
    const std::string times = attribute(each, "repetitionValue");
    if (!isArray)
      text += fmt::format("{} := {}", attribute(each, "member"), inner);
    else if (times.empty() || times == "1")
      text += inner;
    else
      text += fmt::format("{}({})", times, inner);
  }
  return isArray ? fmt::format("[{}]", text) : fmt::format("({})", text);
}

/// `(a := 1, 2)`: what CODESYS gives to the FB_Init of a block.
std::string assignmentsText(const Node &variable) {
  const Node list = extra(variable, "InputAssignments");
  if (!list)
    return {};
  std::string text;
  for (const Node &each : children(list, "InputAssignment")) {
    const std::string name = textOf(child(each, "Name"));
    text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", name,
                        name.empty() ? "" : " := ", textOf(child(each, "Value")));
  }
  return "(" + text + ")";
}

} // namespace

std::string typeText(Context &context, const Node &node, const std::string &owner) {
  const Node type = firstElement(node);
  const std::string_view kind = localName(type);
  if (kind == "derived")
    return attribute(type, "name");
  if (kind == "array")
    return arrayText(context, type, owner);
  if (kind == "string" || kind == "STRING")
    return stringText(type, "STRING");
  if (kind == "wstring" || kind == "WSTRING")
    return stringText(type, "WSTRING");
  if (kind == "pointer")
    return "POINTER TO " + typeText(context, child(type, "baseType"), owner);
  if (kind == "reference")
    return "REFERENCE TO " + typeText(context, child(type, "baseType"), owner);
  if (kind == "subrangeSigned" || kind == "subrangeUnsigned")
    return rangeText(context, type, owner);
  if (kind == "enum")
    return enumText(context, type, {}, owner);
  if (kind == "struct")
    return context.addHelperType(type, owner, structText(context, type, owner));
  if (!kind.empty() && !firstElement(type))
    return upperCase(kind);
  context.leftOut(kind.empty() ? node : type, owner,
                  kind.empty() ? "it has no type"
                               : fmt::format("its type `{}` is not known", kind));
  return "UNKNOWN_TYPE";
}

std::string initialText(Context &context, const Node &node, std::string_view type) {
  const Node initial = child(node, "initialValue");
  if (!initial)
    return {};
  const std::string value = valueText(context, initial, type);
  return value.empty() ? std::string() : " := " + value;
}

std::string variableLines(Context &context, const Node &list, const std::string &owner) {
  std::string text;
  for (const Node &each : children(list, "variable")) {
    const std::string name = context.nameOf(each, owner + ": variable");
    if (name.empty())
      continue;
    const std::string address = attribute(each, "address");
    const std::string whole = fmt::format("{}_{}", owner, name);
    const std::string type = typeText(context, child(each, "type"), whole);
    text += documentationLines(each, "  ") + attributeLines(each, "  ");
    text += fmt::format("  {}{} : {}{}{};\n", name, address.empty() ? "" : " AT " + address, type,
                        assignmentsText(each), initialText(context, each, type));
    context.leaveOutUnknown(each, {"type", "initialValue", "documentation"});
    context.leaveOutUnknownExtras(each, {"Attributes", "InputAssignments"});
  }
  return text;
}

void readDataType(Context &context, const Node &node) {
  const std::string name = context.nameOf(node, "type");
  if (name.empty() || isInSource(node))
    return;
  context.leaveOutUnknown(node,
                          {"baseType", "initialValue", "documentation", "InterfaceAsPlainText"});
  context.leaveOutUnknownExtras(
      node, {"Attributes", "Inheritance", "EnumValueDocumentation", "InterfaceAsPlainText"});
  if (const std::string plain = plainDeclaration(node); !plain.empty())
    return context.add(ObjectKind::Type, node, name, plain);
  const Node base = child(node, "baseType");
  const Node type = firstElement(base);
  const std::string_view kind = localName(type);
  std::string body;
  if (kind == "struct")
    body = structText(context, type, name);
  else if (kind == "enum")
    body = enumText(context, type, node, name);
  else
    body = typeText(context, base, name);
  const std::string extends = textOf(child(extra(node, "Inheritance"), "Extends"));
  const std::string initial = initialText(context, node, body);
  context.add(ObjectKind::Type, node, name,
              fmt::format("{}{}TYPE {}{} :\n{}{}{}\nEND_TYPE\n", documentationLines(node),
                          attributeLines(node), name, extends.empty() ? "" : " EXTENDS " + extends,
                          body, initial, kind == "struct" ? "" : ";"));
}

void readUnion(Context &context, const Node &node) {
  const std::string name = context.nameOf(node, "union");
  if (name.empty() || isInSource(node))
    return;
  context.leaveOutUnknown(node, {"variable", "documentation", "InterfaceAsPlainText"});
  context.leaveOutUnknownExtras(node, {"Attributes", "InterfaceAsPlainText", "InSource"});
  if (const std::string plain = plainDeclaration(node); !plain.empty())
    return context.add(ObjectKind::Type, node, name, plain);
  context.add(ObjectKind::Type, node, name,
              fmt::format("{}{}TYPE {} :\nUNION\n{}END_UNION\nEND_TYPE\n", documentationLines(node),
                          attributeLines(node), name, variableLines(context, node, name)));
}

} // namespace stc::import::plcopen
