#include "drivers/dummy/parameter_list.hpp"

#include "runtime/iec/math.h"

#include <array>

namespace stride::dummy {
namespace {

using Answer = bus::ParameterAnswer;
using Type = Answer::Type;
using Target = ParameterTarget;

/// Which drives have a parameter.
enum class Of : uint8_t { All, Lag, SecondOrder, Linear };

/// Which values it takes.
enum class Range : uint8_t { ReadOnly, Any, Positive, NotNegative, Share };

struct Entry {
  int32_t number;
  Type type;
  std::string_view name;
  std::string_view unit;
  Of of;
  Range range;
  double (*get)(const Target &);
  void (*set)(Target &, double);
  uint32_t DriveParameters::*raw = nullptr;          ///< Type::Raw.
  bus::ByteString DriveParameters::*bytes = nullptr; ///< Type::Bytes.
};

double units(const Target &t, double increments) {
  return increments * t.parameters.unitsPerIncrement;
}
double increments(const Target &t, double units) { return units / t.parameters.unitsPerIncrement; }

void neverSet(Target & /*t*/, double /*value*/) {}
double noNumber(const Target & /*t*/) { return 0; }

// Everything of the mechanics that is set goes on from where it is.
template <double MechanicsParameters::*Member> void setMechanics(Target &t, double value) {
  t.parameters.mechanics.*Member = value;
  t.mechanics.configure(t.parameters.mechanics);
}
template <double MechanicsParameters::*Member> double getMechanics(const Target &t) {
  return t.parameters.mechanics.*Member;
}
// The same for what refers to increments inside and to technical units outside.
template <double MechanicsParameters::*Member> void setPerUnit(Target &t, double value) {
  setMechanics<Member>(t, value * t.parameters.unitsPerIncrement);
}
template <double MechanicsParameters::*Member> double getPerUnit(const Target &t) {
  return t.parameters.mechanics.*Member / t.parameters.unitsPerIncrement;
}
template <double DriveParameters::*Member> void setLength(Target &t, double value) {
  t.parameters.*Member = increments(t, value);
}
template <double DriveParameters::*Member> double getLength(const Target &t) {
  return units(t, t.parameters.*Member);
}
template <bool DriveParameters::*Member> void setFlag(Target &t, double value) {
  t.parameters.*Member = value != 0;
}
template <bool DriveParameters::*Member> double getFlag(const Target &t) {
  return t.parameters.*Member ? 1 : 0;
}
template <double HomingParameters::*Member> void setHoming(Target &t, double value) {
  t.parameters.homing.*Member = increments(t, value);
}
template <double HomingParameters::*Member> double getHoming(const Target &t) {
  return units(t, t.parameters.homing.*Member);
}

using M = MechanicsParameters;
using D = DriveParameters;
using H = HomingParameters;

constexpr auto kReal = Type::Real;
constexpr auto kWhole = Type::Whole;
constexpr auto kBool = Type::Bool;

constexpr std::array kEntries = {
    Entry{1, kWhole, "Model", "", Of::All, Range::ReadOnly,
          [](const Target &t) -> double { return static_cast<int>(t.parameters.mechanics.model); },
          neverSet},
    Entry{2, kWhole, "DeadTime", "cycles", Of::All, Range::ReadOnly,
          [](const Target &t) -> double { return t.parameters.deadTime; }, neverSet},
    Entry{3, kWhole, "SwitchCycles", "cycles", Of::All, Range::Positive,
          [](const Target &t) -> double { return t.parameters.switchCycles; },
          [](Target &t, double value) {
            t.parameters.switchCycles = static_cast<uint32_t>(value);
          }},
    Entry{10, kReal, "TimeConstant", "s", Of::Lag, Range::Positive, getMechanics<&M::timeConstant>,
          setMechanics<&M::timeConstant>},
    Entry{11, kReal, "Inertia", "Nm/(u/s^2)", Of::SecondOrder, Range::Positive,
          getPerUnit<&M::inertia>, setPerUnit<&M::inertia>},
    Entry{12, kReal, "ViscousFriction", "Nm/(u/s)", Of::SecondOrder, Range::NotNegative,
          getPerUnit<&M::viscousFriction>, setPerUnit<&M::viscousFriction>},
    Entry{13, kReal, "CoulombFriction", "Nm", Of::SecondOrder, Range::NotNegative,
          getMechanics<&M::coulombFriction>, setMechanics<&M::coulombFriction>},
    Entry{20, kReal, "TorqueLimit", "Nm", Of::SecondOrder, Range::Positive,
          getMechanics<&M::torqueLimit>, setMechanics<&M::torqueLimit>},
    Entry{21, kReal, "PositionGain", "1/s", Of::SecondOrder, Range::Positive,
          getMechanics<&M::positionGain>, setMechanics<&M::positionGain>},
    Entry{22, kReal, "VelocityGain", "Nm/(u/s)", Of::SecondOrder, Range::Positive,
          getPerUnit<&M::velocityGain>, setPerUnit<&M::velocityGain>},
    Entry{23, kReal, "IntegralTime", "s", Of::SecondOrder, Range::NotNegative,
          getMechanics<&M::integralTime>, setMechanics<&M::integralTime>},
    Entry{24, kReal, "VelocityFeedforward", "", Of::SecondOrder, Range::Share,
          getMechanics<&M::velocityFeedforward>, setMechanics<&M::velocityFeedforward>},
    Entry{30, kBool, "LimitPositiveUsed", "", Of::Linear, Range::Any,
          getFlag<&D::hasLimitPositive>, setFlag<&D::hasLimitPositive>},
    Entry{31, kReal, "LimitPositive", "u", Of::Linear, Range::Any, getLength<&D::limitPositive>,
          setLength<&D::limitPositive>},
    Entry{32, kBool, "LimitNegativeUsed", "", Of::Linear, Range::Any,
          getFlag<&D::hasLimitNegative>, setFlag<&D::hasLimitNegative>},
    Entry{33, kReal, "LimitNegative", "u", Of::Linear, Range::Any, getLength<&D::limitNegative>,
          setLength<&D::limitNegative>},
    Entry{40, kReal, "HomingVelocity", "u/s", Of::All, Range::Positive, getHoming<&H::fast>,
          setHoming<&H::fast>},
    Entry{41, kReal, "HomingVelocitySlow", "u/s", Of::All, Range::Positive, getHoming<&H::slow>,
          setHoming<&H::slow>},
    Entry{42, kReal, "HomingAcceleration", "u/s^2", Of::All, Range::Positive,
          getHoming<&H::acceleration>, setHoming<&H::acceleration>},
    Entry{43, kBool, "HomingPositive", "", Of::All, Range::Any,
          [](const Target &t) -> double { return t.parameters.homing.positive ? 1 : 0; },
          [](Target &t, double value) { t.parameters.homing.positive = value != 0; }},
    Entry{100, kReal, "Position", "u", Of::All, Range::ReadOnly,
          [](const Target &t) {
            return units(t, static_cast<double>(t.mechanics.position()) + t.mechanics.fraction());
          },
          neverSet},
    Entry{101, kReal, "Velocity", "u/s", Of::All, Range::ReadOnly,
          [](const Target &t) { return units(t, t.mechanics.velocity()); }, neverSet},
    Entry{102, kReal, "Torque", "Nm", Of::All, Range::ReadOnly,
          [](const Target &t) { return t.mechanics.torque(); }, neverSet},
    Entry{103, kReal, "Lag", "u", Of::All, Range::ReadOnly,
          [](const Target &t) { return units(t, t.lag); }, neverSet},
    Entry{104, kWhole, "PositionCounter", "inc", Of::All, Range::ReadOnly,
          [](const Target &t) -> double { return t.status.position; }, neverSet},
    Entry{105, kBool, "HomeSwitch", "", Of::All, Range::ReadOnly,
          [](const Target &t) -> double { return t.status.homeSwitch ? 1 : 0; }, neverSet},
    Entry{106, kWhole, "ErrorNumber", "", Of::All, Range::ReadOnly,
          [](const Target &t) -> double { return t.status.errorId; }, neverSet},
    Entry{200, Type::Raw, "DeviceType", "", Of::All, Range::ReadOnly, noNumber, neverSet,
          &D::deviceType},
    Entry{201, Type::Raw, "UserBits", "", Of::All, Range::Any, noNumber, neverSet, &D::userBits},
    Entry{210, Type::Bytes, "DeviceName", "", Of::All, Range::ReadOnly, noNumber, neverSet, nullptr,
          &D::deviceName},
    Entry{211, Type::Bytes, "UserText", "", Of::All, Range::Any, noNumber, neverSet, nullptr,
          &D::userText},
};

bus::ParameterForm formOf(const Entry &entry) {
  switch (entry.type) {
  case Type::Bool:
    return bus::ParameterForm::Bool;
  case Type::Raw:
    return bus::ParameterForm::Raw;
  case Type::Bytes:
    return bus::ParameterForm::Bytes;
  case Type::Whole:
  case Type::Real:
    break;
  }
  return bus::ParameterForm::Number;
}

bool applies(const Entry &entry, const Target &target) {
  switch (entry.of) {
  case Of::Lag:
    return target.parameters.mechanics.model == Model::Lag;
  case Of::SecondOrder:
    return target.parameters.mechanics.model == Model::SecondOrder;
  case Of::Linear:
    return target.parameters.period <= 0;
  case Of::All:
    break;
  }
  return true;
}

bool inRange(Range range, double value) {
  switch (range) {
  case Range::Positive:
    return value > 0;
  case Range::NotNegative:
    return value >= 0;
  case Range::Share:
    return value >= 0 && value <= 1;
  default:
    return true;
  }
}

const Entry *find(const Target &target, int32_t number) {
  for (const Entry &entry : kEntries)
    if (entry.number == number && applies(entry, target))
      return &entry;
  return nullptr;
}

const Entry *findPlace(const Target &target, const bus::ParameterRequest &request) {
  int32_t place = request.number;
  for (const Entry &entry : kEntries)
    if (applies(entry, target) && (request.forms & bus::formBit(formOf(entry))) != 0 &&
        place-- == 0)
      return &entry;
  return nullptr;
}

Answer::Result writeNumber(Target &target, const Entry &entry, double value) {
  constexpr double kLargest = 1e9; // any further whole number fits
  if (!(value > -1e300 && value < 1e300))
    return Answer::Result::Refused;
  if (entry.type == Type::Whole)
    value = stride::floor(value + 0.5);
  if (!inRange(entry.range, value) || (entry.type == Type::Whole && value > kLargest))
    return Answer::Result::Refused;
  entry.set(target, value);
  return Answer::Result::Done;
}

Answer::Result write(Target &target, const Entry &entry, const bus::ParameterRequest &request) {
  if (entry.range == Range::ReadOnly)
    return Answer::Result::ReadOnly;
  if (entry.raw != nullptr) {
    target.parameters.*entry.raw = request.raw;
  } else if (entry.bytes != nullptr) {
    if (request.bytes.size() > kUserText)
      return Answer::Result::Refused;
    target.parameters.*entry.bytes = request.bytes;
  } else {
    return writeNumber(target, entry, request.value);
  }
  return Answer::Result::Done;
}

void read(const Target &target, const Entry &entry, Answer &answer) {
  if (entry.raw != nullptr)
    answer.raw = target.parameters.*entry.raw;
  else if (entry.bytes != nullptr)
    answer.bytes = target.parameters.*entry.bytes;
  else
    answer.value = entry.get(target);
}

} // namespace

Answer answerParameter(Target &target, const bus::ParameterRequest &request) {
  using Kind = bus::ParameterRequest::Kind;
  Answer answer;
  const Entry *entry =
      request.kind == Kind::Describe ? findPlace(target, request) : find(target, request.number);
  if (entry == nullptr || (request.kind != Kind::Describe && formOf(*entry) != request.form)) {
    answer.result = Answer::Result::Unknown;
    return answer;
  }
  switch (request.kind) {
  case Kind::Read:
    read(target, *entry, answer);
    break;
  case Kind::Write:
    answer.result = write(target, *entry, request);
    break;
  case Kind::Describe:
    answer.number = entry->number;
    answer.type = entry->type;
    answer.writable = entry->range != Range::ReadOnly;
    answer.name = entry->name;
    answer.unit = entry->unit;
    break;
  }
  return answer;
}

} // namespace stride::dummy
