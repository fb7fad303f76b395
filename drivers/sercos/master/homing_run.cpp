#include "drivers/sercos/master/homing_run.hpp"

#include "drivers/sercos/protocol/words.hpp"

namespace stride::sercos {
namespace {

/// Cycles until positions can speak of the stop: there and back, and one of its own.
constexpr uint32_t kDeadTime = 4;

} // namespace

/// Until it is cancelled the drive has it, also when it has been executed: it would not begin
/// again. And from then on it follows its command values: what moves must be at rest before, or it
/// would be led back to where it was when it said so.
void HomingRun::giveUp() {
  switch (step_) {
  case Step::Starting:
  case Step::Running:
    step_ = Step::Interrupting;
    break;
  case Step::Reference:
  case Step::Offset:
    step_ = Step::Cancelling;
    break;
  case Step::Found:
  case Step::Failed:
    step_ = Step::Idle;
    break;
  default:
    break;
  }
}

void HomingRun::stop(bool able, bool rests) {
  ++cycles_;
  if (!able || (rests && cycles_ >= kDeadTime) || cycles_ >= timeout_)
    step_ = Step::Cancelling;
}

void HomingRun::step(bool wanted, bool able, bool rests) {
  if (step_ == Step::Stopping)
    stop(able, rests);
  if (!wanted) {
    giveUp();
    return;
  }
  if (step_ == Step::Idle)
    step_ = able ? Step::Starting : Step::Failed;
  else if (!able && (step_ == Step::Starting || step_ == Step::Running))
    step_ = Step::Failing;
}

ServiceWish HomingRun::wish() const {
  using Kind = ServiceWish::Kind;
  switch (step_) {
  case Step::Starting:
    return {Kind::Write, idns::kDriveHoming, command::kStart};
  case Step::Running:
    return {Kind::State, idns::kDriveHoming};
  case Step::Interrupting:
    return {Kind::Write, idns::kDriveHoming, command::kInterrupt};
  case Step::Ending:
  case Step::Cancelling:
  case Step::Failing:
    return {Kind::Write, idns::kDriveHoming, command::kCancel};
  case Step::Reference:
    return {Kind::Read, idns::kReferenceDistance1};
  case Step::Offset:
    return {Kind::Read, idns::kReferenceOffset1};
  default:
    return {};
  }
}

void HomingRun::answered(const ServiceWish &wish, const ServiceAnswer &answer) {
  if (wish != this->wish()) // it has gone on meanwhile
    return;
  switch (step_) {
  case Step::Starting:
    step_ = answer.done ? Step::Running : Step::Failed;
    break;
  case Step::Running: {
    const auto state = static_cast<uint16_t>(answer.value & data_state::kCommandMask);
    if (!answer.done || state == data_state::kFailed)
      step_ = Step::Failing;
    else if (state == data_state::kDone)
      step_ = Step::Reference;
    break;
  }
  case Step::Reference:
    reference_ = answer.done ? answer.value : 0;
    step_ = Step::Offset;
    break;
  case Step::Offset: // drives may lack it
    offset_ = answer.done ? answer.value : 0;
    step_ = Step::Ending;
    break;
  case Step::Ending:
    step_ = answer.done ? Step::Found : Step::Failed;
    break;
  case Step::Failing:
    step_ = Step::Failed;
    break;
  case Step::Interrupting:
    step_ = answer.done ? Step::Stopping : Step::Cancelling;
    cycles_ = 0;
    break;
  case Step::Cancelling:
    step_ = Step::Idle;
    break;
  default:
    break;
  }
}

} // namespace stride::sercos
