#include "drivers/sercos/master/homing_run.hpp"

#include "drivers/sercos/protocol/words.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

/// Cycles until positions can speak of the stop: there and back, and one of its own.
constexpr uint32_t kDeadTime = 4;

} // namespace

void HomingRun::go(Step step) {
  step_ = step;
  cycles_ = 0;
}

/// Until it is cancelled the drive has it, also when it has been executed: it would not begin
/// again. And from then on it follows its command values: what moves must be at rest before, or it
/// would be led back to where it was when it said so.
void HomingRun::giveUp() {
  switch (step_) {
  case Step::Starting:
  case Step::Running:
    go(Step::Interrupting);
    break;
  case Step::Reference:
  case Step::Offset:
    go(Step::Cancelling);
    break;
  case Step::Found:
  case Step::Failed:
    go(Step::Idle);
    break;
  default:
    break;
  }
}

void HomingRun::step(bool wanted, bool able, bool rests) {
  cycles_ = std::min(cycles_ + 1, timeout_);
  if (step_ == Step::Stopping && (!able || (rests && cycles_ >= kDeadTime) || cycles_ >= timeout_))
    go(Step::Cancelling);
  if (!wanted) {
    giveUp();
    return;
  }
  if (step_ == Step::Idle) {
    failed_ = false;
    go(able ? Step::Starting : Step::Failed);
  } else if (!able && (step_ == Step::Starting || step_ == Step::Running)) {
    failed_ = true;
    go(Step::Cancelling);
  }
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
    return {Kind::Write, idns::kDriveHoming, command::kCancel};
  case Step::Reference:
    return {Kind::Read, idns::kReferenceDistance1};
  case Step::Offset:
    return {Kind::Read, idns::kReferenceOffset1};
  default:
    return {};
  }
}

/// How the run goes. A drive that does not answer may go on by itself.
void HomingRun::told(const ServiceAnswer &answer) {
  const auto state = static_cast<uint16_t>(answer.value & data_state::kCommandMask);
  if (answer.done && state == data_state::kDone) {
    go(Step::Reference);
  } else if (!answer.done || state == data_state::kFailed) {
    failed_ = true;
    go(answer.done ? Step::Cancelling : Step::Interrupting);
  }
}

void HomingRun::answered(const ServiceWish &wish, const ServiceAnswer &answer) {
  if (wish != this->wish()) // it has gone on meanwhile
    return;
  const bool again = !answer.heard && cycles_ < timeout_; // who has not heard it is told again
  switch (step_) {
  case Step::Starting:
    failed_ = !answer.done;
    if (answer.done)
      go(Step::Running);
    else
      go(answer.heard ? Step::Failed : Step::Interrupting);
    break;
  case Step::Running:
    told(answer);
    break;
  case Step::Interrupting:
    if (!again)
      go(answer.done ? Step::Stopping : Step::Cancelling);
    break;
  case Step::Reference:
    reference_ = answer.done ? answer.value : 0;
    go(Step::Offset);
    break;
  case Step::Offset: // drives may lack it
    offset_ = answer.done ? answer.value : 0;
    go(Step::Ending);
    break;
  case Step::Ending:
    go(answer.done ? Step::Found : Step::Failed);
    break;
  case Step::Cancelling:
    if (!again)
      go(failed_ ? Step::Failed : Step::Idle);
    break;
  default:
    break;
  }
}

} // namespace stride::sercos
