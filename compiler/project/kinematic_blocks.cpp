#include "compiler/project/kinematic_blocks.hpp"

#include "compiler/source/suggest.hpp"
#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace stc {

namespace {

/// A kinematics of the library and how many axes it has.
struct KnownKinematics {
  std::string_view name;
  size_t axes;
};
constexpr std::array<KnownKinematics, 21> kKinematics = {{{"Kin_4AxisPalletizer", 4},
                                                          {"Kin_5Axes", 5},
                                                          {"Kin_5AxesTable", 5},
                                                          {"Kin_ArticulatedRobot_6DOF", 6},
                                                          {"Kin_Bipod_Rotary", 2},
                                                          {"Kin_CAxis", 1},
                                                          {"Kin_CAxis_Tool", 1},
                                                          {"Kin_Gantry2", 2},
                                                          {"Kin_Gantry3", 3},
                                                          {"Kin_HGantry2", 2},
                                                          {"Kin_OffsetWrist_6DOF", 6},
                                                          {"Kin_Polar", 2},
                                                          {"Kin_Polar_Z", 3},
                                                          {"Kin_Pos_RRR", 3},
                                                          {"Kin_Scara2_Z", 3},
                                                          {"Kin_Scara3_Z", 4},
                                                          {"Kin_TGantry2", 2},
                                                          {"Kin_Tripod_Linear", 3},
                                                          {"Kin_Tripod_Rotary", 3},
                                                          {"Kin_Wrist2", 2},
                                                          {"Kin_Wrist3", 3}}};

/// 0: it is not one of the library's.
size_t axesOf(std::string_view lower) {
  for (const KnownKinematics &known : kKinematics)
    if (lowerCase(known.name) == lower)
      return known.axes;
  return 0;
}

std::string elementary(const ast::VarDecl &input) {
  if (input.type == nullptr || input.type->kind != ast::TypeExprKind::Named)
    return {};
  const auto *type = ast::as<ast::NamedTypeExpr>(input.type);
  return type->path.size() == 1 ? lowerCase(type->path.front().text) : std::string();
}

bool isWhole(std::string_view type) {
  constexpr std::array<std::string_view, 12> kWhole = {"sint",  "int",  "dint",  "lint",
                                                       "usint", "uint", "udint", "ulint",
                                                       "byte",  "word", "dword", "lword"};
  return std::find(kWhole.begin(), kWhole.end(), type) != kWhole.end();
}

std::string expectation(const ast::VarDecl &input) {
  const std::string type = elementary(input);
  if (type == "lreal" || type == "real")
    return "a number";
  if (type == "bool")
    return "`true` or `false`";
  if (isWhole(type))
    return "an integer";
  return "set by the program: stride.toml gives numbers and BOOLs only";
}

std::optional<std::string> textOf(const ast::VarDecl &input, const TomlNode &value) {
  const std::string type = elementary(input);
  const bool isInteger = value.kind == TomlKind::Integer;
  if ((type == "lreal" || type == "real") && (isInteger || value.kind == TomlKind::Floating))
    return realLiteral(value.floating);
  if (type == "bool" && value.kind == TomlKind::Boolean)
    return std::string(value.boolean ? "TRUE" : "FALSE");
  if (isWhole(type) && isInteger)
    return std::to_string(value.integer);
  return std::nullopt;
}

} // namespace

const ast::PouDecl *KinematicBlocks::blockOf(std::string_view name) {
  const std::string lower = lowerCase(name);
  const ast::Decl *found = typeIn(files_, lower);
  if (found == nullptr)
    found = finder_.find(lower);
  const bool isPou = found != nullptr && (found->kind == ast::DeclKind::FunctionBlock ||
                                          found->kind == ast::DeclKind::Interface);
  return isPou ? ast::as<ast::PouDecl>(found) : nullptr;
}

bool KinematicBlocks::implements(const ast::PouDecl *pou, std::string_view interfaceName,
                                 int depth) {
  constexpr int kDeepest = 64; // of a program that extends in a circle, which the checker reports
  if (pou == nullptr || depth > kDeepest)
    return false;
  for (const ast::NamePath &path : pou->interfaces) {
    const ast::Name &name = path.back();
    if (equalIgnoringCase(name.text, interfaceName) ||
        implements(blockOf(name.text), interfaceName, depth + 1))
      return true;
  }
  return !pou->base.empty() && implements(blockOf(pou->base.back().text), interfaceName, depth + 1);
}

size_t KinematicBlocks::check(const ConfigName &name, std::string_view interfaceName,
                              std::string_view what, const std::vector<InputValue> &values) {
  const ast::PouDecl *block = blockOf(name.text);
  if (equalIgnoringCase(name.text, "Kin_Coupled")) {
    program_.diagnostics
        .report(Code::ConfigUnknownKinematics, name.span,
                "`Kin_Coupled` is made of `kinematics` and `orientation`", "name its parts instead")
        .help("for example `kinematics = \"Kin_Scara2_Z\"`, `orientation = \"Kin_CAxis\"`");
    return 0;
  }
  if (block == nullptr || block->kind != ast::DeclKind::FunctionBlock ||
      (block->modifiers & ast::kModAbstract) != 0 || !implements(block, interfaceName)) {
    reportUnknownKinematics(name, block, interfaceName, what);
    return 0;
  }
  if (turnsOnly(interfaceName, name.text)) {
    program_.diagnostics
        .report(Code::ConfigUnknownKinematics, name.span,
                fmt::format("`{}` turns a tool, and nothing places it", name.text),
                "not a kinematics by itself")
        .help(fmt::format("name what places it as `kinematics`, and `orientation = \"{}\"`",
                          name.text));
    return 0;
  }
  for (const InputValue &value : values)
    checkInput(name.text, *block, value);
  return axesOf(lowerCase(name.text));
}

bool KinematicBlocks::isOwn(const ConfigName &name) { return axesOf(lowerCase(name.text)) == 0; }

bool KinematicBlocks::turnsOnly(std::string_view interfaceName, std::string_view name) {
  return interfaceName == kAnyKinematics && axesOf(lowerCase(name)) > 0 &&
         implements(blockOf(name), kTurningKinematics);
}

void KinematicBlocks::reportUnknownKinematics(const ConfigName &name, const ast::PouDecl *block,
                                              std::string_view interfaceName,
                                              std::string_view what) {
  Diagnostic &d = program_.diagnostics.report(
      Code::ConfigUnknownKinematics, name.span,
      block == nullptr ? fmt::format("there is no kinematics `{}`", name.text)
                       : fmt::format("`{}` is not {}", name.text, what),
      block == nullptr ? "not found" : fmt::format("does not implement {}", interfaceName));
  std::vector<std::string_view> known;
  for (const KnownKinematics &one : kKinematics)
    if (implements(blockOf(one.name), interfaceName) && !turnsOnly(interfaceName, one.name))
      known.push_back(one.name);
  for (const ast::File *file : files_)
    for (const ast::Decl *decl : file->declarations)
      if (decl->kind == ast::DeclKind::FunctionBlock &&
          implements(ast::as<ast::PouDecl>(decl), interfaceName))
        known.push_back(decl->name.text);
  if (const std::string_view near = nearest(name.text, known); !near.empty()) {
    d.help(fmt::format("did you mean `{}`?", near));
    return;
  }
  std::string all;
  for (const std::string_view one : known)
    all += fmt::format("{}{}", all.empty() ? "" : ", ", one);
  d.note("known: " + all);
}

void KinematicBlocks::checkInput(std::string_view blockName, const ast::PouDecl &block,
                                 const InputValue &value) {
  std::vector<std::string_view> known;
  const ast::VarDecl *input = inputOf(block, value.name.text, known);
  if (input == nullptr) {
    Diagnostic &d = program_.diagnostics.report(
        Code::ConfigUnknownKey, value.name.span,
        fmt::format("`{}` has no input `{}`", blockName, value.name.text), "unknown");
    std::string all;
    for (const std::string_view name : known)
      all += fmt::format("{}`{}`", all.empty() ? "" : ", ", name);
    if (const std::string_view near = nearest(value.name.text, known); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    else
      d.note(all.empty() ? std::string("it has no inputs") : "its inputs: " + all);
    return;
  }
  if (textOf(*input, value.value))
    return;
  const std::string type(program_.sources.text(input->type->span));
  program_.diagnostics
      .report(Code::ConfigWrongType, value.value.span,
              fmt::format("`{}` must be {}", input->name.text, expectation(*input)),
              fmt::format("this is {}", describe(value.value)))
      .note(fmt::format("`{}.{}` is {}", blockName, input->name.text, type));
}

const ast::VarDecl *KinematicBlocks::inputOf(const ast::PouDecl &block, std::string_view name,
                                             std::vector<std::string_view> &known) {
  const ast::PouDecl *pou = &block;
  constexpr int kDeepest = 64;
  for (int depth = 0; pou != nullptr && depth < kDeepest; ++depth) {
    for (const ast::VarDecl *variable : pou->variables) {
      if (variable->section != ast::Section::Input)
        continue;
      if (equalIgnoringCase(variable->name.text, name))
        return variable;
      known.push_back(variable->name.text);
    }
    pou = pou->base.empty() ? nullptr : blockOf(pou->base.back().text);
  }
  return nullptr;
}

void KinematicBlocks::addValues(const std::vector<InputValue> &values, const ConfigName &blockName,
                                SyntheticSource &out) {
  const ast::PouDecl *block = blockOf(blockName.text);
  std::string_view separator = " := (";
  for (const InputValue &value : values) {
    std::vector<std::string_view> known;
    const ast::VarDecl *input = inputOf(*block, value.name.text, known);
    out.add(fmt::format("{}{} := ", separator, value.name.text));
    out.add(*textOf(*input, value.value), value.value.span);
    separator = ", ";
  }
  out.add(values.empty() ? ";\n" : ");\n");
}

} // namespace stc
