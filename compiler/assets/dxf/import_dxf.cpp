// A drawing becomes programs.
#include "compiler/assets/dxf/dxf.hpp"
#include "compiler/assets/dxf/program.hpp"
#include "compiler/assets/dxf/route.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace dxf;

/// A unit of drawings: $INSUNITS.
struct Unit {
  std::string_view name;
  double mm;
};

Unit unitOf(int32_t number) {
  static constexpr Unit kUnits[] = {{"", 1},
                                    {"inches", 25.4},
                                    {"feet", 304.8},
                                    {"miles", 1609344},
                                    {"mm", 1},
                                    {"cm", 10},
                                    {"m", 1000},
                                    {"km", 1e6},
                                    {"microinches", 25.4e-6},
                                    {"mils", 0.0254},
                                    {"yards", 914.4},
                                    {"angstroms", 1e-7},
                                    {"nm", 1e-6},
                                    {"µm", 1e-3},
                                    {"dm", 100}};
  return number >= 0 && number < static_cast<int32_t>(std::size(kUnits)) ? kUnits[number]
                                                                         : Unit{"", 1};
}

/// Closed contours have up to so many places where they can begin.
constexpr size_t kMostBeginnings = 64;

class Importer {
public:
  Importer(const SourceFile &file, const DxfImport &import, Diagnostics &diagnostics)
      : file_(file), import_(import), diagnostics_(diagnostics), faults_(diagnostics) {}

  std::optional<std::vector<DxfProgram>> run() {
    const std::vector<std::vector<Contour>> groups = read();
    if (faults_.any())
      return std::nullopt;
    std::vector<DxfProgram> programs;
    for (const std::vector<Contour> &group : groups)
      programsOf(group, programs);
    if (!check(programs))
      return std::nullopt;
    return programs;
  }

private:
  [[nodiscard]] Span top() const { return {file_.id(), 0, 0}; }

  /// The contours, in a group for each program (DxfPart::Contour: in one).
  std::vector<std::vector<Contour>> read() {
    const Drawing drawing = readDrawing(file_, faults_);
    if (faults_.any())
      return {};
    Flattening how;
    const double scale = scaleOf(drawing);
    how.scale = {{scale, 0}, {0, scale}, {}};
    how.tolerance = import_.tolerance;
    how.least = std::min(1e-6, import_.epsilon / 4);
    how.layers = {import_.layers.begin(), import_.layers.end()};
    Chains chains = chainsOf(file_, drawing, how, faults_);
    if (faults_.any() || !checkLayers(drawing, chains))
      return {};
    report(chains);
    if (chains.chains.empty())
      faults_.report(top(), "there is nothing in this drawing that a program could follow",
                     "no lines, arcs, circles, polylines, ellipses, splines that are seen",
                     "name layers that are off or frozen with --layer");
    return grouped(std::move(chains.chains));
  }

  double scaleOf(const Drawing &drawing) {
    const Unit unit = unitOf(drawing.unit);
    const double scale = import_.scale.value_or(unit.mm);
    if (!import_.scale && unit.mm != 1)
      diagnostics_
          .report(Code::DxfUnit, top(),
                  fmt::format("the drawing is in {}: the program is in mm", unit.name),
                  fmt::format("$INSUNITS = {}: all is multiplied by {:g}", drawing.unit, unit.mm))
          .help("--scale 1 leaves the numbers as they are");
    return scale;
  }

  /// Layers that the command names are there.
  bool checkLayers(const Drawing &drawing, const Chains &chains) {
    for (const std::string &layer : import_.layers) {
      if (drawing.layers.contains(layer) || chains.used.contains(layer))
        continue;
      std::string names;
      for (const std::string &one : chains.used)
        names += (names.empty() ? "" : ", ") + one;
      faults_.report(top(), fmt::format("this drawing has no layer `{}`", layer),
                     "--layer names it", fmt::format("there are: {}", names));
      return false;
    }
    return true;
  }

  void report(const Chains &chains) {
    for (const auto &[why, out] : chains.leftOut) {
      const std::string how = out.count == 1 ? "1 entity" : fmt::format("{} entities", out.count);
      const std::string message =
          why == "Z" ? fmt::format("Z of {} is left out", how)
                     : fmt::format("{} {} left out: {}", how, out.count == 1 ? "is" : "are", why);
      diagnostics_.report(Code::DxfLeftOut, out.first, message, "the first one");
    }
  }

  /// Chains of one layer are joined; then groups.
  std::vector<std::vector<Contour>> grouped(std::vector<Chain> chains) {
    std::vector<std::string> names;
    std::map<std::string, std::vector<Chain>, NoCase> layers;
    for (Chain &chain : chains) {
      std::vector<Chain> &layer = layers[chain.layer];
      if (layer.empty())
        names.push_back(chain.layer);
      layer.push_back(std::move(chain));
    }
    std::vector<std::vector<Contour>> groups;
    for (const std::string &name : names) {
      std::vector<Contour> contours = contoursOf(std::move(layers[name]), import_.epsilon);
      if (groups.empty() || import_.part == DxfPart::Layer)
        groups.emplace_back();
      std::vector<Contour> &group = groups.back();
      std::move(contours.begin(), contours.end(), std::back_inserter(group));
    }
    return groups;
  }

  /// Turns closed contours so that the tool is on the side of the waste.
  void direct(std::vector<Contour> &contours, const std::vector<int32_t> &parents) const {
    for (size_t i = 0; i < contours.size(); ++i) {
      if (!contours[i].closed)
        continue;
      bool inner = false;
      for (int32_t at = parents[i]; at >= 0; at = parents[static_cast<size_t>(at)])
        inner = !inner;
      const bool counterclockwise = inner == (import_.tool == DxfTool::Left);
      if (isCounterclockwise(contours[i]) != counterclockwise)
        contours[i] = reversed(contours[i]);
    }
  }

  /// Where a closed contour can begin. With a tool in the middle of lines, where it has any: at a
  /// corner the tool would leave a mark.
  [[nodiscard]] std::vector<Beginning> beginningsOf(const Contour &contour) const {
    std::vector<Beginning> all;
    const std::vector<Piece> &pieces = contour.pieces;
    const auto add = [&](size_t piece, double part) {
      const Point place = part == 0 ? pieces[piece].start : placeAt(pieces[piece], part);
      all.push_back({piece, part, place, place});
    };
    if (pieces.size() == 1 && isFull(pieces[0])) {
      for (const double part : {0.0, 0.25, 0.5, 0.75})
        add(0, part);
      return all;
    }
    const size_t step = (pieces.size() + kMostBeginnings - 1) / kMostBeginnings;
    if (import_.tool != DxfTool::None)
      for (size_t i = 0; i < pieces.size(); i += step)
        if (pieces[i].kind == Piece::Kind::Line)
          add(i, 0.5);
    if (all.empty())
      for (size_t i = 0; i < pieces.size(); i += step)
        add(i, 0);
    return all;
  }

  /// Puts the start of a lead-in beside each beginning. Those whose lead-in meets a contour are
  /// left out; if that is all, it becomes shorter.
  void lead(const Contour &contour, const Outlines &outlines, std::vector<Beginning> &all) {
    constexpr int kHalvings = 4;
    constexpr double kNext = 0.05; // of the lead-in: next to its own contour
    double length = import_.leadIn;
    for (int i = 0; i <= kHalvings; ++i, length /= 2) {
      std::vector<Beginning> free;
      for (Beginning beginning : all) {
        const Point ahead = directionAt(contour.pieces[beginning.piece], beginning.part);
        const Point left{-ahead.y, ahead.x};
        const Point way = left * (import_.tool == DxfTool::Left ? length : -length);
        beginning.from = beginning.to + way;
        if (!outlines.areMet(beginning.from, beginning.to + way * kNext))
          free.push_back(beginning);
      }
      if (!free.empty()) {
        all = std::move(free);
        return;
      }
    }
    diagnostics_.report(Code::DxfLeftOut, top(),
                        fmt::format("the contour at X{:g} Y{:g} has no room for a lead-in",
                                    contour.start().x, contour.start().y),
                        "in this drawing");
  }

  [[nodiscard]] std::vector<Stop> stopsOf(const std::vector<Contour> &contours,
                                          const std::vector<int32_t> &parents) {
    std::optional<Outlines> outlines;
    if (import_.tool != DxfTool::None && import_.leadIn > 0)
      outlines.emplace(contours);
    std::vector<Stop> stops;
    for (size_t i = 0; i < contours.size(); ++i) {
      const Contour &contour = contours[i];
      Stop stop;
      stop.closed = contour.closed;
      if (import_.insideFirst)
        stop.within = parents[i];
      if (contour.closed)
        stop.beginnings = beginningsOf(contour);
      else
        stop.beginnings = {{0, 0, contour.start(), contour.end()},
                           {0, 0, contour.end(), contour.start()}};
      if (contour.closed && outlines)
        lead(contour, *outlines, stop.beginnings);
      stops.push_back(std::move(stop));
    }
    return stops;
  }

  [[nodiscard]] Cut cutOf(const Contour &contour, const Stop &stop, const Visit &visit) const {
    const Beginning &beginning = stop.beginnings[visit.beginning];
    Cut cut;
    cut.from = beginning.from;
    cut.corrected = contour.closed && import_.tool != DxfTool::None;
    if (contour.closed)
      cut.contour = startingAt(contour, beginning.piece, beginning.part);
    else
      cut.contour = visit.beginning == 0 ? contour : reversed(contour);
    return cut;
  }

  void programsOf(std::vector<Contour> contours, std::vector<DxfProgram> &programs) {
    std::vector<int32_t> parents;
    if (import_.insideFirst || import_.tool != DxfTool::None)
      parents = nestingOf(contours);
    if (import_.tool != DxfTool::None)
      direct(contours, parents);
    const std::vector<Stop> stops = stopsOf(contours, parents);
    const Point start{import_.start[0], import_.start[1]};
    const std::vector<Visit> route = routeOf(stops, start);
    std::vector<Cut> cuts;
    for (const Visit &visit : route)
      cuts.push_back(cutOf(contours[visit.contour], stops[visit.contour], visit));
    if (import_.part == DxfPart::Contour) {
      for (size_t i = 0; i < cuts.size(); ++i)
        programs.push_back(programOf({cuts[i]}));
      return;
    }
    DxfProgram program = programOf(cuts);
    program.travel = travelOf(stops, route, start);
    program.drawnTravel = travelOf(stops, drawnRoute(stops), start);
    programs.push_back(std::move(program));
  }

  [[nodiscard]] DxfProgram programOf(const std::vector<Cut> &cuts) const {
    DxfProgram program;
    program.layer = cuts.front().contour.layer;
    program.contours = cuts.size();
    program.closed = static_cast<size_t>(
        std::count_if(cuts.begin(), cuts.end(), [](const Cut &cut) { return cut.contour.closed; }));
    program.text =
        programText(std::filesystem::path(file_.name()).filename().string(), cuts, import_);
    return program;
  }

  /// Whether words of the command have made wrong programs.
  bool check(const std::vector<DxfProgram> &programs) {
    if (programs.empty())
      return false;
    Sources sources;
    Diagnostics found;
    const SourceFile &text = sources.file(sources.add("a.cnc", programs.front().text));
    if (const auto program = readCnc(text, found))
      checkCnc(*program, found);
    for (const Diagnostic &one : found.all())
      if (one.severity == Severity::Error) {
        diagnostics_
            .report(Code::CncSentence, {},
                    fmt::format("the program would be wrong: {}", one.message))
            .help("correct --words, --on, --off");
        return false;
      }
    return true;
  }

  const SourceFile &file_;
  const DxfImport &import_;
  Diagnostics &diagnostics_;
  Faults faults_;
};

} // namespace

std::optional<std::vector<DxfProgram>> importDxf(const SourceFile &file, const DxfImport &import,
                                                 Diagnostics &diagnostics) {
  return Importer(file, import, diagnostics).run();
}

} // namespace stc
