#ifndef STRIDE_COMPILER_PROJECT_CONFIG_READER_HPP
#define STRIDE_COMPILER_PROJECT_CONFIG_READER_HPP
// What the readers of stride.toml's sections share.

#include "compiler/project/config.hpp"
#include "compiler/toml/schema.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// The whole of stride.toml, as the section without a name.
[[nodiscard]] const SectionSchema &projectSchema();
/// The same of a library, in which `library` is a table.
[[nodiscard]] const SectionSchema &librarySchema();
/// [fmt]: how sources are formatted.
[[nodiscard]] const SectionSchema &formatSchema();

/// ST that declares g_DRIVESTRUCT and its type; the axis groups, drives and encoders are declared
/// elsewhere.
[[nodiscard]] std::string driveStruct(const ProjectConfig &config);

/// [[axes_group]]
[[nodiscard]] const SectionSchema &axesGroupSchema();

/// Reads `[[bus]]` with everything below it, `[[axis]]`, and `[[axes_group]]`, into the
/// configuration.
class PlcReader {
public:
  PlcReader(ProjectConfig &config, Diagnostics &diagnostics)
      : config_(config), diagnostics_(diagnostics) {}

  void readBus(const CheckedSection &section);
  void readAxis(const CheckedSection &section);
  void readAxesGroup(const CheckedSection &section);

private:
  /// The kind of bus, which decides about the parameters of an axis group.
  enum class BusKind : uint8_t { Any, Can, Sercos };

  std::string readDriver(const TomlNode &type);
  void readAxisGroup(const CheckedSection &section, BusConfig &bus, BusKind kind);
  void readCan(const CheckedSection &section, AxisGroupConfig &group, BusKind kind);
  void readSercos(const CheckedSection &section, AxisGroupConfig &group, BusKind kind);
  void readBaudRate(const CheckedSection &section, BusKind kind);
  void readDrive(const CheckedSection &section, AxisGroupConfig &group, Unique &ids);
  std::string unitOf(const CheckedSection &section);
  void readCyclicData(const CheckedSection &section, ConfigFields &fields);
  bool checkCyclicData(const CheckedSection &section, std::string_view direction);
  void readMovement(const CheckedSection &section, ConfigFields &fields, std::string_view what);
  void readEncoder(const CheckedSection &section, AxisGroupConfig &group, Unique &ids);
  void readScaling(const CheckedSection &section, ConfigFields &fields, std::string_view what);
  void checkPeriod(const CheckedSection &section, const TomlNode &period, std::string_view what);
  void readLimits(const CheckedSection &section, ConfigFields &fields, bool rotary,
                  std::string_view what);
  void readRamp(const CheckedSection &section, ConfigFields &fields);
  bool addVariable(const ConfigName &name);

  ProjectConfig &config_;
  Diagnostics &diagnostics_;
  Unique busNames_{Code::ConfigDuplicateName, diagnostics_};
  Unique variableNames_{Code::ConfigDuplicateName, diagnostics_};
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_CONFIG_READER_HPP
