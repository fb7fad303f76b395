#include "drivers/sercos/protocol/pack_profile.hpp"

#include <algorithm>
#include <array>

namespace stride::sercos {
namespace {

using namespace idns;

/// Run-up, times, diagnostics, control and status, mode, torque in percent and its limits,
/// velocities and their limit: what all classes have.
constexpr std::array kCommon = {
    kControlUnitCycle, kCommunicationCycle, kShortestAtStart, kAtToMdt,           kShortestFeedback,
    kAtStart,          kFeedbackSampling,   kCommandValid,    kPlaceInMdt,        kMdtLength,
    kClass1,           kInterfaceStatus,    kTelegramType,    kInvalidPhase2,     kInvalidPhase3,
    kPrimaryMode,      kVelocityFeedback,   kVelocityScaling, kTorqueFeedback,    kTorqueScaling,
    kAtToAt,           kMdtToMst,           kMdtStart,        kCommandProcessing, kVelocityLimit,
    kTorqueLimit,      kDiagnosticMessage,  kResetClass1,     kCheckPhase3,       kCheckPhase4,
    kControlWord,      kStatusWord};
constexpr std::array kPosition = {kPositionCommand,
                                  kPositionLimitPositive,
                                  kPositionLimitNegative,
                                  kPositionFeedback1,
                                  kPositionScaling,
                                  kRotationalResolution,
                                  kModulo};
constexpr std::array kVelocity = {kVelocityCommand};
constexpr std::array kMore = {kClass2,
                              kClass3,
                              kAtList,
                              kMdtList,
                              kMostAtData,
                              kMostMdtData,
                              kAtCandidates,
                              kMdtCandidates,
                              kTorqueCommand,
                              kHomingVelocity,
                              kHomingAcceleration,
                              kReferenceDistance1,
                              kHomingParameter,
                              kDriveHoming,
                              kPositionFeedbackStatus,
                              kProbe1Positive,
                              kProbe1Negative,
                              kProbe2Positive,
                              kProbe2Negative,
                              kProbeControl,
                              kProbing,
                              kProbeStatus,
                              kRealTimeControl1,
                              kRealTimeControl2,
                              kRealTimeStatus1,
                              kRealTimeStatus2,
                              kAccelerationScaling,
                              kLinearFactor,
                              kLinearExponent,
                              kVelocityFactor,
                              kVelocityExponent,
                              kHomeSwitch};

template <size_t A, size_t B>
constexpr std::array<Idn, A + B> joined(const std::array<Idn, A> &a, const std::array<Idn, B> &b) {
  std::array<Idn, A + B> all{};
  auto next = std::copy(a.begin(), a.end(), all.begin());
  std::copy(b.begin(), b.end(), next);
  std::sort(all.begin(), all.end());
  return all;
}

constexpr auto kBasicA = joined(kCommon, kPosition);
constexpr auto kBasicB = joined(kCommon, kVelocity);
constexpr auto kExtended = joined(joined(kBasicA, kVelocity), kMore);

} // namespace

std::span<const Idn> packProfileIdns(PackProfile profile) {
  switch (profile) {
  case PackProfile::BasicA:
    return kBasicA;
  case PackProfile::BasicB:
    return kBasicB;
  case PackProfile::Extended:
    return kExtended;
  default:
    return {};
  }
}

} // namespace stride::sercos
