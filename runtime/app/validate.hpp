// Checks of an application's description before it is used.
#ifndef STRIDE_RUNTIME_APP_VALIDATE_HPP
#define STRIDE_RUNTIME_APP_VALIDATE_HPP

#include "runtime/app/application.hpp"

namespace stride::app {

/// Throws Error when the description is for another ABI or disagrees with the runtime's layouts.
void checkHead(const StrideAppV1 &description, const RuntimeLayouts &layouts);

/// The same, and Error when the description, which has all its tables, is not consistent in itself
/// (indices, offsets).
void validate(const StrideAppV1 &description, const RuntimeLayouts &layouts);

} // namespace stride::app

#endif
