// Which PDOs an I/O device has, and what it is told when it starts. [CiA 401] Pure arithmetic, for
// the compiler and for the master.
#ifndef STRIDE_DRIVERS_CAN_PLAN_IO_PLAN_HPP
#define STRIDE_DRIVERS_CAN_PLAN_IO_PLAN_HPP

#include "drivers/can/plan/pdo_plan.hpp"
#include "runtime/bus/group_setup.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stride::can {

/// One direction of an I/O device: digital bytes first, analog values of two bytes last.
struct IoSide {
  static constexpr uint32_t kMostDigital = 8;
  static constexpr uint32_t kMostAnalog = 12;

  uint32_t bytes = 0;   ///< All of it, with unused ones in between.
  uint32_t digital = 0; ///< [bytes]
  uint32_t analog = 0;  ///< [values]
  [[nodiscard]] uint32_t analogAt() const { return bytes - 2 * analog; }
};

struct IoPlan {
  IoSide inputs;
  IoSide outputs;
  DrivePlan plan;
  /// Of the PDOs, by their places in `plan`: their first byte among the device's inputs or outputs.
  std::array<uint16_t, DrivePlan::kMostPdos> rpdoAt{};
  std::array<uint16_t, DrivePlan::kMostPdos> tpdoAt{};
  /// What is written when it starts: first what its outputs become when the master is lost.
  std::vector<SdoWrite> startup;
  std::vector<std::string> errors; ///< Of `startup`: a sentence each, which names the entry.
  /// Analog outputs whose safe value nobody tells the device, which has it only while the master
  /// lives: numbers from 1.
  std::vector<uint32_t> untold;
  std::string fault; ///< Why it cannot be served; empty: nothing.
};

/// Without regard to other nodes.
IoPlan planIo(const bus::IoSetup &io);

} // namespace stride::can

#endif
