// The names of SMC_ERROR, for messages.
#ifndef STRIDE_RUNTIME_HOST_ERROR_NAMES_HPP
#define STRIDE_RUNTIME_HOST_ERROR_NAMES_HPP

#include <cstdint>
#include <string>

namespace stride::host {

/// "SMC_FB_WASNT_CALLED_DURING_MOTION (30)"; without a name "error 999".
std::string motionErrorText(uint32_t error);

} // namespace stride::host

#endif
