#include "tests/oracle/path/path_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace stride::oracle {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A derivative as the mean over some samples, and how wrong rounding may make it.
struct Difference {
  double value, error;
};

/// The derivative of the order of `Points` - 1: that of the polynomial through the points.
template <size_t Points>
Difference derivative(const std::array<double, Points> &times,
                      const std::array<double, Points> &values, double rounding) {
  double factorial = 1;
  for (size_t i = 2; i < Points; ++i)
    factorial *= static_cast<double>(i);
  double speed = 0;
  for (size_t i = 1; i < Points; ++i)
    speed = std::max(speed, std::fabs((values[i] - values[i - 1]) / (times[i] - times[i - 1])));
  // Times are rounded, too: as if the places were others by the velocity times that.
  const double byTime = speed * kEpsilon * std::fabs(times[Points - 1]);
  double sum = 0;
  double error = 0;
  for (size_t i = 0; i < Points; ++i) {
    double product = factorial;
    for (size_t k = 0; k < Points; ++k)
      if (k != i)
        product /= times[i] - times[k];
    sum += values[i] * product;
    error += std::fabs(product) * (rounding * kEpsilon * std::fabs(values[i]) + byTime);
  }
  return {sum, error};
}

void raise(Worst &worst, double value, double error, double limit, const Worst &where) {
  if (!(limit < kNone))
    return;
  double use = (std::fabs(value) - error) / limit;
  if (std::isnan(use))
    use = kNone; // nothing is kept
  if (use <= worst.use)
    return;
  worst = where;
  worst.use = use;
  worst.value = value;
}

/// Measures differences of samples that are one stride apart.
class Differences {
public:
  Differences(std::span<const Sample> samples, const MotionLimits &limits, size_t stride,
              double rounding, size_t axes, MotionReport &report)
      : samples_(samples), limits_(limits), stride_(stride), rounding_(rounding), axes_(axes),
        report_(report) {}

  void measure() {
    for (size_t i = 0; i + stride_ < samples_.size(); ++i) {
      first(i);
      if (i + 2 * stride_ < samples_.size())
        second(i);
      if (i + 3 * stride_ < samples_.size())
        third(i);
    }
  }

private:
  template <size_t Points> std::array<double, Points> times(size_t i) const {
    std::array<double, Points> all;
    for (size_t k = 0; k < Points; ++k)
      all[k] = samples_[i + k * stride_].time;
    return all;
  }
  template <size_t Points> Difference ofWay(size_t i) const {
    std::array<double, Points> all;
    for (size_t k = 0; k < Points; ++k)
      all[k] = samples_[i + k * stride_].way;
    return derivative<Points>(times<Points>(i), all, rounding_);
  }
  template <size_t Points> Difference ofAxis(size_t i, size_t axis) const {
    std::array<double, Points> all;
    for (size_t k = 0; k < Points; ++k)
      all[k] = samples_[i + k * stride_].place[axis];
    return derivative<Points>(times<Points>(i), all, rounding_);
  }
  /// Samples at one time have no difference there.
  template <size_t Points> bool apart(size_t i) const {
    for (size_t k = 1; k < Points; ++k)
      if (!(samples_[i + k * stride_].time > samples_[i + (k - 1) * stride_].time))
        return false;
    return true;
  }
  [[nodiscard]] bool hasWay(size_t i, size_t points) const {
    for (size_t k = 0; k < points; ++k)
      if (std::isnan(samples_[i + k * stride_].way))
        return false;
    return true;
  }
  [[nodiscard]] Worst where(size_t i, size_t points, size_t axis = 0) const {
    const size_t middle = i + (points - 1) * stride_ / 2;
    return {0, 0, samples_[middle].time, middle, axis, stride_};
  }

  void first(size_t i) {
    if (!apart<2>(i))
      return;
    if (hasWay(i, 2)) {
      const Difference velocity = ofWay<2>(i);
      raise(report_.velocity, velocity.value, velocity.error, limits_.velocity, where(i, 2));
    }
    double square = 0;
    double error = 0;
    for (size_t axis = 0; axis < kAxes; ++axis) {
      if (axis >= axes_ && !(limits_.axisVelocity[axis] < kNone))
        continue;
      const Difference velocity = ofAxis<2>(i, axis);
      raise(report_.axisVelocity, velocity.value, velocity.error, limits_.axisVelocity[axis],
            where(i, 2, axis));
      if (axis < axes_) {
        square += velocity.value * velocity.value;
        error += velocity.error;
      }
    }
    raise(report_.pathVelocity, std::sqrt(square), error, limits_.velocity, where(i, 2));
  }

  void second(size_t i) {
    if (!apart<3>(i))
      return;
    if (hasWay(i, 3)) {
      const Difference acceleration = ofWay<3>(i);
      const bool rises = acceleration.value > 0.0;
      raise(rises ? report_.acceleration : report_.deceleration, acceleration.value,
            acceleration.error, rises ? limits_.acceleration : limits_.deceleration, where(i, 3));
    }
    for (size_t axis = 0; axis < kAxes; ++axis) {
      if (!(limits_.axisAcceleration[axis] < kNone))
        continue;
      const Difference acceleration = ofAxis<3>(i, axis);
      raise(report_.axisAcceleration, acceleration.value, acceleration.error,
            limits_.axisAcceleration[axis], where(i, 3, axis));
    }
  }

  void third(size_t i) {
    if (!(limits_.jerk < kNone) || !apart<4>(i) || !hasWay(i, 4))
      return;
    const Difference jerk = ofWay<4>(i);
    raise(report_.jerk, jerk.value, jerk.error, limits_.jerk, where(i, 4));
  }

  std::span<const Sample> samples_;
  const MotionLimits &limits_;
  size_t stride_;
  double rounding_;
  size_t axes_;
  MotionReport &report_;
};

void measureOrder(std::span<const Sample> samples, const CheckOptions &options,
                  MotionReport &report) {
  for (size_t i = 1; i < samples.size(); ++i) {
    const Sample &before = samples[i - 1];
    const Sample &here = samples[i];
    const Worst where{kNone, 0, here.time, i, 0, 1};
    const double back = before.way - here.way;
    if (back > report.backwards.value) {
      report.backwards = where;
      report.backwards.value = back;
    }
    if (here.time > before.time)
      continue;
    // A time that goes back is worse than any jump.
    const double step = here.time < before.time ? kNone : distance(before.place, here.place);
    if (step > options.jump && step > report.jump.value) {
      report.jump = where;
      report.jump.value = step;
    }
  }
}

/// Follows the reference: the foot of each sample is looked for near that of the one before.
class Follower {
public:
  Follower(std::span<const Sample> samples, const PathChain &reference, double tolerance,
           double reach)
      : samples_(samples), reference_(reference), tolerance_(tolerance), reach_(reach) {}

  void measure(MotionReport &report) {
    double way = 0;
    double greatest = 0;
    for (size_t i = 0; i < samples_.size(); ++i) {
      const double step =
          i > 0 ? distance(samples_[i].place, samples_[i - 1].place, reference_.axes()) : 0.0;
      const Foot foot =
          reference_.nearest(samples_[i].place, way - reach_ - step, way + reach_ + 2 * step);
      raise(report.distance, foot.distance, 0, tolerance_, {0, 0, samples_[i].time, i, 0, 0});
      way = foot.way;
      greatest = std::max(greatest, way);
      greatest_.push_back(greatest);
    }
    for (const ChainElement &element : reference_.elements())
      for (const double part : {0.5, 1.0})
        missed(element, part, report.missed);
  }

private:
  /// How near the motion comes to a place of the reference.
  void missed(const ChainElement &element, double part, Worst &worst) const {
    const double way = element.startWay + part * element.length;
    const Place place = element.at(part);
    auto at = std::lower_bound(greatest_.begin(), greatest_.end(), way - reach_);
    size_t i = static_cast<size_t>(at - greatest_.begin());
    i = std::min(i > 0 ? i - 1 : 0, samples_.size() - 1);
    double least = distance(samples_[i].place, place, reference_.axes());
    size_t nearest = i;
    for (; i + 1 < samples_.size() && greatest_[i] <= way + reach_; ++i) {
      const double apart = distanceOfStep(samples_[i].place, samples_[i + 1].place, place);
      if (apart < least) {
        least = apart;
        nearest = i;
      }
    }
    raise(worst, least, 0, tolerance_, {0, 0, samples_[nearest].time, nearest, 0, 0});
  }

  [[nodiscard]] double distanceOfStep(const Place &from, const Place &to,
                                      const Place &point) const {
    double along = 0;
    double all = 0;
    for (size_t axis = 0; axis < reference_.axes(); ++axis) {
      along += (to[axis] - from[axis]) * (point[axis] - from[axis]);
      all += (to[axis] - from[axis]) * (to[axis] - from[axis]);
    }
    const double part = all > 0.0 ? std::clamp(along / all, 0.0, 1.0) : 0.0;
    Place foot = from;
    for (size_t axis = 0; axis < reference_.axes(); ++axis)
      foot[axis] += part * (to[axis] - from[axis]);
    return distance(foot, point, reference_.axes());
  }

  std::span<const Sample> samples_;
  const PathChain &reference_;
  double tolerance_, reach_;
  std::vector<double> greatest_; ///< By sample: the greatest way of a foot so far.
};

std::string line(const char *name, const Worst &worst) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "%-18s %.9f of the limit: %.9g at %.6f s (sample %zu, "
                "axis %zu, stride %zu)\n",
                name, worst.use, worst.value, worst.time, worst.sample, worst.axis, worst.stride);
  return text.data();
}

} // namespace

MotionLimits::MotionLimits() {
  axisVelocity.fill(kNone);
  axisAcceleration.fill(kNone);
}

bool MotionReport::within(double part) const {
  bool kept = exactEnd;
  for (const Worst *worst :
       {&velocity, &acceleration, &deceleration, &jerk, &pathVelocity, &axisVelocity,
        &axisAcceleration, &distance, &missed, &backwards, &jump})
    kept = kept && worst->use <= 1.0 + part;
  return kept;
}

std::string MotionReport::text() const {
  const std::array<std::pair<const char *, const Worst *>, 11> all = {
      {{"velocity", &velocity},
       {"acceleration", &acceleration},
       {"deceleration", &deceleration},
       {"jerk", &jerk},
       {"path velocity", &pathVelocity},
       {"axis velocity", &axisVelocity},
       {"axis acceleration", &axisAcceleration},
       {"distance", &distance},
       {"missed", &missed},
       {"backwards", &backwards},
       {"jump", &jump}}};
  std::string lines;
  for (const auto &[name, worst] : all)
    if (worst->use > 0.0)
      lines += line(name, *worst);
  return lines + (exactEnd ? "" : "the end is not reached exactly\n");
}

MotionReport checkMotion(std::span<const Sample> samples, const MotionLimits &limits,
                         const PathChain *reference, const CheckOptions &options) {
  MotionReport report;
  if (samples.empty()) {
    report.exactEnd = false;
    return report;
  }
  const size_t axes = reference ? reference->axes() : 3;
  for (const size_t stride : options.strides)
    Differences(samples, limits, stride, options.rounding, axes, report).measure();
  measureOrder(samples, options, report);
  if (!reference)
    return report;
  report.exactEnd = samples.back().place == reference->end();
  if (limits.tolerance < kNone)
    Follower(samples, *reference, limits.tolerance, std::max(options.reach, 16 * limits.tolerance))
        .measure(report);
  return report;
}

} // namespace stride::oracle
