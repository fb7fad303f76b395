#ifndef STRIDE_COMPILER_ASSETS_DXF_DXF_HPP
#define STRIDE_COMPILER_ASSETS_DXF_DXF_HPP
// Drawings in DXF, as ASCII: CNC programs are made of them, and they of CNC programs (V2.3 manual,
// section 3.3, "Import DXF file"). Both work on texts: no files, nothing is shown. What DXF means
// is as Autodesk's public DXF reference describes it, R12 to 2018.

#include "compiler/assets/cnc/cnc_source.hpp"

#include <optional>
#include <string>
#include <vector>

namespace stc {

/// Bytes of a drawing at most.
inline constexpr size_t kMaxDxfBytes = size_t{64} << 20U;

/// What becomes a program of its own.
enum class DxfPart : uint8_t { File, Layer, Contour };

/// On which side of closed contours the tool goes.
enum class DxfTool : uint8_t {
  None,
  Left,  ///< G41: inner contours counterclockwise, outer ones clockwise.
  Right, ///< G42: the other way round.
};

/// How programs are made of a drawing.
struct DxfImport {
  std::vector<std::string> layers; ///< Only these, be they frozen or off; none: all that are not.
  DxfPart part = DxfPart::File;
  double epsilon = 0.001;      ///< Ends so close are one place. Positive. [u]
  double tolerance = 0.001;    ///< Of splines that become arcs. Positive. [u]
  std::optional<double> scale; ///< Of all coordinates; nothing: from the drawing's unit to mm.
  bool insideFirst = false;    ///< Contours within others before these.
  double start[2]{};           ///< Where the tool is before. X, Y. [u]
  bool back = false;           ///< G0 to `start` at the end.
  std::string words;           ///< Of the first motion: `F100 E500`.
  std::optional<double> safeZ; ///< Above the workpiece: G0 goes there. [u]
  std::optional<double> depth; ///< Contours are driven there. [u]
  double plungeFeed = 0;       ///< F down to `depth`, needs `feed`; 0: as contours. [u/s]
  double feed = 0;             ///< F of contours; 0: as `words` say. [u/s]
  std::vector<std::string>
      on; ///< At the start of each contour: `M3`, or `H1`, which stops nothing.
  std::vector<std::string> off; ///< At the end of each contour.
  DxfTool tool = DxfTool::None;
  double toolRadius = 0;   ///< D of G41, G42. [u]
  double leadIn = 0;       ///< Closed contours begin so far beside them, on the tool's side. [u]
  bool avoidLoops = false; ///< G61, G60 around each of them.
};

/// One of the programs.
struct DxfProgram {
  std::string layer; ///< Of DxfPart::Layer.
  std::string text;
  size_t contours = 0;
  size_t closed = 0;      ///< How many of them are closed.
  double travel = 0;      ///< Between contours in X and Y. [u]
  double drawnTravel = 0; ///< The same in the order and direction of the drawing. [u]
};

/// The programs of a drawing. Where the file is no drawing, or says what is not possible, that is
/// reported (SE0893), and nothing returned. What is left out is reported as a warning (SE0894).
[[nodiscard]] std::optional<std::vector<DxfProgram>>
importDxf(const SourceFile &file, const DxfImport &import, Diagnostics &diagnostics);

/// How a drawing is made of a program.
struct DxfExport {
  double tolerance = 0.001; ///< Of helices, which become lines. Positive. [u]
  bool rapid = false;       ///< G0 as well, in the layer RAPID.
};

/// The drawing of the path of a program that has no errors, in mm (AutoCAD 2000): lines, arcs,
/// circles, ellipses and splines in the layer PATH. Nothing if decoding it ends with an error,
/// which is reported.
[[nodiscard]] std::optional<std::string> exportDxf(const CncProgram &program, const DxfExport &how,
                                                   Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_DXF_DXF_HPP
