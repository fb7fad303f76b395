// An axis under a program that moves it for ever: for tests with all layers of a bus.
#ifndef STRIDE_TESTS_SUPPORT_STACK_AXIS_HPP
#define STRIDE_TESTS_SUPPORT_STACK_AXIS_HPP

#include "runtime/app/ctx.h"
#include "runtime/axis/axis_ref.hpp"
#include "tests/support/fresh.hpp"

#include "st/SM_PLCopen/MC_Home.h"
#include "st/SM_PLCopen/MC_MoveAbsolute.h"
#include "st/SM_PLCopen/MC_Power.h"
#include "st/SM_PLCopen/MC_Reset.h"
#include "st/SM_PLCopen/MC_Stop.h"

#include <cmath>
#include <cstdint>

namespace stride::test {

/// An axis and the program that moves it to and fro, and resets it as the pages for users say.
struct StackAxis {
  static constexpr double kVelocity = 100;      // u/s
  static constexpr double kAcceleration = 4000; // u/s²
  static constexpr double kWay = 6;             // u, to each side
  static constexpr uint32_t kIncrements = 1000; // of a unit

  StackAxis() {
    axis.dwRatioTechUnitsDenom = kIncrements;
    axis.fSWMaxDeceleration = kAcceleration;
    power.Enable = power.bRegulatorOn = power.bDriveStart = 1;
  }
  /// In each cycle.
  void run(Ctx &ctx) {
    power.Axis = move.Axis = reset.Axis = home.Axis = stop.Axis = &axis;
    power.body__(ctx);
    ++cycles;
    if (axis.nAxisState == axis::state::kErrorStop)
      ++stopped;
    else
      stopped = 0;
    reset.Execute = resets && stopped > 20 && cycles % 40 < 20 ? 1 : 0;
    reset.body__(ctx);
    if (homes || home.Busy != 0)
      runHome(ctx);
    else
      runMove(ctx);
    runStop(ctx);
  }
  [[nodiscard]] bool errs() const { return axis.nAxisState == axis::state::kErrorStop; }

  axis::AxisRef axis = fresh<axis::AxisRef>();
  ::st::SM_PLCopen::MC_Power power = fresh<::st::SM_PLCopen::MC_Power>();
  ::st::SM_PLCopen::MC_MoveAbsolute move = fresh<::st::SM_PLCopen::MC_MoveAbsolute>();
  ::st::SM_PLCopen::MC_Home home = fresh<::st::SM_PLCopen::MC_Home>();
  ::st::SM_PLCopen::MC_Reset reset = fresh<::st::SM_PLCopen::MC_Reset>();
  ::st::SM_PLCopen::MC_Stop stop = fresh<::st::SM_PLCopen::MC_Stop>();
  bool resets = true; ///< MC_Reset is called in errorstop.
  bool homes = false; ///< Reference runs in place of motions.
  int stopped = 0;    ///< Cycles in errorstop.
  int done = 0;       ///< Motions.
  int homed = 0;      ///< Reference runs that have found something.
  int failedHomes = 0;
  int stopsHomes = 0; ///< A reference run is stopped by MC_Stop after so many cycles; 0: never.
  int stops = 0;      ///< That have come to rest.

private:
  void runStop(Ctx &ctx) {
    homing = axis.nAxisState == axis::state::kHoming ? homing + 1 : 0;
    if (stopsHomes > 0 && homing == stopsHomes)
      stop.Execute = 1;
    else if (stop.Execute != 0 && stop.Busy == 0) {
      stops += stop.Done != 0 ? 1 : 0;
      stop.Execute = 0;
    }
    stop.Deceleration = kAcceleration;
    stop.body__(ctx);
  }
  void runMove(Ctx &ctx) {
    if (move.Execute != 0 && move.Busy == 0) {
      done += move.Done != 0 ? 1 : 0;
      move.Execute = 0;
    } else if (move.Execute == 0 && axis.nAxisState == axis::state::kStandstill) {
      if (std::fabs(axis.fSetPosition - middle) > 2 * kWay)
        middle = axis.fSetPosition;
      forward = !forward;
      move.Position = middle + (forward ? kWay : -kWay);
      move.Velocity = kVelocity;
      move.Acceleration = move.Deceleration = kAcceleration;
      move.Execute = 1;
    }
    move.body__(ctx);
  }
  void runHome(Ctx &ctx) {
    if (home.Execute != 0 && home.Busy == 0) {
      homed += home.Done != 0 ? 1 : 0;
      failedHomes += home.Error != 0 ? 1 : 0;
      home.Execute = 0;
    } else if (home.Execute == 0 && axis.nAxisState == axis::state::kStandstill) {
      home.Deceleration = kAcceleration;
      home.Position = 10;
      home.Execute = 1;
    }
    move.Execute = 0;
    move.body__(ctx);
    home.body__(ctx);
  }

  double middle = 0;
  int cycles = 0;
  int homing = 0;
  bool forward = false;
};

} // namespace stride::test

#endif
