#include "drivers/can/master/logical_device.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/power.hpp"
#include "drivers/can/master/texts.hpp"

#include <algorithm>
#include <span>

namespace stride::can {
namespace {

constexpr double kRefresh = 0.1; ///< RPDOs by event go out at least so often. [s]
constexpr uint8_t kMostWrong = 3;
constexpr uint32_t kMostFailedSends = 2;

uint8_t placeBit(size_t place) { return static_cast<uint8_t>(1U << place); }

} // namespace

LogicalDevice::LogicalDevice(const NodeConfig &config, size_t place)
    : kind_(config.kind), io_(config.io), configured_(config.device(place).plan),
      plan_(configured_), drive_(config.device(place).drive, configured_),
      parameters_(config.device(place).parameters, configured_.axis),
      refreshCycles_(cyclesOf(kRefresh, config.cycle)), pdoTimeout_(config.pdoTimeout),
      needed_(neededPdos()) {}

/// The TPDOs without which nothing is known of it.
uint8_t LogicalDevice::neededPdos() const {
  uint8_t needed = 0;
  for (size_t i = 0; i < plan_.tpdoCount; ++i) {
    const Pdo &pdo = plan_.tpdos[i];
    const bool state =
        std::any_of(pdo.mapped().begin(), pdo.mapped().end(), [](const PdoEntry &entry) {
          const Signal signal = signalOf(entry.object);
          return signal == Signal::Statusword || signal == Signal::EncoderPosition;
        });
    if (pdo.synchronous() || state || isIo())
      needed = needed | placeBit(i);
  }
  return needed;
}

/// FALSE: the frame has another length than it should.
bool LogicalDevice::takeOver(size_t place, const Frame &frame) {
  const Pdo &pdo = plan_.tpdos[place];
  if (!isIo())
    return decode(pdo, frame, signals_);
  if (frame.length != pdo.length())
    return false;
  if (io_.exchange != nullptr)
    io_.exchange->inputs.write(io_.tpdoAt[place], frame.bytes());
  return true;
}

Frame LogicalDevice::rpdoFrame(size_t place) const {
  const Pdo &pdo = plan_.rpdos[place];
  if (!isIo())
    return encode(pdo, signals_);
  Frame frame = makeFrame(pdo.cobId, pdo.length());
  if (io_.exchange != nullptr)
    io_.exchange->outputs.read(io_.rpdoAt[place], std::span(frame.data).first(frame.length));
  return frame;
}

void LogicalDevice::showIo(bool works) noexcept {
  if (!isIo() || io_.exchange == nullptr)
    return;
  if (works)
    io_.exchange->begun.store(true, std::memory_order_relaxed);
  io_.exchange->works.store(works, std::memory_order_release);
}

void LogicalDevice::tpdo(size_t place, const Frame &frame) {
  if (place >= plan_.tpdoCount) // of the start-up before
    return;
  if (!takeOver(place, frame)) {
    if (wrongLength_[place] < kMostWrong)
      ++wrongLength_[place];
    return;
  }
  wrongLength_[place] = 0;
  seen_ = seen_ | placeBit(place);
  atSync_[place] = true;
  if (arrived_[place] < UINT8_MAX)
    ++arrived_[place];
}

/// Synchronous TPDOs: one for each SYNC. Late ones come with the next.
void LogicalDevice::countPdos(uint32_t syncs) {
  bool all = true;
  bool any = false;
  for (size_t i = 0; i < plan_.tpdoCount; ++i) {
    if (!plan_.tpdos[i].synchronous())
      continue;
    any = true;
    all = all && arrived_[i] > 0;
    balances_[i].count(arrived_[i], std::max(syncs, 1U));
  }
  if (any)
    missing_ = all ? 0 : std::min(missing_ + 1, pdoTimeout_);
}

/// Each by itself: the statusword may have a PDO that is wrong beside one that is right.
bool LogicalDevice::wrongLength() const {
  return std::any_of(wrongLength_.begin(), wrongLength_.end(),
                     [](uint8_t inARow) { return inARow >= kMostWrong; });
}

bool LogicalDevice::duplicate() const {
  return std::any_of(balances_.begin(), balances_.end(),
                     [](const PdoBalance &balance) { return balance.second(); });
}

bool LogicalDevice::pdosComplete() const {
  for (size_t i = 0; i < plan_.tpdoCount; ++i)
    if (plan_.tpdos[i].synchronous() && !atSync_[i])
      return false;
  return true;
}

void LogicalDevice::makePdos(bool works) {
  if (!works) {
    for (Rpdo &one : rpdos_)
      one.due = false;
    return;
  }
  if (kind_ == NodeConfig::Kind::Drive)
    drive_.write(signals_);
  for (size_t i = 0; i < plan_.rpdoCount; ++i) {
    const Pdo &pdo = plan_.rpdos[i];
    Rpdo &one = rpdos_[i];
    one.frame = rpdoFrame(i);
    if (one.refresh > 0)
      --one.refresh;
    one.due = pdo.synchronous() || !one.known || one.frame != one.last || one.refresh == 0;
  }
}

void LogicalDevice::rpdoSent(size_t place, bool taken) {
  Rpdo &one = rpdos_[place];
  one.due = !taken;
  one.known = taken;
  if (!taken)
    return;
  one.last = one.frame;
  one.refresh = refreshCycles_;
}

void LogicalDevice::forgetSent() {
  for (Rpdo &one : rpdos_)
    one.known = false;
}

bool LogicalDevice::endOfPdos() {
  const bool failed =
      std::any_of(rpdos_.begin(), rpdos_.end(), [](const Rpdo &one) { return one.due; });
  const uint32_t before = failedSends_;
  failedSends_ = failed ? std::min(failedSends_ + 1, kMostFailedSends) : 0;
  return failedSends_ == kMostFailedSends && before < kMostFailedSends;
}

bool LogicalDevice::sendsFail() const { return failedSends_ >= kMostFailedSends; }

void LogicalDevice::beginStartUp() {
  seen_ = 0;
  facts_ = {};
  setPlan(configured_);
}

void LogicalDevice::setPlan(const DrivePlan &plan) {
  plan_ = plan;
  needed_ = neededPdos();
}

void LogicalDevice::started() {
  if (kind_ == NodeConfig::Kind::Drive)
    drive_.begin(facts_, signals_);
  for (Rpdo &one : rpdos_)
    one = {};
}

void LogicalDevice::reset() {
  drive_.end();
  parameters_.clear();
  fault_ = before_ = saidStuck_ = joined_ = false;
  missing_ = failedSends_ = 0;
  wrongLength_ = {};
  balances_ = {};
  seen_ = 0;
}

void LogicalDevice::readDrive(uint16_t told, bool reachable, uint8_t node, bus::News &news) {
  drive_.reach(reachable);
  drive_.read(signals_, told);
  before_ = fault_;
  fault_ = drive_.fault();
  if (drive_.velocityDoubtful())
    news.say("node ", uint32_t{node}, AxisText(plan_.axis),
             ": its velocity (606Ch) does not fit its positions (6064h): check velocity_scale");
  if (drive_.stuck() && !saidStuck_)
    news.say("node ", uint32_t{node}, AxisText(plan_.axis), " stays in '",
             nameOf(drive_.powerState()), "' whatever it is told");
  saidStuck_ = drive_.stuck();
}

} // namespace stride::can
