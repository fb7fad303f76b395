#include "compiler/project/csy_sources.hpp"

#include "compiler/assets/csy/channel_outputs.hpp"
#include "compiler/source/suggest.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <unordered_map>

namespace stc {

namespace {

constexpr uint32_t kFirstImaginary = 9;
constexpr uint32_t kFirstRemote = 13;
constexpr size_t kLeastAxesOfPath = 2;

/// `(A := 1, B := 2)`
std::string structure(const CsyFields &fields) {
  std::string text;
  for (const auto &[member, value] : fields)
    text += fmt::format("{}{} := {}", text.empty() ? "(" : ", ", member, value);
  return text.empty() ? text : text + ")";
}

/// `, A := 1, B := 2`
std::string inputs(const CsyFields &fields) {
  std::string text;
  for (const auto &[member, value] : fields)
    text += fmt::format(", {} := {}", member, value);
  return text;
}

class ModuleWriter {
public:
  ModuleWriter(ProjectConfig &config, Diagnostics &diagnostics)
      : config_(config), diagnostics_(diagnostics) {
    for (const AxisGroupConfig &group : config.axisGroups) {
      for (const DriveConfig &drive : group.drives)
        axes_.emplace(lowerCase(drive.name.text), Axis{drive.name.text, group.task.text, &group});
      for (const EncoderConfig &encoder : group.encoders)
        encoders_.emplace(lowerCase(encoder.name.text),
                          Axis{encoder.name.text, group.task.text, &group});
    }
    for (const AxisConfig &axis : config.axes)
      axes_.emplace(lowerCase(axis.name.text), Axis{axis.name.text, axis.task.text, nullptr});
  }

  SyntheticSource write() {
    Unique places(Code::ConfigDuplicateName, diagnostics_);
    for (const CsyConfig &csy : config_.csy)
      if (places.add(fmt::format("{}.{}", csy.rack, csy.slot), csy.span,
                     fmt::format("two modules are in rack {}, slot {}", csy.rack, csy.slot)))
        addModule(csy);
    return std::move(out_);
  }

private:
  struct Axis {
    std::string_view name;
    std::string_view task;
    const AxisGroupConfig *group = nullptr; ///< of drives; null: an [[axis]]
  };
  using Axes = std::unordered_map<std::string, Axis>;

  Diagnostic &report(Code code, Span where, std::string message, std::string label) {
    return diagnostics_.report(code, where, std::move(message), std::move(label));
  }

  const Axis *find(const Axes &known, const ConfigName &name, std::string_view what,
                   std::string_view help) {
    if (const auto found = known.find(lowerCase(name.text)); found != known.end())
      return &found->second;
    Diagnostic &d = report(Code::ConfigUnknownAxis, name.span,
                           fmt::format("there is no {} `{}`", what, name.text), "not found");
    std::vector<std::string_view> names;
    for (const auto &[lower, axis] : known)
      names.push_back(axis.name);
    std::sort(names.begin(), names.end());
    if (const std::string_view near = nearest(name.text, names); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    else
      d.help(std::string(help));
    return nullptr;
  }

  /// All axes of a module are served by one task.
  void join(const Axis &axis, const ConfigName &name) {
    if (first_ == nullptr) {
      first_ = &name;
      task_ = axis.task;
    } else if (!equalIgnoringCase(task_, axis.task)) {
      report(Code::ConfigAxesTasks, name.span, "the axes of a module are served by two tasks",
             fmt::format("by task `{}`", axis.task))
          .label(first_->span, fmt::format("by task `{}`", task_))
          .help("give both the same `sTask`: a module moves all its axes in one cycle");
    }
    if (axis.group != nullptr &&
        std::find(groups_.begin(), groups_.end(), axis.group) == groups_.end())
      groups_.push_back(axis.group);
  }

  void addModule(const CsyConfig &csy) {
    const size_t errors = diagnostics_.errorCount();
    prefix_ = fmt::format("csy__{}_{}", csy.rack, csy.slot);
    place_ = fmt::format("{}.{}", csy.rack, csy.slot);
    first_ = nullptr;
    task_ = {};
    groups_.clear();
    variables_.clear();
    instances_.clear();
    calls_.clear();
    callsInStop_.clear();
    held_.clear();
    declareChannel("0", "T_CSY_RING");
    declareChannel("MOD", "T_GEN_MOD");
    declareInStop(0, "T_CSY_RING", csy.onStop);
    for (const CsyAxisConfig &axis : csy.axes)
      addAxis(axis);
    for (const CsyCamConfig &cam : csy.cams)
      addCam(cam);
    for (const CsyCoordinatedConfig &group : csy.coordinated)
      addCoordinated(group, csy);
    for (const CsyFollowerConfig &group : csy.followers)
      addFollower(group);
    if (first_ == nullptr && diagnostics_.errorCount() == errors)
      report(Code::ConfigMissingKey, csy.span, "the module has no axis", "needs [[csy.axis]]")
          .help("add `[[csy.axis]]` with `channel = 1` and `axis = \"…\"`");
    if (diagnostics_.errorCount() != errors)
      return;
    writeModule(csy);
    for (TaskConfig &task : config_.tasks)
      if (equalIgnoringCase(task.name.text, task_)) {
        task.programs.insert(task.programs.begin(), {prefix_ + "__service", csy.span});
        task.stopPrograms.push_back({prefix_ + "__stop", csy.span});
      }
  }

  /// In STOP a channel is served with other outputs than its own, which are the program's: with
  /// zeros, or with what the own ones were when STOP began.
  void declareInStop(uint32_t channel, std::string_view type, CsyOnStop onStop) {
    variables_ += fmt::format("  {{attribute 'hide'}}\n  {{attribute 'csy_stop'}}\n"
                              "  {}_{}_stop AT %CH{}.{} : CSY.{};\n",
                              prefix_, channel, place_, channel, type);
    if (onStop != CsyOnStop::Hold)
      return;
    for (const std::string &output : csyOutputsOf(channel))
      held_ += fmt::format("    {0}_{1}_stop.{2} := {0}_{1}.{2};\n", prefix_, channel, output);
  }

  void declareChannel(std::string_view channel, std::string_view type) {
    variables_ += fmt::format("  {{attribute 'hide'}}\n  {}_{} AT %CH{}.{} : CSY.{};\n", prefix_,
                              channel, place_, channel, type);
  }

  /// A function block that serves a channel. `onStop`: of channels with outputs.
  void serve(uint32_t channel, std::string_view block, std::string_view type,
             const std::string &settings, std::string_view arguments,
             std::optional<CsyOnStop> onStop) {
    declareChannel(fmt::format("{}", channel), type);
    if (onStop)
      declareInStop(channel, type, *onStop);
    instances_ +=
        fmt::format("  fb{0} : CSY.{1} := (iChannel := {0}{2});\n", channel, block, settings);
    const auto call = [&](std::string_view inStop) {
      return fmt::format("  fb{0}(Module := {1}, Channel := {1}_{0}{2}{3});\n", channel, prefix_,
                         inStop, arguments);
    };
    calls_ += call("");
    callsInStop_ += call(onStop ? "_stop" : "");
  }

  void addAxis(const CsyAxisConfig &axis) {
    const std::string parameters =
        axis.parameters.empty() ? std::string() : ", stConfigured := " + structure(axis.parameters);
    if (axis.channel >= kFirstRemote) {
      std::string encoder;
      if (axis.encoder.span.valid()) {
        const Axis *found = find(encoders_, axis.encoder, "encoder",
                                 "encoders are the names of [[bus.axis_group.encoder]]");
        if (found == nullptr)
          return;
        join(*found, axis.encoder);
        encoder = fmt::format(", pEncoder := ADR({})", found->name);
      }
      serve(axis.channel, "CSY_REMOTE", "T_CSY_IND", parameters + encoder, "", axis.onStop);
      return;
    }
    if (!axis.axis.span.valid())
      return; // reported
    const Axis *found = find(axes_, axis.axis, "axis",
                             "axes are the names of [[axis]] and [[bus.axis_group.drive]]");
    if (found == nullptr)
      return;
    join(*found, axis.axis);
    serve(axis.channel, "CSY_AXIS", "T_CSY_IND",
          fmt::format(", bImaginary := {}{}{}", axis.channel >= kFirstImaginary ? "TRUE" : "FALSE",
                      parameters, inputs(axis.inputs)),
          fmt::format(", Axis := {}", found->name), axis.onStop);
  }

  void addCam(const CsyCamConfig &cam) {
    const auto table = [&](std::string_view input, const ConfigName &name) {
      return name.span.valid() ? fmt::format(", {0} := ADR({1}), di{2} := SIZEOF({1}) / 4", input,
                                             name.text, input.substr(1))
                               : std::string();
    };
    for (const std::string_view array : {"Master", "Slave"})
      variables_ += fmt::format("  {{attribute 'hide'}}\n  {}_{}_{} : ARRAY[0..{}] OF LREAL;\n",
                                prefix_, cam.channel, array, cam.points - 1);
    serve(cam.channel, "CSY_CAM", "T_CSY_CAM",
          fmt::format(", diPoints := {0}, pMaster := ADR({1}_{2}_Master), pSlave := "
                      "ADR({1}_{2}_Slave){3}{4}{5}",
                      cam.points, prefix_, cam.channel, inputs(cam.inputs),
                      table("pMasterTable", cam.masterTable), table("pSlaveTable", cam.slaveTable)),
          "", std::nullopt);
  }

  void addFollower(const CsyFollowerConfig &group) {
    std::string slaves;
    size_t byCams = 0;
    for (const CsyFields &slave : group.slaves) {
      slaves += (slaves.empty() ? "" : ", ") + structure(slave);
      for (const auto &[member, value] : slave)
        byCams += member == "bCam" && value == "TRUE" ? 1 : 0;
    }
    std::string path;
    if (byCams >= kLeastAxesOfPath) {
      variables_ += fmt::format("  {{attribute 'hide'}}\n  {}_{}_Path : CSY.CSY_PATH_STATE;\n",
                                prefix_, group.channel);
      path = fmt::format(", pPath := ADR({}_{}_Path)", prefix_, group.channel);
    }
    serve(group.channel, "CSY_FOLLOWER", "T_CSY_FOLLOW",
          fmt::format(", iMaster := {}{}{}", group.master,
                      slaves.empty() ? std::string() : ", astConfigured := [" + slaves + "]", path),
          "", group.onStop);
  }

  void addCoordinated(const CsyCoordinatedConfig &group, const CsyConfig &csy) {
    std::vector<uint32_t> members;
    for (const ConfigName &name : group.axes) {
      const auto axis =
          std::find_if(csy.axes.begin(), csy.axes.end(), [&](const CsyAxisConfig &candidate) {
            return equalIgnoringCase(candidate.axis.text, name.text);
          });
      if (axis != csy.axes.end())
        members.push_back(axis->channel);
      else
        report(Code::ConfigUnknownAxis, name.span,
               fmt::format("`{}` is no axis of this module", name.text), "not found")
            .help("name axes of [[csy.axis]]");
    }
    serve(group.channel, "CSY_COORDINATED", "T_CSY_COORD",
          fmt::format(", aiConfigured := [{}]", fmt::join(members, ", ")), "", group.onStop);
  }

  void writeModule(const CsyConfig &csy) {
    out_.add("VAR_GLOBAL\n");
    out_.add(variables_, csy.span);
    out_.add(fmt::format("  {{attribute 'hide'}}\n  {} : CSY.CSY_MODULE;\nEND_VAR\n", prefix_));
    std::string groups;
    for (const AxisGroupConfig *group : groups_)
      groups += fmt::format("{}ADR({})", groups.empty() ? "" : ", ", group->name.text);
    if (!groups.empty())
      groups = fmt::format(", iGroups := {}, apGroup := [{}]", groups_.size(), groups);
    for (const AxisGroupConfig *group : groups_)
      if (group->shared != nullptr && group->shared->type == "SercosDrive.SERCOS_RING_SIM") {
        groups += fmt::format(", pRing := ADR({})", sharedVariable(*group));
        break;
      }
    out_.add(fmt::format("{{attribute 'hide'}}\nPROGRAM {}__service\nVAR\n"
                         "  fb0 : CSY.CSY_RING := (iRack := {}, iSlot := {}, pMemory := "
                         "ADR(%MW0){}{});\n{}  bWasInStop : BOOL;\nEND_VAR\n",
                         prefix_, csy.rack, csy.slot, inputs(csy.inputs), groups, instances_),
             csy.span);
    out_.add(fmt::format(
                 "IF {0}.bInStop THEN\n  IF NOT bWasInStop THEN\n    bWasInStop := TRUE;\n{1}"
                 "  END_IF\n  fb0(Module := {0}, Channel := {0}_0_stop, General := {0}_MOD);\n{2}"
                 "ELSE\n  bWasInStop := FALSE;\n"
                 "  fb0(Module := {0}, Channel := {0}_0, General := {0}_MOD);\n{3}"
                 "END_IF\nEND_PROGRAM\n"
                 "{{attribute 'hide'}}\nPROGRAM {0}__stop\n{0}.bInStop := TRUE;\n"
                 "{0}__service();\n{0}.bInStop := FALSE;\nEND_PROGRAM\n",
                 prefix_, held_, callsInStop_, calls_),
             csy.span);
  }

  ProjectConfig &config_;
  Diagnostics &diagnostics_;
  Axes axes_;
  Axes encoders_;
  SyntheticSource out_{"<plc>/TSX_CSY_85.st"};
  // Of the module that is being written:
  std::string prefix_;
  std::string place_;
  const ConfigName *first_ = nullptr; ///< the first axis
  std::string_view task_;
  std::vector<const AxisGroupConfig *> groups_;
  std::string variables_;
  std::string instances_;
  std::string calls_;
  std::string callsInStop_;
  std::string held_; ///< outputs that are kept when STOP begins
};

} // namespace

SyntheticSource csyDeclarations(ProjectConfig &config, Diagnostics &diagnostics) {
  return ModuleWriter(config, diagnostics).write();
}

} // namespace stc
