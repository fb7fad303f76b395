#include "compiler/project/axes_group_sources.hpp"

#include "compiler/project/kinematic_blocks.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/global_names.hpp"
#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unordered_map>

namespace stc {

namespace {

// As the blocks of axis groups have it: runtime/numeric/group/place.hpp.
constexpr size_t kMoreAxes = 4;
constexpr size_t kMostAxes = 10;

/// Where traces of a group show its tool.
constexpr std::array<std::string_view, 2> kTracedSystems = {"MCS", "WCS"};

class GroupWriter {
public:
  GroupWriter(Program &program, ProjectConfig &config, const std::vector<ast::File *> &files,
              const LibraryIndex &index)
      : program_(program), config_(config), kinematics_(program, files, index),
        names_(globalNames(files)) {
    for (const AxisGroupConfig &group : config.axisGroups) {
      others_.emplace(lowerCase(group.name.text), "a group of drives on a bus");
      for (const DriveConfig &drive : group.drives)
        addAxis(drive.name, group.task.text);
      for (const EncoderConfig &encoder : group.encoders)
        others_.emplace(lowerCase(encoder.name.text), "an encoder");
    }
    for (const AxisConfig &axis : config.axes)
      addAxis(axis.name, axis.task.text);
  }

  SyntheticSource write() {
    for (const AxesGroupConfig &group : config_.axesGroups)
      addGroup(group);
    return std::move(out_);
  }

private:
  struct Axis {
    std::string_view name;
    std::string_view task;
    const ConfigName *user = nullptr; ///< The group's entry that has taken it.
    std::string_view group;
  };

  void addAxis(const ConfigName &name, std::string_view task) {
    axes_.emplace(lowerCase(name.text), Axis{name.text, task, nullptr, {}});
  }

  Diagnostic &report(Code code, Span where, std::string message, std::string label) {
    return program_.diagnostics.report(code, where, std::move(message), std::move(label));
  }

  void addGroup(const AxesGroupConfig &group) {
    const size_t errors = program_.diagnostics.errorCount();
    checkName(group);
    const std::string_view task = checkAxes(group);
    const size_t joints = checkKinematics(group);
    checkNumber(group, joints);
    TaskConfig *const planner = planningTask(group, task);
    if (planner != nullptr && program_.diagnostics.errorCount() == errors)
      checkPlanned(group);
    if (program_.diagnostics.errorCount() != errors || task.empty())
      return;
    declare(group, planner != nullptr);
    if (planner != nullptr)
      planner->programs.push_back({group.name.text + "__plan", group.planningTask.span});
    for (TaskConfig &candidate : config_.tasks)
      if (equalIgnoringCase(candidate.name.text, task))
        candidate.programs.push_back({group.name.text + "__service", group.name.span});
  }

  void checkName(const AxesGroupConfig &group) {
    if (const auto clash = names_.find(lowerCase(group.name.text)); clash != names_.end())
      report(Code::ConfigNameClash, group.name.span,
             fmt::format("the axes group `{}` has the name of something in the program",
                         group.name.text),
             "becomes a global variable of this name")
          .label(clash->second, "already declared here")
          .help("rename one of them");
  }

  /// The task of its axes; empty: something has been reported.
  std::string_view checkAxes(const AxesGroupConfig &group) {
    std::string_view task;
    const ConfigName *first = nullptr;
    bool mixed = false;
    for (const ConfigName &name : group.axes) {
      const auto found = axes_.find(lowerCase(name.text));
      if (found == axes_.end()) {
        reportUnknownAxis(name);
        continue;
      }
      Axis &axis = found->second;
      if (axis.user != nullptr) {
        reportTaken(group, name, axis);
        continue;
      }
      axis.user = &name;
      axis.group = group.name.text;
      if (first == nullptr) {
        first = &name;
        task = axis.task;
      } else if (!equalIgnoringCase(task, axis.task) && !mixed) {
        mixed = true;
        report(Code::ConfigAxesTasks, name.span,
               fmt::format("the axes of `{}` are served by two tasks", group.name.text),
               fmt::format("by task `{}`", axis.task))
            .label(first->span, fmt::format("by task `{}`", task))
            .help("give both the same `sTask`: a group moves all its axes in one cycle");
      }
    }
    return task;
  }

  /// The task in which it is planned; null: that of its axes, or something has been reported.
  TaskConfig *planningTask(const AxesGroupConfig &group, std::string_view task) {
    const ConfigName &name = group.planningTask;
    if (name.text.empty() || equalIgnoringCase(name.text, task))
      return nullptr;
    std::vector<std::string_view> known;
    for (TaskConfig &candidate : config_.tasks) {
      if (equalIgnoringCase(candidate.name.text, name.text))
        return &candidate;
      known.push_back(candidate.name.text);
    }
    Diagnostic &d = report(Code::ConfigUnknownTask, name.span,
                           fmt::format("there is no task `{}`", name.text), "not found");
    if (const std::string_view near = nearest(name.text, known); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    d.note(fmt::format("tasks: {}", fmt::join(known, ", ")));
    return nullptr;
  }

  /// What a planning task cannot plan with.
  void checkPlanned(const AxesGroupConfig &group) {
    for (const ConfigName *name : {&group.kinematics, &group.orientation})
      if (!name->text.empty() && KinematicBlocks::isOwn(*name))
        report(Code::PlannedKinematics, group.planningTask.span,
               fmt::format("`{}` cannot be planned in another task", group.name.text),
               fmt::format("task `{}` would call `{}`", group.planningTask.text, name->text))
            .label(name->span, "the program's own, which the task of the axes calls, too")
            .help("take a kinematics of the library, or leave `planning_task` out");
  }

  void reportUnknownAxis(const ConfigName &name) {
    if (const auto other = others_.find(lowerCase(name.text)); other != others_.end()) {
      report(Code::ConfigUnknownAxis, name.span,
             fmt::format("`{}` is {}, not an axis", name.text, other->second), "no axis");
      return;
    }
    Diagnostic &d = report(Code::ConfigUnknownAxis, name.span,
                           fmt::format("there is no axis `{}`", name.text), "not found");
    std::vector<std::string_view> known;
    for (const auto &[lower, axis] : axes_)
      known.push_back(axis.name);
    std::sort(known.begin(), known.end());
    if (const std::string_view near = nearest(name.text, known); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    else
      d.help("axes are the names of [[axis]] and [[bus.axis_group.drive]]");
  }

  void reportTaken(const AxesGroupConfig &group, const ConfigName &name, const Axis &axis) {
    const bool same =
        axis.user >= group.axes.data() && axis.user < group.axes.data() + group.axes.size();
    report(Code::ConfigAxisTaken, name.span,
           same ? fmt::format("`{}` has the axis `{}` twice", group.name.text, name.text)
                : fmt::format("the axis `{}` is in two groups, `{}` and `{}`", name.text,
                              axis.group, group.name.text),
           "again here")
        .label(axis.user->span, "first here");
  }

  /// How many axes the kinematics has; 0: not known, or something has been reported.
  size_t checkKinematics(const AxesGroupConfig &group) {
    if (group.kinematics.text.empty())
      return 0;
    const bool coupled = !group.orientation.text.empty();
    const size_t placing =
        kinematics_.check(group.kinematics, coupled ? kPlacingKinematics : kAnyKinematics,
                          coupled ? "a kinematics that places" : "a kinematics", group.parameters);
    if (!coupled)
      return placing;
    const size_t turning =
        kinematics_.check(group.orientation, kTurningKinematics, "a kinematics that turns",
                          group.orientationParameters);
    return placing > 0 && turning > 0 ? placing + turning : 0;
  }

  void checkNumber(const AxesGroupConfig &group, size_t joints) {
    const size_t count = group.axes.size();
    const std::string block =
        group.orientation.text.empty()
            ? fmt::format("`{}`", group.kinematics.text)
            : fmt::format("`{}` with `{}`", group.kinematics.text, group.orientation.text);
    const std::string label = fmt::format("{} {}", count, count == 1 ? "axis" : "axes");
    if (joints > count)
      report(Code::ConfigAxesNumber, group.axesSpan,
             fmt::format("{} has {} axes, and `{}` only {}", block, joints, group.name.text, count),
             label)
          .help("name its axes in the order in which it counts them: docs/kinematics.md");
    else if (joints > 0 && count > joints + kMoreAxes)
      report(Code::ConfigAxesNumber, group.axesSpan,
             fmt::format("`{}` has too many axes: {} has {}, and at most {} go along",
                         group.name.text, block, joints, kMoreAxes),
             label);
    else if (count > kMostAxes)
      report(
          Code::ConfigAxesNumber, group.axesSpan,
          fmt::format("`{}` has too many axes: a group has {} at most", group.name.text, kMostAxes),
          label);
  }

  /// The type of the group's own, which has its kinematics, and what traces of it show.
  void declareType(const AxesGroupConfig &group) {
    const bool hasKinematics = !group.kinematics.text.empty();
    const bool coupled = !group.orientation.text.empty();
    out_.add(fmt::format("/// The axes group {0}.\n{{attribute 'hide'}}\n"
                         "FUNCTION_BLOCK {0}__Group EXTENDS SM3_Robotics.AXIS_GROUP_REF_SM3\n"
                         "VAR_OUTPUT\n",
                         group.name.text));
    const auto part = [&](std::string_view variable, std::string_view says, const ConfigName &block,
                          const std::vector<InputValue> &values) {
      out_.add(fmt::format("  /// {}\n  {} : ", says, variable));
      out_.add(block.text, block.span);
      kinematics_.addValues(values, block, out_);
    };
    if (coupled) {
      out_.add("  /// Its kinematics.\n  Trafo : SM3_Transformation.Kin_Coupled;\n");
      part("Position", "The part of its kinematics that places.", group.kinematics,
           group.parameters);
      part("Orientation", "The part of its kinematics that turns.", group.orientation,
           group.orientationParameters);
    } else if (hasKinematics) {
      part("Trafo", "Its kinematics.", group.kinematics, group.parameters);
    }
    out_.add("END_VAR\nVAR_INPUT\n");
    for (const std::string_view system : kTracedSystems)
      if (hasKinematics)
        out_.add(fmt::format("  /// Set position of the tool, while the group is traced.\n"
                             "  {{attribute 'hide'}}\n  {} : SM3_Robotics.MC_COORD_REF;\n",
                             system));
    out_.add("  /// The group is traced.\n  {attribute 'hide'}\n  bTrace : BOOL;\n"
             "END_VAR\nEND_FUNCTION_BLOCK\n");
  }

  static std::string systemsOf(const AxesGroupConfig &group) {
    const auto or0 = [](const std::string &pose) {
      return pose.empty() ? std::string("(X := 0.0)") : pose;
    };
    return group.base.empty() && group.pcs1.empty() && group.pcs2.empty()
               ? std::string()
               : fmt::format(", astSystem := [{}, {}, {}]", or0(group.base), or0(group.pcs1),
                             or0(group.pcs2));
  }

  void declare(const AxesGroupConfig &group, bool plannedAside) {
    const std::string &name = group.name.text;
    const bool hasKinematics = !group.kinematics.text.empty();
    declareType(group);
    std::string axes;
    for (const ConfigName &axis : group.axes)
      axes += fmt::format("{}ADR({})", axes.empty() ? "" : ", ", axis.text);
    std::string fields = fmt::format("uiAxes := {}, apAxis := [{}]", group.axes.size(), axes);
    if (hasKinematics)
      fields += fmt::format(", itfKinematics := {}.Trafo", name);
    if (!group.orientation.text.empty())
      fields +=
          fmt::format(", Trafo := (itfPosKin := {0}.Position, itfOriKin := {0}.Orientation)", name);
    fields += systemsOf(group);
    if (!group.tool.empty())
      fields += fmt::format(", stTool := {}, bTool := TRUE", group.tool);
    if (plannedAside) {
      fields += fmt::format(", pPlanning := ADR({}__planning)", name);
      declarePlanning(name);
    }
    out_.add("VAR_GLOBAL\n  /// A group of axes.\n");
    out_.add(fmt::format("  {0} : {0}__Group := ({1});\n", name, fields), group.name.span);
    out_.add("END_VAR\n");
    declareService(name, hasKinematics);
  }

  /// What plans for the group, and the program that lets it do so.
  void declarePlanning(const std::string &name) {
    out_.add(fmt::format("VAR_GLOBAL\n  {{attribute 'hide'}}\n"
                         "  {0}__planning : SM3_Robotics.SMC_GROUP_PLANNING;\nEND_VAR\n"
                         "{{attribute 'hide'}}\nPROGRAM {0}__plan\n{0}__planning();\n"
                         "END_PROGRAM\n",
                         name));
  }

  /// The program that lets the group go on, and notes what traces show.
  void declareService(const std::string &name, bool hasKinematics) {
    std::string reads;
    std::string_view reader;
    if (hasKinematics) {
      reads = fmt::format("IF {}.bTrace THEN\n", name);
      for (const std::string_view system : kTracedSystems)
        reads += fmt::format("  read(AxisGroup := {0}, Enable := TRUE, CoordSystem := "
                             "SM3_Robotics.SMC_COORD_SYSTEM.{1});\n"
                             "  {0}.{1} := read.Position.c;\n",
                             name, system);
      reads += "END_IF\n";
      reader = "  read : SM3_Robotics.SMC_GroupReadSetPosition;\n";
    }
    out_.add(fmt::format("{{attribute 'hide'}}\nPROGRAM {0}__service\nVAR\n"
                         "  update : SM3_Robotics.SMC_GroupUpdate;\n"
                         "{2}END_VAR\n"
                         "update(AxisGroup := {0}, Enable := TRUE);\n{1}END_PROGRAM\n",
                         name, reads, reader));
  }

  Program &program_;
  ProjectConfig &config_;
  KinematicBlocks kinematics_;
  std::unordered_map<std::string, Span> names_;
  std::unordered_map<std::string, Axis> axes_;
  std::unordered_map<std::string, std::string_view> others_; ///< and what they are
  SyntheticSource out_{"<plc>/Axes_Groups.st"};
};

} // namespace

GroupTrace groupTrace(const AxesGroupConfig &group) {
  const std::string &name = group.name.text;
  std::vector<std::string> columns = {name + ".eState"};
  if (!group.kinematics.text.empty())
    for (const std::string_view system : kTracedSystems)
      for (const char member : std::string_view("XYZABC"))
        columns.push_back(fmt::format("{}.{}.{}", name, system, member));
  for (const ConfigName &axis : group.axes)
    columns.push_back(axis.text + ".fSetPosition");
  for (const ConfigName &axis : group.axes)
    columns.push_back(axis.text + ".fSetVelocity");
  return {name, fmt::format("{}.bTrace=TRUE", name), fmt::format("{}", fmt::join(columns, ","))};
}

SyntheticSource axesGroupDeclarations(Program &program, ProjectConfig &config,
                                      const std::vector<ast::File *> &files,
                                      const LibraryIndex &index) {
  return GroupWriter(program, config, files, index).write();
}

} // namespace stc
