// From the elements of a cam to its curve and its data: SoftMotion V2.3 manual, sections 4.2 and
// 4.4.3.

#include "compiler/assets/cam/cam_source.hpp"

#include "runtime/numeric/cam/element_block.hpp"
#include "runtime/numeric/cam/reduce.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace stc {

namespace {

using namespace stride::cam;

constexpr double kContinuous = 1e-9;

Segment lineBetween(const Node &left, const Node &right) {
  Segment segment = makeSegment({}, left, right);
  segment.coefficients[1] = right.y - left.y;
  for (int i = 2; i < 8; ++i)
    segment.coefficients[i] = 0.0;
  return segment;
}

/// The kind of number that a table holds.
struct NumberRange {
  double low, high; ///< exact as REAL, too: the scale consists of REALs
  bool integer;
};

NumberRange rangeOf(Element element) {
  switch (element) {
  case Element::Int:
    return {-32768, 32767, true};
  case Element::Uint:
    return {0, 65535, true};
  case Element::Dint:
    return {-2147483648.0, 2147483520.0, true};
  case Element::Udint:
    return {0, 4294967040.0, true};
  case Element::Real:
  case Element::Lreal:
    break;
  }
  return {0, 1, false};
}

/// A scale from numbers in the table to units, and the way back.
class NumberScale {
public:
  NumberScale(Element element, std::pair<double, double> editor, std::pair<double, double> table)
      : element_(element), editorMin(notAbove(editor.first)), editorMax(-notAbove(-editor.second)),
        tableMin(static_cast<float>(table.first)), tableMax(static_cast<float>(table.second)) {
    scale_ = {tableMin, editorMin,
              (double{editorMax} - double{editorMin}) / (double{tableMax} - double{tableMin})};
  }

  [[nodiscard]] double toNumber(double value) const {
    const double number = scale_.zero + (value - scale_.base) / scale_.factor;
    if (rangeOf(element_).integer)
      return std::nearbyint(number);
    return element_ == Element::Real ? static_cast<double>(static_cast<float>(number)) : number;
  }
  [[nodiscard]] double toValue(double number) const { return scale_.of(number); }
  [[nodiscard]] bool fits(double number) const {
    switch (element_) {
    case Element::Int:
      return number >= -32768 && number <= 32767;
    case Element::Uint:
      return number >= 0 && number <= 65535;
    case Element::Dint:
      return number >= -2147483648.0 && number <= 2147483647.0;
    case Element::Udint:
      return number >= 0 && number <= 4294967295.0;
    case Element::Real:
    case Element::Lreal:
      break;
    }
    return std::isfinite(number);
  }

private:
  /// As REAL; the scale must not become smaller by that, or its ends would fall out of the table.
  static float notAbove(double value) {
    const auto near = static_cast<float>(value);
    return double{near} > value ? std::nextafter(near, -std::numeric_limits<float>::infinity())
                                : near;
  }

  Element element_;
  Scale scale_;

public:
  float editorMin, editorMax, tableMin, tableMax;
};

template <class T> void put(std::vector<double> &storage, int64_t index, double number) {
  const T value = static_cast<T>(number);
  std::memcpy(reinterpret_cast<char *>(storage.data()) + index * int64_t{sizeof value}, &value,
              sizeof value);
}

void putNumber(Element element, std::vector<double> &storage, int64_t index, double number) {
  switch (element) {
  case Element::Int:
    return put<int16_t>(storage, index, number);
  case Element::Uint:
    return put<uint16_t>(storage, index, number);
  case Element::Dint:
    return put<int32_t>(storage, index, number);
  case Element::Udint:
    return put<uint32_t>(storage, index, number);
  case Element::Real:
    return put<float>(storage, index, number);
  case Element::Lreal:
    return put<double>(storage, index, number);
  }
}

std::string_view nameOf(Element element) {
  static constexpr std::string_view kNames[] = {"",      "INT",  "UINT", "DINT",
                                                "UDINT", "REAL", "LREAL"};
  return kNames[static_cast<size_t>(element)];
}

class Compiler {
public:
  Compiler(const CamSource &cam, Diagnostics &diagnostics)
      : cam_(cam), diagnostics_(diagnostics), segments_(segmentsOf(cam)) {
    curve_.start = cam.start;
    curve_.end = cam.end;
    curve_.form = Form::Segments;
    curve_.count = static_cast<int32_t>(segments_.size());
    curve_.data = segments_.data();
  }

  std::optional<CamData> compile() {
    data_.header.start = cam_.start;
    data_.header.end = cam_.end;
    data_.header.tappets = static_cast<uint32_t>(cam_.tappets.size());
    cam_.name.text.copy(data_.header.name, sizeof data_.header.name - 1);
    data_.tappets = cam_.tappets;
    if (cam_.tappets.size() > kCamFileMaxCount)
      return fail(fmt::format("a cam has at most {} tappets", kCamFileMaxCount),
                  fmt::format("there are {}", cam_.tappets.size()));
    if (cam_.elements.empty())
      return std::move(data_); // tappets only
    if (checkCurve(curve_) != CurveError::None || !isFinite())
      return fail("the numbers of this cam are too large or too close together",
                  "its curve cannot be computed");
    switch (cam_.compile.mode) {
    case CamMode::Equidistant:
      return even();
    case CamMode::ElementOptimised:
      return optimised();
    case CamMode::Polynomial:
    case CamMode::None:
      break;
    }
    return polynomial();
  }

private:
  std::optional<CamData> fail(std::string message, std::string label) {
    diagnostics_.report(Code::CamTable,
                        cam_.compile.span.valid() ? cam_.compile.span : cam_.name.span,
                        std::move(message), std::move(label));
    return std::nullopt;
  }

  /// Position and all derivatives, of which the third one is the first to become too large.
  [[nodiscard]] bool isFinite() const {
    return std::all_of(segments_.begin(), segments_.end(), [](const Segment &segment) {
      for (const double x : {segment.start, segment.end}) {
        const Point at = evaluateSegment(segment, x);
        if (!std::isfinite(at.y) || !std::isfinite(at.v) || !std::isfinite(at.a) ||
            !std::isfinite(at.j))
          return false;
      }
      return true;
    });
  }

  double valueAt(double x) { return evaluateCurve(curve_, x, cam_.periodic, index_).y; }

  /// Points with velocity and acceleration where they can describe it, else segments.
  std::optional<CamData> polynomial() {
    const bool laws = std::any_of(segments_.begin(), segments_.end(), [](const Segment &segment) {
      return segment.law != Law::Polynomial;
    });
    const bool smooth = jumpsOf(segments_, false, 0).empty();
    CamFileHeader &header = data_.header;
    header.form = laws || !smooth ? Form::Segments : Form::Nodes;
    header.elements =
        static_cast<uint32_t>(segments_.size() + (header.form == Form::Nodes ? 1 : 0));
    if (header.elements > kCamFileMaxCount)
      return fail(fmt::format("a cam has at most {} places", kCamFileMaxCount),
                  fmt::format("there are {}", header.elements));
    if (header.form == Form::Segments) {
      data_.storage.resize(segments_.size() * sizeof(Segment) / sizeof(double));
      std::memcpy(data_.storage.data(), segments_.data(), segments_.size() * sizeof(Segment));
      return std::move(data_);
    }
    for (const Node &node : nodes())
      data_.storage.insert(data_.storage.end(), {node.x, node.y, node.v, node.a});
    return std::move(data_);
  }

  [[nodiscard]] std::vector<Node> nodes() const {
    std::vector<Node> result;
    for (const CamElement &element : cam_.elements)
      for (const Node &node : {element.left, element.right})
        if (result.empty() || node.x > result.back().x)
          result.push_back(node);
    return result;
  }

  std::optional<CamData> even() {
    const int places = cam_.compile.places;
    data_.header.open = cam_.periodic;
    data_.header.rise = cam_.periodic ? cam_.elements.back().right.y - cam_.elements[0].left.y : 0;
    const double steps = cam_.periodic ? places : places - 1;
    std::vector<XY> table;
    for (const double y : sampleEven(curve_, cam_.periodic, places, cam_.periodic)) {
      const double i = static_cast<double>(table.size());
      table.push_back({cam_.start + i * ((cam_.end - cam_.start) / steps), y});
    }
    return fill(Form::EvenTable, table);
  }

  std::optional<CamData> optimised() {
    const int places = cam_.compile.places;
    if (const int least = leastElements(curve_); places < least)
      return fail(fmt::format("the table is too small: this cam needs at least {} places", least),
                  fmt::format("{} are too few", places));
    return fill(Form::PairTable, sampleElements(curve_, cam_.periodic, places));
  }

  /// The least and greatest slave position; not both the same.
  static std::pair<double, double> extent(const std::vector<XY> &table) {
    const auto [low, high] = std::minmax_element(
        table.begin(), table.end(), [](const XY &a, const XY &b) { return a.y < b.y; });
    return low->y < high->y ? std::pair(low->y, high->y) : std::pair(low->y, low->y + 1);
  }

  /// Unscaled, unless the file says otherwise or the numbers are integers, which would be coarse.
  NumberScale scaleFor(const std::optional<std::pair<double, double>> &numbers,
                       const std::pair<double, double> &editor) {
    const NumberRange range = rangeOf(cam_.compile.type);
    if (numbers)
      return {cam_.compile.type, editor, *numbers};
    if (range.integer)
      return {cam_.compile.type, editor, {range.low, range.high}};
    return {cam_.compile.type, {0, 1}, {0, 1}};
  }

  std::optional<CamData> fill(Form form, const std::vector<XY> &table) {
    const Element type = cam_.compile.type;
    const NumberScale master = scaleFor(cam_.compile.masterNumbers, {cam_.start, cam_.end});
    const NumberScale slave =
        scaleFor(cam_.compile.slaveNumbers, cam_.slaveScale.value_or(extent(table)));
    CamFileHeader &header = data_.header;
    header.form = form;
    header.element = type;
    header.cubic = cam_.compile.cubic;
    header.elements = static_cast<uint32_t>(table.size());
    const auto size =
        static_cast<size_t>(elementBlockSize(form, type, static_cast<int64_t>(table.size())));
    data_.storage.assign((size + sizeof(double) - 1) / sizeof(double), 0.0);
    int64_t at = 0;
    double before = -std::numeric_limits<double>::infinity();
    for (const XY &place : table) {
      double x = place.x;
      if (form == Form::PairTable) {
        const double number = master.toNumber(x);
        if (!master.fits(number) || number <= before)
          return fail(number <= before
                          ? fmt::format("two places of the cam get the same master number {}, near "
                                        "master position {}",
                                        number, x)
                          : fmt::format("master position {} is {} in the table", x, number),
                      fmt::format("{} cannot hold that", nameOf(type)));
        before = number;
        putNumber(type, data_.storage, at++, number);
        x = master.toValue(number); // where the place really is
      }
      const double y = x == place.x ? place.y : valueAt(x);
      const double number = slave.toNumber(y);
      if (!slave.fits(number))
        return fail(fmt::format("slave position {} is {} in the table", y, number),
                    fmt::format("{} cannot hold that", nameOf(type)));
      putNumber(type, data_.storage, at++, number);
    }
    const TableScaling scaling{master.editorMin, master.editorMax, slave.editorMin, slave.editorMax,
                               master.tableMin,  master.tableMax,  slave.tableMin,  slave.tableMax};
    std::memcpy(reinterpret_cast<char *>(data_.storage.data()) +
                    scalingOffset(form, sizeOf(type), static_cast<int64_t>(table.size())),
                &scaling, sizeof scaling);
    if (checkCurve(data_.curve()) != CurveError::None)
      return fail("the table of this cam has no usable scale",
                  "numbers and positions are too different in size");
    return std::move(data_);
  }

  const CamSource &cam_;
  Diagnostics &diagnostics_;
  std::vector<Segment> segments_;
  Curve curve_;
  uint32_t index_ = 0;
  CamData data_;
};

} // namespace

std::vector<Segment> segmentsOf(const CamSource &cam) {
  std::vector<Segment> result;
  for (size_t i = 0; i < cam.elements.size(); ++i) {
    const CamElement &element = cam.elements[i];
    if (i > 0 && element.left.x > cam.elements[i - 1].right.x)
      result.push_back(makeSegment({}, cam.elements[i - 1].right, element.left));
    if (element.kind == CamElement::Kind::Line)
      result.push_back(lineBetween(element.left, element.right));
    else if (element.kind == CamElement::Kind::Law)
      result.push_back(makeSegment(element.shape, element.left, element.right));
  }
  return result;
}

namespace {

/// How large the summands of a segment's derivative are: differences far below come from rounding.
double summand(const Segment &segment, int derivative) {
  double size = std::fabs(segment.stroke);
  for (const double coefficient : segment.coefficients)
    size = std::max(size, std::fabs(coefficient));
  return size / std::pow(segment.end - segment.start, derivative);
}

} // namespace

std::vector<CamJump> jumpsOf(const std::vector<Segment> &segments, bool periodic, double interval) {
  std::vector<CamJump> jumps;
  const auto joint = [&](const Segment &left, const Segment &right, bool around) {
    const Point before = evaluateSegment(left, left.end);
    Point behind = evaluateSegment(right, right.start);
    if (around && interval > 0)
      behind.y += std::round((before.y - behind.y) / interval) * interval;
    const auto look = [&](std::string_view what, double a, double b, int power) {
      const double size =
          std::max({std::fabs(a), std::fabs(b), summand(left, power), summand(right, power)});
      if (std::fabs(a - b) > kContinuous * size)
        jumps.push_back({what, left.end, a, b});
    };
    look("position", before.y, behind.y, 0);
    look("velocity", before.v, behind.v, 1);
    look("acceleration", before.a, behind.a, 2);
  };
  for (size_t i = 1; i < segments.size(); ++i)
    joint(segments[i - 1], segments[i], false);
  if (periodic && !segments.empty())
    joint(segments.back(), segments.front(), true);
  return jumps;
}

std::optional<CamData> compileCam(const CamSource &cam, Diagnostics &diagnostics) {
  return Compiler(cam, diagnostics).compile();
}

} // namespace stc
