#include "drivers/sercos/master/probes.hpp"

#include "drivers/sercos/protocol/words.hpp"

namespace stride::sercos {
namespace {

constexpr std::array<Idn, 2> kEnables = {idns::kProbe1Enable, idns::kProbe2Enable};

} // namespace

void Probes::step(uint8_t wanted) {
  wanted = wanted & inputs_;
  const auto fresh = static_cast<uint8_t>(wanted & ~wanted_);
  wanted_ = wanted;
  captured_ = captured_ & wanted & static_cast<uint8_t>(~fresh);
  seen_ = seen_ & wanted & static_cast<uint8_t>(~fresh);
  // What has been latched before must be forgotten first.
  for (size_t probe = 0; probe < enables_.size(); ++probe)
    if ((fresh >> 2 * probe & 3U) != 0)
      enables_[probe].again = enables_[probe].on;
  if (wanted != 0 && step_ == Step::Off)
    step_ = Step::Edges;
}

ServiceWish Probes::wish() const {
  using Kind = ServiceWish::Kind;
  if (step_ == Step::Edges)
    return {Kind::Write, idns::kProbeControl, inputs_};
  if (step_ == Step::Command)
    return {Kind::Write, idns::kProbing, command::kStart};
  if (step_ != Step::Active)
    return {};
  for (size_t edge = 0; edge < kEdges; ++edge)
    if ((seen_ >> edge & 1U) != 0)
      return {Kind::Read, static_cast<Idn>(idns::kProbe1Positive + edge)};
  bool armed = false;
  for (size_t probe = 0; probe < enables_.size(); ++probe) {
    const Enable &enable = enables_[probe];
    const bool wants = wantsProbe(probe);
    if (enable.on && (enable.again || !wants))
      return {Kind::Write, kEnables[probe], 0};
    if (!enable.on && wants)
      return {Kind::Write, kEnables[probe], 1};
    armed = armed || (enable.on && wants);
  }
  return armed ? ServiceWish{Kind::Read, idns::kProbeStatus} : ServiceWish{};
}

void Probes::answered(const ServiceWish &wish, const ServiceAnswer &answer) {
  if (wish.idn == idns::kProbeControl) {
    step_ = answer.done ? Step::Command : Step::Ended;
  } else if (wish.idn == idns::kProbing) {
    step_ = answer.done ? Step::Active : Step::Ended;
  } else if (wish.idn == kEnables[0] || wish.idn == kEnables[1]) {
    Enable &enable = enables_[wish.idn == kEnables[0] ? 0 : 1];
    if (!answer.done)
      return; // it is told again
    enable.on = wish.value != 0;
    enable.again = enable.again && enable.on;
  } else if (wish.idn == idns::kProbeStatus) {
    for (size_t edge = 0; answer.done && edge < kEdges; ++edge) {
      const Enable &enable = enables_[edge / 2];
      const auto bit = static_cast<uint8_t>(1U << edge);
      if (enable.on && !enable.again &&
          (static_cast<uint64_t>(answer.value) & bit & wanted_) != 0 && (captured_ & bit) == 0)
        seen_ = seen_ | bit;
    }
  } else if (wish.idn >= idns::kProbe1Positive && wish.idn <= idns::kProbe2Negative) {
    const size_t edge = wish.idn - size_t{idns::kProbe1Positive};
    const auto bit = static_cast<uint8_t>(1U << edge);
    if (!answer.done || (seen_ & bit) == 0)
      return;
    seen_ = seen_ & static_cast<uint8_t>(~bit);
    captured_ = captured_ | bit;
    positions_[edge] = static_cast<int32_t>(answer.value);
  }
}

} // namespace stride::sercos
