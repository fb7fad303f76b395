// g_DRIVESTRUCT: the whole PLC configuration, for programs (SoftMotion V2.3 manual, section 11.2).

#include "compiler/project/config_reader.hpp"
#include "compiler/syntax/st_text.hpp"

#include <fmt/format.h>

namespace stc {

namespace {

/// A list of values that may be empty in the configuration but not in ST.
class List {
public:
  List(std::string_view name, std::string_view type) : name_(name), type_(type) {}

  void add(const std::string &value) {
    values_ += (count_ == 0 ? "" : ", ") + value;
    ++count_;
  }
  void address(const ConfigName &variable) { add(fmt::format("ADR({})", variable.text)); }

  [[nodiscard]] std::string declaration() const {
    return fmt::format("  {} : ARRAY[0..{}] OF {};\n", name_, count_ == 0 ? 0 : count_ - 1, type_);
  }
  [[nodiscard]] std::string value() const {
    return count_ == 0 ? std::string() : fmt::format(", {} := [{}]", name_, values_);
  }
  [[nodiscard]] size_t count() const { return count_; }

private:
  std::string_view name_;
  std::string_view type_;
  std::string values_;
  size_t count_ = 0;
};

} // namespace

std::string driveStruct(const ProjectConfig &config) {
  List buses("aBusInterface", "SM_DriveBasic.SMC_BUSINTERFACE_REF");
  List groups("apAxisGroup", "POINTER TO SM_DriveBasic.SMC_AXISGROUP_REF");
  List drives("apDrive", "POINTER TO SM_DriveBasic.AXIS_REF");
  List encoders("apEncoder", "POINTER TO SM_DriveBasic.SMC_ENCODER_REF");
  for (const BusConfig &bus : config.buses)
    buses.add(fmt::format("(sName := {}, sInterfaceType := {}, wAxisGroupCount := {})",
                          stringLiteral(bus.name.text), stringLiteral(bus.interfaceType),
                          bus.axisGroups));
  for (const AxisGroupConfig &group : config.axisGroups) {
    groups.address(group.name);
    for (const DriveConfig &drive : group.drives)
      drives.address(drive.name);
    for (const EncoderConfig &encoder : group.encoders)
      encoders.address(encoder.name);
  }
  return fmt::format(
      "TYPE DRIVESTRUCT :\nSTRUCT\n"
      "  wBusInterfaceCount, wAxisGroupCount, wDriveCount, wEncoderCount : WORD;\n{}{}{}{}"
      "  psBootupError : POINTER TO STRING(255);\n"
      "END_STRUCT\nEND_TYPE\n"
      "VAR_GLOBAL\n  g_DRIVESTRUCT : DRIVESTRUCT := (wBusInterfaceCount := {}, wAxisGroupCount := "
      "{}, wDriveCount := {}, wEncoderCount := {}{}{}{}{}, "
      "psBootupError := ADR(SM_DriveBasic.g_strBootupError));\nEND_VAR\n",
      buses.declaration(), groups.declaration(), drives.declaration(), encoders.declaration(),
      buses.count(), groups.count(), drives.count(), encoders.count(), buses.value(),
      groups.value(), drives.value(), encoders.value());
}

} // namespace stc
