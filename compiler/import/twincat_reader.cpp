#include "compiler/import/twincat_reader.hpp"

#include "compiler/import/st_scan.hpp"
#include "compiler/import/twincat_project.hpp"
#include "compiler/import/unit_text.hpp"
#include "compiler/import/xml_document.hpp"

#include <array>
#include <charconv>

#include <fmt/format.h>

namespace stc::import {

namespace twincat {
namespace {

struct Language {
  std::string_view element;
  std::string_view name;
};

/// Bodies that are drawn: serialised objects, whose meaning is nowhere published.
constexpr std::array<Language, 5> kDrawn = {{
    {"NWL", "a network list (LD, FBD or IL)"},
    {"CFC", "a continuous function chart (CFC)"},
    {"SFC", "a sequential function chart (SFC)"},
    {"IL", "an instruction list of the editor (IL)"},
    {"UML", "a UML chart"},
}};

/// Elements of a POU that are no part of the program.
constexpr std::array<std::string_view, 5> kEditorData = {"Folder", "LineIds", "ObjectProperties",
                                                         "ExtendedData", "Comment"};

std::string_view nameOf(const pugi::xml_node &node) { return node.attribute("Name").as_string(); }

/// Reads the objects of one file.
class Reader {
public:
  Reader(const std::string &file, const XmlDocument &document, Model &model)
      : file_(file), document_(document), model_(model) {}

  void read(const pugi::xml_node &root) {
    for (const pugi::xml_node &node : root.children()) {
      const std::string_view kind = node.name();
      if (kind == "POU" || kind == "Itf")
        addPou(node);
      else if (kind == "DUT")
        addDeclaration(node, ObjectKind::Type, "type");
      else if (kind == "GVL")
        addDeclaration(node, ObjectKind::GlobalList, "global variables");
      else if (kind == "Task")
        addTask(node);
      else if (node.type() == pugi::node_element)
        leaveOut(node, fmt::format("{} {}", kind, nameOf(node)),
                 "objects of this kind are not imported");
    }
  }

private:
  [[nodiscard]] Origin originOf(const pugi::xml_node &node) const {
    return {file_, document_.lineOf(node)};
  }

  void leaveOut(const pugi::xml_node &node, std::string object, std::string why) {
    model_.leftOut.push_back({originOf(node), std::move(object), std::move(why)});
  }

  /// The text of `<Declaration>`; its links to hardware are reported.
  std::string declarationOf(const pugi::xml_node &node, const std::string &object) {
    const pugi::xml_node declaration = node.child("Declaration");
    std::string text = declaration.text().as_string();
    if (!text.empty())
      reportLinks(file_, object, text, document_.lineOf(declaration), model_);
    return text;
  }

  /// The body, or why it cannot be taken.
  void readBody(const pugi::xml_node &node, const std::string &object, Unit &unit) {
    const pugi::xml_node body = node.child("Implementation");
    for (const pugi::xml_node &part : body.children()) {
      if (std::string_view(part.name()) == "ST") {
        unit.body = part.text().as_string();
        continue;
      }
      if (part.type() != pugi::node_element)
        continue;
      std::string what = fmt::format("a body in {}", part.name());
      for (const Language &each : kDrawn)
        if (each.element == part.name())
          what = each.name;
      unit.notImported = fmt::format("{}:{}: {}", stemOf(file_), document_.lineOf(part), what);
      leaveOut(part, object, fmt::format("its body is {}; rewrite it in ST", what));
    }
  }

  Unit unitOf(const pugi::xml_node &node, UnitKind kind, const std::string &owner) {
    Unit unit;
    unit.kind = kind;
    unit.name = nameOf(node);
    const std::string object = owner.empty() ? unit.name : fmt::format("{}.{}", owner, unit.name);
    unit.declaration = declarationOf(node, object);
    readBody(node, object, unit);
    for (const pugi::xml_node &child : node.children())
      readMember(child, object, unit);
    return unit;
  }

  void readMember(const pugi::xml_node &child, const std::string &object, Unit &unit) {
    struct MemberWord {
      std::string_view element;
      UnitKind kind;
    };
    static constexpr std::array<MemberWord, 5> kMembers = {{{"Method", UnitKind::Method},
                                                            {"Property", UnitKind::Property},
                                                            {"Get", UnitKind::Get},
                                                            {"Set", UnitKind::Set},
                                                            {"Action", UnitKind::Action}}};
    const std::string_view element = child.name();
    for (const MemberWord &each : kMembers)
      if (element == each.element) {
        unit.members.push_back(unitOf(child, each.kind, object));
        return;
      }
    if (child.type() != pugi::node_element || element == "Declaration" ||
        element == "Implementation")
      return;
    for (const std::string_view each : kEditorData)
      if (element == each)
        return;
    leaveOut(child, fmt::format("{} {}.{}", element, object, nameOf(child)),
             "parts of this kind are not imported");
  }

  void addPou(const pugi::xml_node &node) {
    const Unit unit = unitOf(node, UnitKind::Pou, {});
    std::string problem;
    std::string text = textOf(unit, problem);
    if (text.empty())
      return leaveOut(node, unit.name, problem);
    model_.objects.push_back({ObjectKind::Pou, unit.name, {}, std::move(text), originOf(node)});
  }

  void addDeclaration(const pugi::xml_node &node, ObjectKind kind, std::string_view what) {
    const std::string name(nameOf(node));
    std::string text = declarationOf(node, name);
    if (text.empty())
      return leaveOut(node, fmt::format("{} {}", what, name), "it is empty");
    if (text.back() != '\n')
      text += '\n';
    model_.objects.push_back({kind, name, {}, std::move(text), originOf(node)});
  }

  /// CycleTime is in microseconds: the file itself says so in a comment.
  void addTask(const pugi::xml_node &node) {
    Task task;
    task.name = asIdentifier(nameOf(node));
    task.origin = originOf(node);
    task.priority = node.child("Priority").text().as_string();
    const std::string_view cycle = node.child("CycleTime").text().as_string();
    unsigned long long microseconds = 0;
    const auto [end, error] =
        std::from_chars(cycle.data(), cycle.data() + cycle.size(), microseconds);
    if (error == std::errc() && end == cycle.data() + cycle.size() && microseconds != 0)
      task.interval = fmt::format("T#{}us", microseconds);
    else
      leaveOut(node, fmt::format("task {}", task.name),
               fmt::format("its CycleTime `{}` is no number of microseconds", cycle));
    for (const pugi::xml_node &call : node.children("PouCall"))
      task.programs.emplace_back(call.child("Name").text().as_string());
    model_.tasks.push_back(std::move(task));
  }

  const std::string &file_;
  const XmlDocument &document_;
  Model &model_;
};

} // namespace
} // namespace twincat

bool isTwinCat(std::string_view text) {
  const auto has = [&](std::string_view sign) { return text.find(sign) != std::string_view::npos; };
  return has("<TcPlcObject") || has("<TcSmProject") || has("<TcSmItem") ||
         (has("developer/msbuild") && has(".Tc"));
}

void readTwinCat(const std::string &file, std::string_view text, Model &model) {
  const auto document = readXml(text);
  if (!document->problem.empty()) {
    model.unreadable.push_back({{file, document->problemLine}, "file", document->problem});
    return;
  }
  const pugi::xml_node root = document->tree.document_element();
  const std::string_view name = root.name();
  if (name == "TcPlcObject")
    twincat::Reader(file, *document, model).read(root);
  else if (name == "Project")
    readPlcProject(file, *document, model);
  else if (name == "TcSmProject" || name == "TcSmItem")
    readSystemProject(file, *document, model);
  else
    model.unreadable.push_back(
        {{file, document->lineOf(root)},
         "file",
         fmt::format("its root is `{}`, which no file of TwinCAT 3 has", name)});
}

} // namespace stc::import
