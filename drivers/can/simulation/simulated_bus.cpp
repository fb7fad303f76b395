#include "drivers/can/simulation/simulated_bus.hpp"

#include "drivers/can/simulation/simulated_port.hpp"
#include "drivers/can/simulation/wire.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

constexpr int64_t kSecond = 1'000'000'000;

} // namespace

SimulatedBus::SimulatedBus(const BusSetup &setup) : setup_(setup), wires_(1), faults_(setup.seed) {}

SimulatedBus::~SimulatedBus() = default;

int64_t SimulatedBus::bitsNs(uint32_t bits) const { return bits * kSecond / setup_.bitRate; }

Station SimulatedBus::addPort() {
  const Station station = members_.size();
  ports_.push_back(std::make_unique<SimulatedPort>(*this, station, setup_));
  members_.emplace_back().port = ports_.back().get();
  return station;
}

Port &SimulatedBus::port(Station station) { return *members_[station].port; }

Station SimulatedBus::attach(Node &node, int64_t reactionNs) {
  const Station station = members_.size();
  Member &member = members_.emplace_back();
  member.node = &node;
  member.reactionNs = reactionNs;
  node.powerOn(now_);
  served(station);
  return station;
}

void SimulatedBus::runUntil(int64_t timeNs) noexcept {
  using What = Next::What;
  for (Station i = 0; i < members_.size(); ++i)
    if (members_[i].node != nullptr) // somebody may have changed it meanwhile
      served(i);
  for (Next event = next(); event.timeNs <= timeNs; event = next()) {
    // What is sent at `timeNs` takes part in the arbitration of that time.
    if (event.what == What::Start && event.timeNs >= timeNs)
      break;
    now_ = std::max(now_, event.timeNs);
    handle(event);
  }
  now_ = std::max(now_, timeNs);
}

/// Of what is due at the same time the end of a frame comes first, and the start of the next one
/// last. Whoever is attached first is first.
SimulatedBus::Next SimulatedBus::next() const noexcept {
  using What = Next::What;
  Next event;
  for (size_t piece = 0; piece < wires_.size(); ++piece) {
    if (wires_[piece].endNs != kNever)
      event.consider(wires_[piece].endNs, What::End, piece);
    else
      event.consider(startNs(piece), What::Start, piece);
  }
  for (size_t i = 0; i < kLate; ++i)
    event.consider(late_[i].timeNs, What::Late, i);
  for (Station i = 0; i < members_.size(); ++i) {
    event.consider(members_[i].recoverNs, What::Recover, i);
    event.consider(members_[i].timerNs, What::Timer, i);
  }
  return event;
}

/// Whether somebody acknowledges its frames.
bool SimulatedBus::heard(const Member &sender) const noexcept {
  return std::any_of(members_.begin(), members_.end(), [&](const Member &other) {
    return &other != &sender && other.piece == sender.piece && other.takesPart();
  });
}

bool SimulatedBus::mayStart(const Member &member, size_t piece) const noexcept {
  // A passive one whom nobody hears repeats its frame for ever: nothing comes of it.
  return member.full && member.piece == piece && member.takesPart() &&
         (!member.controller.passive() || heard(member));
}

int64_t SimulatedBus::startNs(size_t piece) const noexcept {
  int64_t ready = kNever;
  for (const Member &member : members_)
    if (member.full && member.readyNs < ready && mayStart(member, piece))
      ready = member.readyNs;
  return ready == kNever ? kNever : std::max({ready, wires_[piece].idleNs, now_});
}

void SimulatedBus::handle(const Next &event) noexcept {
  switch (event.what) {
  case Next::What::End:
    finish(event.which);
    break;
  case Next::What::Late:
    deliverLate(event.which);
    break;
  case Next::What::Recover:
    recover(event.which);
    break;
  case Next::What::Timer:
    members_[event.which].node->advance(now_);
    served(event.which);
    break;
  case Next::What::Start:
    start(event.which);
    break;
  }
}

/// All who have something to send begin at once, and who sends the smallest identifier goes on.
void SimulatedBus::start(size_t piece) noexcept {
  Wire &wire = wires_[piece];
  Member *best = nullptr;
  for (Member &member : members_)
    if (mayStart(member, piece) && member.readyNs <= now_ &&
        (best == nullptr || arbitration(member.mailbox) < arbitration(best->mailbox)))
      best = &member;
  if (best == nullptr)
    return;
  wire.sender = static_cast<Station>(best - members_.data());
  wire.frame = best->mailbox;
  best->sending = true;
  const Frame *other = nullptr;
  for (Member &member : members_) {
    if (&member == best || !mayStart(member, piece) || member.readyNs > now_ ||
        arbitration(member.mailbox) != arbitration(wire.frame))
      continue;
    member.sending = true;
    if (other == nullptr && member.mailbox != wire.frame)
      other = &member.mailbox;
  }
  uint32_t bits = exactBits(wire.frame);
  wire.outcome = heard(*best) ? Outcome::Whole : Outcome::NotAcknowledged;
  wire.choice = faults_.choose(wire.frame);
  if (wire.outcome == Outcome::NotAcknowledged || wire.choice.fault == Fault::Disturb) {
    wire.outcome = wire.outcome == Outcome::Whole ? Outcome::Disturbed : wire.outcome;
    bits = bits - kTailBits - kGapBits + 2 + kErrorBits;
  } else if (wire.choice.fault == Fault::Duplicate) {
    bits += bits;
  }
  wire.endNs = now_ + bitsNs(bits - kGapBits);
  wire.idleNs = now_ + bitsNs(bits);
  counters_.bits += bits;
  if (other != nullptr)
    collide(wire, piece, wire.sender, *other);
}

/// Stations that send the same identifier notice each other at the first bit that differs: whoever
/// sends the recessive one. If it is passive it may not disturb the other, else both fail.
void SimulatedBus::collide(Wire &wire, size_t piece, Station winner, const Frame &other) noexcept {
  ++counters_.collisions;
  const StuffedBits first(wire.frame);
  const StuffedBits second(other);
  const size_t place = firstDifference(first, second);
  const bool firstWins = place >= first.size() || !first[place];
  Member *dominant = nullptr;
  bool disturbs = false;
  for (Member &member : members_) {
    if (!member.sending || member.piece != piece)
      continue;
    if ((member.mailbox == wire.frame) == firstWins)
      dominant = dominant == nullptr ? &member : dominant;
    else
      disturbs = disturbs || !member.controller.passive();
  }
  if (disturbs || dominant == nullptr) {
    wire.outcome = Outcome::Disturbed;
    const uint32_t bits = static_cast<uint32_t>(place) + 1 + kErrorBits;
    wire.endNs = now_ + bitsNs(bits);
    wire.idleNs = now_ + bitsNs(bits + kGapBits);
    return;
  }
  const Frame through = dominant->mailbox;
  for (Member &member : members_)
    if (member.sending && member.piece == piece && member.mailbox != through) {
      member.sending = false;
      member.controller.sendFailed();
      note(member);
    }
  wire.sender = firstWins ? winner : static_cast<Station>(dominant - members_.data());
  wire.frame = through;
  wire.choice = {Fault::None, 0, through};
  const uint32_t bits = exactBits(through);
  wire.endNs = now_ + bitsNs(bits - kGapBits);
  wire.idleNs = now_ + bitsNs(bits);
}

void SimulatedBus::finish(size_t piece) noexcept {
  Wire &wire = wires_[piece];
  wire.endNs = kNever;
  if (wire.outcome != Outcome::Whole) {
    failed(piece, wire.outcome == Outcome::Disturbed);
    return;
  }
  ++counters_.frames;
  if (tap_ != nullptr)
    tap_->seen(wire.frame, now_, wire.sender);
  for (Station i = 0; i < members_.size(); ++i) {
    Member &member = members_[i];
    if (!member.sending || member.piece != piece)
      continue;
    member.sending = false;
    member.full = false;
    member.controller.sent();
    served(i);
    if (member.controller.passive())
      member.readyNs = std::max(member.readyNs, wire.idleNs + bitsNs(kSuspendBits));
  }
  const FaultChoice choice = wire.choice;
  const Station sender = wire.sender;
  const auto from = static_cast<uint8_t>(piece);
  if (choice.fault == Fault::Lose)
    return;
  if (choice.fault == Fault::Delay) {
    for (Late &late : late_)
      if (late.timeNs == kNever) {
        late = {choice.frame, now_ + choice.delayNs, sender, from};
        return;
      }
    return; // too many are under way: this one is lost
  }
  deliver(choice.frame, sender, from);
  if (choice.fault == Fault::Duplicate)
    deliver(choice.frame, sender, from);
}

/// The frame was not whole: its senders repeat it by themselves.
void SimulatedBus::failed(size_t piece, bool acknowledged) noexcept {
  ++counters_.errors;
  for (Station i = 0; i < members_.size(); ++i) {
    Member &member = members_[i];
    if (member.piece != piece || !member.takesPart())
      continue;
    if (!member.sending)
      member.controller.receiveFailed();
    else if (acknowledged)
      member.controller.sendFailed();
    else
      member.controller.notAcknowledged();
    if (member.sending && member.port != nullptr)
      ++member.port->counters_.errorFrames;
    member.sending = false;
    if (member.controller.passive())
      member.readyNs = std::max(member.readyNs, wires_[piece].idleNs + bitsNs(kSuspendBits));
    note(member);
  }
}

/// After its counters have changed: whether it is off the bus now.
void SimulatedBus::note(Member &member) noexcept {
  if (!member.controller.off() || member.recoverNs != kNever)
    return;
  member.full = false;
  member.sending = false;
  if (member.node != nullptr)
    member.recoverNs = now_ + bitsNs(kRecoveryBits);
  else {
    member.port->forget();
    ++member.port->counters_.errorFrames;
    if (setup_.restartNs > 0)
      member.recoverNs = now_ + setup_.restartNs + bitsNs(kRecoveryBits);
  }
}

void SimulatedBus::recover(Station station) noexcept {
  Member &member = members_[station];
  member.recoverNs = kNever;
  member.controller.restart();
  if (member.port != nullptr)
    ++member.port->counters_.restarts;
  else
    member.node->recovered(now_);
  served(station);
}

void SimulatedBus::deliver(const Frame &frame, Station sender, uint8_t piece) noexcept {
  for (Station i = 0; i < members_.size(); ++i) {
    Member &member = members_[i];
    if (i == sender || member.piece != piece || !member.takesPart())
      continue;
    member.controller.received();
    if (member.node != nullptr) {
      if (member.node->receive(frame, now_))
        served(i);
    } else if (!member.port->received_.push({frame, now_})) {
      ++member.port->counters_.dropped;
    }
  }
}

void SimulatedBus::deliverLate(size_t which) noexcept {
  const Late late = late_[which];
  late_[which].timeNs = kNever;
  deliver(late.frame, late.sender, late.piece);
}

/// The node has done something: when it has to do next, and what it sends.
void SimulatedBus::served(Station station) noexcept {
  Member &member = members_[station];
  fill(station);
  if (member.node != nullptr)
    member.timerNs = member.powered ? member.node->nextNs() : kNever;
}

void SimulatedBus::fill(Station station) noexcept {
  Member &member = members_[station];
  if (member.full || !member.takesPart())
    return;
  if (member.node != nullptr) {
    member.full = member.node->transmit(member.mailbox);
    member.readyNs = now_ + member.reactionNs;
    return;
  }
  SimulatedPort::Waiting waiting;
  member.full = member.port->next(waiting);
  member.mailbox = waiting.frame;
  member.readyNs = std::max(waiting.readyNs, now_);
}

ControllerState SimulatedBus::state(Station station) const {
  const Member &member = members_[station];
  return member.powered ? member.controller.state() : ControllerState::Down;
}

} // namespace stride::can::simulation
