// Whatever a ring says, nothing breaks, and no drive gets torque without a command.
#include "drivers/sercos/master/master.hpp"

#include "tests/unit/sercos_master/scripted_ring.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace stride::sercos::test {
namespace {

/// A good ring, whose answers become random ones of right and wrong lengths, from right and wrong
/// addresses, as soon as `noise` is set.
class NoisyRing final : public Ring {
public:
  explicit NoisyRing(uint32_t seed) : random_(seed) {
    for (uint8_t address = 1; address <= 3; ++address) {
      ScriptedDrive &drive = drives_.emplace_back(address);
      drive.feedback = words({address, 0, 0, 0});
      drive.length = 12;
    }
    for (ScriptedDrive &drive : drives_)
      good_.drives.push_back(&drive);
  }

  void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept override {
    told = sent;
    good_.cycle(sent, answers);
    if (!noise)
      return;
    answers.light = random_() % 500 != 0;
    answers.mstReturned = answers.light && random_() % 300 != 0;
    answers.mstDistorted = random_() % 7 == 0;
    if (random_() % 100 == 0)
      answers.count = random_() % 5;
    for (size_t i = 0; i < answers.count; ++i)
      disturb(answers.telegrams[i], sent);
  }
  void setLight(uint8_t) noexcept override {}
  void setBaudRate(uint8_t) noexcept override {}

  MasterTelegrams told;
  bool noise = false;

private:
  void disturb(DriveTelegram &telegram, const MasterTelegrams &sent) {
    if (random_() % 200 == 0)
      telegram.address = static_cast<uint8_t>(random_());
    telegram.distorted = random_() % 100 == 0;
    if (random_() % 200 == 0)
      telegram.length = static_cast<uint8_t>(random_() % (kMostRecordBytes + 1));
    if (random_() % 3 == 0)
      for (uint8_t &byte : telegram.data)
        byte = static_cast<uint8_t>(random_());
    // Most steps of the service channel go on.
    if (random_() % 4 != 0)
      telegram.data[0] = static_cast<uint8_t>((sent.mdtData[0] & 1) | (telegram.data[0] & 0xF8));
  }

  std::deque<ScriptedDrive> drives_;
  ScriptedRing good_;
  std::mt19937 random_;
};

void live(uint32_t seed) {
  MasterConfig config;
  config.cycle = 0.001;
  for (uint8_t address = 1; address <= 3; ++address) {
    DriveConfig &drive = config.drives.emplace_back();
    drive.address = address;
    drive.cycle = 0.001;
    drive.probeInputs = 15;
    drive.serviceTimeout = 40;
    std::vector<std::string> errors;
    drive.settings.cyclic = planCyclic({}, errors);
  }
  auto owned = std::make_unique<NoisyRing>(seed);
  NoisyRing &ring = *owned;
  Master master(config, std::move(owned));
  std::mt19937 random(seed + 1);
  int operating = 0;
  for (int cycle = 0; cycle < 3000; ++cycle) {
    master.executeStart();
    operating += master.drive(2).started() ? 1 : 0;
    ring.noise = operating > 5;
    for (size_t i = 0; i < 3; ++i) {
      bus::Message message;
      uint16_t progress = 0;
      if (master.init(i, progress, message) == bus::StartUp::Failed && random() % 4 == 0)
        for (size_t all = 0; all < 3; ++all)
          master.reset(all);
      ASSERT_TRUE(progress <= 99);
      bus::DriveCommand command;
      command.position = static_cast<uint32_t>(random());
      command.velocity = static_cast<double>(random());
      command.homing = random() % 16 == 0;
      command.errorAckn = random() % 16 == 0;
      command.capture = static_cast<uint8_t>(random() % 16);
      command.controllerMode = static_cast<uint8_t>(random() % 5);
      master.drive(i).axis().command(command); // never with torque
      bus::ParameterRequest request;
      request.kind = static_cast<bus::ParameterRequest::Kind>(random() % 3);
      request.number = static_cast<int32_t>(random() % 3 == 0 ? random() : random() % 400);
      request.form = static_cast<bus::ParameterForm>(random() % 4);
      bus::ParameterAnswer answer;
      if (master.drive(i).started() && random() % 30 == 0)
        master.drive(i).ask(request);
      (void)master.drive(i).poll(answer);
      if (random() % 200 == 0)
        master.drive(i).cancelQuestion();
    }
    master.executeEnd();
    const MasterTelegrams &told = ring.told;
    ASSERT_TRUE(told.mdtLength <= kMostMdtBytes);
    ASSERT_TRUE(told.phase <= Phase::Four);
    if (!told.mdt)
      continue;
    // Control words: of the drive that is asked, or of each at its place.
    for (size_t place = 0; place + 2 <= told.mdtLength; place += 12)
      ASSERT_TRUE((wordAt(told.mdtData, place) & 0xE000) == 0);
  }
  ASSERT_TRUE(operating > 5);
}

TEST(NoisyRing, NothingBreaksAndNothingMoves) {
  for (uint32_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    live(seed);
  }
}

} // namespace
} // namespace stride::sercos::test
