#include "compiler/import/plcopen_context.hpp"

#include "compiler/import/exp_lines.hpp"

#include "compiler/import/texts.hpp"
#include "compiler/source/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

bool contains(std::initializer_list<std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Elements of addData that say nothing about the program: identification, dates of the tool.
bool isIdentification(std::string_view element) {
  return contains({"ObjectId", "ProjectInformation", "ProjectStructure"}, element);
}

/// The lines after CommentState; nothing when a comment has no end.
std::optional<std::string> withComments(std::string_view text, bool nested) {
  CommentState state(nested);
  std::string result;
  for (const std::string_view line : import::linesOf(text))
    result += state.line(line) + "\n";
  return state.inside() ? std::nullopt : std::optional(std::move(result));
}

/// Text in apostrophes as a pragma holds it.
std::string quotedText(std::string_view text) { return fmt::format("'{}'", quotedForSt(text)); }

} // namespace

std::vector<Node> children(const Node &node, std::string_view name) {
  std::vector<Node> found;
  for (const Node &each : node.children())
    if (each.type() == pugi::node_element && (name.empty() || localName(each) == name))
      found.push_back(each);
  return found;
}

Node firstElement(const Node &node) {
  for (const Node &each : node.children())
    if (each.type() == pugi::node_element)
      return each;
  return {};
}

std::string linesOf(const Node &node) {
  std::string text = textOf(node);
  const size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string::npos)
    return {};
  text.resize(last + 1);
  const size_t first = text.find_first_not_of(" \t\r\n");
  const size_t line = text.rfind('\n', first);
  return text.substr(line == std::string::npos ? 0 : line + 1) + "\n";
}

std::string attribute(const Node &node, const char *name) { return node.attribute(name).value(); }

bool isName(std::string_view text) {
  const auto isLetter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !text.empty() && isLetter(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [&](char c) { return isLetter(c) || (c >= '0' && c <= '9'); });
}

bool sameName(std::string_view a, std::string_view b) {
  return stride::common::lowerCase(std::string(a)) == stride::common::lowerCase(std::string(b));
}

std::vector<Extra> extrasOf(const Node &node) {
  std::vector<Extra> extras;
  for (const Node &add : children(node, "addData"))
    for (const Node &data : children(add, "data")) {
      bool any = false;
      for (const Node &element : children(data)) {
        extras.push_back({attribute(data, "name"), element, data});
        any = true;
      }
      if (!any)
        extras.push_back({attribute(data, "name"), {}, data});
    }
  return extras;
}

Node extra(const Node &node, std::string_view name) {
  for (const Node &add : children(node, "addData"))
    for (const Node &data : children(add, "data"))
      if (const Node found = child(data, name))
        return found;
  return {};
}

void Context::changed(const Node &node, std::string object, std::string text) {
  model_.changed.push_back({originOf(node), std::move(object), std::move(text)});
}

void Context::leftOut(const Node &node, std::string object, std::string text) {
  model_.leftOut.push_back({originOf(node), std::move(object), std::move(text)});
}

void Context::leaveOutUnknown(const Node &node, std::initializer_list<std::string_view> known) {
  for (const Node &each : children(node)) {
    const std::string_view name = localName(each);
    if (name == "addData" || contains(known, name))
      continue;
    Unknown &entry = unknown_[fmt::format("element {} in {}", name, localName(node))];
    if (entry.count++ == 0)
      entry.origin = originOf(each);
  }
}

void Context::leaveOutUnknownExtras(const Node &node,
                                    std::initializer_list<std::string_view> known) {
  for (const Extra &each : extrasOf(node)) {
    const std::string_view name = localName(each.element);
    if (contains(known, name) || isIdentification(name))
      continue;
    Unknown &entry = unknown_[fmt::format("addData {} of {}", each.name, localName(node))];
    if (entry.count++ == 0)
      entry.origin = originOf(each.data);
  }
}

void Context::finish() {
  std::vector<Remark> remarks;
  for (const auto &[what, unknown] : unknown_)
    remarks.push_back(
        {unknown.origin, what,
         unknown.count == 1
             ? std::string("its meaning is not known here")
             : fmt::format("its meaning is not known here ({} in this file)", unknown.count)});
  std::stable_sort(remarks.begin(), remarks.end(),
                   [](const Remark &a, const Remark &b) { return a.origin.line < b.origin.line; });
  model_.leftOut.insert(model_.leftOut.end(), remarks.begin(), remarks.end());
}

std::string Context::nameOf(const Node &node, std::string_view kind) {
  std::string name = attribute(node, "name");
  if (isName(name))
    return name;
  leftOut(node, fmt::format("{} `{}`", kind, name),
          name.empty() ? "it has no name" : "its name is no identifier");
  return {};
}

bool Context::isNotBuilt(const Node &node, const std::string &name) {
  const Node properties = extra(node, "BuildProperties");
  if (!sameName(textOf(child(properties, "ExcludeFromBuild")), "true"))
    return false;
  changed(properties, name, "dropped: it is excluded from the build there");
  return true;
}

std::vector<std::string> Context::folderOf(const Node &node) const {
  std::string id = attribute(node, "ObjectId");
  if (id.empty())
    id = textOf(extra(node, "ObjectId"));
  const auto found = folders_.find(id.empty() ? attribute(node, "name") : id);
  return found == folders_.end() ? std::vector<std::string>() : found->second;
}

void Context::add(ObjectKind kind, const Node &node, std::string name, std::string text) {
  // The file does not say whether comments nest; most tools that are not CODESYS do not do that.
  if (!withComments(text, true))
    if (std::optional<std::string> other = withComments(text, false)) {
      text = std::move(*other);
      changed(node, name, "comments that stand in comments: each `(*` in them became `( *`");
    }
  model_.objects.push_back(
      {kind, std::move(name), folderOf(node), std::move(text), originOf(node)});
}

std::string Context::addHelperType(const Node &node, const std::string &owner,
                                   const std::string &text) {
  std::string name = fmt::format("{}_type{}", asIdentifier(owner), ++helperTypes_);
  add(ObjectKind::Type, node, name, fmt::format("TYPE {} :\n{}\nEND_TYPE\n", name, text));
  changed(node, owner, fmt::format("its type is declared in line; it became {}", name));
  return name;
}

std::string attributeLines(const Node &node, const std::string &indent) {
  std::string text;
  for (const Node &each : children(extra(node, "Attributes"), "Attribute")) {
    const std::string value = attribute(each, "Value");
    text += fmt::format("{}{{attribute {}{}}}\n", indent, quotedText(attribute(each, "Name")),
                        value.empty() ? std::string() : " := " + quotedText(value));
  }
  return text;
}

std::string commentLines(std::string_view text, const std::string &indent, std::string_view sign) {
  std::string result;
  for (std::string_view line : import::linesOf(text)) {
    line = trimmed(line);
    result += fmt::format("{}{}{}{}\n", indent, sign, line.empty() ? "" : " ", line);
  }
  return result;
}

std::string documentationLines(const Node &node, const std::string &indent) {
  return commentLines(linesOf(child(node, "documentation")), indent);
}

bool isInSource(const Node &node) { return !extra(node, "InSource").empty(); }

std::string plainDeclaration(const Node &node) {
  if (const Node plain = extra(node, "InterfaceAsPlainText"))
    return linesOf(plain);
  return linesOf(child(node, "InterfaceAsPlainText"));
}

} // namespace stc::import::plcopen
