// Lines instead of the splines and ellipses of a CNC program.

#include "compiler/assets/cnc_edit/cut_program.hpp"
#include "compiler/assets/cnc_edit/split.hpp"
#include "compiler/assets/cnc_edit/word_edits.hpp"

#include "runtime/numeric/cnc/object_shape.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::cnc;
using gcode::CncTrace;
using gcode::CncVisit;
using gcode::EditSentence;
using stride::numeric::cross;
using stride::numeric::dot;
using stride::numeric::norm;

/// Lines of one curve at most.
constexpr double kMostLines = 100'000;
/// Places of a curve at which its direction is looked at.
constexpr int kPlaces = 1024;

bool isExpanded(int32_t function) {
  return function == 5 || function == 6 || (function >= 8 && function <= 10);
}

/// Between two vectors. [degrees]
double angleBetween(const Vector3 &a, const Vector3 &b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / M_PI;
}

/// A curve by what it has turned up to a parameter.
class Turning {
public:
  explicit Turning(const stride::path::Shape &shape) : shape_(shape) {
    Vector3 before = stride::path::overParameter(shape, 0).d1;
    for (int i = 1; i <= kPlaces; ++i) {
      const Vector3 now = stride::path::overParameter(shape, static_cast<double>(i) / kPlaces).d1;
      turned_.push_back(turned_.back() + angleBetween(before, now));
      before = now;
    }
  }

  [[nodiscard]] double all() const { return turned_.back(); }

  /// Parameters at which the curve has turned by equal parts; with both ends.
  [[nodiscard]] std::vector<double> parts(int count) const {
    std::vector<double> parameters{0};
    for (int i = 1; i < count; ++i) {
      const double wanted = all() * i / count;
      const auto at = std::upper_bound(turned_.begin() + 1, turned_.end() - 1, wanted);
      const double rest = (wanted - *(at - 1)) / std::max(*at - *(at - 1), 1e-300);
      parameters.push_back((static_cast<double>(at - turned_.begin()) - 1 + rest) / kPlaces);
    }
    parameters.push_back(1);
    return parameters;
  }

  /// Whether lines between these parameters turn by less than `angle`, with half of it towards the
  /// curve at its ends. [degrees]
  [[nodiscard]] bool isFine(const std::vector<double> &parameters, double angle) const {
    Vector3 place = stride::path::overParameter(shape_, 0).p;
    Vector3 direction = stride::path::overParameter(shape_, 0).d1;
    double most = angle / 2; // beside a line of another curve that goes on smoothly
    for (size_t i = 1; i < parameters.size(); ++i) {
      const Vector3 next = stride::path::overParameter(shape_, parameters[i]).p;
      if (!(angleBetween(direction, next - place) < most))
        return false;
      direction = next - place;
      place = next;
      most = angle;
    }
    return angleBetween(direction, stride::path::overParameter(shape_, 1).d1) < angle / 2;
  }

private:
  const stride::path::Shape &shape_;
  std::vector<double> turned_{0}; ///< [degrees]
};

class Expander {
public:
  Expander(const CncExpansion &expansion, Diagnostics &diagnostics)
      : expansion_(expansion), diagnostics_(diagnostics) {}

  using Ways = std::optional<std::vector<double>>;

  Ways cuts(const CncTrace &trace, const CncVisit &visit) {
    if (!isExpanded(visit.function))
      return std::nullopt;
    const PathObject &object = trace.objects[static_cast<size_t>(visit.object)];
    place_ = trace.sentences[static_cast<size_t>(visit.sentence)].words.front().span;
    if (visit.unknown != 0 && (visit.unknown & 7) != 0)
      return refuse("the shape of this curve depends on variables",
                    "write numbers in the sentences before");
    if (!isCurve(object.moveType))
      return std::vector<double>{};
    return expansion_.length > 0 ? byLength(object) : byAngle(object);
  }

private:
  Ways refuse(const std::string &message, const std::string &help) {
    gcode::refuseEdit(place_, message, "no lines are made of it", help, diagnostics_);
    return std::nullopt;
  }

  Ways byLength(const PathObject &object) {
    const double count = std::ceil(object.length / expansion_.length * (1 - 1e-12));
    if (count > kMostLines)
      return refuse("this curve would become too many lines", "choose a greater length");
    std::vector<double> ways;
    for (double i = 1; i < count; ++i)
      ways.push_back(object.length * i / count);
    return ways;
  }

  Ways byAngle(const PathObject &object) {
    ObjectShape shape{};
    if (shapeOf(object, shape) != ShapeError::None)
      return refuse("this curve cannot be measured", "correct its words");
    const Turning turning(shape.shape);
    double count = std::max(1.0, std::ceil(turning.all() / expansion_.angle));
    std::vector<double> parts;
    while (count <= kMostLines) {
      parts = turning.parts(static_cast<int>(count));
      if (turning.isFine(parts, expansion_.angle))
        break;
      count = std::ceil(count * 1.05 + 0.5);
    }
    if (count > kMostLines)
      return refuse("this curve has a bend that lines cannot follow, or too many of them",
                    "choose a greater angle, or a length");
    std::vector<double> ways;
    double way = 0;
    for (size_t i = 1; i + 1 < parts.size(); ++i) {
      way += stride::path::lengthBetween(shape.shape, parts[i - 1], parts[i]);
      ways.push_back(way);
    }
    return ways;
  }

  CncExpansion expansion_;
  Diagnostics &diagnostics_;
  Span place_;
};

/// Splines are what the points beside them make of them: no variable may be there.
bool checkVariables(const CncTrace &trace, Diagnostics &diagnostics) {
  for (size_t i = 0; i < trace.visits.size(); ++i) {
    const CncVisit &visit = trace.visits[i];
    if (visit.object < 0 || (visit.function != 5 && visit.function != 10))
      continue;
    for (const size_t beside :
         {i - std::min<size_t>(i, 1), std::min(i + 1, trace.visits.size() - 1)})
      for (const CncWord &word :
           trace.sentences[static_cast<size_t>(trace.visits[beside].sentence)].words)
        if (!word.variable.empty() &&
            std::string_view("XYZIJKRT").find(static_cast<char>(word.word.letter)) !=
                std::string_view::npos) {
          gcode::refuseEdit(word.span, "the shape of a spline depends on this variable",
                            "beside the spline", "write a number", diagnostics);
          return false;
        }
  }
  return true;
}

} // namespace

std::optional<std::string> expandCnc(const SourceFile &file, const CncExpansion &expansion,
                                     Diagnostics &diagnostics) {
  const std::optional<CncProgram> program = gcode::readForTrace(file, diagnostics);
  if (!program)
    return std::nullopt;
  const std::optional<CncTrace> trace = gcode::traceCnc(*program, diagnostics);
  if (!trace || !checkVariables(*trace, diagnostics))
    return std::nullopt;
  const size_t errors = diagnostics.errorCount();
  Expander expander(expansion, diagnostics);
  gcode::CutRule rule;
  rule.lines = true;
  rule.cuts = [&expander](const CncTrace &all, const CncVisit &visit) {
    return expander.cuts(all, visit);
  };
  rule.wants = [](const EditSentence &, int32_t function) {
    return function < 0 || isExpanded(function);
  };
  std::optional<std::string> text = gcode::cutProgram(file, *trace, rule, diagnostics);
  return diagnostics.errorCount() == errors ? text : std::nullopt;
}

} // namespace stc
