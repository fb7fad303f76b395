// The parameters of stride.toml. Names, types and meanings of the PLC configuration are those of
// the SoftMotion V2.3 manual, sections 2.1.2 to 2.1.4.

#include "compiler/codegen/codegen.hpp"
#include "compiler/project/schema.hpp"
#include "compiler/syntax/format.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace stc {

namespace {

constexpr double kWord = 65535;
constexpr double kDword = 4294967295.0;
constexpr double kHuge = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::min();
constexpr double kMicrosecond = 1e3;
constexpr double kHour = 3.6e12;

constexpr std::array<Choice, 2> kGenerations = {{{"2.3", 2}, {"3", 3}}};

constexpr std::array<Choice, 2> kMovementTypes = {{{"rotary", 0}, {"linear", 1}}};

constexpr std::array<Choice, 4> kRampTypes = {
    {{"trapezoid", 0}, {"sigmoid", 1}, {"parabolic", 2}, {"sigmoid_limited", 3}}};

// Values as AXIS_REF.wControlType has them (Annex A, 1001).
constexpr std::array<Choice, 7> kControlTypes = {{{"TOR ->", 1},
                                                  {"VEL -> VEL", 2},
                                                  {"VEL -> POS", 3},
                                                  {"POS -> POS", 4},
                                                  {"POS, VEL -> POS, VEL", 5},
                                                  {"VEL ->", 6},
                                                  {"CONFIGURABLE", 0}}};

// Parameter numbers of AXIS_REF (Annex A).
constexpr std::int64_t kUserDefined = 65535; // what it is, the driver knows
constexpr std::array<Choice, 5> kSendData = {{{"SetPosition", 1100},
                                              {"SetVelocity", 1110},
                                              {"SetTorque", 1160},
                                              {"SetCurrent", 1150},
                                              {"SetUserDef", kUserDefined}}};
constexpr std::array<Choice, 5> kReceiveData = {{{"ActPosition", 1101},
                                                 {"ActVelocity", 1111},
                                                 {"ActTorque", 1161},
                                                 {"ActCurrent", 1151},
                                                 {"ActUserDef", kUserDefined}}};

// kBit/s: CAN up to 1000, Sercos from 2000.
constexpr std::array<Choice, 13> kBaudRates = {{{"10", 10},
                                                {"20", 20},
                                                {"50", 50},
                                                {"100", 100},
                                                {"125", 125},
                                                {"250", 250},
                                                {"500", 500},
                                                {"800", 800},
                                                {"1000", 1000},
                                                {"2000", 2000},
                                                {"4000", 4000},
                                                {"8000", 8000},
                                                {"16000", 16000}}};
constexpr std::array<Choice, 3> kSyncProducers = {{{"PLC", 0}, {"1.Drive", 1}, {"SYNC device", 2}}};

constexpr std::array<Choice, 3> kModels = {{{"ideal", 0}, {"lag", 1}, {"second_order", 2}}};

constexpr Parameter word(std::string_view name, std::string_view unit = {}) {
  return {name, ParameterType::integer, false, 0, kWord, {}, unit};
}
constexpr Parameter dword(std::string_view name, std::string_view unit = {}) {
  return {name, ParameterType::integer, false, 0, kDword, {}, unit};
}
constexpr Parameter positive(std::string_view name, std::string_view unit) {
  return {name, ParameterType::real, false, kTiny, kHuge, {}, unit};
}
constexpr Parameter anyReal(std::string_view name, std::string_view unit) {
  return {name, ParameterType::real, false, -kHuge, kHuge, {}, unit};
}
constexpr Parameter notNegative(std::string_view name, std::string_view unit) {
  return {name, ParameterType::real, false, 0, kHuge, {}, unit};
}
constexpr Parameter count(std::string_view name, double low, double high, std::string_view unit) {
  return {name, ParameterType::integer, false, low, high, {}, unit};
}
constexpr Parameter flag(std::string_view name) { return {name, ParameterType::boolean}; }
constexpr Parameter choice(std::string_view name, std::span<const Choice> choices) {
  return {name, ParameterType::choice, false, 0, 0, choices};
}
constexpr Parameter needed(Parameter parameter) {
  parameter.required = true;
  return parameter;
}

constexpr std::array<Choice, 2> kLayouts = {{{"natural", 0}, {"v2.3", 4}}};
constexpr std::array<Choice, 3> kAddressings = {{{"units", 0}, {"bytes", 1}, {"words", 2}}};
constexpr double kImageArea = 16777216;

constexpr std::array kImageParameters = {
    choice("addressing", kAddressings),
    Parameter{"inputs", ParameterType::integer, false, 0, kImageArea, {}, "bytes"},
    Parameter{"outputs", ParameterType::integer, false, 0, kImageArea, {}, "bytes"},
    Parameter{"memory", ParameterType::integer, false, 0, kImageArea, {}, "bytes"},
};

constexpr std::array kProjectParameters = {
    Parameter{"name", ParameterType::text},
    choice("softmotion", kGenerations),
    choice("layout", kLayouts),
    Parameter{"defines", ParameterType::nameList},
    Parameter{"new_pool", ParameterType::integer, false, 1024, 268435456, {}, "bytes"},
};

constexpr std::array<Choice, 4> kTaskKinds = {
    {{"cyclic", static_cast<std::int64_t>(TaskStart::cyclic)},
     {"freewheeling", static_cast<std::int64_t>(TaskStart::freewheeling)},
     {"event", static_cast<std::int64_t>(TaskStart::event)},
     {"status", static_cast<std::int64_t>(TaskStart::status)}}};

constexpr double kSecond = 1e9;
constexpr std::array kRetainParameters = {
    Parameter{"file", ParameterType::text},
    Parameter{"period", ParameterType::interval, false, kSecond / 10, kHour},
};

constexpr std::array kFilesParameters = {
    Parameter{"root", ParameterType::text},
    flag("anywhere"),
    count("delay", 0, 100000, "cycles"),
};

constexpr std::array kTaskParameters = {
    needed({"name", ParameterType::identifier}),
    choice("kind", kTaskKinds),
    Parameter{"interval", ParameterType::interval, false, kMicrosecond, kHour},
    Parameter{"event", ParameterType::text},
    Parameter{"watchdog", ParameterType::interval, false, kMicrosecond, kHour},
    Parameter{"watchdog_sensitivity", ParameterType::integer, false, 1, 1000},
    Parameter{"core", ParameterType::integer, false, 0, 1023},
    Parameter{"priority", ParameterType::integer, false, 0, 31},
    Parameter{"programs", ParameterType::nameList},
};

constexpr std::array kBusParameters = {
    needed({"name", ParameterType::identifier}),
    needed({"InterfaceType", ParameterType::text}),
};

constexpr std::array kAxisGroupParameters = {
    needed({"name", ParameterType::identifier}),
    Parameter{"sTask", ParameterType::text},
    Parameter{"dwCycle", ParameterType::integer, false, 1, kDword, {}, "µs"},
    word("wParam1"),
    word("wParam2"),
    word("wParam3"),
    word("wParam4"),
    dword("dwParam1"),
    dword("dwParam2"),
    dword("dwParam3"),
    dword("dwParam4"),
    choice("BaudRate", kBaudRates),
    count("LedBrightness", 0, kWord, {}),
    count("ControllerNo", 0, 255, {}),
    choice("SyncProducer", kSyncProducers),
};

constexpr std::array kDriveParameters = {
    needed({"name", ParameterType::identifier}),
    needed(word("wDriveId")),
    choice("wControlType", kControlTypes),
    choice("wCyclicDataS1", kSendData),
    choice("wCyclicDataS2", kSendData),
    choice("wCyclicDataS3", kSendData),
    choice("wCyclicDataR1", kReceiveData),
    choice("wCyclicDataR2", kReceiveData),
    choice("wCyclicDataR3", kReceiveData),
    Parameter{"dwRatioTechUnitsDenom", ParameterType::integer, false, 1, kDword, {}, "increments"},
    Parameter{"iRatioTechUnitsNum", ParameterType::integer, false, 1, 32767, {}, "u"},
    choice("iMovementType", kMovementTypes),
    positive("fPositionPeriod", "u"),
    positive("fSWMaxVelocity", "u/s"),
    positive("fSWMaxAcceleration", "u/s²"),
    positive("fSWMaxDeceleration", "u/s²"),
    flag("bSWLimitEnable"),
    anyReal("fSWLimitNegative", "u"),
    anyReal("fSWLimitPositive", "u"),
    flag("bHWLimitEnable"),
    choice("eRampType", kRampTypes),
    positive("fJerk", "u/s³"),
};

constexpr std::array<Choice, 2> kIoDevices = {{{"Simulated", 0}, {"SharedMemory", 1}}};
constexpr std::array<Choice, 2> kOnLoss = {{{"keep", 0}, {"safe", 1}}};

constexpr std::array kIoParameters = {
    needed({"name", ParameterType::identifier}),
    needed(choice("device", kIoDevices)),
    Parameter{"inputs_at", ParameterType::integer, false, 0, kImageArea, {}, "bytes"},
    Parameter{"inputs", ParameterType::integer, false, 0, kImageArea, {}, "bytes"},
    Parameter{"outputs_at", ParameterType::integer, false, 0, kImageArea, {}, "bytes"},
    Parameter{"outputs", ParameterType::integer, false, 0, kImageArea, {}, "bytes"},
    choice("on_loss", kOnLoss),
    flag("loop_back"),
    Parameter{"delay", ParameterType::integer, false, 0, 1000, {}, "cycles"},
    Parameter{"segment", ParameterType::text},
    Parameter{"timeout", ParameterType::interval, false, kMicrosecond, kHour},
};

constexpr std::array kIoChannelParameters = {
    needed({"name", ParameterType::identifier}),
    needed({"address", ParameterType::text}),
    Parameter{"safe_value", ParameterType::integer, false, -2147483648.0, kDword},
    Parameter{"comment", ParameterType::text},
};

constexpr std::array<Choice, 2> kHomingDirections = {{{"negative", -1}, {"positive", 1}}};

constexpr std::array kPhysicsParameters = {
    choice("model", kModels),
    Parameter{"time_constant", ParameterType::interval, false, kMicrosecond, kHour},
    positive("inertia", "Nm/(u/s²)"),
    positive("torque_limit", "Nm"),
    notNegative("viscous_friction", "Nm/(u/s)"),
    notNegative("coulomb_friction", "Nm"),
    positive("position_gain", "1/s"),
    positive("velocity_gain", "Nm/(u/s)"),
    Parameter{"velocity_integral_time", ParameterType::interval, false, kMicrosecond, kHour},
    Parameter{"velocity_feedforward", ParameterType::real, false, 0, 1},
    count("substeps", 1, 1000, {}),
    count("dead_time", 0, 64, "cycles"),
    count("start_up_cycles", 1, 100000, "cycles"),
    count("switch_cycles", 1, 100000, "cycles"),
    anyReal("start_position", "u"),
    anyReal("limit_negative", "u"),
    anyReal("limit_positive", "u"),
    anyReal("home_switch_from", "u"),
    anyReal("home_switch_to", "u"),
    anyReal("index_position", "u"),
    positive("index_distance", "u"),
    anyReal("probe_position", "u"),
    positive("probe_distance", "u"),
    count("parameter_cycles", 1, 100000, "cycles"),
    positive("homing_velocity", "u/s"),
    positive("homing_velocity_slow", "u/s"),
    positive("homing_acceleration", "u/s²"),
    choice("homing_direction", kHomingDirections),
};

constexpr std::array kEncoderParameters = {
    needed({"name", ParameterType::identifier}),
    needed(word("wEncoderId")),
    Parameter{"dwRatioTechUnitsDenom", ParameterType::integer, false, 1, kDword, {}, "increments"},
    Parameter{"iRatioTechUnitsNum", ParameterType::integer, false, 1, 32767, {}, "u"},
    choice("iMovementType", kMovementTypes),
    positive("fPositionPeriod", "u"),
    flag("bSWLimitEnable"),
    anyReal("fSWLimitNegative", "u"),
    anyReal("fSWLimitPositive", "u"),
    dword("dwEncoderModulo", "increments"),
    dword("dwParam1"),
    dword("dwParam2"),
    dword("dwParam3"),
    dword("dwParam4"),
    dword("dwParam5"),
    dword("dwParam6"),
    dword("dwParam7"),
    dword("dwParam8"),
};

constexpr std::array<Choice, 3> kKeywordCases = {
    {{"upper", static_cast<std::int64_t>(KeywordCase::upper)},
     {"lower", static_cast<std::int64_t>(KeywordCase::lower)},
     {"keep", static_cast<std::int64_t>(KeywordCase::keep)}}};
constexpr std::array kFormatParameters = {
    count("width", 40, 1000, "characters"),
    count("indent", 1, 16, "blanks"),
    flag("tabs"),
    choice("keywords", kKeywordCases),
    flag("align"),
};

constexpr Section kProject = {"project", "the project", "project", false, kProjectParameters, {}};
constexpr Section kImage = {"image", "the process image", "image", false, kImageParameters, {}};
constexpr Section kFormat = {"fmt", "the format", "fmt", false, kFormatParameters, {}};
constexpr Section kRetain = {"retain", "the retained data", "retain", false, kRetainParameters, {}};
constexpr Section kFiles = {"files", "the access to files", "files", false, kFilesParameters, {}};
constexpr Section kTask = {"task", "a task", "task", true, kTaskParameters, {}};
constexpr Section kPhysics = {"physics", "the physics of a drive", "bus.axis_group.drive.physics",
                              false,     kPhysicsParameters,       {}};
constexpr std::array<const Section *, 1> kDriveSections = {&kPhysics};
constexpr Section kDrive = {"drive", "a drive",        "bus.axis_group.drive",
                            true,    kDriveParameters, kDriveSections};
constexpr std::array kEncoderPhysicsParameters = {
    Parameter{"follows", ParameterType::identifier},
    anyReal("own_velocity", "u/s"),
};
constexpr Section kEncoderPhysics = {
    "physics", "the physics of an encoder", "bus.axis_group.encoder.physics",
    false,     kEncoderPhysicsParameters,   {}};
constexpr std::array<const Section *, 1> kEncoderSections = {&kEncoderPhysics};
constexpr Section kEncoder = {"encoder", "an encoder",       "bus.axis_group.encoder",
                              true,      kEncoderParameters, kEncoderSections};
constexpr std::array<const Section *, 2> kAxisGroupSections = {&kDrive, &kEncoder};
constexpr Section kAxisGroup = {"axis_group", "an axis group",      "bus.axis_group",
                                true,         kAxisGroupParameters, kAxisGroupSections};
constexpr std::array<const Section *, 1> kBusSections = {&kAxisGroup};
constexpr Section kBus = {"bus", "a bus", "bus", true, kBusParameters, kBusSections};

constexpr Section kIoChannel = {"channel", "a channel",          "io.channel",
                                true,      kIoChannelParameters, {}};
constexpr std::array<const Section *, 1> kIoSections = {&kIoChannel};
constexpr Section kIo = {"io", "an I/O device", "io", true, kIoParameters, kIoSections};

constexpr std::array<Choice, 4> kSeverities = {
    {{"error", static_cast<std::int64_t>(Severity::error)},
     {"warning", static_cast<std::int64_t>(Severity::warning)},
     {"note", static_cast<std::int64_t>(Severity::note)},
     {"off", static_cast<std::int64_t>(Severity::off)}}};

/// `SE0390` and `unused-variable`, for every code; errors have no choice.
struct DiagnosticSection {
  DiagnosticSection() {
    names = settingNames();
    for (const CodeInfo &entry : allCodes()) {
      if (entry.severity == Severity::error) {
        errors.push_back(codeName(entry.code));
        errors.push_back(kebabName(entry.code));
      }
    }
    for (const std::string &name : names)
      parameters.push_back(choice(name, kSeverities));
    for (const std::string &name : errors)
      parameters.push_back(choice(name, std::span(kSeverities).first(1)));
    section = {"diagnostics", "[diagnostics]", "diagnostics", false, parameters, {}};
  }
  std::vector<std::string> names;
  std::vector<std::string> errors;
  std::vector<Parameter> parameters;
  Section section;
};

/// The whole of stride.toml.
struct TopSection {
  DiagnosticSection diagnostics;
  std::array<const Section *, 9> sections = {
      &kProject, &diagnostics.section, &kImage, &kRetain, &kFiles, &kFormat, &kTask, &kBus, &kIo};
  Section top = {"", "stride.toml", "", false, {}, sections};
};

} // namespace

const Section &formatSchema() { return kFormat; }

const Section &projectSchema() {
  static const TopSection schema;
  return schema.top;
}

} // namespace stc
