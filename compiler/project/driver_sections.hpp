#ifndef STRIDE_COMPILER_PROJECT_DRIVER_SECTIONS_HPP
#define STRIDE_COMPILER_PROJECT_DRIVER_SECTIONS_HPP
// The sections of stride.toml that depend on a driver: what the registries of drivers/ say becomes
// schemas, and the rules between parameters of a section are checked.

#include "compiler/project/config.hpp"
#include "compiler/toml/schema.hpp"
#include "runtime/bus/driver_schema.hpp"
#include "runtime/bus/group_check.hpp"
#include "runtime/io/io_schema.hpp"

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// The driver's name in an InterfaceType: its first word.
[[nodiscard]] std::string_view driverOf(std::string_view interfaceType);

/// A section of several drivers, with all that is below it.
class DriverSection {
public:
  DriverSection() = default;
  DriverSection(const DriverSection &) = delete;
  DriverSection &operator=(const DriverSection &) = delete;
  ~DriverSection() = default;

  /// The section but for its parameters.
  void begin(const SectionSchema &section) { section_ = section; }
  /// Parameters and tables that it has now; those that another driver has as well stay as they are.
  /// `reason`: why they are without effect; empty: they are not.
  void add(std::span<const Parameter> parameters, const std::string &reason = {});
  void add(std::span<const stride::common::ParameterTable> tables, const std::string &reason = {});
  /// A section below, whatever the driver; it must live as long.
  void add(const SectionSchema &section) { sections_.push_back(&section); }
  /// When everything has been added.
  [[nodiscard]] const SectionSchema &finish();

private:
  SectionSchema section_;
  std::vector<Parameter> parameters_;
  std::vector<Foreign> foreign_;
  std::deque<SectionSchema> tables_;
  std::deque<std::string> paths_;
  std::vector<const SectionSchema *> sections_;
};

/// `[[bus]]` as one driver has it.
class BusSection {
public:
  /// `driver`: null for one that nobody knows; then the parameters of `all` count.
  BusSection(const stride::bus::DriverSchema *driver,
             std::span<const stride::bus::DriverSchema *const> all);
  [[nodiscard]] const SectionSchema &section() const { return *section_; }

private:
  DriverSection drive_;
  DriverSection encoder_;
  DriverSection axisGroup_;
  DriverSection bus_;
  const SectionSchema *section_;
};

/// `[[io]]` as one device has it.
class IoSection {
public:
  /// `driver`: null for one that nobody knows; then the parameters of `all` count.
  IoSection(const stride::io::IoSchema *driver, std::span<const stride::io::IoSchema *const> all);
  [[nodiscard]] const SectionSchema &section() const { return *section_; }

private:
  std::vector<Choice> devices_;
  std::vector<Parameter> general_;
  DriverSection io_;
  const SectionSchema *section_;
};

/// The section of this table of the list `[[bus]]` or `[[io]]`, by the driver that it names.
[[nodiscard]] const SectionSchema &busSection(const TomlNode &bus);
[[nodiscard]] const SectionSchema &ioSection(const TomlNode &io);
/// The sections with the parameters of all drivers.
[[nodiscard]] const SectionSchema &anyBusSection();
[[nodiscard]] const SectionSchema &anyIoSection();

/// What the rules between parameters need to know besides their section.
struct RuleScope {
  std::string_view counts = "counts "; ///< Before "only with …".
  std::string_view what = "drive";     ///< "only for linear {}s"
  bool rotary = false;
  /// Of drives that parameters name; null: it is not looked whether there is such a drive.
  const AxisGroupConfig *group = nullptr;
};

/// Reports what contradicts the rules of the section's rows: parameters without effect, missing
/// ones, those in the wrong order. What is wrong by itself has been reported.
void checkRules(const CheckedSection &section, const RuleScope &scope, Diagnostics &diagnostics);

/// Appends all valid parameters of a section, in the schema's order: numbers, choices with their
/// name, durations in seconds.
void addParameters(const CheckedSection &section, std::string_view prefix,
                   std::vector<ConfigParameter> &out);

/// Reads a driver's tables below the section of an axis group, a drive or an encoder.
void readDriverTables(const CheckedSection &section, const RuleScope &scope,
                      std::vector<ConfigParameter> &parameters, Diagnostics &diagnostics);

/// What the drivers of the axis groups say about what they exchange with their drives
/// (DriverSchema::plan), as far as they say something.
[[nodiscard]] std::vector<stride::bus::GroupPlanText> busPlans(const ProjectConfig &config);

/// Reports what the driver of an axis group has to say of it (DriverSchema::check). The group has
/// been read without errors; `cycleSeconds`: of its task.
void checkByDriver(const ProjectConfig &config, const AxisGroupConfig &group, double cycleSeconds,
                   Diagnostics &diagnostics);

/// What driver and program share about a drive, as its section says; null: nothing.
[[nodiscard]] const stride::bus::SharedData *sharedDataOf(const CheckedSection &drive,
                                                          std::string_view driver);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_DRIVER_SECTIONS_HPP
