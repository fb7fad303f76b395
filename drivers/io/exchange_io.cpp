// Devices that are nodes of a bus: the driver of the bus does the work.

#include "drivers/can/io_schema.hpp"
#include "runtime/io/io_driver.hpp"

#include <algorithm>
#include <array>

namespace stride::io {
namespace {

/// How many of the bytes of inputs are digital: analog ones are the last.
size_t digitalBytes(const IoSettings &settings) {
  const auto analog = 2 * static_cast<size_t>(settings.parameters.number("analog_inputs"));
  return settings.inputBytes - std::min<size_t>(analog, settings.inputBytes);
}

class ExchangeIo final : public IoDriver {
public:
  explicit ExchangeIo(const IoSettings &settings)
      : exchange_(settings.exchange), digital_(digitalBytes(settings)),
        given_(settings.inputBytes) {}

  bool works(int64_t) noexcept override {
    return exchange_ != nullptr && exchange_->works.load(std::memory_order_acquire);
  }
  bool starts() noexcept override {
    return exchange_ != nullptr && !exchange_->begun.load(std::memory_order_relaxed);
  }
  bool read(uint32_t first, std::span<BYTE> to) noexcept override {
    if (exchange_ == nullptr)
      return false;
    exchange_->inputs.read(first, to);
    given_.write(first, to);
    return true;
  }
  void write(uint32_t first, std::span<const BYTE> from) noexcept override {
    if (exchange_ != nullptr)
      exchange_->outputs.write(first, from);
  }
  /// What differs from what was given has been written by somebody. The rest is as old as the way
  /// over the bus is long: taken as written, it would undo what is still on that way.
  void sense(uint32_t first, std::span<const BYTE> image) noexcept override {
    if (exchange_ == nullptr || !exchange_->simulated.load(std::memory_order_relaxed))
      return;
    for (size_t at = 0; at < image.size();) {
      const size_t place = first + at;
      const bool digital = place < digital_;
      const bool pair = !digital && (place - digital_) % 2 == 0 && at + 1 < image.size();
      const size_t count = pair ? 2 : 1;
      senseValue(place, image.subspan(at, count), digital);
      at += count;
    }
  }
  bool simulateFault(bool fault) noexcept override {
    if (exchange_ == nullptr || !exchange_->simulated.load(std::memory_order_relaxed))
      return false;
    exchange_->pulled.store(fault, std::memory_order_relaxed);
    return true;
  }

private:
  /// Of digital inputs each bit is one of its own, analog ones are values as a whole.
  void senseValue(size_t place, std::span<const BYTE> image, bool digital) noexcept {
    std::array<BYTE, 2> given{};
    given_.read(place, std::span(given).first(image.size()));
    if (std::equal(image.begin(), image.end(), given.begin()))
      return;
    std::array<BYTE, 2> now{};
    std::copy(image.begin(), image.end(), now.begin());
    if (digital) {
      std::array<BYTE, 1> there{};
      exchange_->terminals.read(place, there);
      const auto written = static_cast<BYTE>(now[0] ^ given[0]);
      now[0] = static_cast<BYTE>((there[0] & ~written) | (now[0] & written));
    }
    exchange_->terminals.write(place, std::span(now).first(image.size()));
  }

  std::shared_ptr<common::IoExchange> exchange_;
  size_t digital_;
  common::ExchangedBytes given_; ///< What the last read of each byte gave.
};

} // namespace

namespace can {
std::unique_ptr<IoDriver> makeDriver(const IoSettings &settings) {
  return std::make_unique<ExchangeIo>(settings);
}
} // namespace can

} // namespace stride::io
