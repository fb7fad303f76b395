#include "drivers/can/simulation/io401.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

using Type = DataType;

// Of 1000h, beside the number of the profile.
constexpr uint32_t kProfile = 401;
constexpr uint32_t kDigitalInputs = 0x10000;
constexpr uint32_t kDigitalOutputs = 0x20000;
constexpr uint32_t kAnalogInputs = 0x40000;
constexpr uint32_t kAnalogOutputs = 0x80000;

constexpr uint16_t kInput8 = 0x6000;
constexpr uint16_t kInput16 = 0x6100;
constexpr uint16_t kOutput8 = 0x6200;
constexpr uint16_t kOutput16 = 0x6300;
constexpr uint16_t kErrorMode8 = 0x6206;
constexpr uint16_t kErrorValue8 = 0x6207;
constexpr uint16_t kAnalogInput = 0x6401;
constexpr uint16_t kAnalogOutput = 0x6411;
constexpr uint16_t kAnalogEvents = 0x6423;
constexpr uint16_t kAnalogErrorMode = 0x6443;
constexpr uint16_t kAnalogErrorValue = 0x6444;

/// An array of `count` like `row`, with its number of entries before; nothing if there are none.
void addArray(std::vector<ObjectRow> &rows, size_t count, ObjectRow row) {
  if (count == 0)
    return;
  rows.push_back(
      {.index = row.index, .type = Type::Unsigned8, .access = Access::Const, .value = count});
  for (size_t i = 1; i <= count; ++i) {
    row.sub = static_cast<uint8_t>(i);
    rows.push_back(row);
  }
}

/// A PDO of entries of an array: from the one after `before` on, as many as there are and fit.
PdoRow pdoOfArray(uint32_t cobId, uint16_t index, size_t before, size_t count, uint32_t bits) {
  const size_t entries = before < count ? std::min<size_t>(count - before, 64 / bits) : 0;
  PdoRow pdo{.cobId = entries > 0 ? cobId : cobId | 0x80000000U};
  for (size_t i = 0; i < entries; ++i)
    pdo.map[i] =
        static_cast<uint32_t>(index) << 16U | static_cast<uint32_t>(before + i + 1) << 8U | bits;
  return pdo;
}

/// Digital bytes in the first, analog values in the other three.
std::vector<PdoRow> pdosOf(uint32_t cobId, uint16_t digital, size_t bytes, uint16_t analog,
                           size_t values) {
  std::vector<PdoRow> pdos = {pdoOfArray(cobId, digital, 0, bytes, 8)};
  for (uint32_t i = 0; i < 3; ++i)
    pdos.push_back(pdoOfArray(cobId + (i + 1) * 0x100, analog, size_t{4} * i, values, 16));
  return pdos;
}

DeviceRows ioRows(const Io401Setup &setup) {
  const size_t in = setup.inputBytes;
  const size_t out = setup.outputBytes;
  const size_t analogIn = setup.analogInputs;
  const size_t analogOut = setup.analogOutputs;
  DeviceRows device;
  device.deviceType = kProfile | (in > 0 ? kDigitalInputs : 0) | (out > 0 ? kDigitalOutputs : 0) |
                      (analogIn > 0 ? kAnalogInputs : 0) | (analogOut > 0 ? kAnalogOutputs : 0);
  std::vector<ObjectRow> &rows = device.objects;
  rows = setup.more; // of several for the same object the last one counts
  const auto read = [](uint16_t index, Type type) {
    return ObjectRow{
        .index = index, .type = type, .access = Access::ReadOnly, .mapping = kInTransmit};
  };
  const auto written = [](uint16_t index, Type type) {
    return ObjectRow{.index = index, .type = type, .mapping = kInBoth};
  };
  addArray(rows, in, read(kInput8, Type::Unsigned8));
  addArray(rows, in / 2, read(kInput16, Type::Unsigned16));
  addArray(rows, out, written(kOutput8, Type::Unsigned8));
  addArray(rows, out, {.index = kErrorMode8, .type = Type::Unsigned8, .value = 0xFF});
  addArray(rows, out, {.index = kErrorValue8, .type = Type::Unsigned8});
  addArray(rows, out / 2, written(kOutput16, Type::Unsigned16));
  addArray(rows, analogIn, read(kAnalogInput, Type::Integer16));
  addArray(rows, analogOut, written(kAnalogOutput, Type::Integer16));
  if (analogIn > 0)
    rows.push_back({.index = kAnalogEvents, .type = Type::Boolean});
  addArray(rows, analogOut, {.index = kAnalogErrorMode, .type = Type::Unsigned8, .value = 1});
  addArray(rows, analogOut, {.index = kAnalogErrorValue, .type = Type::Integer32});
  device.receive = pdosOf(0x200, kOutput8, out, kAnalogOutput, analogOut);
  device.transmit = pdosOf(0x40000180, kInput8, in, kAnalogInput, analogIn);
  return device;
}

Io401Setup limited(Io401Setup setup) {
  setup.inputBytes = std::min<uint8_t>(setup.inputBytes, 8);
  setup.outputBytes = std::min<uint8_t>(setup.outputBytes, 8);
  setup.analogInputs = std::min(setup.analogInputs, Io401Setup::kMostAnalog);
  setup.analogOutputs = std::min(setup.analogOutputs, Io401Setup::kMostAnalog);
  return setup;
}

} // namespace

SimulatedIo401::SimulatedIo401(const Io401Setup &setup)
    : CanopenNode(setup.node, ioRows(limited(setup))), inputBytes_(limited(setup).inputBytes),
      outputBytes_(limited(setup).outputBytes), analogInputs_(limited(setup).analogInputs),
      analogOutputs_(limited(setup).analogOutputs), wired_(setup.wired) {}

void SimulatedIo401::put(uint16_t index, size_t place, uint64_t value) noexcept {
  if (Entry *entry = objects().find(index, static_cast<uint8_t>(place + 1)))
    entry->value = Dictionary::fitted(entry->row.type, value);
}

uint64_t SimulatedIo401::get(uint16_t index, size_t place) const noexcept {
  return objects().value(index, static_cast<uint8_t>(place + 1));
}

void SimulatedIo401::showInputs() noexcept {
  for (size_t i = 0; i < inputBytes_; ++i) {
    put(kInput8, i, inputs_ >> 8 * i & 0xFFU);
    put(kInput16, i / 2, inputs_ >> 16 * (i / 2) & 0xFFFFU);
  }
  for (size_t i = 0; i < analogInputs_; ++i)
    put(kAnalogInput, i, static_cast<uint64_t>(static_cast<int64_t>(analog_[i])));
}

void SimulatedIo401::setInput(size_t byte, uint8_t value) noexcept {
  if (byte >= inputBytes_ || (inputs_ >> 8 * byte & 0xFFU) == value)
    return;
  inputs_ = (inputs_ & ~(uint64_t{0xFF} << 8 * byte)) | uint64_t{value} << 8 * byte;
  showInputs();
  changed_ = true;
}

void SimulatedIo401::setAnalogInput(size_t channel, int16_t value) noexcept {
  if (channel >= analogInputs_ || analog_[channel] == value)
    return;
  analog_[channel] = value;
  showInputs();
  changed_ = true;
}

uint8_t SimulatedIo401::output(size_t byte) const noexcept {
  return byte < outputBytes_ ? static_cast<uint8_t>(get(kOutput8, byte)) : uint8_t{0};
}

int16_t SimulatedIo401::analogOutput(size_t channel) const noexcept {
  return channel < analogOutputs_ ? static_cast<int16_t>(get(kAnalogOutput, channel)) : int16_t{0};
}

void SimulatedIo401::onReset() noexcept {
  showInputs();
  follow();
}

/// Bytes and pairs of bytes are the same outputs.
void SimulatedIo401::onWritten(Entry &entry) noexcept {
  const size_t place = entry.row.sub - size_t{1};
  if (entry.row.sub == 0)
    return;
  if (entry.row.index == kOutput8) {
    const size_t pair = place / 2;
    put(kOutput16, pair, get(kOutput8, 2 * pair) | get(kOutput8, 2 * pair + 1) << 8U);
  } else if (entry.row.index == kOutput16) {
    put(kOutput8, 2 * place, entry.value & 0xFFU);
    put(kOutput8, 2 * place + 1, entry.value >> 8U & 0xFFU);
  }
  follow();
}

/// Wires from the outputs to the inputs.
void SimulatedIo401::follow() noexcept {
  for (size_t i = 0; wired_ && i < std::min(inputBytes_, outputBytes_); ++i)
    setInput(i, output(i));
  for (size_t i = 0; wired_ && i < std::min(analogInputs_, analogOutputs_); ++i)
    setAnalogInput(i, analogOutput(i));
}

void SimulatedIo401::makeSafe() noexcept {
  for (size_t i = 0; i < outputBytes_; ++i) {
    const uint64_t mode = get(kErrorMode8, i); // 1: the output takes the value
    put(kOutput8, i, (get(kOutput8, i) & ~mode) | (get(kErrorValue8, i) & mode));
  }
  for (size_t i = 0; i < outputBytes_ / 2U; ++i)
    put(kOutput16, i, get(kOutput8, 2 * i) | get(kOutput8, 2 * i + 1) << 8U);
  for (size_t i = 0; i < analogOutputs_; ++i)
    if (get(kAnalogErrorMode, i) != 0)
      put(kAnalogOutput, i, get(kAnalogErrorValue, i));
  follow();
}

void SimulatedIo401::onState(NmtState state) noexcept {
  if (state == NmtState::Stopped || state == NmtState::Initialising)
    makeSafe();
}

void SimulatedIo401::onConnectionLost() noexcept { makeSafe(); }

bool SimulatedIo401::triggers(const Entry &entry) const noexcept {
  return entry.row.index != kAnalogInput || objects().value(kAnalogEvents) != 0;
}

} // namespace stride::can::simulation
