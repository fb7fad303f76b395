#include "drivers/dummy/mechanics.hpp"

#include "runtime/iec/math.h"

namespace stride::dummy {
namespace {

double magnitude(double x) { return x < 0 ? -x : x; }

double withSign(double size, double sign) { return sign < 0 ? -size : size; }

// Below this the closed forms lose digits to cancellation, and series are exact to the last one.
constexpr double kSmall = 0.125;

/// (1 - exp(-z)) / z for z >= 0.
double decayIntegral(double z) {
  if (z >= kSmall)
    return (1.0 - stride::exp(-z)) / z;
  double sum = 0;
  for (int n = 14; n >= 0; --n) // 1 - z/2 + z^2/6 - …
    sum = 1.0 / (n + 1) * (1.0 - z * sum);
  return sum;
}

/// (z - 1 + exp(-z)) / z^2 for z >= 0.
double decayDoubleIntegral(double z) {
  if (z >= kSmall)
    return (1.0 - decayIntegral(z)) / z;
  double sum = 0;
  for (int n = 14; n >= 0; --n) // 1/2 - z/6 + z^2/24 - …
    sum = 1.0 / (n + 2) * (1.0 - z * sum);
  return sum;
}

/// ln(1 + u) / u for u >= 0.
double logQuotient(double u) {
  if (u >= kSmall)
    return stride::ln(1.0 + u) / u;
  double sum = 0;
  for (int n = 17; n >= 1; --n) // 1 - u/2 + u^2/3 - …
    sum = 1.0 / n - u * sum;
  return sum;
}

} // namespace

void moveBody(const MechanicsParameters &parameters, double torque, double time, double &x,
              double &v) {
  const double mass = parameters.inertia;
  const double viscous = parameters.viscousFriction;
  const double dry = parameters.coulombFriction;
  // At most: to rest, and away again.
  for (int phase = 0; phase < 2 && time > 0; ++phase) {
    if (v == 0 && magnitude(torque) <= dry)
      return; // sticks
    const double force = torque - withSign(dry, v != 0 ? v : torque);
    double span = time;
    bool stops = false;
    if (v != 0 && force * v < 0) { // m v' = force - viscous v reaches 0
      const double toRest = -mass * v / force * logQuotient(-viscous * v / force);
      stops = toRest <= time;
      if (stops)
        span = toRest;
    }
    const double z = viscous * span / mass;
    const double acceleration = (force - viscous * v) / mass;
    x += v * span + acceleration * span * span * decayDoubleIntegral(z);
    v = stops ? 0.0 : v + acceleration * span * decayIntegral(z);
    time -= span;
  }
}

Mechanics::Mechanics(const MechanicsParameters &parameters, int64_t position) : whole_(position) {
  configure(parameters);
}

void Mechanics::configure(const MechanicsParameters &parameters) {
  p_ = parameters;
  if (p_.model == Model::Lag)
    decay_ = stride::exp(-p_.cycle / p_.timeConstant);
}

/// The axis is `offset` increments beyond `whole`.
void Mechanics::set(int64_t whole, double offset) {
  const double turns = stride::floor(offset + 0.5);
  whole_ = whole + static_cast<int64_t>(turns);
  rest_ = offset - turns;
}

double Mechanics::limited(double torque) {
  if (magnitude(torque) <= p_.torqueLimit)
    return torque;
  saturated_ = true;
  return withSign(p_.torqueLimit, torque);
}

void Mechanics::regulate(const Demand &demand, double load) {
  saturated_ = false;
  switch (p_.model) {
  case Model::Ideal:
    torque_ = demand.torque;
    velocity_ = demand.velocity;
    if (demand.mode == kPositionMode) {
      whole_ = demand.to;
      rest_ = 0;
    } else {
      set(whole_, rest_ + 0.5 * (demand.velocityFrom + demand.velocity) * p_.cycle);
    }
    break;
  case Model::Lag:
    regulateLag(demand);
    break;
  case Model::SecondOrder:
    regulateSecondOrder(demand, load);
    break;
  }
}

/// T y' + y = x, with x a ramp over the cycle; the same for the velocity.
void Mechanics::regulateLag(const Demand &demand) {
  const double time = p_.timeConstant;
  if (demand.mode == kPositionMode) {
    const double lag = static_cast<double>(demand.from - whole_) - rest_;
    const double way = static_cast<double>(demand.to - demand.from);
    const double left = lag * decay_ + way / p_.cycle * time * (1.0 - decay_);
    set(demand.to, -left);
    velocity_ = left / time;
    return;
  }
  const double change = (demand.velocity - demand.velocityFrom) / p_.cycle * time;
  const double deviation = velocity_ - demand.velocityFrom + change;
  const double mean = 0.5 * (demand.velocityFrom + demand.velocity) - change;
  set(whole_, rest_ + mean * p_.cycle + deviation * time * (1.0 - decay_));
  velocity_ = demand.velocity - change + deviation * decay_;
}

/// The controllers run `substeps` times in a cycle; between them the torque is constant and the
/// motion is exact.
void Mechanics::regulateSecondOrder(const Demand &demand, double load) {
  const bool positioning = demand.mode == kPositionMode;
  const int64_t base = positioning ? demand.to : whole_;
  const double step = p_.cycle / p_.substeps;
  const double way = static_cast<double>(demand.to - demand.from);
  double x = static_cast<double>(whole_ - base) + rest_;
  double v = velocity_;
  for (uint32_t i = 1; i <= p_.substeps; ++i) {
    if (demand.mode == kTorqueMode) {
      torque_ = limited(demand.torque);
    } else {
      const double passed = static_cast<double>(i - 1) / p_.substeps;
      double wanted = demand.velocityFrom + (demand.velocity - demand.velocityFrom) * passed;
      if (positioning) {
        const double ahead = way * (passed - 1.0);
        wanted = p_.positionGain * (ahead - x) + p_.velocityFeedforward * way / p_.cycle;
      }
      const double deviation = wanted - v;
      const double free = p_.velocityGain * deviation + integral_;
      torque_ = limited(free);
      // The integral part waits while more of it would not help.
      if (p_.integralTime > 0 && (free == torque_ || deviation * free < 0))
        integral_ += p_.velocityGain * deviation * step / p_.integralTime;
    }
    moveBody(p_, torque_ + load, step, x, v);
  }
  set(base, x);
  velocity_ = v;
}

void Mechanics::coast(double load) {
  torque_ = 0;
  integral_ = 0;
  saturated_ = false;
  if (p_.model != Model::SecondOrder) {
    velocity_ = 0;
    return;
  }
  double x = rest_;
  moveBody(p_, load, p_.cycle, x, velocity_);
  set(whole_, x);
}

void Mechanics::hold() {
  torque_ = 0;
  integral_ = 0;
  velocity_ = 0;
  saturated_ = false;
}

void Mechanics::place(int64_t position) {
  hold();
  whole_ = position;
  rest_ = 0;
}

} // namespace stride::dummy
