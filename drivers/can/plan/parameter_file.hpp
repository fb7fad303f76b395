// Files with parameters of a drive, as SMC_WriteDriveParamsToFile writes them: text or XML.
#ifndef STRIDE_DRIVERS_CAN_PLAN_PARAMETER_FILE_HPP
#define STRIDE_DRIVERS_CAN_PLAN_PARAMETER_FILE_HPP

#include "drivers/can/plan/pdo_plan.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stride::can {

struct ParameterFile {
  /// In the order of the file. Where CiA 402 does not fix the length of an object it is 0: the
  /// drive has to be asked for it.
  std::vector<SdoWrite> writes;
  std::string error; ///< What is wrong, with its line; empty: nothing.
};

/// Text: after a first line `drive;ID` a line `NUMBER;VALUE;NAME;UNIT` for each parameter. XML:
/// elements `<Parameter Number="NUMBER" …>VALUE</Parameter>`. A number is index * 256 + subindex.
ParameterFile readParameterFile(std::string_view text, uint8_t axis = 0);

} // namespace stride::can

#endif
