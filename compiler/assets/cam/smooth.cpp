// The derivatives at the smooth points of a cam.

#include "compiler/assets/cam/cam_source.hpp"

#include "runtime/numeric/cam/builder.hpp"

#include <algorithm>
#include <cmath>

namespace stc {

namespace {

using namespace stride::cam;

constexpr int16_t kPlace = 2;        // Boundary::given: x, y
constexpr int16_t kVelocity = 3;     // … and v
constexpr int16_t kAcceleration = 4; // … and a

/// The pieces between and of the elements, for the builder.
class Smoother {
public:
  explicit Smoother(CamSource &cam)
      : cam_(cam), closed_(cam.periodic && cam.elements.front().smooth) {
    const double rise = cam.elements.back().right.y - cam.elements.front().left.y;
    // A line on top of it all changes no jerk: without it the cam ends at the place of its start.
    slope_ = closed_ ? rise / (cam.end - cam.start) : 0.0;
  }

  bool solve() {
    std::vector<CamElement> &elements = cam_.elements;
    for (size_t i = 0; i < elements.size(); ++i) {
      if (i > 0 && elements[i].left.x > elements[i - 1].right.x)
        add(boundary(elements[i - 1], elements[i - 1].right),
            boundary(elements[i], elements[i].left));
      if (elements[i].kind != CamElement::Kind::Point)
        add(boundary(elements[i], elements[i].left), boundary(elements[i], elements[i].right));
    }
    if (pieces_.empty())
      return true;
    if (closed_)
      pieces_.front().left.given = 0; // what the end is
    const auto count = static_cast<int32_t>(pieces_.size());
    std::vector<JointWork> work(pieces_.size() + 1);
    stride::cam::Builder builder(pieces_.data(), count, closed_, work.data());
    if (builder.solve() != BuildError::None)
      return false;
    std::vector<Segment> segments;
    for (int32_t i = 0; i < count; ++i) {
      Segment made[2];
      int32_t number = 0;
      if (builder.segments(i, made, number) != BuildError::None)
        return false;
      segments.insert(segments.end(), made, made + number);
    }
    for (CamElement &element : elements)
      if (element.smooth)
        take(element, segments);
    if (closed_ && elements.back().smooth) { // to the bit
      elements.back().left.v = elements.back().right.v = elements.front().left.v;
      elements.back().left.a = elements.back().right.a = elements.front().left.a;
    }
    return std::all_of(elements.begin(), elements.end(), [](const CamElement &element) {
      return std::isfinite(element.left.v) && std::isfinite(element.left.a);
    });
  }

private:
  [[nodiscard]] Boundary boundary(const CamElement &element, const Node &at) const {
    const double x = at.x - cam_.start;
    int16_t given = kAcceleration;
    if (element.smooth)
      given = element.given == 0 ? kPlace : kVelocity;
    return {x, at.y - slope_ * x, at.v - slope_, at.a, 0.0, given};
  }

  void add(const Boundary &left, const Boundary &right) {
    pieces_.push_back({PieceKind::Poly5, left, right, {}, 0.25, 0.5, Law::Polynomial});
  }

  void take(CamElement &element, const std::vector<Segment> &segments) const {
    const double x = element.left.x - cam_.start;
    for (const Segment &segment : segments) {
      if (segment.start != x && segment.end != x)
        continue;
      const Point at = evaluateSegment(segment, x);
      if (element.given == 0)
        element.left.v = at.v + slope_;
      element.left.a = at.a;
      element.right = element.left;
      return;
    }
  }

  CamSource &cam_;
  bool closed_;
  double slope_ = 0.0;
  std::vector<Piece> pieces_;
};

} // namespace

bool smoothen(CamSource &cam) {
  const bool any = std::any_of(cam.elements.begin(), cam.elements.end(),
                               [](const CamElement &element) { return element.smooth; });
  return !any || Smoother(cam).solve();
}

} // namespace stc
