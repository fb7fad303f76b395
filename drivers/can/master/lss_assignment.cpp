#include "drivers/can/master/lss_assignment.hpp"

namespace stride::can {

void LssAssignment::begin(const LssOrder &order) {
  order_ = order;
  outcome_ = {};
  go(Step::Wait);
}

bool LssAssignment::awaits(Step step) { return answerTo(step) != 0; }

/// The first byte of the answer to what a step asks; 0: it has none.
uint8_t LssAssignment::answerTo(Step step) {
  switch (step) {
  case Step::Serial:
    return lss::kSelected;
  case Step::Inquire:
    return lss::kInquireNode;
  case Step::SetNode:
    return lss::kConfigureNode;
  case Step::BitRate:
    return lss::kConfigureBitRate;
  case Step::Store:
    return lss::kStore;
  default:
    return 0;
  }
}

void LssAssignment::go(Step step) {
  step_ = step;
  waited_ = 0;
  pending_ = step != Step::Idle;
}

Frame LssAssignment::nextFrame() const {
  switch (step_) {
  case Step::Vendor:
  case Step::Product:
  case Step::Revision:
  case Step::Serial: {
    const auto part =
        static_cast<uint8_t>(static_cast<unsigned>(step_) - static_cast<unsigned>(Step::Vendor));
    return lss::request(static_cast<uint8_t>(lss::kSelectVendor + part), order_.identity[part]);
  }
  case Step::Inquire:
    return lss::request(lss::kInquireNode, 0);
  case Step::SetNode:
    return lss::request(lss::kConfigureNode, order_.node);
  case Step::BitRate: // the first byte is the table, the second one the place in it
    return lss::request(lss::kConfigureBitRate, uint32_t{order_.bitRate} << 8U);
  case Step::Store:
    return lss::request(lss::kStore, 0);
  default: // Wait, Leave
    return lss::request(lss::kSwitchGlobal, 0);
  }
}

void LssAssignment::sent() {
  pending_ = false;
  if (step_ == Step::Leave)
    go(Step::Idle);
  else if (!awaits(step_))
    go(static_cast<Step>(static_cast<uint8_t>(step_) + 1));
}

/// An answer to what was asked before has come too late, and is none to this.
void LssAssignment::received(const Frame &frame) {
  if (pending_ || !awaits(step_) || !lss::isAnswer(frame) || frame.data[0] != answerTo(step_))
    return;
  answered(&frame);
}

void LssAssignment::cycle() {
  if (pending_ || !awaits(step_))
    return;
  if (++waited_ >= timeout_)
    answered(nullptr);
}

void LssAssignment::end(LssOutcome::Kind kind) {
  outcome_.kind = kind;
  go(Step::Leave);
}

/// What comes after the number makes it last, and is no reason to refuse a node.
void LssAssignment::numberSet() {
  outcome_.kind = LssOutcome::Kind::Assigned;
  if (!order_.store)
    go(Step::Leave);
  else
    go(order_.bitRate != lss::kNoBitRate ? Step::BitRate : Step::Store);
}

/// Null: there was none in time.
void LssAssignment::answered(const Frame *answer) {
  using Kind = LssOutcome::Kind;
  const auto done = [answer](uint8_t command) {
    return answer != nullptr && lss::resultOf(*answer, command) == LssResult::Done;
  };
  switch (step_) {
  case Step::Serial:
    if (answer != nullptr)
      go(Step::Inquire);
    else
      end(Kind::NotFound);
    break;
  case Step::Inquire:
    if (answer == nullptr) {
      end(Kind::Refused);
      break;
    }
    outcome_.before = answer->data[1];
    if (outcome_.before == order_.node)
      end(Kind::Unchanged);
    else
      go(Step::SetNode);
    break;
  case Step::SetNode:
    if (done(lss::kConfigureNode))
      numberSet();
    else
      end(Kind::Refused);
    break;
  case Step::BitRate:
    outcome_.noBitRate = !done(lss::kConfigureBitRate);
    go(Step::Store);
    break;
  default: // Store
    outcome_.notStored = !done(lss::kStore);
    go(Step::Leave);
    break;
  }
}

} // namespace stride::can
