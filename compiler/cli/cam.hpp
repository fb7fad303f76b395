#ifndef STRIDE_COMPILER_CLI_CAM_HPP
#define STRIDE_COMPILER_CLI_CAM_HPP
// What the commands of `stride cam` work on.

#include "compiler/assets/cam/cam_source.hpp"
#include "compiler/cli/commands.hpp"
#include "compiler/source/sources.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::cli {

/// A cam that a command was given: a cam file, a binary file, or a table of positions.
struct LoadedCam {
  enum class Kind { Source, Binary, Table };
  Kind kind = Kind::Source;
  CamSource source; ///< of the other two what they say: name, ends, tappets
  CamData data;     ///< compiled; of a table of positions without elements
  std::vector<stride::cam::Segment> segments; ///< its curve

  /// The curve, good as long as this does not move.
  [[nodiscard]] stride::cam::Curve curve() const;
};

/// A place of a table of positions.
struct CamPlace {
  double x = 0; ///< [master u]
  double y = 0; ///< [slave u]
};

/// Reads any of the three by what the name ends with: `.cam.toml`, `.cam`, anything else is a
/// table. What is wrong is reported.
[[nodiscard]] std::optional<LoadedCam> loadCam(const std::string &path, Sources &sources,
                                               Diagnostics &diagnostics);

/// Reads `master;slave` or `master:slave`, a place a line, ascending by the master; decimals after
/// a dot or a comma. What is wrong is reported.
[[nodiscard]] std::optional<std::vector<CamPlace>> readPlaces(const SourceFile &file,
                                                              Diagnostics &diagnostics);

/// The same as a text: `master;slave` with CR and LF.
[[nodiscard]] std::string placesText(const std::vector<CamPlace> &places);

/// The places as points of a cam, with velocity and acceleration of the parabola through each and
/// its neighbours. `cam` has at least two elements afterwards.
void pointsThrough(const std::vector<CamPlace> &places, CamSource &cam);

/// Makes the ends of a periodic cam of points fit: both get the parabola through the place before
/// the end, the joint and the place after the start.
void joinEnds(CamSource &cam);

/// Gives `cam` the elements of a curve: points of nodes, else lines and laws. False: the curve has
/// pieces that a cam file cannot describe.
[[nodiscard]] bool elementsOf(const LoadedCam &from, CamSource &cam);

/// Position, velocity, acceleration and jerk over the master, tappets marked.
[[nodiscard]] std::string drawCam(const LoadedCam &cam);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CAM_HPP
