// The parameters of a simulated drive that programs can ask for: MC_ReadParameter with negative
// numbers.
#ifndef STRIDE_DRIVERS_DUMMY_PARAMETER_LIST_HPP
#define STRIDE_DRIVERS_DUMMY_PARAMETER_LIST_HPP

#include "drivers/dummy/drive_parameters.hpp"
#include "runtime/bus/axis_driver.hpp"

namespace stride::dummy {

/// What the parameters are about.
struct ParameterTarget {
  DriveParameters &parameters;
  Mechanics &mechanics;
  const bus::DriveStatus &status;
  double lag; ///< Set position at the drive minus actual position. [inc]
};

/// Answers a question for a parameter of the drive.
bus::ParameterAnswer answerParameter(ParameterTarget &target, const bus::ParameterRequest &request);

} // namespace stride::dummy

#endif
