#include "drivers/can/master/master.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/plan/bus_load.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace stride::can {
namespace {

constexpr uint32_t kMostMissed = 3;
constexpr uint32_t kMostLate = 2;
constexpr double kLssTimeout = 0.5; ///< To store something may take a while. [s]
constexpr double kBootTime = 2;     ///< Of devices that LSS has reset, at most. [s]
/// Frames that are read in a cycle, as a multiple of those that are planned …
constexpr size_t kReserve = 4;
/// … and of those that the bus can carry meanwhile, whoever sends them: what is left in the queue
/// would make all later ones old. A cycle of minutes does not get memory for them all.
constexpr uint64_t kBusReserve = 2;
constexpr uint64_t kShortestFrame = 47; // bit
constexpr uint64_t kMostFrames = 16384;

size_t plannedFrames(const MasterConfig &config) {
  size_t frames = 1 + std::max(config.sdoPerCycle, kMostSdosPerCycle);
  for (const NodeConfig &node : config.nodes) {
    frames += 2U; // heartbeat, EMCY
    for (size_t i = 0; i < node.devices(); ++i)
      frames += node.device(i).plan.tpdoCount;
  }
  return frames;
}

size_t framesToRead(const MasterConfig &config) {
  const uint64_t onTheBus = kBusReserve * (config.bitsPerCycle / kShortestFrame);
  return std::max(kReserve * plannedFrames(config),
                  static_cast<size_t>(std::min(onTheBus, kMostFrames)));
}

bool isLost(ControllerState state) {
  return state == ControllerState::BusOff || state == ControllerState::Down;
}

} // namespace

Master::Master(const MasterConfig &config, std::unique_ptr<Port> port)
    : config_(config), port_(std::move(port)), frames_(framesToRead(config)),
      heartbeatCycles_(cyclesOf(config.heartbeat, config.cycle)),
      timeCycles_(config.timeStamp > 0 ? cyclesOf(config.timeStamp, config.cycle) : 0),
      lss_(cyclesOf(kLssTimeout, config.cycle)) {
  nodes_.reserve(config.nodes.size());
  for (const NodeConfig &node : config.nodes) {
    nodes_.emplace_back(node);
    cyclicBits_.push_back(nodes_.back().cyclicBits());
    addRoutes(static_cast<uint8_t>(nodes_.size() - 1));
    nodes_.back().useCobIds(cobIds_);
  }
  routes_[kSyncCobId] = {Kind::Sync};
  routes_[lss::kAnswerId] = {Kind::Lss};
  for (const uint16_t one : {kNmtId, kSyncCobId, kTimeId, lss::kAnswerId, lss::kRequestId})
    cobIds_.set(one);
  cobIds_.set((kHeartbeatBase + config.node) & Frame::kLastId);
}

void Master::addRoutes(uint8_t index) {
  const uint8_t number = config_.nodes[index].plan.node;
  routes_[kSdoAnswerBase + number] = {Kind::Sdo, index};
  routes_[kHeartbeatBase + number] = {Kind::Heartbeat, index};
  routes_[kEmcyBase + number] = {Kind::Emcy, index};
  for (const uint16_t base : {kSdoAnswerBase, kSdoRequestBase, kHeartbeatBase, kEmcyBase})
    cobIds_.set(base + number);
  addPdoRoutes(index);
  for (const LogicalDevice &device : nodes_[index].devices()) {
    for (const Pdo &pdo : device.plan().sentByDrive())
      cobIds_.set(pdo.cobId & Frame::kLastId);
    for (const Pdo &pdo : device.plan().receivedByDrive())
      cobIds_.set(pdo.cobId & Frame::kLastId);
  }
}

void Master::addPdoRoutes(uint8_t index) {
  const std::span<const LogicalDevice> devices = std::as_const(nodes_[index]).devices();
  for (size_t i = 0; i < devices.size(); ++i) {
    const std::span<const Pdo> pdos = devices[i].plan().sentByDrive();
    for (size_t place = 0; place < pdos.size(); ++place)
      routes_[pdos[place].cobId & Frame::kLastId] = {Kind::Tpdo, index, static_cast<uint8_t>(place),
                                                     static_cast<uint8_t>(i)};
  }
}

/// A node has, and keeps, other PDOs than planned.
void Master::useOtherPdos(size_t index) {
  addPdoRoutes(static_cast<uint8_t>(index));
  cyclicBits_[index] = nodes_[index].cyclicBits();
  uint64_t bits = kSyncBits;
  for (const uint32_t one : cyclicBits_)
    bits += one;
  if (config_.bitsPerCycle > 0 && bits > config_.bitsPerCycle)
    news_.say("with PDOs that nodes do not let be changed, SYNC and PDOs need ",
              static_cast<uint32_t>(bits), " bits of a cycle, which has ",
              static_cast<uint32_t>(config_.bitsPerCycle));
}

void Master::executeStart() {
  port_->beginCycle();
  watchBus();
  for (Node &node : nodes_)
    node.beginReceive();
  syncs_ = 0;
  // Who waits for what nodes say at SYNC must not take what they said at the one before for it.
  const bool waits = config_.readWaitNs > 0;
  if (waits)
    receiveAll();
  if (config_.givesSync && !isLost(state_))
    giveSync();
  if (!waits)
    receiveAll();
  judgeSync();
  judgeSetValues();
  awaitPdos();
  // Nodes answer the SYNC of somebody else as well.
  const uint32_t syncs = syncs_ + (config_.givesSync ? 1 : 0);
  bool duplicate = false;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    Node &node = nodes_[i];
    if (node.takePlanChange())
      useOtherPdos(i);
    node.endReceive(syncs, news_);
    duplicate = duplicate || (node.started() && node.duplicate());
  }
  if (duplicate)
    for (Node &node : nodes_)
      node.lose(NodeLoss::Duplicate, news_);
  serveLss();
}

/// One node after the other: only one may be selected at a time.
void Master::serveLss() {
  lss_.cycle();
  if (lssNode_ != kNobody && !lss_.busy())
    numbered();
  if (lssNode_ == kNobody && resetNmt_ == NmtCommand::None)
    numberNext();
  const bool busy = lssNode_ != kNobody || resetNmt_ != NmtCommand::None ||
                    std::any_of(nodes_.begin(), nodes_.end(),
                                [](const Node &node) { return node.wantsNumber(); });
  for (Node &node : nodes_)
    node.setLssBusy(busy);
}

/// Who is booting does not answer: it may be the next one.
bool Master::awaitsBootUps() {
  const bool boots =
      std::any_of(nodes_.begin(), nodes_.end(), [](const Node &node) { return node.boots(); });
  toBoot_ = boots && toBoot_ > 0 ? toBoot_ - 1 : 0;
  return toBoot_ > 0;
}

void Master::numberNext() {
  if (awaitsBootUps())
    return;
  for (size_t i = 0; i < nodes_.size(); ++i) { // who is looked for again has its turn
    const size_t next = (nextLss_ + i) % nodes_.size();
    if (!nodes_[next].wantsNumber())
      continue;
    lssNode_ = next;
    nextLss_ = (next + 1) % nodes_.size();
    lss_.begin(nodes_[next].seek());
    return;
  }
}

/// A node that had another number begins with its new one when it is reset by the old one; but not
/// if one of ours that works would be reset with it.
void Master::numbered() {
  LssOutcome outcome = lss_.outcome();
  if (outcome.kind == LssOutcome::Kind::Assigned && outcome.before != lss::kNoNode) {
    const bool used = std::any_of(nodes_.begin(), nodes_.end(), [&outcome](const Node &node) {
      return node.number() == outcome.before && node.inUse();
    });
    if (used) {
      outcome.kind = LssOutcome::Kind::InUse;
    } else {
      resetNmt_ = NmtCommand::ResetCommunication;
      resetNode_ = outcome.before;
    }
  }
  nodes_[lssNode_].numbered(outcome, news_);
  lssNode_ = kNobody;
}

void Master::sendLss() {
  if (resetNmt_ != NmtCommand::None && send(nmtFrame(resetNmt_, resetNode_), SendClass::Service)) {
    resetNmt_ = NmtCommand::None;
    toBoot_ = cyclesOf(kBootTime, config_.cycle);
    for (Node &node : nodes_)
      if (node.number() == resetNode_)
        node.resetByLss();
  }
  if (lss_.pending() && send(lss_.nextFrame(), SendClass::Service))
    lss_.sent();
}

void Master::giveSync() {
  (void)send(makeFrame(kSyncCobId, 0), SendClass::Process);
  for (Node &node : nodes_)
    node.syncPassed();
}

/// What the port knows is more: that there is no such interface, or that it has another bit rate.
void Master::sayLost() {
  if (state_ == ControllerState::BusOff)
    news_.say("bus-off: the controller takes no part any more");
  else
    news_.say(port_->problem().empty() ? "the interface is down" : port_->problem());
}

void Master::watchBus() {
  const ControllerState before = state_;
  state_ = port_->state();
  const PortCounters counters = port_->counters();
  const bool restarted = counters.restarts > restarts_; // perhaps it was off between two cycles
  restarts_ = counters.restarts;
  if (isLost(state_) || restarted)
    for (Node &node : nodes_) {
      node.lose(NodeLoss::Bus, news_);
      for (LogicalDevice &device : node.devices())
        device.forgetSent();
    }
  if (isLost(state_)) {
    if (!isLost(before))
      sayLost();
  } else if (isLost(before) || restarted) {
    news_.say("the bus is back");
  } else if (state_ == ControllerState::Passive && before != ControllerState::Passive) {
    news_.say("the controller is error-passive: check wiring, termination and bit rate");
  }
  if (counters.dropped > dropped_)
    news_.say(static_cast<uint32_t>(counters.dropped - dropped_),
              " received frames were lost for want of room");
  dropped_ = counters.dropped;
  if (counters.unlogged > 0 && !saidUnlogged_) {
    news_.say("the log of the bus lacks frames: its file is too slow, or the disk is full");
    saidUnlogged_ = true;
  }
}

void Master::receiveAll() {
  size_t count = early_;
  early_ = 0;
  count += port_->receive(std::span(frames_).subspan(count));
  count = std::min(count, frames_.size());
  for (size_t i = 0; i < count; ++i)
    take(frames_[i].frame);
  if (count < frames_.size())
    return;
  ++counters_.overloads;
  if (!saidOverload_)
    news_.say("more frames than ", static_cast<uint32_t>(count),
              " in a cycle: the rest is read in the next ones");
  saidOverload_ = true;
}

/// Nobody waits for a node that is silent: it delays its first cycles only.
bool Master::lacksPdos() const {
  return std::any_of(nodes_.begin(), nodes_.end(),
                     [](const Node &node) { return node.communication() && !node.pdosComplete(); });
}

void Master::awaitPdos() {
  const int64_t now = config_.readWaitNs > 0 && !isLost(state_) ? port_->monotonicNs() : -1;
  if (now < 0)
    return;
  const int64_t end = now + config_.readWaitNs;
  for (size_t room = frames_.size(); lacksPdos();) {
    const bool any = room > 0 && port_->wait(end);
    const size_t count = any ? port_->receive(std::span(frames_).first(room)) : 0;
    // What comes may be nobody's: the port's own frames, which have left it.
    if (!any || (count == 0 && port_->monotonicNs() >= end)) {
      ++counters_.readsLate;
      return;
    }
    for (size_t i = 0; i < count; ++i)
      take(frames_[i].frame);
    room -= count;
  }
}

void Master::take(const Frame &frame) {
  ++counters_.framesReceived;
  if (frame.id > Frame::kLastId || frame.length > Frame::kMostBytes || frame.remote)
    return;
  const Route route = routes_[frame.id];
  switch (route.kind) {
  case Kind::None:
    break;
  case Kind::Tpdo:
    nodes_[route.node].devices()[route.device].tpdo(route.place, frame);
    break;
  case Kind::Sdo:
    nodes_[route.node].sdoAnswer(frame);
    break;
  case Kind::Heartbeat:
    nodes_[route.node].heartbeat(frame);
    break;
  case Kind::Emcy:
    nodes_[route.node].emcy(frame, news_);
    break;
  case Kind::Lss:
    lss_.received(frame);
    break;
  case Kind::Sync:
    ++syncs_;
    for (Node &node : nodes_)
      node.syncPassed();
    break;
  }
}

void Master::judgeSync() {
  if (config_.givesSync) {
    counters_.foreignSyncs += syncs_;
    if (syncs_ > 0 && !saidForeign_)
      news_.say("somebody else gives SYNC, too: see SyncProducer");
    saidForeign_ = saidForeign_ || syncs_ > 0;
    return;
  }
  syncSeen_ = syncSeen_ || syncs_ > 0;
  if (!syncSeen_)
    return;
  counters_.syncMissed += syncs_ == 0 ? 1 : 0;
  counters_.syncTwice += syncs_ > 1 ? 1 : 0;
  missedInRow_ = syncs_ == 0 ? std::min(missedInRow_ + 1, kMostMissed + 1) : 0;
  if (missedInRow_ == kMostMissed)
    news_.say("no SYNC for ", kMostMissed, " cycles");
}

/// PDOs that are still waiting when the next cycle begins come too late for its SYNC.
void Master::judgeSetValues() {
  const bool late = port_->unconfirmed() > 0;
  counters_.setValuesLate += late ? 1 : 0;
  lateInRow_ = late ? std::min(lateInRow_ + 1, kMostLate + 1) : 0;
  if (lateInRow_ == kMostLate)
    news_.say("set values are late: the bus is too slow for this cycle");
  for (Node &node : nodes_)
    node.setLate(lateInRow_ >= kMostLate);
}

uint32_t Master::awaitSync(int64_t monotonicNs) {
  uint32_t syncs = 0;
  for (;;) {
    const size_t count = port_->receive(std::span(frames_).subspan(early_));
    for (size_t i = 0; i < count && early_ < frames_.size(); ++i)
      syncs += frames_[early_++].frame.id == kSyncCobId ? 1 : 0;
    if (syncs > 0 || early_ == frames_.size() || !port_->wait(monotonicNs))
      return syncs;
  }
}

bool Master::send(const Frame &frame, SendClass sendClass) {
  const SendResult result = port_->send(frame, sendClass);
  counters_.sendQueueFull += result == SendResult::QueueFull ? 1 : 0;
  counters_.framesSent += result == SendResult::Sent ? 1 : 0;
  return result == SendResult::Sent;
}

void Master::executeEnd() {
  for (Node &node : nodes_)
    node.makePdos();
  if (isLost(state_))
    return;
  sendPdos();
  sendCommands();
  sendLss();
  sendHeartbeat();
  sendTime();
  sendSdos();
}

void Master::sendPdos() {
  for (Node &node : nodes_) {
    for (LogicalDevice &device : node.devices())
      for (size_t place = 0; place < device.rpdoCount(); ++place)
        if (device.rpdoDue(place))
          device.rpdoSent(place, send(device.rpdo(place), SendClass::Process));
    node.endOfPdos(news_);
  }
}

void Master::sendCommands() {
  for (Node &node : nodes_) {
    if (node.nmt() != NmtCommand::None &&
        send(nmtFrame(node.nmt(), node.number()), SendClass::Service))
      node.nmtSent();
    if (node.supervision().asks() && send(node.supervision().question(), SendClass::Service))
      node.supervision().asked();
  }
}

void Master::sendHeartbeat() {
  if (toHeartbeat_ > 0) {
    --toHeartbeat_;
    return;
  }
  Frame frame = makeFrame(kHeartbeatBase + config_.node, 1);
  frame.data[0] = nmt::kOperational;
  if (send(frame, SendClass::Service))
    toHeartbeat_ = heartbeatCycles_ - 1;
}

/// TIME_OF_DAY: milliseconds of the day and days since 1984-01-01. [CiA 301] A bus without a clock
/// of that kind begins there with the run.
void Master::sendTime() {
  ++cycles_;
  if (timeCycles_ == 0)
    return;
  if (toTime_ > 0) {
    --toTime_;
    return;
  }
  constexpr int64_t kSecondMs = 1000;
  constexpr int64_t kDayMs = 86'400 * kSecondMs;
  constexpr int64_t kBeginDay = 5113; // of 1984, since 1970
  const int64_t utc = port_->utcNs();
  const int64_t ms =
      utc >= 0
          ? utc / 1'000'000
          : kBeginDay * kDayMs +
                static_cast<int64_t>(static_cast<double>(cycles_ - 1) * config_.cycle * 1e3 + 0.5);
  Frame frame = makeFrame(kTimeId, 6);
  writeNumber(frame, 0, 4, static_cast<uint32_t>(ms % kDayMs));
  writeNumber(frame, 4, 2, static_cast<uint32_t>(std::max<int64_t>(ms / kDayMs - kBeginDay, 0)));
  if (send(frame, SendClass::Service))
    toTime_ = timeCycles_ - 1;
}

/// What is left of the cycle beside SYNC and the PDOs of the nodes that have started.
uint32_t Master::roomForSdos() const {
  uint64_t bits = kSyncBits;
  bool all = true;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    bits += nodes_[i].started() ? cyclicBits_[i] : 0;
    all = all && nodes_[i].started();
  }
  if (all || config_.bitsPerCycle == 0)
    return config_.sdoPerCycle;
  return std::max(config_.sdoPerCycle, sdosThatFit(config_.bitsPerCycle, bits));
}

/// As many as the bus has room for; each node in its turn.
void Master::sendSdos() {
  uint32_t room = roomForSdos();
  size_t idle = 0; // nodes in a row without a question
  while (room > 0 && idle < nodes_.size()) {
    SdoClient &sdo = nodes_[nextSdo_].sdo();
    nextSdo_ = (nextSdo_ + 1) % nodes_.size();
    if (!sdo.pending()) {
      ++idle;
      continue;
    }
    if (!send(sdo.nextFrame(), SendClass::Service))
      return;
    sdo.sent();
    idle = 0;
    --room;
  }
}

void Master::problem(bus::Message &text) const {
  if (state_ == ControllerState::BusOff)
    text.set("bus-off: the CAN controller takes no part any more");
  else if (state_ == ControllerState::Down)
    text.set(port_->problem().empty() ? "the CAN interface is not there or not up"
                                      : port_->problem());
  else if (missedInRow_ >= kMostMissed)
    text.set("no SYNC from the node that gives it");
}

} // namespace stride::can
