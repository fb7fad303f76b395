#include "compiler/doc/reference.hpp"

#include "compiler/syntax/attributes.hpp"

#include "compiler/syntax/st_text.hpp"

#include <algorithm>

namespace stc::doc {

namespace {

bool isHidden(const ast::Attributes &attributes) {
  return hasAttribute(attributes, ast::AttributeId::Hide);
}

bool isPrivate(ast::Access access) { return access == ast::Access::Private; }

class Describer {
public:
  explicit Describer(const Sources &sources) : sources_(sources) {}

  void file(const ast::File &file, std::vector<Entry> &entries) {
    for (const ast::Decl *decl : file.declarations)
      if (!isHidden(decl->attributes) && !isPrivate(decl->access))
        declaration(*decl, entries);
  }

private:
  [[nodiscard]] std::string text(Span span) const { return std::string(sources_.text(span)); }

  [[nodiscard]] std::string path(const ast::NamePath &names) const {
    std::string result;
    for (const ast::Name &name : names)
      result += (result.empty() ? "" : ".") + std::string(name.text);
    return result;
  }

  [[nodiscard]] Member member(const ast::VarDecl &variable) const {
    return {std::string(variable.name.text),
            variable.type == nullptr ? "" : text(variable.type->span),
            variable.init == nullptr ? "" : text(variable.init->span), std::string(variable.doc)};
  }

  /// Sections in the order of the text; those of one kind become one group.
  [[nodiscard]] std::vector<Group> parameters(std::span<ast::VarDecl *const> variables) const {
    std::vector<Group> groups;
    for (const ast::VarDecl *variable : variables) {
      const char *title = variable->section == ast::Section::Input    ? "Inputs"
                          : variable->section == ast::Section::InOut  ? "In-outs"
                          : variable->section == ast::Section::Output ? "Outputs"
                                                                      : nullptr;
      if (title != nullptr && !isHidden(variable->attributes))
        groupOf(groups, title).members.push_back(member(*variable));
    }
    return groups;
  }

  [[nodiscard]] Group fields(const char *title, std::span<ast::VarDecl *const> variables) const {
    Group group{title, {}};
    for (const ast::VarDecl *variable : variables)
      if (!isHidden(variable->attributes))
        group.members.push_back(member(*variable));
    return group;
  }

  static Group &groupOf(std::vector<Group> &groups, const char *title) {
    for (Group &group : groups)
      if (group.title == title)
        return group;
    return groups.emplace_back(Group{title, {}});
  }

  static const char *kindOf(ast::DeclKind kind) {
    switch (kind) {
    case ast::DeclKind::Program:
      return "Program";
    case ast::DeclKind::Function:
      return "Function";
    case ast::DeclKind::Class:
      return "Class";
    case ast::DeclKind::Interface:
      return "Interface";
    case ast::DeclKind::Method:
      return "Method";
    case ast::DeclKind::Action:
      return "Action";
    default:
      return "Function block";
    }
  }

  [[nodiscard]] Entry pou(const ast::PouDecl &decl, const std::string &owner) const {
    Entry entry;
    entry.kind = kindOf(decl.kind);
    entry.name = owner + std::string(decl.name.text);
    entry.text = decl.doc;
    if (decl.returnType != nullptr)
      entry.suffix = ": " + text(decl.returnType->span);
    if (!decl.base.empty())
      entry.suffix += (entry.suffix.empty() ? "EXTENDS " : " EXTENDS ") + path(decl.base);
    for (size_t i = 0; i < decl.interfaces.size(); ++i)
      entry.suffix += (i == 0 ? " IMPLEMENTS " : ", ") + path(decl.interfaces[i]);
    entry.groups = parameters(decl.variables);
    const std::string inner = entry.name + ".";
    for (const ast::PouDecl *method : decl.methods)
      if (!isHidden(method->attributes) && !isPrivate(method->access))
        entry.parts.push_back(pou(*method, inner));
    for (const ast::PropertyDecl *property : decl.properties) {
      if (isHidden(property->attributes) || isPrivate(property->access))
        continue;
      std::string access = property->set == nullptr ? " (read only)" : "";
      entry.parts.push_back({"Property",
                             inner + std::string(property->name.text),
                             ": " + text(property->type->span) + access,
                             std::string(property->doc),
                             {},
                             {}});
    }
    for (const ast::PouDecl *action : decl.actions)
      if (!isHidden(action->attributes))
        entry.parts.push_back(pou(*action, inner));
    return entry;
  }

  void declaration(const ast::Decl &decl, std::vector<Entry> &entries) {
    Entry entry;
    const std::string space = decl.space.empty() ? "" : path(decl.space) + ".";
    entry.name = space + std::string(decl.name.text);
    entry.text = decl.doc;
    switch (decl.kind) {
    case ast::DeclKind::Program:
    case ast::DeclKind::Function:
    case ast::DeclKind::FunctionBlock:
    case ast::DeclKind::Class:
    case ast::DeclKind::Interface:
      entry = pou(static_cast<const ast::PouDecl &>(decl), space);
      break;
    case ast::DeclKind::Structure: {
      const auto &structure = static_cast<const ast::StructDecl &>(decl);
      entry.kind = structure.isUnion ? "Union" : "Structure";
      if (!structure.base.empty())
        entry.suffix = "EXTENDS " + path(structure.base);
      entry.groups.push_back(fields("Fields", structure.fields));
      break;
    }
    case ast::DeclKind::Enumeration: {
      const auto &enumeration = static_cast<const ast::EnumDecl &>(decl);
      entry.kind = "Enumeration";
      if (enumeration.type->base != nullptr)
        entry.suffix = ": " + text(enumeration.type->base->span);
      Group group{"Values", {}};
      for (const ast::EnumeratorDecl &e : enumeration.type->enumerators)
        group.members.push_back({std::string(e.name.text), "",
                                 e.value == nullptr ? "" : text(e.value->span),
                                 std::string(e.doc)});
      entry.groups.push_back(std::move(group));
      break;
    }
    case ast::DeclKind::Alias: {
      const auto &alias = static_cast<const ast::AliasDecl &>(decl);
      entry.kind = "Type";
      entry.suffix = ": " + text(alias.type->span);
      break;
    }
    case ast::DeclKind::Globals: {
      const auto &globals = static_cast<const ast::GlobalsDecl &>(decl);
      std::string list(decl.name.text);
      if (list.empty())
        list = sources_.file(decl.span.file).name();
      list = list.substr(list.rfind('/') + 1);
      entry.name = space + list.substr(0, list.find('.'));
      entry.kind = "Global variables";
      entry.groups.push_back(fields("Variables", globals.variables));
      break;
    }
    default:
      return; // a configuration, or parts of one
    }
    entries.push_back(std::move(entry));
  }

  const Sources &sources_;
};

} // namespace

Module describe(std::string name, std::span<const ast::File *const> files, const Sources &sources) {
  Module module{std::move(name), {}, {}};
  Describer describer(sources);
  for (const ast::File *file : files)
    describer.file(*file, module.entries);
  std::stable_sort(module.entries.begin(), module.entries.end(),
                   [](const Entry &a, const Entry &b) { return a.name < b.name; });
  return module;
}

std::string firstSentence(const std::string &text) {
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '.' && (i + 1 == text.size() || text[i + 1] == ' ' || text[i + 1] == '\n'))
      return text.substr(0, i + 1);
  return text;
}

} // namespace stc::doc
