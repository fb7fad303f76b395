// Online change: the state of a running application becomes the state of a new build of it.
#ifndef STRIDE_RUNTIME_APP_CARRY_OVER_HPP
#define STRIDE_RUNTIME_APP_CARRY_OVER_HPP

#include "runtime/app/address_map.hpp"
#include "runtime/app/carry_report.hpp"
#include "runtime/app/layout_index.hpp"
#include "runtime/app/pool_carry.hpp"
#include "runtime/app/type_match.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace stride::app {

/// Something that only the values themselves showed.
struct CarryEvent {
  enum class Kind : uint8_t {
    Nulled,         ///< An address whose target the new build does not have.
    TextCut,        ///< A text that was longer than the new string.
    OutOfRange,     ///< A value outside of the new subrange.
    EnumeratorGone, ///< A value whose enumerator the new build does not have.
  };
  Kind kind;
  AddressMap::Status status; ///< Nulled: why.
  uint32_t oldType;          ///< Of the variable.
  uint32_t newType;
  uint64_t newOffset; ///< Of the variable.
  uint64_t address;   ///< Nulled: the old address. OutOfRange: the value, an int64_t.
};

/// What happened in one carry-over. Made before, so that applying allocates nothing.
class CarryResult {
public:
  explicit CarryResult(size_t capacity = 256) { events_.resize(capacity); }

  void clear() { *this = CarryResult(std::move(events_)); }
  void add(const CarryEvent &event) noexcept;

  uint64_t nulled() const { return nulled_; }
  uint64_t textsCut() const { return textsCut_; }
  uint64_t enumeratorsGone() const { return enumeratorsGone_; }
  uint64_t outOfRange() const { return outOfRange_; }
  uint64_t addressesKept = 0;
  uint64_t objectsGivenUp = 0; ///< Objects of __NEW whose type has changed.
  /// The first ones; there may have been more than fitted.
  std::span<const CarryEvent> events() const { return {events_.data(), used_}; }
  uint64_t total() const { return nulled_ + textsCut_ + enumeratorsGone_ + outOfRange_; }

private:
  explicit CarryResult(std::vector<CarryEvent> &&events) : events_(std::move(events)) {}
  std::vector<CarryEvent> events_;
  size_t used_ = 0;
  uint64_t nulled_ = 0;
  uint64_t textsCut_ = 0;
  uint64_t enumeratorsGone_ = 0;
  uint64_t outOfRange_ = 0;
};

/// Memory outside of the state that both builds see at the same addresses.
struct SharedMemory {
  uint64_t begin;
  uint64_t size;
};

/// A plan for one pair of builds, made once, outside of the cycle. See docs/online-change.md.
class CarryOver {
public:
  /// Both descriptions are valid (validate.hpp) and outlive the plan. Addresses into `shared` stay
  /// as they are.
  CarryOver(const StrideAppV1 &oldApp, const StrideAppV1 &newApp, MatchOptions options = {},
            std::vector<SharedMemory> shared = {});
  CarryOver(const CarryOver &) = delete;
  CarryOver &operator=(const CarryOver &) = delete;

  const CarryReport &report() const { return report_; }

  /// Copies the values of the old state into the freshly initialised new one. Allocates nothing,
  /// locks nothing, throws nothing. Not with Verdict::Refused.
  void apply(const std::byte *oldState, std::byte *newState, CarryResult &result) const noexcept;

  /// The whole change, between two cycles: FB_Exit(bInCopyCode := TRUE) of the old instances,
  /// apply, FB_Reinit of the new ones. The new state was initialised with inCopyCode. `now` gives
  /// the host, the times and the loop budget; its state is not used. Throws what the host's `raise`
  /// throws when the program's own code fails: in FB_Exit nothing has been carried over yet, in
  /// FB_Reinit everything has.
  /// `call` runs that code and may guard it; where it returns false, nothing more is done.
  using LifecycleCall = std::function<bool(void (*hook)(Ctx *), Ctx &ctx)>;
  enum class Taken : uint8_t { Whole, ExitFailed, ReinitFailed };
  Taken takeOver(
      const Ctx &now, std::byte *oldState, std::byte *newState, CarryResult &result,
      const LifecycleCall &call = [](void (*hook)(Ctx *), Ctx &ctx) {
        hook(&ctx);
        return true;
      }) const;

  /// The events in words: "Main.p pointed to Main.gone, which the new build does not have".
  std::vector<std::string> describe(const CarryResult &result, const std::byte *oldState) const;

  const TypeMatch &match() const { return match_; }
  /// Steps at the outermost level, for statistics.
  size_t stepCount() const { return steps_.size(); }

private:
  using NumberFunction = void (*)(const std::byte *from, std::byte *to, uint64_t count,
                                  uint64_t fromStride, uint64_t toStride);
  struct Step {
    enum class Kind : uint8_t { Copy, Bit, Number, Text, Names, Range, Repeat, Slot };
    Kind kind;
    bool maybe;    ///< Slot: it may as well be something else (a union).
    uint32_t pair; ///< Number, Text, Names, Range, Slot: the types. Repeat: the program.
    uint64_t oldOffset;
    uint64_t newOffset;
    uint64_t count; ///< Copy: bytes. Bit: old bit's number + 16 * new bit's, 8 for a whole byte.
    uint64_t oldStride;
    uint64_t newStride;
  };
  struct Program {
    uint32_t first;
    uint32_t count;
  };
  struct Place {
    uint64_t oldOffset;
    uint64_t newOffset;
  };
  /// Steps being collected. `barrier`: something that must not be touched lies after the last.
  struct Steps {
    std::vector<Step> list;
    bool barrier = false;
  };
  struct Run;

  void copySteps(uint32_t pair, Place at, Steps &out);
  void fieldSteps(const TypePair &pair, Place at, Steps &out);
  void slotSteps(uint32_t pair, Place at, bool maybe, Steps &out);
  void append(const Steps &program, Place at, Steps &out);
  void appendCopy(Place at, uint64_t bytes, uint64_t align, Steps &out) const;
  void repeat(const Steps &program, Place at, const TypePair &array, Steps &out);
  uint32_t store(const Steps &program);
  const Steps &copyProgram(uint32_t pair);
  const Steps &slotProgram(uint32_t pair, bool maybe);
  Place elementPlace(const TypePair &array, Place at) const;
  uint64_t oldSize(uint32_t pair) const;
  uint64_t newSize(uint32_t pair) const;

  TypeMatch match_;
  PoolCarry pool_;
  LayoutIndex oldIndex_;
  LayoutIndex newIndex_;
  AddressMap addresses_;
  std::vector<SharedMemory> shared_;
  CarryReport report_;
  std::vector<Step> steps_; ///< Programs one after the other.
  std::vector<Program> programs_;
  Program copies_{};
  Program slots_{};
  std::vector<Program> poolSlots_;        ///< By pair: of the objects of __NEW.
  std::vector<NumberFunction> numbers_;   ///< By pair.
  std::vector<AddressMap::Slot> targets_; ///< By pair.
  std::vector<Steps> copyPrograms_;       ///< By pair, while the plan is made.
  std::vector<Steps> slotPrograms_;       ///< By pair and `maybe`, while the plan is made.
  std::vector<bool> copyKnown_;
  std::vector<bool> slotKnown_;
};

} // namespace stride::app

#endif
