#include "compiler/export/plcopen_writer.hpp"

#include "compiler/export/plcopen_parts.hpp"
#include "compiler/source/content_hash.hpp"
#include "compiler/source/identifier.hpp"
#include "compiler/source/toml_sections.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>

namespace stc::exporting {

using namespace ast;

std::string trimmedLines(std::string_view text) {
  const size_t last = text.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos)
    return {};
  const size_t first = text.find_first_not_of(" \t\r\n");
  const size_t line = text.rfind('\n', first);
  const size_t begin = line == std::string_view::npos ? 0 : line + 1;
  return std::string(text.substr(begin, last + 1 - begin)) + "\n";
}

Node Writer::addData(Node parent, std::string_view space, std::string_view name,
                     const char *handleUnknown) {
  Node add = parent.child("addData");
  if (!add)
    add = parent.append_child("addData");
  Node data = add.append_child("data");
  data.append_attribute("name") = fmt::format("{}{}", space, name).c_str();
  data.append_attribute("handleUnknown") = handleUnknown;
  return data;
}

void Writer::addXhtml(Node parent, std::string_view text) {
  std::string clean;
  for (const char c : text)
    if (c != '\r')
      clean += static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' ? ' ' : c;
  Node node = parent.append_child("xhtml");
  node.append_attribute("xmlns") = "http://www.w3.org/1999/xhtml";
  node.text() = clean.c_str();
}

void Writer::addDocumentation(Node parent, std::string_view text) {
  if (!text.empty())
    addXhtml(parent.append_child("documentation"), text);
}

void Writer::addPlainDeclaration(Node parent, std::string_view text) {
  if (!text.empty())
    addXhtml(addData(parent, kCodesys, "interfaceasplaintext").append_child("InterfaceAsPlainText"),
             text);
}

void Writer::addAttributes(Node parent, Attributes attributes) const {
  if (attributes.empty())
    return;
  Node list = addData(parent, kCodesys, "attributes").append_child("Attributes");
  for (const Attribute &each : attributes) {
    Node one = list.append_child("Attribute");
    one.append_attribute("Name") = std::string(each.name).c_str();
    one.append_attribute("Value") = std::string(each.value).c_str();
  }
}

std::string Writer::textOf(Span span) const {
  return span.valid() ? std::string(project_.sources().text(span)) : std::string();
}

std::string Writer::pathOf(NamePath path) {
  std::string text;
  for (const Name &each : path)
    text += fmt::format("{}{}", text.empty() ? "" : ".", each.text);
  return text;
}

namespace {

/// Builds the whole file.
class FileBuilder {
public:
  FileBuilder(const Project &project, const PlcOpenOptions &options)
      : project_(project), options_(options), writer_(project) {}

  PlcOpenFile build() {
    head();
    Node types = root_.append_child("types");
    dataTypes_ = types.append_child("dataTypes");
    pous_ = types.append_child("pous");
    Node configuration = root_.append_child("instances")
                             .append_child("configurations")
                             .append_child("configuration");
    configuration.append_attribute("name") = "Device";
    resource_ = configuration.append_child("resource");
    resource_.append_attribute("name") = "Application";
    readTexts();
    writer_.tasks(resource_);
    addHardware();
    addStructure();
    for (const File *file : files_)
      add(*file);
    if (hasConfiguration_)
      Writer::addData(configuration, kStride, "insource").append_child("InSource");
    PlcOpenFile out;
    std::ostringstream text;
    document_.save(text, "  ", pugi::format_default, pugi::encoding_utf8);
    out.xml = text.str();
    out.notes = std::move(notes_);
    return out;
  }

private:
  [[nodiscard]] const SourceFile &sourceOf(const File &file) const {
    return project_.sources().file(file.id);
  }

  void head() {
    Node declaration = document_.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "utf-8";
    root_ = document_.append_child("project");
    root_.append_attribute("xmlns") = options_.version == PlcOpenVersion::V200
                                          ? "http://www.plcopen.org/xml/tc6_0200"
                                          : "http://www.plcopen.org/xml/tc6_0201";
    Node file = root_.append_child("fileHeader");
    file.append_attribute("companyName") = "";
    file.append_attribute("productName") = "Stride";
    file.append_attribute("productVersion") = "1";
    file.append_attribute("creationDateTime") = options_.date.c_str();
    Node content = root_.append_child("contentHeader");
    content.append_attribute("name") = project_.name().c_str();
    content.append_attribute("modificationDateTime") = options_.date.c_str();
    Node coordinates = content.append_child("coordinateInfo");
    for (const char *each : {"fbd", "ld", "sfc"}) {
      Node scaling = coordinates.append_child(each).append_child("scaling");
      scaling.append_attribute("x") = "1";
      scaling.append_attribute("y") = "1";
    }
  }

  /// Of all files first: a member may stand in another file than its block.
  void readTexts() {
    std::set<FileId> seen; // what a CONFIGURATION declares is a second tree of its file
    for (const File *file : project_.program().files) {
      if (sourceOf(*file).isSynthetic() || !seen.insert(file->id).second)
        continue;
      files_.push_back(file);
      FileTexts texts = declarationTexts(*file, sourceOf(*file).text());
      texts_.merge(texts.texts);
      whole_[file] = texts.onlyAsAWhole;
    }
  }

  /// What stride.toml says of inputs, outputs, drives and axes: no element of the format has it.
  void addHardware() {
    std::string text;
    for (FileId id = 1; id <= project_.sources().size(); ++id) {
      const SourceFile &file = project_.sources().file(id);
      if (file.name() != "stride.toml" || file.isSynthetic())
        continue;
      for (const TomlSectionText &each : tomlSections(file.text()))
        if (std::ranges::find(kHardwareSections, each.name) != kHardwareSections.end())
          text += each.text;
      break;
    }
    if (!text.empty())
      Writer::addXhtml(Writer::addData(root_, kStride, "hardware").append_child("Hardware"), text);
  }

  /// Folders are said only when there are some.
  void addStructure() {
    if (std::ranges::any_of(files_, [&](const File *each) { return !folderOf(*each).empty(); }))
      structure_ = Writer::addData(root_, kCodesys, "projectstructure", "discard")
                       .append_child("ProjectStructure");
  }

  [[nodiscard]] std::filesystem::path folderOf(const File &file) const {
    return std::filesystem::path(sourceOf(file).name()).lexically_normal().parent_path();
  }

  /// Puts an object into the folder of its file. CODESYS knows objects by identifications, which
  /// are the same each time here.
  void placeObject(Node node, const std::string &name, const File &file) {
    if (!structure_)
      return;
    Node folder = structure_;
    for (const std::filesystem::path &part : folderOf(file)) {
      Node below = folder.find_child_by_attribute("Folder", "Name", part.c_str());
      if (!below) {
        below = folder.append_child("Folder");
        below.append_attribute("Name") = part.c_str();
      }
      folder = below;
    }
    const std::string hash =
        blake2b256(fmt::format("{}:{}:{}", project_.name(), node.name(), lowerCase(name)));
    const std::string id = fmt::format("{}-{}-4{}-a{}-{}", hash.substr(0, 8), hash.substr(8, 4),
                                       hash.substr(13, 3), hash.substr(17, 3), hash.substr(20, 12));
    if (node.name() == std::string_view("Interface") || node.name() == std::string_view("Source"))
      node.append_attribute("ObjectId") = id.c_str();
    else
      Writer::addData(node, kCodesys, "objectid", "discard").append_child("ObjectId").text() =
          id.c_str();
    Node object = folder.append_child("Object");
    object.append_attribute("Name") = name.c_str();
    object.append_attribute("ObjectId") = id.c_str();
  }

  void add(const File &file) {
    const bool whole = whole_[&file];
    const std::string stem = std::filesystem::path(sourceOf(file).name()).stem().string();
    std::map<std::string, std::vector<const GlobalsDecl *>> lists;
    for (const Decl *decl : file.declarations) {
      Node node;
      switch (decl->kind) {
      case DeclKind::Structure:
      case DeclKind::Enumeration:
      case DeclKind::Alias:
        node = writer_.dataType(dataTypes_, root_, *decl, texts_[decl], whole);
        break;
      case DeclKind::Globals:
        lists[decl->name ? std::string(decl->name.text) : stem].push_back(as<GlobalsDecl>(decl));
        break;
      case DeclKind::Interface:
        node = writer_.interface(root_, *static_cast<const PouDecl *>(decl), texts_, whole);
        break;
      case DeclKind::Configuration:
        hasConfiguration_ = true;
        break;
      case DeclKind::Config:
      case DeclKind::Access:
        break;
      default:
        node = writer_.pou(pous_, *static_cast<const PouDecl *>(decl), texts_, whole);
        break;
      }
      if (node && !whole)
        placeObject(node, std::string(decl->name.text), file);
    }
    for (const auto &[name, blocks] : lists) {
      Node node = writer_.globals(resource_, name, blocks, texts_, whole);
      if (!whole)
        placeObject(node, name, file);
    }
    if (whole)
      addSource(file, stem);
  }

  void addSource(const File &file, const std::string &stem) {
    Node source = Writer::addData(root_, kStride, "source").append_child("Source");
    source.append_attribute("name") = stem.c_str();
    Writer::addXhtml(source, sourceOf(file).text());
    placeObject(source, stem, file);
    notes_.push_back(fmt::format("{}: other tools do not get its namespaces, conditional pragmas, "
                                 "CONFIGURATION, VAR_CONFIG or VAR_ACCESS",
                                 sourceOf(file).name()));
  }

  const Project &project_;
  const PlcOpenOptions &options_;
  const Writer writer_;
  pugi::xml_document document_;
  Node root_;
  Node dataTypes_;
  Node pous_;
  Node resource_;
  Node structure_;                  ///< null: all files lie in the project's own folder
  std::vector<const File *> files_; ///< of the project itself
  DeclarationTexts texts_;
  std::map<const File *, bool> whole_;
  bool hasConfiguration_ = false;
  std::vector<std::string> notes_;
};

} // namespace

PlcOpenFile plcOpenFile(const Project &project, const PlcOpenOptions &options) {
  return FileBuilder(project, options).build();
}

} // namespace stc::exporting
