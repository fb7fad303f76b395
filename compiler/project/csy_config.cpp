#include "compiler/project/csy_config.hpp"

#include "compiler/assets/csy/firmware.hpp"
#include "compiler/syntax/st_text.hpp"

#include <array>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::common;

constexpr double kLastRack = 7;
constexpr double kLastSlot = 14;
constexpr double kMostCamPoints = 5000;

// The numbers are those of CSY_Unit.
constexpr std::array<Choice, 17> kPositionUnits = {{{"mrad", 0},
                                                    {"rad", 1},
                                                    {"deg", 2},
                                                    {"arcmin", 3},
                                                    {"rev", 4},
                                                    {"um", 10},
                                                    {"mm", 11},
                                                    {"cm", 12},
                                                    {"m", 13},
                                                    {"in", 20},
                                                    {"ft", 21},
                                                    {"yd", 22},
                                                    {"mile", 23},
                                                    {"counts", 30},
                                                    {"µm", 10},
                                                    {"°", 2},
                                                    {"inch", 20}}};
constexpr std::array<Choice, 26> kSpeedUnits = {
    {{"mrad/s", 0},   {"rad/s", 1},      {"rad/min", 2},   {"deg/s", 3},       {"deg/min", 4},
     {"arcmin/s", 5}, {"rev/s", 6},      {"rev/min", 7},   {"um/s", 10},       {"mm/s", 11},
     {"mm/min", 12},  {"cm/s", 13},      {"cm/min", 14},   {"m/s", 15},        {"m/min", 16},
     {"in/s", 20},    {"in/min", 21},    {"ft/s", 22},     {"ft/min", 23},     {"yd/min", 24},
     {"mile/s", 25},  {"counts/ms", 30}, {"counts/s", 31}, {"counts/min", 32}, {"µm/s", 10},
     {"°/s", 3}}};
constexpr std::array<Choice, 20> kAccelUnits = {
    {{"mrad/s2", 0},   {"rad/s2", 1},      {"deg/s2", 2},     {"arcmin/s2", 3}, {"rev/s2", 4},
     {"rev/min/s", 5}, {"um/s2", 10},      {"mm/s2", 11},     {"cm/s2", 12},    {"m/s2", 13},
     {"m/min2", 14},   {"g", 15},          {"in/s2", 20},     {"ft/s2", 21},    {"yd/min2", 22},
     {"mile/s2", 23},  {"counts/ms2", 30}, {"counts/s2", 31}, {"µm/s2", 10},    {"°/s2", 2}}};
constexpr std::array<Choice, 5> kShapes = {{{"rectangle", 100},
                                            {"trapezoid125", 125},
                                            {"trapezoid150", 150},
                                            {"trapezoid175", 175},
                                            {"triangle", 200}}};
constexpr std::array<Choice, 2> kInterpolations = {{{"linear", 0}, {"cubic", 1}}};
constexpr std::array<Choice, 2> kPositions = {{{"measured", 0}, {"setpoint", 1}}};
constexpr std::array<Choice, 2> kChannelOnStop = {{{"fallback", 0}, {"hold", 1}}};
constexpr std::array<Choice, 2> kLinks = {{{"gear", 0}, {"cam", 1}}};
// The numbers are those of bits 8 to 10 of FOLL_DESCRIPTION.
constexpr std::array<Choice, 5> kStarts = {
    {{"immediate", 0}, {"falling", 1}, {"rising", 2}, {"above", 3}, {"below", 4}}};

/// A parameter and what becomes of it.
enum class Wording : uint8_t { Integer, Real, Flag, Choice, ChosenFlag };
struct FieldRow {
  Parameter parameter;
  std::string_view member;
  Wording wording;
};

constexpr Parameter unit(std::string_view name, std::span<const Choice> units) {
  return choice(name, units).defaultsTo(11);
}

constexpr std::array<FieldRow, 17> kAxisFields = {{
    {positive("ACCEL", "acceleration").defaultsTo(100), "ACCEL", Wording::Real},
    {positive("DECEL", "acceleration").defaultsTo(100), "DECEL", Wording::Real},
    {choice("ACCEL_TYPE", kShapes).defaultsTo(100), "ACCEL_TYPE", Wording::Choice},
    {notNegative("IN_POSITION_BAND", "position").defaultsTo(0.0), "IN_POSITION_BAND",
     Wording::Real},
    {notNegative("ENABLE_POSITION_BAND", "position").defaultsTo(0.0), "ENABLE_POSITION_BAND",
     Wording::Real},
    {anyReal("ROLLOVER_MAX", "position").defaultsTo(0.0), "ROLLOVER_MAX", Wording::Real},
    {anyReal("ROLLOVER_MIN", "position").defaultsTo(0.0), "ROLLOVER_MIN", Wording::Real},
    {notNegative("ACCEL_MAX", "acceleration").defaultsTo(0.0), "ACCEL_MAX", Wording::Real},
    {notNegative("DECEL_MAX", "acceleration").defaultsTo(0.0), "DECEL_MAX", Wording::Real},
    {notNegative("SPEED_MAX", "speed").defaultsTo(0.0), "SPEED_MAX", Wording::Real},
    {anyReal("POSITION_MAX", "position").defaultsTo(0.0), "POSITION_MAX", Wording::Real},
    {anyReal("POSITION_MIN", "position").defaultsTo(0.0), "POSITION_MIN", Wording::Real},
    {anyReal("SCALE_NUMERATOR", "").defaultsTo(1), "SCALE_NUMERATOR", Wording::Real},
    {anyReal("SCALE_DENOMINATOR", "").defaultsTo(1), "SCALE_DENOMINATOR", Wording::Real},
    {unit("ACCEL_UNIT", kAccelUnits), "ACCEL_UNIT", Wording::Choice},
    {unit("SPEED_UNIT", kSpeedUnits), "SPEED_UNIT", Wording::Choice},
    {unit("POSITION_UNIT", kPositionUnits), "POSITION_UNIT", Wording::Choice},
}};
/// By the bits of FUNCTION_VALIDATION.
constexpr std::array kValidations = {flag("position_check"), flag("enable_position_check"),
                                     flag("modulo")};

constexpr std::array<FieldRow, 7> kCamFields = {{
    {choice("interpolation", kInterpolations).defaultsTo(0.0), "iInterpolation", Wording::Choice},
    {unit("unit", kPositionUnits), "iUnit", Wording::Choice},
    {choice("slave_unit", kPositionUnits), "iSlaveUnit", Wording::Choice},
    {anyReal("master_start", "unit").defaultsTo(0.0), "fMasterStart", Wording::Real},
    {positive("master_increment", "unit").defaultsTo(1), "fMasterIncrement", Wording::Real},
    {anyReal("slave_start", "unit").defaultsTo(0.0), "fSlaveStart", Wording::Real},
    {anyReal("slave_increment", "unit").defaultsTo(1), "fSlaveIncrement", Wording::Real},
}};

constexpr std::array<FieldRow, 12> kSlaveFields = {{
    {whole("channel", 1, 12).needed(), "iChannel", Wording::Integer},
    {choice("link", kLinks).defaultsTo(0.0), "bCam", Wording::ChosenFlag},
    {choice("position", kPositions).defaultsTo(1), "bSetpoint", Wording::ChosenFlag},
    {anyReal("numerator", "").defaultsTo(1), "fNumerator", Wording::Real},
    {anyReal("denominator", "").defaultsTo(1), "fDenominator", Wording::Real},
    {whole("cam", 25, 31).onlyWith("link", 1), "iCam", Wording::Integer},
    {anyReal("offset", "position").defaultsTo(0.0), "fOffset", Wording::Real},
    {choice("start", kStarts).defaultsTo(0.0), "iStart", Wording::Choice},
    {anyReal("trigger", "position").defaultsTo(0.0), "fTrigger", Wording::Real},
    {flag("bias_remains").defaultsTo(0.0), "bBiasRemains", Wording::Flag},
    {flag("halt_on_follow").defaultsTo(0.0), "bHaltOnFollow", Wording::Flag},
    {flag("stop_master_on_fault").defaultsTo(0.0), "bStopMaster", Wording::Flag},
}};

constexpr std::array<FieldRow, 6> kModuleFields = {{
    {kCsyFirmware, "iMostPoints", Wording::Choice},
    {positive("cam_points_per_second", "1/s").defaultsTo(100), "fCamPointsPerSecond",
     Wording::Real},
    {flag("present").defaultsTo(1), "bPresent", Wording::Flag},
    {whole("CYCLE_TIME", 0, 32767).defaultsTo(4), "iCycleTime", Wording::Integer},
    {whole("BAUD_RATE", 0, 32767).defaultsTo(4), "iBaudRate", Wording::Integer},
    {real("OPTICAL_POWER", 0, 100).defaultsTo(100), "fOpticalPower", Wording::Real},
}};

template <size_t Fields, size_t Others>
constexpr auto rows(const std::array<FieldRow, Fields> &fields,
                    const std::array<Parameter, Others> &others) {
  std::array<Parameter, Fields + Others> all{};
  for (size_t i = 0; i < Others; ++i)
    all[i] = others[i];
  for (size_t i = 0; i < Fields; ++i)
    all[Others + i] = fields[i].parameter;
  return all;
}

constexpr auto kAxisRows = rows(kAxisFields, kValidations);
constexpr SectionSchema kModuleAxisParameters = {
    "parameters", "the parameters of an axis", "csy.axis.parameters", false, kAxisRows, {}};
constexpr std::array kModuleAxisKeys = {
    whole("channel", 1, 16).needed(),
    identifier("axis"),
    identifier("encoder"),
    positive("manual_speed", "speed").defaultsTo(1),
    choice("on_stop", kChannelOnStop),
};
constexpr std::array<const SectionSchema *, 1> kModuleAxisSections = {&kModuleAxisParameters};
constexpr SectionSchema kModuleAxis = {"axis", "an axis of a module", "csy.axis",
                                       true,   kModuleAxisKeys,       kModuleAxisSections};

constexpr auto kModuleCamKeys =
    rows(kCamFields,
         std::array{whole("channel", 25, 31).needed(), whole("points", 2, kMostCamPoints).needed(),
                    identifier("master_table"), identifier("slave_table")});
constexpr SectionSchema kModuleCam = {"cam", "a cam of a module", "csy.cam",
                                      true,  kModuleCamKeys,      {}};

constexpr auto kModuleSlaveKeys = rows(kSlaveFields, std::array<Parameter, 0>{});
constexpr SectionSchema kModuleSlave = {"slave", "a slave",        "csy.follower.slave",
                                        true,    kModuleSlaveKeys, {}};
constexpr std::array kModuleFollowerKeys = {
    whole("channel", 21, 24).needed(), whole("master", 1, 16), choice("on_stop", kChannelOnStop)};
constexpr std::array<const SectionSchema *, 1> kModuleFollowerSections = {&kModuleSlave};
constexpr SectionSchema kModuleFollower = {"follower",          "a follower group",
                                           "csy.follower",      true,
                                           kModuleFollowerKeys, kModuleFollowerSections};

constexpr std::array kModuleCoordinatedKeys = {whole("channel", 17, 20).needed(),
                                               Parameter{"axes", ParameterType::NameList, true},
                                               choice("on_stop", kChannelOnStop)};
constexpr SectionSchema kModuleCoordinated = {
    "coordinated", "a coordinated group", "csy.coordinated", true, kModuleCoordinatedKeys, {}};

constexpr auto kCsyKeys =
    rows(kModuleFields,
         std::array{whole("rack", 0, kLastRack).needed(), whole("slot", 0, kLastSlot).needed(),
                    choice("on_stop", kChannelOnStop).defaultsTo(0)});
constexpr std::array<const SectionSchema *, 4> kCsySections = {
    &kModuleAxis, &kModuleCam, &kModuleFollower, &kModuleCoordinated};
constexpr SectionSchema kCsy = {"csy", "a module", "csy", true, kCsyKeys, kCsySections};

/// What a section says of a row, as ST, with the row's default where it says nothing.
std::string valueOf(const CheckedSection &section, const FieldRow &row) {
  const std::string_view name = row.parameter.name;
  const auto otherwise = static_cast<int64_t>(row.parameter.otherwise.number);
  const auto flag = [](bool value) { return std::string(value ? "TRUE" : "FALSE"); };
  switch (row.wording) {
  case Wording::Integer:
    return fmt::format("{}", section.integer(name, otherwise));
  case Wording::Real:
    return realLiteral(section.real(name));
  case Wording::Choice:
    return fmt::format("{}", section.choice(name));
  case Wording::ChosenFlag:
    return flag(section.choice(name) != 0);
  case Wording::Flag:
    return flag(section.boolean(name, otherwise != 0));
  }
  return {};
}

template <size_t Fields>
CsyFields fieldsOf(const CheckedSection &section, const std::array<FieldRow, Fields> &table) {
  CsyFields fields;
  for (const FieldRow &row : table)
    fields.emplace_back(row.member, valueOf(section, row));
  return fields;
}

/// The parameters of an axis.
CsyFields parametersOf(const CheckedSection &section) {
  CsyFields fields = fieldsOf(section, kAxisFields);
  unsigned bits = 0;
  for (size_t i = 0; i < kValidations.size(); ++i)
    bits |= section.boolean(kValidations[i].name, false) ? 1U << i : 0U;
  fields.emplace_back("FUNCTION_VALIDATION", fmt::format("{}", bits));
  return fields;
}

class CsyReader {
public:
  CsyReader(const CheckedSection &section, Diagnostics &diagnostics)
      : section_(section), diagnostics_(diagnostics) {}

  CsyConfig read() {
    csy_.span = section_.table().span;
    csy_.rack = static_cast<uint32_t>(section_.integer("rack", 0));
    csy_.slot = static_cast<uint32_t>(section_.integer("slot", 0));
    csy_.inputs = fieldsOf(section_, kModuleFields);
    csy_.onStop = static_cast<CsyOnStop>(section_.choice("on_stop"));
    for (const CheckedSection &axis : section_.sections("axis", diagnostics_))
      readAxis(axis);
    for (const CheckedSection &cam : section_.sections("cam", diagnostics_))
      readCam(cam);
    for (const CheckedSection &group : section_.sections("follower", diagnostics_))
      readFollower(group);
    for (const CheckedSection &group : section_.sections("coordinated", diagnostics_))
      readCoordinated(group);
    return std::move(csy_);
  }

private:
  /// False: the channel is missing, wrong, or taken; reported.
  template <typename Config> bool channel(const CheckedSection &section, Config &config) {
    const TomlNode *value = section.get("channel");
    if (value == nullptr)
      return false;
    config.channel = static_cast<uint32_t>(value->integer);
    config.channelSpan = value->span;
    return channels_.add(
        fmt::format("{}", value->integer), value->span,
        fmt::format("the channel {} of the module is given twice", value->integer));
  }

  void readAxis(const CheckedSection &section) {
    CsyAxisConfig axis;
    if (!channel(section, axis))
      return;
    axis.axis = nameIn(section, "axis");
    axis.encoder = nameIn(section, "encoder");
    axis.inputs = {{"fManualSpeed", realLiteral(section.real("manual_speed"))}};
    for (const CheckedSection &table : section.sections("parameters", diagnostics_))
      axis.parameters = parametersOf(table);
    constexpr uint32_t kFirstRemote = 13;
    if (axis.channel < kFirstRemote) {
      needs(section, "axis", axis.axis);
      if (axis.encoder.span.valid())
        withoutEffect(diagnostics_, section, "encoder", "for channels 13 to 16 only");
    } else if (axis.axis.span.valid()) {
      withoutEffect(diagnostics_, section, "axis", "for channels 1 to 12 only");
      axis.axis = {};
    }
    axis.onStop = onStop(section);
    csy_.axes.push_back(std::move(axis));
  }

  /// Of a channel; what the module says where it says nothing.
  CsyOnStop onStop(const CheckedSection &section) const {
    return section.has("on_stop") ? static_cast<CsyOnStop>(section.choice("on_stop")) : csy_.onStop;
  }

  void needs(const CheckedSection &section, std::string_view key, const ConfigName &name) {
    if (name.span.valid() || section.has(key))
      return;
    diagnostics_
        .report(Code::ConfigMissingKey, section.table().span,
                fmt::format("{} needs `{}`", section.schema().what, key), "of which one?")
        .help(fmt::format("add `{} = \"…\"`: the name of a drive or of an [[axis]]", key));
  }

  void readCam(const CheckedSection &section) {
    CsyCamConfig cam;
    if (!channel(section, cam))
      return;
    cam.points = static_cast<uint32_t>(section.integer("points", 0));
    cam.masterTable = nameIn(section, "master_table");
    cam.slaveTable = nameIn(section, "slave_table");
    cam.inputs = fieldsOf(section, kCamFields);
    if (!section.has("slave_unit"))
      for (auto &[member, value] : cam.inputs)
        if (member == "iSlaveUnit")
          value = fmt::format("{}", section.choice("unit"));
    const auto instead = [&](std::string_view table, std::string_view start,
                             std::string_view step) {
      if (!section.has(table))
        return;
      for (const std::string_view key : {start, step})
        if (section.has(key))
          withoutEffect(diagnostics_, section, key, fmt::format("only without `{}`", table));
    };
    instead("master_table", "master_start", "master_increment");
    instead("slave_table", "slave_start", "slave_increment");
    csy_.cams.push_back(std::move(cam));
  }

  void readFollower(const CheckedSection &section) {
    CsyFollowerConfig group;
    if (!channel(section, group))
      return;
    group.master = static_cast<uint32_t>(section.integer("master", 0));
    const std::span<const TomlNode> slaves = section.tables("slave");
    constexpr size_t kMostSlaves = 6;
    if (slaves.size() > kMostSlaves)
      diagnostics_.report(Code::ConfigOutOfRange, slaves[kMostSlaves].span,
                          fmt::format("a follower group has {} slaves at most", kMostSlaves),
                          "one too many");
    for (const CheckedSection &slave : section.sections("slave", diagnostics_)) {
      if (slave.choice("link") == 1)
        needsCam(slave);
      group.slaves.push_back(fieldsOf(slave, kSlaveFields));
    }
    group.onStop = onStop(section);
    csy_.followers.push_back(std::move(group));
  }

  void needsCam(const CheckedSection &slave) {
    if (!slave.has("cam"))
      diagnostics_
          .report(Code::ConfigMissingKey, slave.table().span, "a slave with a cam needs `cam`",
                  "of which one?")
          .help("add `cam = 25`: the channel of a [[csy.cam]]");
  }

  void readCoordinated(const CheckedSection &section) {
    CsyCoordinatedConfig group;
    if (!channel(section, group))
      return;
    if (const TomlNode *axes = section.get("axes"))
      for (const TomlNode &axis : axes->children)
        group.axes.push_back({axis.text, axis.span});
    constexpr size_t kMost = 8;
    if (group.axes.size() < 2 || group.axes.size() > kMost) {
      diagnostics_.report(Code::ConfigOutOfRange, group.channelSpan,
                          fmt::format("a coordinated group has 2 to {} axes", kMost),
                          fmt::format("this one has {}", group.axes.size()));
      return;
    }
    group.onStop = onStop(section);
    csy_.coordinated.push_back(std::move(group));
  }

  const CheckedSection &section_;
  Diagnostics &diagnostics_;
  CsyConfig csy_;
  Unique channels_{Code::ConfigDuplicateName, diagnostics_};
};

} // namespace

const SectionSchema &csySchema() { return kCsy; }

CsyConfig readCsy(const CheckedSection &section, Diagnostics &diagnostics) {
  return CsyReader(section, diagnostics).read();
}

} // namespace stc
