#include "drivers/can/simulation/node_host.hpp"

#include <algorithm>
#include <span>

namespace stride::can::simulation {
namespace {

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
  count_ = port_.receive(frames_);
  for (size_t i = 0; i < count_; ++i) {
    tellReceived(i, nowNs);
    send(nowNs); // an answer to each, as a node has it that is alone in its controller
  }
}

/// A SYNC after which another one has come is none any more.
void NodeHost::tellReceived(size_t place, int64_t nowNs) noexcept {
  const Frame &frame = frames_[place].frame;
  const auto rest = std::span<const Received>(frames_).first(count_).subspan(place + 1);
  for (const Member &member : members_) {
    Node &node = *member.node;
    const bool old = node.synchronizedBy(frame) &&
                     std::any_of(rest.begin(), rest.end(), [&node](const Received &later) {
                       return node.synchronizedBy(later.frame);
                     });
    if (!old)
      node.receive(frame, nowNs);
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
