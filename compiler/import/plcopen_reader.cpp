#include "compiler/import/plcopen_reader.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/libraries.hpp"
#include "compiler/import/plcopen_context.hpp"
#include "compiler/source/toml_sections.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stc::import {

namespace plcopen {

namespace {

/// Part of all namespaces: tc6.xsd, tc6_0200, tc6_0201.
constexpr std::string_view kNamespace = "http://www.plcopen.org/xml/tc6";

/// Identifications of objects, and in which folders of the tool's tree they are.
void readFolders(Context &context, const Node &node, std::vector<std::string> &folders) {
  for (const Node &each : children(node)) {
    const std::string_view kind = localName(each);
    if (kind != "Folder" && kind != "Object")
      continue;
    const std::string name = attribute(each, "Name");
    if (kind == "Object") {
      const std::string id = attribute(each, "ObjectId");
      context.setFolder(id.empty() ? name : id, folders);
      readFolders(context, each, folders);
      continue;
    }
    std::vector<std::string> below = foldersOf("\\/" + name);
    folders.insert(folders.end(), below.begin(), below.end());
    readFolders(context, each, folders);
    folders.resize(folders.size() - below.size());
  }
}

void readTypes(Context &context, const Node &types) {
  context.leaveOutUnknown(types, {"dataTypes", "pous"});
  context.leaveOutUnknown(child(types, "dataTypes"), {"dataType"});
  context.leaveOutUnknown(child(types, "pous"), {"pou"});
  for (const Node &each : children(child(types, "dataTypes"), "dataType"))
    readDataType(context, each);
  for (const Node &each : children(child(types, "pous"), "pou"))
    readPou(context, each);
}

void readExtra(Context &context, const Node &element, const std::string &listName) {
  const std::string_view kind = localName(element);
  if (kind == "pou")
    readPou(context, element);
  else if (kind == "dataType")
    readDataType(context, element);
  else if (kind == "union")
    readUnion(context, element);
  else if (kind == "globalVars")
    readGlobals(context, element, listName);
  else if (kind == "Interface")
    readInterface(context, element);
  else if (kind == "Libraries")
    for (const Node &each : children(element, "Library"))
      context.model().libraries.push_back(
          libraryNamed(attribute(each, "Name"), context.originOf(each)));
  else if (kind == "resource")
    readExtras(context, element, listName);
}

/// Text that `stride export plcopen` keeps because no element can say it.
void readSource(Context &context, const Node &element) {
  const std::string name = attribute(element, "name");
  context.add(ObjectKind::Source, element, isName(name) ? name : "Source", linesOf(element));
}

/// Sections of stride.toml that `stride export plcopen` keeps: of those that it does, nothing else.
void readHardware(Context &context, const Node &element) {
  const std::string text = linesOf(element);
  for (const TomlSectionText &each : tomlSections(text)) {
    const std::string name(each.name);
    if (std::ranges::find(kHardwareSections, each.name) == kHardwareSections.end()) {
      context.leftOut(element, fmt::format("section {}", name),
                      "only sections about inputs, outputs and drives are taken");
      continue;
    }
    std::vector<ManifestSection> &all = context.model().sections;
    if (!all.empty() && all.back().name == name)
      all.back().text += each.text;
    else
      all.push_back({name, std::string(each.text), context.originOf(element)});
  }
}

} // namespace

void readExtras(Context &context, const Node &node, const std::string &listName) {
  for (const Extra &each : extrasOf(node))
    if (localName(each.element) == "Source")
      readSource(context, each.element);
    else if (localName(each.element) == "Hardware")
      readHardware(context, each.element);
    else
      readExtra(context, each.element, listName);
  context.leaveOutUnknownExtras(node, {"pou", "dataType", "union", "globalVars", "Interface",
                                       "Libraries", "resource", "Source", "Hardware"});
}

} // namespace plcopen

bool isPlcOpen(std::string_view text) {
  return text.find(plcopen::kNamespace) != std::string_view::npos;
}

void readPlcOpen(const std::string &file, std::string_view text, Model &model) {
  const std::unique_ptr<XmlDocument> document = readXml(text);
  if (!document->problem.empty()) {
    model.unreadable.push_back({{file, document->problemLine}, "file", document->problem});
    return;
  }
  plcopen::Context context(file, *document, model);
  const plcopen::Node project = plcopen::firstElement(document->tree);
  if (localName(project) != "project") {
    model.unreadable.push_back(
        {context.originOf(project), fmt::format("element {}", localName(project)),
         "a PLCopen XML file begins with the element project; export the project as PLCopen XML"});
    return;
  }
  std::vector<std::string> folders;
  plcopen::readFolders(context, plcopen::extra(project, "ProjectStructure"), folders);
  context.leaveOutUnknown(project,
                          {"fileHeader", "contentHeader", "types", "instances", "documentation"});
  context.leaveOutUnknown(child(project, "contentHeader"),
                          {"coordinateInfo", "Comment", "addDataInfo"});
  context.leaveOutUnknownExtras(child(project, "contentHeader"), {});
  plcopen::readTypes(context, child(project, "types"));
  plcopen::readInstances(context, child(project, "instances"));
  plcopen::readExtras(context, project, "Global_Variables");
  context.finish();
}

} // namespace stc::import
