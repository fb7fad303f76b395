// A CAN bus within the process, in virtual time and deterministic to the bit: frames take the time
// that their bits take, and who sends next is decided bit by bit as on a wire.
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_SIMULATED_BUS_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_SIMULATED_BUS_HPP

#include "drivers/can/port/port.hpp"
#include "drivers/can/simulation/controller.hpp"
#include "drivers/can/simulation/faults.hpp"
#include "drivers/can/simulation/node.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace stride::can::simulation {

class SimulatedPort;

/// One of those at the bus: a master's port or a node. Numbered in the order of being attached.
using Station = size_t;

struct BusSetup {
  uint32_t bitRate = 1'000'000; ///< [bit/s]
  int64_t cycleNs = 1'000'000;  ///< By which beginCycle of a port moves its time on. [ns]
  int64_t programNs = 0;        ///< After receive a port's frames are sent so much later. [ns]
  size_t sendQueue = 10;        ///< Frames that a port's queue holds.
  size_t receiveQueue = 278;    ///< Frames that a port keeps until they are taken.
  int64_t restartNs = 0;        ///< A port's bus-off ends after this; 0: by restart. [ns]
  uint64_t seed = 1;            ///< Of faults by chance.
};

/// Who wants to see what has been on the wire, as a recorder does.
class Tap {
public:
  Tap() = default;
  Tap(const Tap &) = delete;
  Tap &operator=(const Tap &) = delete;
  virtual ~Tap() = default;
  /// The frame was whole at `endNs`.
  virtual void seen(const Frame &frame, int64_t endNs, Station sender) noexcept = 0;
};

/// What there has been since the beginning.
struct BusCounters {
  uint64_t frames = 0;     ///< Whole ones.
  uint64_t bits = 0;       ///< Of frames, whole or not, and of errors.
  uint64_t collisions = 0; ///< Two stations sent the same identifier with different bytes.
  uint64_t errors = 0;     ///< Frames that were not whole.
};

/// The bus has one clock. A port's beginCycle moves it to the time of that port, unless another
/// port has brought it there already. What a port sends is in its queue at the port's time; a node
/// answers in the instant in which it has received, or `reactionNs` later. From one thread.
class SimulatedBus {
public:
  explicit SimulatedBus(const BusSetup &setup);
  ~SimulatedBus();
  SimulatedBus(const SimulatedBus &) = delete;
  SimulatedBus &operator=(const SimulatedBus &) = delete;

  /// One more port for a master. It lives as long as the bus. Not while the bus runs.
  Station addPort();
  [[nodiscard]] Port &port(Station station);

  /// One more node, whose supply is switched on now. It must live as long as the bus. Not while
  /// the bus runs.
  Station attach(Node &node, int64_t reactionNs = 0);

  /// Moves the clock on. For tests; otherwise ports do.
  void runUntil(int64_t timeNs) noexcept;
  [[nodiscard]] int64_t nowNs() const { return now_; }
  [[nodiscard]] int64_t bitsNs(uint32_t bits) const;

  [[nodiscard]] Faults &faults() { return faults_; }
  /// Cuts the cable: stations with the same number of a piece hear each other; all begin in 0.
  void setPiece(Station station, uint8_t piece);
  /// The supply of a node, or whether the interface of a port is up.
  void setPower(Station station, bool on);
  void forceBusOff(Station station);
  /// Ends a bus-off.
  void restart(Station station);

  [[nodiscard]] ControllerState state(Station station) const;
  [[nodiscard]] const BusCounters &counters() const { return counters_; }
  void setTap(Tap *tap) { tap_ = tap; }

private:
  friend class SimulatedPort;

  struct Member {
    Node *node = nullptr;
    SimulatedPort *port = nullptr;
    Controller controller;
    Frame mailbox;
    bool full = false;   ///< There is a frame in the mailbox …
    int64_t readyNs = 0; ///< … which may be sent from then on.
    int64_t reactionNs = 0;
    int64_t recoverNs = kNever; ///< Its bus-off ends.
    int64_t timerNs = kNever;   ///< The node has something to do.
    uint8_t piece = 0;
    bool powered = true;
    bool sending = false; ///< What is on its piece of the wire just now.
    [[nodiscard]] bool takesPart() const { return powered && !controller.off(); }
  };

  enum class Outcome : uint8_t { Whole, Disturbed, NotAcknowledged };

  /// A piece of the wire.
  struct Wire {
    int64_t idleNs = 0;     ///< The next frame may begin then.
    int64_t endNs = kNever; ///< What is on it ends then; kNever: nothing is.
    Outcome outcome = Outcome::Whole;
    Frame frame;
    FaultChoice choice;
    Station sender = 0;
  };

  struct Late {
    Frame frame;
    int64_t timeNs = kNever;
    Station sender = 0;
    uint8_t piece = 0;
  };

  struct Next {
    int64_t timeNs = kNever;
    enum class What : uint8_t { End, Late, Recover, Timer, Start } what = What::End;
    size_t which = 0;
    void consider(int64_t candidate, What kind, size_t index) {
      if (candidate < timeNs || (candidate == timeNs && kind < what))
        *this = {candidate, kind, index};
    }
  };

  [[nodiscard]] Next next() const noexcept;
  [[nodiscard]] int64_t startNs(size_t piece) const noexcept;
  [[nodiscard]] bool heard(const Member &sender) const noexcept;
  [[nodiscard]] bool mayStart(const Member &member, size_t piece) const noexcept;
  void handle(const Next &event) noexcept;
  void start(size_t piece) noexcept;
  void collide(Wire &wire, size_t piece, Station winner, const Frame &other) noexcept;
  void finish(size_t piece) noexcept;
  void failed(size_t piece, bool acknowledged) noexcept;
  void deliver(const Frame &frame, Station sender, uint8_t piece) noexcept;
  void deliverLate(size_t which) noexcept;
  void served(Station station) noexcept;
  void fill(Station station) noexcept;
  void recover(Station station) noexcept;
  void note(Member &member) noexcept;

  static constexpr size_t kLate = 64;

  BusSetup setup_;
  int64_t now_ = 0;
  std::vector<Member> members_;
  std::vector<Wire> wires_; ///< By the number of the piece; only those in use.
  std::vector<std::unique_ptr<SimulatedPort>> ports_;
  std::array<Late, kLate> late_{};
  Faults faults_;
  BusCounters counters_;
  Tap *tap_ = nullptr;
};

} // namespace stride::can::simulation

#endif
