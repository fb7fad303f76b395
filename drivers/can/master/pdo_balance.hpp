// Whether one node sends the PDOs that come with SYNC, or two that have one node id.
#ifndef STRIDE_DRIVERS_CAN_MASTER_PDO_BALANCE_HPP
#define STRIDE_DRIVERS_CAN_MASTER_PDO_BALANCE_HPP

#include <algorithm>
#include <cstdint>

namespace stride::can {

/// Weighs one synchronous TPDO against SYNC. A node that is late owes answers, and may give all of
/// them at once; but it never gives more than one for each SYNC. Two nodes give two.
class PdoBalance {
public:
  /// So many more than SYNCs show a second node. A frame can be on the bus twice without one: its
  /// receiver had it when its sender saw an error in its last bits. [ISO 11898-1]
  static constexpr int32_t kMostExcess = 3;
  /// SYNCs that a node still answers when it has been late: as many as the deepest queues of CAN
  /// controllers hold. So a second node is found after kMostExcess cycles, and after
  /// kDeepestBacklog + kMostExcess where there were gaps before.
  static constexpr int32_t kDeepestBacklog = 64;
  /// Cycles as they should be, after which one excess frame is forgotten.
  static constexpr uint32_t kForget = 100;

  /// What has come in a cycle, and for how many SYNCs.
  void count(uint32_t answers, uint32_t syncs) {
    const int32_t difference = bounded(answers) - bounded(syncs);
    excess_ = std::clamp(excess_ + difference, -kDeepestBacklog, kMostExcess);
    proper_ = difference == 0 && excess_ > 0 ? proper_ + 1 : 0;
    if (proper_ == kForget) {
      --excess_;
      proper_ = 0;
    }
    second_ = second_ || excess_ >= kMostExcess;
  }

  /// There is a second node; TRUE stays.
  [[nodiscard]] bool second() const { return second_; }

private:
  static int32_t bounded(uint32_t count) {
    return static_cast<int32_t>(std::min<uint32_t>(count, 2 * kDeepestBacklog));
  }

  int32_t excess_ = 0;  ///< Answers beyond one for each SYNC; below 0: those that are owed.
  uint32_t proper_ = 0; ///< Cycles in a row with one answer for each SYNC.
  bool second_ = false;
};

} // namespace stride::can

#endif
