// Lines, arcs and helices one after the other, as a program says them: what motions are compared
// with. Distances are exact for lines and arcs.
#ifndef STRIDE_TESTS_ORACLE_PATH_PATH_CHAIN_HPP
#define STRIDE_TESTS_ORACLE_PATH_PATH_CHAIN_HPP

#include <array>
#include <cstddef>
#include <vector>

namespace stride::oracle {

/// X, Y, Z and six other axes.
inline constexpr size_t kAxes = 9;
using Place = std::array<double, kAxes>;

/// The distance of two places over the first `axes` of their axes.
double distance(const Place &a, const Place &b, size_t axes = kAxes);

/// A line, or an arc around a centre; what an arc does besides turning goes evenly with its angle.
struct ChainElement {
  Place start, end;
  bool isArc;
  std::array<double, 3> centre;  ///< In the plane of the start.
  std::array<double, 3> radial;  ///< From there to the start.
  std::array<double, 3> lateral; ///< The same, a quarter turn later in the sense of the sweep.
  double sweep;                  ///< > 0 [rad]
  Place drift;                   ///< What it does besides turning: of a line everything.
  double length;                 ///< Over the axes of the chain. [u]
  double startWay;               ///< From the start of the chain. [u]

  /// 0: at its start, 1: at its end, both exactly.
  [[nodiscard]] Place at(double part) const;
};

/// The place of a chain that is nearest to a point.
struct Foot {
  double distance;
  double way;     ///< From the start of the chain. [u]
  size_t element; ///< Its index.
};

class PathChain {
public:
  /// Distances and lengths count the first `axes` axes.
  explicit PathChain(const Place &start, size_t axes = 3);

  void addLine(const Place &end);
  /// In the plane at a right angle to `normal` (of any length) through the start, counterclockwise
  /// around it. Start = end is a full turn. The centre is moved onto the bisector.
  void addArc(const Place &end, const std::array<double, 3> &centre,
              const std::array<double, 3> &normal);

  [[nodiscard]] const std::vector<ChainElement> &elements() const { return elements_; }
  [[nodiscard]] const Place &end() const { return end_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] size_t axes() const { return axes_; }

  /// The place at a way from the start, 0 to length(). [u] in
  [[nodiscard]] Place at(double way) const;
  /// Of those places whose way is between both; of equally near ones the first.
  [[nodiscard]] Foot nearest(const Place &point, double fromWay, double toWay) const;

private:
  void add(ChainElement element);

  size_t axes_;
  Place end_;
  double length_ = 0;
  std::vector<ChainElement> elements_;
};

} // namespace stride::oracle

#endif // STRIDE_TESTS_ORACLE_PATH_PATH_CHAIN_HPP
