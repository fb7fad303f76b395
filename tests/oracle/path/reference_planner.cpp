#include "tests/oracle/path/reference_planner.hpp"

#include "tests/oracle/path/cell_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stride::oracle {

namespace {

/// A field with the velocity that one way to share its limit allows.
struct Stretch {
  double length, velocity;
  double tangential, curvature;

  /// What is left for the acceleration up to a velocity.
  [[nodiscard]] double acceleration(double peak) const {
    return (1.0 - curvature * peak * peak) / tangential;
  }
};

/// The way from `from` up to `peak` and down to `to`.
double wayOver(const Stretch &stretch, double from, double peak, double to, double jerk) {
  const double acceleration = stretch.acceleration(peak);
  return changeWay(from, peak, acceleration, jerk) + changeWay(peak, to, acceleration, jerk);
}

/// The greatest velocity up to `most` that a change from `from` reaches within the stretch.
double reachedFrom(const Stretch &stretch, double from, double most, double jerk) {
  const auto fits = [&](double to) {
    return changeWay(from, to, stretch.acceleration(to), jerk) <= stretch.length;
  };
  if (most <= from || fits(most))
    return most;
  double low = from;
  double high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

double timeOver(const Stretch &stretch, double from, double peak, double to, double jerk) {
  const double acceleration = stretch.acceleration(peak);
  const double rest = stretch.length - wayOver(stretch, from, peak, to, jerk);
  return changeTime(peak - from, acceleration, jerk) + changeTime(peak - to, acceleration, jerk) +
         std::max(0.0, rest) / peak;
}

/// The peak between two joints that takes the least time. The joints can be reached from each
/// other.
double bestPeak(const Stretch &stretch, double from, double to, double jerk) {
  const double least = std::max(from, to);
  double low = least;
  double high = stretch.velocity;
  if (wayOver(stretch, from, high, to, jerk) > stretch.length)
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (wayOver(stretch, from, middle, to, jerk) <= stretch.length ? low : high) = middle;
    }
  else
    low = high;
  // Close to the ceiling of a curve the acceleration is small: a lower peak may be quicker.
  double best = low;
  for (int i = 0; i < 12; ++i) {
    const double peak = least + (low - least) * i / 12.0;
    if (peak > 0.0 &&
        timeOver(stretch, from, peak, to, jerk) < timeOver(stretch, from, best, to, jerk))
      best = peak;
  }
  return best;
}

/// The velocities at the joints: as great as both neighbours and the ways to the next joints allow.
std::vector<double> jointVelocities(const std::vector<Stretch> &stretches, double jerk) {
  const size_t count = stretches.size();
  std::vector<double> joints(count + 1, 0.0);
  for (size_t i = 1; i < count; ++i) {
    const double most = std::min(stretches[i - 1].velocity, stretches[i].velocity);
    joints[i] = reachedFrom(stretches[i - 1], joints[i - 1], most, jerk);
  }
  for (size_t i = count; i-- > 1;)
    joints[i] = reachedFrom(stretches[i], joints[i + 1], joints[i], jerk);
  return joints;
}

struct Peaks {
  std::vector<double> joints, peaks;
  double time = 0;
};

Peaks planStretches(const std::vector<Stretch> &stretches, double jerk) {
  Peaks plan;
  plan.joints = jointVelocities(stretches, jerk);
  for (size_t i = 0; i < stretches.size(); ++i) {
    const double from = plan.joints[i];
    const double to = plan.joints[i + 1];
    plan.peaks.push_back(bestPeak(stretches[i], from, to, jerk));
    plan.time += timeOver(stretches[i], from, plan.peaks.back(), to, jerk);
  }
  return plan;
}

/// The part of the limit that curvature may take is `share` at most; none: not a path to be driven.
std::vector<Stretch> stretchesOf(std::span<const Cell> fields, double share) {
  std::vector<Stretch> stretches;
  for (const Cell &field : fields) {
    const double square =
        field.curvature > 0.0 ? std::min(field.ceiling, share / field.curvature) : field.ceiling;
    stretches.push_back({field.length, std::sqrt(square), field.tangential, field.curvature});
  }
  return stretches;
}

void addPhases(const std::vector<Stretch> &stretches, const Peaks &peaks, double jerk, double way,
               ReferencePlan &plan) {
  for (size_t i = 0; i < stretches.size(); ++i) {
    const double peak = peaks.peaks[i];
    const double acceleration = stretches[i].acceleration(peak);
    const double rise = changeWay(peaks.joints[i], peak, acceleration, jerk);
    const double fall = changeWay(peak, peaks.joints[i + 1], acceleration, jerk);
    const auto append = [&](const std::vector<Phase> &phases) {
      plan.phases.insert(plan.phases.end(), phases.begin(), phases.end());
    };
    append(changePhases(way, peaks.joints[i], peak, acceleration, jerk));
    const double even = stretches[i].length - rise - fall;
    if (even > 0.0)
      append({{even / peak, 0.0, way + rise, peak, 0.0}});
    way += stretches[i].length;
    append(changePhases(way - fall, peak, peaks.joints[i + 1], acceleration, jerk));
  }
}

} // namespace

std::vector<Cell> fieldsOf(std::span<const Cell> cells, double ratio) {
  // Of a run: the extremes of what its fields have.
  struct Range {
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0;
    void add(double value) {
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    [[nodiscard]] bool within(double ratio) const { return greatest <= ratio * least; }
  };
  struct Run {
    Range ceiling, tangential, left;
    void add(const Cell &cell) {
      ceiling.add(cell.ceiling);
      tangential.add(cell.tangential);
      left.add(cell.ceiling < std::numeric_limits<double>::infinity()
                   ? 1.0 + cell.curvature * cell.ceiling
                   : 1.0 + cell.curvature);
    }
    [[nodiscard]] bool within(double ratio) const {
      return ceiling.within(ratio * ratio) && tangential.within(ratio) && left.within(ratio);
    }
  };
  std::vector<Cell> fields;
  Run run;
  for (const Cell &cell : cells) {
    Run longer = run;
    longer.add(cell);
    if (fields.empty() || !longer.within(ratio)) {
      fields.push_back(cell);
      run = {};
      run.add(cell);
      continue;
    }
    Cell &field = fields.back();
    field.length += cell.length;
    field.tangential = std::max(field.tangential, cell.tangential);
    field.curvature = std::max(field.curvature, cell.curvature);
    field.ceiling = std::min(field.ceiling, cell.ceiling);
    run = longer;
  }
  return fields;
}

ReferencePlan referencePlan(std::span<const Cell> fields, double jerk) {
  ReferencePlan plan{true, 0.0, {}};
  std::vector<double> ways(1, 0.0);
  for (const Cell &field : fields)
    ways.push_back(ways.back() + field.length);
  for (const CellPart &part : partsBetweenStops(fields)) {
    const std::span<const Cell> own = fields.subspan(part.first, part.count);
    Peaks best;
    best.time = std::numeric_limits<double>::infinity();
    double bestShare = 0;
    for (const double share : {0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4}) {
      Peaks peaks = planStretches(stretchesOf(own, share), jerk);
      if (peaks.time < best.time) {
        best = std::move(peaks);
        bestShare = share;
      }
    }
    if (!(best.time < std::numeric_limits<double>::infinity())) {
      plan.found = false;
      return plan;
    }
    plan.time += best.time;
    addPhases(stretchesOf(own, bestShare), best, jerk, ways[part.first], plan);
  }
  return plan;
}

Phase stateAt(const ReferencePlan &plan, double time) {
  Phase last{};
  for (const Phase &phase : plan.phases) {
    if (time <= phase.duration)
      return after(phase, std::max(0.0, time));
    time -= phase.duration;
    last = after(phase, phase.duration);
  }
  return last;
}

} // namespace stride::oracle
