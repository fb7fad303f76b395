// The data blocks of a simulated Sercos device. [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_SIMULATION_IDN_LIST_HPP
#define STRIDE_DRIVERS_SERCOS_SIMULATION_IDN_LIST_HPP

#include "drivers/sercos/protocol/attribute.hpp"
#include "drivers/sercos/protocol/idn.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace stride::sercos::simulation {

/// Which telegrams can carry it.
inline constexpr uint8_t kInAt = 1;
inline constexpr uint8_t kInMdt = 2;

/// When the master has to write it anew at each run-up.
enum class Given : uint8_t { Never, Phase2, Phase3 };

/// What a device knows of an IDN before it is switched on.
struct IdnRow {
  Idn idn = 0;
  std::string_view name;
  std::string_view unit{}; ///< Empty: it has none.
  Attribute attribute{};
  int64_t value = 0;  ///< Of one that is no list.
  int64_t low = 0;    ///< The least and …
  int64_t high = 0;   ///< … the largest value; equal: every value.
  uint8_t cyclic = 0; ///< kInAt, kInMdt.
  Given given = Given::Never;
  std::string_view text{}; ///< Of a text …
  std::vector<Idn> ids{};  ///< … or of a list of IDNs.
  size_t room = 0;         ///< Most bytes of a list, even; 0: what it holds at first.
};

/// A data block. Nothing but the row's strings and the reserved list lies elsewhere.
struct IdnEntry {
  IdnRow row;
  int64_t value = 0;
  std::vector<uint8_t> list; ///< Its bytes; never more than `room`, which is reserved.
  size_t room = 0;
  uint16_t state = 0; ///< data_state.
  bool given = false; ///< It has been written in this run-up.

  [[nodiscard]] bool isList() const { return row.attribute.list; }
  [[nodiscard]] bool isCommand() const { return row.attribute.command; }
  [[nodiscard]] bool hasLimits() const { return !isList() && row.low != row.high; }
  /// Elements of a list of IDNs.
  [[nodiscard]] size_t count() const { return list.size() / 2; }
  [[nodiscard]] Idn id(size_t index) const {
    return static_cast<Idn>(list[2 * index] | (list[2 * index + 1] << 8U));
  }
  void clear() { list.clear(); }
  /// FALSE: there is no room.
  bool add(Idn idn);
  void setText(std::string_view text);
};

/// A value as the attribute has it: cut to its bytes, and sign-extended if it is shown so.
int64_t fitted(const Attribute &attribute, uint64_t bits);

class IdnList {
public:
  /// In any order; the last one of several for the same IDN counts. The lists S-0-0017, S-0-0018,
  /// S-0-0019, S-0-0025, S-0-0187 and S-0-0188 are made of the others.
  explicit IdnList(std::vector<IdnRow> rows);

  /// Null: there is none.
  [[nodiscard]] IdnEntry *find(Idn idn);
  [[nodiscard]] const IdnEntry *find(Idn idn) const;
  /// One that must exist: for the device that has made the rows. Throws std::out_of_range.
  [[nodiscard]] IdnEntry &at(Idn idn);
  /// The value of one, 0 without it.
  [[nodiscard]] int64_t value(Idn idn) const;

  [[nodiscard]] std::span<IdnEntry> entries() { return entries_; }
  [[nodiscard]] std::span<const IdnEntry> entries() const { return entries_; }

private:
  void fillLists();
  void fill(Idn list, bool (*belongs)(const IdnEntry &));

  std::vector<IdnEntry> entries_; ///< In the order of their numbers.
};

} // namespace stride::sercos::simulation

#endif
