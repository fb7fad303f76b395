#include "drivers/sercos/master/scaling.hpp"

#include "runtime/iec/math.h"

#include <array>

namespace stride::sercos {
namespace {

constexpr double kMinute = 60;
constexpr double kTurn = 6.283185307179586;

double powerOfTen(int64_t exponent) {
  constexpr int64_t kMost = 30;
  return stride::pow(10.0, static_cast<double>(std::clamp(exponent, -kMost, kMost)));
}

bool has(int64_t word, uint16_t bits) { return (static_cast<uint64_t>(word) & bits) != 0; }

uint16_t kindOf(int64_t word) {
  return static_cast<uint16_t>(static_cast<uint64_t>(word) & scaling::kKind);
}

struct FactRow {
  Idn idn;
  int64_t ScalingFacts::*member;
};
constexpr std::array<FactRow, 11> kFacts = {{
    {idns::kPositionScaling, &ScalingFacts::position},
    {idns::kLinearFactor, &ScalingFacts::linearFactor},
    {idns::kLinearExponent, &ScalingFacts::linearExponent},
    {idns::kRotationalResolution, &ScalingFacts::turn},
    {idns::kModulo, &ScalingFacts::modulo},
    {idns::kVelocityScaling, &ScalingFacts::velocity},
    {idns::kVelocityFactor, &ScalingFacts::velocityFactor},
    {idns::kVelocityExponent, &ScalingFacts::velocityExponent},
    {idns::kTorqueScaling, &ScalingFacts::torque},
    {idns::kTorqueFactor, &ScalingFacts::torqueFactor},
    {idns::kTorqueExponent, &ScalingFacts::torqueExponent},
}};

} // namespace

int64_t *ScalingFacts::of(Idn idn) {
  for (const FactRow &row : kFacts)
    if (row.idn == idn)
      return &(this->*row.member);
  return nullptr;
}

double velocityUnit(const ScalingFacts &facts) {
  const uint16_t kind = kindOf(facts.velocity);
  if (kind != scaling::kLinear && kind != scaling::kRotational)
    return 1;
  const bool seconds = has(facts.velocity, scaling::kSeconds);
  const bool own = has(facts.velocity, scaling::kParameters);
  double unit = static_cast<double>(facts.velocityFactor) * powerOfTen(facts.velocityExponent);
  if (!own) // what is preferred: 10^-6 m/min, 10^-4 turns/min, 10^-6 turns/s
    unit = kind == scaling::kRotational && !seconds ? 1e-4 : 1e-6;
  if (!seconds)
    unit /= kMinute;
  if (kind == scaling::kRotational) {
    if (own && has(facts.velocity, scaling::kRadians))
      unit /= kTurn;
    const double turn = has(facts.position, scaling::kParameters) ? static_cast<double>(facts.turn)
                                                                  : kPreferredTurn;
    return unit * turn;
  }
  const double increment =
      has(facts.position, scaling::kParameters)
          ? static_cast<double>(facts.linearFactor) * powerOfTen(facts.linearExponent)
          : 1e-7;
  return unit / increment;
}

double torqueUnit(const ScalingFacts &facts, double rated) {
  const uint16_t kind = kindOf(facts.torque);
  if (kind != scaling::kLinear && kind != scaling::kRotational)
    return rated / 1000; // 0.1 %
  if (has(facts.torque, scaling::kParameters))
    return static_cast<double>(facts.torqueFactor) * powerOfTen(facts.torqueExponent);
  return kind == scaling::kLinear ? 1.0 : 0.01;
}

uint32_t moduloOf(const ScalingFacts &facts) {
  if (!has(facts.position, scaling::kModulo) || facts.modulo <= 0 || facts.modulo > INT32_MAX)
    return 0;
  return static_cast<uint32_t>(facts.modulo);
}

void PositionCounter::begin(uint32_t modulo, int32_t position) {
  modulo_ = modulo;
  shown_ = toldValue_ = position;
  counter_ = told_ = static_cast<uint32_t>(position);
}

/// The shorter way.
int32_t PositionCounter::wayTo(int32_t position) const {
  const auto way =
      static_cast<int32_t>(static_cast<uint32_t>(position) - static_cast<uint32_t>(shown_));
  if (modulo_ == 0)
    return way;
  const auto turn = static_cast<int64_t>(modulo_);
  int64_t rest = static_cast<int64_t>(way) % turn;
  if (rest > turn / 2)
    rest -= turn;
  else if (rest < -(turn / 2))
    rest += turn;
  return static_cast<int32_t>(rest);
}

void PositionCounter::show(int32_t position) {
  counter_ += static_cast<uint32_t>(wayTo(position));
  shown_ = position;
}

uint32_t PositionCounter::counterOf(int32_t position) const {
  return counter_ + static_cast<uint32_t>(wayTo(position));
}

int32_t PositionCounter::command(uint32_t counter) {
  const auto way = static_cast<int32_t>(counter - told_);
  told_ = counter;
  if (modulo_ == 0) {
    toldValue_ =
        static_cast<int32_t>(static_cast<uint32_t>(toldValue_) + static_cast<uint32_t>(way));
    return toldValue_;
  }
  const auto turn = static_cast<int64_t>(modulo_);
  int64_t value = (int64_t{toldValue_} + way) % turn;
  if (value < 0)
    value += turn;
  toldValue_ = static_cast<int32_t>(value);
  return toldValue_;
}

} // namespace stride::sercos
