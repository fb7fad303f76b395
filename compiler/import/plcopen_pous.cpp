// POUs of PLCopen XML with their members: actions, and what CODESYS adds (methods, properties,
// interfaces).
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/plcopen_context.hpp"
#include "compiler/source/st_scan.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

/// PRIVATE, ABSTRACT … with a blank after each.
std::string modifiersOf(const Node &interface) {
  constexpr std::array<std::pair<const char *, std::string_view>, 7> kModifiers = {
      {{"Public", "PUBLIC "},
       {"Private", "PRIVATE "},
       {"Protected", "PROTECTED "},
       {"Internal", "INTERNAL "},
       {"Final", "FINAL "},
       {"Abstract", "ABSTRACT "},
       {"Override", "OVERRIDE "}}};
  const Node access = extra(interface, "AccessModifiers");
  std::string text;
  for (const auto &[name, word] : kModifiers)
    if (isTrue(access, name))
      text += word;
  return text;
}

std::string inheritanceOf(const Node &interface) {
  Node inheritance = extra(interface, "Inheritance");
  if (!inheritance) // of an INTERFACE, old versions of CODESYS write it without addData
    inheritance = child(interface, "Inheritance");
  std::string text;
  for (const std::string_view kind : {"Extends", "Implements"}) {
    std::string names;
    for (const Node &each : children(inheritance, kind))
      names += (names.empty() ? "" : ", ") + std::string(trimmed(textOf(each)));
    if (!names.empty())
      text += fmt::format(" {} {}", kind == "Extends" ? "EXTENDS" : "IMPLEMENTS", names);
  }
  return text;
}

std::string returnTypeOf(Context &context, const Node &interface, const std::string &owner) {
  const Node type = child(interface, "returnType");
  if (!type)
    return {};
  if (const std::string_view written = trimmed(type.child_value());
      !firstElement(type) && !written.empty())
    return fmt::format(" : {}", written);
  return " : " + typeText(context, type, owner);
}

/// The head and the sections: as the author has written them, or from the elements.
std::string declarationOf(Context &context, const Node &node, std::string_view keyword,
                          const std::string &name, const std::string &owner) {
  const Node interface = child(node, "interface");
  context.leaveOutUnknown(interface, {"returnType", "localVars", "tempVars", "inputVars",
                                      "outputVars", "inOutVars", "externalVars", "globalVars",
                                      "accessVars", "staticVars", "instanceVars", "documentation"});
  context.leaveOutUnknownExtras(
      interface, {"Attributes", "Inheritance", "AccessModifiers", "InterfaceAsPlainText"});
  std::string plain = plainDeclaration(node);
  if (plain.empty())
    plain = plainDeclaration(interface);
  if (!plain.empty())
    return plain;
  std::string comment = documentationLines(node);
  if (comment.empty())
    comment = documentationLines(interface);
  return fmt::format("{}{}{} {}{}{}{}\n{}", comment, attributeLines(interface), keyword,
                     modifiersOf(interface), name, inheritanceOf(interface),
                     returnTypeOf(context, interface, owner),
                     sectionsText(context, interface, owner));
}

/// Bodies of all worksheets, one after the other.
std::string bodiesOf(Context &context, const Node &node, const Node &pou, const std::string &object,
                     std::string &members) {
  std::string text;
  for (const Node &body : children(node, "body"))
    text += bodyText(context, body, pou, object, members);
  return text;
}

std::string method(Context &context, const Node &node, const std::string &owner) {
  const std::string name = context.nameOf(node, owner + ": method");
  if (name.empty())
    return {};
  const std::string object = owner + "." + name;
  context.leaveOutUnknown(
      node, {"interface", "body", "transitions", "documentation", "InterfaceAsPlainText"});
  context.leaveOutUnknownExtras(node, {"InterfaceAsPlainText"});
  std::string members;
  std::string text = declarationOf(context, node, "METHOD", name, owner + "_" + name);
  text += bodiesOf(context, node, node, object, members) + "END_METHOD\n";
  leaveOutMembers(context, node, object, members);
  return text;
}

/// GET or SET of a property.
std::string accessor(Context &context, const Node &node, std::string_view word,
                     const std::string &owner) {
  if (!node)
    return {};
  context.leaveOutUnknown(node, {"interface", "body", "documentation", "InterfaceAsPlainText"});
  context.leaveOutUnknownExtras(node, {"InterfaceAsPlainText"});
  const Node interface = child(node, "interface");
  std::string declarations = plainDeclaration(node);
  if (declarations.empty())
    declarations = plainDeclaration(interface);
  if (declarations.empty())
    declarations = sectionsText(context, interface, owner);
  std::string members;
  const std::string body = bodiesOf(context, node, {}, owner, members);
  leaveOutMembers(context, node, owner, members);
  return fmt::format("{}\n{}{}END_{}\n",
                     trimmed(fmt::format("{} {}", word, modifiersOf(interface))), declarations,
                     body, word);
}

std::string property(Context &context, const Node &node, const std::string &owner) {
  const std::string name = context.nameOf(node, owner + ": property");
  if (name.empty())
    return {};
  context.leaveOutUnknown(
      node, {"interface", "GetAccessor", "SetAccessor", "documentation", "InterfaceAsPlainText"});
  context.leaveOutUnknownExtras(node, {"InterfaceAsPlainText"});
  const std::string object = owner + "." + name;
  return fmt::format("{}{}{}END_PROPERTY\n",
                     declarationOf(context, node, "PROPERTY", name, owner + "_" + name),
                     accessor(context, child(node, "GetAccessor"), "GET", object),
                     accessor(context, child(node, "SetAccessor"), "SET", object));
}

std::string actionsOf(Context &context, const Node &node, const std::string &owner) {
  std::string text;
  for (const Node &each : children(child(node, "actions"), "action")) {
    const std::string name = context.nameOf(each, owner + ": action");
    if (name.empty())
      continue;
    context.leaveOutUnknown(each, {"body", "transitions", "documentation"});
    context.leaveOutUnknownExtras(each, {});
    std::string members;
    const bool own = !child(each, "transitions").empty(); // otherwise those of the POU
    const std::string body =
        bodiesOf(context, each, own ? each : node, owner + "." + name, members);
    text += fmt::format("\n{}ACTION {}:\n{}END_ACTION\n{}", documentationLines(each), name, body,
                        members);
  }
  return text;
}

/// Methods and properties, wherever they stand in the addData.
std::string membersOf(Context &context, const Node &node, const std::string &owner) {
  std::string text;
  for (const Extra &each : extrasOf(node)) {
    const std::string_view kind = localName(each.element);
    std::string one;
    if (kind == "Method")
      one = method(context, each.element, owner);
    else if (kind == "Property")
      one = property(context, each.element, owner);
    if (!one.empty())
      text += "\n" + one;
  }
  for (const Node &each : children(child(node, "Methods"), "Method"))
    text += "\n" + method(context, each, owner);
  for (const Node &each : children(child(node, "Properties"), "Property"))
    text += "\n" + property(context, each, owner);
  return text;
}

/// The flags that a chart can use here, by the names that CODESYS's settings have for them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kFlags = {
    {{"Init", "BOOL"},
     {"Reset", "BOOL"},
     {"Error", "BOOL"},
     {"EnableLimit", "BOOL"},
     {"QuitError", "BOOL"},
     {"Pause", "BOOL"},
     {"Trans", "BOOL"},
     {"Tip", "BOOL"},
     {"TipMode", "BOOL"},
     {"ErrorStep", "STRING"},
     {"ErrorPOU", "STRING"},
     {"CurrentStep", "STRING"}}};

/// Declares the flags that CODESYS's settings of a chart declare without a word in the text.
std::string flagSection(Context &context, const Node &pou, const std::string &object,
                        std::string_view declaration) {
  std::string section;
  std::string declared;
  std::string others;
  const auto add = [](std::string &list, const std::string &name) {
    list += (list.empty() ? "" : ", ") + name;
  };
  for (const Node &each : children(child(extra(pou, "SFCSettings"), "Flags"))) {
    if (!isTrue(each, "Use"))
      continue;
    const std::string name = fmt::format("SFC{}", localName(each));
    const std::vector<StWord> words = wordsOf(declaration);
    const auto *const row = std::ranges::find(
        kFlags, localName(each), &std::pair<std::string_view, std::string_view>::first);
    const bool written = std::ranges::any_of(words, [&](const StWord &word) {
      return sameName(declaration.substr(word.begin, word.end - word.begin), name);
    });
    if (row == kFlags.end() || !isTrue(each, "Declare")) {
      add(others, name);
    } else if (!written) {
      section += fmt::format("  {} : {};\n", name, row->second);
      add(declared, name);
    }
  }
  const Node settings = extra(pou, "SFCSettings");
  if (!declared.empty())
    context.changed(settings, object,
                    fmt::format("flags that its chart uses are declared: {}", declared));
  if (!others.empty())
    context.changed(settings, object,
                    fmt::format("its chart uses the flags {}, which it does not declare or which "
                                "are not known here: they have no effect",
                                others));
  return section.empty() ? section : fmt::format("VAR\n{}END_VAR\n", section);
}

struct PouKind {
  std::string_view type;
  std::string_view keyword;
};

constexpr std::array<PouKind, 4> kPouKinds = {{{"program", "PROGRAM"},
                                               {"functionBlock", "FUNCTION_BLOCK"},
                                               {"function", "FUNCTION"},
                                               {"class", "CLASS"}}};

std::string_view pouKeywordOf(std::string_view type) {
  for (const PouKind &each : kPouKinds)
    if (sameName(each.type, type))
      return each.keyword;
  return {};
}

/// What ends the declaration: the file's word for the kind says less than the author's text.
std::string_view closingKeyword(std::string_view declaration, std::string_view keyword) {
  const std::string first = firstKeyword(declaration);
  for (const PouKind &each : kPouKinds)
    if (sameName(each.keyword, first))
      return each.keyword;
  return keyword;
}

} // namespace

void readPou(Context &context, const Node &node) {
  const std::string name = context.nameOf(node, "POU");
  if (name.empty() || isInSource(node) || context.isNotBuilt(node, name))
    return;
  std::string_view keyword = pouKeywordOf(attribute(node, "pouType"));
  if (keyword.empty()) {
    context.changed(node, name,
                    fmt::format("its pouType `{}` is not known; it became a FUNCTION_BLOCK",
                                attribute(node, "pouType")));
    keyword = "FUNCTION_BLOCK";
  }
  context.leaveOutUnknown(node, {"interface", "body", "actions", "transitions", "documentation",
                                 "InterfaceAsPlainText"});
  context.leaveOutUnknownExtras(
      node, {"Method", "Property", "InterfaceAsPlainText", "SFCSettings", "BuildProperties"});
  std::string declaration = declarationOf(context, node, keyword, name, name);
  declaration += flagSection(context, node, name, declaration);
  std::string members;
  const std::string body = bodiesOf(context, node, node, name, members);
  members += actionsOf(context, node, name) + membersOf(context, node, name);
  context.add(ObjectKind::Pou, node, name,
              fmt::format("{}{}{}{}END_{}\n", declaration, body.empty() ? "" : "\n", body, members,
                          closingKeyword(declaration, keyword)));
}

void readInterface(Context &context, const Node &node) {
  const std::string name = context.nameOf(node, "interface");
  if (name.empty() || isInSource(node) || context.isNotBuilt(node, name))
    return;
  context.leaveOutUnknown(node, {"Methods", "Properties", "Inheritance", "documentation",
                                 "InterfaceAsPlainText", "interface"});
  context.leaveOutUnknownExtras(node, {"Inheritance", "Attributes", "InterfaceAsPlainText",
                                       "Method", "Property", "BuildProperties"});
  std::string text = plainDeclaration(node);
  if (text.empty())
    text = fmt::format("{}{}INTERFACE {}{}\n", documentationLines(node), attributeLines(node), name,
                       inheritanceOf(node));
  text += membersOf(context, node, name) + "END_INTERFACE\n";
  context.add(ObjectKind::Pou, node, name, text);
}

} // namespace stc::import::plcopen
