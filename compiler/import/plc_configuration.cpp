#include "compiler/import/plc_configuration.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/project_files.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace stc::import {

namespace {

enum class Role { Other, Bus, Group, Drive, Encoder };

struct RoleName {
  std::string_view word; ///< in lower case
  Role role;
  Role above; ///< what it stands in; Other: in nothing that has to do with drives
};
// The manual's names of the elements of the PLC configuration (2.1.1 to 2.1.4).
constexpr std::array<RoleName, 4> kRoles = {{{"businterface", Role::Bus, Role::Other},
                                             {"axisgroup", Role::Group, Role::Bus},
                                             {"encoder", Role::Encoder, Role::Group},
                                             {"drive", Role::Drive, Role::Group}}};

struct Module {
  Role role = Role::Other;
  std::string section;
  std::string name;
  Origin origin;
};

/// `name` as an identifier; names of modules are any texts.
std::string identifierOf(std::string_view name) {
  std::string result;
  for (const char c : name) {
    const bool good =
        c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (good && !(c == '_' && result.ends_with('_')))
      result += c;
    else if (!good && !result.ends_with('_'))
      result += '_';
  }
  if (result.empty() || (result.front() >= '0' && result.front() <= '9'))
    result.insert(result.begin(), '_');
  return result;
}

/// `'name' 'comment'`: the texts between apostrophes; `$'` is one in a text.
std::vector<std::string> textsOf(std::string_view line) {
  std::vector<std::string> texts;
  bool inside = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '\'') {
      inside = !inside;
      if (inside)
        texts.emplace_back();
    } else if (inside && line[i] == '$' && i + 1 < line.size()) {
      const char c = line[++i];
      texts.back() += c == 'N' || c == 'R' || c == 'T' || c == 'L' ? ' ' : c;
    } else if (inside) {
      texts.back() += line[i];
    }
  }
  return texts;
}

/// By the size in the address; four bytes may be a number of another kind, which the section says.
std::string_view typeOf(std::string_view address, const std::string &section) {
  const bool isReal = lowerCase(section).find("float") != std::string::npos ||
                      lowerCase(section).find("real") != std::string::npos;
  switch (address.size() > 2 ? address[2] : '\0') {
  case 'B':
    return "BYTE";
  case 'W':
    return "WORD";
  case 'D':
    return isReal ? "REAL" : "DWORD";
  case 'R':
    return "REAL";
  default:
    return "BOOL";
  }
}

class Configuration {
public:
  Configuration(const std::vector<std::string> &lines, const Origin &origin, Model &model)
      : lines_(lines), origin_(origin), model_(model) {}

  void read() {
    for (at_ = 0; at_ < lines_.size(); ++at_)
      readLine(trimmed(lines_[at_]));
    finishModule();
    if (parameters_ != 0)
      model_.notes.push_back(fmt::format(
          "The PLC configuration ({}:{}) sets parameters of the target's hardware, which Stride's "
          "devices do not have: {}. Its text is kept in import/kept.",
          origin_.file, origin_.line, parameters_));
  }

private:
  [[nodiscard]] Origin here() const { return {origin_.file, origin_.line + at_}; }

  void readLine(std::string_view line) {
    const std::string_view key = firstWord(line);
    const std::vector<std::string> texts = textsOf(line);
    const std::string first = texts.empty() ? std::string() : texts.front();
    if (key == "_MODULE")
      begin(first);
    else if (key == "_END_MODULE")
      end();
    else if (key == "_CHANNEL")
      finishModule(), channel_ = IoChannel{{}, {}, {}, {}, here()};
    else if (key == "_END_CHANNEL")
      finishChannel();
    else if (key == "_SYMBOLIC_NAME" && channel_)
      channel_->name = first;
    else if (key == "_COMMENT" && channel_)
      channel_->comment = first;
    else if (key == "_IECADR" && channel_)
      setAddress(line);
    else if (key == "_BIT" && channel_)
      addBit(line, texts);
    else if (key == "_SECTION_NAME" && channel_)
      channelSection_ = first;
    else if (key == "_SECTION_NAME" && !modules_.empty())
      modules_.back().section = first;
    else if (key == "_MODULE_NAME" && !modules_.empty())
      modules_.back().name = first;
    else if (key == "_PARAM")
      addParameter(line, first);
  }

  void begin(const std::string &vendor) {
    finishModule();
    modules_.push_back({Role::Other, {}, {}, here()});
    open_ = true;
    if (vendor != "3S" && foreign_.insert(vendor).second)
      model_.leftOut.push_back({here(), fmt::format("module of `{}`", vendor),
                                "settings of fieldbus modules of this vendor are not imported; "
                                "channels with names are"});
  }

  void end() {
    finishModule();
    if (!modules_.empty())
      modules_.pop_back();
  }

  /// The nearest module around the last one that has to do with drives.
  [[nodiscard]] Role roleAround() const {
    for (size_t i = modules_.size() - 1; i-- > 0;)
      if (modules_[i].role != Role::Other)
        return modules_[i].role;
    return Role::Other;
  }

  /// Name and section of the last module are known: what is it?
  void finishModule() {
    if (!open_ || modules_.empty())
      return;
    open_ = false;
    Module &module = modules_.back();
    bool nestedBus = false;
    for (const RoleName &each : kRoles)
      if (module.role == Role::Other &&
          (lowerCase(module.section).find(each.word) != std::string::npos ||
           lowerCase(module.name).starts_with(each.word))) {
        if (each.above == roleAround())
          module.role = each.role;
        else
          nestedBus = nestedBus || each.role == Role::Bus;
      }
    if (nestedBus && module.role == Role::Other)
      model_.leftOut.push_back({module.origin, fmt::format("bus interface `{}`", module.name),
                                "it stands inside another bus interface"});
    addDrive(module);
  }

  std::string nameOf(const Module &module) {
    std::string name = identifierOf(module.name);
    if (name != module.name)
      model_.changed.push_back(
          {module.origin, fmt::format("module `{}`", module.name),
           fmt::format("became {}: its name is that of a variable here", name)});
    return name;
  }

  void addDrive(const Module &module) {
    switch (module.role) {
    case Role::Other:
      return;
    case Role::Bus:
      model_.buses.push_back({nameOf(module), {}, module.origin});
      return;
    case Role::Group:
      model_.buses.back().groups.push_back({nameOf(module), {}, {}, module.origin, {}, {}});
      return;
    case Role::Drive:
      group().drives.push_back({nameOf(module), {}, module.origin, {}});
      return;
    case Role::Encoder:
      group().encoders.push_back({nameOf(module), {}, module.origin, {}});
      return;
    }
  }

  DriveGroupSetup &group() { return model_.buses.back().groups.back(); }

  void setAddress(std::string_view line) {
    const size_t colon = line.find(':');
    channel_->address = trimmed(line.substr(colon == std::string_view::npos ? 0 : colon + 1));
    if (channel_->address.starts_with('%') && channel_->address.size() > 2)
      model_.hardware.push_back({channel_->address, here()});
  }

  /// `_BIT 3: %IX0.0.3 'name' 'comment'`
  void addBit(std::string_view line, const std::vector<std::string> &texts) {
    const size_t percent = line.find('%');
    if (percent == std::string_view::npos || texts.empty() || texts[0].empty())
      return;
    const std::string address(line.substr(percent, line.find_first_of(" \t", percent) - percent));
    addNamed({texts[0], address, "BOOL", texts.size() > 1 ? texts[1] : std::string(), here()});
  }

  void finishChannel() {
    if (channel_ && !channel_->name.empty() && !channel_->address.empty()) {
      channel_->type = typeOf(channel_->address, channelSection_);
      addNamed(*channel_);
    }
    channel_.reset();
  }

  void addNamed(IoChannel channel) {
    const std::string name = identifierOf(channel.name);
    if (name != channel.name)
      model_.changed.push_back({channel.origin, fmt::format("channel `{}`", channel.name),
                                fmt::format("became {}: it is a variable here", name)});
    channel.name = name;
    model_.channels.push_back(std::move(channel));
  }

  /// `_PARAM 12: 0, 'value'`
  void addParameter(std::string_view line, const std::string &value) {
    finishModule();
    const Role role = modules_.empty() || channel_ ? Role::Other : modules_.back().role;
    NumberedParameter parameter{0, value};
    const std::string_view digits = trimmed(line.substr(firstWord(line).size()));
    std::from_chars(digits.data(), digits.data() + digits.size(), parameter.number);
    if (role == Role::Group)
      group().numbered.push_back(parameter);
    else if (role == Role::Drive)
      group().drives.back().numbered.push_back(parameter);
    else if (role == Role::Encoder)
      group().encoders.back().numbered.push_back(parameter);
    else
      ++parameters_;
  }

  const std::vector<std::string> &lines_;
  const Origin &origin_;
  Model &model_;
  size_t at_ = 0;
  std::vector<Module> modules_; ///< those that are open, the root first
  bool open_ = false;           ///< the last one's head is being read
  std::optional<IoChannel> channel_;
  std::string channelSection_;
  std::set<std::string> foreign_; ///< vendors
  size_t parameters_ = 0;         ///< of modules that are no drives
};

/// How a value of the target's configuration becomes one of stride.toml.
enum class ValueKind { Number, Switch, Choice, Text };

struct KnownParameter {
  std::string_view key;
  ValueKind kind;
};
// The names that the manual gives to module parameters (2.1.2 to 2.1.4).
constexpr std::array<KnownParameter, 28> kParameters = {{
    {"sTask", ValueKind::Text},
    {"dwCycle", ValueKind::Number},
    {"wDriveId", ValueKind::Number},
    {"wEncoderId", ValueKind::Number},
    {"wControlType", ValueKind::Choice},
    {"wCyclicDataS1", ValueKind::Choice},
    {"wCyclicDataS2", ValueKind::Choice},
    {"wCyclicDataS3", ValueKind::Choice},
    {"wCyclicDataR1", ValueKind::Choice},
    {"wCyclicDataR2", ValueKind::Choice},
    {"wCyclicDataR3", ValueKind::Choice},
    {"dwRatioTechUnitsDenom", ValueKind::Number},
    {"iRatioTechUnitsNum", ValueKind::Number},
    {"iMovementType", ValueKind::Choice},
    {"fPositionPeriod", ValueKind::Number},
    {"fSWMaxVelocity", ValueKind::Number},
    {"fSWMaxAcceleration", ValueKind::Number},
    {"fSWMaxDeceleration", ValueKind::Number},
    {"bSWLimitEnable", ValueKind::Switch},
    {"fSWLimitNegative", ValueKind::Number},
    {"fSWLimitPositive", ValueKind::Number},
    {"bHWLimitEnable", ValueKind::Switch},
    {"eRampType", ValueKind::Choice},
    {"fJerk", ValueKind::Number},
    {"dwEncoderModulo", ValueKind::Number},
    {"wParam1", ValueKind::Number},
    {"dwParam1", ValueKind::Number},
    {"unit", ValueKind::Text},
}};

std::string tomlValue(const std::string &value, ValueKind kind) {
  const std::string lower = lowerCase(value);
  if (kind == ValueKind::Switch && (lower == "true" || lower == "1" || lower == "yes"))
    return "true";
  if (kind == ValueKind::Switch && (lower == "false" || lower == "0" || lower == "no"))
    return "false";
  if (kind != ValueKind::Text)
    if (std::optional<std::string> number = tomlNumber(value))
      return *std::move(number);
  return tomlText(kind == ValueKind::Choice ? lower : value);
}

/// Numbers of the words of a line or section of the configuration file.
std::optional<int> numberIn(std::string_view text) {
  const size_t digit = text.find_first_of("0123456789");
  if (digit == std::string_view::npos)
    return std::nullopt;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data() + digit, text.data() + text.size(), number);
  return error == std::errc() ? std::optional(number) : std::nullopt;
}

bool hasWord(std::string_view text, std::string_view word) {
  const auto letter = [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1))
    if ((at == 0 || !letter(text[at - 1])) &&
        (at + word.size() == text.size() || !letter(text[at + word.size()])))
      return true;
  return false;
}

/// Number → parameter. Where a section `[…]` has the name, `Id=` or the section's own number count.
std::map<int, const KnownParameter *> namesOf(const std::string &configuration) {
  std::map<int, const KnownParameter *> names;
  std::optional<int> section;
  for (const std::string_view raw : linesOf(configuration)) {
    const std::string_view line = trimmed(raw);
    const size_t equals = line.find('=');
    const std::string_view key = trimmed(line.substr(0, std::min(equals, line.size())));
    if (line.starts_with('['))
      section = numberIn(line);
    else if (equals != std::string_view::npos && equalIgnoringCase(key, "id"))
      section = numberIn(line.substr(equals + 1));
    for (const KnownParameter &each : kParameters)
      if (equals != std::string_view::npos && hasWord(line.substr(equals + 1), each.key))
        if (const std::optional<int> number = numberIn(key) ? numberIn(key) : section)
          names.try_emplace(*number, &each);
  }
  return names;
}

bool has(const std::vector<Parameter> &parameters, std::string_view key) {
  return std::any_of(parameters.begin(), parameters.end(),
                     [&](const Parameter &each) { return each.key == key; });
}

void nameAll(std::vector<Parameter> &parameters, const std::vector<NumberedParameter> &numbered,
             const std::map<int, const KnownParameter *> &names) {
  for (const NumberedParameter &each : numbered)
    if (const auto name = names.find(each.number); name != names.end())
      if (!has(parameters, name->second->key))
        parameters.push_back({std::string(name->second->key),
                              tomlValue(each.value, name->second->kind), Certainty::Guessed,
                              fmt::format("parameter {} by the configuration file", each.number)});
}

/// What every drive needs and the file does not say.
void addMissing(std::vector<Parameter> &parameters) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kNeeded = {
      {{"iMovementType", "\"linear\""},
       {"dwRatioTechUnitsDenom", "10000"},
       {"iRatioTechUnitsNum", "1"}}};
  for (const auto &[key, example] : kNeeded)
    if (!has(parameters, key))
      parameters.push_back({std::string(key), std::string(example), Certainty::Missing, {}});
}

void nameDrives(std::vector<DriveSetup> &drives, const char *address,
                const std::map<int, const KnownParameter *> &names) {
  size_t order = 0;
  for (DriveSetup &drive : drives) {
    ++order;
    nameAll(drive.parameters, drive.numbered, names);
    if (!has(drive.parameters, address))
      drive.parameters.insert(drive.parameters.begin(), {address, fmt::format("{}", order),
                                                         Certainty::Guessed, "by its order"});
    if (!drive.numbered.empty() || names.empty())
      addMissing(drive.parameters);
  }
}

} // namespace

void readPlcConfiguration(const std::vector<std::string> &lines, const Origin &origin,
                          Model &model) {
  Configuration(lines, origin, model).read();
}

void nameParameters(Model &model, const std::string &configuration) {
  const std::map<int, const KnownParameter *> names = namesOf(configuration);
  for (BusSetup &bus : model.buses)
    for (DriveGroupSetup &group : bus.groups) {
      nameAll(group.parameters, group.numbered, names);
      if (!group.numbered.empty() && !has(group.parameters, "sTask"))
        group.parameters.push_back(
            {"sTask", tomlText(model.tasks.empty() ? "MotionTask" : model.tasks[0].name),
             model.tasks.size() > 1 ? Certainty::Guessed : Certainty::Missing, "the first task"});
      nameDrives(group.drives, "wDriveId", names);
      nameDrives(group.encoders, "wEncoderId", names);
    }
}

} // namespace stc::import
