// Any bytes as telegrams for simulated Sercos devices, from the start or after a run-up: nothing
// crashes, and a drive has torque only in phase 4 after control words that ask for it.
#include "drivers/sercos/simulation/simulated_drive.hpp"
#include "drivers/sercos/simulation/simulated_io.hpp"
#include "drivers/sercos/simulation/simulated_ring.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

namespace {

using namespace stride::sercos;
using simulation::SimulatedDrive;
using simulation::SimulatedRing;

constexpr uint8_t kDrive = 3;

struct Scene {
  SimulatedDrive drive;
  simulation::SimulatedIo io{{.device = {.address = 2}}};
  SimulatedRing ring;
  MasterTelegrams sent;
  RingAnswers answers;
  uint16_t word = 0; ///< The control word of the run-up.

  explicit Scene(const simulation::DriveSetup &setup) : drive(setup) {
    ring.attach(drive);
    ring.attach(io);
  }

  void cycle(unsigned times = 1) {
    for (; times > 0; --times)
      ring.cycle(sent, answers);
  }
  void step(unsigned bits, uint16_t info) {
    word = static_cast<uint16_t>((~word & 1U) | bits);
    putWord(sent.mdtData, 0, word);
    putWord(sent.mdtData, 2, info);
    cycle(2);
  }
  void command(uint16_t number) {
    step(0x0E, number); // element 1, write, end
    step(0x3E, 3);      // element 7
    cycle(6);
    step(0x3E, 0);
  }
  void runUp() {
    sent.mdt = true;
    sent.mdtAddress = kDrive;
    sent.mdtLength = 4;
    for (const Phase phase : {Phase::One, Phase::Two}) {
      sent.phase = phase;
      cycle(3);
    }
    constexpr std::pair<uint16_t, int64_t> kTimes[] = {
        {1, 1000}, {2, 1000}, {6, 13}, {89, 100}, {7, 700}, {8, 1000}, {9, 1}, {10, 8}, {15, 4}};
    for (const auto &[number, value] : kTimes) {
      drive.list().at(number).value = value;
      drive.list().at(number).given = true;
    }
    command(127);
    sent.phase = Phase::Three;
    sent.mdtAddress = kBroadcast;
    sent.mdtLength = 8;
    cycle(3);
    drive.list().at(32).given = true;
    command(128);
    sent.phase = Phase::Four;
    cycle(3);
    if (drive.phase() != Phase::Four)
      std::abort();
  }
};

simulation::DriveSetup setupOf(uint8_t kind) {
  simulation::DriveSetup setup;
  setup.device.address = kDrive;
  setup.drive.mechanics.cycle = 0.001;
  setup.drive.switchCycles = 1;
  setup.drive.probeInputs = 15;
  setup.drive.homing = {false, 20000, 3000, 1'000'000};
  setup.drive.index = {true, 100, 4096};
  if ((kind & 2U) != 0) {
    setup.drive.mechanics.model = stride::dummy::Model::SecondOrder;
    setup.drive.mechanics.inertia = 1e-5;
    setup.drive.mechanics.torqueLimit = 5;
    setup.drive.mechanics.substeps = 4;
  }
  return setup;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  Scene scene(setupOf(data[0]));
  if ((data[0] & 1U) != 0)
    scene.runUp();
  ++data, --size;
  bool before = scene.drive.hasTorque();
  constexpr size_t kCycle = 11; // flags, address, length, control word, word, cyclic data
  for (; size >= kCycle; data += kCycle, size -= kCycle) {
    MasterTelegrams &sent = scene.sent;
    sent.mst = (data[0] & 0x08U) == 0;
    sent.mdt = (data[0] & 0x10U) == 0;
    sent.phase = static_cast<Phase>(data[0] & 7U);
    sent.periodNs = (data[0] & 0x20U) != 0 ? 1 + data[1] * int64_t{40'000} : 1'000'000;
    sent.mdtAddress = (data[0] & 0x40U) != 0 ? data[1] : kBroadcast;
    sent.mdtLength = (data[0] & 0x80U) != 0 ? data[2] : 8;
    for (size_t i = 0; i < 8; ++i)
      sent.mdtData[i] = data[3 + i];
    scene.cycle();
    const uint16_t valid = scene.drive.controlWord(); // of this cycle's MDT
    const bool now = scene.drive.hasTorque();
    if (now && !before && ((valid & control::kOn) == 0 || (valid & control::kEnable) == 0))
      std::abort();
    before = now;
    for (const DriveTelegram &at : scene.answers.ats())
      if (at.length < kHeadBytes || at.length > kMostRecordBytes)
        std::abort();
  }
  return 0;
}
