#include "drivers/can/plan/objects.hpp"

namespace stride::can {
namespace {

struct Known {
  Object object;
  ObjectForm form;
};

/// Besides the objects of signals: what programs write most. Signed, or written only.
constexpr std::array<Known, 33> kKnown = {{
    {{0x605A, 0}, {2, true}},  // quick stop option
    {{0x605B, 0}, {2, true}},  // shutdown option
    {{0x605C, 0}, {2, true}},  // disable operation option
    {{0x605D, 0}, {2, true}},  // halt option
    {{0x605E, 0}, {2, true}},  // fault reaction option
    {{0x6007, 0}, {2, true}},  // abort connection option
    {{0x6062, 0}, {4, true}},  // position demand
    {{0x6063, 0}, {4, true}},  // position in internal units
    {{0x606B, 0}, {4, true}},  // velocity demand
    {{0x6069, 0}, {4, true}},  // velocity sensor
    {{0x6074, 0}, {2, true}},  // torque demand
    {{0x6079, 0}, {4, false}}, // DC link voltage
    {{0x607B, 1}, {4, true}},  // range limit
    {{0x607B, 2}, {4, true}},  //
    {{0x607C, 0}, {4, true}},  // home offset
    {{0x607D, 1}, {4, true}},  // software limits
    {{0x607D, 2}, {4, true}},  //
    {{0x607E, 0}, {1, false}}, // polarity
    {{0x6081, 0}, {4, false}}, // profile velocity
    {{0x6083, 0}, {4, false}}, // profile acceleration
    {{0x6084, 0}, {4, false}}, // profile deceleration
    {{0x6085, 0}, {4, false}}, // quick stop deceleration
    {{0x6086, 0}, {2, true}},  // motion profile type
    {{0x6087, 0}, {4, false}}, // torque slope
    {{0x6098, 0}, {1, true}},  // homing method
    {{0x6099, 1}, {4, false}}, // homing speeds
    {{0x6099, 2}, {4, false}}, //
    {{0x609A, 0}, {4, false}}, // homing acceleration
    {{0x60B0, 0}, {4, true}},  // position offset
    {{0x60B2, 0}, {2, true}},  // torque offset
    {{0x60C1, 1}, {4, true}},  // interpolated position
    {{0x60C2, 1}, {1, false}}, // interpolation period: mantissa,
    {{0x60C2, 2}, {1, true}},  // exponent
}};

constexpr bool tableIsInOrder() {
  for (size_t i = 0; i < kSignalObjects.size(); ++i)
    if (kSignalObjects[i].signal != static_cast<Signal>(i))
      return false;
  return kSignalObjects.size() + 1 == kSignals;
}
static_assert(tableIsInOrder());

} // namespace

std::string_view nameOf(Signal signal) {
  static constexpr std::array<std::string_view, kSignals> kSignalNames = {
      "controlword",     "mode of operation", "target position",  "velocity offset",
      "target velocity", "target torque",     "probe function",   "statusword",
      "mode display",    "position",          "velocity",         "torque",
      "current",         "following error",   "error code",       "inputs",
      "probe status",    "probe 1 rising",    "probe 1 falling",  "probe 2 rising",
      "probe 2 falling", "second position",   "encoder position", ""};
  return kSignalNames[static_cast<size_t>(signal)];
}

ObjectForm formOf(Object object) {
  for (const SignalObject &row : kSignalObjects)
    if (row.object == object)
      return {static_cast<uint8_t>(row.bits / 8), row.isSigned};
  for (const Known &known : kKnown)
    if (known.object == object)
      return known.form;
  return {};
}

} // namespace stride::can
