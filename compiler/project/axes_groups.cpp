// [[axes_group]]: axes that move together on a path.

#include "compiler/project/config_reader.hpp"
#include "compiler/syntax/st_text.hpp"

#include <array>
#include <fmt/format.h>

namespace stc {

namespace {

using stride::common::anyReal;
using stride::common::identifier;

constexpr std::array kGroupParameters = {
    identifier("name").needed(), Parameter{"axes", ParameterType::NameList, true},
    identifier("kinematics"),    identifier("orientation"),
    identifier("planning_task"),
};

constexpr std::array kPoseParameters = {
    anyReal("X", "u"), anyReal("Y", "u"), anyReal("Z", "u"),
    anyReal("A", "°"), anyReal("B", "°"), anyReal("C", "°"),
};

// The keys are names of the inputs of a block.
constexpr SectionSchema kParameters = {
    "parameters", "the kinematics", "axes_group.parameters", false, {}, {}, {}, true};
constexpr SectionSchema kOrientationParameters = {"orientation_parameters",
                                                  "the orientation",
                                                  "axes_group.orientation_parameters",
                                                  false,
                                                  {},
                                                  {},
                                                  {},
                                                  true};
constexpr SectionSchema kTool = {"tool", "the tool", "axes_group.tool", false, kPoseParameters, {}};
constexpr SectionSchema kBase = {"base", "the base", "axes_group.base", false, kPoseParameters, {}};
constexpr SectionSchema kPcs1 = {"PCS_1", "a coordinate system", "axes_group.PCS_1",
                                 false,   kPoseParameters,       {}};
constexpr SectionSchema kPcs2 = {"PCS_2", "a coordinate system", "axes_group.PCS_2",
                                 false,   kPoseParameters,       {}};
constexpr std::array<const SectionSchema *, 6> kGroupSections = {
    &kParameters, &kOrientationParameters, &kTool, &kBase, &kPcs1, &kPcs2};
constexpr SectionSchema kAxesGroup = {"axes_group", "an axes group",  "axes_group",
                                      true,         kGroupParameters, kGroupSections};

std::vector<InputValue> valuesIn(const CheckedSection &section, std::string_view name,
                                 Diagnostics &diagnostics) {
  std::vector<InputValue> values;
  Unique keys(Code::ConfigDuplicateName, diagnostics);
  for (const CheckedSection &table : section.sections(name, diagnostics))
    for (const TomlNode &member : table.table().children)
      if (keys.add(lowerCase(member.key), member.keySpan,
                   fmt::format("`{}` is given twice: upper and lower case do not count here",
                               member.key)))
        values.push_back({{member.key, member.keySpan}, member});
  return values;
}

/// A pose as ST; empty: it is not given.
std::string poseIn(const CheckedSection &section, std::string_view name, Diagnostics &diagnostics) {
  std::string text;
  for (const CheckedSection &table : section.sections(name, diagnostics)) {
    for (const Parameter &parameter : kPoseParameters)
      text += fmt::format("{}{} := {}", text.empty() ? "(" : ", ", parameter.name,
                          realLiteral(table.real(parameter.name, 0)));
    text += ")";
  }
  return text;
}

} // namespace

const SectionSchema &axesGroupSchema() { return kAxesGroup; }

void PlcReader::readAxesGroup(const CheckedSection &section) {
  AxesGroupConfig group;
  group.name = nameOf(section);
  if (const TomlNode *axes = section.get("axes")) {
    group.axesSpan = axes->span;
    for (const TomlNode &axis : axes->children)
      group.axes.push_back({axis.text, axis.span});
  } else {
    config_.incomplete = true; // and reported
  }
  group.kinematics = nameIn(section, "kinematics");
  group.orientation = nameIn(section, "orientation");
  group.planningTask = nameIn(section, "planning_task");
  const auto needs = [&](std::string_view key, std::string_view other) {
    if (const TomlNode *value = section.table().find(key);
        value != nullptr && !section.has(other)) {
      config_.incomplete = true;
      diagnostics_
          .report(Code::ConfigMissingKey, value->keySpan,
                  fmt::format("`{}` needs `{}`", key, other), "of what?")
          .help(fmt::format("add `{} = …`: the name of a block such as \"{}\"", other,
                            other == "kinematics" ? "Kin_Gantry3" : "Kin_CAxis"));
    }
  };
  needs("orientation", "kinematics");
  needs("parameters", "kinematics");
  needs("tool", "kinematics");
  needs("orientation_parameters", "orientation");
  group.parameters = valuesIn(section, "parameters", diagnostics_);
  group.orientationParameters = valuesIn(section, "orientation_parameters", diagnostics_);
  group.tool = poseIn(section, "tool", diagnostics_);
  group.base = poseIn(section, "base", diagnostics_);
  group.pcs1 = poseIn(section, "PCS_1", diagnostics_);
  group.pcs2 = poseIn(section, "PCS_2", diagnostics_);
  if (addVariable(group.name))
    config_.axesGroups.push_back(std::move(group));
}

} // namespace stc
