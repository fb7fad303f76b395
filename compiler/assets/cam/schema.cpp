// The parameters of cam files: SoftMotion V2.3 manual, sections 4.3 and 4.4.

#include "compiler/toml/schema.hpp"
#include "compiler/assets/cam/cam_source.hpp"

#include <array>
#include <limits>

namespace stc {

namespace {

constexpr double kFarthest = 1e300;
constexpr double kMicroseconds = 4294967295.0;
constexpr double kGroups = 32767;

constexpr Parameter coordinate(std::string_view name, bool required = false) {
  return {name, ParameterType::Real, required, -kFarthest, kFarthest};
}

constexpr std::array<Choice, 5> kLaws = {
    {{"polynomial", static_cast<int64_t>(stride::cam::Law::Polynomial)},
     {"harmonic", static_cast<int64_t>(stride::cam::Law::Harmonic)},
     {"cycloidal", static_cast<int64_t>(stride::cam::Law::Cycloidal)},
     {"modified_sine", static_cast<int64_t>(stride::cam::Law::ModifiedSine)},
     {"modified_trapezoid", static_cast<int64_t>(stride::cam::Law::ModifiedTrapezoid)}}};

// SMC_CAMTAPPETTYPE and SMC_CAMTAPPETACTION.
constexpr std::array<Choice, 3> kPasses = {{{"positive", 0}, {"each", 1}, {"negative", 2}}};
constexpr std::array<Choice, 4> kActions = {{{"on", 0}, {"off", 1}, {"invert", 2}, {"timed", 3}}};

constexpr std::array<Choice, 4> kModes = {
    {{"polynomial", static_cast<int64_t>(CamMode::Polynomial)},
     {"equidistant", static_cast<int64_t>(CamMode::Equidistant)},
     {"element_optimised", static_cast<int64_t>(CamMode::ElementOptimised)},
     {"none", static_cast<int64_t>(CamMode::None)}}};
constexpr std::array<Choice, 6> kTypes = {
    {{"INT", 1}, {"UINT", 2}, {"DINT", 3}, {"UDINT", 4}, {"REAL", 5}, {"LREAL", 6}}};
constexpr std::array<Choice, 2> kInterpolations = {{{"linear", 1}, {"cubic", 3}}};

constexpr std::array kMasterParameters = {
    coordinate("start", true),
    coordinate("end", true),
    Parameter{"unit", ParameterType::Text},
};
constexpr std::array kSlaveParameters = {
    coordinate("minimum"),
    coordinate("maximum"),
    Parameter{"unit", ParameterType::Text},
};
constexpr std::array kPointParameters = {
    coordinate("x", true),
    coordinate("y", true),
    coordinate("v"),
    coordinate("a"),
    Parameter{"smooth", ParameterType::Boolean},
};
constexpr std::array kLineParameters = {
    coordinate("x", true),
    coordinate("y", true),
    coordinate("x_end", true),
    coordinate("y_end", true),
};
constexpr std::array kLawParameters = {
    coordinate("x", true),
    coordinate("y", true),
    coordinate("v"),
    coordinate("a"),
    coordinate("x_end", true),
    coordinate("y_end", true),
    coordinate("v_end"),
    coordinate("a_end"),
    Parameter{"law", ParameterType::Choice, true, 0, 0, kLaws},
    Parameter{"parameter", ParameterType::Real, false, 0, 0.999},
    Parameter{"inflexion", ParameterType::Real, false, 0.001, 0.999},
};
constexpr std::array kTappetParameters = {
    coordinate("x", true),
    Parameter{"group", ParameterType::Integer, true, 0, kGroups},
    Parameter{"pass", ParameterType::Choice, false, 0, 0, kPasses},
    Parameter{"action", ParameterType::Choice, false, 0, 0, kActions},
    Parameter{"delay", ParameterType::Integer, false, 0, kMicroseconds, {}, "µs"},
    Parameter{"duration", ParameterType::Integer, false, 0, kMicroseconds, {}, "µs"},
};
constexpr std::array kCompileParameters = {
    Parameter{"mode", ParameterType::Choice, true, 0, 0, kModes},
    Parameter{"type", ParameterType::Choice, false, 0, 0, kTypes},
    Parameter{"places", ParameterType::Integer, false, 2, stride::cam::kCamFileMaxCount},
    Parameter{"interpolation", ParameterType::Choice, false, 0, 0, kInterpolations},
    coordinate("master_minimum"),
    coordinate("master_maximum"),
    coordinate("slave_minimum"),
    coordinate("slave_maximum"),
};
constexpr std::array kCamParameters = {
    Parameter{"name", ParameterType::Identifier},
    Parameter{"periodic", ParameterType::Boolean},
    Parameter{"interval", ParameterType::Real, false, 0, std::numeric_limits<double>::max()},
};

constexpr SectionSchema kMaster = {"master", "the master", "master", false, kMasterParameters, {}};
constexpr SectionSchema kSlave = {"slave", "the slave", "slave", false, kSlaveParameters, {}};
constexpr SectionSchema kPoint = {"point", "a point", "point", true, kPointParameters, {}};
constexpr SectionSchema kLine = {"line", "a line", "line", true, kLineParameters, {}};
constexpr SectionSchema kLaw = {"law", "a law", "law", true, kLawParameters, {}};
constexpr SectionSchema kTappet = {"tappet", "a tappet", "tappet", true, kTappetParameters, {}};
constexpr SectionSchema kCompile = {"compile", "[compile]",        "compile",
                                    false,     kCompileParameters, {}};
constexpr std::array<const SectionSchema *, 7> kCamSections = {&kMaster, &kSlave,  &kPoint,  &kLine,
                                                               &kLaw,    &kTappet, &kCompile};
constexpr SectionSchema kCam = {"", "a cam", "", false, kCamParameters, kCamSections};

} // namespace

const SectionSchema &camSchema() { return kCam; }

} // namespace stc
