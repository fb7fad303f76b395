// Process data objects: what they are made of, and when they go. [CiA 301, PDO, 1400h … 1BFFh]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_PROCESS_DATA_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_PROCESS_DATA_HPP

#include "drivers/can/port/frame.hpp"
#include "drivers/can/simulation/dictionary.hpp"
#include "drivers/can/simulation/emergency.hpp"
#include "drivers/can/simulation/node.hpp"
#include "drivers/can/simulation/sdo_server.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stride::can::simulation {

/// Objects in one PDO at most.
inline constexpr size_t kMapped = 8;

/// One PDO, as the node has it when it is new.
struct PdoRow {
  uint16_t number = 0;                 ///< From 1; 0: its place.
  uint32_t cobId = 0;                  ///< Without the node's id, which is added.
  uint8_t type = 255;                  ///< 0 … 240 with SYNC, 254 and 255 with events.
  std::array<uint32_t, kMapped> map{}; ///< Index, subindex, bits; 0 after the last one.
  bool fixed = false;                  ///< The mapping is what it is.
};

/// The rows of the dictionary for PDOs: `receive` from 1400h and 1600h on, `transmit` from 1800h
/// and 1A00h on. Parameters of at most 512 each.
void addPdoRows(std::vector<ObjectRow> &rows, std::span<const PdoRow> receive,
                std::span<const PdoRow> transmit);

class ProcessData {
public:
  /// The rows must be in the dictionary. `remotely`: TPDOs are sent when somebody asks by RTR.
  ProcessData(Dictionary &dictionary, ObjectRules &rules, Emergency &emergency,
              std::span<const PdoRow> receive, std::span<const PdoRow> transmit, bool remotely);

  /// Whether somebody may write that parameter of a PDO now.
  [[nodiscard]] Abort beforeWrite(const Entry &entry, uint64_t value, bool preOperational) const;
  static bool isParameter(uint16_t index) { return index >= 0x1400 && index < 0x1C00; }

  /// Parameters have changed, or all objects have other values.
  void configure() noexcept;
  /// The node becomes operational.
  void begin(int64_t nowNs) noexcept;
  /// It is no longer.
  void end() noexcept;

  // While it is operational:
  [[nodiscard]] bool listensTo(uint16_t id) const noexcept {
    return operational_ && (listens_[id / 64 % listens_.size()] >> id % 64 & 1U) != 0;
  }
  void receive(const Frame &frame, int64_t nowNs) noexcept;
  /// SYNC: what has been received is valid now …
  void applySynchronous() noexcept;
  /// … and what there is now is sent. `counter` of the SYNC, 0: it has none.
  void sample(uint8_t counter, int64_t nowNs) noexcept;
  /// Objects may have changed, or time has passed: what is sent by events.
  void lookForEvents(int64_t nowNs) noexcept;
  [[nodiscard]] int64_t nextNs() const noexcept;
  bool transmit(Frame &frame) noexcept;

private:
  struct Place {
    Entry *entry = nullptr; ///< Null: a gap.
    uint8_t bytes = 0;
  };

  struct Pdo {
    uint16_t place = 0; ///< Of its parameters: its number less 1.
    Entry *cobId = nullptr;
    Entry *type = nullptr;
    Entry *inhibit = nullptr;
    Entry *event = nullptr;
    Entry *start = nullptr;
    std::array<Entry *, kMapped + 1> map{};
    bool fixed = false;
    // By the parameters:
    bool exists = false;
    uint16_t id = 0;
    size_t places = 0;
    std::array<Place, kMapped> content{};
    uint8_t bytes = 0;
    // While the node is operational:
    Frame frame;          ///< Received, or to be sent.
    bool pending = false; ///< It is still to be used, or sent.
    bool seen = false;    ///< There was one.
    bool due = false;     ///< Type 0: something has changed.
    uint8_t syncs = 0;    ///< Since the last one that was sent.
    bool waits = false;   ///< For SYNC with the counter of its start.
    int64_t lastNs = 0;   ///< Of the last one.
    Frame sent;           ///< The last one by an event.

    [[nodiscard]] bool synchronous() const { return type->value <= 240; }
    [[nodiscard]] int64_t eventNs() const;
    [[nodiscard]] int64_t inhibitNs() const;
  };

  [[nodiscard]] bool transmits(const Pdo &pdo) const { return &pdo >= pdos_.data() + receivers_; }
  [[nodiscard]] const Pdo &pdoOf(uint16_t index) const;
  [[nodiscard]] Abort checkMapping(const Pdo &pdo, uint32_t mapping, Place &place) const;
  [[nodiscard]] Abort checkCobId(const Pdo &pdo, uint64_t value) const;
  [[nodiscard]] Abort checkCount(const Pdo &pdo, uint64_t count) const;
  void resolve(Pdo &pdo) noexcept;
  void apply(Pdo &pdo) noexcept;
  void build(Pdo &pdo) noexcept;
  [[nodiscard]] bool changed(const Pdo &pdo) const noexcept;
  void watch(Pdo &pdo, int64_t nowNs) noexcept;

  Dictionary &dictionary_;
  ObjectRules &rules_;
  Emergency &emergency_;
  std::vector<Pdo> pdos_; ///< Those that are received first.
  size_t receivers_;
  bool remotely_;
  bool operational_ = false;
  std::array<uint64_t, (Frame::kLastId + 1) / 64> listens_{}; ///< Bit n: to the identifier n.
};

} // namespace stride::can::simulation

#endif
