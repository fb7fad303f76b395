// Gives a node its number by LSS while the bus runs: one frame at a time, without ever waiting.
#ifndef STRIDE_DRIVERS_CAN_MASTER_LSS_ASSIGNMENT_HPP
#define STRIDE_DRIVERS_CAN_MASTER_LSS_ASSIGNMENT_HPP

#include "drivers/can/master/lss.hpp"

#include <cstdint>

namespace stride::can {

/// Who shall get which number.
struct LssOrder {
  lss::Identity identity{};
  uint8_t node = 1;                  ///< 1 … 127.
  uint8_t bitRate = lss::kNoBitRate; ///< That it stores, too; by the table of the standard.
  bool store = false;                ///< The node keeps the number when it is switched off.
};

/// What has come of it.
struct LssOutcome {
  enum class Kind : uint8_t {
    None,      ///< It has not been tried yet.
    NotFound,  ///< No node of that identity answers.
    Unchanged, ///< It has that number already.
    Assigned,  ///< It begins anew with it, or will with the next reset of its communication.
    Refused,   ///< It does not take the number, or has ceased to answer.
    InUse,     ///< It has the number of a node in operation, and cannot be reset by that.
  };
  Kind kind = Kind::None;
  uint8_t before = lss::kNoNode; ///< The number that it had.
  bool notStored = false;        ///< It could not store the number …
  bool noBitRate = false;        ///< … or does not take the bit rate.
};

class LssAssignment {
public:
  /// `timeout`: for each answer. [cycles]
  explicit LssAssignment(uint32_t timeout) : timeout_(timeout) {}

  /// Whoever was selected before is let go.
  void begin(const LssOrder &order);
  [[nodiscard]] bool busy() const { return step_ != Step::Idle; }
  /// When it is no longer busy.
  [[nodiscard]] const LssOutcome &outcome() const { return outcome_; }

  [[nodiscard]] bool pending() const { return pending_; }
  /// The frame to be sent now; `pending()`.
  [[nodiscard]] Frame nextFrame() const;
  /// It has been.
  void sent();
  /// A frame with the identifier of answers.
  void received(const Frame &frame);
  /// A cycle has passed.
  void cycle();

private:
  enum class Step : uint8_t {
    Wait, ///< All nodes go to the state in which they can be selected.
    Vendor,
    Product,
    Revision,
    Serial,
    Inquire,
    SetNode,
    BitRate,
    Store,
    Leave,
    Idle,
  };
  [[nodiscard]] static bool awaits(Step step);
  [[nodiscard]] static uint8_t answerTo(Step step);
  void go(Step step);
  void answered(const Frame *answer);
  void end(LssOutcome::Kind kind);
  void numberSet();

  LssOrder order_;
  LssOutcome outcome_;
  uint32_t timeout_;
  uint32_t waited_ = 0; ///< For the answer. [cycles]
  Step step_ = Step::Idle;
  bool pending_ = false;
};

} // namespace stride::can

#endif
