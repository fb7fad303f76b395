// A group whose axes' task and whose planning task are threads that run as fast as they can, under
// ThreadSanitizer: portals drive lines, are stopped at once, go on with other overrides, and begin
// again. Prints how many movements have been done, and how many answers taken.
#include "runtime/numeric/group/planning.hpp"
#include "runtime/numeric/kinematics/portals.hpp"

#include <atomic>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

using namespace stride::group;
namespace kinematics = stride::kinematics;

namespace {

constexpr int kMovementsWanted = 60;
constexpr double kCycle = 0.001;

void command(GroupMotion &group, int number) {
  double to[kAxes] = {};
  double perTime[kAxes];
  to[0] = number % 2 == 0 ? 12.0 : -3.0;
  to[1] = number % 3 == 0 ? 7.0 : 1.0;
  for (double &velocity : perTime)
    velocity = 100.0;
  Order order{};
  order.velocityFactor = order.accelerationFactor = order.jerkFactor = 1.0;
  append(group, drawId(group), axesLeg(group.axes, to, perTime, 100.0), order);
}

} // namespace

int main() {
  auto group = std::make_unique<GroupMotion>();
  auto planning = std::make_unique<GroupPlanning>();
  kinematics::AnyKinematics portal{};
  portal.setArm(kinematics::ArmKind::Gantry3, kinematics::Gantry3{});
  AxisLimits limits[kAxes];
  for (AxisLimits &axis : limits)
    axis = {200.0, 4000.0, 90000.0, -1e4, 1e4};
  const Arm arm{portal.ref(), 3, 0, limits, {}};
  const double home[kAxes] = {};
  reset(*group, home);

  std::atomic<bool> over = false;
  std::thread planner([&] {
    while (!over.load(std::memory_order_relaxed)) {
      planAside(*planning, {0.004, 256, 96});
      std::this_thread::yield();
    }
  });
  int done = 0;
  int taken = 0;
  int movements = 0;
  for (int64_t n = 0; n < 20'000'000 && done < kMovementsWanted; ++n) {
    const bool rests = isAtRest(*group);
    if (rests && (group->first == group->next || group->alone)) {
      done += group->first == group->next ? 1 : 0;
      reset(*group, std::as_const(group->axes));
      command(*group, ++movements);
    }
    GroupCommand now{kCycle, 1.0, false, 0.0, 64, 24};
    now.stop = group->alone || (movements % 4 == 1 && n % 50 == 49);
    now.atOnce = now.stop;
    if (movements % 4 == 2) // which the axes' task plans, too
      now.override = n / 150 % 2 == 0 ? 0.6 : 0.9;
    taken += follow(*group, *planning, arm, now) ? 1 : 0;
    goOn(*group, *planning, arm, now);
    (void)post(*group, *planning, arm, portal, now);
    std::this_thread::yield();
  }
  over.store(true, std::memory_order_relaxed);
  planner.join();
  std::printf("done = %d\ntaken = %d\n", done, taken);
  return 0;
}
