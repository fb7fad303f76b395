#include "compiler/project/config.hpp"

#include "compiler/project/interval.hpp"
#include "compiler/project/io_config.hpp"
#include "compiler/project/names.hpp"
#include "compiler/project/schema.hpp"
#include "compiler/project/toml_tree.hpp"
#include "compiler/semantics/suggest.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace stc {

namespace {

constexpr std::array<std::string_view, 1> kDrivers = {"Dummy"};
constexpr int kConfigurable = 0; // wControlType
constexpr int kPosVelToPosVel = 5;
constexpr int kRotary = 0;
constexpr int kLinear = 1;
constexpr double kLargestPeriod = 2147483648.0; // increments: 16#80000000

std::string realLiteral(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".") == std::string::npos) {
    const std::size_t exponent = text.find('e');
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  }
  return text;
}

ConfigName nameOf(const CheckedSection &section) {
  const TomlNode *name = section.get("name");
  return name != nullptr ? ConfigName{name->text, name->span} : ConfigName{};
}

// Reports the second use of a name or number, with the first one marked.
class Unique {
public:
  Unique(Code code, Diagnostics &diagnostics) : code_(code), diagnostics_(diagnostics) {}

  bool add(const std::string &key, Span where, const std::string &message) {
    const auto [first, isNew] = seen_.try_emplace(key, where);
    if (!isNew)
      diagnostics_.report(code_, where, message, "used again here")
          .label(first->second, "first used here");
    return isNew;
  }

private:
  Code code_;
  Diagnostics &diagnostics_;
  std::unordered_map<std::string, Span> seen_;
};

class Reader {
public:
  Reader(const SourceFile &file, Diagnostics &diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  ProjectConfig read() {
    const std::unique_ptr<TomlNode> document = parseToml(file_, diagnostics_);
    if (document == nullptr) {
      config_.incomplete = true;
      return std::move(config_);
    }
    const CheckedSection top(*document, projectSchema(), diagnostics_);
    for (const CheckedSection &levels : top.sections("diagnostics", diagnostics_))
      readLevels(levels);
    for (const CheckedSection &project : top.sections("project", diagnostics_)) {
      config_.name = project.text("name");
      config_.poolSize =
          (static_cast<std::uint64_t>(project.integer("new_pool", 65536)) + 15) / 16 * 16;
      config_.generation = static_cast<unsigned>(project.choice("softmotion", 2));
      config_.pack = static_cast<unsigned>(project.choice("layout", 0));
      if (const TomlNode *defines = project.get("defines"))
        for (const TomlNode &one : defines->children)
          readDefine(one);
    }
    for (const CheckedSection &image : top.sections("image", diagnostics_)) {
      config_.addressing = static_cast<Addressing>(image.choice("addressing", 0));
      std::size_t area = 0;
      for (const std::string_view name : {"inputs", "outputs", "memory"})
        config_.imageBytes[area++] = static_cast<std::uint32_t>(image.integer(name, 0));
    }
    for (const CheckedSection &retain : top.sections("retain", diagnostics_)) {
      config_.retainFile = retain.text("file");
      config_.retainPeriodNs = parseInterval(retain.text("period")).value_or(0);
    }
    for (const CheckedSection &task : top.sections("task", diagnostics_))
      readTask(task);
    for (const CheckedSection &bus : top.sections("bus", diagnostics_))
      readBus(bus);
    for (const CheckedSection &io : top.sections("io", diagnostics_))
      readIoDevice(io, config_, diagnostics_);
    return std::move(config_);
  }

private:
  // What the command line says about a code stays.
  void readLevels(const CheckedSection &section) {
    Levels levels;
    for (const TomlNode &member : section.table().children) {
      if (section.get(member.key) == nullptr)
        continue;
      const auto severity = static_cast<Severity>(section.choice(member.key, 0));
      if (const std::optional<Levels::Group> group = findGroup(member.key))
        levels.set(*group, severity);
      else if (const CodeInfo *code = findCode(member.key))
        levels.set(code->code, severity);
    }
    levels.add(diagnostics_.levels());
    diagnostics_.setLevels(std::move(levels));
  }

  void readDefine(const TomlNode &node) {
    if (const std::optional<Define> define = stc::readDefine(node.text))
      config_.defines.push_back(*define);
    else
      diagnostics_
          .report(Code::configBadName, node.span, fmt::format("`{}` cannot be defined", node.text),
                  "not a name")
          .help("write \"NAME\" or \"NAME=VALUE\"");
  }

  void readTask(const CheckedSection &section) {
    TaskConfig task;
    task.name = nameOf(section);
    if (task.name.span.valid() &&
        !taskNames_.add(lowerCase(task.name.text), task.name.span,
                        fmt::format("two tasks are named `{}`", task.name.text)))
      return;
    task.start = static_cast<TaskStart>(
        section.choice("kind", static_cast<std::int64_t>(TaskStart::cyclic)));
    readStart(section, task);
    task.watchdogNs = parseInterval(section.text("watchdog")).value_or(0);
    task.watchdogSensitivity = static_cast<unsigned>(section.integer("watchdog_sensitivity", 1));
    if (section.has("watchdog_sensitivity") && !section.has("watchdog"))
      withoutEffect(section, "watchdog_sensitivity", "only together with `watchdog`");
    if (section.has("core"))
      task.core = static_cast<unsigned>(section.integer("core", 0));
    task.priority = static_cast<unsigned>(section.integer("priority", 1));
    if (const TomlNode *programs = section.get("programs"))
      for (const TomlNode &program : programs->children)
        task.programs.push_back({program.text, program.span});
    config_.tasks.push_back(std::move(task));
  }

  /// What starts it: an interval, an event, or nothing.
  void readStart(const CheckedSection &section, TaskConfig &task) {
    if (section.has("kind") && section.get("kind") == nullptr)
      return;                                     // unknown, which has been reported
    constexpr std::int64_t kOwnPace = 10'000'000; // of freewheeling and status tasks
    task.intervalNs = parseInterval(section.text("interval")).value_or(0);
    const bool onEvent = task.start == TaskStart::event || task.start == TaskStart::status;
    if (onEvent) {
      if (const TomlNode *event = section.get("event"))
        task.event = {event->text, event->span};
      else if (!section.has("event"))
        missing(section, "event", "the BOOL that starts it, for example \"GVL.bStart\"");
    } else if (section.has("event")) {
      withoutEffect(section, "event", "only with kind = \"event\" or \"status\"");
    }
    if (task.start == TaskStart::cyclic && !section.has("interval"))
      missing(section, "interval", "a duration such as \"T#10ms\"");
    if (task.intervalNs == 0 &&
        (task.start == TaskStart::freewheeling || task.start == TaskStart::status))
      task.intervalNs = kOwnPace;
  }

  void readBus(const CheckedSection &section) {
    const ConfigName name = nameOf(section);
    if (name.span.valid())
      busNames_.add(lowerCase(name.text), name.span,
                    fmt::format("two buses are named `{}`", name.text));
    std::string driver;
    if (const TomlNode *type = section.get("InterfaceType"))
      driver = readDriver(*type);
    for (const CheckedSection &group : section.sections("axis_group", diagnostics_))
      readAxisGroup(group, name.text, driver);
  }

  std::string readDriver(const TomlNode &type) {
    const std::string word = type.text.substr(0, type.text.find(' '));
    for (const std::string_view driver : kDrivers)
      if (driver == word)
        return word;
    Diagnostic &d =
        diagnostics_.report(Code::configUnknownDriver, type.span,
                            fmt::format("there is no driver `{}`", word), "names the driver");
    const std::vector<std::string_view> known(kDrivers.begin(), kDrivers.end());
    if (const std::string_view near = nearest(word, known); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    d.note("the text before the first blank of InterfaceType names the driver; known: "
           "\"Dummy (simulated drives)\"");
    return {};
  }

  void readAxisGroup(const CheckedSection &section, const std::string &bus,
                     const std::string &driver) {
    AxisGroupConfig group;
    group.name = nameOf(section);
    group.groupSpan = section.table().span;
    group.bus = bus;
    group.driver = driver;
    if (const TomlNode *task = section.get("sTask"))
      group.task = {task->text, task->span};
    if (const TomlNode *cycle = section.get("dwCycle")) {
      group.cycleUs = static_cast<std::uint32_t>(cycle->integer);
      group.cycleSpan = cycle->span;
    }
    for (const std::string_view name : {"wParam1", "wParam2", "wParam3", "wParam4", "dwParam1",
                                        "dwParam2", "dwParam3", "dwParam4"})
      if (const TomlNode *value = section.get(name))
        group.fields.emplace_back(name, std::to_string(value->integer));
    const bool declared = addVariable(group.name);
    Unique ids(Code::configDuplicateDriveId, diagnostics_);
    for (const CheckedSection &drive : section.sections("drive", diagnostics_))
      readDrive(drive, group, ids);
    if (declared)
      config_.axisGroups.push_back(std::move(group));
  }

  bool addVariable(const ConfigName &name) {
    if (name.span.valid() &&
        variableNames_.add(
            lowerCase(name.text), name.span,
            fmt::format("the PLC configuration uses the name `{}` twice", name.text)))
      return true;
    config_.incomplete = config_.incomplete || !name.span.valid();
    return false;
  }

  void readDrive(const CheckedSection &section, AxisGroupConfig &group, Unique &ids) {
    DriveConfig drive;
    drive.name = nameOf(section);
    if (const TomlNode *id = section.get("wDriveId"))
      ids.add(std::to_string(id->integer), id->span,
              fmt::format("two drives of axis group `{}` have the wDriveId {}", group.name.text,
                          id->integer));
    drive.fields.emplace_back("wDriveId", std::to_string(section.integer("wDriveId", 0)));
    drive.fields.emplace_back("bRealDrive", "TRUE");
    readCyclicData(section, drive.fields);
    for (const std::string_view name : {"dwRatioTechUnitsDenom", "iRatioTechUnitsNum"})
      if (const TomlNode *value = section.get(name))
        drive.fields.emplace_back(name, std::to_string(value->integer));
    readMovement(section, drive);
    for (const std::string_view name :
         {"fSWMaxVelocity", "fSWMaxAcceleration", "fSWMaxDeceleration"})
      if (const TomlNode *value = section.get(name))
        drive.fields.emplace_back(name, realLiteral(value->floating));
    if (const TomlNode *value = section.get("bHWLimitEnable"))
      drive.fields.emplace_back("bHWLimitEnable", value->boolean ? "TRUE" : "FALSE");
    readRamp(section, drive);
    if (addVariable(drive.name))
      group.drives.push_back(std::move(drive));
  }

  void readCyclicData(const CheckedSection &section, ConfigFields &fields) {
    const std::int64_t type = section.choice("wControlType", kPosVelToPosVel);
    fields.emplace_back("wControlType", std::to_string(type));
    bool torque = type == 1;
    bool velocity = type == 2 || type == 3 || type == 6;
    bool position = type == 4 || type == 5;
    for (const std::string_view name : {"wCyclicDataS1", "wCyclicDataS2", "wCyclicDataS3",
                                        "wCyclicDataR1", "wCyclicDataR2", "wCyclicDataR3"}) {
      if (section.get(name) == nullptr)
        continue;
      const std::int64_t number = section.choice(name, 0);
      fields.emplace_back(name, std::to_string(number));
      if (type != kConfigurable) {
        withoutEffect(section, name, "only with wControlType = \"CONFIGURABLE\"");
        continue;
      }
      position = position || number == 1100;
      velocity = velocity || number == 1110;
      torque = torque || number == 1160;
    }
    if (position || velocity || torque)
      fields.emplace_back("byControllerMode", position ? "3" : velocity ? "2" : "1");
  }

  void readMovement(const CheckedSection &section, DriveConfig &drive) {
    const auto type = section.choice("iMovementType", kLinear);
    drive.fields.emplace_back("iMovementType", std::to_string(type));
    const TomlNode *period = section.get("fPositionPeriod");
    if (type == kRotary && !section.has("fPositionPeriod"))
      diagnostics_
          .report(Code::configMissingKey, section.get("iMovementType")->span,
                  "a rotary drive needs `fPositionPeriod`", "makes the drive rotary")
          .help("add the length of one turn in technical units, for example `fPositionPeriod = "
                "360.0`");
    if (period != nullptr) {
      drive.fields.emplace_back("fPositionPeriod", realLiteral(period->floating));
      if (type == kRotary)
        checkPeriod(section, *period);
      else if (section.get("iMovementType") != nullptr || !section.has("iMovementType"))
        withoutEffect(section, "fPositionPeriod", "only for rotary drives");
    }
    readLimits(section, drive, type == kRotary);
  }

  // The period in increments must be at least one and fit the drive's 32-bit position (manual,
  // section 2.1.3).
  void checkPeriod(const CheckedSection &section, const TomlNode &period) {
    const double denominator = section.real("dwRatioTechUnitsDenom", 1);
    const double numerator = section.real("iRatioTechUnitsNum", 1);
    const double increments = period.floating * denominator / numerator;
    if (increments < 1.0) {
      diagnostics_
          .report(Code::configOutOfRange, period.span,
                  "one period of the drive must be at least one increment",
                  fmt::format("{} u × {} / {} = {:.15g} increments", period.floating, denominator,
                              numerator, increments))
          .help("give the ratio of increments to technical units with dwRatioTechUnitsDenom and "
                "iRatioTechUnitsNum");
      return;
    }
    if (increments <= kLargestPeriod)
      return;
    Diagnostic &d =
        diagnostics_.report(Code::configPeriodTooLarge, period.span,
                            "one period of the drive is more than 16#80000000 increments",
                            fmt::format("{} u × {} / {} = {:.15g} increments", period.floating,
                                        denominator, numerator, increments));
    if (const TomlNode *ratio = section.get("dwRatioTechUnitsDenom"))
      d.label(ratio->span, "increments …");
    if (const TomlNode *ratio = section.get("iRatioTechUnitsNum"))
      d.label(ratio->span, "… per so many units");
    d.help(fmt::format("with this ratio the period can be at most {:.15g} u",
                       std::floor(kLargestPeriod * numerator / denominator)));
  }

  void readLimits(const CheckedSection &section, DriveConfig &drive, bool rotary) {
    const bool enabled = section.boolean("bSWLimitEnable", false);
    if (section.get("bSWLimitEnable") != nullptr)
      drive.fields.emplace_back("bSWLimitEnable", enabled ? "TRUE" : "FALSE");
    for (const std::string_view name : {"fSWLimitNegative", "fSWLimitPositive"})
      if (const TomlNode *value = section.get(name))
        drive.fields.emplace_back(name, realLiteral(value->floating));
    if (!enabled)
      return;
    if (rotary) {
      withoutEffect(section, "bSWLimitEnable", "only for linear drives");
      return;
    }
    const TomlNode *low = section.get("fSWLimitNegative");
    const TomlNode *high = section.get("fSWLimitPositive");
    if (low != nullptr && high != nullptr && low->floating < high->floating)
      return;
    if (section.has("fSWLimitNegative") && section.has("fSWLimitPositive") &&
        (low == nullptr || high == nullptr))
      return; // wrong and reported
    if (low != nullptr && high != nullptr) {
      diagnostics_
          .report(Code::configLimits, low->span,
                  "fSWLimitNegative must be less than fSWLimitPositive", "not less than …")
          .label(high->span, "… this");
      return;
    }
    diagnostics_
        .report(Code::configLimits, section.get("bSWLimitEnable")->span,
                "software limits are switched on but not both given", "needs both limits")
        .help("add `fSWLimitNegative = …` and `fSWLimitPositive = …`");
  }

  void readRamp(const CheckedSection &section, DriveConfig &drive) {
    constexpr std::array<std::string_view, 3> kNames = {"trapezoid", "sigmoid", "parabolic"};
    const auto ramp = static_cast<std::size_t>(section.choice("eRampType", 0));
    if (section.get("eRampType") != nullptr)
      drive.fields.emplace_back("eRampType", fmt::format("SMC_RAMPTYPE.{}", kNames[ramp]));
    if (const TomlNode *jerk = section.get("fJerk"))
      drive.fields.emplace_back("fJerk", realLiteral(jerk->floating));
    if (ramp != 0 && !section.has("fJerk"))
      diagnostics_
          .report(Code::configMissingKey, section.get("eRampType")->span,
                  fmt::format("the ramp type \"{}\" needs `fJerk`", kNames[ramp]),
                  "limits the jerk")
          .help("add the largest jerk in u/s³, for example `fJerk = 20000.0`");
    else if (ramp == 0 && section.get("fJerk") != nullptr)
      withoutEffect(section, "fJerk", "only with eRampType = \"sigmoid\" or \"parabolic\"");
  }

  void missing(const CheckedSection &section, std::string_view name, std::string_view what) {
    diagnostics_
        .report(Code::configMissingKey, section.table().span,
                fmt::format("a task needs `{}`", name), fmt::format("`{}` is missing", name))
        .help(fmt::format("add `{} = …`: {}", name, what));
  }

  void withoutEffect(const CheckedSection &section, std::string_view name,
                     std::string_view reason) {
    diagnostics_.report(Code::configWithoutEffect, section.get(name)->keySpan,
                        fmt::format("`{}` has no effect here", name),
                        fmt::format("counts {}", reason));
  }

  const SourceFile &file_;
  Diagnostics &diagnostics_;
  ProjectConfig config_;
  Unique taskNames_{Code::configDuplicateName, diagnostics_};
  Unique busNames_{Code::configDuplicateName, diagnostics_};
  Unique variableNames_{Code::configDuplicateName, diagnostics_};
};

} // namespace

ProjectConfig readConfig(const SourceFile &toml, Diagnostics &diagnostics) {
  return Reader(toml, diagnostics).read();
}

} // namespace stc
