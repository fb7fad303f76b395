#include "compiler/assets/csy/path_source.hpp"

#include "compiler/assets/csy/firmware.hpp"
#include "compiler/toml/schema.hpp"

#include <array>
#include <fmt/format.h>
#include <vector>

namespace stc {

namespace {

using namespace stride::common;
using stride::csy::PathError;
using stride::csy::Problem;
using stride::csy::SegmentType;
using stride::csy::TablePoint;

constexpr double kMostReal = 3.4028234663852886e38;
constexpr double kMostInt = 32767;

constexpr Parameter number(std::string_view name, std::string_view unit = "mm") {
  return real(name, -kMostReal, kMostReal, unit);
}

constexpr std::array<Choice, 8> kTypes = {{{"line", 0},
                                           {"cubic", 1},
                                           {"quintic", 2},
                                           {"blend_arc", 10},
                                           {"arc_by_radius", 11},
                                           {"arc_by_centre", 12},
                                           {"tool", 100},
                                           {"tool_other_side", 101}}};

constexpr std::array kPointKeys = {
    number("x").needed(),
    number("y").needed(),
    number("z"),
    choice("type", kTypes).defaultsTo(0.0),
    number("Vset", "mm/s").defaultsTo(0.0),
    number("lracc1"),
    number("lracc2"),
    number("R"),
    number("Xc"),
    number("Yc"),
    whole("NpLin", 0, kMostInt).defaultsTo(1),
    whole("NpRacc", 0, kMostInt).defaultsTo(15),
    whole("KF", 0, kMostInt, "%").defaultsTo(100),
    flag("clockwise").defaultsTo(0.0),
    flag("over_180").defaultsTo(0.0),
};
constexpr std::array kAxisKeys = {
    notNegative("SPEED_MAX", "mm/s").defaultsTo(0.0),
    notNegative("ACCEL", "mm/s²").defaultsTo(0.0),
    notNegative("DECEL", "mm/s²").defaultsTo(0.0),
};
constexpr std::array kPathKeys = {whole("axes", 2, 3).defaultsTo(2), kCsyFirmware};
constexpr SectionSchema kPoint = {"point", "a point", "point", true, kPointKeys, {}};
constexpr SectionSchema kX = {"x", "the first axis", "x", false, kAxisKeys, {}};
constexpr SectionSchema kY = {"y", "the second axis", "y", false, kAxisKeys, {}};
constexpr SectionSchema kZ = {"z", "the third axis", "z", false, kAxisKeys, {}};
constexpr std::array<const SectionSchema *, 4> kSections = {&kPoint, &kX, &kY, &kZ};
constexpr SectionSchema kPath = {"", "a path", "", false, kPathKeys, kSections};

double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

class PathReader {
public:
  PathReader(const SourceFile &file, Diagnostics &diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  std::unique_ptr<CsyPath> read() {
    const size_t errors = diagnostics_.errorCount();
    const std::unique_ptr<TomlNode> tree = parseToml(file_, diagnostics_);
    if (!tree)
      return nullptr;
    const CheckedSection path(*tree, kPath, diagnostics_);
    path_->table.axes = static_cast<uint32_t>(path.integer("axes"));
    path_->table.points = 0;
    readLimits(path);
    const auto most = static_cast<size_t>(path.choice("firmware"));
    for (const CheckedSection &point : path.sections("point", diagnostics_))
      if (!readPoint(point, most))
        break;
    if (diagnostics_.errorCount() != errors)
      return nullptr;
    const Problem problem = computed();
    if (problem.error != PathError::None)
      return report(problem);
    computeSpeeds(path_->table, path_->trajectory, path_->limits, path_->speeds);
    return std::move(path_);
  }

private:
  Problem computed() {
    if (path_->table.points == 0)
      return {PathError::NoPoints, 0};
    return computeTrajectory(path_->table, path_->trajectory);
  }

  std::unique_ptr<CsyPath> report(const Problem &problem) {
    const CsyProblemText text = textOf(problem.error);
    const Span where =
        problem.point < spans_.size() ? spans_[problem.point] : Span{file_.id(), 0, 0};
    Diagnostic &diagnostic =
        diagnostics_.report(Code::CsyPath, where,
                            fmt::format("P{}: {} (code {})", problem.point, text.message,
                                        static_cast<int>(problem.error)),
                            spans_.empty() ? "no [[point]]" : "at this point");
    if (!text.help.empty())
      diagnostic.help(std::string(text.help));
    return nullptr;
  }

  void readLimits(const CheckedSection &path) {
    double *const velocity[] = {&path_->limits.velocity.x, &path_->limits.velocity.y,
                                &path_->limits.velocity.z};
    double *const acceleration[] = {&path_->limits.acceleration.x, &path_->limits.acceleration.y,
                                    &path_->limits.acceleration.z};
    constexpr std::string_view kNames[] = {"x", "y", "z"};
    for (size_t i = 0; i < 3; ++i)
      for (const CheckedSection &axis : path.sections(kNames[i], diagnostics_)) {
        if (i >= path_->table.axes)
          withoutEffect(diagnostics_, path, kNames[i], "with `axes = 3` only");
        const double up = axis.real("ACCEL");
        const double down = axis.real("DECEL");
        *velocity[i] = rounded(axis.real("SPEED_MAX"));
        *acceleration[i] = rounded(up > 0.0 && down > 0.0 ? std::min(up, down) : up + down);
      }
  }

  /// False: there are too many.
  bool readPoint(const CheckedSection &section, size_t most) {
    spans_.push_back(section.table().span);
    if (spans_.size() > most) {
      report({PathError::TooManyPoints, static_cast<uint32_t>(most)});
      return false;
    }
    TablePoint &point = path_->table.point[path_->table.points++];
    const auto type = static_cast<SegmentType>(section.choice("type"));
    point = {};
    point.type = static_cast<int16_t>(type);
    point.position = {rounded(section.real("x", 0.0)), rounded(section.real("y", 0.0)),
                      path_->table.axes == 3 ? rounded(section.real("z", 0.0)) : 0.0};
    point.speed = rounded(section.real("Vset"));
    const auto pair = [&](std::string_view first, std::string_view second) {
      point.parF[0] = rounded(section.real(first, 0.0));
      point.parF[1] = second.empty() ? 0.0 : rounded(section.real(second, 0.0));
    };
    if (type == SegmentType::ArcByRadius)
      pair("R", "");
    else if (type == SegmentType::ArcByCentre)
      pair("Xc", "Yc");
    else
      pair("lracc1", "lracc2");
    point.parW[0] = static_cast<int16_t>(section.integer("NpLin"));
    point.parW[1] = static_cast<int16_t>(section.integer("NpRacc"));
    point.parW[2] = static_cast<int16_t>(section.integer("KF"));
    const bool flagged = section.boolean(type == SegmentType::ArcBlend ? "over_180" : "clockwise");
    point.parW[3] = flagged ? 1 : 0;
    return true;
  }

  const SourceFile &file_;
  Diagnostics &diagnostics_;
  std::unique_ptr<CsyPath> path_ = std::make_unique<CsyPath>();
  std::vector<Span> spans_; ///< of the points
};

} // namespace

std::unique_ptr<CsyPath> readCsyPath(const SourceFile &file, Diagnostics &diagnostics) {
  return PathReader(file, diagnostics).read();
}

} // namespace stc
