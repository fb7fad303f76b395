// The master of a Sercos ring: phases 0 to 4, all telegrams, and what becomes of a ring that
// breaks.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_MASTER_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_MASTER_HPP

#include "drivers/sercos/master/ring_control.hpp"
#include "drivers/sercos/master/slave.hpp"
#include "drivers/sercos/protocol/timing.hpp"
#include "drivers/sercos/ring/ring.hpp"
#include "runtime/bus/news.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace stride::sercos {

struct MasterConfig {
  std::vector<DriveConfig> drives; ///< In the order of the axes.
  double cycle = 0.003;            ///< [s]
  uint32_t megabits = 2;           ///< [MBit/s]
  uint8_t light = 100;             ///< [%]
};

/// What has happened on the ring since the beginning.
struct MasterCounters {
  uint64_t mstLost = 0;   ///< Cycles without the own MST in phases 1 to 4.
  uint64_t atLost = 0;    ///< ATs that did not come, or came distorted, in phases 2 to 4.
  uint64_t ringFalls = 0; ///< How often the ring fell to phase 0.
};

class Master final : public RingControl {
public:
  Master(const MasterConfig &config, std::unique_ptr<Ring> ring);

  void attach(bus::DriverHost &host) { news_.attach(host); }

  /// First in a cycle: sends what the last one has prepared, and takes the answers.
  void executeStart();
  /// Last in a cycle: prepares the telegrams.
  void executeEnd();

  /// One step of a drive's start-up: that of the ring, with it. Drives for which nobody asks are
  /// left out.
  bus::StartUp init(size_t drive, uint16_t &progress, bus::Message &message);
  /// A drive begins anew: with all of them, or when the ring is down, the ring does.
  void reset(size_t drive);

  [[nodiscard]] size_t driveCount() const { return slaves_.size(); }
  [[nodiscard]] Slave &drive(size_t index) { return slaves_[index]; }
  [[nodiscard]] const Slave &drive(size_t index) const { return slaves_[index]; }
  [[nodiscard]] const MasterCounters &counters() const { return counters_; }
  [[nodiscard]] Ring &ring() { return *ring_; }
  /// Why the ring is down, for people; nothing set: it is not.
  void problem(bus::Message &text) const;

  [[nodiscard]] Phase actualPhase() const override { return phase_; }
  [[nodiscard]] Phase commandedPhase() const override { return commanded_; }
  void commandPhase(Phase phase) override;
  [[nodiscard]] uint32_t baudRate() const override { return config_.megabits; }
  [[nodiscard]] uint8_t opticalPower() const override { return light_; }
  void setOpticalPower(uint8_t percent) override;
  [[nodiscard]] uint32_t cycleTime() const override { return cycleUs_; }

private:
  void restart();
  void fall(const bus::Message &reason);
  void fallBy(size_t drive, std::string_view what);
  void enter(Phase phase);
  void judgeMst();
  void phaseZero();
  void phaseOne(uint8_t answering);
  void judgeConfigured();
  void askPhaseOne();
  void phaseTwo(uint8_t answering);
  void askPhaseTwo();
  void takeAt(size_t drive);
  void followDrives();
  void planTimes();
  void enterNext();
  [[nodiscard]] size_t answersOf(uint8_t address, const DriveTelegram *&one) const;
  [[nodiscard]] bool isConfigured(uint8_t address) const;
  [[nodiscard]] size_t nextWanted(size_t from) const;
  [[nodiscard]] uint8_t addressOf(size_t drive) const { return slaves_[drive].config().address; }
  void fillMdt();

  MasterConfig config_;
  std::unique_ptr<Ring> ring_;
  bus::News news_;
  std::vector<Slave> slaves_;
  std::vector<bool> wanted_; ///< Somebody asks for its start-up.
  std::vector<bool> reset_;  ///< In this cycle.
  std::vector<DriveTiming> timings_;
  std::vector<DriveSlot> slots_;
  RingTiming timing_;
  MasterTelegrams sent_;
  RingAnswers answers_;
  MasterCounters counters_;
  bus::Message reason_; ///< Why the ring is down.
  uint32_t cycleUs_;
  uint32_t waited_ = 0;  ///< In this phase. [cycles]
  uint32_t patience_;    ///< For the ring to close, and for ATs after a phase. [cycles]
  uint32_t returns_ = 0; ///< Of the MST in phase 0, one after the other.
  uint32_t mstMisses_ = 0;
  uint32_t tries_ = 0; ///< Phase 1: of this drive.
  size_t asked_ = 0;   ///< Phases 1 and 2: which drive; their number: none any more.
  uint16_t other_ = 0; ///< Phase 1, after the drives: the address that is asked.
  uint8_t light_;
  Phase phase_ = Phase::Zero;
  Phase commanded_ = Phase::Four;
  bool down_ = false; ///< The ring has fallen, and waits for a reset.
};

} // namespace stride::sercos

#endif
