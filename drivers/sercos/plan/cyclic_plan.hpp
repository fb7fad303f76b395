// What travels between master and drive in each cycle.
#ifndef STRIDE_DRIVERS_SERCOS_PLAN_CYCLIC_PLAN_HPP
#define STRIDE_DRIVERS_SERCOS_PLAN_CYCLIC_PLAN_HPP

#include "drivers/sercos/protocol/idn.hpp"
#include "drivers/sercos/protocol/telegrams.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace stride::sercos {

/// CyclicData of runtime/bus, as bits.
namespace cyclic {
inline constexpr uint8_t kPosition = 1;
inline constexpr uint8_t kVelocity = 2;
inline constexpr uint8_t kTorque = 4;
inline constexpr uint8_t kCurrent = 8;
} // namespace cyclic

// Controller modes, as AXIS_REF numbers them.
inline constexpr uint8_t kTorqueControl = 1;
inline constexpr uint8_t kVelocityControl = 2;
inline constexpr uint8_t kPositionControl = 3;

/// One datum of a telegram.
struct CyclicObject {
  Idn idn = 0;
  uint8_t bytes = 4; ///< 2 or 4.
  friend bool operator==(const CyclicObject &, const CyclicObject &) = default;
};

/// Data of one direction, in the order of the telegram.
class CyclicRecord {
public:
  [[nodiscard]] std::span<const CyclicObject> objects() const { return {objects_.data(), count_}; }
  /// Of the telegram: status or control word, word of the service channel, data.
  [[nodiscard]] uint32_t bytes() const;
  /// Where the data of an IDN begins in the telegram; 0: it is not in it.
  [[nodiscard]] uint32_t placeOf(Idn idn) const;
  [[nodiscard]] bool carries(Idn idn) const { return placeOf(idn) != 0; }
  /// False: there is no room.
  bool add(const CyclicObject &object);

private:
  std::array<CyclicObject, kMostCyclicObjects> objects_{};
  uint8_t count_ = 0;
};

struct CyclicPlan {
  uint16_t telegramType = 0; ///< S-0-0015.
  CyclicRecord mdt;          ///< To the drive.
  CyclicRecord at;           ///< From it.
  /// Controller modes that its command values allow: bit n stands for mode n.
  uint8_t controllerModes = 0;
  uint8_t received = 0; ///< cyclic::…: what of an axis comes back.
};

/// What stride.toml wants to be exchanged.
struct CyclicWish {
  bool io = false;                    ///< An I/O device: only what is additional.
  uint8_t controlType = 5;            ///< wControlType.
  std::array<uint16_t, 3> send{};     ///< wCyclicDataS1 …, with wControlType 0.
  std::array<uint16_t, 3> receive{};  ///< wCyclicDataR1 …
  std::vector<CyclicObject> more;     ///< Also from the drive.
  std::vector<CyclicObject> moreSent; ///< Also to the drive.
};

/// `errors`: what cannot be exchanged.
CyclicPlan planCyclic(const CyclicWish &wish, std::vector<std::string> &errors);

} // namespace stride::sercos

#endif
