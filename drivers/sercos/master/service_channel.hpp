// The master's end of a drive's service channel: a word in each direction in a cycle.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_SERVICE_CHANNEL_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_SERVICE_CHANNEL_HPP

#include "drivers/sercos/protocol/attribute.hpp"
#include "drivers/sercos/protocol/idn.hpp"
#include "drivers/sercos/protocol/service_error.hpp"
#include "drivers/sercos/protocol/words.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stride::sercos {

/// One transfer at a time, for one element of one IDN. Values need the attribute, which says how
/// long they are: it is read before them.
class ServiceChannel {
public:
  enum class State : uint8_t { Idle, Busy, Done, Failed };

  /// Most bytes of a list, or of a text: its length is a word, and with the two lengths before it
  /// is 65536 bytes long. [IEC 61491, as manuals of drives tell it]
  static constexpr size_t kMost = 65532;

  /// `timeout`: telegrams of the drive without the end of a step.
  explicit ServiceChannel(uint32_t timeout) : bytes_(kMost + 1), timeout_(timeout) {}

  /// The drive begins anew, with its handshake bit at 0. Nothing is allocated.
  void clear();

  /// Begins to read an element; false: another transfer is under way.
  bool read(Idn idn, Element element);
  /// Begins to write the operation data; `bytes` has as many as the attribute says, of a list those
  /// in use. False: another transfer is under way, or it is too long.
  bool write(Idn idn, std::span<const uint8_t> bytes);
  /// What is under way is given up.
  void cancel();

  /// What the drive has said in its telegram.
  void received(uint16_t statusWord, uint16_t info);
  /// Bits of the control word for the next one to it …
  [[nodiscard]] uint16_t control() const { return control_; }
  /// … and its word.
  [[nodiscard]] uint16_t info() const { return info_; }

  [[nodiscard]] State state() const { return state_; }
  /// Done or Failed has been taken notice of.
  void release();
  /// Failed: the drive's ServiceError; 0: no answer in time, or it was longer than kMost.
  [[nodiscard]] uint16_t error() const { return error_; }
  [[nodiscard]] bool timedOut() const { return timedOut_; }
  /// Done, reading: what has come; of a list without its two lengths.
  [[nodiscard]] std::span<const uint8_t> bytes() const { return {bytes_.data(), size_}; }
  /// The same as a number, with the sign that the attribute says.
  [[nodiscard]] int64_t number() const;
  /// Of the IDN, where its values have been transferred.
  [[nodiscard]] const Attribute &attribute() const { return attribute_; }
  [[nodiscard]] Idn idn() const { return idn_; }

private:
  enum class Step : uint8_t {
    None,
    Open,
    AttributeLow,
    AttributeHigh,
    Single, ///< An element of one word.
    Length, ///< The bytes in use.
    Room,   ///< The most that there can be.
    Words,
  };

  void begin(Idn idn, Element element, bool writes);
  void start();
  void go(Step step, Element element, bool writes, bool end, uint16_t word);
  void advance(uint16_t info);
  void afterOpen();
  void afterAttribute();
  void list(uint16_t info);
  void nextWord();
  void takeWord(uint16_t info);
  void finish();
  void fail(uint16_t error);
  [[nodiscard]] bool isText() const {
    return element_ == Element::Name || element_ == Element::Unit;
  }
  [[nodiscard]] uint16_t wordAt(size_t place) const;

  std::vector<uint8_t> bytes_; ///< kMost, and one that fills up the last word of an odd list.
  size_t size_ = 0;            ///< Bytes of the element.
  size_t place_ = 0;           ///< The next one of them.
  Attribute attribute_;
  uint32_t attributeBits_ = 0;
  uint32_t timeout_;
  uint32_t waited_ = 0;
  uint16_t control_ = 0;
  uint16_t info_ = 0;
  uint16_t error_ = 0;
  Idn idn_ = 0;
  Element element_ = Element::None;
  Step step_ = Step::None;
  State state_ = State::Idle;
  bool writes_ = false;
  bool open_ = false;  ///< The channel is open for idn_ …
  bool known_ = false; ///< … and its attribute has been read.
  bool timedOut_ = false;
  bool draining_ = false; ///< A step that nobody waits for any more is not over.
};

} // namespace stride::sercos

#endif
