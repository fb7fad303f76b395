#include "drivers/sercos/protocol/telegrams.hpp"

#include <array>

namespace stride::sercos {
namespace {

using namespace idns;

constexpr std::array<Idn, 1> kTorqueOut = {kTorqueCommand};
constexpr std::array<Idn, 1> kVelocityOut = {kVelocityCommand};
constexpr std::array<Idn, 1> kPositionOut = {kPositionCommand};
constexpr std::array<Idn, 2> kBothOut = {kPositionCommand, kVelocityCommand};
constexpr std::array<Idn, 1> kVelocityIn = {kVelocityFeedback};
constexpr std::array<Idn, 1> kPosition1In = {kPositionFeedback1};
constexpr std::array<Idn, 1> kPosition2In = {kPositionFeedback2};
constexpr std::array<Idn, 2> kBoth1In = {kPositionFeedback1, kVelocityFeedback};
constexpr std::array<Idn, 2> kBoth2In = {kPositionFeedback2, kVelocityFeedback};

} // namespace

TelegramContents standardTelegram(uint16_t telegramType) {
  const bool external = (telegramType & kExternalFeedback) != 0;
  const std::span<const Idn> position =
      external ? std::span<const Idn>(kPosition2In) : std::span<const Idn>(kPosition1In);
  switch (telegramType & kTelegramMask) {
  case 1:
    return {{}, kTorqueOut};
  case 2:
    return {kVelocityIn, kVelocityOut};
  case 3:
    return {position, kVelocityOut};
  case 4:
    return {position, kPositionOut};
  case 5:
    return {external ? std::span<const Idn>(kBoth2In) : std::span<const Idn>(kBoth1In), kBothOut};
  case 6:
    return {{}, kVelocityOut};
  default:
    return {};
  }
}

} // namespace stride::sercos
