// What every device on the ring has: times, telegrams, diagnostics. Names and units are those of
// the standard; times that a device needs are those of public data sheets.
#include "drivers/sercos/protocol/telegrams.hpp"
#include "drivers/sercos/simulation/device.hpp"
#include "drivers/sercos/simulation/rows.hpp"

namespace stride::sercos::simulation {
namespace {

using namespace idns;
using namespace rows;

constexpr size_t kTextRoom = 60;
constexpr size_t kInvalidRoom = 64; // 32 IDNs
constexpr int64_t kMostBytes = kMostCyclicObjects * kMostObjectBytes;

void addTimes(std::vector<IdnRow> &all) {
  const auto given = [&all](Idn idn, std::string_view name, std::string_view unit, int64_t value,
                            int64_t low, int64_t high) {
    all.push_back({.idn = idn,
                   .name = name,
                   .unit = unit,
                   .attribute = number(kIn2),
                   .value = value,
                   .low = low,
                   .high = high,
                   .given = Given::Phase2});
  };
  const auto fixed = [&all](Idn idn, std::string_view name, int64_t value) {
    all.push_back(
        {.idn = idn, .name = name, .unit = "us", .attribute = number(kNever), .value = value});
  };
  given(kControlUnitCycle, "NC cycle time (TNcyc)", "us", 2000, 62, 65000);
  given(kCommunicationCycle, "SERCOS cycle time (TScyc)", "us", 2000, 62, 65000);
  fixed(kShortestAtStart, "Shortest AT transmission starting time (T1min)", 12);
  fixed(kAtToMdt, "Transmit/receive transition time (TATMT)", 12);
  fixed(kShortestFeedback, "Minimum feedback processing time (T5)", 200);
  given(kAtStart, "AT transmission starting time (T1)", "us", 0, 0, 65000);
  given(kFeedbackSampling, "Feedback acquisition capture point (T4)", "us", 0, 0, 65000);
  given(kCommandValid, "Command value valid time (T3)", "us", 0, 0, 65000);
  given(kPlaceInMdt, "Position of data record in MDT", "byte", 1, 1, 65531);
  given(kMdtLength, "Length of MDT", "byte", 4, 4, 65534);
  fixed(kAtToAt, "Transmit to transmit recovery time (TATAT)", 4);
  fixed(kMdtToMst, "Receive to receive recovery time (TMTSY)", 50);
  given(kMdtStart, "MDT transmission starting time (T2)", "us", 0, 0, 65000);
  fixed(kCommandProcessing, "Command value proceeding time (TMTSG)", 50);
}

void addTelegrams(std::vector<IdnRow> &all) {
  constexpr size_t kRoom = 2 * kMostCyclicObjects;
  all.push_back({.idn = kTelegramType,
                 .name = "Telegram type parameter",
                 .attribute = bits(kIn2),
                 .value = 4,
                 .given = Given::Phase2});
  all.push_back({.idn = kAtList,
                 .name = "Configuration list of AT",
                 .attribute = idnList(kIn2),
                 .room = kRoom});
  all.push_back({.idn = kMdtList,
                 .name = "Configuration list of MDT",
                 .attribute = idnList(kIn2),
                 .room = kRoom});
  all.push_back({.idn = kMostAtData,
                 .name = "Length of the configurable data record in the AT",
                 .unit = "byte",
                 .attribute = number(kNever),
                 .value = kMostBytes});
  all.push_back({.idn = kMostMdtData,
                 .name = "Length of the configurable data record in the MDT",
                 .unit = "byte",
                 .attribute = number(kNever),
                 .value = kMostBytes});
  all.push_back({.idn = kAtCandidates,
                 .name = "IDN-list of configurable data in the AT",
                 .attribute = idnList(kNever)});
  all.push_back({.idn = kMdtCandidates,
                 .name = "IDN-list of configurable data in the MDT",
                 .attribute = idnList(kNever)});
  all.push_back({.idn = kSlaveArrangement,
                 .name = "Slave arrangement (SLKN)",
                 .attribute = of(2, Display::Hexadecimal, kNever)});
}

void addLists(std::vector<IdnRow> &all) {
  const auto list = [&all](Idn idn, std::string_view name, size_t room) {
    all.push_back({.idn = idn, .name = name, .attribute = idnList(kNever), .room = room});
  };
  list(kAllIdns, "IDN-list of all operation data", 0);
  list(kPhase2Idns, "IDN-list of operation data for CP2", 0);
  list(kPhase3Idns, "IDN-list of operation data for CP3", 0);
  list(kInvalidPhase2, "IDN-list of invalid operation data for CP2", kInvalidRoom);
  list(kInvalidPhase3, "IDN-list of invalid operation data for CP3", kInvalidRoom);
  list(kCommands, "IDN-list of all procedure commands", 0);
}

void addDiagnostics(std::vector<IdnRow> &all) {
  const auto seen = [&all](Idn idn, std::string_view name) {
    all.push_back({.idn = idn, .name = name, .attribute = bits(kNever), .cyclic = kInAt});
  };
  seen(kClass1, "Class 1 diagnostic (C1D)");
  seen(kClass2, "Class 2 diagnostic (C2D)");
  seen(kClass3, "Class 3 diagnostic (C3D)");
  seen(kInterfaceStatus, "Interface status");
  seen(kManufacturerClass1, "Manufacturer class 1 diagnostic");
  seen(kControlWord, "Master control word");
  seen(kStatusWord, "Drive status word");
  for (const Idn idn : {kClass2Mask, kClass3Mask})
    all.push_back(
        {.idn = idn,
         .name = idn == kClass2Mask ? "Mask class 2 diagnostic" : "Mask class 3 diagnostic",
         .attribute = bits(kIn234),
         .value = 0xFFFF});
  all.push_back({.idn = kMstErrors, .name = "MST error counter", .attribute = number(kNever)});
  all.push_back({.idn = kMdtErrors, .name = "MDT error counter", .attribute = number(kNever)});
  all.push_back({.idn = kDiagnosticMessage,
                 .name = "Diagnostic message",
                 .attribute = text(kNever),
                 .text = "ready",
                 .room = kTextRoom});
  all.push_back({.idn = kManufacturerVersion,
                 .name = "Manufacturer version",
                 .attribute = text(kNever),
                 .text = "Stride simulation 1"});
  all.push_back({.idn = kInterfaceVersion,
                 .name = "SERCOS interface version",
                 .attribute = text(kNever),
                 .text = "V02.00"});
}

void addCommandsAndBits(std::vector<IdnRow> &all) {
  all.push_back(
      {.idn = kResetClass1, .name = "Reset class 1 diagnostic", .attribute = command(kIn234)});
  all.push_back({.idn = kCheckPhase3, .name = "CP3 transition check", .attribute = command(kIn2)});
  all.push_back({.idn = kCheckPhase4,
                 .name = "CP4 transition check",
                 .attribute = command(protect::kPhase2 | protect::kPhase4)});
  all.push_back({.idn = kRealTimeControl1,
                 .name = "Allocation of real-time control bit 1",
                 .attribute = idnNumber(kIn234)});
  all.push_back({.idn = kRealTimeControl2,
                 .name = "Allocation of real-time control bit 2",
                 .attribute = idnNumber(kIn234)});
  all.push_back({.idn = kRealTimeStatus1,
                 .name = "Allocation of real-time status bit 1",
                 .attribute = idnNumber(kIn234)});
  all.push_back({.idn = kRealTimeStatus2,
                 .name = "Allocation of real-time status bit 2",
                 .attribute = idnNumber(kIn234)});
}

} // namespace

std::vector<IdnRow> communicationRows() {
  std::vector<IdnRow> all;
  addTimes(all);
  addTelegrams(all);
  addLists(all);
  addDiagnostics(all);
  addCommandsAndBits(all);
  return all;
}

} // namespace stride::sercos::simulation
