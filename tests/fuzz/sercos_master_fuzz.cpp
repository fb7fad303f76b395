// A master on a ring that spoils the answers as the input says, from the first telegram on: nothing
// crashes, phases go up one by one or down to 0, telegrams keep their bounds, and no drive is told
// to have torque, for which nobody asks here.
#include "drivers/sercos/master/master.hpp"
#include "drivers/sercos/simulation/simulated_drive.hpp"
#include "drivers/sercos/simulation/simulated_ring.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace stride::sercos;
namespace bus = stride::bus;

constexpr std::array<uint8_t, 2> kAddresses = {3, 7};

/// What happens to the answers of one cycle.
struct Fault {
  uint8_t after = 0; ///< Cycles since the one before.
  uint8_t kind = 0;
  uint8_t which = 0; ///< Telegram.
  uint8_t place = 0; ///< Byte.
  uint8_t value = 0;
};

void spoil(const Fault &fault, RingAnswers &answers) {
  DriveTelegram &at = answers.telegrams[answers.count == 0 ? 0 : fault.which % answers.count];
  switch (fault.kind % 8) {
  case 0:
    at.data[fault.place % at.data.size()] ^= fault.value;
    break;
  case 1:
    at.length = static_cast<uint8_t>(fault.value % (kMostRecordBytes + 1));
    break;
  case 2:
    at.address = fault.value;
    break;
  case 3:
    at.distorted = true;
    break;
  case 4:
    answers.count = fault.value % (answers.count + 1);
    break;
  case 5: // twice
    if (answers.count > 0 && answers.count < kMostAnswers)
      answers.telegrams[answers.count++] = at;
    break;
  case 6:
    answers.mstReturned = false;
    break;
  default:
    answers.light = (fault.value & 1U) != 0;
    answers.mstDistorted = true;
    break;
  }
}

/// Judges what is sent, and spoils what comes back.
class HostileRing final : public Ring {
public:
  explicit HostileRing(simulation::SimulatedRing &ring) : ring_(ring) {}

  void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept override {
    judge(sent);
    ring_.cycle(sent, answers);
    if (fault != nullptr)
      spoil(*fault, answers);
  }
  void setLight(uint8_t percent) noexcept override { ring_.setLight(percent); }
  void setBaudRate(uint8_t megabits) noexcept override { ring_.setBaudRate(megabits); }

  const Fault *fault = nullptr; ///< Of this cycle.

private:
  void judge(const MasterTelegrams &sent) {
    const auto phase = static_cast<unsigned>(sent.phase);
    if (sent.mst && (phase > 4 || (phase != 0 && phase != before_ && phase != before_ + 1)))
      std::abort();
    if (sent.mdt && (sent.mdtLength > kMostMdtBytes || sent.mdtLength < kHeadBytes))
      std::abort();
    // The MDT has the form of the phase before; its first word is that of a control word there,
    // too.
    if (sent.mdt && (wordAt(sent.mdtData, 0) >> 14U) == 3)
      std::abort();
    if (sent.mst)
      before_ = phase;
  }

  simulation::SimulatedRing &ring_;
  unsigned before_ = 0;
};

class Scene {
public:
  Scene() {
    MasterConfig config;
    config.cycle = 0.002;
    config.megabits = 4;
    for (const uint8_t address : kAddresses) {
      simulation::DriveSetup setup;
      setup.device.address = address;
      setup.drive.mechanics.cycle = config.cycle;
      drives_.push_back(std::make_unique<simulation::SimulatedDrive>(setup));
      ring_.attach(*drives_.back());
      DriveConfig &added = config.drives.emplace_back();
      added.address = address;
      added.cycle = config.cycle;
      CyclicWish wish;
      wish.controlType = 4;
      std::vector<std::string> errors;
      added.settings.cyclic = planCyclic(wish, errors);
    }
    ring_.setBaudRate(4);
    auto hostile = std::make_unique<HostileRing>(ring_);
    hostile_ = hostile.get();
    master_ = std::make_unique<Master>(config, std::move(hostile));
  }

  void cycle(const Fault *fault) {
    hostile_->fault = fault;
    master_->executeStart();
    for (size_t i = 0; i < kAddresses.size(); ++i)
      if (results_[i] == bus::StartUp::Busy) {
        bus::Message message;
        uint16_t progress = 0;
        results_[i] = master_->init(i, progress, message);
        if (progress > 99 && results_[i] == bus::StartUp::Busy)
          std::abort();
      }
    master_->executeEnd();
  }
  [[nodiscard]] bool started() const {
    return results_[0] == bus::StartUp::Started && results_[1] == bus::StartUp::Started;
  }
  void reset() {
    for (size_t i = 0; i < kAddresses.size(); ++i) {
      master_->reset(i);
      results_[i] = bus::StartUp::Busy;
    }
  }

private:
  simulation::SimulatedRing ring_;
  std::vector<std::unique_ptr<simulation::SimulatedDrive>> drives_;
  HostileRing *hostile_ = nullptr;
  std::unique_ptr<Master> master_;
  std::array<bus::StartUp, kAddresses.size()> results_{bus::StartUp::Busy, bus::StartUp::Busy};
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  constexpr size_t kFault = 5;
  constexpr size_t kMostFaults = 64;
  constexpr int kMostCycles = 4000; // of a run-up without faults, and many more than it takes
  Scene scene;
  for (size_t i = 0; size >= kFault && i < kMostFaults; ++i, data += kFault, size -= kFault) {
    const Fault fault{data[0], data[1], data[2], data[3], data[4]};
    for (unsigned wait = fault.after; wait > 0; --wait)
      scene.cycle(nullptr);
    scene.cycle(&fault);
    if ((fault.kind & 0x80U) != 0)
      scene.reset();
  }
  // Whatever there was: a reset on a sound ring starts all of them.
  scene.reset();
  for (int i = 0; i < kMostCycles && !scene.started(); ++i)
    scene.cycle(nullptr);
  if (!scene.started())
    std::abort();
  return 0;
}
