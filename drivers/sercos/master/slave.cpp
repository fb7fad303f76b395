#include "drivers/sercos/master/slave.hpp"

#include "drivers/sercos/master/texts.hpp"

#include <algorithm>

namespace stride::sercos {

Slave::Slave(const DriveConfig &config)
    : config_(config), channel_(config.serviceTimeout), startUp_(config), axis_(config),
      parameters_(config.settings.cyclic.mdt) {}

void Slave::clear() {
  leave();
  fault_.set();
  own_ = {};
  failed_ = false;
}

void Slave::leave() {
  channel_.clear();
  axis_.end();
  parameters_.clear();
  telegram_ = {};
  misses_ = 0;
  owner_ = Owner::Nobody;
  phase_ = Phase::Zero;
  heard_ = started_ = false;
}

void Slave::enter(Phase phase) {
  if (phase == Phase::Two)
    channel_.clear();
  startUp_.begin(phase);
  phase_ = phase;
  heard_ = false;
  misses_ = 0;
}

void Slave::fail(const bus::Message &fault) {
  failed_ = true;
  fault_ = fault;
}

void Slave::missed() { ++misses_; }

void Slave::received(const DriveTelegram &telegram, bus::News &news) {
  misses_ = 0;
  heard_ = true;
  telegram_ = telegram;
  const std::span<const uint8_t> bytes = telegram_.bytes();
  channel_.received(wordAt(bytes, 0), wordAt(bytes, 2));
  if (startUp_.state() == StartUp::State::Busy && !failed_) {
    startUp_.step(channel_, fault_);
    failed_ = startUp_.state() == StartUp::State::Failed;
    if (ready())
      channel_.release();
  }
  if (!started_)
    return;
  axis_.read(bytes);
  serve(news);
}

void Slave::start() {
  started_ = true;
  owner_ = last_ = Owner::Nobody;
  channel_.release();
  axis_.begin(startUp_.facts(), startUp_.missingModes(), telegram_.bytes());
}

bus::DriveStatus Slave::status() const {
  bus::DriveStatus status = axis_.status();
  status.communication = started_;
  if (started_)
    return status;
  status.regulatorOn = status.driveStarted = false;
  status.error = false;
  return status;
}

void Slave::fill(std::span<uint8_t> record) {
  uint16_t word = 0;
  if (phase_ >= Phase::Three)
    std::copy_n(own_.begin(), record.size(), record.begin());
  if (started_) {
    axis_.write(record);
    word = wordAt(record, 0);
  }
  word = static_cast<uint16_t>((word & ~control::kServiceMask) | channel_.control());
  putWord(record, 0, word);
  putWord(record, 2, channel_.info());
}

// The service channel in operation: in turns what the axis needs and what programs ask.

void Slave::serve(bus::News &news) {
  if (owner_ != Owner::Nobody && channel_.state() != ServiceChannel::State::Busy)
    end(news);
  if (owner_ == Owner::Nobody)
    begin();
}

void Slave::begin() {
  const ServiceWish wish = axis_.wish();
  const bool asks = parameters_.wants();
  if (wish.kind == ServiceWish::Kind::None && !asks)
    return;
  channel_.release();
  if (asks && (last_ == Owner::Axis || wish.kind == ServiceWish::Kind::None)) {
    owner_ = last_ = Owner::Parameters;
    parameters_.begin(channel_);
    return;
  }
  owner_ = last_ = Owner::Axis;
  wish_ = wish;
  if (wish.kind == ServiceWish::Kind::Write) {
    const std::array<uint8_t, 2> bytes = {static_cast<uint8_t>(wish.value),
                                          static_cast<uint8_t>(wish.value >> 8U)};
    (void)channel_.write(wish.idn, bytes);
  } else {
    (void)channel_.read(wish.idn,
                        wish.kind == ServiceWish::Kind::State ? Element::Idn : Element::Data);
  }
}

void Slave::end(bus::News &news) {
  if (owner_ == Owner::Axis)
    endWish(news);
  else
    parameters_.finished(channel_);
  if (channel_.state() != ServiceChannel::State::Busy)
    owner_ = Owner::Nobody;
}

void Slave::endWish(bus::News &news) {
  ServiceAnswer answer;
  answer.done = channel_.state() == ServiceChannel::State::Done;
  answer.heard = !channel_.timedOut();
  if (answer.done && wish_.kind != ServiceWish::Kind::Write)
    answer.value = channel_.number();
  if (answer.done && wish_.kind == ServiceWish::Kind::Text) {
    const std::span<const uint8_t> bytes = channel_.bytes();
    news.say("address ", uint32_t{config_.address},
             " has an error, S-0-0011 = ", WordText(axis_.status().errorId), ": ",
             std::string_view(reinterpret_cast<const char *>(bytes.data()), bytes.size()));
  }
  axis_.answered(wish_, answer);
}

void Slave::ask(const bus::ParameterRequest &request) {
  parameters_.start(request);
  if (!parameters_.wants())
    return;
  if (request.kind == bus::ParameterRequest::Kind::Read && answerFromTelegram(request))
    return;
  if (request.kind == bus::ParameterRequest::Kind::Write)
    (void)writeToTelegram(request);
}

/// What comes in each cycle is there already.
bool Slave::answerFromTelegram(const bus::ParameterRequest &request) {
  const auto place = placeOfParameter(request.number);
  if (!place || place->element != Element::Data || place->piece != 0 ||
      request.form == bus::ParameterForm::Bytes)
    return false;
  const CyclicRecord &at = config_.settings.cyclic.at;
  const uint32_t where = at.placeOf(place->idn);
  if (where == 0 || telegram_.length < at.bytes())
    return false;
  for (const CyclicObject &object : at.objects()) {
    if (object.idn != place->idn)
      continue;
    const std::span<const uint8_t> bytes = telegram_.bytes();
    const uint16_t low = wordAt(bytes, where);
    const uint32_t high = object.bytes > 2 ? wordAt(bytes, where + 2) : 0U;
    const auto whole = static_cast<int32_t>(low | high << 16U);
    parameters_.answerWith(object.bytes > 2 ? whole : static_cast<int16_t>(low));
  }
  return true;
}

/// What goes in each cycle, and is no command value of an axis, is what programs write.
bool Slave::writeToTelegram(const bus::ParameterRequest &request) {
  const auto place = placeOfParameter(request.number);
  if (!place || place->element != Element::Data || place->piece != 0 ||
      request.form == bus::ParameterForm::Bytes)
    return false;
  const uint32_t where = config_.settings.cyclic.mdt.placeOf(place->idn);
  const bool isCommand = place->idn == idns::kPositionCommand ||
                         place->idn == idns::kVelocityCommand || place->idn == idns::kTorqueCommand;
  if (where == 0 || isCommand)
    return false;
  constexpr double kMost = 4294967295.0;
  const double value = std::clamp(request.value, -kMost, kMost);
  const auto word = request.form == bus::ParameterForm::Raw
                        ? request.raw
                        : static_cast<uint32_t>(static_cast<int64_t>(value));
  putWord(own_, where, static_cast<uint16_t>(word));
  for (const CyclicObject &object : config_.settings.cyclic.mdt.objects())
    if (object.idn == place->idn && object.bytes > 2)
      putWord(own_, where + 2, static_cast<uint16_t>(word >> 16U));
  parameters_.answerWith(static_cast<int32_t>(word));
  return true;
}

void Slave::cancelQuestion() {
  parameters_.cancel(channel_);
  if (owner_ == Owner::Parameters)
    owner_ = Owner::Nobody;
}

} // namespace stride::sercos
