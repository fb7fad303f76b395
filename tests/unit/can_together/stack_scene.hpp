// Axes of a program on simulated CAN drives, all layers in between: blocks, axes, drive group,
// driver, bus, nodes. And somebody else at the same bus.
#ifndef STRIDE_TESTS_UNIT_CAN_TOGETHER_STACK_SCENE_HPP
#define STRIDE_TESTS_UNIT_CAN_TOGETHER_STACK_SCENE_HPP

#include "drivers/can/can_driver.hpp"
#include "drivers/can/schema.hpp"
#include "drivers/can/simulated_network.hpp"
#include "runtime/app/ctx.h"
#include "runtime/bus/drive_group.hpp"
#include "tests/support/fresh.hpp"
#include "tests/support/stack_axis.hpp"
#include "tests/unit/can_together/together_scene.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stride::can {

using test::StackAxis;

/// All of it.
struct Stack {
  explicit Stack(double cycle = 0.002) : setup(kSchema, cycle) {}

  bus::SetupParameters &add(uint32_t id, double controlType) {
    bus::SetupParameters &drive = setup.addDrive("D" + std::to_string(id), id).parameters;
    drive.add({"wControlType", "", controlType});
    drive.add({"dwRatioTechUnitsDenom", "", static_cast<double>(StackAxis::kIncrements)});
    axes.push_back(std::make_unique<StackAxis>());
    axes.back()->axis.wDriveId = static_cast<uint16_t>(id);
    return drive;
  }

  void make() {
    auto port = std::make_unique<SimulatedNetwork>(setup);
    network = port.get();
    stranger = network->bus().addPort();
    auto made = std::make_unique<CanDriver>(setup, std::move(port));
    driver = made.get();
    driver->attach(host);
    std::vector<axis::AxisRef *> refs;
    for (const auto &one : axes)
      refs.push_back(&one->axis);
    group = std::make_unique<bus::DriveGroup>(std::move(made), groupRef, refs, setup.cycleSeconds);
  }

  void cycle() {
    group->executeStart();
    for (const auto &one : axes)
      one->run(ctx);
    if (resetsGroup && cycles % 50 == 0 && wantsReset())
      ++groupRef.udiResetsAsked;
    group->executeEnd();
    Port &other = network->bus().port(stranger);
    other.beginCycle();
    std::array<Received, 64> frames;
    while (other.receive(frames) != 0) {
    }
    ++cycles;
    ++ctx.cycle;
  }
  /// SMC_ResetAxisGroup is for what MC_Reset cannot bring back, and for a start-up that has failed.
  [[nodiscard]] bool wantsReset() const {
    bool wants = groupRef.wState >= 1000;
    for (const auto &one : axes)
      wants = wants || (groupRef.wState == axis::kNormalOperation && one->stopped > 150 &&
                        one->axis.bCommunication == 0);
    return wants;
  }
  /// Somebody else sends a frame.
  void say(uint16_t id, std::initializer_list<uint8_t> bytes) {
    Frame frame;
    frame.id = id;
    frame.length = static_cast<uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    network->bus().port(stranger).send(frame, SendClass::Service);
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
  QuietHost host;
  bus::AxisGroupRef groupRef = test::fresh<bus::AxisGroupRef>();
  std::vector<std::unique_ptr<StackAxis>> axes;
  SimulatedNetwork *network = nullptr; ///< The driver's port.
  CanDriver *driver = nullptr;
  std::unique_ptr<bus::DriveGroup> group;
  simulation::Station stranger = 0;
  bool resetsGroup = true;
  int cycles = 0;
};

} // namespace stride::can

#endif
