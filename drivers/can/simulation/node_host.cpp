#include "drivers/can/simulation/node_host.hpp"

#include <algorithm>
#include <array>

namespace stride::can::simulation {
namespace {

/// Frames in one step at most: a bus that never rests does not keep it from what is due.
constexpr size_t kMostFrames = 256;
/// How soon a port that is full is asked again. [ns]
constexpr int64_t kAgain = 200'000;

} // namespace

void NodeHost::add(Node &node, int64_t nowNs) {
  members_.push_back({&node, {}, false});
  node.powerOn(nowNs);
}

void NodeHost::tell(const Frame &frame, const Node *sender, int64_t nowNs) noexcept {
  for (const Member &member : members_)
    if (member.node != sender)
      member.node->receive(frame, nowNs);
}

/// Round by round, so that none of them keeps the others from sending.
void NodeHost::send(int64_t nowNs) noexcept {
  size_t sent = 0;
  for (bool more = true; more && sent < kMostFrames;) {
    more = false;
    for (Member &member : members_) {
      member.full = member.full || member.node->transmit(member.mailbox);
      if (!member.full || port_.send(member.mailbox, SendClass::Process) != SendResult::Sent)
        continue;
      member.full = false;
      more = true;
      ++sent;
      tell(member.mailbox, member.node, nowNs);
    }
  }
}

void NodeHost::step(int64_t nowNs) noexcept {
  lastNs_ = nowNs;
  port_.beginCycle();
  const bool off = port_.state() == ControllerState::BusOff;
  if (off_ && !off)
    for (const Member &member : members_)
      member.node->recovered(nowNs);
  off_ = off;
  for (const Member &member : members_)
    for (int64_t next = member.node->nextNs(); next <= nowNs; next = member.node->nextNs())
      member.node->advance(next);
  send(nowNs);
  std::array<Received, 16> frames;
  size_t taken = 0;
  for (size_t count = frames.size(); count == frames.size() && taken < kMostFrames;) {
    count = port_.receive(frames);
    taken += count;
    for (size_t i = 0; i < count; ++i) {
      tell(frames[i].frame, nullptr, nowNs);
      send(nowNs); // an answer to each, as a node has it that is alone in its controller
    }
  }
}

int64_t NodeHost::nextNs() const noexcept {
  int64_t next = kNever;
  bool waits = false;
  for (const Member &member : members_) {
    next = std::min(next, member.node->nextNs());
    waits = waits || member.full;
  }
  return waits ? std::min(next, lastNs_ + kAgain) : next;
}

} // namespace stride::can::simulation
