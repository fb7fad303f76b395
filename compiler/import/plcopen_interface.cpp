// Variables of POUs and global variables of PLCopen XML.
#include "compiler/import/plcopen_context.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

struct SectionKind {
  std::string_view element;
  std::string_view keyword;
};

constexpr std::array<SectionKind, 10> kSections = {{
    {"localVars", "VAR"},
    {"tempVars", "VAR_TEMP"},
    {"inputVars", "VAR_INPUT"},
    {"outputVars", "VAR_OUTPUT"},
    {"inOutVars", "VAR_IN_OUT"},
    {"externalVars", "VAR_EXTERNAL"},
    {"globalVars", "VAR_GLOBAL"},
    {"staticVars", "VAR_STAT"},
    {"instanceVars", "VAR_INST"},
    {"accessVars", "VAR_ACCESS"},
}};

std::string_view keywordOf(std::string_view element) {
  for (const SectionKind &each : kSections)
    if (each.element == element)
      return each.keyword;
  return {};
}

std::string qualifiersOf(const Node &list) {
  std::string text;
  if (isTrue(list, "constant"))
    text += " CONSTANT";
  if (isTrue(list, "retain"))
    text += " RETAIN";
  if (isTrue(list, "nonretain"))
    text += " NON_RETAIN";
  if (isTrue(list, "persistent"))
    text += " PERSISTENT";
  return text;
}

/// The lists of MixedAttrsVarList, in which CODESYS keeps the blocks of a list that differ in their
/// qualifiers; without it the list itself.
std::vector<Node> blocksOf(const Node &list) {
  const Node mixed = extra(list, "MixedAttrsVarList");
  if (!mixed)
    return {list};
  std::vector<Node> blocks = children(mixed);
  // What stands in the list itself is one of the blocks; if not, it goes first.
  const auto has = [&](const Node &variable) {
    return std::any_of(blocks.begin(), blocks.end(), [&](const Node &block) {
      const std::vector<Node> variables = children(block, "variable");
      return std::any_of(variables.begin(), variables.end(), [&](const Node &each) {
        return sameName(attribute(each, "name"), attribute(variable, "name"));
      });
    });
  };
  const std::vector<Node> own = children(list, "variable");
  if (!own.empty() && !has(own.front()))
    blocks.insert(blocks.begin(), list);
  return blocks;
}

} // namespace

std::string sectionText(Context &context, const Node &list, std::string_view keyword,
                        const std::string &owner) {
  context.leaveOutUnknown(list, {"variable", "documentation"});
  const std::string lines = variableLines(context, list, owner);
  if (lines.empty())
    return {};
  return fmt::format("{}{}{}\n{}END_VAR\n", documentationLines(list), keyword, qualifiersOf(list),
                     lines);
}

std::string sectionsText(Context &context, const Node &interface, const std::string &owner) {
  std::string text;
  for (const Node &each : children(interface)) {
    const std::string_view keyword = keywordOf(localName(each));
    if (keyword.empty())
      continue;
    if (keyword == "VAR_GLOBAL") {
      readGlobals(context, each, owner + "_Globals");
      context.changed(each, owner, "its global variables became a list of their own");
      continue;
    }
    context.leaveOutUnknownExtras(each, {"MixedAttrsVarList", "Attributes"});
    for (const Node &block : blocksOf(each)) {
      const std::string_view own = keywordOf(localName(block));
      text += sectionText(context, block, own.empty() ? keyword : own, owner);
    }
  }
  return text;
}

void readGlobals(Context &context, const Node &list, const std::string &fallbackName) {
  if (isInSource(list))
    return;
  std::string name = attribute(list, "name");
  if (!isName(name)) {
    if (!name.empty())
      context.changed(list, fmt::format("list `{}`", name),
                      fmt::format("its name is no identifier; it became {}", fallbackName));
    name = fallbackName;
  }
  context.leaveOutUnknownExtras(list, {"MixedAttrsVarList", "Attributes", "InterfaceAsPlainText"});
  std::string text = plainDeclaration(list);
  if (text.empty())
    for (const Node &block : blocksOf(list)) {
      const std::string section = sectionText(context, block, "VAR_GLOBAL", name);
      if (!section.empty())
        text += (text.empty() ? "" : "\n") + attributeLines(list) + section;
    }
  if (text.empty())
    return;
  std::vector<Object> &objects = context.model().objects;
  const Origin origin = context.originOf(list);
  for (Object &each : objects)
    if (each.kind == ObjectKind::GlobalList && sameName(each.name, name) &&
        each.origin.file == origin.file) {
      each.text += "\n" + text;
      return;
    }
  context.add(ObjectKind::GlobalList, list, name, text);
}

} // namespace stc::import::plcopen
