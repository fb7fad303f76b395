#ifndef STRIDE_COMPILER_ASSETS_CSY_PATH_SOURCE_HPP
#define STRIDE_COMPILER_ASSETS_CSY_PATH_SOURCE_HPP
// Path files (*.path.toml): a table of points for TrjCompute as text, with what the axes can do.
// Source: TSX CSY 85 configuration manual 35010452, chapter 4.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "runtime/numeric/csy/trajectory_speeds.hpp"

#include <memory>
#include <string>

namespace stc {

/// A path that can be computed.
struct CsyPath {
  stride::csy::TrajectoryTable table;
  stride::csy::Trajectory trajectory;
  stride::csy::Speeds speeds;
  stride::csy::SlaveLimits limits;
};

/// Reads a file and computes its path. Null: what is wrong has been reported, at its point
/// (Code::CsyPath and those of configurations). Numbers are rounded to REAL, as the module has
/// them.
[[nodiscard]] std::unique_ptr<CsyPath> readCsyPath(const SourceFile &file,
                                                   Diagnostics &diagnostics);

/// What a code of the interpolation means, and a way out.
struct CsyProblemText {
  std::string_view message;
  std::string_view help;
};
[[nodiscard]] CsyProblemText textOf(stride::csy::PathError error);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CSY_PATH_SOURCE_HPP
