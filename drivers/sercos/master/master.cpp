#include "drivers/sercos/master/master.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

constexpr double kPatience = 2; // s
/// Phase 1: that a drive is asked before it counts as missing.
constexpr uint32_t kMostTries = 3;

} // namespace

Master::Master(const MasterConfig &config, std::unique_ptr<Ring> ring)
    : config_(config), ring_(std::move(ring)), wanted_(config.drives.size()),
      reset_(config.drives.size()), timings_(config.drives.size()), slots_(config.drives.size()),
      cycleUs_(static_cast<uint32_t>(std::clamp(config.cycle * 1e6 + 0.5, 1.0, 4e9))),
      patience_(cyclesOf(kPatience, config.cycle)), light_(config.light) {
  slaves_.reserve(config.drives.size());
  for (const DriveConfig &drive : config.drives)
    slaves_.emplace_back(drive);
  sent_.periodNs = std::max<int64_t>(static_cast<int64_t>(config.cycle * 1e9 + 0.5), 1);
  ring_->setBaudRate(static_cast<uint8_t>(config.megabits));
  ring_->setLight(light_);
}

void Master::setOpticalPower(uint8_t percent) {
  light_ = std::min<uint8_t>(percent, 100);
  ring_->setLight(light_);
}

void Master::executeStart() {
  answers_.count = 0;
  ring_->cycle(sent_, answers_);
  const uint8_t answering =
      sent_.mdt && sent_.mdtAddress != kBroadcast ? sent_.mdtAddress : kNoAddress;
  ++waited_;
  judgeMst();
  switch (phase_) {
  case Phase::Zero:
    phaseZero();
    break;
  case Phase::One:
    phaseOne(answering);
    break;
  case Phase::Two:
    phaseTwo(answering);
    followDrives();
    break;
  default:
    for (size_t i = 0; i < slaves_.size() && phase_ >= Phase::Three; ++i)
      if (wanted_[i])
        takeAt(i);
    followDrives();
    break;
  }
}

void Master::executeEnd() {
  std::fill(reset_.begin(), reset_.end(), false);
  sent_.mst = true;
  sent_.phase = phase_;
  sent_.mdt = false;
  switch (phase_) {
  case Phase::Zero:
    break;
  case Phase::One:
    askPhaseOne();
    break;
  case Phase::Two:
    askPhaseTwo();
    break;
  default:
    fillMdt();
    break;
  }
}

bus::StartUp Master::init(size_t drive, uint16_t &progress, bus::Message &message) {
  constexpr std::array<uint16_t, 5> kBegin = {0, 10, 20, 50, 80};
  constexpr std::array<uint16_t, 5> kSteps = {9, 9, 29, 29, 19};
  Slave &slave = slaves_[drive];
  if (slave.failed()) {
    message = slave.fault();
    return bus::StartUp::Failed;
  }
  if (down_) {
    const bool byOne =
        std::any_of(slaves_.begin(), slaves_.end(), [](const Slave &one) { return one.failed(); });
    if (byOne)
      return bus::StartUp::Busy; // that one says why
    message = reason_;
    return bus::StartUp::Failed;
  }
  if (phase_ == Phase::Zero) {
    wanted_[drive] = true;
  } else if (!wanted_[drive]) {
    message.set("it takes no part in the ring since that has started: SMC_ResetAxisGroup "
                "starts it with all drives");
    return bus::StartUp::Failed;
  }
  if (slave.started())
    return bus::StartUp::Started;
  const auto phase = static_cast<size_t>(phase_);
  uint32_t percent = slave.startUp().percent();
  if (phase_ == Phase::Zero)
    percent = returns_ * 100 / kMstReturns;
  else if (phase_ == Phase::One)
    percent = other_ * 100U / kLastAddress;
  progress = static_cast<uint16_t>(kBegin[phase] + kSteps[phase] * std::min(percent, 100U) / 100);
  return bus::StartUp::Busy;
}

void Master::reset(size_t drive) {
  reset_[drive] = true;
  bool all = true;
  for (size_t i = 0; i < slaves_.size(); ++i)
    all = all && (reset_[i] || !wanted_[i]);
  if (all || down_)
    restart();
  else if (slaves_[drive].started())
    slaves_[drive].start(); // its torque goes off; the ring goes on
}

void Master::restart() {
  for (Slave &slave : slaves_)
    slave.clear();
  std::fill(wanted_.begin(), wanted_.end(), false);
  reason_.set();
  down_ = false;
  enter(Phase::Zero);
}

void Master::commandPhase(Phase phase) {
  commanded_ = std::min(phase, Phase::Four);
  if (commanded_ >= phase_ || down_)
    return;
  bus::Message reason;
  reason.set("the program has commanded phase ", static_cast<uint32_t>(phase));
  fall(reason);
}

void Master::enter(Phase phase) {
  phase_ = phase;
  waited_ = 0;
  returns_ = 0;
  tries_ = 0;
  other_ = 0;
  asked_ = nextWanted(0);
  if (phase >= Phase::Two)
    for (size_t i = 0; i < slaves_.size(); ++i)
      if (wanted_[i])
        slaves_[i].enter(phase);
}

void Master::fall(const bus::Message &reason) {
  const bool operates = std::any_of(slaves_.begin(), slaves_.end(),
                                    [](const Slave &slave) { return slave.started(); });
  if (operates)
    news_.say("the ring falls to phase 0: ", reason.text());
  for (Slave &slave : slaves_)
    slave.leave();
  reason_ = reason;
  down_ = true;
  ++counters_.ringFalls;
  enter(Phase::Zero);
}

void Master::fallBy(size_t drive, std::string_view what) {
  bus::Message reason;
  reason.set("address ", uint32_t{addressOf(drive)}, " ", what);
  slaves_[drive].fail(reason);
  fall(reason);
}

void Master::problem(bus::Message &text) const {
  if (down_)
    text = reason_;
}

/// What is not seen twice in a row is not there; in phase 0 it may be so for a while.
void Master::judgeMst() {
  if (answers_.mstReturned || phase_ == Phase::Zero) {
    mstMisses_ = 0;
    return;
  }
  ++counters_.mstLost;
  if (++mstMisses_ < kMostMisses)
    return;
  bus::Message reason;
  reason.set(answers_.light ? "the MST does not come back" : "the ring is open, there is no light");
  fall(reason);
}

void Master::phaseZero() {
  if (down_)
    return;
  if (commanded_ == Phase::Zero || nextWanted(0) == slaves_.size()) {
    waited_ = 0; // the patience begins when somebody wants the ring
    return;
  }
  returns_ = answers_.light && answers_.mstReturned ? returns_ + 1 : 0;
  if (returns_ >= kMstReturns) {
    enter(Phase::One);
    return;
  }
  if (waited_ < patience_)
    return;
  bus::Message reason;
  if (!answers_.light)
    reason.set("the ring is open, there is no light");
  else if (answers_.mstDistorted)
    reason.set("the MST comes back distorted: does each drive have ", config_.megabits,
               " MBit/s and enough light?");
  else
    reason.set("the MST does not come back");
  fall(reason);
}

bool Master::isConfigured(uint8_t address) const {
  return std::any_of(slaves_.begin(), slaves_.end(),
                     [address](const Slave &slave) { return slave.config().address == address; });
}

size_t Master::nextWanted(size_t from) const {
  while (from < slaves_.size() && !wanted_[from])
    ++from;
  return from;
}

/// How many answers there are to an address, distorted ones included; `one`: one that is whole.
size_t Master::answersOf(uint8_t address, const DriveTelegram *&one) const {
  size_t count = 0;
  one = nullptr;
  for (const DriveTelegram &telegram : answers_.ats()) {
    if (!telegram.distorted && telegram.address != address)
      continue;
    ++count;
    if (!telegram.distorted && telegram.length >= kHeadBytes)
      one = &telegram;
  }
  return count;
}

void Master::phaseOne(uint8_t answering) {
  if (answering == kNoAddress)
    return;
  if (asked_ < slaves_.size()) {
    if (answering == addressOf(asked_))
      judgeConfigured();
    return;
  }
  const DriveTelegram *one = nullptr;
  if (!isConfigured(answering) && answersOf(answering, one) > 0)
    news_.say("address ", uint32_t{answering}, " answers and is not configured: it is left out");
  if (other_ >= kLastAddress && answering >= kLastAddress && commanded_ > Phase::One)
    enter(Phase::Two);
}

void Master::judgeConfigured() {
  const DriveTelegram *one = nullptr;
  const size_t count = answersOf(addressOf(asked_), one);
  if (count == 1 && one != nullptr) {
    tries_ = 0;
    asked_ = nextWanted(asked_ + 1);
    return;
  }
  if (++tries_ < kMostTries)
    return;
  if (count == 0)
    fallBy(asked_, "does not answer: is the drive on, with this address?");
  else if (count == 1)
    fallBy(asked_, "answers distorted");
  else
    fallBy(asked_, "answers more than once: two drives have this address");
}

void Master::askPhaseOne() {
  uint8_t address = 0;
  if (asked_ < slaves_.size()) {
    address = addressOf(asked_);
  } else {
    // All other addresses, one in a cycle; the last one until its answer is there.
    other_ = static_cast<uint16_t>(std::min<unsigned>(other_ + 1U, kLastAddress + 1U));
    while (other_ < kLastAddress && isConfigured(static_cast<uint8_t>(other_)))
      ++other_;
    address = static_cast<uint8_t>(std::min<unsigned>(other_, kLastAddress));
  }
  sent_.mdt = true;
  sent_.mdtAddress = address;
  sent_.mdtLength = kHeadBytes;
  std::fill_n(sent_.mdtData.begin(), kHeadBytes, uint8_t{0});
}

void Master::phaseTwo(uint8_t answering) {
  for (size_t i = 0; i < slaves_.size(); ++i)
    if (wanted_[i] && answering != kNoAddress && addressOf(i) == answering) {
      takeAt(i);
      break;
    }
}

/// Each drive in its turn.
void Master::askPhaseTwo() {
  sent_.mdt = true;
  sent_.mdtAddress = addressOf(asked_);
  sent_.mdtLength = kHeadBytes;
  slaves_[asked_].fill(std::span<uint8_t>(sent_.mdtData).first(kHeadBytes));
  asked_ = nextWanted(asked_ + 1);
  if (asked_ == slaves_.size())
    asked_ = nextWanted(0);
}

void Master::takeAt(size_t drive) {
  Slave &slave = slaves_[drive];
  const size_t length =
      phase_ == Phase::Two ? kHeadBytes : slave.config().settings.cyclic.at.bytes();
  const DriveTelegram *one = nullptr;
  (void)answersOf(addressOf(drive), one);
  if (one != nullptr && one->length == length) {
    slave.received(*one, news_);
    return;
  }
  slave.missed();
  ++counters_.atLost;
  const uint32_t most = slave.heard() ? kMostMisses : patience_;
  if (slave.misses() >= most)
    fallBy(drive, slave.heard() ? "sends no telegram any more" : "sends no telegram");
}

/// What the drives have done in this phase.
void Master::followDrives() {
  if (phase_ < Phase::Two)
    return;
  bool ready = true;
  bool awaits = false;
  bool planned = true;
  for (size_t i = 0; i < slaves_.size(); ++i) {
    const Slave &slave = slaves_[i];
    if (!wanted_[i])
      continue;
    if (slave.failed()) {
      const bus::Message reason = slave.fault();
      fall(reason);
      return;
    }
    ready = ready && slave.ready() && slave.heard();
    awaits = awaits || slave.awaitsPlan();
    planned = planned && (slave.awaitsPlan() || slave.ready());
  }
  if (awaits && planned)
    planTimes();
  if (ready)
    enterNext();
}

void Master::enterNext() {
  if (commanded_ <= phase_ && phase_ != Phase::Four)
    return;
  if (phase_ != Phase::Four) {
    enter(static_cast<Phase>(static_cast<unsigned>(phase_) + 1));
    return;
  }
  for (size_t i = 0; i < slaves_.size(); ++i)
    if (wanted_[i] && !slaves_[i].started())
      slaves_[i].start();
}

void Master::planTimes() {
  size_t count = 0;
  for (size_t i = 0; i < slaves_.size(); ++i)
    if (wanted_[i])
      timings_[count++] = slaves_[i].startUp().timing();
  timing_ = planRing(std::span<const DriveTiming>(timings_).first(count), config_.megabits,
                     cycleUs_, std::span<DriveSlot>(slots_).first(count));
  if (!timing_.fits) {
    bus::Message reason;
    reason.set("the telegrams need ", timing_.neededUs, " us of the cycle of ", cycleUs_,
               " us with what the drives say of their times");
    fall(reason);
    return;
  }
  // Each slot to its drive, from the end so that none is overwritten before it is used.
  for (size_t i = slaves_.size(); i-- > 0;)
    if (wanted_[i])
      slots_[i] = slots_[--count];
  for (size_t i = 0; i < slaves_.size(); ++i)
    if (wanted_[i])
      slaves_[i].plan({cycleUs_, timing_, slots_[i]});
}

void Master::fillMdt() {
  sent_.mdt = true;
  sent_.mdtAddress = kBroadcast;
  sent_.mdtLength = static_cast<uint16_t>(timing_.mdtLength);
  for (size_t i = 0; i < slaves_.size(); ++i)
    if (wanted_[i])
      slaves_[i].fill(
          std::span<uint8_t>(sent_.mdtData)
              .subspan(slots_[i].placeInMdt - 1U, slaves_[i].config().settings.cyclic.mdt.bytes()));
}

} // namespace stride::sercos
