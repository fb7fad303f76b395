// POUs and their members as PLCopen XML.
#include "compiler/export/plcopen_parts.hpp"

#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stc::exporting {

using namespace ast;

namespace {

const char *elementOf(Section section) {
  switch (section) {
  case Section::Input:
    return "inputVars";
  case Section::Output:
    return "outputVars";
  case Section::InOut:
    return "inOutVars";
  case Section::Temp:
    return "tempVars";
  case Section::External:
    return "externalVars";
  default: // VAR_STAT and VAR_INST are in the declaration as text only
    return "localVars";
  }
}

const char *pouTypeOf(DeclKind kind) {
  return kind == DeclKind::Program    ? "program"
         : kind == DeclKind::Function ? "function"
                                      : "functionBlock";
}

void addBody(Node parent, const DeclarationText &text) {
  const std::string body = trimmedLines(text.body) + trimmedLines(text.tail);
  Node node = parent.append_child("body");
  Writer::addXhtml(node.append_child(isListBody(body) ? "IL" : "ST"), body);
}

/// What is not in the head's text of our own members, but in XML.
void addModifiers(Node interface, Access access, uint8_t modifiers) {
  const char *const name = access == Access::Public      ? "Public"
                           : access == Access::Private   ? "Private"
                           : access == Access::Protected ? "Protected"
                           : access == Access::Internal  ? "Internal"
                                                         : nullptr;
  if (name == nullptr && modifiers == 0)
    return;
  Node node =
      Writer::addData(interface, kCodesys, "accessmodifiers").append_child("AccessModifiers");
  if (name != nullptr)
    node.append_attribute(name) = "true";
  for (const auto &[bit, word] :
       {std::pair{kModAbstract, "Abstract"}, std::pair{kModFinal, "Final"},
        std::pair{kModOverride, "Override"}})
    if ((modifiers & bit) != 0)
      node.append_attribute(word) = "true";
}

void addInheritance(Node parent, const PouDecl &decl) {
  const bool isInterface = decl.kind == DeclKind::Interface;
  if (decl.base.empty() && decl.interfaces.empty())
    return;
  Node node = Writer::addData(parent, kCodesys, "pouinheritance").append_child("Inheritance");
  if (!decl.base.empty())
    node.append_child("Extends").text() = Writer::pathOf(decl.base).c_str();
  for (const NamePath &each : decl.interfaces)
    node.append_child(isInterface ? "Extends" : "Implements").text() = Writer::pathOf(each).c_str();
}

const DeclarationText &textFor(const DeclarationTexts &texts, const Decl &decl) {
  static const DeclarationText kNone;
  const auto found = texts.find(&decl);
  return found == texts.end() ? kNone : found->second;
}

std::string plainOf(const DeclarationText &text) {
  return trimmedLines(text.leading) + trimmedLines(text.declaration);
}

/// `PRIVATE …`, as it stands after GET, without this word.
std::string_view withoutAccess(std::string_view text, Access access) {
  const size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const size_t end = std::min(text.find_first_of(" \t\r\n;:=.([^", begin), text.size());
  const std::string word = lowerCase(text.substr(begin, end - begin));
  const size_t next = std::min(text.find_first_not_of(" \t\r\n", end), text.size());
  // A variable may have such a name.
  const bool variable =
      next < text.size() && std::string_view(":=.([^").find(text[next]) != std::string_view::npos;
  const bool is =
      word == "public" || word == "private" || word == "protected" || word == "internal";
  return access != Access::None && is && !variable ? text.substr(end) : text;
}

} // namespace

void Writer::setQualifiers(Node list, uint8_t qualifiers) {
  for (const auto &[bit, name] :
       {std::pair{kQualConstant, "constant"}, std::pair{kQualRetain, "retain"},
        std::pair{kQualNonRetain, "nonretain"}, std::pair{kQualPersistent, "persistent"}})
    if ((qualifiers & bit) != 0)
      list.append_attribute(name) = "true";
}

void Writer::variables(Node interface, std::span<VarDecl *const> variables) const {
  Node list;
  const VarDecl *last = nullptr;
  for (const VarDecl *each : variables) {
    // Those that the compiler adds have no text of their own.
    if (!each->name || textOf(each->name.span) != each->name.text ||
        each->type->kind == TypeExprKind::Inferred)
      continue;
    if (last == nullptr || last->section != each->section || last->qualifiers != each->qualifiers) {
      list = interface.append_child(elementOf(each->section));
      setQualifiers(list, each->qualifiers);
    }
    last = each;
    variable(list, *each);
  }
}

void Writer::interfaceOf(Node parent, const PouDecl &decl) const {
  Node interface = parent.append_child("interface");
  if (decl.returnType != nullptr)
    type(interface.append_child("returnType"), decl.returnType);
  variables(interface, decl.variables);
  addInheritance(interface, decl);
  addModifiers(interface, decl.access, decl.modifiers);
  addAttributes(interface, decl.attributes);
  addDocumentation(interface, decl.doc);
}

void Writer::method(Node parent, const PouDecl &decl, const DeclarationTexts &texts) const {
  const DeclarationText &text = textFor(texts, decl);
  Node node = parent.append_child("Method");
  node.append_attribute("name") = std::string(decl.name.text).c_str();
  interfaceOf(node, decl);
  if (!chart(node, trimmedLines(text.body) + trimmedLines(text.tail)))
    addBody(node, text);
  addPlainDeclaration(node, plainOf(text));
}

void Writer::accessor(Node property, const char *name, const PouDecl *decl,
                      const PropertyDecl &owner, const DeclarationTexts &texts) const {
  if (decl == nullptr)
    return;
  const DeclarationText &text = textFor(texts, *decl);
  Node node = property.append_child(name);
  Node interface = node.append_child("interface");
  const size_t hidden = decl->returnType == nullptr ? 1 : 0; // SET: the new value
  variables(
      interface,
      std::span<VarDecl *const>(decl->variables).subspan(std::min(hidden, decl->variables.size())));
  if (decl->access != owner.access)
    addModifiers(interface, decl->access, 0);
  // Without the word GET or SET; without variables the specifier stands in the body.
  const std::string_view head =
      std::string_view(text.declaration).substr(std::min<size_t>(3, text.declaration.size()));
  const std::string declarations = trimmedLines(withoutAccess(head, decl->access));
  DeclarationText own = text;
  if (trimmedLines(head).empty())
    own.body = withoutAccess(text.body, decl->access);
  addBody(node, own);
  addPlainDeclaration(node, declarations);
}

void Writer::property(Node parent, const PropertyDecl &decl, const DeclarationTexts &texts) const {
  const DeclarationText &text = textFor(texts, decl);
  Node node = parent.append_child("Property");
  node.append_attribute("name") = std::string(decl.name.text).c_str();
  Node interface = node.append_child("interface");
  type(interface.append_child("returnType"), decl.type);
  addModifiers(interface, decl.access, decl.modifiers);
  addAttributes(interface, decl.attributes);
  addDocumentation(interface, decl.doc);
  accessor(node, "GetAccessor", decl.get, decl, texts);
  accessor(node, "SetAccessor", decl.set, decl, texts);
  // Comments between the accessors are the property's own.
  addPlainDeclaration(node, plainOf(text) + trimmedLines(text.body) + trimmedLines(text.tail));
}

void Writer::members(Node pou, const PouDecl &decl, const DeclarationTexts &texts) const {
  // In the order of the text, as far as the format keeps it.
  for (const PouDecl *each : decl.methods)
    method(addData(pou, kCodesys, "method"), *each, texts);
  for (const PropertyDecl *each : decl.properties)
    property(addData(pou, kCodesys, "property"), *each, texts);
}

Node Writer::pou(Node pous, const PouDecl &decl, const DeclarationTexts &texts, bool whole) const {
  const DeclarationText &text = textFor(texts, decl);
  Node node = pous.append_child("pou");
  node.append_attribute("name") = std::string(decl.name.text).c_str();
  node.append_attribute("pouType") = pouTypeOf(decl.kind);
  interfaceOf(node, decl);
  if (!decl.actions.empty()) {
    Node actions = node.append_child("actions");
    for (const PouDecl *each : decl.actions) {
      Node action = actions.append_child("action");
      action.append_attribute("name") = std::string(each->name.text).c_str();
      DeclarationText own = textFor(texts, *each);
      own.body = trimmedLines(own.leading) + own.body;
      if (!chart(action, own.body))
        addBody(action, own);
    }
  }
  if (!chart(node, trimmedLines(text.body) + trimmedLines(text.tail)))
    addBody(node, text);
  if (whole)
    addData(node, kStride, "insource").append_child("InSource");
  else
    addPlainDeclaration(node, plainOf(text));
  members(node, decl, texts);
  return node;
}

Node Writer::interface(Node project, const PouDecl &decl, const DeclarationTexts &texts,
                       bool whole) const {
  const DeclarationText &text = textFor(texts, decl);
  Node node = addData(project, kCodesys, "interface").append_child("Interface");
  node.append_attribute("name") = std::string(decl.name.text).c_str();
  Node methods = node.append_child("Methods");
  for (const PouDecl *each : decl.methods)
    method(methods, *each, texts);
  Node properties = node.append_child("Properties");
  for (const PropertyDecl *each : decl.properties)
    property(properties, *each, texts);
  addInheritance(node, decl);
  if (whole)
    addData(node, kStride, "insource").append_child("InSource");
  else
    addPlainDeclaration(node, plainOf(text) + trimmedLines(text.body) + trimmedLines(text.tail));
  addDocumentation(node, decl.doc);
  return node;
}

} // namespace stc::exporting
