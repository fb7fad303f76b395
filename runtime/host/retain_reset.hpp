// `stride-host reset`: retained data of an application that does not run.
#ifndef STRIDE_RUNTIME_HOST_RETAIN_RESET_HPP
#define STRIDE_RUNTIME_HOST_RETAIN_RESET_HPP

#include "runtime/app/retain_store.hpp"
#include "runtime/host/messages.hpp"

#include <cstdint>
#include <string>

namespace stride::host {

/// What the next start begins with, as CODESYS names it.
enum class ResetKind : uint8_t {
  Warm,   ///< RETAIN and PERSISTENT variables as they are, the others initial.
  Cold,   ///< PERSISTENT variables as they are, the others initial.
  Origin, ///< All initial.
};

/// Does it to the file and says (standard output) what is left; false: there is nothing, which it
/// says, too. Throws app::Error, also while the application runs.
bool resetRetained(ResetKind kind, const std::string &file, Messages &messages,
                   app::RetainFiles &files = app::systemFiles());

} // namespace stride::host

#endif
