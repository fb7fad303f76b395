#ifndef STRIDE_COMPILER_CLI_CNC_PATH_HPP
#define STRIDE_COMPILER_CLI_CNC_PATH_HPP
// A CNC program driven without an application: what `stride cnc run` and `stride cnc plot` show.

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/cli/commands.hpp"

#include "runtime/numeric/cnc/interpolator.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace stc::cli {

/// The letters of axes by AxisBit; the sixth additional axis has none.
inline constexpr std::string_view kAxisLetters = "XYZABCPQUVW";

/// The path of a program, as an interpolator gets it.
struct CncPath {
  std::vector<stride::cnc::PathObject> objects;
  size_t programmed = 0; ///< Objects that the program has.
  size_t blends = 0;     ///< Objects that corners became.
  size_t stops = 0;      ///< Corners where the path stops.
  double length = 0;     ///< [u]
  uint16_t axes = 0;     ///< Which ones there are, by AxisBit.
};

/// Decodes the program, merges lines, blends corners, and says how fast the path may go from each
/// object to the next. Nothing if it is wrong, which is reported.
[[nodiscard]] std::optional<CncPath>
cncPathOf(const CncProgram &program, const CncMotionOptions &options, Diagnostics &diagnostics);

/// What a cycle has given.
using CncCycle = std::function<void(double time, const stride::cnc::Progress &progress)>;

/// The path takes more cycles than are driven.
inline constexpr int kCncTooLong = -1;

/// Drives the path from its first motion on; M functions are acknowledged at once. Returns the
/// SMC_ERROR that has ended it, kCncTooLong, or 0.
int driveCnc(const CncPath &path, const CncMotionOptions &options, const CncCycle &cycle);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CNC_PATH_HPP
