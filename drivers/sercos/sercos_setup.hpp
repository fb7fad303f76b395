// What the PLC configuration says, for the master.
#ifndef STRIDE_DRIVERS_SERCOS_SERCOS_SETUP_HPP
#define STRIDE_DRIVERS_SERCOS_SERCOS_SETUP_HPP

#include "drivers/sercos/master/master.hpp"
#include "runtime/bus/group_setup.hpp"

#include <string>
#include <vector>

namespace stride::sercos {

struct SercosSetup {
  MasterConfig master;
  std::vector<std::string> faults; ///< Of each drive: why it cannot start; empty: nothing.
  static constexpr size_t kNoDrive = static_cast<size_t>(-1);
  std::vector<size_t> encoders; ///< Of each: whose second one it is; kNoDrive: nobody's.
};

/// Reads the drives' parameter files, too.
SercosSetup sercosSetup(const bus::GroupSetup &setup);

} // namespace stride::sercos

#endif
