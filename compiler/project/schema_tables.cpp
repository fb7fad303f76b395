// The parameters of stride.toml, but for those of drivers (driver_sections.cpp).

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/project/config_reader.hpp"
#include "compiler/project/driver_sections.hpp"
#include "compiler/syntax/format.hpp"
#include "runtime/bus/plc_schema.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace stc {

namespace {

namespace plc = stride::bus::plc;
using stride::common::anyReal;
using stride::common::choice;
using stride::common::duration;
using stride::common::flag;
using stride::common::identifier;
using stride::common::kHourNs;
using stride::common::positive;
using stride::common::real;
using stride::common::text;
using stride::common::whole;

constexpr std::array<Choice, 2> kGenerations = {{{"2.3", 2}, {"3", 3}}};

constexpr std::array<Choice, 2> kLayouts = {{{"natural", 0}, {"v2.3", 4}}};
constexpr std::array<Choice, 3> kAddressings = {{{"units", 0}, {"bytes", 1}, {"words", 2}}};
constexpr double kImageArea = 16777216;

constexpr std::array kImageParameters = {
    choice("addressing", kAddressings),
    whole("inputs", 0, kImageArea, "bytes"),
    whole("outputs", 0, kImageArea, "bytes"),
    whole("memory", 0, kImageArea, "bytes"),
};

constexpr std::array kProjectParameters = {
    text("name"),
    choice("softmotion", kGenerations),
    choice("layout", kLayouts),
    Parameter{"defines", ParameterType::NameList},
    Parameter{"sources", ParameterType::NameList},
    whole("new_pool", 1024, 268435456, "bytes"),
};

constexpr std::array kLibraryParameters = {
    identifier("name").needed(),
    text("version").needed(),
    identifier("namespace"),
    text("title"),
    text("description"),
    text("company"),
    text("license"),
    flag("qualified_only"),
};

constexpr std::array kUseParameters = {
    identifier("name").needed(),
    text("path"),
    text("version"),
    identifier("namespace"),
};

constexpr std::array<Choice, 4> kTaskKinds = {
    {{"cyclic", static_cast<int64_t>(TaskStart::Cyclic)},
     {"freewheeling", static_cast<int64_t>(TaskStart::Freewheeling)},
     {"event", static_cast<int64_t>(TaskStart::Event)},
     {"status", static_cast<int64_t>(TaskStart::Status)}}};

constexpr double kSecond = 1e9;
constexpr std::array kRetainParameters = {
    text("file"),
    Parameter{"period", ParameterType::Interval, false, kSecond / 10, kHourNs},
};

constexpr std::array kFilesParameters = {
    text("root"),
    flag("anywhere"),
    whole("delay", 0, 100000, "cycles"),
};

constexpr std::array<Choice, 3> kLaunchers = {{{"ccache", static_cast<int64_t>(Launcher::Ccache)},
                                               {"distcc", static_cast<int64_t>(Launcher::Distcc)},
                                               {"icecc", static_cast<int64_t>(Launcher::Icecc)}}};
constexpr std::array kBuildParameters = {
    choice("launcher", kLaunchers),
    whole("jobs", 1, 1000),
};

constexpr std::array kTaskParameters = {
    identifier("name").needed(),
    choice("kind", kTaskKinds),
    duration("interval"),
    text("event"),
    duration("watchdog"),
    whole("watchdog_sensitivity", 1, 1000),
    whole("core", 0, 1023),
    whole("priority", 0, 31),
    Parameter{"programs", ParameterType::NameList},
};

constexpr std::array<Choice, 1> kAxisKinds = {{{"virtual", 0}}};
constexpr std::array kAxisParameters = {
    identifier("name").needed(),
    choice("kind", kAxisKinds).needed(),
    text("unit"),
    text("sTask"),
    whole("dwCycle", 1, stride::common::kLargestDword, "µs"),
    plc::kMovementType,
    positive("fPositionPeriod", "u"),
    positive("fSWMaxVelocity", "u/s"),
    positive("fSWMaxAcceleration", "u/s²"),
    positive("fSWMaxDeceleration", "u/s²"),
    positive("fSWMaxJerk", "u/s³"),
    flag("bSWLimitEnable"),
    anyReal("fSWLimitNegative", "u"),
    anyReal("fSWLimitPositive", "u"),
    choice("eRampType", plc::kRampTypes).defaultsTo(0),
    positive("fJerk", "u/s³"),
};

constexpr std::array<Choice, 3> kKeywordCases = {
    {{"upper", static_cast<int64_t>(KeywordCase::Upper)},
     {"lower", static_cast<int64_t>(KeywordCase::Lower)},
     {"keep", static_cast<int64_t>(KeywordCase::Keep)}}};
constexpr std::array kFormatParameters = {
    whole("width", 40, 1000, "characters"),
    whole("indent", 1, 16, "blanks"),
    flag("tabs"),
    choice("keywords", kKeywordCases),
    flag("align"),
};

constexpr std::array<Choice, 5> kCncModes = {
    {{"program", static_cast<int64_t>(CncCompile::Program)},
     {"queue", static_cast<int64_t>(CncCompile::Queue)},
     {"text-file", static_cast<int64_t>(CncCompile::TextFile)},
     {"queue-file", static_cast<int64_t>(CncCompile::QueueFile)},
     {"none", static_cast<int64_t>(CncCompile::None)}}};
constexpr std::array kCncParameters = {
    text("file").needed(),
    choice("compile", kCncModes),
    positive("default_velocity", "u/s"),
    positive("default_acceleration", "u/s²"),
    positive("default_deceleration", "u/s²"),
    real("angle_tolerance", 0, 180, "°"),
    whole("queue_bytes", 5000, 100'000, "bytes"),
    flag("step_suppress"),
    Parameter{"preprocess", ParameterType::NameList},
    real("tool_radius", 0, 1e6, "u"),
};
constexpr std::array kCncStartParameters = {
    anyReal("X", "u"), anyReal("Y", "u"), anyReal("Z", "u"), anyReal("A", "u"),
    anyReal("B", "u"), anyReal("C", "u"), anyReal("P", "u"), anyReal("Q", "u"),
    anyReal("U", "u"), anyReal("V", "u"), anyReal("W", "u"),
};

constexpr double kLongestTestNs = 1000 * kHourNs;
constexpr std::array kTestParameters = {
    identifier("name").needed(),
    Parameter{"for", ParameterType::Interval, true, 1000, kLongestTestNs},
    Parameter{"trace", ParameterType::NameList, true},
    text("script"),
    Parameter{"set", ParameterType::NameList},
    real("tolerance", 0, 1e300),
    duration("every"),
};

constexpr SectionSchema kProject = {"project", "the project",      "project",
                                    false,     kProjectParameters, {}};
/// Its keys are whatever the library's parameters are called.
constexpr SectionSchema kLibraryValues = {
    "parameters", "the parameters", "library.parameters", false, {}, {}, {}, true};
constexpr std::array<const SectionSchema *, 1> kUseSections = {&kLibraryValues};
constexpr SectionSchema kUse = {"library", "a library",    "library",
                                true,      kUseParameters, kUseSections};
constexpr SectionSchema kUseOfLibrary = {"uses", "a library",    "library.uses",
                                         true,   kUseParameters, kUseSections};
constexpr std::array<const SectionSchema *, 1> kLibrarySections = {&kUseOfLibrary};
constexpr SectionSchema kLibrary = {"library", "the library",      "library",
                                    false,     kLibraryParameters, kLibrarySections};
constexpr SectionSchema kImage = {"image", "the process image", "image",
                                  false,   kImageParameters,    {}};
constexpr SectionSchema kFormat = {"fmt", "the format", "fmt", false, kFormatParameters, {}};
constexpr SectionSchema kRetain = {"retain", "the retained data", "retain",
                                   false,    kRetainParameters,   {}};
constexpr SectionSchema kFiles = {"files", "the access to files", "files",
                                  false,   kFilesParameters,      {}};
constexpr SectionSchema kBuild = {"build", "the build", "build", false, kBuildParameters, {}};
constexpr SectionSchema kTask = {"task", "a task", "task", true, kTaskParameters, {}};
constexpr SectionSchema kAxis = {"axis", "an axis", "axis", true, kAxisParameters, {}};
constexpr SectionSchema kCncStart = {"start", "the start",         "cnc.start",
                                     false,   kCncStartParameters, {}};
constexpr std::array<const SectionSchema *, 1> kCncSections = {&kCncStart};
constexpr SectionSchema kCnc = {"cnc", "a CNC program", "cnc", true, kCncParameters, kCncSections};
constexpr SectionSchema kTest = {"test", "a test", "test", true, kTestParameters, {}};
constexpr std::array<Choice, 4> kSeverities = {
    {{"error", static_cast<int64_t>(Severity::Error)},
     {"warning", static_cast<int64_t>(Severity::Warning)},
     {"note", static_cast<int64_t>(Severity::Note)},
     {"off", static_cast<int64_t>(Severity::Off)}}};

/// `SE0390` and `unused-variable`, for every code; errors have no choice.
struct DiagnosticSection {
  DiagnosticSection() {
    names = settingNames();
    for (const CodeInfo &entry : allCodes()) {
      if (entry.severity == Severity::Error) {
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
  SectionSchema section;
};

/// The whole of stride.toml.
struct TopSection {
  DiagnosticSection diagnostics;
  explicit TopSection(const SectionSchema &library)
      : sections{&kProject,       &library, &diagnostics.section,
                 &kImage,         &kRetain, &kFiles,
                 &kFormat,        &kTask,   &anyBusSection(),
                 &anyIoSection(), &kAxis,   &axesGroupSchema(),
                 &csySchema(),    &kCnc,    &kBuild,
                 &kTest},
        top{"", "stride.toml", "", false, {}, sections} {}
  std::array<const SectionSchema *, 16> sections;
  SectionSchema top;
};

} // namespace

const SectionSchema &formatSchema() { return kFormat; }

const SectionSchema &projectSchema() {
  static const TopSection schema(kUse);
  return schema.top;
}

const SectionSchema &librarySchema() {
  static const TopSection schema(kLibrary);
  return schema.top;
}

} // namespace stc
