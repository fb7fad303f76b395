// Variables at fixed addresses (`AT %MW3`) that another build has elsewhere. The process image is
// memory, which an online change carries over as it is: their values have to go along.
#ifndef STRIDE_RUNTIME_APP_IMAGE_MOVES_HPP
#define STRIDE_RUNTIME_APP_IMAGE_MOVES_HPP

#include "runtime/app/abi.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stride::app {

/// A variable whose address in %Q or %M has changed.
struct ImageMove {
  std::string path;
  uint64_t oldOffset; ///< From the start of the state.
  uint64_t newOffset; ///< From the start of the state.
  uint64_t count;     ///< Bytes; for isBit the old bit's number + 16 * the new bit's.
  bool isBit;         ///< It is, or was, a single bit.
  const char *oldType;
  const char *newType;
  bool sameType; ///< Its value can go along.
};

/// Instead of a bit's number: all bits of a byte.
inline constexpr unsigned kNoBit = 8;

/// Those variables of lists and programs, found by name and by {attribute 'renamed_from'}, in the
/// order of the new build. What lies in %I is left out: its values come from outside.
std::vector<ImageMove> imageMoves(const StrideAppV1 &oldApp, const StrideAppV1 &newApp);

} // namespace stride::app

#endif
