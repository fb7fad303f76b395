#include "drivers/sercos/protocol/service_error.hpp"

#include <algorithm>
#include <array>

namespace stride::sercos {
namespace {

constexpr std::array<ServiceErrorRow, 42> kRows = {{
    {0x0000, "no error"},
    {0x0001, "the service channel is not open"},
    {0x0009, "invalid access while the service channel closes"},
    {0x1001, "the drive has no such IDN"},
    {0x1009, "invalid access to the IDN"},
    {0x2001, "the IDN has no name"},
    {0x2002, "the name is too short"},
    {0x2003, "the name is too long"},
    {0x2004, "the name can only be read"},
    {0x2005, "the name is write-protected at this time"},
    {0x3002, "the attribute is too short"},
    {0x3003, "the attribute is too long"},
    {0x3004, "the attribute can only be read"},
    {0x3005, "the attribute is write-protected at this time"},
    {0x4001, "the IDN has no unit"},
    {0x4002, "the unit is too short"},
    {0x4003, "the unit is too long"},
    {0x4004, "the unit can only be read"},
    {0x4005, "the unit is write-protected at this time"},
    {0x5001, "the IDN has no minimum"},
    {0x5002, "the minimum is too short"},
    {0x5003, "the minimum is too long"},
    {0x5004, "the minimum can only be read"},
    {0x5005, "the minimum is write-protected at this time"},
    {0x6001, "the IDN has no maximum"},
    {0x6002, "the maximum is too short"},
    {0x6003, "the maximum is too long"},
    {0x6004, "the maximum can only be read"},
    {0x6005, "the maximum is write-protected at this time"},
    {0x7002, "the data is too short"},
    {0x7003, "the data is too long"},
    {0x7004, "the data can only be read"},
    {0x7005, "the data is write-protected at this time, for instance in this phase"},
    {0x7006, "the value is below the minimum"},
    {0x7007, "the value is above the maximum"},
    {0x7008, "the value is not allowed"},
    {0x7009, "the data is protected by a password"},
    {0x700A, "the data is write-protected, it comes cyclically"},
    {0x7010, "the command is active already"},
    {0x7011, "the command cannot be interrupted"},
    {0x7012, "the command cannot be executed at this time"},
    {0x7013, "parameters of the command are invalid"},
}};

} // namespace

std::span<const ServiceErrorRow> serviceErrors() { return kRows; }

std::string_view serviceErrorText(uint16_t code) {
  const auto *row = std::lower_bound(
      kRows.begin(), kRows.end(), code,
      [](const ServiceErrorRow &one, uint16_t wanted) { return one.code < wanted; });
  return row != kRows.end() && row->code == code ? row->text
                                                 : "an error that the standard does not have";
}

} // namespace stride::sercos
