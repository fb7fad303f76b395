// Identifiers for the PDOs of further axes of a device: the predefined connection set has eight for
// a node, and those of its first axis are among them.
#include "drivers/can/plan/group_plan.hpp"

#include <bitset>

namespace stride::can {
namespace {

class CobIds {
public:
  CobIds(const bus::GroupSetup &setup, const GroupPlan &plan) {
    nodes_.set(0);
    nodes_.set(kSyncDevice);
    nodes_.set(static_cast<size_t>(setup.busParameters.number("node_id")) % nodes_.size());
    for (const bus::DriveSetup &drive : setup.drives)
      nodes_.set(drive.id % nodes_.size());
    for (size_t i = 0; i < plan.drives.size(); ++i)
      if (plan.faults[i].empty())
        take(plan.drives[i].plan);
    for (const EncoderPlan &encoder : plan.encoders)
      take(encoder.plan);
    for (const IoPlan &io : plan.ios)
      take(io.plan);
  }

  /// The device's own ones first; then those of numbers that nobody has, the last one first.
  uint16_t next(uint16_t base, uint8_t node) {
    if (const uint16_t own = freeOf(base, node); own != 0)
      return own;
    for (uint8_t other = kLastNode; other > 0; --other)
      if (!nodes_.test(other))
        if (const uint16_t id = freeOf(base, other); id != 0)
          return id;
    return 0;
  }

private:
  void take(const DrivePlan &plan) {
    nodes_.set(plan.node);
    for (const Pdo &pdo : plan.receivedByDrive())
      used_.set(pdo.cobId);
    for (const Pdo &pdo : plan.sentByDrive())
      used_.set(pdo.cobId);
  }
  uint16_t freeOf(uint16_t base, uint8_t node) {
    for (size_t place = 0; place < DrivePlan::kMostPdos; ++place) {
      const uint16_t id = predefinedId(base, place, node, 0);
      if (used_.test(id))
        continue;
      used_.set(id);
      return id;
    }
    return 0;
  }

  std::bitset<Frame::kLastId + 1> used_;
  std::bitset<kLastNode + 1> nodes_; ///< Numbers that are somebody's.
};

} // namespace

void addCobIds(const bus::GroupSetup &setup, GroupPlan &plan) {
  CobIds ids(setup, plan);
  for (size_t i = 0; i < plan.drives.size(); ++i) {
    DrivePlan &drive = plan.drives[i].plan;
    if (drive.axis == 0 || !plan.faults[i].empty())
      continue;
    bool enough = true;
    for (size_t place = 0; place < drive.rpdoCount; ++place)
      enough = (drive.rpdos[place].cobId = ids.next(kRpdoBase, drive.node)) != 0 && enough;
    for (size_t place = 0; place < drive.tpdoCount; ++place)
      enough = (drive.tpdos[place].cobId = ids.next(kTpdoBase, drive.node)) != 0 && enough;
    if (!enough)
      plan.faults[i] = "there is no COB-ID left for its PDOs";
  }
}

} // namespace stride::can
