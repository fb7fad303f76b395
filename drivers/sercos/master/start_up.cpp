#include "drivers/sercos/master/start_up.hpp"

#include "drivers/sercos/master/texts.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

/// Members of DriveTiming by the IDN that says them.
struct TimeRow {
  Idn idn;
  uint32_t DriveTiming::*member;
};
constexpr std::array<TimeRow, 6> kTimeRows = {{
    {idns::kShortestAtStart, &DriveTiming::shortestAtStart},
    {idns::kAtToMdt, &DriveTiming::atToMdt},
    {idns::kShortestFeedback, &DriveTiming::feedback},
    {idns::kAtToAt, &DriveTiming::atToAt},
    {idns::kMdtToMst, &DriveTiming::mdtToMst},
    {idns::kCommandProcessing, &DriveTiming::processing},
}};

/// What is asked of a step's IDN first.
Element firstElement(StartOp op) {
  switch (op) {
  case StartOp::ReadTime:
  case StartOp::ReadScaling:
  case StartOp::ProfileBits:
    return Element::Data;
  default:
    return Element::Attribute;
  }
}

/// Bytes of a value, whatever the drive's attribute says.
size_t mostBytesOf(const IdnValue &value) {
  return std::max(value.text.size(), value.numbers.size() * sizeof(int64_t));
}

} // namespace

StartUp::StartUp(const DriveConfig &config)
    : phases_{startSteps(config, Phase::Two), startSteps(config, Phase::Three),
              startSteps(config, Phase::Four)},
      file_(config.file), fileWritten_(config.file.size()), steps_(&phases_[0]),
      commandTimeout_(config.commandTimeout) {
  scratch_.numbers.resize(1);
  size_t most = mostBytesOf(scratch_);
  for (const std::vector<StartStep> &phase : phases_)
    for (const StartStep &one : phase)
      most = std::max(most, mostBytesOf(one.value));
  for (const IdnValue &one : file_)
    most = std::max(most, mostBytesOf(one));
  bytes_.resize(std::min(most, ServiceChannel::kMost));
  usual_.atBytes = config.settings.cyclic.at.bytes();
  usual_.mdtBytes = config.settings.cyclic.mdt.bytes();
}

const std::vector<StartStep> &StartUp::steps(Phase phase) const {
  return phases_[static_cast<size_t>(phase) - 2];
}

void StartUp::begin(Phase phase) {
  phase_ = phase;
  steps_ = &phases_[static_cast<size_t>(phase) - 2];
  place_ = 0;
  part_ = Part::Begin;
  state_ = State::Busy;
  filePlace_ = 0;
  if (phase != Phase::Two)
    return;
  planned_ = false;
  timing_ = usual_;
  facts_ = {};
  missingModes_ = 0;
  std::fill(fileWritten_.begin(), fileWritten_.end(), false);
}

void StartUp::plan(const DriveTimes &times) {
  times_ = times;
  planned_ = true;
  if (state_ == State::AwaitsPlan)
    state_ = State::Busy;
}

uint8_t StartUp::percent() const {
  const size_t count = steps_->size();
  return static_cast<uint8_t>(count == 0 ? 100 : std::min(place_, count) * 100 / count);
}

void StartUp::next() {
  ++place_;
  part_ = Part::Begin;
  scratch_.idn = 0;
}

void StartUp::tell(bus::Message &message, Idn idn) const {
  message.set("phase ", static_cast<uint32_t>(phase_), ", ", IdnName(idn));
}

void StartUp::step(ServiceChannel &channel, bus::Message &message) {
  if (state_ != State::Busy)
    return;
  if (part_ != Part::Begin) {
    ++waited_;
    if (channel.state() == ServiceChannel::State::Busy)
      return;
    answered(channel, message);
  }
  while (state_ == State::Busy && part_ == Part::Begin) {
    if (place_ >= steps_->size()) {
      state_ = State::Done;
    } else if (now().op == StartOp::AwaitPlan) {
      if (planned_)
        next();
      else
        state_ = State::AwaitsPlan;
    } else if (now().op == StartOp::WriteFile &&
               (filePlace_ >= file_.size() || fileWritten_[filePlace_])) {
      if (filePlace_ >= file_.size())
        next();
      else
        ++filePlace_;
    } else {
      ask(channel);
    }
  }
}

const IdnValue &StartUp::value() const {
  return now().op == StartOp::WriteFile ? file_[filePlace_] : now().value;
}

void StartUp::ask(ServiceChannel &channel) {
  channel.release();
  waited_ = 0;
  (void)channel.read(value().idn, firstElement(now().op));
  part_ = Part::Asked;
}

void StartUp::answered(ServiceChannel &channel, bus::Message &message) {
  switch (part_) {
  case Part::Begin:
    break;
  case Part::Asked:
    asked(channel, message);
    break;
  case Part::Writing:
    written(channel, message);
    break;
  case Part::Polling:
    polled(channel, message);
    break;
  case Part::Ending:
    next();
    break;
  case Part::Refusal:
    tellRefusal(channel, message);
    break;
  }
}

void StartUp::asked(ServiceChannel &channel, bus::Message &message) {
  const StartStep &step = now();
  if (channel.state() != ServiceChannel::State::Done) {
    if (step.optional && channel.error() == service_error::kNoIdn)
      next();
    else
      refused(channel, message);
    return;
  }
  switch (step.op) {
  case StartOp::ReadTime:
    for (const TimeRow &row : kTimeRows)
      if (row.idn == step.value.idn)
        timing_.*row.member = static_cast<uint32_t>(channel.number());
    next();
    break;
  case StartOp::ReadScaling:
    *facts_.of(step.value.idn) = channel.number();
    next();
    break;
  case StartOp::CheckLength:
    checkLength(channel, message);
    break;
  case StartOp::ProfileIdn:
    next();
    break;
  case StartOp::ProfileBits:
    checkBits(channel, message);
    break;
  case StartOp::WriteTime:
    scratch_.idn = step.value.idn;
    scratch_.numbers[0] = timeOf(step.value.idn);
    write(channel, scratch_, message);
    break;
  case StartOp::Command:
    scratch_.idn = step.value.idn;
    scratch_.numbers[0] = command::kStart;
    write(channel, scratch_, message);
    break;
  case StartOp::WriteFile:
    fileStep(channel, message);
    break;
  default:
    write(channel, step.value, message);
    break;
  }
}

void StartUp::checkLength(const ServiceChannel &channel, bus::Message &message) {
  const StartStep &step = now();
  if (!channel.attribute().list && channel.attribute().bytes == step.bytes) {
    next();
    return;
  }
  tell(message, step.value.idn);
  message.append(": it has another length than the ");
  message.append(uint32_t{step.bytes});
  message.append(" bytes that are planned for each cycle");
  fail();
}

void StartUp::checkBits(const ServiceChannel &channel, bus::Message &message) {
  const StartStep &step = now();
  if ((static_cast<uint64_t>(channel.number()) & step.mask) ==
      static_cast<uint64_t>(step.value.numbers[0])) {
    next();
    return;
  }
  message.set("the Pack Profile is not met: ", IdnName(step.value.idn), " is ",
              WordText(static_cast<uint16_t>(channel.number())), ", where ", step.text);
  fail();
}

int64_t StartUp::timeOf(Idn idn) const {
  switch (idn) {
  case idns::kMdtStart:
    return times_.ring.mdtStart;
  case idns::kAtStart:
    return times_.slot.atStart;
  case idns::kFeedbackSampling:
    return times_.ring.feedback;
  case idns::kCommandValid:
    return times_.ring.commandValid;
  case idns::kPlaceInMdt:
    return times_.slot.placeInMdt;
  case idns::kMdtLength:
    return times_.ring.mdtLength;
  default:
    return times_.cycle;
  }
}

void StartUp::write(ServiceChannel &channel, const IdnValue &value, bus::Message &message) {
  size_t count = 0;
  const EncodeFault fault = encodeValue(value, channel.attribute(), bytes_, count);
  if (fault != EncodeFault::None) {
    tell(message, value.idn);
    message.append(": the value is not what the drive expects there, ");
    message.append(describe(fault));
    fail();
    return;
  }
  channel.release();
  (void)channel.write(value.idn, std::span<const uint8_t>(bytes_).first(count));
  part_ = Part::Writing;
}

/// What this phase does not allow waits for the next one.
void StartUp::fileStep(ServiceChannel &channel, bus::Message &message) {
  if (channel.attribute().writableIn(phase_)) {
    write(channel, value(), message);
    return;
  }
  ++filePlace_;
  part_ = Part::Begin;
}

void StartUp::written(ServiceChannel &channel, bus::Message &message) {
  const StartStep &step = now();
  if (channel.state() != ServiceChannel::State::Done) {
    const bool isMode = step.op == StartOp::WriteMode && !channel.timedOut();
    constexpr auto kLagless = static_cast<int64_t>(OperationMode::Position1Lagless);
    if (isMode && step.value.numbers[0] == kLagless && scratch_.idn != step.value.idn) {
      // then with lag
      scratch_.idn = step.value.idn;
      scratch_.numbers[0] = static_cast<int64_t>(OperationMode::Position1);
      write(channel, scratch_, message);
    } else if (step.optional && !channel.timedOut()) {
      if (isMode)
        missingModes_ =
            static_cast<uint8_t>(missingModes_ | 1U << (step.value.idn - idns::kPrimaryMode));
      next();
    } else {
      refused(channel, message);
    }
    return;
  }
  if (step.op == StartOp::Command) {
    channel.release();
    (void)channel.read(step.value.idn, Element::Idn);
    part_ = Part::Polling;
    return;
  }
  if (step.op != StartOp::WriteFile) {
    next();
    return;
  }
  fileWritten_[filePlace_++] = true;
  part_ = Part::Begin;
}

void StartUp::polled(ServiceChannel &channel, bus::Message &message) {
  if (channel.state() != ServiceChannel::State::Done) {
    refused(channel, message);
    return;
  }
  const Idn idn = now().value.idn;
  const auto state = static_cast<uint16_t>(channel.number() & data_state::kCommandMask);
  channel.release();
  if (state == data_state::kDone || (state == data_state::kFailed && now().optional)) {
    scratch_.numbers[0] = command::kCancel;
    const std::array<uint8_t, 2> cancel{};
    (void)channel.write(idn, cancel);
    part_ = Part::Ending;
  } else if (state == data_state::kFailed) {
    (void)channel.read(idn == idns::kCheckPhase3 ? idns::kInvalidPhase2 : idns::kInvalidPhase3,
                       Element::Data);
    part_ = Part::Refusal;
  } else if (waited_ >= commandTimeout_) {
    tell(message, idn);
    message.append(": the command does not end");
    fail();
  } else {
    (void)channel.read(idn, Element::Idn);
  }
}

void StartUp::tellRefusal(const ServiceChannel &channel, bus::Message &message) {
  tell(message, now().value.idn);
  message.append(": the drive refuses the next phase");
  const std::span<const uint8_t> bytes = channel.bytes();
  if (channel.state() == ServiceChannel::State::Done && bytes.size() >= 2) {
    message.append(", invalid are");
    for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
      message.append(i == 0 ? " " : ", ");
      message.append(IdnName(static_cast<Idn>(bytes[i] | bytes[i + 1] << 8U)));
    }
  }
  fail();
}

void StartUp::refused(const ServiceChannel &channel, bus::Message &message) {
  const StartStep &step = now();
  const bool writing = part_ == Part::Writing && step.op != StartOp::Command;
  if (step.op == StartOp::ProfileIdn && !channel.timedOut()) {
    message.set("the Pack Profile is not met: the drive has no ", IdnName(step.value.idn));
    fail();
    return;
  }
  const bool scratch = step.op == StartOp::WriteTime || scratch_.idn == step.value.idn;
  const IdnValue &given = scratch ? scratch_ : value();
  tell(message, value().idn);
  if (writing && given.isText) {
    message.append(" := '");
    message.append(given.text);
    message.append("'");
  } else if (writing && given.numbers.size() == 1) {
    message.append(" := ");
    message.append(NumberText(given.numbers[0]));
  }
  message.append(": ");
  if (channel.timedOut()) {
    message.append("the service channel does not answer");
  } else if (channel.error() == 0) {
    message.append("it is longer than the master has room for");
  } else {
    message.append(serviceErrorText(channel.error()));
    message.append(" (");
    message.append(WordText(channel.error()));
    message.append(")");
  }
  fail();
}

} // namespace stride::sercos
