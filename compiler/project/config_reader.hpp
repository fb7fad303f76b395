#pragma once
// What the readers of stride.toml's sections share.

#include "compiler/project/config.hpp"
#include "compiler/project/schema.hpp"

#include <string>
#include <string_view>
#include <unordered_map>

namespace stc {

/// The `name` of a section; with an invalid span when it is missing or wrong.
[[nodiscard]] ConfigName nameOf(const CheckedSection &section);

/// A number as a literal of ST.
[[nodiscard]] std::string realLiteral(double value);

/// Names in lower case that the files give to things of the whole project, and where.
[[nodiscard]] std::unordered_map<std::string, Span>
globalNames(const std::vector<ast::File *> &files);

/// Reports the second use of a name or number, with the first one marked.
class Unique {
public:
  Unique(Code code, Diagnostics &diagnostics) : code_(code), diagnostics_(diagnostics) {}

  /// True for a new one; else `message` has been reported at `where`.
  bool add(const std::string &key, Span where, const std::string &message);

private:
  Code code_;
  Diagnostics &diagnostics_;
  std::unordered_map<std::string, Span> seen_;
};

/// Warns that a valid parameter changes nothing; `reason` completes "counts …".
void withoutEffect(Diagnostics &diagnostics, const CheckedSection &section, std::string_view name,
                   std::string_view reason);

/// ST that declares g_DRIVESTRUCT and its type; the axis groups, drives and encoders are declared
/// elsewhere.
[[nodiscard]] std::string driveStruct(const ProjectConfig &config);

/// Reads `[[bus]]` with everything below it into the configuration.
class PlcReader {
public:
  PlcReader(ProjectConfig &config, Diagnostics &diagnostics)
      : config_(config), diagnostics_(diagnostics) {}

  void readBus(const CheckedSection &section);

private:
  /// The kind of bus, which decides about the parameters of an axis group.
  enum class BusKind : std::uint8_t { any, can, sercos };

  std::string readDriver(const TomlNode &type);
  void readAxisGroup(const CheckedSection &section, BusConfig &bus, BusKind kind);
  void readCan(const CheckedSection &section, AxisGroupConfig &group, BusKind kind);
  void readSercos(const CheckedSection &section, AxisGroupConfig &group, BusKind kind);
  void readBaudRate(const CheckedSection &section, BusKind kind);
  void readDrive(const CheckedSection &section, AxisGroupConfig &group, Unique &ids);
  void readCyclicData(const CheckedSection &section, ConfigFields &fields);
  bool checkCyclicData(const CheckedSection &section, std::string_view direction);
  void readEncoder(const CheckedSection &section, AxisGroupConfig &group, Unique &ids);
  void readScaling(const CheckedSection &section, ConfigFields &fields, std::string_view what);
  void checkPeriod(const CheckedSection &section, const TomlNode &period, std::string_view what);
  void readLimits(const CheckedSection &section, ConfigFields &fields, bool rotary,
                  std::string_view what);
  void readRamp(const CheckedSection &section, ConfigFields &fields);
  bool addVariable(const ConfigName &name);

  ProjectConfig &config_;
  Diagnostics &diagnostics_;
  Unique busNames_{Code::configDuplicateName, diagnostics_};
  Unique variableNames_{Code::configDuplicateName, diagnostics_};
};

} // namespace stc
