// stride cam

#include "compiler/cli/cam.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/syntax/st_text.hpp"

#include "runtime/numeric/cam/bounds.hpp"
#include "runtime/numeric/cam/element_block.hpp"
#include "runtime/numeric/cam/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

namespace {

using namespace stride::cam;

constexpr std::string_view kNumbers[] = {"", "INT", "UINT", "DINT", "UDINT", "REAL", "LREAL"};

/// The path with another ending than the cam's own.
std::string withEnding(const std::string &path, std::string_view ending) {
  std::string stem = path;
  for (const std::string_view own : {kCamSuffix, std::string_view(".cam")})
    if (lowerCase(stem).ends_with(own)) {
      stem.resize(stem.size() - own.size());
      return stem.append(ending);
    }
  return std::filesystem::path(path).replace_extension("").string().append(ending);
}

std::string unitsOf(const CamSource &cam, std::string_view power) {
  if (cam.slaveUnit.empty() && cam.masterUnit.empty())
    return {};
  const std::string slave = cam.slaveUnit.empty() ? "u" : cam.slaveUnit;
  const std::string master = cam.masterUnit.empty() ? "u" : cam.masterUnit;
  return power.empty() ? " " + slave : fmt::format(" {}/{}{}", slave, master, power.substr(1));
}

/// Rounded to what can be read; no `-0`.
std::string shown(double value) {
  const std::string text = fmt::format("{:.9g}", value);
  return text == "-0" ? "0" : text;
}

/// A limit that rounding has left of 0, or the value.
double cleared(double value, double size) {
  constexpr double kRounding = 1e-10; // of what the values around it come to
  return std::fabs(value) <= kRounding * size ? 0.0 : value;
}

void clearRounding(Range &range, double size) {
  size = std::max({size, std::fabs(range.low), std::fabs(range.high)});
  range = {cleared(range.low, size), cleared(range.high, size)};
}

/// The greatest position by its magnitude. [slave u]
double sizeOf(const Bounds &bounds) {
  return std::max(std::fabs(bounds.position.low), std::fabs(bounds.position.high));
}

/// The curve's bounds as they are shown. What is small beside a slave that covers its position once
/// over the whole cam comes from rounding.
Bounds shownBounds(const Curve &curve, const MasterLimits &master) {
  Bounds bounds = boundsOf(curve, master);
  const double slope = sizeOf(bounds) / (curve.end - curve.start);
  const double bend = slope / (curve.end - curve.start);
  clearRounding(bounds.position, 0.0);
  clearRounding(bounds.velocity, slope * master.velocity);
  clearRounding(bounds.acceleration,
                bend * master.velocity * master.velocity + slope * master.acceleration);
  return bounds;
}

std::string rangeText(const Range &range) {
  return fmt::format("{} … {}", shown(range.low), shown(range.high));
}

/// A session of one command: what it reads, and what is wrong with it.
class Session {
public:
  explicit Session(const CamOptions &options) : options_(options) {}

  std::optional<LoadedCam> load(const std::string &path) {
    return loadCam(path, sources_, diagnostics_);
  }
  /// Only a cam with a curve.
  std::optional<LoadedCam> loadCurve(const std::string &path) {
    std::optional<LoadedCam> cam = load(path);
    if (cam && cam->segments.empty()) {
      diagnostics_.report(Code::CamUnreadable, {},
                          fmt::format("`{}` has tappets only, no curve", path));
      cam.reset();
    }
    return cam;
  }
  Diagnostics &diagnostics() { return diagnostics_; }
  Sources &sources() { return sources_; }

  void write(const std::string &path, const std::string &text) {
    if (!writeFile(path, text))
      diagnostics_.report(Code::CannotWrite, {},
                          fmt::format("`{}` cannot be written: {}", path, lastError()));
    else
      written_ += path + "\n";
  }

  int finish() {
    Diagnostics sorted = diagnostics_;
    sorted.sort();
    const int exitCode = show(sorted.all(), sources_, options_.output);
    if (exitCode == 0 && !written_.empty())
      print(written_);
    return exitCode;
  }

private:
  const CamOptions &options_;
  Sources sources_;
  Diagnostics diagnostics_;
  std::string written_;
};

/// How the data of a compiled cam look.
std::string dataText(const LoadedCam &cam) {
  const CamFileHeader &header = cam.data.header;
  const auto bytes = elementBlockSize(header.form, header.element, header.elements);
  std::string text;
  switch (header.form) {
  case Form::Nodes:
    text = fmt::format("{} points with velocity and acceleration", header.elements);
    break;
  case Form::Segments:
    text = fmt::format("{} segments", header.elements);
    break;
  case Form::EvenTable:
  case Form::PairTable:
    text = fmt::format("{} {} of {}, {} between them", header.elements,
                       header.form == Form::EvenTable ? "places at even distances" : "pairs",
                       kNumbers[static_cast<size_t>(header.element)],
                       header.cubic ? "cubic curves" : "lines");
    break;
  }
  return fmt::format("{}, {} bytes{}", text, bytes,
                     cam.kind == LoadedCam::Kind::Source && cam.source.compile.mode == CamMode::None
                         ? " (not compiled into the project)"
                         : "");
}

/// How far a table lies off the curve that it stands for, at most, as samples show it.
double deviationOf(const LoadedCam &cam) {
  const Curve ideal = cam.curve();
  const Curve table = cam.data.curve();
  uint32_t at = 0;
  uint32_t in = 0;
  double most = 0;
  const uint32_t pieces = pieceCount(table);
  for (uint32_t i = 0; i < pieces; ++i) {
    const Segment piece = pieceOf(table, i, cam.source.periodic);
    for (int k = 0; k <= 8; ++k) {
      const double x = std::clamp(piece.start + (piece.end - piece.start) * k / 8, cam.source.start,
                                  cam.source.end);
      const double y = evaluateCurve(ideal, x, cam.source.periodic, at).y;
      most = std::max(most, std::fabs(y - evaluateCurve(table, x, cam.source.periodic, in).y));
    }
  }
  return most;
}

std::string describeCam(const std::string &path, const LoadedCam &cam) {
  const CamSource &source = cam.source;
  std::string text =
      fmt::format("{}{}\n", path, source.name.text.empty() ? "" : ": " + source.name.text);
  const std::string master = source.masterUnit.empty() ? "" : " " + source.masterUnit;
  text += fmt::format("  master        {} … {}{}{}\n", shown(source.start), shown(source.end),
                      master, source.periodic ? ", periodic" : "");
  if (cam.segments.empty())
    return text + fmt::format("  tappets       {}\n", source.tappets.size());
  const Bounds bounds = shownBounds(cam.curve(), {});
  text += fmt::format("  position      {}{}\n", rangeText(bounds.position), unitsOf(source, ""));
  text += fmt::format("  velocity      up to {}{}\n", shown(bounds.velocity.high),
                      unitsOf(source, " "));
  text += fmt::format("  acceleration  {}{}\n", rangeText(bounds.acceleration),
                      unitsOf(source, " \xC2\xB2"));
  const Segment &last = cam.segments.back();
  const double rise =
      evaluateSegment(last, last.end).y - evaluateSegment(cam.segments.front(), source.start).y;
  text += fmt::format("  rise          {}{}\n", shown(cleared(rise, sizeOf(bounds))),
                      unitsOf(source, ""));
  if (!source.tappets.empty())
    text += fmt::format("  tappets       {}\n", source.tappets.size());
  if (cam.kind != LoadedCam::Kind::Table)
    text += fmt::format("  data          {}\n", dataText(cam));
  const bool isTable = cam.data.header.elements != 0 && (cam.data.header.form == Form::EvenTable ||
                                                         cam.data.header.form == Form::PairTable);
  if (isTable && cam.kind == LoadedCam::Kind::Source)
    text += fmt::format("  off the curve up to {:.3g}{}\n",
                        cleared(deviationOf(cam), sizeOf(bounds)), unitsOf(source, ""));
  return text;
}

/// A table of the runtime has jumps of velocity by nature.
void reportJumps(const std::string &path, const LoadedCam &cam, Diagnostics &diagnostics) {
  if (cam.kind != LoadedCam::Kind::Binary || cam.data.header.form != Form::Segments)
    return;
  for (const CamJump &jump : jumpsOf(cam.segments, false, 0))
    diagnostics.report(Code::CamJump, {},
                       fmt::format("`{}`: the {} jumps from {:.6g} to {:.6g} at master position {}",
                                   path, jump.what, jump.before, jump.behind, jump.x));
}

int camCheck(const CamOptions &options) {
  int exitCode = 0;
  for (const std::string &path : options.files) {
    Session session(options);
    Levels levels;
    levels.set(Code::CamJump, Severity::Error);
    session.diagnostics().setLevels(levels);
    const std::optional<LoadedCam> cam = session.load(path);
    if (cam) {
      print(describeCam(path, *cam));
      reportJumps(path, *cam, session.diagnostics());
    }
    exitCode = std::max(exitCode, session.finish());
  }
  return exitCode;
}

int camBounds(const CamOptions &options) {
  Session session(options);
  if (const std::optional<LoadedCam> cam = session.loadCurve(options.files.front())) {
    const Bounds bounds =
        shownBounds(cam->curve(), {options.masterVelocity, options.masterAcceleration});
    const std::string slave = cam->source.slaveUnit.empty() ? "u" : cam->source.slaveUnit;
    print(fmt::format("position      {} {}\nvelocity      {} {}/s\nacceleration  {} {}/s\xC2\xB2\n",
                      rangeText(bounds.position), slave, rangeText(bounds.velocity), slave,
                      rangeText(bounds.acceleration), slave));
  }
  return session.finish();
}

int camPlot(const CamOptions &options) {
  Session session(options);
  const std::string &path = options.files.front();
  if (!options.out.empty() &&
      lowerCase(std::filesystem::path(options.out).extension().string()) != ".svg")
    return showError(Code::CannotWrite, fmt::format("`{}`: a cam is drawn as .svg", options.out),
                     options.output);
  if (const std::optional<LoadedCam> cam = session.loadCurve(path))
    session.write(options.out.empty() ? withEnding(path, ".svg") : options.out, drawCam(*cam));
  return session.finish();
}

int camExport(const CamOptions &options) {
  Session session(options);
  const std::string &path = options.files.front();
  if (const std::optional<LoadedCam> cam = session.loadCurve(path)) {
    const Curve curve = cam->curve();
    std::vector<CamPlace> places;
    uint32_t index = 0;
    for (size_t i = 0; i < options.points; ++i) {
      const double part = static_cast<double>(i) / static_cast<double>(options.points - 1);
      const double x =
          i + 1 == options.points ? curve.end : curve.start + part * (curve.end - curve.start);
      places.push_back({x, evaluateCurve(curve, x, cam->source.periodic, index).y});
    }
    session.write(options.out.empty() ? withEnding(path, ".txt") : options.out, placesText(places));
  }
  return session.finish();
}

/// Writes a cam file, unless reading it again would find something wrong.
void writeSource(Session &session, const CamOptions &options, CamSource &source,
                 std::string_view comment) {
  const std::string &path = options.files.front();
  const std::string target = options.out.empty() ? withEnding(path, kCamSuffix) : options.out;
  if (options.out.empty() && target == path) {
    session.diagnostics()
        .report(Code::CannotWrite, {}, fmt::format("`{}` would be replaced", path))
        .help("name another file with `-o FILE`");
    return;
  }
  if (!options.name.empty())
    source.name.text = options.name;
  const std::string text = camFileText(source, comment);
  Diagnostics &diagnostics = session.diagnostics();
  const FileId id = session.sources().add(target, text);
  if (readCam(session.sources().file(id), diagnostics))
    session.write(target, text);
}

std::string reducedText(size_t points, double tolerance) {
  return fmt::format("{} points, off the curve by {} at most", points, shown(tolerance));
}

/// Replaces the elements by as few points as the tolerance allows; false: it cannot.
bool reduce(Session &session, const LoadedCam &cam, double tolerance, CamSource &source,
            const std::string &path) {
  const std::vector<Node> nodes = reduceCurve(cam.curve(), source.periodic, tolerance);
  if (nodes.empty()) {
    session.diagnostics().report(
        Code::CamTable, {},
        fmt::format("`{}` cannot be reduced within {}: the tolerance is too small", path,
                    shown(tolerance)));
    return false;
  }
  source.elements.clear();
  for (const Node &node : nodes) {
    CamElement element;
    element.left = element.right = node;
    source.elements.push_back(element);
  }
  return true;
}

int camImport(const CamOptions &options) {
  Session session(options);
  const std::string &path = options.files.front();
  if (std::optional<LoadedCam> cam = session.loadCurve(path)) {
    if (options.periodic && cam->kind == LoadedCam::Kind::Table) {
      joinEnds(cam->source);
      cam->segments = segmentsOf(cam->source);
    }
    CamSource source = cam->source;
    source.periodic = options.periodic;
    source.interval = options.interval;
    std::string comment =
        fmt::format("Imported from {}", std::filesystem::path(path).filename().string());
    bool good = true;
    if (options.tolerance > 0) {
      good = reduce(session, *cam, options.tolerance, source, path);
      comment += ": " + reducedText(source.elements.size(), options.tolerance);
    }
    if (good)
      writeSource(session, options, source, comment);
  }
  return session.finish();
}

int camReduce(const CamOptions &options) {
  Session session(options);
  const std::string &path = options.files.front();
  if (const std::optional<LoadedCam> cam = session.loadCurve(path)) {
    CamSource source = cam->source;
    const size_t before = source.elements.size();
    if (reduce(session, *cam, options.tolerance, source, path)) {
      writeSource(session, options, source,
                  fmt::format("{}: {}", std::filesystem::path(path).filename().string(),
                              reducedText(source.elements.size(), options.tolerance)));
      if (!session.diagnostics().hasErrors())
        print(before == 0 ? fmt::format("{} points\n", source.elements.size())
                          : fmt::format("{} points instead of {} elements\n",
                                        source.elements.size(), before));
    }
  }
  return session.finish();
}

int camWrite(const CamOptions &options) {
  Session session(options);
  const std::string &path = options.files.front();
  if (const std::optional<LoadedCam> cam = session.load(path)) {
    if (cam->kind == LoadedCam::Kind::Table) {
      session.diagnostics()
          .report(Code::CamUnreadable, {}, fmt::format("`{}` is a table of positions", path))
          .help("make a cam file of it first: `stride cam import`");
      return session.finish();
    }
    std::string bytes(static_cast<size_t>(camFileSize(cam->data.header)), '\0');
    writeCamFile(cam->data.header, cam->data.elements(), cam->data.tappets.data(),
                 reinterpret_cast<uint8_t *>(bytes.data()));
    session.write(options.out.empty() ? withEnding(path, ".CAM") : options.out, bytes);
  }
  return session.finish();
}

int camRead(const CamOptions &options) {
  Session session(options);
  const std::string &path = options.files.front();
  if (const std::optional<LoadedCam> cam = session.load(path)) {
    CamSource source = cam->source;
    if (cam->kind == LoadedCam::Kind::Binary && !elementsOf(*cam, source)) {
      session.diagnostics()
          .report(Code::CamUnreadable, {},
                  fmt::format("`{}` has segments that a cam file cannot describe", path))
          .help("`stride cam reduce` describes its curve by points, within a tolerance");
      return session.finish();
    }
    writeSource(session, options, source,
                fmt::format("Read from {}", std::filesystem::path(path).filename().string()));
  }
  return session.finish();
}

} // namespace

int camCommand(const CamOptions &options) {
  switch (options.action) {
  case CamAction::Check:
    return camCheck(options);
  case CamAction::Bounds:
    return camBounds(options);
  case CamAction::Plot:
    return camPlot(options);
  case CamAction::ExportTable:
    return camExport(options);
  case CamAction::ImportTable:
    return camImport(options);
  case CamAction::Reduce:
    return camReduce(options);
  case CamAction::Write:
    return camWrite(options);
  case CamAction::Read:
    return camRead(options);
  }
  return 0;
}

} // namespace stc::cli
