// Identification numbers of Sercos. [IEC 61491]
#ifndef STRIDE_DRIVERS_SERCOS_PROTOCOL_IDN_HPP
#define STRIDE_DRIVERS_SERCOS_PROTOCOL_IDN_HPP

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace stride::sercos {

/// Bit 15: the manufacturer's (P) or the standard's (S); bits 14 … 12: parameter set; bits 11 … 0:
/// number of the data block. S-0-0047 is 47, P-0-0047 is 32768 + 47, S-1-0047 is 4096 + 47.
using Idn = uint16_t;

inline constexpr Idn kProductBit = 0x8000;
inline constexpr uint16_t kLastBlock = 4095;
inline constexpr uint8_t kLastSet = 7;

constexpr Idn idn(bool product, uint8_t set, uint16_t block) {
  return static_cast<Idn>((product ? kProductBit : 0U) | ((set & 7U) << 12U) |
                          (block & kLastBlock));
}

/// "S-0-0047", always 8 characters.
using IdnText = std::array<char, 8>;
IdnText idnText(Idn idn);
/// Reads "S-0-0047" or "P-0-0001": one to four digits at the end, letters of either case; else
/// nothing.
std::optional<Idn> parseIdn(std::string_view text);

namespace idns {
inline constexpr Idn kControlUnitCycle = 1;   ///< tNcyc [µs]
inline constexpr Idn kCommunicationCycle = 2; ///< tScyc [µs]
inline constexpr Idn kShortestAtStart = 3;    ///< t1min [µs]
inline constexpr Idn kAtToMdt = 4;            ///< tATMT [µs]
inline constexpr Idn kShortestFeedback = 5;   ///< t5 [µs]
inline constexpr Idn kAtStart = 6;            ///< t1 [µs]
inline constexpr Idn kFeedbackSampling = 7;   ///< t4 [µs]
inline constexpr Idn kCommandValid = 8;       ///< t3 [µs]
inline constexpr Idn kPlaceInMdt = 9;         ///< From the address field on: 1, 3, 5 … [byte]
inline constexpr Idn kMdtLength = 10;         ///< Of the data field. [byte]
inline constexpr Idn kClass1 = 11;
inline constexpr Idn kClass2 = 12;
inline constexpr Idn kClass3 = 13;
inline constexpr Idn kInterfaceStatus = 14;
inline constexpr Idn kTelegramType = 15;
inline constexpr Idn kAtList = 16; ///< Cyclic data of the AT.
inline constexpr Idn kAllIdns = 17;
inline constexpr Idn kPhase2Idns = 18;    ///< Data that must be given in phase 2.
inline constexpr Idn kPhase3Idns = 19;    ///< Data that must be given in phase 3.
inline constexpr Idn kInvalidPhase2 = 21; ///< What S-0-0127 has found.
inline constexpr Idn kInvalidPhase3 = 22; ///< What S-0-0128 has found.
inline constexpr Idn kMdtList = 24;       ///< Cyclic data of the MDT.
inline constexpr Idn kCommands = 25;      ///< All procedure commands.
inline constexpr Idn kMstErrors = 28;
inline constexpr Idn kMdtErrors = 29;
inline constexpr Idn kManufacturerVersion = 30;
inline constexpr Idn kPrimaryMode = 32;
inline constexpr Idn kSecondaryMode1 = 33;
inline constexpr Idn kSecondaryMode2 = 34;
inline constexpr Idn kSecondaryMode3 = 35;
inline constexpr Idn kVelocityCommand = 36;
inline constexpr Idn kAdditiveVelocity = 37;
inline constexpr Idn kVelocityLimitPositive = 38;
inline constexpr Idn kVelocityLimitNegative = 39;
inline constexpr Idn kVelocityFeedback = 40;
inline constexpr Idn kHomingVelocity = 41;
inline constexpr Idn kHomingAcceleration = 42;
inline constexpr Idn kVelocityPolarity = 43;
inline constexpr Idn kVelocityScaling = 44;
inline constexpr Idn kVelocityFactor = 45;
inline constexpr Idn kVelocityExponent = 46;
inline constexpr Idn kPositionCommand = 47;
inline constexpr Idn kPositionLimitPositive = 49;
inline constexpr Idn kPositionLimitNegative = 50;
inline constexpr Idn kPositionFeedback1 = 51;
inline constexpr Idn kReferenceDistance1 = 52; ///< Position at the reference mark.
inline constexpr Idn kPositionFeedback2 = 53;
inline constexpr Idn kReferenceDistance2 = 54;
inline constexpr Idn kPositionPolarity = 55;
inline constexpr Idn kPositionWindow = 57;
inline constexpr Idn kPositionScaling = 76;
inline constexpr Idn kLinearFactor = 77;
inline constexpr Idn kLinearExponent = 78;
inline constexpr Idn kRotationalResolution = 79; ///< Increments per turn.
inline constexpr Idn kTorqueCommand = 80;
inline constexpr Idn kAdditiveTorque = 81;
inline constexpr Idn kTorqueLimitPositive = 82;
inline constexpr Idn kTorqueLimitNegative = 83;
inline constexpr Idn kTorqueFeedback = 84;
inline constexpr Idn kTorquePolarity = 85;
inline constexpr Idn kTorqueScaling = 86;
inline constexpr Idn kAtToAt = 87;            ///< tATAT [µs]
inline constexpr Idn kMdtToMst = 88;          ///< tMTSY [µs]
inline constexpr Idn kMdtStart = 89;          ///< t2 [µs]
inline constexpr Idn kCommandProcessing = 90; ///< tMTSG [µs]
inline constexpr Idn kVelocityLimit = 91;     ///< Both directions.
inline constexpr Idn kTorqueLimit = 92;       ///< Both directions. [0.1 %]
inline constexpr Idn kTorqueFactor = 93;
inline constexpr Idn kTorqueExponent = 94;
inline constexpr Idn kDiagnosticMessage = 95;
inline constexpr Idn kSlaveArrangement = 96;
inline constexpr Idn kClass2Mask = 97;
inline constexpr Idn kClass3Mask = 98;
inline constexpr Idn kResetClass1 = 99; ///< Procedure command.
inline constexpr Idn kVelocityGain = 100;
inline constexpr Idn kVelocityIntegral = 101;
inline constexpr Idn kModulo = 103;
inline constexpr Idn kPositionGain = 104;
inline constexpr Idn kPeakCurrent = 109;
inline constexpr Idn kRatedCurrent = 111;
inline constexpr Idn kTorqueThreshold = 126;
inline constexpr Idn kCheckPhase3 = 127; ///< Procedure command.
inline constexpr Idn kCheckPhase4 = 128; ///< Procedure command.
inline constexpr Idn kManufacturerClass1 = 129;
inline constexpr Idn kProbe1Positive = 130;
inline constexpr Idn kProbe1Negative = 131;
inline constexpr Idn kProbe2Positive = 132;
inline constexpr Idn kProbe2Negative = 133;
inline constexpr Idn kControlWord = 134;
inline constexpr Idn kStatusWord = 135;
inline constexpr Idn kAccelerationPositive = 136;
inline constexpr Idn kAccelerationNegative = 137;
inline constexpr Idn kAcceleration = 138; ///< Both directions: of halt and stop.
inline constexpr Idn kControllerType = 140;
inline constexpr Idn kMotorType = 141;
inline constexpr Idn kApplicationType = 142;
inline constexpr Idn kInterfaceVersion = 143;
inline constexpr Idn kHomingParameter = 147;
inline constexpr Idn kDriveHoming = 148; ///< Procedure command.
inline constexpr Idn kReferenceOffset1 = 150;
inline constexpr Idn kMonitoringWindow = 159;
inline constexpr Idn kAccelerationScaling = 160;
inline constexpr Idn kProbeControl = 169;
inline constexpr Idn kProbing = 170; ///< Procedure command.
inline constexpr Idn kProbeStatus = 179;
inline constexpr Idn kMostAtData = 185;    ///< Most bytes of cyclic data in the AT.
inline constexpr Idn kMostMdtData = 186;   ///< Most bytes of cyclic data in the MDT.
inline constexpr Idn kAtCandidates = 187;  ///< What may be in S-0-0016.
inline constexpr Idn kMdtCandidates = 188; ///< What may be in S-0-0024.
inline constexpr Idn kFollowingDistance = 189;
inline constexpr Idn kStoreList = 192;    ///< What S-0-0264 stores.
inline constexpr Idn kLoadDefaults = 262; ///< Procedure command.
inline constexpr Idn kStore = 264;        ///< Procedure command.
inline constexpr Idn kSignalControl = 145;
inline constexpr Idn kSignalStatus = 144;
inline constexpr Idn kRealTimeControl1 = 301;
inline constexpr Idn kRealTimeControl2 = 303;
inline constexpr Idn kRealTimeStatus1 = 305;
inline constexpr Idn kRealTimeStatus2 = 307;
inline constexpr Idn kInPosition = 336;
inline constexpr Idn kHomeSwitch = 400;
inline constexpr Idn kProbe1 = 401;
inline constexpr Idn kProbe2 = 402;
inline constexpr Idn kPositionFeedbackStatus = 403; ///< Bit 0: it has been homed.
inline constexpr Idn kProbe1Enable = 405;
inline constexpr Idn kProbe2Enable = 406;
inline constexpr Idn kHomingEnable = 407;
inline constexpr Idn kProbe1PositiveLatched = 409;
inline constexpr Idn kProbe1NegativeLatched = 410;
inline constexpr Idn kProbe2PositiveLatched = 411;
inline constexpr Idn kProbe2NegativeLatched = 412;
} // namespace idns

} // namespace stride::sercos

#endif
