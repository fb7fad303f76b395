#include "drivers/can/master/sdo_abort.hpp"

#include <algorithm>
#include <array>

namespace stride::can {
namespace {

using enum AbortMeaning;

constexpr std::array<AbortRow, 31> kAbortRows = {{
    {abort_code::kToggle, Failed, "the toggle bit has not changed"},
    {abort_code::kTimedOut, Failed, "no answer in time"},
    {abort_code::kCommand, Failed, "invalid or unknown command specifier"},
    {abort_code::kBlockSize, Failed, "invalid block size"},
    {abort_code::kSequence, Failed, "invalid sequence number"},
    {abort_code::kCrc, Failed, "CRC error"},
    {abort_code::kMemory, Failed, "out of memory"},
    {abort_code::kUnsupported, Refused, "unsupported access to the object"},
    {abort_code::kWriteOnly, Refused, "the object can only be written"},
    {abort_code::kReadOnly, ReadOnly, "the object can only be read"},
    {abort_code::kNoObject, Unknown, "there is no such object"},
    {abort_code::kCannotBeMapped, Refused, "the object cannot be mapped into a PDO"},
    {0x06040042, Refused, "the mapped objects are longer than a PDO"},
    {0x06040043, Refused, "parameters that do not go together"},
    {0x06040047, Refused, "the device contradicts itself"},
    {0x06060000, Failed, "a fault of the hardware"},
    {abort_code::kLength, Refused, "the object has another length"},
    {abort_code::kTooLong, Refused, "the object is shorter"},
    {abort_code::kTooShort, Refused, "the object is longer"},
    {abort_code::kNoSubindex, Unknown, "there is no such subindex"},
    {abort_code::kValueRange, Refused, "the value is not allowed"},
    {abort_code::kValueHigh, Refused, "the value is too high"},
    {abort_code::kValueLow, Refused, "the value is too low"},
    {0x06090036, Refused, "the maximum is less than the minimum"},
    {0x060A0023, Failed, "a resource is not available"},
    {abort_code::kGeneral, Failed, "a general error"},
    {abort_code::kNotStored, Refused, "the value cannot be transferred or stored"},
    {abort_code::kLocalControl, Refused, "not while the device is under local control"},
    {abort_code::kDeviceState, Refused, "not in the present state of the device"},
    {0x08000023, Failed, "the object dictionary is not there"},
    {0x08000024, Failed, "no data available"},
}};

constexpr AbortRow kUnknownCode = {0, Failed, "an abort code that the standard does not have"};

} // namespace

std::span<const AbortRow> abortCodes() { return kAbortRows; }

const AbortRow &abortRow(uint32_t code) {
  const auto *row =
      std::lower_bound(kAbortRows.begin(), kAbortRows.end(), code,
                       [](const AbortRow &one, uint32_t wanted) { return one.code < wanted; });
  return row != kAbortRows.end() && row->code == code ? *row : kUnknownCode;
}

} // namespace stride::can
