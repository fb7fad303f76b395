#ifndef STRIDE_COMPILER_CODEGEN_PLC_TABLES_HPP
#define STRIDE_COMPILER_CODEGEN_PLC_TABLES_HPP
// The PLC configuration and the I/O devices in app.cpp: tables of runtime/app/abi.h.

#include "compiler/codegen/codegen.hpp"
#include "compiler/codegen/units.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace stc::codegen {

/// A global variable of the project and its place in the state (`globals__.Drive`).
struct PlacedVariable {
  const VarSymbol *variable = nullptr;
  std::string place;
};

/// By name; null: there is none.
using FindGlobal = std::function<PlacedVariable(std::string_view name)>;

/// Writes the tables of parameters, buses, drives, encoders, axis groups and I/O devices.
class PlcTables {
public:
  PlcTables(Context &context, const AppConfig &config, FindGlobal find);

  /// Makes the tables; the numbers below are known afterwards.
  void write();

  [[nodiscard]] const std::string &text() const { return text_; }
  [[nodiscard]] size_t parameters() const { return parameterCount_; }
  [[nodiscard]] size_t drives() const { return driveCount_; }
  [[nodiscard]] size_t encoders() const { return encoderCount_; }
  [[nodiscard]] size_t groups() const { return groupCount_; }
  [[nodiscard]] size_t ioDevices() const { return ioCount_; }
  /// Layout hashes of AXIS_REF, SMC_AXISGROUP_REF and SMC_ENCODER_REF; 0: not used.
  [[nodiscard]] uint64_t axisLayout() const { return axisLayout_; }
  [[nodiscard]] uint64_t groupLayout() const { return groupLayout_; }
  [[nodiscard]] uint64_t encoderLayout() const { return encoderLayout_; }

private:
  std::string addParameters(const std::vector<ConfigParameter> &list);
  void addDrive(const AppConfig::Drive &drive);
  void addEncoder(const AppConfig::Encoder &encoder);
  void addBuses();
  void addAxisGroups();
  void addIoDevices();
  void addTable(const char *columns, const char *type, const char *name, const std::string &rows);

  Context &c_;
  const AppConfig &config_;
  FindGlobal find_;
  std::string text_;
  std::string parameters_; ///< rows of the tables
  std::string drives_;
  std::string buses_;
  std::string encoders_;
  std::string groupRows_;
  std::string ioRows_;
  std::string ioBytes_; ///< tables of safe values
  size_t parameterCount_ = 0;
  size_t driveCount_ = 0;
  size_t encoderCount_ = 0;
  size_t groupCount_ = 0;
  size_t ioCount_ = 0;
  uint64_t axisLayout_ = 0;
  uint64_t groupLayout_ = 0;
  uint64_t encoderLayout_ = 0;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_PLC_TABLES_HPP
