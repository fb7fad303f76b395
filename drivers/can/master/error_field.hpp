// The list of errors that a node keeps (1003h): when it is asked for it, and what is said of it.
// [CiA 301, error register and pre-defined error field]
#ifndef STRIDE_DRIVERS_CAN_MASTER_ERROR_FIELD_HPP
#define STRIDE_DRIVERS_CAN_MASTER_ERROR_FIELD_HPP

#include "drivers/can/master/emcy.hpp"
#include "drivers/can/master/object_wish.hpp"
#include "runtime/bus/news.hpp"

#include <cstdint>

namespace stride::can {

/// What a node has told of its errors otherwise.
struct Told {
  const EmcyRing &emcy;
  uint16_t errorCode = 0; ///< 603Fh; 0: none, or not known.
};

class ErrorField {
public:
  /// The node has started, or could not: whether it has an error is asked once (1001h), and its
  /// newest one if so.
  void begin();
  /// The node starts anew.
  void clear() { *this = ErrorField(); }
  /// It has told an error, or shows a fault: its newest one is asked. Nothing happens if it has no
  /// such list.
  void ask();
  /// Its fault has gone.
  void settle() { code_ = 0; }
  /// The node has no error any more: what comes after that is news again, even if it is the same.
  void gone();

  /// What is to be read.
  [[nodiscard]] ObjectWish wish() const;
  /// It has been, or not; `missing`: the node has no such object. What it has not told already is
  /// said.
  void answered(const ObjectAnswer &answer, bool missing, uint32_t node, const Told &told,
                bus::News &news);

  /// The code of the newest error, since it was asked last; 0: not known.
  [[nodiscard]] uint16_t code() const { return code_; }

private:
  enum class Step : uint8_t { Idle, Register, Count, Newest };

  void counted(const ObjectAnswer &answer, bool missing, uint32_t node, const Told &told,
               bus::News &news);
  void sayRegister(uint32_t node, const Told &told, bus::News &news);
  void sayNewest(uint32_t newest, uint32_t node, const Told &told, bus::News &news);
  void end();

  uint32_t said_ = 0; ///< The entry that has been said last.
  uint16_t code_ = 0;
  uint8_t register_ = 0; ///< 1001h, when it was asked at the beginning.
  uint8_t count_ = 0;    ///< Errors in the list.
  Step step_ = Step::Idle;
  bool again_ = false;  ///< There has been another error meanwhile.
  bool absent_ = false; ///< The node has no such list.
  bool gone_ = false;   ///< The error that is being read has gone meanwhile.
};

} // namespace stride::can

#endif
