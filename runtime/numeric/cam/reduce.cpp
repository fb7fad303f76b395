#include "runtime/numeric/cam/reduce.hpp"

#include "runtime/numeric/cam/bounds.hpp"
#include "runtime/numeric/cam/extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>

namespace stride::cam {
namespace {

constexpr size_t kLongestBridge = 2048;

Point at(const Curve &curve, double x, bool periodic) {
  uint32_t index = 0;
  return evaluateCurve(curve, x, periodic || curve.open, index);
}

/// `f` between `low` and `high`, over 0 to 1.
Smooth restricted(const Smooth &f, double low, double high) {
  const double width = high - low;
  Smooth out;
  for (int i = 7; i >= 0; --i) { // Horner's scheme with low + width * w
    for (int k = 7; k > 0; --k)
      out.c[k] = out.c[k] * low + out.c[k - 1] * width;
    out.c[0] = out.c[0] * low + f.c[i];
  }
  const double sine = std::sin(f.omega * low);
  const double cosine = std::cos(f.omega * low);
  out.omega = f.omega * width;
  out.sine = f.sine * cosine - f.cosine * sine;
  out.cosine = f.sine * sine + f.cosine * cosine;
  return out;
}

/// The greatest distance between the quintic `target` and the part of piece `piece` that it covers.
double distanceOf(const Segment &piece, const Segment &target) {
  Smooth parts[kMostParts];
  const int count = partsOf(piece, parts);
  Smooth quintic;
  std::copy(std::begin(target.coefficients), std::end(target.coefficients), quintic.c);
  const double length = piece.end - piece.start;
  const double targetLength = target.end - target.start;
  double distance = 0.0;
  for (int i = 0; i < count; ++i) {
    // What both cover, on the master and in the u of each.
    const double low = std::max(piece.start + parts[i].low * length, target.start);
    const double high = std::min(piece.start + parts[i].high * length, target.end);
    if (!(high > low))
      continue;
    const Smooth own =
        restricted(parts[i], (low - piece.start) / length, (high - piece.start) / length);
    const Smooth other = restricted(quintic, (low - target.start) / targetLength,
                                    (high - target.start) / targetLength);
    const Smooth difference = combined(own, 1.0, other, -1.0);
    double roots[kMostRoots];
    const int rootCount = rootsOf(derivativeOf(difference), roots);
    for (int k = 0; k < rootCount; ++k)
      distance = std::max(distance, std::fabs(valueOf(difference, roots[k])));
    distance = std::max(distance, std::fabs(valueOf(difference, 0.0)));
    distance = std::max(distance, std::fabs(valueOf(difference, 1.0)));
  }
  return distance;
}

/// A curve of which every x is a place of one piece, for reduceCurve.
class Source {
public:
  Source(const Curve &curve, bool periodic) : curve_(curve), periodic_(periodic || curve.open) {
    for (uint32_t i = 0; i < pieceCount(curve); ++i)
      pieces_.push_back(pieceOf(curve, i, periodic_));
  }

  size_t pieces() const { return pieces_.size(); }
  double beginOf(size_t piece) const {
    return piece < pieces_.size() ? pieces_[piece].start : pieces_.back().end;
  }

  /// At the joint before `piece`: the mean of both sides.
  Node joint(size_t piece) const {
    const double x = beginOf(piece);
    if (piece == 0 || piece == pieces_.size()) {
      const Point point = evaluateSegment(piece == 0 ? pieces_.front() : pieces_.back(), x);
      return {x, piece == 0 ? point.y : endOfPiece(curve_, static_cast<uint32_t>(piece - 1)),
              point.v, point.a};
    }
    const Point left = evaluateSegment(pieces_[piece - 1], x);
    const Point right = evaluateSegment(pieces_[piece], x);
    return {x, right.y, mean(left.v, right.v), mean(left.a, right.a)};
  }

  Node inside(size_t piece, double x) const {
    const Point point = evaluateSegment(pieces_[piece], x);
    return {x, point.y, point.v, point.a};
  }

  /// Whether the quintic between two places, which lie in the pieces `first` to `last`, is near
  /// enough.
  bool isNear(const Node &left, const Node &right, size_t first, size_t last,
              double tolerance) const {
    const Segment target = makeSegment({}, left, right);
    for (size_t i = first; i <= last; ++i)
      if (!(distanceOf(pieces_[i], target) <= tolerance))
        return false;
    return true;
  }

private:
  static double mean(double a, double b) { return a == b ? a : 0.5 * (a + b); }

  const Curve &curve_;
  bool periodic_;
  std::vector<Segment> pieces_;
};

/// Adds the places after `left`, up to `right`, that one piece needs; false if they would be too
/// many.
bool divide(const Source &source, size_t piece, const Node &left, const Node &right,
            double tolerance, int depth, size_t most, std::vector<Node> &out) {
  if (out.size() >= most)
    return false;
  if (source.isNear(left, right, piece, piece, tolerance)) {
    out.push_back(right);
    return true;
  }
  const double middle = 0.5 * (left.x + right.x);
  if (depth == 0 || !(middle > left.x) || !(middle < right.x))
    return false;
  const Node node = source.inside(piece, middle);
  return divide(source, piece, left, node, tolerance, depth - 1, most, out) &&
         divide(source, piece, node, right, tolerance, depth - 1, most, out);
}

/// A stretch between two places that a table must have, and how many it gets in between.
struct Stretch {
  double begin;
  double end;
  bool line;
  int inner = 0;
};

bool isLine(const Segment &piece) {
  if (piece.law != Law::Polynomial && piece.stroke != 0.0)
    return false;
  double rest = 0.0;
  double size = std::fabs(piece.coefficients[0]) + std::fabs(piece.coefficients[1]);
  for (int i = 2; i < 8; ++i)
    rest += std::fabs(piece.coefficients[i]);
  for (int i = 1; i < 8; ++i)
    size += std::fabs(piece.coefficients[i]);
  return rest <= 1e-12 * size; // what rounding leaves of a quintic that is a line
}

double slopeOf(const Segment &piece) { return piece.coefficients[1] / (piece.end - piece.start); }

std::vector<Stretch> stretchesOf(const Curve &curve, bool periodic) {
  std::vector<Stretch> stretches;
  double slope = 0.0;
  for (uint32_t i = 0; i < pieceCount(curve); ++i) {
    const Segment piece = pieceOf(curve, i, periodic || curve.open);
    const bool line = isLine(piece);
    const double own = slopeOf(piece);
    const bool same =
        !stretches.empty() && stretches.back().line == line &&
        (!line || std::fabs(own - slope) <= 1e-12 * (std::fabs(own) + std::fabs(slope)));
    if (same)
      stretches.back().end = piece.end;
    else
      stretches.push_back({piece.start, piece.end, line});
    slope = own;
  }
  // What the program takes for start and end decides.
  stretches.front().begin = curve.start;
  stretches.back().end = curve.end;
  return stretches;
}

} // namespace

std::vector<XY> reducePoints(std::span<const XY> points, double tolerance) {
  const size_t count = points.size();
  if (count <= 2)
    return {points.begin(), points.end()};
  // Fewest lines from the first point to each, and from where the last of them comes.
  std::vector<size_t> lines(count, std::numeric_limits<size_t>::max());
  std::vector<size_t> from(count, 0);
  lines[0] = 0;
  for (size_t i = 0; i + 1 < count; ++i) {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    for (size_t k = i + 1; k < count && k - i <= kLongestBridge; ++k) {
      const double way = points[k].x - points[i].x;
      const double rise = points[k].y - points[i].y;
      const double slope = rise / way;
      if (((slope >= low && slope <= high) || k == i + 1) && lines[i] + 1 < lines[k]) {
        lines[k] = lines[i] + 1;
        from[k] = i;
      }
      low = std::max(low, (rise - tolerance) / way);
      high = std::min(high, (rise + tolerance) / way);
      if (low > high)
        break;
    }
  }
  std::vector<XY> kept;
  for (size_t i = count - 1; i != 0; i = from[i])
    kept.push_back(points[i]);
  kept.push_back(points[0]);
  std::reverse(kept.begin(), kept.end());
  return kept;
}

std::vector<Node> reduceCurve(const Curve &curve, bool periodic, double tolerance, size_t most) {
  const Source source(curve, periodic);
  std::vector<Node> out{source.joint(0)};
  size_t first = 0; // the next piece
  while (first < source.pieces()) {
    const Node left = out.back();
    const auto reaches = [&](size_t last) {
      return source.isNear(left, source.joint(last + 1), first, last, tolerance);
    };
    // As far as doubling goes, then halves between what does and what does not.
    size_t good = first;
    size_t bad = source.pieces();
    if (!reaches(first)) {
      if (!divide(source, first, left, source.joint(first + 1), tolerance, 40, most, out))
        return {};
      ++first;
      continue;
    }
    for (size_t step = 1; good + step < source.pieces(); step *= 2) {
      if (!reaches(good + step)) {
        bad = good + step;
        break;
      }
      good += step;
    }
    while (bad - good > 1) {
      const size_t middle = good + (bad - good) / 2;
      (reaches(middle) ? good : bad) = middle;
    }
    if (out.size() >= most)
      return {};
    out.push_back(source.joint(good + 1));
    first = good + 1;
  }
  return out;
}

std::vector<double> sampleEven(const Curve &curve, bool periodic, int count, bool open) {
  std::vector<double> out;
  const int last = open ? count : count - 1;
  const double step = (curve.end - curve.start) / last;
  for (int i = 0; i < count; ++i)
    out.push_back(at(curve, i == last ? curve.end : curve.start + i * step, periodic).y);
  return out;
}

int leastElements(const Curve &curve) {
  return static_cast<int>(stretchesOf(curve, false).size()) + 1;
}

std::vector<XY> sampleElements(const Curve &curve, bool periodic, int count) {
  std::vector<Stretch> stretches = stretchesOf(curve, periodic);
  int left = count - static_cast<int>(stretches.size()) - 1;
  if (left < 0)
    return {};
  const bool onlyLines =
      std::all_of(stretches.begin(), stretches.end(), [](const Stretch &s) { return s.line; });
  // Each place goes where the distances are greatest.
  const auto distance = [&](size_t i) {
    return (stretches[i].end - stretches[i].begin) / (stretches[i].inner + 1);
  };
  using Entry = std::pair<double, size_t>;
  const auto less = [](const Entry &a, const Entry &b) {
    return a.first < b.first || (a.first == b.first && a.second > b.second);
  };
  std::priority_queue<Entry, std::vector<Entry>, decltype(less)> queue(less);
  for (size_t i = 0; i < stretches.size(); ++i)
    if (onlyLines || !stretches[i].line)
      queue.emplace(distance(i), i);
  for (; left > 0; --left) {
    const size_t i = queue.top().second;
    queue.pop();
    ++stretches[i].inner;
    queue.emplace(distance(i), i);
  }
  std::vector<XY> out;
  for (const Stretch &stretch : stretches) {
    const double step = (stretch.end - stretch.begin) / (stretch.inner + 1);
    for (int k = 0; k <= stretch.inner; ++k) {
      const double x = stretch.begin + k * step;
      out.push_back({x, at(curve, x, periodic).y});
    }
  }
  out.push_back({curve.end, at(curve, curve.end, periodic).y});
  return out;
}

} // namespace stride::cam
