#ifndef STRIDE_COMPILER_ASSETS_CAM_CAM_SOURCE_HPP
#define STRIDE_COMPILER_ASSETS_CAM_CAM_SOURCE_HPP
// Cam files, *.cam.toml: what the cam editor of SoftMotion shows (V2.3 manual, chapter 4).

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/ast.hpp"
#include "compiler/toml/schema.hpp"
#include "runtime/numeric/cam/cam_file.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stc {

/// The suffix of cam files.
inline constexpr std::string_view kCamSuffix = ".cam.toml";

/// A point, a line or a law of a cam, between two places; those of a point are the same.
struct CamElement {
  enum class Kind : uint8_t { Point, Line, Law };
  Kind kind = Kind::Point;
  stride::cam::Node left{};
  stride::cam::Node right{};
  stride::cam::LawShape shape;
  /// Points: v and a are chosen so that the gaps around get the least jerk; with `given` 1 only a.
  bool smooth = false;
  int given = 0;
  Span span; ///< of its header
};

/// The whole of a cam file, as the section without a name.
[[nodiscard]] const SectionSchema &camSchema();

/// How a cam becomes data: manual, section 4.4.3.
enum class CamMode : uint8_t { Polynomial, Equidistant, ElementOptimised, None };

struct CamCompile {
  CamMode mode = CamMode::Polynomial;
  stride::cam::Element type = stride::cam::Element::Lreal; ///< of tables
  int32_t places = 0;                                      ///< of tables
  bool cubic = false;                                      ///< tables: cubic between the places
  /// Numbers in the table for the two ends of the master's and the slave's scale.
  std::optional<std::pair<double, double>> masterNumbers;
  std::optional<std::pair<double, double>> slaveNumbers;
  Span span; ///< of what says how many places, or of the mode
};

/// A cam as its file describes it.
struct CamSource {
  ConfigName name;
  bool periodic = false;
  double interval = 0; ///< periodic: the end may lie by multiples of it further; 0: not at all
  double start = 0;    ///< [master u]
  double end = 0;      ///< [master u]
  std::string masterUnit;
  std::string slaveUnit;
  std::optional<std::pair<double, double>> slaveScale; ///< minimum and maximum [slave u]
  std::vector<CamElement> elements; ///< ascending, from start to end; none: tappets only
  std::vector<stride::cam::FileTappet> tappets; ///< in the order of the file
  CamCompile compile;
};

/// Reads and checks a cam file. Everything wrong is reported; with errors nothing is returned.
[[nodiscard]] std::optional<CamSource> readCam(const SourceFile &file, Diagnostics &diagnostics);

/// Gives the smooth points of a cam their velocity and acceleration: those with which the integral
/// of the squared jerk over the gaps is least. False: they cannot be computed.
[[nodiscard]] bool smoothen(CamSource &cam);

/// The curve of a cam: its lines and laws, and between the elements polynomials of degree 5 that
/// keep position, velocity and acceleration continuous.
[[nodiscard]] std::vector<stride::cam::Segment> segmentsOf(const CamSource &cam);

/// Where a curve of segments jumps.
struct CamJump {
  std::string_view what; ///< "position", "velocity", "acceleration"
  double x = 0;          ///< [master u]
  double before = 0;     ///< [slave u], [slave u/master u], [slave u/master u²]
  double behind = 0;
};

/// All jumps between segments, for a periodic cam also from its end to its start. Differences of
/// 1e-9 of the greatest value at a joint are none.
[[nodiscard]] std::vector<CamJump> jumpsOf(const std::vector<stride::cam::Segment> &segments,
                                           bool periodic, double interval);

/// A compiled cam: what MC_CAM_REF holds and points at.
struct CamData {
  stride::cam::CamFileHeader header;
  std::vector<double> storage; ///< what pce points at, aligned as a double is
  std::vector<stride::cam::FileTappet> tappets;

  [[nodiscard]] const void *elements() const { return storage.data(); }
  [[nodiscard]] stride::cam::Curve curve() const {
    return stride::cam::curveOfFile(header, storage.data());
  }
};

/// The data of a cam as its file wants them; CamMode::None counts as polynomial. What a table
/// cannot hold is reported, and nothing is returned.
[[nodiscard]] std::optional<CamData> compileCam(const CamSource &cam, Diagnostics &diagnostics);

/// Cams as ST: the list of globals CAM_Data with an MC_CAM_REF per cam, hidden variables with its
/// points and tappets, _SMC_CAM_LIST and _SMC_CAM_COUNT. May be empty. Cams named like something in
/// `files` or like another cam are reported and left out.
[[nodiscard]] SyntheticSource camDeclarations(const std::vector<CamSource> &cams,
                                              const std::vector<ast::File *> &files,
                                              Diagnostics &diagnostics);

/// A cam file that describes the points, with the tappets; `comment` stands above.
[[nodiscard]] std::string camFileText(const CamSource &cam, std::string_view comment);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CAM_CAM_SOURCE_HPP
