// Parameters of a drive in a file, as SMC_WriteDriveParamsToFile writes it.
#ifndef STRIDE_DRIVERS_SERCOS_PARAMETER_FILE_HPP
#define STRIDE_DRIVERS_SERCOS_PARAMETER_FILE_HPP

#include "drivers/sercos/plan/idn_value.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stride::sercos {

/// Reads lines "number;value;name;unit", or the XML that the block writes; numbers are IDNs.
/// False: `error` says what is wrong, with the line.
bool readParameterFile(std::string_view text, std::vector<IdnValue> &values, std::string &error);

} // namespace stride::sercos

#endif
