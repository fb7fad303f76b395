// Axes of a program on a simulated ring, all layers in between: blocks, axes, drive group, driver,
// master, drives. And a judge of all that travels.
#ifndef STRIDE_TESTS_UNIT_SERCOS_TOGETHER_STACK_SCENE_HPP
#define STRIDE_TESTS_UNIT_SERCOS_TOGETHER_STACK_SCENE_HPP

#include "drivers/sercos/schema.hpp"
#include "drivers/sercos/sercos_driver.hpp"
#include "drivers/sercos/simulated_network.hpp"
#include "runtime/bus/drive_group.hpp"
#include "tests/support/fresh.hpp"
#include "tests/support/stack_axis.hpp"
#include "tests/unit/sercos_together/ring_judge.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stride::sercos {

using test::StackAxis;

/// The simulated ring, whose answers may be damaged on their way.
class JudgedRing final : public Ring {
public:
  JudgedRing(const bus::GroupSetup &setup, RingJudge &judge) : network(setup), judge_(judge) {
    for (size_t i = 0; i < setup.drives.size(); ++i)
      judge_.watch(network.drive(i));
  }

  void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept override {
    network.cycle(sent, answers);
    if (damage)
      damage(answers);
    judge_.cycle(sent, answers);
  }
  void setLight(uint8_t percent) noexcept override { network.setLight(percent); }
  void setBaudRate(uint8_t megabits) noexcept override { network.setBaudRate(megabits); }

  SimulatedNetwork network;
  std::function<void(RingAnswers &)> damage;

private:
  RingJudge &judge_;
};

class NobodyListens final : public bus::DriverHost {
public:
  void raise(bus::BusEvent /*event*/) noexcept override {}
  void say(const bus::Message & /*news*/) noexcept override {}
};

/// `limit`: the largest way of a cycle. [inc]
struct Stack {
  explicit Stack(double cycle = 0.002, double limit = StackAxis::kVelocity)
      : setup(kSchema, cycle),
        judge(static_cast<int64_t>(limit * cycle * StackAxis::kIncrements) + 2,
              static_cast<int64_t>(StackAxis::kAcceleration * cycle * cycle *
                                   StackAxis::kIncrements)) {}

  bus::SetupParameters &add(uint32_t id) {
    bus::SetupParameters &drive = setup.addDrive("D" + std::to_string(id), id).parameters;
    drive.add({"iMovementType", "", 1});
    drive.add({"dwRatioTechUnitsDenom", "", static_cast<double>(StackAxis::kIncrements)});
    axes.push_back(std::make_unique<StackAxis>());
    axes.back()->axis.wDriveId = static_cast<uint16_t>(id);
    axes.back()->axis.iMovementType = 1;
    return drive;
  }

  void make() {
    auto judged = std::make_unique<JudgedRing>(setup, judge);
    ring = judged.get();
    auto made = std::make_unique<SercosDriver>(setup, std::move(judged));
    driver = made.get();
    driver->attach(host);
    std::vector<axis::AxisRef *> refs;
    for (const auto &one : axes)
      refs.push_back(&one->axis);
    group = std::make_unique<bus::DriveGroup>(std::move(made), groupRef, refs, setup.cycleSeconds);
    for (size_t i = 0; i < axes.size(); ++i) {
      simulation::IdnList &list = drive(i).list();
      list.at(idns::kHomingVelocity).value = 60'000;
      list.at(idns::kHomingAcceleration).value = 2'000'000;
      list.at(idns::kAcceleration).value = 4'000'000;
      list.at(idns::kHomingParameter).value = 0x40; // no index pulse
    }
  }
  [[nodiscard]] simulation::SimulatedDrive &drive(size_t index) {
    return ring->network.drive(index);
  }

  void cycle() {
    group->executeStart();
    for (const auto &one : axes)
      one->run(ctx);
    if (resetsGroup && cycles % 50 == 0 && wantsReset())
      ++groupRef.udiResetsAsked;
    group->executeEnd();
    ++cycles;
    ++ctx.cycle;
  }
  /// As docs/sercos.md says: after a fall, and after a start-up that has failed.
  [[nodiscard]] bool wantsReset() const {
    bool wants = groupRef.wState >= 1000;
    for (const auto &one : axes)
      wants = wants || (groupRef.wState == axis::kNormalOperation && one->stopped > 100 &&
                        one->axis.bCommunication == 0);
    return wants;
  }
  /// Until all have made so many motions.
  bool moveAll(int motions, int most) {
    for (const auto &one : axes)
      one->done = 0;
    const auto moved = [&] {
      for (const auto &one : axes)
        if (one->done < motions)
          return false;
      return true;
    };
    for (int i = 0; i < most && !moved(); ++i)
      cycle();
    return moved();
  }

  Ctx ctx{};
  bus::GroupSetup setup;
  RingJudge judge;
  NobodyListens host;
  bus::AxisGroupRef groupRef = test::fresh<bus::AxisGroupRef>();
  std::vector<std::unique_ptr<StackAxis>> axes;
  JudgedRing *ring = nullptr; ///< The driver's.
  SercosDriver *driver = nullptr;
  std::unique_ptr<bus::DriveGroup> group;
  bool resetsGroup = true;
  int cycles = 0;
};

} // namespace stride::sercos

#endif
