// `device = "CAN"`: an I/O device of CiA 401, a node of an axis group on CAN.
#ifndef STRIDE_DRIVERS_CAN_IO_SCHEMA_HPP
#define STRIDE_DRIVERS_CAN_IO_SCHEMA_HPP

#include "drivers/can/schema.hpp"
#include "runtime/io/io_schema.hpp"

#include <array>

namespace stride::io::can {

namespace rows = stride::can::rows;

inline constexpr std::array kParameters = {
    common::text("axis_group").needed().says("the axis group on CAN whose bus it is at"),
    common::whole("node", 1, 127).needed().says("its node id"),
    common::whole("analog_inputs", 0, 12)
        .defaultsTo(0)
        .says("analog inputs of 16 bits (6401h): the last bytes of `inputs`"),
    common::whole("analog_outputs", 0, 12)
        .defaultsTo(0)
        .says("analog outputs of 16 bits (6411h): the last bytes of `outputs`"),
    common::whole("digital_inputs", 0, 8, "bytes")
        .says("bytes of digital inputs (6000h): the first ones of `inputs`; default: what analog "
              "inputs leave"),
    common::whole("digital_outputs", 0, 8, "bytes")
        .says("bytes of digital outputs (6200h): the first ones of `outputs`; default: what "
              "analog outputs leave"),
    common::choice("when", rows::kWhens)
        .defaultsTo(stride::can::kAtSync)
        .says("whether inputs and outputs are sent in every cycle, or when something changes and "
              "every 100 ms"),
    common::duration("inhibit")
        .defaultsTo(0)
        .onlyWith("when", stride::can::kByEvent)
        .says("shortest time between two PDOs with inputs, in steps of 100 µs"),
    common::choice("reset", rows::kResets)
        .defaultsTo(stride::can::kResetCommunication)
        .says("what it is told by NMT when its start-up begins"),
    common::duration("guard").says(
        "node guarding with this period instead of a heartbeat, for devices without 1017h"),
    common::choice("lss", rows::kLss)
        .defaultsTo(stride::can::kLssNone)
        .says("before its start-up it is found by its `identity` and given its node id, as a drive "
              "on CAN"),
    common::whole("pdo_timeout", 1, 1000, "cycles")
        .defaultsTo(3)
        .onlyWith("when", stride::can::kAtSync)
        .says("without its PDOs until the device is lost"),
    rows::list("startup").says("objects that are written when it starts, as of a drive on CAN"),
    common::flag("wired").defaultsTo(0).says(
        "in a simulation its inputs are connected with its outputs"),
};

inline constexpr std::array kTables = {
    common::ParameterTable{"identity", "the identity of an I/O device", rows::kIdentity}};

inline constexpr IoSchema kSchema = {
    .name = "CAN", .external = true, .parameters = kParameters, .tables = kTables, .bus = "CAN"};

} // namespace stride::io::can

#endif
