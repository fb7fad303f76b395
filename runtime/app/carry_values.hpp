// Single values from one type to another.
#ifndef STRIDE_RUNTIME_APP_CARRY_VALUES_HPP
#define STRIDE_RUNTIME_APP_CARRY_VALUES_HPP

#include "runtime/iec/types.h"

#include <cstddef>
#include <cstdint>

namespace stride::app {

/// Converts `count` values; defined for every pair of kinds for which keepsEveryValue holds, else
/// null. None of the functions allocates or throws.
using NumberConversion = void (*)(const std::byte *from, std::byte *to, uint64_t count,
                                  uint64_t fromStride, uint64_t toStride);
NumberConversion numberConversion(Kind from, Kind to);

/// Copies a STRING (unit 1) or WSTRING (unit 2) and clears the rest. False if it was cut.
bool carryText(const std::byte *from, uint32_t fromLength, std::byte *to, uint32_t toLength,
               uint32_t unit) noexcept;

/// An integer of the kind, ULINT and LWORD as their bits.
int64_t readInteger(Kind kind, const std::byte *from) noexcept;
void writeInteger(Kind kind, int64_t value, std::byte *to) noexcept;

} // namespace stride::app

#endif
