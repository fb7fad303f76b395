#include "drivers/can/master/node.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/sdo_abort.hpp"
#include "drivers/can/master/texts.hpp"

#include <algorithm>

namespace stride::can {
namespace {

constexpr double kRefresh = 0.1; ///< RPDOs by event go out at least so often. [s]
constexpr uint32_t kMostWrong = 3;
constexpr uint32_t kMostFailedSends = 2;

uint8_t placeBit(size_t place) { return static_cast<uint8_t>(1U << place); }

/// The TPDOs without which nothing is known of a node.
uint8_t neededPdos(const NodeConfig &config) {
  const DrivePlan &plan = config.plan;
  uint8_t needed = 0;
  for (size_t i = 0; i < plan.tpdoCount; ++i) {
    const Pdo &pdo = plan.tpdos[i];
    const bool state =
        std::any_of(pdo.mapped().begin(), pdo.mapped().end(), [](const PdoEntry &entry) {
          const Signal signal = signalOf(entry.object);
          return signal == Signal::Statusword || signal == Signal::EncoderPosition;
        });
    if (pdo.synchronous() || state || config.kind == NodeConfig::Kind::Io)
      needed = needed | placeBit(i);
  }
  return needed;
}

} // namespace

std::string_view describe(NodeLoss loss) {
  static constexpr std::array<std::string_view, 5> kTexts = {
      "",
      " has restarted in operation",
      " has left the state operational",
      " cannot be reached: the bus is off or the interface is down",
      " sends more than one node can: duplicate node id?",
  };
  return kTexts[static_cast<size_t>(loss)];
}

Node::Node(const NodeConfig &config)
    : config_(config), sdo_(config.plan.node, cyclesOf(config.sdoTimeout, config.cycle)),
      supervision_(config.plan.node), startUp_(config), drive_(config.drive, config.plan),
      parameters_(config.parameters), refreshCycles_(cyclesOf(kRefresh, config.cycle)),
      needed_(neededPdos(config)),
      seekCycles_(config.lss.wait > 0 ? cyclesOf(config.lss.wait, config.cycle) : 0),
      wantsNumber_(config.lss.wanted) {}

LssOrder Node::seek() {
  sought_ = std::max(sought_, 1U);
  lastSeek_ = sought_ > seekCycles_; // who has come in time is found by the last one at the latest
  return {config_.identity, config_.plan.node, config_.lss.bitRate, config_.lss.store};
}

void Node::numbered(const LssOutcome &outcome, bus::News &news) {
  const bool first = lss_.kind == LssOutcome::Kind::None;
  lss_ = outcome;
  if (outcome.kind == LssOutcome::Kind::NotFound && !lastSeek_) {
    if (first)
      news.say("node ", uint32_t{config_.plan.node},
               " does not answer by LSS yet: it is looked for again (lss_wait)");
    return;
  }
  wantsNumber_ = false;
  sought_ = 0;
  if (outcome.kind != LssOutcome::Kind::Assigned)
    return;
  if (outcome.before != lss::kNoNode) // it is still to be reset: who has booted so far is another
    supervision_.clear();
  boots_ = supervision_.bootUps() == 0;
  const uint32_t number = config_.plan.node;
  if (outcome.before == lss::kNoNode)
    news.say("node ", number, " has got its number by LSS");
  else
    news.say("node ", number, " has got its number by LSS, in place of ", uint32_t{outcome.before});
  if (outcome.notStored)
    news.say("node ", number, " cannot store its number: it is given to it at each start");
  if (outcome.noBitRate)
    news.say("node ", number, " does not take the bit rate by LSS: it keeps its own setting");
}

void Node::resetByLss() {
  supervision_.clear();
  boots_ = true;
}

/// FALSE: the frame has another length than it should.
bool Node::takeOver(size_t place, const Frame &frame) {
  const Pdo &pdo = config_.plan.tpdos[place];
  if (!isIo())
    return decode(pdo, frame, signals_);
  if (frame.length != pdo.length())
    return false;
  if (config_.io.exchange != nullptr)
    config_.io.exchange->inputs.write(config_.io.tpdoAt[place], frame.bytes());
  return true;
}

Frame Node::rpdoFrame(size_t place) const {
  const Pdo &pdo = config_.plan.rpdos[place];
  if (!isIo())
    return encode(pdo, signals_);
  Frame frame = makeFrame(pdo.cobId, pdo.length());
  if (config_.io.exchange != nullptr)
    config_.io.exchange->outputs.read(config_.io.rpdoAt[place],
                                      std::span(frame.data).first(frame.length));
  return frame;
}

void Node::showIo() noexcept {
  if (!isIo() || config_.io.exchange == nullptr)
    return;
  const bool works = communication();
  if (works)
    config_.io.exchange->begun.store(true, std::memory_order_relaxed);
  config_.io.exchange->works.store(works, std::memory_order_release);
}

void Node::tpdo(size_t place, const Frame &frame) {
  if (!takeOver(place, frame)) {
    wrongLength_ = std::min(wrongLength_ + 1, kMostWrong);
    return;
  }
  wrongLength_ = 0;
  seen_ = seen_ | placeBit(place);
  atSync_[place] = true;
  if (arrived_[place] < UINT8_MAX)
    ++arrived_[place];
}

void Node::emcy(const Frame &frame, bus::News &news) {
  const uint32_t before = emcy_.count();
  const uint16_t old = emcy_.code();
  emcy_.received(frame);
  if (emcy_.count() == before || phase_ == Phase::Idle)
    return;
  const Emcy &one = emcy_.message(0);
  const uint32_t number = config_.plan.node;
  if (one.code == 0)
    errors_.gone();
  if (one.code == 0 && old == 0)
    return;
  if (one.code == 0)
    news.say("node ", number, ": its error has gone");
  else
    news.say("node ", number,
             isCommunicationWarning(one.code) ? " warns: " : " reports: ", errorText(one.code),
             " (EMCY ", HexText(one.code, 4), ")");
  if (one.code != 0 && phase_ != Phase::Starting) // at the end of its start-up it is asked anyway
    errors_.ask();
}

void Node::beginReceive() { arrived_ = {}; }

void Node::endReceive(uint32_t syncs, bus::News &news) {
  sdo_.cycle();
  supervision_.cycle();
  boots_ = boots_ && supervision_.bootUps() == 0;
  if (sought_ > 0 && sought_ <= seekCycles_)
    ++sought_;
  if (phase_ == Phase::Failed)
    serveSdo(news);
  if (phase_ != Phase::Started)
    return;
  countPdos(syncs);
  watch(news);
  if (isDrive())
    watchDrive(news);
  serveSdo(news);
}

void Node::watchDrive(bus::News &news) {
  drive_.read(signals_, emcy_.code() != 0 ? emcy_.code() : errors_.code());
  drive_.reach(communication());
  if (drive_.fault() && !fault_)
    errors_.ask();
  else if (!drive_.fault())
    errors_.settle();
  if (fault_ && !drive_.fault())
    errors_.gone();
  fault_ = drive_.fault();
  if (drive_.velocityDoubtful())
    news.say("node ", uint32_t{config_.plan.node},
             ": its velocity (606Ch) does not fit its positions (6064h): check velocity_scale");
  if (drive_.stuck() && !saidStuck_)
    news.say("node ", uint32_t{config_.plan.node}, " stays in '", nameOf(drive_.powerState()),
             "' whatever it is told");
  saidStuck_ = drive_.stuck();
}

/// Synchronous TPDOs: one for each SYNC. Late ones come with the next.
void Node::countPdos(uint32_t syncs) {
  bool all = true;
  bool any = false;
  for (size_t i = 0; i < config_.plan.tpdoCount; ++i) {
    if (!config_.plan.tpdos[i].synchronous())
      continue;
    any = true;
    all = all && arrived_[i] > 0;
    balances_[i].count(arrived_[i], std::max(syncs, 1U));
  }
  if (any)
    missing_ = all ? 0 : std::min(missing_ + 1, config_.pdoTimeout);
}

bool Node::duplicate() const {
  return std::any_of(balances_.begin(), balances_.end(),
                     [](const PdoBalance &balance) { return balance.second(); });
}

bool Node::pdosComplete() const {
  for (size_t i = 0; i < config_.plan.tpdoCount; ++i)
    if (config_.plan.tpdos[i].synchronous() && !atSync_[i])
      return false;
  return true;
}

void Node::watch(bus::News &news) {
  if (loss_ == NodeLoss::None) {
    if (supervision_.bootUps() != bootUps_)
      lose(NodeLoss::Restarted, news);
    else if (supervision_.kind() != Supervision::Kind::None &&
             supervision_.state() != nmt::kOperational)
      lose(NodeLoss::LeftOperational, news);
  }
  silent_ = supervision_.lost() || missing_ >= config_.pdoTimeout || wrongLength_ >= kMostWrong;
  const uint32_t number = config_.plan.node;
  if (silent_ && !saidSilent_ && loss_ == NodeLoss::None) {
    if (wrongLength_ >= kMostWrong)
      news.say("node ", number, " sends PDOs of another length than they are configured");
    else if (supervision_.lost())
      news.say("node ", number, " is silent: no heartbeat");
    else
      news.say("node ", number, " is silent: no PDO for ", missing_, " cycles");
  } else if (!silent_ && saidSilent_ && loss_ == NodeLoss::None) {
    news.say("node ", number, " answers again");
  }
  saidSilent_ = silent_;
}

void Node::lose(NodeLoss loss, bus::News &news) {
  if (phase_ != Phase::Started || loss_ != NodeLoss::None)
    return;
  loss_ = loss;
  news.say("node ", uint32_t{config_.plan.node}, describe(loss),
           "; SMC_ResetAxisGroup or SMC3_ReinitDrive starts it anew");
}

bool Node::communication() const {
  return phase_ == Phase::Started && loss_ == NodeLoss::None && !silent_ && !late_ &&
         failedSends_ < kMostFailedSends;
}

bus::DriveStatus Node::status() const {
  bus::DriveStatus status = drive_.status();
  status.communication = communication();
  return status;
}

void Node::makePdos() {
  if (phase_ != Phase::Started) {
    for (Rpdo &one : rpdos_)
      one.due = false;
    return;
  }
  if (isDrive())
    drive_.write(signals_);
  for (size_t i = 0; i < config_.plan.rpdoCount; ++i) {
    const Pdo &pdo = config_.plan.rpdos[i];
    Rpdo &one = rpdos_[i];
    one.frame = rpdoFrame(i);
    if (one.refresh > 0)
      --one.refresh;
    one.due = pdo.synchronous() || !one.known || one.frame != one.last || one.refresh == 0;
  }
}

void Node::rpdoSent(size_t place, bool taken) {
  Rpdo &one = rpdos_[place];
  one.due = !taken;
  one.known = taken;
  if (!taken)
    return;
  one.last = one.frame;
  one.refresh = refreshCycles_;
}

void Node::endOfPdos(bus::News &news) {
  const bool failed =
      std::any_of(rpdos_.begin(), rpdos_.end(), [](const Rpdo &one) { return one.due; });
  const uint32_t before = failedSends_;
  failedSends_ = failed ? std::min(failedSends_ + 1, kMostFailedSends) : 0;
  if (failedSends_ == kMostFailedSends && before < kMostFailedSends && loss_ == NodeLoss::None)
    news.say("node ", uint32_t{config_.plan.node},
             " does not get its set values: the queue of the interface is full");
}

bus::StartUp Node::init(uint16_t &progress, bus::Message &message, bus::News &news) {
  if (phase_ == Phase::Started)
    return bus::StartUp::Started;
  if (phase_ != Phase::Starting) {
    reset();
    nmt_ = NmtCommand::None;
    phase_ = Phase::Starting;
    startUp_.begin();
    facts_ = {};
    seen_ = 0;
  }
  const bool arrived = (seen_ & needed_) == needed_;
  const bool lssBusy = lssBusy_ || wantsNumber_;
  const StartParts parts{config_, sdo_, supervision_, facts_, nmt_, arrived, lssBusy, lss_, boots_};
  const bus::StartUp result = startUp_.step(parts, message);
  progress = startUp_.progress();
  if (result == bus::StartUp::Failed)
    failed(message);
  else if (result == bus::StartUp::Started)
    started(news);
  return result;
}

/// An error that the node has may be why.
void Node::failed(bus::Message &message) {
  phase_ = Phase::Failed;
  if (emcy_.code() != 0) {
    message.append("; it reports: ");
    message.append(errorText(emcy_.code()));
    message.append(" (EMCY ");
    message.append(HexText(emcy_.code(), 4));
    message.append(")");
  }
  if (!sdo_.timedOut())
    errors_.begin();
}

void Node::started(bus::News &news) {
  phase_ = Phase::Started;
  errors_.begin();
  bootUps_ = supervision_.bootUps();
  if (isDrive())
    drive_.begin(facts_, signals_);
  for (Rpdo &one : rpdos_)
    one = {};
  sayLacks(news);
}

void Node::sayLacks(bus::News &news) const {
  const uint32_t number = config_.plan.node;
  if (isDrive() && !isExactPeriod(config_.cycle))
    news.say("node ", number, ": its interpolation period (60C2h) cannot be exactly the cycle");
  if (startUp_.lacksConsumer())
    news.say("node ", number,
             " has no consumer heartbeat (1016h): it does not notice when this program ends");
  if (startUp_.lacksHeartbeat())
    news.say("node ", number, " has no heartbeat (1017h): only its PDOs show that it is there");
  if (startUp_.lacksErrorValues())
    news.say("node ", number,
             " has no error values for its outputs (6206h, 6207h, 6443h, 6444h): without the "
             "controller they stay as they are, or do as the device likes");
}

void Node::reset() {
  if (phase_ != Phase::Idle) {
    nmt_ = NmtCommand::PreOperational;
    wantsNumber_ = config_.lss.wanted;
    lss_ = {};
    sought_ = 0;
  }
  phase_ = Phase::Idle;
  sdo_.clear();
  supervision_.clear();
  emcy_.clear();
  errors_.clear();
  drive_.end();
  parameters_.clear();
  user_ = SdoUser::None;
  loss_ = NodeLoss::None;
  fault_ = silent_ = saidSilent_ = saidStuck_ = false;
  missing_ = wrongLength_ = failedSends_ = 0;
  balances_ = {};
  seen_ = 0;
}

/// The SDO channel in operation: first what the drive needs, then its errors, then what programs
/// ask. Of a node that could not start only its errors.
void Node::serveSdo(bus::News &news) {
  if (user_ != SdoUser::None) {
    if (sdo_.state() == SdoClient::State::Busy)
      return;
    const SdoUser user = user_;
    user_ = SdoUser::None;
    if (user == SdoUser::Parameter) {
      parameters_.finished(sdo_);
      if (sdo_.state() == SdoClient::State::Busy) // the second half of a write
        user_ = SdoUser::Parameter;
    } else if (user == SdoUser::Errors) {
      errorsAnswered(news);
    } else {
      wishAnswered(news);
    }
    if (user_ != SdoUser::None)
      return;
  }
  if (!sdo_.pending()) // an abort
    serveNext();
}

void Node::serveNext() {
  const bool works = phase_ == Phase::Started;
  const bool there = loss_ == NodeLoss::None;
  const ObjectWish wish = works && there && isDrive() ? drive_.wish() : ObjectWish{};
  const ObjectWish error = there ? errors_.wish() : ObjectWish{};
  if (wish.kind != ObjectWish::Kind::None) {
    beginWish(wish, SdoUser::Drive);
  } else if (error.kind != ObjectWish::Kind::None) {
    beginWish(error, SdoUser::Errors);
  } else if (works && parameters_.wants()) {
    parameters_.begin(sdo_);
    user_ = sdo_.state() == SdoClient::State::Busy ? SdoUser::Parameter : SdoUser::None;
  }
}

ObjectAnswer Node::objectAnswer() const {
  ObjectAnswer answer{sdo_.state() == SdoClient::State::Done, 0};
  for (size_t i = 0; answer.done && wish_.kind == ObjectWish::Kind::Read && i < sdo_.size(); ++i)
    answer.value |= uint32_t{wishBytes_[i]} << 8 * i;
  return answer;
}

void Node::errorsAnswered(bus::News &news) {
  const bool missing = !sdo_.timedOut() && isMissing(sdo_.abortCode());
  errors_.answered(objectAnswer(), missing, config_.plan.node, {emcy_, drive_.errorCode()}, news);
}

void Node::wishAnswered(bus::News &news) {
  const ObjectAnswer answer = objectAnswer();
  drive_.answered(wish_, answer);
  const auto code = static_cast<uint16_t>(answer.value);
  if (wish_.object == object::kErrorCode && answer.done && code != 0 && code != emcy_.code())
    news.say("node ", uint32_t{config_.plan.node}, " has a fault: ", errorText(code),
             " (603Fh = ", HexText(code, 4), ")");
}

void Node::beginWish(const ObjectWish &wish, SdoUser user) {
  wish_ = wish;
  bool begun = false;
  if (wish.kind == ObjectWish::Kind::Read) {
    begun = sdo_.upload(wish.object, wishBytes_);
  } else {
    for (size_t i = 0; i < wishBytes_.size(); ++i)
      wishBytes_[i] = static_cast<uint8_t>(wish.value >> 8 * i);
    const size_t size = std::clamp<size_t>(wish.size, 1, wishBytes_.size());
    begun = sdo_.download(wish.object, std::span<const uint8_t>(wishBytes_).first(size));
  }
  user_ = begun ? user : SdoUser::None;
}

} // namespace stride::can
