// The PLC configuration: SoftMotion V2.3 manual, section 2.1.

#include "compiler/project/config_reader.hpp"
#include "compiler/project/driver_sections.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/st_text.hpp"
#include "drivers/registry.hpp"
#include "runtime/bus/plc_schema.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace stc {

namespace {

using stride::bus::plc::kConfigurable;
using stride::bus::plc::kRotary;

constexpr std::array<std::string_view, 4> kMotionLimits = {"fSWMaxVelocity", "fSWMaxAcceleration",
                                                           "fSWMaxDeceleration", "fSWMaxJerk"};
constexpr double kLargestPeriod = 2147483648.0; // increments: 16#80000000
constexpr int64_t kCanFastest = 1000;           // kBit/s
constexpr int64_t kSercosSlowest = 2000;

void integerField(const CheckedSection &section, std::string_view name, ConfigFields &fields) {
  if (const TomlNode *value = section.get(name))
    fields.emplace_back(name, std::to_string(value->integer));
}

void realField(const CheckedSection &section, std::string_view name, ConfigFields &fields) {
  if (const TomlNode *value = section.get(name))
    fields.emplace_back(name, realLiteral(value->floating));
}

void flagField(const CheckedSection &section, std::string_view name, ConfigFields &fields) {
  if (const TomlNode *value = section.get(name))
    fields.emplace_back(name, value->boolean ? "TRUE" : "FALSE");
}

std::string plural(std::string_view what) {
  return what == "axis" ? "axes" : std::string(what) + "s";
}

} // namespace

void PlcReader::readBus(const CheckedSection &section) {
  BusConfig bus;
  bus.name = nameOf(section);
  if (bus.name.span.valid())
    busNames_.add(lowerCase(bus.name.text), bus.name.span,
                  fmt::format("two buses are named `{}`", bus.name.text));
  BusKind kind = BusKind::Any;
  if (const TomlNode *type = section.get("InterfaceType")) {
    bus.driver = readDriver(*type);
    bus.interfaceType = type->text;
    // "Dummy (CAN)": simulated drives that stand for some on a CAN bus
    const std::string lower = lowerCase(type->text);
    if (lower.starts_with("can") || lower.find("(can") != std::string::npos)
      kind = BusKind::Can;
    else if (lower.starts_with("sercos") || lower.find("(sercos") != std::string::npos)
      kind = BusKind::Sercos;
  }
  addParameters(section, "", bus.parameters);
  checkRules(section, {.what = "bus"}, diagnostics_);
  for (const CheckedSection &group : section.sections("axis_group", diagnostics_))
    readAxisGroup(group, bus, kind);
  config_.buses.push_back(std::move(bus));
}

std::string PlcReader::readDriver(const TomlNode &type) {
  std::string word(driverOf(type.text));
  if (stride::drivers::findSchema(word) != nullptr)
    return word;
  Diagnostic &d =
      diagnostics_.report(Code::ConfigUnknownDriver, type.span,
                          fmt::format("there is no driver `{}`", word), "names the driver");
  std::vector<std::string_view> known;
  std::string examples;
  for (const stride::bus::DriverSchema *driver : stride::drivers::kSchemas) {
    known.push_back(driver->name);
    examples += fmt::format("{}\"{}\"", examples.empty() ? "" : ", ", driver->interfaceType);
  }
  if (const std::string_view near = nearest(word, known); !near.empty())
    d.help(fmt::format("did you mean `{}`?", near));
  else if (equalIgnoringCase(word, "CAN") || equalIgnoringCase(word, "Sercos"))
    d.help(fmt::format("\"{} ({})\" simulates the drives of such a bus",
                       stride::drivers::kSchemas.front()->name, word));
  d.note("the text before the first blank of InterfaceType names the driver; known: " + examples);
  return {};
}

void PlcReader::readAxisGroup(const CheckedSection &section, BusConfig &bus, BusKind kind) {
  AxisGroupConfig group;
  group.name = nameOf(section);
  group.groupSpan = section.table().span;
  group.bus = config_.buses.size();
  group.driver = bus.driver;
  if (const TomlNode *task = section.get("sTask"))
    group.task = {task->text, task->span};
  if (const TomlNode *cycle = section.get("dwCycle")) {
    group.cycleUs = static_cast<uint32_t>(cycle->integer);
    group.cycleSpan = cycle->span;
  }
  for (const std::string_view name :
       {"wParam1", "wParam2", "wParam3", "wParam4", "dwParam1", "dwParam2", "dwParam3", "dwParam4"})
    integerField(section, name, group.fields);
  readBaudRate(section, kind);
  readCan(section, group, kind);
  readSercos(section, group, kind);
  addParameters(section, "", group.parameters);
  readDriverTables(section, {.what = "axis group", .group = &group}, group.parameters,
                   diagnostics_);
  const stride::bus::DriverSchema *driver = stride::drivers::findSchema(group.driver);
  if (driver != nullptr && !driver->groupData.type.empty())
    group.shared = &driver->groupData;
  const bool declared =
      addVariable(group.name) &&
      (group.shared == nullptr || addVariable({sharedVariable(group), group.name.span}));
  Unique driveIds(Code::ConfigDuplicateDriveId, diagnostics_);
  for (const CheckedSection &drive : section.sections("drive", diagnostics_))
    readDrive(drive, group, driveIds);
  Unique encoderIds(Code::ConfigDuplicateDriveId, diagnostics_);
  for (const CheckedSection &encoder : section.sections("encoder", diagnostics_))
    readEncoder(encoder, group, encoderIds);
  if (declared) {
    ++bus.axisGroups;
    config_.axisGroups.push_back(std::move(group));
  }
}

void PlcReader::readBaudRate(const CheckedSection &section, BusKind kind) {
  const TomlNode *rate = section.get("BaudRate");
  if (rate == nullptr)
    return;
  const int64_t value = section.choice("BaudRate", 0);
  if (kind == BusKind::Any) {
    withoutEffect(diagnostics_, section, "BaudRate", "for CAN and Sercos buses only");
    return;
  }
  const bool fits = kind == BusKind::Can ? value <= kCanFastest : value >= kSercosSlowest;
  if (!fits)
    diagnostics_
        .report(Code::ConfigOutOfRange, rate->span,
                fmt::format("{} has no baud rate of {} kBit/s",
                            kind == BusKind::Can ? "a CAN bus" : "Sercos", value),
                "does not fit the bus")
        .note(kind == BusKind::Can ? "possible: 10, 20, 50, 100, 125, 250, 500, 800, 1000 kBit/s"
                                   : "possible: 2000, 4000, 8000, 16000 kBit/s");
}

void PlcReader::readCan(const CheckedSection &section, AxisGroupConfig &group, BusKind kind) {
  if (kind == BusKind::Can) {
    if (const TomlNode *producer = section.get("SyncProducer"))
      group.syncProducer = {producer->text, producer->span};
    return;
  }
  for (const std::string_view name : {"ControllerNo", "SyncProducer"})
    if (section.get(name) != nullptr)
      withoutEffect(diagnostics_, section, name, "for CAN buses only");
}

// Sercos cards take the baud rate from wParam1 and the brightness from wParam2 (manual, 11.2).
void PlcReader::readSercos(const CheckedSection &section, AxisGroupConfig &group, BusKind kind) {
  if (kind != BusKind::Sercos) {
    if (section.get("LedBrightness") != nullptr)
      withoutEffect(diagnostics_, section, "LedBrightness", "for Sercos buses only");
    return;
  }
  const auto pass = [&](std::string_view name, std::string_view word, int64_t value) {
    const TomlNode *given = section.get(name);
    const TomlNode *parameter = section.get(word);
    if (given == nullptr)
      return;
    if (parameter == nullptr)
      group.fields.emplace_back(word, std::to_string(value));
    else if (parameter->integer != value)
      diagnostics_
          .report(Code::ConfigOutOfRange, parameter->span,
                  fmt::format("`{}` contradicts `{}`", word, name),
                  fmt::format("would have to be {}", value))
          .label(given->span, "the same, said otherwise")
          .help(fmt::format("leave `{}` out", word));
  };
  pass("BaudRate", "wParam1", section.choice("BaudRate", 0) / 1000);
  pass("LedBrightness", "wParam2", section.integer("LedBrightness", 0));
}

bool PlcReader::addVariable(const ConfigName &name) {
  if (name.span.valid() &&
      variableNames_.add(lowerCase(name.text), name.span,
                         fmt::format("the PLC configuration uses the name `{}` twice", name.text)))
    return true;
  config_.incomplete = config_.incomplete || !name.span.valid();
  return false;
}

void PlcReader::readDrive(const CheckedSection &section, AxisGroupConfig &group, Unique &ids) {
  DriveConfig drive;
  drive.name = nameOf(section);
  // Drives on CAN may be axes of one node.
  const TomlNode *axis = section.get("axis");
  if (const TomlNode *id = section.get("wDriveId"))
    ids.add(fmt::format("{}.{}", id->integer, axis != nullptr ? axis->integer : 0), id->span,
            fmt::format("two drives of axis group `{}` have the wDriveId {}", group.name.text,
                        id->integer));
  drive.id = static_cast<uint32_t>(section.integer("wDriveId", 0));
  drive.unit = unitOf(section);
  drive.fields.emplace_back("wDriveId", std::to_string(drive.id));
  drive.fields.emplace_back("bRealDrive", "TRUE");
  readCyclicData(section, drive.fields);
  readScaling(section, drive.fields, "drive");
  for (const std::string_view name : kMotionLimits)
    realField(section, name, drive.fields);
  const bool rotary = section.choice("iMovementType") == kRotary;
  flagField(section, "bHWLimitEnable", drive.fields);
  if (rotary && section.boolean("bHWLimitEnable", false))
    withoutEffect(diagnostics_, section, "bHWLimitEnable", "only for linear drives");
  readRamp(section, drive.fields);
  addParameters(section, "", drive.parameters);
  readDriverTables(section, {.what = "drive", .rotary = rotary, .group = &group}, drive.parameters,
                   diagnostics_);
  drive.shared = sharedDataOf(section, group.driver);
  if (!addVariable(drive.name))
    return;
  if (drive.shared != nullptr && !addVariable({sharedVariable(drive), drive.name.span}))
    return;
  group.drives.push_back(std::move(drive));
}

// What people write behind a number: a word without blanks.
std::string PlcReader::unitOf(const CheckedSection &section) {
  constexpr size_t kLongest = 16;
  const TomlNode *unit = section.get("unit");
  if (unit == nullptr)
    return {};
  const bool good = !unit->text.empty() && unit->text.size() <= kLongest &&
                    std::none_of(unit->text.begin(), unit->text.end(), [](char c) {
                      return static_cast<unsigned char>(c) <= ' ' || c == '"' || c == '\\' ||
                             c == ']' || c == 0x7F;
                    });
  if (good)
    return unit->text;
  diagnostics_
      .report(Code::ConfigOutOfRange, unit->span,
              fmt::format("`unit` must be a word of at most {} bytes", kLongest), "is none")
      .help("write for example `unit = \"mm\"`; blanks, `\"`, `\\` and `]` cannot be in it");
  return {};
}

void PlcReader::readCyclicData(const CheckedSection &section, ConfigFields &fields) {
  const int64_t type = section.choice("wControlType");
  fields.emplace_back("wControlType", std::to_string(type));
  bool torque = type == 1;
  bool velocity = type == 2 || type == 3 || type == 6;
  bool position = type == 4 || type == 5;
  bool current = false;
  for (const std::string_view name : {"wCyclicDataS1", "wCyclicDataS2", "wCyclicDataS3",
                                      "wCyclicDataR1", "wCyclicDataR2", "wCyclicDataR3"}) {
    if (section.get(name) == nullptr)
      continue;
    const int64_t number = section.choice(name, 0);
    fields.emplace_back(name, std::to_string(number));
    if (type != kConfigurable) {
      withoutEffect(diagnostics_, section, name, "only with wControlType = \"CONFIGURABLE\"");
      continue;
    }
    position = position || number == 1100;
    velocity = velocity || number == 1110;
    torque = torque || number == 1160;
    current = current || number == 1150;
  }
  if (type == kConfigurable) {
    const bool sends = checkCyclicData(section, "wCyclicDataS");
    checkCyclicData(section, "wCyclicDataR");
    if (!sends)
      diagnostics_
          .report(Code::ConfigMissingKey, section.get("wControlType")->span,
                  "a drive with wControlType = \"CONFIGURABLE\" needs `wCyclicDataS1`",
                  "sends nothing to the drive")
          .help("add what is sent in every cycle, for example `wCyclicDataS1 = \"SetPosition\"`");
  }
  if (position || velocity || torque || current)
    fields.emplace_back("byControllerMode", position ? "3" : velocity ? "2" : torque ? "1" : "4");
}

// Whether any is given, right or wrong; a value that travels twice is reported.
bool PlcReader::checkCyclicData(const CheckedSection &section, std::string_view direction) {
  Unique values(Code::ConfigDuplicateName, diagnostics_);
  bool any = false;
  for (const char place : {'1', '2', '3'}) {
    const std::string name = std::string(direction) + place;
    any = any || section.has(name);
    if (const TomlNode *value = section.get(name))
      values.add(std::to_string(section.choice(name, 0)), value->span,
                 direction.ends_with('S') ? "the same value is sent twice in a cycle"
                                          : "the same value is received twice in a cycle");
  }
  return any;
}

void PlcReader::readEncoder(const CheckedSection &section, AxisGroupConfig &group, Unique &ids) {
  EncoderConfig encoder;
  encoder.name = nameOf(section);
  if (const TomlNode *id = section.get("wEncoderId"))
    ids.add(std::to_string(id->integer), id->span,
            fmt::format("two encoders of axis group `{}` have the wEncoderId {}", group.name.text,
                        id->integer));
  encoder.id = static_cast<uint32_t>(section.integer("wEncoderId", 0));
  integerField(section, "wEncoderId", encoder.fields);
  readScaling(section, encoder.fields, "encoder");
  integerField(section, "dwEncoderModulo", encoder.fields);
  if (const TomlNode *modulo = section.get("dwEncoderModulo");
      modulo != nullptr && modulo->integer == 1)
    diagnostics_
        .report(Code::ConfigOutOfRange, modulo->span,
                "`dwEncoderModulo` must be 0 or at least 2 increments",
                "an encoder that never moves")
        .help("0 stands for 32 bits, 65536 for 16 bits, 4096 for 12 bits");
  for (const std::string_view name : {"dwParam1", "dwParam2", "dwParam3", "dwParam4", "dwParam5",
                                      "dwParam6", "dwParam7", "dwParam8"})
    integerField(section, name, encoder.fields);
  addParameters(section, "", encoder.parameters);
  const bool rotary = section.choice("iMovementType") == kRotary;
  readDriverTables(section, {.what = "encoder", .rotary = rotary, .group = &group},
                   encoder.parameters, diagnostics_);
  if (addVariable(encoder.name))
    group.encoders.push_back(std::move(encoder));
}

void PlcReader::readAxis(const CheckedSection &section) {
  AxisConfig axis;
  axis.name = nameOf(section);
  axis.section = section.table().span;
  if (const TomlNode *task = section.get("sTask"))
    axis.task = {task->text, task->span};
  if (const TomlNode *cycle = section.get("dwCycle")) {
    axis.cycleUs = static_cast<uint32_t>(cycle->integer);
    axis.cycleSpan = cycle->span;
  }
  axis.unit = unitOf(section);
  axis.fields.emplace_back("bRealDrive", "FALSE");
  readMovement(section, axis.fields, "axis");
  readLimits(section, axis.fields, section.choice("iMovementType") == kRotary, "axis");
  for (const std::string_view name : kMotionLimits)
    realField(section, name, axis.fields);
  readRamp(section, axis.fields);
  if (addVariable(axis.name))
    config_.axes.push_back(std::move(axis));
}

void PlcReader::readScaling(const CheckedSection &section, ConfigFields &fields,
                            std::string_view what) {
  for (const std::string_view name : {"dwRatioTechUnitsDenom", "iRatioTechUnitsNum"})
    integerField(section, name, fields);
  readMovement(section, fields, what);
  const bool rotary = section.choice("iMovementType") == kRotary;
  if (const TomlNode *period = section.get("fPositionPeriod"); period != nullptr && rotary)
    checkPeriod(section, *period, what);
  readLimits(section, fields, rotary, what);
}

void PlcReader::readMovement(const CheckedSection &section, ConfigFields &fields,
                             std::string_view what) {
  const auto type = section.choice("iMovementType");
  fields.emplace_back("iMovementType", std::to_string(type));
  if (type == kRotary && !section.has("fPositionPeriod"))
    diagnostics_
        .report(Code::ConfigMissingKey, section.get("iMovementType")->span,
                fmt::format("a rotary {} needs `fPositionPeriod`", what),
                fmt::format("makes the {} rotary", what))
        .help("add the length of one turn in technical units, for example `fPositionPeriod = "
              "360.0`");
  if (section.get("fPositionPeriod") == nullptr)
    return;
  realField(section, "fPositionPeriod", fields);
  if (type != kRotary && (section.get("iMovementType") != nullptr || !section.has("iMovementType")))
    withoutEffect(diagnostics_, section, "fPositionPeriod",
                  fmt::format("only for rotary {}", plural(what)));
}

// The period in increments must be at least one and fit a 32-bit position (manual, section 2.1.3).
void PlcReader::checkPeriod(const CheckedSection &section, const TomlNode &period,
                            std::string_view what) {
  const double denominator = section.real("dwRatioTechUnitsDenom");
  const double numerator = section.real("iRatioTechUnitsNum");
  const double increments = period.floating * denominator / numerator;
  const std::string computed = fmt::format("{} u × {} / {} = {:.15g} increments", period.floating,
                                           denominator, numerator, increments);
  if (increments < 1.0) {
    diagnostics_
        .report(Code::ConfigOutOfRange, period.span,
                fmt::format("one period of the {} must be at least one increment", what), computed)
        .help("give the ratio of increments to technical units with dwRatioTechUnitsDenom and "
              "iRatioTechUnitsNum");
    return;
  }
  if (increments <= kLargestPeriod)
    return;
  Diagnostic &d = diagnostics_.report(
      Code::ConfigPeriodTooLarge, period.span,
      fmt::format("one period of the {} is more than 16#80000000 increments", what), computed);
  if (const TomlNode *ratio = section.get("dwRatioTechUnitsDenom"))
    d.label(ratio->span, "increments …");
  if (const TomlNode *ratio = section.get("iRatioTechUnitsNum"))
    d.label(ratio->span, "… per so many units");
  d.help(fmt::format("with this ratio the period can be at most {:.15g} u",
                     std::floor(kLargestPeriod * numerator / denominator)));
}

void PlcReader::readLimits(const CheckedSection &section, ConfigFields &fields, bool rotary,
                           std::string_view what) {
  const bool enabled = section.boolean("bSWLimitEnable", false);
  flagField(section, "bSWLimitEnable", fields);
  for (const std::string_view name : {"fSWLimitNegative", "fSWLimitPositive"})
    realField(section, name, fields);
  if (!enabled)
    return;
  if (rotary) {
    withoutEffect(diagnostics_, section, "bSWLimitEnable",
                  fmt::format("only for linear {}", plural(what)));
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
        .report(Code::ConfigLimits, low->span,
                "fSWLimitNegative must be less than fSWLimitPositive", "not less than …")
        .label(high->span, "… this");
    return;
  }
  diagnostics_
      .report(Code::ConfigLimits, section.get("bSWLimitEnable")->span,
              "software limits are switched on but not both given", "needs both limits")
      .help("add `fSWLimitNegative = …` and `fSWLimitPositive = …`");
}

void PlcReader::readRamp(const CheckedSection &section, ConfigFields &fields) {
  constexpr std::array<std::string_view, 4> kNames = {"trapezoid", "sigmoid", "parabolic",
                                                      "sigmoid_limited"};
  const auto ramp = static_cast<size_t>(section.choice("eRampType"));
  if (section.get("eRampType") != nullptr)
    fields.emplace_back("eRampType", fmt::format("SMC_RAMPTYPE.{}", kNames[ramp]));
  realField(section, "fJerk", fields);
  if (ramp != 0 && !section.has("fJerk"))
    diagnostics_
        .report(Code::ConfigMissingKey, section.get("eRampType")->span,
                fmt::format("the ramp type \"{}\" needs `fJerk`", kNames[ramp]), "limits the jerk")
        .help("add the largest jerk in u/s³, for example `fJerk = 20000.0`");
  else if (ramp == 0 && section.get("fJerk") != nullptr)
    withoutEffect(diagnostics_, section, "fJerk", "only with another eRampType than \"trapezoid\"");
}

} // namespace stc
