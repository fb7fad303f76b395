// What compiler and runtime know of a driver before there is one. Data, and a function on data.
#ifndef STRIDE_RUNTIME_BUS_DRIVER_SCHEMA_HPP
#define STRIDE_RUNTIME_BUS_DRIVER_SCHEMA_HPP

#include "runtime/bus/group_check.hpp"
#include "runtime/common/parameter.hpp"

#include <span>
#include <string_view>

namespace stride::bus {

/// A variable that driver and program share about a drive (AXIS_REF.pMS leads there), or about an
/// axis group.
struct SharedData {
  std::string_view type = {}; ///< In ST, with its library; empty: there is none.
  /// There is one for each drive with this table in stride.toml; one for each axis group.
  std::string_view table = {};
  std::string_view suffix = {}; ///< Of its name, after that of the drive or the group.
  std::string_view what = {};   ///< For messages: "simulation of drive".
};

struct GroupSetup;

struct DriverSchema {
  std::string_view name;          ///< The first word of InterfaceType.
  std::string_view interfaceType; ///< An InterfaceType of it, for messages.
  SharedData driveData = {};
  SharedData groupData = {}; ///< See AxisDriver::bindGroupData.
  /// The bus has a SYNC every dwCycle: it starts the task on bSync of its axis group (waitSync).
  bool givesSync = false;
  bool records = false; ///< What passes the bus can be kept and repeated (GroupSetup::recording).
  // Parameters of its own, besides those of plc_schema.hpp.
  std::span<const common::Parameter> bus = {};
  std::span<const common::Parameter> axisGroup = {};
  std::span<const common::Parameter> drive = {};
  std::span<const common::Parameter> encoder = {};
  // Tables below, by names of their own.
  std::span<const common::ParameterTable> axisGroupTables = {};
  std::span<const common::ParameterTable> driveTables = {};
  std::span<const common::ParameterTable> encoderTables = {};
  /// Appends what is to be said of a group that `stride check` has found in order so far; null:
  /// nothing. A function of its arguments only, in a library that the compiler links.
  void (*check)(const GroupSetup &setup, GroupFindings &findings) = nullptr;
  /// Says what is exchanged with the drives in each cycle, and what of the bus that takes; null: it
  /// has nothing to say. As `check`.
  GroupPlanText (*plan)(const GroupSetup &setup) = nullptr;
};

} // namespace stride::bus

#endif
