#include "drivers/can/master/node.hpp"

#include "drivers/can/master/frames.hpp"
#include "drivers/can/master/sdo_abort.hpp"
#include "drivers/can/master/texts.hpp"
#include "drivers/can/plan/bus_load.hpp"

#include <algorithm>

namespace stride::can {
namespace {

std::vector<LogicalDevice> devicesOf(const NodeConfig &config) {
  std::vector<LogicalDevice> devices;
  for (size_t i = 0; i < config.devices(); ++i)
    devices.emplace_back(config, i);
  return devices;
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
    : config_(config), devices_(devicesOf(config)),
      sdo_(config.plan.node, cyclesOf(config.sdoTimeout, config.cycle)),
      supervision_(config.plan.node), startUp_(config),
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

void Node::beginReceive() {
  stepped_ = false;
  for (LogicalDevice &device : devices_)
    device.beginReceive();
}

void Node::syncPassed() {
  for (LogicalDevice &device : devices_)
    device.syncPassed();
}

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
  for (LogicalDevice &device : devices_)
    device.countPdos(syncs);
  watch(news);
  if (isDrive())
    watchDrives(news);
  serveSdo(news);
}

void Node::watchDrives(bus::News &news) {
  const uint16_t told = emcy_.code() != 0 ? emcy_.code() : errors_.code();
  const bool reachable = communication();
  bool came = false;
  bool went = false;
  bool fault = false;
  for (LogicalDevice &device : devices_) {
    device.readDrive(told, reachable, config_.plan.node, news);
    came = came || device.faultCame();
    went = went || device.faultWent();
    fault = fault || device.drive().fault();
  }
  if (came)
    errors_.ask();
  if (fault)
    return;
  errors_.settle();
  if (went)
    errors_.gone();
}

bool Node::duplicate() const {
  return std::any_of(devices_.begin(), devices_.end(),
                     [](const LogicalDevice &device) { return device.duplicate(); });
}

bool Node::pdosComplete() const {
  return std::all_of(devices_.begin(), devices_.end(),
                     [](const LogicalDevice &device) { return device.pdosComplete(); });
}

void Node::watch(bus::News &news) {
  if (loss_ == NodeLoss::None) {
    if (supervision_.bootUps() != bootUps_)
      lose(NodeLoss::Restarted, news);
    else if (supervision_.kind() != Supervision::Kind::None &&
             supervision_.state() != nmt::kOperational)
      lose(NodeLoss::LeftOperational, news);
  }
  const auto wrong = std::any_of(devices_.begin(), devices_.end(),
                                 [](const LogicalDevice &device) { return device.wrongLength(); });
  const auto mute = std::find_if(devices_.begin(), devices_.end(),
                                 [](const LogicalDevice &device) { return device.silent(); });
  silent_ = supervision_.lost() || mute != devices_.end() || wrong;
  const uint32_t number = config_.plan.node;
  if (silent_ && !saidSilent_ && loss_ == NodeLoss::None) {
    if (wrong)
      news.say("node ", number, " sends PDOs of another length than they are configured");
    else if (supervision_.lost())
      news.say("node ", number, " is silent: no heartbeat");
    else
      news.say("node ", number, " is silent: no PDO for ", mute->missing(), " cycles");
  } else if (!silent_ && saidSilent_ && loss_ == NodeLoss::None) {
    news.say("node ", number, " answers again");
  }
  saidSilent_ = silent_;
}

void Node::lose(NodeLoss loss, bus::News &news) {
  if (phase_ != Phase::Started || loss_ != NodeLoss::None)
    return;
  loss_ = loss;
  for (LogicalDevice &device : devices_) // in this cycle already
    device.drive().reach(false);
  news.say("node ", uint32_t{config_.plan.node}, describe(loss),
           "; SMC_ResetAxisGroup or SMC3_ReinitDrive starts it anew");
}

bool Node::communication() const {
  return phase_ == Phase::Started && loss_ == NodeLoss::None && !silent_ && !late_ &&
         std::none_of(devices_.begin(), devices_.end(),
                      [](const LogicalDevice &device) { return device.sendsFail(); });
}

bus::DriveStatus Node::status(size_t place) const {
  const LogicalDevice &device = devices_[place];
  bus::DriveStatus status = device.drive().status();
  status.communication = communication() && device.joined();
  return status;
}

/// Who is not heard may not hear either: what goes out when it changes is said in each cycle.
void Node::makePdos() {
  for (LogicalDevice &device : devices_) {
    if (silent_ || device.missing() > 0)
      device.forgetSent();
    device.makePdos(phase_ == Phase::Started);
  }
}

void Node::endOfPdos(bus::News &news) {
  bool failed = false;
  for (LogicalDevice &device : devices_)
    failed = device.endOfPdos() || failed;
  if (failed && loss_ == NodeLoss::None)
    news.say("node ", uint32_t{config_.plan.node},
             " does not get its set values: the queue of the interface is full");
}

bool Node::takePlanChange() {
  const bool changed = planChanged_;
  planChanged_ = false;
  return changed;
}

uint32_t Node::cyclicBits() const {
  uint32_t bits = startUp_.unusedBits();
  for (const LogicalDevice &device : devices_)
    bits += can::cyclicBits(device.plan());
  return bits;
}

bus::StartUp Node::init(uint16_t &progress, bus::Message &message, bus::News &news, size_t place) {
  const auto bit = static_cast<uint8_t>(1U << place);
  if (phase_ == Phase::Failed && (told_ & bit) == 0) { // by what another one has found
    told_ = told_ | bit;
    message = failure_;
    return bus::StartUp::Failed;
  }
  const bus::StartUp result =
      phase_ == Phase::Started ? bus::StartUp::Started : step(message, news);
  progress = startUp_.progress();
  if (result == bus::StartUp::Started)
    devices_[place].join();
  if (result == bus::StartUp::Failed) {
    failure_ = message;
    told_ = bit;
  }
  return result;
}

/// One for all its logical devices.
bus::StartUp Node::step(bus::Message &message, bus::News &news) {
  if (stepped_)
    return bus::StartUp::Busy;
  stepped_ = true;
  if (phase_ != Phase::Starting) {
    reset();
    nmt_ = NmtCommand::None;
    phase_ = Phase::Starting;
    startUp_.begin();
    for (LogicalDevice &device : devices_)
      device.beginStartUp();
  }
  const bool arrived =
      std::all_of(devices_.begin(), devices_.end(),
                  [](const LogicalDevice &device) { return device.pdosArrived(); });
  const bool lssBusy = lssBusy_ || wantsNumber_;
  const StartParts parts{config_, sdo_, supervision_, devices_, nmt_,        arrived,
                         lssBusy, lss_, boots_,       cobIds_,  planChanged_};
  const bus::StartUp result = startUp_.step(parts, message);
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
  for (LogicalDevice &device : devices_)
    device.started();
  sayLacks(news);
  sayPdos(news);
}

/// What has not been planned so.
void Node::sayPdos(bus::News &news) const {
  const uint32_t number = config_.plan.node;
  if (startUp_.adapted())
    news.say("node ", number, ": PDOs that it does not let be changed are used as they are");
  for (const FixedPdo &pdo : startUp_.unused()) {
    if (!pdo.transmits)
      continue;
    const uint32_t bits = pdo.cyclic() ? worstBits(pdo.length()) : uint32_t{0};
    news.say("node ", number, ": its TPDO ", uint32_t{pdo.pdo.number},
             " cannot be switched off: nobody uses it, and it takes ", bits, " bits of a cycle");
  }
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
  for (LogicalDevice &device : devices_)
    device.reset();
  user_ = SdoUser::None;
  loss_ = NodeLoss::None;
  silent_ = saidSilent_ = false;
  told_ = 0;
}

void Node::reset(size_t place) {
  const bool works = phase_ == Phase::Started && loss_ == NodeLoss::None;
  if (works && devices_.size() > 1 && !devices_[place].joined())
    return;
  reset();
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
      devices_[asker_].parameters().finished(sdo_);
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
  if (loss_ == NodeLoss::None && phase_ == Phase::Started && isDrive())
    for (size_t i = 0; i < devices_.size(); ++i) {
      const size_t place = (nextAsker_ + i) % devices_.size();
      const ObjectWish wish = devices_[place].drive().wish();
      if (wish.kind == ObjectWish::Kind::None)
        continue;
      asker_ = place;
      nextAsker_ = (place + 1) % devices_.size();
      beginWish(wish, SdoUser::Drive, devices_[place].plan().axis);
      return;
    }
  const ObjectWish error = loss_ == NodeLoss::None ? errors_.wish() : ObjectWish{};
  if (error.kind != ObjectWish::Kind::None) {
    beginWish(error, SdoUser::Errors, 0);
    return;
  }
  if (phase_ == Phase::Started)
    serveParameters();
}

void Node::serveParameters() {
  for (size_t i = 0; i < devices_.size(); ++i) {
    const size_t place = (nextAsker_ + i) % devices_.size();
    if (!devices_[place].parameters().wants())
      continue;
    asker_ = place;
    nextAsker_ = (place + 1) % devices_.size();
    devices_[place].parameters().begin(sdo_);
    user_ = sdo_.state() == SdoClient::State::Busy ? SdoUser::Parameter : SdoUser::None;
    return;
  }
}

void Node::cancelParameter(size_t place) {
  if (user_ == SdoUser::Parameter && asker_ != place) {
    devices_[place].parameters().forget();
    return;
  }
  devices_[place].parameters().cancel(sdo_);
}

ObjectAnswer Node::objectAnswer() const {
  ObjectAnswer answer{sdo_.state() == SdoClient::State::Done, 0};
  for (size_t i = 0; answer.done && wish_.kind == ObjectWish::Kind::Read && i < sdo_.size(); ++i)
    answer.value |= uint32_t{wishBytes_[i]} << 8 * i;
  return answer;
}

void Node::errorsAnswered(bus::News &news) {
  const bool missing = !sdo_.timedOut() && isMissing(sdo_.abortCode());
  errors_.answered(objectAnswer(), missing, config_.plan.node, {emcy_, errorCode()}, news);
}

/// 603Fh of the first drive that shows a fault.
uint16_t Node::errorCode() const {
  for (const LogicalDevice &device : devices_)
    if (device.drive().errorCode() != 0)
      return device.drive().errorCode();
  return 0;
}

void Node::wishAnswered(bus::News &news) {
  const ObjectAnswer answer = objectAnswer();
  const LogicalDevice &device = devices_[asker_];
  devices_[asker_].drive().answered(wish_, answer);
  const auto code = static_cast<uint16_t>(answer.value);
  if (wish_.object != object::kErrorCode || !answer.done || code == 0 || code == emcy_.code())
    return;
  constexpr size_t kPrefix = 3; // 16#
  const HexText index(ofAxis(object::kErrorCode, device.plan().axis).index, 4);
  news.say("node ", uint32_t{config_.plan.node}, " has a fault: ", errorText(code), " (",
           std::string_view(index).substr(kPrefix), "h = ", HexText(code, 4), ")");
}

void Node::beginWish(const ObjectWish &wish, SdoUser user, uint8_t axis) {
  wish_ = wish;
  const Object object = ofAxis(wish.object, axis);
  bool begun = false;
  if (wish.kind == ObjectWish::Kind::Read) {
    begun = sdo_.upload(object, wishBytes_);
  } else {
    for (size_t i = 0; i < wishBytes_.size(); ++i)
      wishBytes_[i] = static_cast<uint8_t>(wish.value >> 8 * i);
    const size_t size = std::clamp<size_t>(wish.size, 1, wishBytes_.size());
    begun = sdo_.download(object, std::span<const uint8_t>(wishBytes_).first(size));
  }
  user_ = begun ? user : SdoUser::None;
}

} // namespace stride::can
