// Random tasks for the planners, and what every plan must keep.
#ifndef STRIDE_TESTS_PROPERTY_MOTION_PROBLEMS_HPP
#define STRIDE_TESTS_PROPERTY_MOTION_PROBLEMS_HPP

#include "runtime/numeric/profile/planner.hpp"

#include "tests/support/cases.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <string>

namespace stride::test {

inline constexpr motion::RampType kRampTypes[] = {
    motion::RampType::Trapezoid, motion::RampType::Sigmoid, motion::RampType::Parabolic,
    motion::RampType::SigmoidLimited};

/// Names the tests of a suite that runs with each of kRampTypes.
inline std::string rampName(const testing::TestParamInfo<motion::RampType> &info) {
  static constexpr const char *kNames[] = {"Trapezoid", "Sigmoid", "Parabolic", "SigmoidLimited"};
  return kNames[static_cast<int>(info.param)];
}

struct MotionProblem {
  motion::State start;
  double target;
  double endVelocity;
  motion::Dynamics dynamics;
};

inline std::ostream &operator<<(std::ostream &out, const MotionProblem &p) {
  out.precision(17);
  const motion::Dynamics &d = p.dynamics;
  return out << "{{" << p.start.position << ", " << p.start.velocity << ", " << p.start.acceleration
             << "}, " << p.target << ", " << p.endVelocity << ", {RampType{"
             << static_cast<int>(d.ramp) << "}, " << d.velocity << ", " << d.acceleration << ", "
             << d.deceleration << ", " << d.jerk << "}}";
}

class MotionRandom : public Random {
public:
  using Random::Random;

  motion::Dynamics dynamics(motion::RampType ramp, double length) {
    motion::Dynamics d{};
    d.ramp = ramp;
    d.velocity = length * magnitude(-2, 2);
    d.acceleration = length * magnitude(-2, 2);
    d.deceleration = chance(0.4) ? d.acceleration : length * magnitude(-2, 2);
    d.jerk = length * magnitude(-2, 4);
    return d;
  }

  double velocity(const motion::Dynamics &d) {
    return sign() * d.velocity * (chance(0.8) ? uniform(0, 1) : uniform(0, 3));
  }

  motion::State state(double position, const motion::Dynamics &d) {
    motion::State state = {position, 0, 0};
    if (chance(0.7))
      state.velocity = velocity(d);
    if (chance(0.6))
      state.acceleration = sign() * std::max(d.acceleration, d.deceleration) *
                           (chance(0.8) ? uniform(0, 1) : uniform(0, 2));
    return state;
  }

  MotionProblem problem(motion::RampType ramp) {
    const double length = magnitude(-6, 6);
    MotionProblem p{};
    p.dynamics = dynamics(ramp, length);
    p.start = state(chance(0.2) ? 0.0 : sign() * length * magnitude(-3, 1), p.dynamics);
    p.target = chance(0.05) ? p.start.position : p.start.position + sign() * length;
    if (chance(0.4))
      p.endVelocity = chance(0.1) ? p.start.velocity : velocity(p.dynamics);
    return p;
  }
};

/// The acceleration counts for these ramp types.
inline bool hasAcceleration(const motion::Dynamics &d) {
  return d.ramp != motion::RampType::Trapezoid;
}

/// What the acceleration at the start makes of the velocity before it is gone.
inline double swingOf(const MotionProblem &p) {
  return hasAcceleration(p.dynamics)
             ? p.start.acceleration * p.start.acceleration / (2 * p.dynamics.jerk)
             : 0.0;
}

/// Sizes of the numbers of a profile, for tolerances.
struct MotionSizes {
  double position;
  double velocity;
  double acceleration;
  double jerk;
};

inline double endOf(const motion::Profile &profile, int32_t i) {
  return i + 1 < profile.count ? profile.segments[i + 1].start : profile.duration;
}

inline MotionSizes sizesOf(const motion::Profile &profile, const MotionProblem &p) {
  MotionSizes sizes = {std::max(std::fabs(p.start.position), std::fabs(profile.end.position)),
                       std::max(std::fabs(p.start.velocity), std::fabs(profile.end.velocity)),
                       std::fabs(p.start.acceleration), 0};
  for (int32_t i = 0; i < profile.count; ++i) {
    const motion::Segment &segment = profile.segments[i];
    const double end = endOf(profile, i);
    sizes.jerk = std::max(sizes.jerk, std::fabs(segment.jerk));
    if (segment.frequency > 0)
      sizes.acceleration =
          std::max(sizes.acceleration, std::fabs(segment.jerk) / segment.frequency);
    for (const double t : {segment.start, 0.5 * (segment.start + end), end}) {
      const motion::State s = segment.at(t);
      sizes.position = std::max(sizes.position, std::fabs(s.position));
      sizes.velocity = std::max(sizes.velocity, std::fabs(s.velocity));
      sizes.acceleration = std::max(sizes.acceleration, std::fabs(s.acceleration));
    }
  }
  return sizes;
}

/// Empty when the profile is steady from the start to its end; else what is wrong. Jumps of the
/// position by `blur` are allowed.
inline std::string jumpIn(const motion::Profile &profile, const MotionProblem &p, double blur) {
  const MotionSizes sizes = sizesOf(profile, p);
  const double tick = 1e-15 * profile.duration; // finer a double does not know the time
  const double jerk = sizes.jerk * tick;
  const double acceleration = 1e-11 * sizes.acceleration + jerk;
  const double velocity = 1e-11 * sizes.velocity + (sizes.acceleration + jerk) * tick;
  const double position = blur + 1e-10 * sizes.position + (sizes.velocity + jerk * tick) * tick;
  motion::State last = p.start;
  double time = 0;
  for (int32_t i = 0; i <= profile.count; ++i) {
    const bool end = i == profile.count;
    const double t = end ? profile.duration : profile.segments[i].start;
    if (!(t >= time))
      return "times fall";
    if (i > 0)
      last = profile.segments[i - 1].at(t);
    const motion::State next = end ? profile.end : profile.segments[i].at(t);
    if (!(std::fabs(next.position - last.position) <= position))
      return "position jumps by " + std::to_string(next.position - last.position);
    if (!(std::fabs(next.velocity - last.velocity) <= velocity))
      return "velocity jumps by " + std::to_string(next.velocity - last.velocity);
    if (hasAcceleration(p.dynamics) &&
        !(std::fabs(next.acceleration - last.acceleration) <= acceleration))
      return "acceleration jumps by " + std::to_string(next.acceleration - last.acceleration);
    time = t;
  }
  return "";
}

/// Whether velocity and position are the integrals of acceleration and velocity in every piece, by
/// Gauss' rule of five points (for sines, on each quarter); else what is wrong.
inline std::string notIntegrated(const motion::Profile &profile, const MotionProblem &p) {
  static constexpr double kNodes[5] = {-0.906179845938663992, -0.538469310105683091, 0,
                                       0.538469310105683091, 0.906179845938663992};
  static constexpr double kWeights[5] = {0.236926885056189088, 0.478628670499366468,
                                         0.568888888888888889, 0.478628670499366468,
                                         0.236926885056189088};
  const MotionSizes sizes = sizesOf(profile, p);
  for (int32_t i = 0; i < profile.count; ++i) {
    const motion::Segment &segment = profile.segments[i];
    const double from = segment.start;
    const double length = endOf(profile, i) - from;
    const int parts = segment.frequency > 0 ? 4 : 1;
    double speed = 0;
    double way = 0;
    for (int part = 0; part < parts; ++part)
      for (int k = 0; k < 5; ++k) {
        const motion::State s =
            segment.at(from + length * (static_cast<double>(part) + 0.5 + 0.5 * kNodes[k]) / parts);
        speed += kWeights[k] * s.acceleration * length / (2 * parts);
        way += kWeights[k] * s.velocity * length / (2 * parts);
      }
    const motion::State first = segment.at(from);
    const motion::State last = segment.at(from + length);
    const double tick = 1e-14 * profile.duration;
    if (std::fabs(last.velocity - first.velocity - speed) >
        1e-11 * sizes.velocity + sizes.acceleration * tick)
      return "acceleration does not add up";
    if (std::fabs(last.position - first.position - way) >
        1e-11 * sizes.position + sizes.velocity * tick)
      return "velocity does not add up";
  }
  return "";
}

/// Whether a profile keeps the velocity: what is above the limit at the start must not grow, what
/// the end has above the limit must not shrink; else what is wrong.
inline std::string tooFast(const motion::Profile &profile, const MotionProblem &p) {
  const double limit = p.dynamics.velocity * (1 + 1e-9);
  const double tick = 1e-15 * profile.duration;
  // The acceleration of the start may add to the velocity until it is gone.
  const double swung =
      hasAcceleration(p.dynamics) ? std::fabs(p.start.acceleration) / p.dynamics.jerk : 0.0;
  const double acceleration = sizesOf(profile, p).acceleration;
  bool rising = false;
  double last = HUGE_VAL;
  for (int32_t i = 0; i < profile.count; ++i) {
    const motion::Segment &segment = profile.segments[i];
    const double from = segment.start;
    const double length = endOf(profile, i) - from;
    for (int k = 0; k <= 8; ++k) {
      const double t = from + length * k / 8;
      const motion::State now = segment.at(t);
      const double speed = std::fabs(now.velocity);
      const double slack = 1e-11 * speed + 2 * acceleration * tick;
      if (t <= swung * (1 + 1e-9)) {
        if (speed >
            std::max({limit, std::fabs(p.start.velocity) + swingOf(p), std::fabs(p.endVelocity)}) +
                slack)
          return "velocity at the start " + std::to_string(speed);
        continue;
      }
      if (speed > limit + slack) {
        if (speed > last + slack)
          rising = true;
        else if (rising && speed < last - slack)
          return "velocity beyond the limit falls again";
      } else {
        if (rising)
          return "velocity beyond the limit before the end";
      }
      if (rising && speed > std::fabs(p.endVelocity) + slack)
        return "velocity beyond the end's: " + std::to_string(speed);
      last = speed;
    }
  }
  return "";
}

/// Whether a profile keeps acceleration and jerk where the start allows; else what is wrong.
inline std::string tooHard(const motion::Profile &profile, const MotionProblem &p) {
  using motion::RampType;
  const RampType ramp = p.dynamics.ramp;
  const double slack = 1 + 1e-9;
  const MotionSizes sizes = sizesOf(profile, p);
  const double peak = ramp == RampType::Sigmoid ? M_PI / 2 : 1.0;
  const double start = std::fabs(p.start.acceleration);
  const double tick = sizes.jerk * 1e-15 * profile.duration;
  for (int32_t i = 0; i < profile.count; ++i) {
    const motion::Segment &segment = profile.segments[i];
    const double from = segment.start;
    const double length = endOf(profile, i) - from;
    if ((ramp == RampType::Parabolic || ramp == RampType::SigmoidLimited) &&
        std::fabs(segment.jerk) > p.dynamics.jerk * slack)
      return "jerk";
    const bool settling = hasAcceleration(p.dynamics) && ramp != RampType::Parabolic && i == 0 &&
                          p.start.acceleration != 0;
    if (settling) {
      if (segment.frequency != 0 || std::fabs(segment.jerk) > p.dynamics.jerk * slack)
        return "settling";
      continue;
    }
    for (const double part : {1e-9, 0.25, 0.5, 0.75, 1 - 1e-9}) {
      const motion::State now = segment.at(from + part * length);
      const double limit =
          now.velocity * now.acceleration > 0 ? p.dynamics.acceleration : p.dynamics.deceleration;
      const double rate = std::fabs(now.acceleration);
      if (rate <= limit * peak * slack + tick)
        continue;
      if (ramp == RampType::Parabolic) {
        if (rate <= start * slack + tick)
          continue;
        // At a velocity of 0 the one limit gives way to the other; what came with the start may
        // turn the velocity.
        if (std::fabs(now.velocity) <= 1e-9 * sizes.velocity + swingOf(p) * slack &&
            rate <=
                std::max({p.dynamics.acceleration, p.dynamics.deceleration, start}) * slack + tick)
          continue;
      } else if (std::fabs(now.velocity) <=
                 1e-9 * sizes.velocity + sizes.acceleration * 1e-14 * profile.duration) {
        continue; // the sign of the velocity is rounding
      }
      return "acceleration " + std::to_string(now.acceleration);
    }
  }
  return "";
}

/// The way that a profile covers against `direction`.
inline double wayAgainst(const motion::Profile &profile, double direction) {
  double way = 0;
  for (int32_t i = 0; i < profile.count; ++i) {
    const double from = profile.segments[i].start;
    const double length = endOf(profile, i) - from;
    const auto at = [&](double part) { return profile.segments[i].at(from + length * part); };
    for (int k = 0; k < 64; ++k) {
      const double ends[2] = {k / 64.0, (k + 1) / 64.0};
      double turn = ends[1];
      if (at(ends[0]).velocity * at(ends[1]).velocity < 0) {
        double low = ends[0];
        for (int halving = 0; halving < 50; ++halving) {
          const double middle = 0.5 * (low + turn);
          (at(middle).velocity * at(ends[0]).velocity > 0 ? low : turn) = middle;
        }
      }
      const double place = at(turn).position;
      way += std::max(0.0, (at(ends[0]).position - place) * direction) +
             std::max(0.0, (place - at(ends[1]).position) * direction);
    }
  }
  return way;
}

/// The way that the last digit of the end velocity makes: what it takes to bring it about.
inline double lastDigit(const MotionProblem &p) {
  const double speed = std::fabs(p.endVelocity);
  const double digit = 0x1p-50 * speed;
  const double rate = std::min(p.dynamics.acceleration, p.dynamics.deceleration);
  const double byJerk = hasAcceleration(p.dynamics) ? std::sqrt(digit / p.dynamics.jerk) : 0.0;
  return speed * (digit / rate + 2 * byJerk);
}

/// Empty when the profile is right in every respect but optimality; else what is wrong.
inline std::string wrongIn(const motion::Profile &profile, const MotionProblem &p,
                           double blur = 0) {
  if (profile.end.position != p.target || profile.end.velocity != p.endVelocity ||
      profile.end.acceleration != 0)
    return "end";
  if (profile.at(profile.duration).position != p.target)
    return "position at the end";
  if (std::string jump = jumpIn(profile, p, blur); !jump.empty())
    return jump;
  for (const auto check : {notIntegrated, tooFast, tooHard})
    if (std::string wrong = check(profile, p); !wrong.empty())
      return wrong;
  return "";
}

} // namespace stride::test

#endif
