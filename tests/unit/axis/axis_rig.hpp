// A rig for tests: one axis on a dummy drive, driven cycle by cycle without an application.
#ifndef STRIDE_TESTS_UNIT_AXIS_AXIS_RIG_HPP
#define STRIDE_TESTS_UNIT_AXIS_AXIS_RIG_HPP

#include "drivers/dummy/dummy_drive.hpp"
#include "runtime/app/ctx.h"
#include "runtime/axis/increments.hpp"
#include "runtime/bus/drive_group.hpp"

#include "tests/support/fresh.hpp"

#include "st/SM_PLCopen/MC_MoveAbsolute.h"
#include "st/SM_PLCopen/MC_Power.h"
#include "st/SM_PLCopen/MC_Stop.h"

#include <memory>

namespace stride::test {

/// One axis group with one drive and an MC_Power that is called in every cycle.
class AxisRig {
public:
  using MoveAbsolute = ::st::SM_PLCopen::MC_MoveAbsolute;
  using Stop = ::st::SM_PLCopen::MC_Stop;

  explicit AxisRig(double cycle = 0.001) : cycleSeconds(cycle) {
    axis.wDriveId = 1;
    axis.dwRatioTechUnitsDenom = 10000;
    axis.fSWMaxDeceleration = 0;
    power.Enable = 1;
    power.bRegulatorOn = 1;
    power.bDriveStart = 1;
    power.Axis = &axis;
  }

  /// Makes a linear axis into a rotary one. Before start().
  void makeRotary(double period) {
    axis.iMovementType = 0;
    axis.fPositionPeriod = period;
  }

  void start(const bus::GroupSetup &setup = dummy::plainSetup(1)) {
    auto driver = std::make_unique<dummy::DummyDriver>(setup);
    drive = driver.get();
    axisGroup = std::make_unique<bus::DriveGroup>(
        std::move(driver), group, std::vector<axis::AxisRef *>{&axis}, cycleSeconds);
  }

  /// One cycle of the task: power, then `program`.
  template <class Program> void cycle(Program program) {
    axisGroup->executeStart();
    power.body__(ctx);
    program();
    axisGroup->executeEnd();
    ++ctx.cycle;
  }

  void idle(int cycles = 1) {
    for (int i = 0; i < cycles; ++i)
      cycle([] {});
  }

  /// Starts the rig and runs until the axis is in standstill; returns the number of cycles.
  int powerUp() {
    if (!axisGroup)
      start();
    for (int i = 1; i < 100; ++i) {
      idle();
      if (power.Status != 0)
        return i;
    }
    return -1;
  }

  /// A move of this axis, not yet started.
  MoveAbsolute move(double position, double velocity = 100, double acceleration = 100,
                    double deceleration = 100) {
    MoveAbsolute block = fresh<MoveAbsolute>();
    block.Axis = &axis;
    block.Position = position;
    block.Velocity = velocity;
    block.Acceleration = acceleration;
    block.Deceleration = deceleration;
    return block;
  }

  Stop stop(double deceleration = 100) {
    Stop block = fresh<Stop>();
    block.Axis = &axis;
    block.Deceleration = deceleration;
    return block;
  }

  template <class Block> void call(Block &block, bool execute) {
    block.Execute = execute ? 1 : 0;
    block.body__(ctx);
  }

  double cycleSeconds;
  Ctx ctx{};
  axis::AxisRef axis = fresh<axis::AxisRef>();
  bus::AxisGroupRef group = fresh<bus::AxisGroupRef>();
  ::st::SM_PLCopen::MC_Power power = fresh<::st::SM_PLCopen::MC_Power>();
  std::unique_ptr<bus::DriveGroup> axisGroup;
  dummy::DummyDriver *drive = nullptr;
};

} // namespace stride::test

#endif
