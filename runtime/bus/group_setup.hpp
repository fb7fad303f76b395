// What a driver is told about its drive group when it is made: the PLC configuration, neutrally.
#ifndef STRIDE_RUNTIME_BUS_GROUP_SETUP_HPP
#define STRIDE_RUNTIME_BUS_GROUP_SETUP_HPP

#include "runtime/bus/driver_schema.hpp"
#include "runtime/bus/plc_schema.hpp"
#include "runtime/common/io_exchange.hpp"
#include "runtime/common/setup_parameters.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stride::bus {

using common::SetupParameter;
using common::SetupParameters;

struct DriveSetup {
  std::string name;
  uint32_t id = 0; ///< wDriveId.
  SetupParameters parameters;
};

struct EncoderSetup {
  std::string name;
  uint32_t id = 0; ///< wEncoderId.
  SetupParameters parameters;
};

/// An I/O device that is a node of the bus (IoSchema::bus).
struct IoSetup {
  std::string name;
  uint32_t inputBytes = 0;
  uint32_t outputBytes = 0;
  std::vector<uint8_t> safeOutputs; ///< Of all its outputs; none: zeros.
  SetupParameters parameters;
  /// Where its bytes are exchanged; null: nobody wants them.
  std::shared_ptr<common::IoExchange> exchange;
  size_t device = 0; ///< Its place in the configuration.
};

/// What a driver's bus is made of.
enum class BusKind : uint8_t {
  Simulated, ///< All of it is in this process, and goes by the cycles: the same bits each time.
  Real,      ///< What the configuration names.
};

/// What is kept of what passes a bus, or repeated: files; empty: nothing.
struct BusRecording {
  std::string log;    ///< Is written.
  std::string replay; ///< Such a file, which takes the place of the simulated bus.
};

/// All values that stride.toml does not give are those of the driver's schema and of
/// plc_schema.hpp.
struct GroupSetup {
  /// Without drives; `schema` must live as long as this.
  GroupSetup(const DriverSchema &driver, double cycle)
      : cycleSeconds(cycle), busParameters({plc::kBus, driver.bus}, cycle),
        parameters({plc::kAxisGroup, driver.axisGroup, driver.axisGroupTables}, cycle),
        schema(&driver) {}

  DriveSetup &addDrive(std::string drive, uint32_t id) {
    return drives.emplace_back(DriveSetup{
        std::move(drive), id,
        SetupParameters({plc::kDrive, schema->drive, schema->driveTables}, cycleSeconds)});
  }
  EncoderSetup &addEncoder(std::string encoder, uint32_t id) {
    return encoders.emplace_back(EncoderSetup{
        std::move(encoder), id,
        SetupParameters({plc::kEncoder, schema->encoder, schema->encoderTables}, cycleSeconds)});
  }

  std::string name;
  std::string bus;
  std::string interfaceType;
  BusKind kind = BusKind::Simulated;
  BusRecording recording; ///< As far as the driver can.
  /// The folder for files, in which parameters of drives may be; nothing: nobody reads files.
  std::optional<std::string> files;
  double cycleSeconds = 0; ///< Of the group's task.
  SetupParameters busParameters;
  SetupParameters parameters;
  std::vector<DriveSetup> drives;
  std::vector<EncoderSetup> encoders;
  std::vector<IoSetup> ios;
  const DriverSchema *schema;
};

} // namespace stride::bus

#endif
