#include "compiler/project/driver_sections.hpp"

#include "compiler/source/suggest.hpp"
#include "compiler/syntax/st_text.hpp"
#include "compiler/toml/interval.hpp"
#include "drivers/io/registry.hpp"
#include "drivers/registry.hpp"
#include "runtime/bus/plc_schema.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <memory>

namespace stc {

namespace {

namespace common = stride::common;
namespace plc = stride::bus::plc;
using stride::bus::DriverSchema;
using stride::io::IoSchema;

constexpr double kImageArea = 16777216;

constexpr std::array<Choice, 2> kOnLoss = {{{"keep", 0}, {"safe", 1}}};

constexpr std::array<Choice, 2> kOnStop = {{{"fallback", 0}, {"hold", 1}}};

constexpr std::array kIoParameters = {
    common::identifier("name").needed(),
    common::whole("inputs_at", 0, kImageArea, "bytes").defaultsTo(0),
    common::whole("inputs", 0, kImageArea, "bytes").defaultsTo(0),
    common::whole("outputs_at", 0, kImageArea, "bytes").defaultsTo(0),
    common::whole("outputs", 0, kImageArea, "bytes").defaultsTo(0),
    common::choice("on_loss", kOnLoss).defaultsTo(0),
    common::choice("on_stop", kOnStop).defaultsTo(0),
};

constexpr std::array kIoChannelParameters = {
    common::identifier("name").needed(),
    common::text("address").needed(),
    common::whole("safe_value", -2147483648.0, common::kLargestDword),
    common::text("comment"),
};
constexpr SectionSchema kIoChannel = {"channel", "a channel",          "io.channel",
                                      true,      kIoChannelParameters, {}};

/// The driver's own first, so that they go before those of others with the same name.
template <class Schema, class Visit>
void forEachDriver(const Schema *driver, std::span<const Schema *const> all, const Visit &visit) {
  if (driver != nullptr)
    visit(*driver, false);
  for (const Schema *other : all)
    if (other != driver)
      visit(*other, driver != nullptr);
}

} // namespace

std::string_view driverOf(std::string_view interfaceType) {
  return interfaceType.substr(0, interfaceType.find(' '));
}

void DriverSection::add(std::span<const Parameter> parameters, const std::string &reason) {
  for (const Parameter &parameter : parameters) {
    if (std::any_of(parameters_.begin(), parameters_.end(),
                    [&](const Parameter &known) { return known.name == parameter.name; }))
      continue;
    parameters_.push_back(parameter);
    if (!reason.empty())
      foreign_.push_back({parameter.name, reason});
  }
}

void DriverSection::add(std::span<const common::ParameterTable> tables, const std::string &reason) {
  for (const common::ParameterTable &table : tables) {
    if (std::any_of(sections_.begin(), sections_.end(),
                    [&](const SectionSchema *known) { return known->name == table.name; }))
      continue;
    paths_.push_back(fmt::format("{}.{}", section_.path, table.name));
    SectionSchema &section = tables_.emplace_back();
    section.name = table.name;
    section.what = table.what;
    section.path = paths_.back();
    section.parameters = table.parameters;
    sections_.push_back(&section);
    if (!reason.empty())
      foreign_.push_back({table.name, reason});
  }
}

const SectionSchema &DriverSection::finish() {
  section_.parameters = parameters_;
  section_.sections = sections_;
  section_.foreign = foreign_;
  return section_;
}

BusSection::BusSection(const DriverSchema *driver, std::span<const DriverSchema *const> all) {
  drive_.begin({"drive", "a drive", "bus.axis_group.drive", true});
  drive_.add(plc::kDrive);
  encoder_.begin({"encoder", "an encoder", "bus.axis_group.encoder", true});
  encoder_.add(plc::kEncoder);
  axisGroup_.begin({"axis_group", "an axis group", "bus.axis_group", true});
  axisGroup_.add(plc::kAxisGroup);
  bus_.begin({"bus", "a bus", "bus", true});
  bus_.add(plc::kBus);
  forEachDriver(driver, all, [this](const DriverSchema &one, bool foreign) {
    const std::string reason =
        foreign ? fmt::format("only with InterfaceType = \"{}\"", one.interfaceType)
                : std::string();
    drive_.add(one.drive, reason);
    drive_.add(one.driveTables, reason);
    encoder_.add(one.encoder, reason);
    encoder_.add(one.encoderTables, reason);
    axisGroup_.add(one.axisGroup, reason);
    axisGroup_.add(one.axisGroupTables, reason);
    bus_.add(one.bus, reason);
  });
  axisGroup_.add(drive_.finish());
  axisGroup_.add(encoder_.finish());
  bus_.add(axisGroup_.finish());
  section_ = &bus_.finish();
}

IoSection::IoSection(const IoSchema *driver, std::span<const IoSchema *const> all) {
  for (const IoSchema *one : all)
    devices_.push_back({one->name, static_cast<int64_t>(devices_.size())});
  general_.assign(kIoParameters.begin(), kIoParameters.end());
  general_.insert(general_.begin() + 1, common::choice("device", devices_).needed());
  io_.begin({"io", "an I/O device", "io", true});
  io_.add(general_);
  forEachDriver(driver, all, [this, driver](const IoSchema &one, bool foreign) {
    const std::string reason =
        foreign ? fmt::format("only with device = \"{}\"", one.name) : std::string();
    // What one kind needs the others do without.
    for (Parameter parameter : one.parameters) {
      parameter.required = parameter.required && &one == driver;
      io_.add({&parameter, 1}, reason);
    }
    io_.add(one.tables, reason);
  });
  io_.add(kIoChannel);
  section_ = &io_.finish();
}

namespace {

/// By name of the driver; "" for one that nobody knows.
template <class SectionOf, class Schema>
std::map<std::string_view, std::unique_ptr<SectionOf>>
sectionsOf(std::span<const Schema *const> all) {
  std::map<std::string_view, std::unique_ptr<SectionOf>> sections;
  sections[""] = std::make_unique<SectionOf>(nullptr, all);
  for (const Schema *one : all)
    sections[one->name] = std::make_unique<SectionOf>(one, all);
  return sections;
}

const SectionSchema &busSectionOf(std::string_view driver) {
  static const auto sections =
      sectionsOf<BusSection, DriverSchema>(std::span(stride::drivers::kSchemas));
  const auto found = sections.find(driver);
  return (found != sections.end() ? found : sections.find(""))->second->section();
}

const SectionSchema &ioSectionOf(std::string_view driver) {
  static const auto sections =
      sectionsOf<IoSection, IoSchema>(std::span(stride::drivers::kIoSchemas));
  const auto found = sections.find(driver);
  return (found != sections.end() ? found : sections.find(""))->second->section();
}

} // namespace

const SectionSchema &anyBusSection() { return busSectionOf({}); }
const SectionSchema &anyIoSection() { return ioSectionOf({}); }

const SectionSchema &busSection(const TomlNode &bus) {
  const TomlNode *type = bus.find("InterfaceType");
  return busSectionOf(type != nullptr && type->kind == TomlKind::String ? driverOf(type->text)
                                                                        : std::string_view());
}

const SectionSchema &ioSection(const TomlNode &io) {
  const TomlNode *device = io.find("device");
  if (device == nullptr)
    return anyIoSection();
  const auto number = findChoice(*findParameter(anyIoSection(), "device"), *device);
  return number ? ioSectionOf(stride::drivers::kIoSchemas[static_cast<size_t>(*number)]->name)
                : anyIoSection();
}

namespace {

/// The rules of one section.
class RuleChecker {
public:
  RuleChecker(const CheckedSection &section, const RuleScope &scope, Diagnostics &diagnostics)
      : section_(section), scope_(scope), diagnostics_(diagnostics) {}

  void check() {
    for (const Parameter &row : section_.schema().parameters) {
      checkCondition(row);
      if (!row.without.empty() && section_.get(row.without) != nullptr)
        withoutEffect(row, fmt::format("only without `{}`", row.without));
      if (row.linearOnly && scope_.rotary)
        withoutEffect(row, fmt::format("only for linear {}s", scope_.what));
      if (!row.lessThan.empty() && !(row.lessOnLinearOnly && scope_.rotary))
        checkOrder(row);
      if (!row.with.empty())
        checkTogether(row);
      if (row.type == ParameterType::DriveName && scope_.group != nullptr &&
          section_.get(row.name) != nullptr)
        checkDrive(*section_.get(row.name));
    }
  }

private:
  void withoutEffect(const Parameter &row, std::string_view reason) {
    if (const TomlNode *value = section_.get(row.name))
      diagnostics_.report(Code::ConfigWithoutEffect, value->keySpan,
                          fmt::format("`{}` has no effect here", row.name),
                          fmt::format("{}{}", scope_.counts, reason));
  }

  void checkCondition(const Parameter &row) {
    const std::string_view on = row.only.parameter;
    // A wrong value has been reported; what would follow from it is not.
    if (on.empty() || (section_.has(on) && section_.get(on) == nullptr))
      return;
    const Parameter &of = *findParameter(section_.schema(), on);
    const bool isChoice = of.type == ParameterType::Choice;
    const int64_t value =
        isChoice ? section_.choice(on) : static_cast<int64_t>(section_.boolean(on));
    if (value != row.only.value) {
      withoutEffect(row, fmt::format("only with {} = {}", on, valueText(of, row.only.value)));
      return;
    }
    if (row.example.empty() || section_.has(row.name))
      return;
    const TomlNode *given = section_.get(on);
    diagnostics_
        .report(Code::ConfigMissingKey, given != nullptr ? given->span : section_.table().span,
                fmt::format("the {} {} needs `{}`", on, valueText(of, value), row.name),
                "chosen here")
        .help(fmt::format("add it, for example `{} = {}`", row.name, row.example));
  }

  static std::string valueText(const Parameter &of, int64_t value) {
    for (const Choice &choice : of.choices)
      if (choice.value == value)
        return fmt::format("\"{}\"", choice.name);
    return value != 0 ? "true" : "false";
  }

  void checkOrder(const Parameter &row) {
    const TomlNode *from = section_.get(row.name);
    const TomlNode *to = section_.get(row.lessThan);
    if (from != nullptr && to != nullptr && !(from->floating < to->floating))
      diagnostics_
          .report(Code::ConfigLimits, from->span,
                  fmt::format("{} must be less than {}", row.name, row.lessThan), "not less than …")
          .label(to->span, "… this");
  }

  void checkTogether(const Parameter &row) {
    if (section_.get(row.name) == nullptr || section_.has(row.with))
      return;
    const Parameter &with = *findParameter(section_.schema(), row.with);
    diagnostics_
        .report(Code::ConfigMissingKey, section_.get(row.name)->keySpan,
                fmt::format("`{}` needs `{}`", row.name, row.with), "is not enough")
        .help(fmt::format("add `{} = …`{}", row.with,
                          with.unit == "u" ? ", a position in technical units" : ""));
  }

  void checkDrive(const TomlNode &value) {
    std::vector<std::string_view> names;
    for (const DriveConfig &drive : scope_.group->drives) {
      if (equalIgnoringCase(drive.name.text, value.text))
        return;
      names.push_back(drive.name.text);
    }
    Diagnostic &d = diagnostics_.report(
        Code::ConfigUnknownChoice, value.span,
        fmt::format("axis group `{}` has no drive `{}`", scope_.group->name.text, value.text),
        "an encoder follows a drive of its axis group");
    if (const std::string_view near = nearest(value.text, names); !near.empty())
      d.help(fmt::format("did you mean \"{}\"?", near));
  }

  const CheckedSection &section_;
  const RuleScope &scope_;
  Diagnostics &diagnostics_;
};

} // namespace

void checkRules(const CheckedSection &section, const RuleScope &scope, Diagnostics &diagnostics) {
  RuleChecker(section, scope, diagnostics).check();
}

void addParameters(const CheckedSection &section, std::string_view prefix,
                   std::vector<ConfigParameter> &out) {
  for (const Parameter &parameter : section.schema().parameters) {
    const TomlNode *value = section.get(parameter.name);
    if (value == nullptr)
      continue;
    ConfigParameter &result = out.emplace_back();
    result.name = std::string(prefix) + std::string(parameter.name);
    switch (parameter.type) {
    case ParameterType::Text:
    case ParameterType::Identifier:
    case ParameterType::DriveName:
      result.text = value->text;
      break;
    case ParameterType::Boolean:
      result.number = value->boolean ? 1 : 0;
      break;
    case ParameterType::Integer:
    case ParameterType::Real:
      result.number = value->floating;
      break;
    case ParameterType::Choice: {
      const int64_t number = findChoice(parameter, *value).value_or(0);
      result.number = static_cast<double>(number);
      for (const Choice &choice : parameter.choices)
        if (choice.value == number)
          result.text = choice.name;
      break;
    }
    case ParameterType::Interval:
      result.number = static_cast<double>(parseInterval(value->text).value_or(0)) * 1e-9;
      break;
    case ParameterType::NameList: // by lines
      for (const TomlNode &element : value->children)
        result.text += (result.text.empty() ? "" : "\n") + element.text;
      break;
    }
  }
}

void readDriverTables(const CheckedSection &section, const RuleScope &scope,
                      std::vector<ConfigParameter> &parameters, Diagnostics &diagnostics) {
  checkRules(section, scope, diagnostics);
  for (const SectionSchema *below : section.schema().sections) {
    if (below->list)
      continue;
    for (const CheckedSection &table : section.sections(below->name, diagnostics)) {
      addParameters(table, fmt::format("{}.", below->name), parameters);
      checkRules(table, scope, diagnostics);
    }
  }
}

const stride::bus::SharedData *sharedDataOf(const CheckedSection &drive, std::string_view driver) {
  const DriverSchema *known = stride::drivers::findSchema(driver);
  for (const DriverSchema *one : stride::drivers::kSchemas)
    if ((known == nullptr || one == known) && !one->driveData.type.empty() &&
        drive.get(one->driveData.table) != nullptr)
      return &one->driveData;
  return nullptr;
}

} // namespace stc
