#include "drivers/sercos/simulation/simulated_io.hpp"

#include "drivers/sercos/simulation/drive_setup.hpp"
#include "drivers/sercos/simulation/rows.hpp"

namespace stride::sercos::simulation {
namespace {

std::vector<IdnRow> ioRows(const IoSetup &setup) {
  using namespace rows;
  std::vector<IdnRow> all = setup.more; // the last one of several for the same IDN counts
  for (const IdnRow &row : communicationRows())
    all.push_back(row);
  all.push_back({.idn = idns::kTelegramType,
                 .name = "Telegram type parameter",
                 .attribute = bits(kIn2),
                 .value = kApplicationTelegram,
                 .given = Given::Phase2});
  all.push_back({.idn = kDigitalOutputs,
                 .name = "Digital outputs",
                 .attribute = bits(kIn234),
                 .cyclic = kInAt | kInMdt});
  all.push_back({.idn = kDigitalInputs,
                 .name = "Digital inputs",
                 .attribute = bits(kNever),
                 .cyclic = kInAt});
  all.push_back({.idn = idns::kControllerType,
                 .name = "Controller type",
                 .attribute = text(kNever),
                 .text = "Stride simulated I/O"});
  return all;
}

} // namespace

SimulatedIo::SimulatedIo(const IoSetup &setup) : Device(setup.device, ioRows(setup)) {}

void SimulatedIo::onPhase(Phase /*before*/) noexcept { list().at(kDigitalOutputs).value = 0; }

void SimulatedIo::onCycle(int64_t /*periodNs*/) noexcept {
  outputs_ = phase() == Phase::Four && !hasError()
                 ? static_cast<uint16_t>(list().value(kDigitalOutputs))
                 : uint16_t{0};
  list().at(kDigitalInputs).value = inputs_;
}

uint16_t SimulatedIo::deviceStatus() const noexcept {
  const Ready ready = hasError() ? Ready::Not : Ready::Logic;
  return static_cast<uint16_t>(static_cast<unsigned>(ready) << status::kReadyShift);
}

uint16_t SimulatedIo::checkData(const IdnEntry &entry, int64_t value) noexcept {
  const Idn idn = entry.row.idn;
  const bool assigns = idn == idns::kRealTimeControl1 || idn == idns::kRealTimeControl2 ||
                       idn == idns::kRealTimeStatus1 || idn == idns::kRealTimeStatus2;
  return assigns && value != 0 ? service_error::kInvalidData : service_error::kNone;
}

uint16_t SimulatedIo::onCommand(Idn /*idn*/) noexcept { return data_state::kFailed; }

} // namespace stride::sercos::simulation
