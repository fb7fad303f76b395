// The parameters of the PLC configuration that there are whatever the driver; names, types and
// meanings are those of the SoftMotion V2.3 manual, sections 2.1.2 to 2.1.4. Most are members of
// AXIS_REF, SMC_AXISGROUP_REF or SMC_ENCODER_REF, too, and the compiler knows more about how they
// belong together; a driver gets all of them.
#ifndef STRIDE_RUNTIME_BUS_PLC_SCHEMA_HPP
#define STRIDE_RUNTIME_BUS_PLC_SCHEMA_HPP

#include "runtime/common/parameter.hpp"

#include <array>
#include <cstdint>

namespace stride::bus::plc {

using common::anyReal;
using common::choice;
using common::Choice;
using common::dword;
using common::flag;
using common::identifier;
using common::kLargestDword;
using common::kLargestWord;
using common::positive;
using common::text;
using common::whole;
using common::word;

// iMovementType
inline constexpr int64_t kRotary = 0;
inline constexpr int64_t kLinear = 1;
inline constexpr std::array<Choice, 2> kMovementTypes = {
    {{"rotary", kRotary}, {"linear", kLinear}}};

inline constexpr std::array<Choice, 4> kRampTypes = {
    {{"trapezoid", 0}, {"sigmoid", 1}, {"parabolic", 2}, {"sigmoid_limited", 3}}};

// wControlType: values as AXIS_REF has them (Annex A, 1001).
inline constexpr int64_t kConfigurable = 0;
inline constexpr int64_t kPosVelToPosVel = 5;
inline constexpr std::array<Choice, 7> kControlTypes = {{{"TOR ->", 1},
                                                         {"VEL -> VEL", 2},
                                                         {"VEL -> POS", 3},
                                                         {"POS -> POS", 4},
                                                         {"POS, VEL -> POS, VEL", kPosVelToPosVel},
                                                         {"VEL ->", 6},
                                                         {"CONFIGURABLE", kConfigurable}}};

// Parameter numbers of AXIS_REF (Annex A).
inline constexpr int64_t kUserDefined = 65535; // what it is, the driver knows
inline constexpr std::array<Choice, 5> kSendData = {{{"SetPosition", 1100},
                                                     {"SetVelocity", 1110},
                                                     {"SetTorque", 1160},
                                                     {"SetCurrent", 1150},
                                                     {"SetUserDef", kUserDefined}}};
inline constexpr std::array<Choice, 5> kReceiveData = {{{"ActPosition", 1101},
                                                        {"ActVelocity", 1111},
                                                        {"ActTorque", 1161},
                                                        {"ActCurrent", 1151},
                                                        {"ActUserDef", kUserDefined}}};

// kBit/s: CAN up to 1000, Sercos from 2000.
inline constexpr std::array<Choice, 13> kBaudRates = {{{"10", 10},
                                                       {"20", 20},
                                                       {"50", 50},
                                                       {"100", 100},
                                                       {"125", 125},
                                                       {"250", 250},
                                                       {"500", 500},
                                                       {"800", 800},
                                                       {"1000", 1000},
                                                       {"2000", 2000},
                                                       {"4000", 4000},
                                                       {"8000", 8000},
                                                       {"16000", 16000}}};
inline constexpr std::array<Choice, 3> kSyncProducers = {
    {{"PLC", 0}, {"1.Drive", 1}, {"SYNC device", 2}}};

inline constexpr std::array kBus = {
    identifier("name").needed(),
    text("InterfaceType").needed(),
};

inline constexpr std::array kAxisGroup = {
    identifier("name").needed(),
    text("sTask"),
    whole("dwCycle", 1, kLargestDword, "µs"),
    word("wParam1"),
    word("wParam2"),
    word("wParam3"),
    word("wParam4"),
    dword("dwParam1"),
    dword("dwParam2"),
    dword("dwParam3"),
    dword("dwParam4"),
    choice("BaudRate", kBaudRates),
    whole("LedBrightness", 0, kLargestWord),
    whole("ControllerNo", 0, 255),
    choice("SyncProducer", kSyncProducers),
};

// Drives and encoders have them alike.
inline constexpr auto kRatioDenominator =
    whole("dwRatioTechUnitsDenom", 1, kLargestDword, "increments").defaultsTo(1);
inline constexpr auto kRatioNumerator = whole("iRatioTechUnitsNum", 1, 32767, "u").defaultsTo(1);
inline constexpr auto kMovementType = choice("iMovementType", kMovementTypes).defaultsTo(kLinear);

inline constexpr std::array kDrive = {
    identifier("name").needed(),
    word("wDriveId").needed(),
    text("unit"),
    choice("wControlType", kControlTypes).defaultsTo(kPosVelToPosVel),
    choice("wCyclicDataS1", kSendData),
    choice("wCyclicDataS2", kSendData),
    choice("wCyclicDataS3", kSendData),
    choice("wCyclicDataR1", kReceiveData),
    choice("wCyclicDataR2", kReceiveData),
    choice("wCyclicDataR3", kReceiveData),
    kRatioDenominator,
    kRatioNumerator,
    kMovementType,
    positive("fPositionPeriod", "u"),
    positive("fSWMaxVelocity", "u/s"),
    positive("fSWMaxAcceleration", "u/s²"),
    positive("fSWMaxDeceleration", "u/s²"),
    positive("fSWMaxJerk", "u/s³"),
    flag("bSWLimitEnable"),
    anyReal("fSWLimitNegative", "u"),
    anyReal("fSWLimitPositive", "u"),
    flag("bHWLimitEnable"),
    choice("eRampType", kRampTypes).defaultsTo(0),
    positive("fJerk", "u/s³"),
};

inline constexpr std::array kEncoder = {
    identifier("name").needed(),
    word("wEncoderId").needed(),
    kRatioDenominator,
    kRatioNumerator,
    kMovementType,
    positive("fPositionPeriod", "u"),
    flag("bSWLimitEnable"),
    anyReal("fSWLimitNegative", "u"),
    anyReal("fSWLimitPositive", "u"),
    dword("dwEncoderModulo", "increments"),
    dword("dwParam1"),
    dword("dwParam2"),
    dword("dwParam3"),
    dword("dwParam4"),
    dword("dwParam5"),
    dword("dwParam6"),
    dword("dwParam7"),
    dword("dwParam8"),
};

} // namespace stride::bus::plc

#endif
