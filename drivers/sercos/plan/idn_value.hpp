// A value for an IDN, as people write it.
#ifndef STRIDE_DRIVERS_SERCOS_PLAN_IDN_VALUE_HPP
#define STRIDE_DRIVERS_SERCOS_PLAN_IDN_VALUE_HPP

#include "drivers/sercos/protocol/attribute.hpp"
#include "drivers/sercos/protocol/idn.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stride::sercos {

/// What is written to a drive. How long its numbers are, only the drive's attribute says.
struct IdnValue {
  Idn idn = 0;
  std::vector<int64_t> numbers; ///< One, or the elements of a list.
  std::string text;             ///< In place of numbers, where isText.
  bool isText = false;
};

/// Reads "S-0-0041 := 100", "S-0-0016 := S-0-0051, S-0-0040" or "S-0-0142 := 'press'". Numbers are
/// those of the operation data, without its decimal point; with a base as in IEC 61131-3, 16#1F.
/// False: `error` says why.
bool parseIdnValue(std::string_view text, IdnValue &value, std::string &error);

/// Reads the numbers after ":=" only, for files.
bool parseNumbers(std::string_view text, std::vector<int64_t> &numbers);

/// Why a value cannot be what an attribute says.
enum class EncodeFault : uint8_t {
  None,
  NotOne,  ///< The operation data is one number.
  Range,   ///< A number does not fit into the bytes that it has.
  TooLong, ///< There is no room for all.
  NoText,  ///< The operation data is no text.
};
std::string_view describe(EncodeFault fault);

/// The bytes of the operation data, without the two lengths of a list; `count` of them.
EncodeFault encodeValue(const IdnValue &value, const Attribute &attribute, std::span<uint8_t> bytes,
                        size_t &count);

} // namespace stride::sercos

#endif
