// What the PLC configuration says, for the master.
#ifndef STRIDE_DRIVERS_CAN_CAN_SETUP_HPP
#define STRIDE_DRIVERS_CAN_CAN_SETUP_HPP

#include "drivers/can/master/master.hpp"
#include "drivers/can/plan/group_plan.hpp"
#include "runtime/bus/group_setup.hpp"

#include <string>
#include <vector>

namespace stride::can {

struct CanSetup {
  /// Where a drive is: which node, and which of its logical devices.
  struct DrivePlace {
    size_t node = 0;
    size_t device = 0;
  };

  MasterConfig master;
  std::vector<DrivePlace> drives; ///< Of each drive; their nodes are the first of the master's.
  size_t driveNodes = 0;          ///< So many nodes are drives.
  BusLoad load;
  std::string interface;           ///< "can0".
  uint32_t bitRate = 1000;         ///< [kBit/s]
  std::vector<std::string> faults; ///< Of each drive: why it cannot start; empty: nothing.
  std::vector<std::string> notes;  ///< To be said when the run begins.
  /// Of each encoder: the node that tells its position, and in which signal.
  struct EncoderSource {
    size_t node = 0;
    size_t device = 0;
    Signal signal = Signal::EncoderPosition;
    std::string fault; ///< Why it cannot be read; empty: nothing.
  };
  std::vector<EncoderSource> encoders;
  bool hasIos = false;        ///< Nodes after those of the encoders.
  bool hasSyncDevice = false; ///< It is the last node.
};

CanSetup canSetup(const bus::GroupSetup &setup);

} // namespace stride::can

#endif
