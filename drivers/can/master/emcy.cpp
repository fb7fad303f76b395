#include "drivers/can/master/emcy.hpp"

#include "drivers/can/master/frames.hpp"

#include <algorithm>

namespace stride::can {
namespace {

/// Codes from `first` to `last`; the narrower row stands first.
struct ErrorRow {
  uint16_t first;
  uint16_t last;
  std::string_view text;
};

constexpr std::array<ErrorRow, 44> kErrorRows = {{
    {0x0000, 0x00FF, "no error"},
    {0x1000, 0x1000, "a general error"},
    {0x2110, 0x213F, "short circuit or earth fault at the input"},
    {0x2211, 0x2214, "overcurrent inside the device"},
    {0x2220, 0x222F, "continuous overcurrent inside the device"},
    {0x2230, 0x223F, "short circuit or earth fault inside the device"},
    {0x2310, 0x231F, "continuous overcurrent at the output"},
    {0x2320, 0x233F, "short circuit or earth fault at the motor"},
    {0x2340, 0x234F, "short circuit between motor phases"},
    {0x2350, 0x2350, "overload of the motor (I2t)"},
    {0x2000, 0x2FFF, "current"},
    {0x3110, 0x3119, "overvoltage of the mains"},
    {0x3120, 0x3129, "undervoltage of the mains"},
    {0x3130, 0x313F, "a phase of the mains"},
    {0x3210, 0x321F, "overvoltage of the DC link"},
    {0x3220, 0x322F, "undervoltage of the DC link"},
    {0x3300, 0x33FF, "voltage at the output"},
    {0x3000, 0x3FFF, "voltage"},
    {0x4100, 0x41FF, "ambient temperature"},
    {0x4200, 0x42FF, "temperature of the device"},
    {0x4300, 0x43FF, "temperature of the drive"},
    {0x4000, 0x4FFF, "temperature"},
    {0x5100, 0x51FF, "supply of the device's electronics"},
    {0x5400, 0x54FF, "power stage"},
    {0x5500, 0x55FF, "memory of the device"},
    {0x5000, 0x5FFF, "hardware of the device"},
    {0x6010, 0x6010, "watchdog of the device"},
    {0x6300, 0x63FF, "parameters of the device"},
    {0x6000, 0x6FFF, "software of the device"},
    {0x7110, 0x711F, "brake chopper"},
    {0x7120, 0x712F, "motor"},
    {0x7300, 0x73FF, "sensor"},
    {0x7000, 0x7FFF, "a module of the device"},
    {0x8110, 0x811F, "the node has lost CAN frames"},
    {0x8120, 0x812F, "the node's CAN controller is error-passive"},
    {0x8130, 0x813F, "the node misses heartbeat or guarding"},
    {0x8140, 0x814F, "the node has recovered from bus-off"},
    {0x8210, 0x821F, "a PDO was too short for the node"},
    {0x8100, 0x82FF, "communication"},
    {0x8300, 0x83FF, "torque control"},
    {0x8400, 0x84FF, "velocity control"},
    {0x8500, 0x87FF, "position control (8611: following error)"},
    {0x8000, 0x8FFF, "supervision"},
    {0xFF00, 0xFFFF, "an error that its maker describes"},
}};

} // namespace

void EmcyRing::received(const Frame &frame) {
  constexpr uint8_t kShortest = 2;
  if (frame.length < kShortest)
    return;
  Emcy &emcy = ring_[count_ % kKept];
  emcy.code = static_cast<uint16_t>(readNumber(frame, 0, 2));
  emcy.errorRegister = frame.data[2];
  std::copy_n(frame.data.begin() + 3, emcy.detail.size(), emcy.detail.begin());
  code_ = emcy.code;
  ++count_;
}

bool EmcyRing::has(uint16_t code) const {
  const auto *const end = ring_.begin() + std::min<size_t>(count_, kKept);
  return std::any_of(ring_.begin(), end, [code](const Emcy &one) { return one.code == code; });
}

std::string_view errorText(uint16_t code) {
  for (const ErrorRow &row : kErrorRows)
    if (code >= row.first && code <= row.last)
      return row.text;
  return "an unknown kind of error";
}

} // namespace stride::can
