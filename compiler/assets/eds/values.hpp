// Numbers, accesses and types as data sheets write them.
#ifndef STRIDE_COMPILER_ASSETS_EDS_VALUES_HPP
#define STRIDE_COMPILER_ASSETS_EDS_VALUES_HPP

#include "compiler/assets/eds/device.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace stc::eds {

/// "17", "-3", "0x1F", "1Fh"; nothing: it is no number, or more than 64 bits.
std::optional<int64_t> numberOf(std::string_view text);

/// A number, a sum of one and $NODEID in any order, or $NODEID alone; nothing: none of these.
std::optional<Value> valueOf(std::string_view text);

/// "rw" in any case; nothing: none that there is.
std::optional<Access> accessOf(std::string_view text);

/// "1", "yes", "optional"; nothing: neither this nor its contrary.
std::optional<bool> flagOf(std::string_view text);

/// Fills a value in for an object of that type; what is strange is noted. `what` is the value's
/// name in the file.
std::optional<Value> readValue(std::string_view text, size_t line, const Object &object,
                               std::string_view what, Device &device);

/// Limits that exclude each other are left out, with a note.
void checkLimits(Object &object, Device &device);

/// "6041h:0", as messages name an object.
std::string nameOf(const Object &object);

} // namespace stc::eds

#endif
