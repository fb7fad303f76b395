// Devices that are nodes of a bus: the driver of the bus does the work.

#include "drivers/can/io_schema.hpp"
#include "runtime/io/io_driver.hpp"

namespace stride::io {
namespace {

class ExchangeIo final : public IoDriver {
public:
  explicit ExchangeIo(const IoSettings &settings) : exchange_(settings.exchange) {}

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
    return true;
  }
  void write(uint32_t first, std::span<const BYTE> from) noexcept override {
    if (exchange_ != nullptr)
      exchange_->outputs.write(first, from);
  }
  void sense(uint32_t first, std::span<const BYTE> image) noexcept override {
    if (exchange_ != nullptr && exchange_->simulated.load(std::memory_order_relaxed))
      exchange_->terminals.write(first, image);
  }
  bool simulateFault(bool fault) noexcept override {
    if (exchange_ == nullptr || !exchange_->simulated.load(std::memory_order_relaxed))
      return false;
    exchange_->pulled.store(fault, std::memory_order_relaxed);
    return true;
  }

private:
  std::shared_ptr<common::IoExchange> exchange_;
};

} // namespace

namespace can {
std::unique_ptr<IoDriver> makeDriver(const IoSettings &settings) {
  return std::make_unique<ExchangeIo>(settings);
}
} // namespace can

} // namespace stride::io
