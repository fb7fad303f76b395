// Frames on a CAN bus with two drives, one of them with two axes, and an I/O device, whatever they
// are: through their start-up and in operation. No drive that nobody has switched on is told to
// operate.
#include "drivers/can/can_driver.hpp"
#include "drivers/can/io_schema.hpp"
#include "drivers/can/schema.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

namespace {

using namespace stride::can;

class BytesPort final : public Port {
public:
  BytesPort(const uint8_t *data, size_t size) : data_(data), size_(size) {}
  void beginCycle() noexcept override { inCycle_ = 0; }
  SendResult send(const Frame &frame, SendClass) noexcept override {
    // Controlwords of the plan below: node 3 has it in its first RPDO.
    if (frame.id == 0x203 && (frame.data[0] & 0x0FU) == 0x0FU)
      std::abort();
    return SendResult::Sent;
  }
  /// Two bytes for the identifier and the length, then the bytes.
  size_t receive(std::span<Received> frames) noexcept override {
    size_t count = 0;
    while (at_ + 2 <= size_ && count < frames.size() && inCycle_ < 4) {
      Frame &frame = frames[count].frame;
      frame = {};
      frame.id = static_cast<uint16_t>((data_[at_] | data_[at_ + 1] << 8) & 0x7FF);
      frame.remote = (data_[at_ + 1] & 0x80) != 0;
      const size_t wanted = data_[at_ + 1] >> 3 & 0xF;
      at_ += 2;
      frame.length = static_cast<uint8_t>(std::min({wanted, Frame::kMostBytes, size_ - at_}));
      std::copy_n(data_ + at_, frame.length, frame.data.begin());
      at_ += frame.length;
      ++count;
      ++inCycle_;
    }
    return count;
  }
  ControllerState state() const noexcept override { return ControllerState::Active; }
  PortCounters counters() const noexcept override { return {}; }
  bool atEnd() const { return at_ + 2 > size_; }

private:
  const uint8_t *data_;
  size_t size_;
  size_t at_ = 0;
  int inCycle_ = 0;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  stride::bus::GroupSetup setup(kSchema, 0.01);
  setup.addDrive("X", 3).parameters.add({"wControlType", "", 4});
  setup.addDrive("Y", 4).parameters.add({"probe_inputs", "", 15});
  setup.addDrive("Z", 4).parameters.add({"axis", "", 2});
  stride::bus::IoSetup &io = setup.ios.emplace_back();
  io.name = "Io";
  io.inputBytes = 5;
  io.outputBytes = 2;
  io.parameters = stride::bus::SetupParameters(
      {{}, stride::io::can::kSchema.parameters, stride::io::can::kSchema.tables});
  io.parameters.add({"node", "", 5});
  io.parameters.add({"analog_inputs", "", 1});
  io.exchange = std::make_shared<stride::common::IoExchange>(io.inputBytes, io.outputBytes);
  auto owned = std::make_unique<BytesPort>(data, size);
  const BytesPort *port = owned.get();
  const std::unique_ptr<stride::bus::AxisDriver> driver =
      std::make_unique<CanDriver>(setup, std::move(owned));
  stride::bus::DriveCommand command;
  command.homing = true;
  command.capture = 15;
  for (int cycle = 0; cycle < 2000 && !(port->atEnd() && cycle > 300); ++cycle) {
    driver->executeStart();
    for (size_t i = 0; i < setup.drives.size(); ++i) {
      uint16_t progress = 0;
      stride::bus::Message message;
      if (driver->init(i, progress, message) == stride::bus::StartUp::Started)
        driver->command(i, command);
      static_cast<void>(driver->status(i));
    }
    driver->executeEnd();
  }
  return 0;
}
