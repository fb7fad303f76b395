// The drive's end of the service channel: two bytes in a cycle, word by word. [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_SERVICE_CHANNEL_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_SERVICE_CHANNEL_HPP

#include "drivers/sercos/protocol/words.hpp"
#include "drivers/sercos/simulation/idn_list.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stride::sercos::simulation {

/// The device at the channel.
class ServiceHost {
public:
  ServiceHost() = default;
  ServiceHost(const ServiceHost &) = delete;
  ServiceHost &operator=(const ServiceHost &) = delete;
  virtual ~ServiceHost() = default;

  [[nodiscard]] virtual Phase servicePhase() const noexcept = 0;
  /// Whether an IDN can be opened, besides that it exists: a service error.
  virtual uint16_t onOpen(const IdnEntry &entry) noexcept = 0;
  /// Whether such data can be written, besides what the attribute and the limits say. Of a list,
  /// `bytes` is what it shall hold; else `value` counts.
  virtual uint16_t onWrite(IdnEntry &entry, int64_t value,
                           std::span<const uint8_t> bytes) noexcept = 0;
  /// It has been written.
  virtual void onWritten(IdnEntry &entry) noexcept = 0;
  /// It has been read to its end.
  virtual void onRead(IdnEntry &entry) noexcept = 0;
};

class ServiceChannel {
public:
  ServiceChannel(IdnList &list, ServiceHost &host);

  /// Closed, with AHS 0.
  void reset() noexcept;
  /// What the master has sent in this cycle. A step takes `busyCycles` more of them.
  void receive(uint16_t controlWord, uint16_t word, uint32_t busyCycles) noexcept;

  /// Bits 2 … 0 of the status word.
  [[nodiscard]] uint16_t statusBits() const { return status_; }
  /// The word for the AT.
  [[nodiscard]] uint16_t word() const { return word_; }
  /// The IDN that is open; null: none.
  [[nodiscard]] const IdnEntry *open() const { return entry_; }

private:
  void step(uint16_t controlWord, uint16_t word) noexcept;
  uint16_t openIdn(uint16_t word, bool end) noexcept;
  uint16_t beginReading(Element element) noexcept;
  uint16_t beginWriting(Element element) const noexcept;
  uint16_t read(bool end) noexcept;
  uint16_t write(uint16_t word, bool end) noexcept;
  [[nodiscard]] size_t expected() const noexcept;
  uint16_t store() noexcept;
  void put(uint64_t value, size_t bytes) noexcept;
  void putList(std::span<const uint8_t> bytes, size_t room) noexcept;

  IdnList &list_;
  ServiceHost &host_;
  IdnEntry *entry_ = nullptr;
  Element element_ = Element::None; ///< Under way; None: the next step begins one.
  bool writing_ = false;
  std::vector<uint8_t> buffer_; ///< Of the element under way.
  size_t length_ = 0;           ///< Bytes of it that are there …
  size_t place_ = 0;            ///< … and how many the master has had.
  uint16_t status_ = 0;
  uint16_t word_ = 0;
  uint32_t busy_ = 0; ///< Cycles until the step that is under way is carried out.
};

} // namespace stride::sercos::simulation

#endif
