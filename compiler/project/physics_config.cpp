// The physics of a simulated drive: `[bus.axis_group.drive.physics]`.

#include "compiler/project/config_reader.hpp"
#include "compiler/project/names.hpp"
#include "compiler/semantics/suggest.hpp"

#include <array>
#include <fmt/format.h>

namespace stc {

namespace {

constexpr std::int64_t kIdeal = 0;
constexpr std::int64_t kLag = 1;
constexpr std::int64_t kSecondOrder = 2;

/// A parameter of one model.
struct OfModel {
  std::string_view name;
  std::int64_t model;
  bool needed;
  std::string_view example;
};

constexpr std::array kOfModel = {
    OfModel{"time_constant", kLag, true, "\"T#5ms\""},
    OfModel{"inertia", kSecondOrder, true, "0.01"},
    OfModel{"torque_limit", kSecondOrder, true, "10.0"},
    OfModel{"viscous_friction", kSecondOrder, false, {}},
    OfModel{"coulomb_friction", kSecondOrder, false, {}},
    OfModel{"position_gain", kSecondOrder, false, {}},
    OfModel{"velocity_gain", kSecondOrder, false, {}},
    OfModel{"velocity_integral_time", kSecondOrder, false, {}},
    OfModel{"velocity_feedforward", kSecondOrder, false, {}},
    OfModel{"substeps", kSecondOrder, false, {}},
};

constexpr std::array<std::string_view, 3> kModelNames = {"ideal", "lag", "second_order"};

} // namespace

void PlcReader::checkModel(const CheckedSection &section, std::int64_t model) {
  for (const OfModel &parameter : kOfModel) {
    if (parameter.model != model && section.get(parameter.name) != nullptr)
      withoutEffect(diagnostics_, section, parameter.name,
                    fmt::format("only with model = \"{}\"",
                                kModelNames[static_cast<std::size_t>(parameter.model)]));
    if (parameter.model == model && parameter.needed && !section.has(parameter.name))
      diagnostics_
          .report(Code::configMissingKey, section.get("model")->span,
                  fmt::format("the model \"{}\" needs `{}`",
                              kModelNames[static_cast<std::size_t>(model)], parameter.name),
                  "chosen here")
          .help(fmt::format("add it, for example `{} = {}`", parameter.name, parameter.example));
  }
}

void PlcReader::readPhysics(const CheckedSection &section, DriveConfig &drive, bool rotary) {
  drive.simulated = true;
  section.parameters("physics.", drive.parameters);
  // A wrong model has been reported; what would follow from it is not.
  if (!section.has("model") || section.get("model") != nullptr)
    checkModel(section, section.choice("model", kIdeal));
  for (const std::string_view name : {"limit_negative", "limit_positive"})
    if (rotary && section.get(name) != nullptr)
      withoutEffect(diagnostics_, section, name, "only for linear drives");
  const auto ordered = [&](std::string_view low, std::string_view high) {
    const TomlNode *from = section.get(low);
    const TomlNode *to = section.get(high);
    if (from != nullptr && to != nullptr && !(from->floating < to->floating))
      diagnostics_
          .report(Code::configLimits, from->span, fmt::format("{} must be less than {}", low, high),
                  "not less than …")
          .label(to->span, "… this");
  };
  ordered("limit_negative", "limit_positive");
  if (!rotary) // on a turning axis the switch may lie across the start of the turn
    ordered("home_switch_from", "home_switch_to");
  const auto together = [&](std::string_view name, std::string_view with) {
    if (section.get(name) != nullptr && !section.has(with))
      diagnostics_
          .report(Code::configMissingKey, section.get(name)->keySpan,
                  fmt::format("`{}` needs `{}`", name, with), "is not enough")
          .help(fmt::format("add `{} = …`, a position in technical units", with));
  };
  together("home_switch_from", "home_switch_to");
  together("home_switch_to", "home_switch_from");
  together("index_distance", "index_position");
  together("probe_distance", "probe_position");
}

void PlcReader::readEncoderPhysics(const CheckedSection &section, const AxisGroupConfig &group,
                                   EncoderConfig &encoder) {
  section.parameters("physics.", encoder.parameters);
  const TomlNode *follows = section.get("follows");
  if (follows == nullptr)
    return;
  if (section.get("own_velocity") != nullptr)
    withoutEffect(diagnostics_, section, "own_velocity", "only without `follows`");
  std::vector<std::string_view> names;
  for (const DriveConfig &drive : group.drives) {
    if (equalIgnoringCase(drive.name.text, follows->text))
      return;
    names.push_back(drive.name.text);
  }
  Diagnostic &d = diagnostics_.report(
      Code::configUnknownChoice, follows->span,
      fmt::format("axis group `{}` has no drive `{}`", group.name.text, follows->text),
      "an encoder follows a drive of its axis group");
  if (const std::string_view near = nearest(follows->text, names); !near.empty())
    d.help(fmt::format("did you mean \"{}\"?", near));
}

} // namespace stc
