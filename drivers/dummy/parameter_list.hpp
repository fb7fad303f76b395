// The parameters of a simulated drive that programs can ask for: MC_ReadParameter with negative
// numbers.
#ifndef STRIDE_DRIVERS_DUMMY_PARAMETER_LIST_HPP
#define STRIDE_DRIVERS_DUMMY_PARAMETER_LIST_HPP

#include "drivers/dummy/drive_parameters.hpp"
#include "runtime/axis/axis_driver.hpp"

namespace stride::dummy {

/// What the parameters are about.
struct ParameterTarget {
  DriveParameters &parameters;
  Mechanics &mechanics;
  const axis::DriveStatus &status;
  double lag; ///< Set position at the drive minus actual position. [inc]
};

/// Answers a question for a parameter of the drive.
axis::ParameterAnswer answerParameter(ParameterTarget &target,
                                      const axis::ParameterRequest &request);

} // namespace stride::dummy

#endif
