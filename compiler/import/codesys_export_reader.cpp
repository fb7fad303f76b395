#include "compiler/import/codesys_export_reader.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/libraries.hpp"
#include "compiler/import/st_scan.hpp"
#include "compiler/import/unit_text.hpp"
#include "compiler/import/xml_document.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

namespace stc::import {

namespace v3 {
namespace {

/// Objects that lie in each other; more is a circle.
constexpr size_t kDeepest = 64;

enum class Kind {
  Pou,
  Type,
  Globals,
  Method,
  Property,
  Accessor,
  Action,
  Folder,
  Container, ///< only holds other objects
  Libraries,
  Task,
  LeftOut,
};

struct TypeOfObject {
  std::string_view guid;
  Kind kind;
  std::string_view name;
};

/// Types of objects as public exports and scripts have them.
constexpr std::array<TypeOfObject, 34> kTypes = {{
    {"6f9dac99-8de1-4efc-8465-68ac443b7d08", Kind::Pou, "POU"},
    {"6654496c-404d-479a-aad2-8551054e5f1e", Kind::Pou, "interface"},
    {"2db5746d-d284-4425-9f7f-2663a34b0ebc", Kind::Type, "type"},
    {"40989022-e4d2-4dc7-89d2-9a412930b20e", Kind::Type, "enumeration"},
    {"ffbfa93a-b94d-45fc-a329-229860183b1d", Kind::Globals, "global variables"},
    {"261bd6e6-249c-4232-bb6f-84c2fbeef430", Kind::Globals, "persistent variables"},
    {"f89f7675-27f3-455b-b98a-243e8673a5a8", Kind::Globals, "parameter list"},
    {"f8a58466-d7f6-439f-bbb8-d4600e41d099", Kind::Method, "method"},
    {"f89f7675-27f1-46b3-8abb-b7da8e774ffd", Kind::Method, "method"},
    {"62ebfd1c-d342-43e5-8efb-f22b6d8e4a04", Kind::Method, "method"},
    {"5a3b8626-d3e9-4f37-98b5-66420063d91e", Kind::Property, "property"},
    {"792f2eb6-721e-4e64-ba20-bc98351056db", Kind::Accessor, "accessor"},
    {"28747452-a93d-4b34-8d05-d2c6018edd7d", Kind::Accessor, "accessor"},
    {"8ac092e5-3128-4e26-9e7e-11016c6684f2", Kind::Action, "action"},
    {"738bea1e-99bb-4f04-90bb-a7a567e74e3a", Kind::Folder, "folder"},
    {"225bfe47-7336-4dbc-9419-4105a7c831fa", Kind::Container, "device"},
    {"40b404f9-e5dc-42c6-907f-c89f4a517386", Kind::Container, "PLC logic"},
    {"639b491f-5557-464c-af91-1471bac9f549", Kind::Container, "application"},
    {"ae1de277-a207-4a28-9efb-456c06bd52f3", Kind::Container, "task configuration"},
    {"8753fe6f-4a22-4320-8103-e553c4fc8e04", Kind::Container, "project settings"},
    {"085afe48-c5d8-4ea5-ab0d-b35701fa6009", Kind::Container, "project information"},
    {"413e2a7d-adb1-4d2c-be29-6ae6e4fab820", Kind::Container, "call of a POU"},
    {"adb5cb65-8e1d-4a00-b70a-375ea27582f3", Kind::Libraries, "library manager"},
    {"98a2708a-9b18-4f31-82ed-a1465b24fa2d", Kind::Task, "task"},
    {"a10c6218-cb94-436f-91c6-e1652575253d", Kind::LeftOut, "transition"},
    {"f18bec89-9fef-401d-9953-2f11739a6808", Kind::LeftOut, "visualization"},
    {"4d3fdb8f-ab50-4c35-9d3a-d4bb9bb9a628", Kind::LeftOut, "visualization manager"},
    {"bc63f5fa-d286-4786-994e-7b27e4f97bd5", Kind::LeftOut, "target visualization"},
    {"0fdbf158-1ae0-47d9-9269-cd84be308e9d", Kind::LeftOut, "web visualization"},
    {"bb0b9044-714e-4614-ad3e-33cbdf34d16b", Kind::LeftOut, "image pool"},
    {"2bef0454-1bd3-412a-ac2c-af0f31dbc40f", Kind::LeftOut, "text list"},
    {"63784cbb-9ba0-45e6-9d69-babf3f040511", Kind::LeftOut, "global text list"},
    {"327b6465-4e7f-4116-846a-8369c730fd66", Kind::LeftOut, "external variables"},
    {"e9159722-55bc-49e5-8034-fbd278ef718f", Kind::LeftOut, "SoftMotion axis pool"},
}};

constexpr std::string_view kPersistent = "261bd6e6-249c-4232-bb6f-84c2fbeef430";

/// An object of the dump.
struct Entry {
  pugi::xml_node object; ///< what it is made of
  std::string guid;
  std::string parent;
  std::string name;
  std::string typeGuid;
  const TypeOfObject *type = nullptr;
  std::vector<size_t> members; ///< methods and the like, by index
};

/// The child with this Name; every element of the dump is a Single, a List or an Array.
pugi::xml_node named(const pugi::xml_node &node, const char *name) {
  return node.find_child_by_attribute("Name", name);
}

std::string textAt(const pugi::xml_node &node, const char *name) {
  return named(node, name).text().as_string();
}

/// The text of a document, which older versions keep line by line.
bool documentOf(const pugi::xml_node &section, std::string &text) {
  const pugi::xml_node document = named(section, "TextDocument");
  if (const pugi::xml_node blob = named(document, "TextBlobForSerialisation")) {
    text = blob.text().as_string();
    return true;
  }
  const pugi::xml_node lines = named(document, "TextLines");
  for (const pugi::xml_node &line : lines.children())
    text += textAt(line, "Text") + "\n";
  return !lines.empty();
}

class Reader {
public:
  Reader(const std::string &file, const XmlDocument &document, Model &model)
      : file_(file), document_(document), model_(model) {}

  void read() {
    collect();
    attachMembers();
    for (const Entry &entry : entries_)
      add(entry);
  }

private:
  [[nodiscard]] Origin originOf(const Entry &entry) const {
    return {file_, document_.lineOf(entry.object)};
  }

  void leaveOut(const Entry &entry, std::string why) {
    model_.leftOut.push_back(
        {originOf(entry),
         fmt::format("{} {}", entry.type == nullptr ? "object" : entry.type->name, entry.name),
         std::move(why)});
  }

  void collect() {
    struct Collector : pugi::xml_tree_walker {
      explicit Collector(Reader &reader) : owner(reader) {}
      bool for_each(pugi::xml_node &node) override {
        if (std::string_view(node.attribute("Name").as_string()) == "MetaObject")
          owner.addEntry(node);
        return true;
      }
      Reader &owner;
    };
    Collector collector(*this);
    pugi::xml_node root = document_.tree.document_element();
    root.traverse(collector);
  }

  void addEntry(const pugi::xml_node &meta) {
    Entry entry;
    entry.object = named(meta.parent(), "Object");
    if (!entry.object)
      entry.object = meta;
    entry.guid = stride::common::lowerCase(textAt(meta, "Guid"));
    entry.parent = stride::common::lowerCase(textAt(meta, "ParentGuid"));
    entry.name = textAt(meta, "Name");
    entry.typeGuid = stride::common::lowerCase(textAt(meta, "TypeGuid"));
    for (const TypeOfObject &each : kTypes)
      if (each.guid == entry.typeGuid)
        entry.type = &each;
    byGuid_.emplace(entry.guid, entries_.size());
    entries_.push_back(std::move(entry));
  }

  [[nodiscard]] Entry *parentOf(const Entry &entry) {
    const auto found = byGuid_.find(entry.parent);
    return found == byGuid_.end() ? nullptr : &entries_[found->second];
  }

  [[nodiscard]] static bool isMember(const Entry &entry) {
    if (entry.type == nullptr)
      return false;
    const Kind kind = entry.type->kind;
    return kind == Kind::Method || kind == Kind::Property || kind == Kind::Accessor ||
           kind == Kind::Action;
  }

  /// Members may lie in folders of their POU.
  void attachMembers() {
    for (size_t i = 0; i < entries_.size(); ++i) {
      if (!isMember(entries_[i]))
        continue;
      Entry *owner = parentOf(entries_[i]);
      for (size_t depth = 0; depth < kDeepest && owner != nullptr && owner->type != nullptr &&
                             owner->type->kind == Kind::Folder;
           ++depth)
        owner = parentOf(*owner);
      const bool accessor = entries_[i].type->kind == Kind::Accessor;
      if (owner != nullptr && owner != &entries_[i] && owner->type != nullptr &&
          owner->type->kind == (accessor ? Kind::Property : Kind::Pou))
        owner->members.push_back(i);
      else
        leaveOut(entries_[i], "the object that it belongs to is not in the export");
    }
  }

  void add(const Entry &entry) {
    if (entry.type == nullptr)
      return leaveOut(entry, fmt::format("objects of type {} are not known", entry.typeGuid));
    switch (entry.type->kind) {
    case Kind::Pou:
      return addPou(entry);
    case Kind::Type:
      return addDeclaration(entry, ObjectKind::Type);
    case Kind::Globals:
      return addDeclaration(entry, ObjectKind::GlobalList);
    case Kind::Libraries:
      return addLibraries(entry);
    case Kind::Task:
      return addTask(entry);
    case Kind::LeftOut:
      return leaveOut(entry, "objects of this kind are not imported");
    default:
      return;
    }
  }

  [[nodiscard]] std::vector<std::string> foldersOf(const Entry &entry) {
    std::vector<std::string> folders;
    const Entry *parent = parentOf(entry);
    for (size_t depth = 0; depth < kDeepest && parent != nullptr; ++depth) {
      if (parent->type != nullptr && parent->type->kind == Kind::Folder)
        for (std::string &each : import::foldersOf("\\/" + parent->name))
          folders.insert(folders.begin(), std::move(each));
      parent = parentOf(*parent);
    }
    return folders;
  }

  Unit unitOf(const Entry &entry, const std::string &owner) {
    const std::string object = owner.empty() ? entry.name : owner + "." + entry.name;
    Unit unit;
    unit.name = entry.name;
    switch (entry.type->kind) {
    case Kind::Action:
      unit.kind = UnitKind::Action;
      break;
    case Kind::Accessor:
      unit.kind = stride::common::lowerCase(entry.name) == "set" ? UnitKind::Set : UnitKind::Get;
      break;
    case Kind::Property:
      unit.kind = UnitKind::Property;
      break;
    default:
      break;
    }
    documentOf(named(entry.object, "Interface"), unit.declaration);
    const pugi::xml_node body = named(entry.object, "Implementation");
    if (body && std::string_view(body.name()) != "Null" && !documentOf(body, unit.body)) {
      const size_t line = document_.lineOf(body);
      unit.notImported = fmt::format("{}:{}: a graphical body", stemOf(file_), line);
      model_.leftOut.push_back(
          {{file_, line}, object, "its body is no text (LD, FBD, CFC or SFC); rewrite it in ST"});
    }
    for (const size_t each : entry.members)
      unit.members.push_back(unitOf(entries_[each], object));
    return unit;
  }

  void addPou(const Entry &entry) {
    std::string problem;
    std::string text = textOf(unitOf(entry, {}), problem);
    if (text.empty())
      return leaveOut(entry, problem);
    model_.objects.push_back(
        {ObjectKind::Pou, entry.name, foldersOf(entry), std::move(text), originOf(entry)});
  }

  void addDeclaration(const Entry &entry, ObjectKind kind) {
    std::string text;
    documentOf(named(entry.object, "Interface"), text);
    if (text.empty())
      return leaveOut(entry, "it holds no text");
    if (text.back() != '\n')
      text += '\n';
    if (entry.typeGuid == kPersistent)
      text = withoutPaths(entry, text);
    model_.objects.push_back(
        {kind, entry.name, foldersOf(entry), std::move(text), originOf(entry)});
  }

  /// A list of persistent variables names variables of other POUs by their paths, too.
  std::string withoutPaths(const Entry &entry, const std::string &text) {
    std::string out;
    for (const std::string_view line : linesOf(text)) {
      const std::string_view code = trimmed(line);
      const std::string_view name = wordAt(code, 0);
      const bool path = !name.empty() && code.substr(name.size()).starts_with('.');
      if (path)
        leaveOut(entry, fmt::format("`{}` is not persistent here: declare it with RETAIN where it "
                                    "stands",
                                    trimmed(code.substr(0, code.find(':')))));
      out += fmt::format("{}{}\n", path ? "// " : "", line);
    }
    return out;
  }

  void addLibraries(const Entry &entry) {
    for (const pugi::xml_node &item : named(entry.object, "Items").children()) {
      std::string whole = textAt(item, "DefaultResolution");
      if (whole.empty())
        whole = textAt(item, "Name");
      LibraryReference library = libraryNamed(whole, {file_, document_.lineOf(item)});
      if (!library.name.empty())
        model_.libraries.push_back(std::move(library));
    }
  }

  void addTask(const Entry &entry) {
    Task task;
    task.name = asIdentifier(entry.name);
    task.origin = originOf(entry);
    task.priority = textAt(entry.object, "Priority");
    const std::string kind = textAt(entry.object, "Kindoftask");
    const pugi::xml_node interval = named(entry.object, "Interval");
    const std::string time = textAt(interval, "Time");
    if (kind == "Cyclic")
      task.interval = time.find('#') != std::string::npos
                          ? time
                          : fmt::format("T#{}{}", time, textAt(interval, "Unit"));
    else if (kind == "Event" || kind == "Status")
      task.event = textAt(entry.object, "Event");
    else if (kind != "Freewheeling")
      leaveOut(entry, fmt::format("its kind `{}` is not imported: it runs freely here", kind));
    for (const pugi::xml_node &call : named(entry.object, "PouList").children())
      task.programs.push_back(textAt(call, "Name"));
    model_.tasks.push_back(std::move(task));
  }

  const std::string &file_;
  const XmlDocument &document_;
  Model &model_;
  std::vector<Entry> entries_;
  std::map<std::string, size_t> byGuid_;
};

} // namespace
} // namespace v3

bool isCodesysExport(std::string_view text) {
  return text.find("<ExportFile") != std::string_view::npos &&
         text.find("<StructuredView") != std::string_view::npos;
}

void readCodesysExport(const std::string &file, std::string_view text, Model &model) {
  const auto document = readXml(text);
  if (!document->problem.empty()) {
    model.unreadable.push_back({{file, document->problemLine}, "file", document->problem});
    return;
  }
  if (std::string_view(document->tree.document_element().name()) != "ExportFile") {
    model.unreadable.push_back({{file, 1}, "file", "its root is no `ExportFile`"});
    return;
  }
  v3::Reader(file, *document, model).read();
}

} // namespace stc::import
