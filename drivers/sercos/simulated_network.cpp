#include "drivers/sercos/simulated_network.hpp"

#include "drivers/sercos/master/scaling.hpp"
#include "drivers/sercos/plan/drive_settings.hpp"
#include "drivers/sercos/simulation/rows.hpp"
#include "runtime/iec/math.h"

#include <algorithm>
#include <iterator>

namespace stride::sercos {
namespace {

using simulation::IdnRow;

/// IDNs of its maker that it is given at start-up, or has in its telegrams.
std::vector<IdnRow> moreRows(const DriveSettings &settings) {
  std::vector<IdnRow> rows;
  const auto add = [&rows](Idn idn, const Attribute &attribute, uint8_t cyclic) {
    const bool own = (idn & kProductBit) != 0;
    const bool known =
        std::any_of(rows.begin(), rows.end(), [idn](const IdnRow &row) { return row.idn == idn; });
    if (own && !known)
      rows.push_back({.idn = idn,
                      .name = "Parameter of the maker",
                      .attribute = attribute,
                      .cyclic = cyclic,
                      .room = attribute.list ? size_t{64} : size_t{0}});
  };
  using namespace simulation::rows;
  for (const CyclicObject &object : settings.cyclic.mdt.objects())
    add(object.idn, of(object.bytes, Display::Signed, kIn234), simulation::kInMdt);
  for (const CyclicObject &object : settings.cyclic.at.objects())
    add(object.idn, of(object.bytes, Display::Signed, kIn234), simulation::kInAt);
  for (const std::vector<IdnValue> &list : settings.lists)
    for (const IdnValue &value : list)
      add(value.idn,
          value.isText ? text(kIn234)
                       : (value.numbers.size() == 1 ? longInteger(kIn234) : idnList(kIn234)),
          0);
  return rows;
}

/// A drive that is what stride.toml expects.
simulation::DriveSetup driveSetup(const bus::DriveSetup &drive, const DriveSettings &settings) {
  const bus::SetupParameters &given = drive.parameters;
  simulation::DriveSetup result;
  result.device.address = static_cast<uint8_t>(drive.id);
  result.drive = dummy::driveParameters(given);
  const double turn = stride::floor(result.drive.period + 0.5);
  result.incrementsPerTurn = turn >= 1 ? turn : kPreferredTurn;
  result.ratedTorque = given.number("torque_rated");
  result.more = moreRows(settings);
  return result;
}

} // namespace

SimulatedNetwork::SimulatedNetwork(const bus::GroupSetup &setup) {
  for (const bus::DriveSetup &drive : setup.drives) {
    const DriveSettings settings = driveSettings(drive.parameters);
    Place &place = places_.emplace_back();
    if (settings.io) {
      simulation::IoSetup io;
      io.device.address = static_cast<uint8_t>(drive.id);
      io.more = moreRows(settings);
      place.io = std::make_unique<simulation::SimulatedIo>(io);
    } else {
      place.drive = std::make_unique<simulation::SimulatedDrive>(driveSetup(drive, settings));
    }
    ring_.attach(place.device());
  }
}

void SimulatedNetwork::bindDrive(size_t drive, void *data) {
  Place &place = places_[drive];
  place.sim = static_cast<DriveSim *>(data);
  if (place.drive != nullptr)
    place.drive->bind(place.sim != nullptr ? &place.sim->base__ : nullptr);
}

void SimulatedNetwork::cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept {
  disturb();
  ring_.cycle(sent, answers);
  countDown();
}

/// What programs have written.
void SimulatedNetwork::disturb() noexcept {
  if (sim_ != nullptr) {
    simulation::RingFaults &faults = ring_.faults();
    faults.open = sim_->bOpenRing != 0;
    faults.openBefore = sim_->uiOpenBefore;
    faults.leastLight = sim_->usiLeastLight;
    faults.loseMsts = sim_->udiLoseMsts;
    faults.distortMsts = sim_->udiDistortMsts;
  }
  for (const Place &place : places_) {
    if (place.sim == nullptr)
      continue;
    const DriveSim &sim = *place.sim;
    simulation::DeviceFaults &faults = place.device().faults();
    faults.off = sim.bOff != 0;
    faults.loseMsts = sim.udiLoseMsts;
    faults.loseMdts = sim.udiLoseMdts;
    faults.loseAts = sim.udiLoseAts;
    faults.distortAts = sim.udiDistortAts;
    faults.busyCycles = sim.udiBusyCycles;
    faults.failPhase4 = sim.bFailPhase4 != 0;
    faults.baudRate = sim.usiBaudRate;
    faults.answersAs = sim.usiAnswersAs;
    faults.refuses = sim.bRefuse != 0;
    faults.refused = sim.wRefusedIDN;
    faults.reason = sim.wRefusal;
  }
}

void SimulatedNetwork::countDown() noexcept {
  if (sim_ != nullptr) {
    sim_->udiLoseMsts = ring_.faults().loseMsts;
    sim_->udiDistortMsts = ring_.faults().distortMsts;
  }
  for (const Place &place : places_) {
    if (place.sim == nullptr)
      continue;
    const simulation::DeviceFaults &faults = place.device().faults();
    place.sim->udiLoseMsts = faults.loseMsts;
    place.sim->udiLoseMdts = faults.loseMdts;
    place.sim->udiLoseAts = faults.loseAts;
    place.sim->udiDistortAts = faults.distortAts;
  }
}

void SimulatedNetwork::lead(RingControl &ring) const {
  if (sim_ == nullptr)
    return;
  const Phase wanted = std::min(static_cast<Phase>(sim_->byHighestPhase), Phase::Four);
  if (wanted != ring.commandedPhase())
    ring.commandPhase(wanted);
  constexpr uint8_t kBrightest = 100;
  if (sim_->usiLight <= kBrightest && sim_->usiLight != ring.opticalPower())
    ring.setOpticalPower(sim_->usiLight);
}

void SimulatedNetwork::publish(const Master &master) const noexcept {
  if (sim_ == nullptr)
    return;
  sim_->byActualPhase = static_cast<uint8_t>(master.actualPhase());
  sim_->byCommandedPhase = static_cast<uint8_t>(master.commandedPhase());
  sim_->uiBaudRate = static_cast<uint16_t>(master.baudRate());
  sim_->usiActualLight = master.opticalPower();
  sim_->udiCycleTime = master.cycleTime();
  sim_->udiMstLost = static_cast<uint32_t>(master.counters().mstLost);
  sim_->udiAtLost = static_cast<uint32_t>(master.counters().atLost);
  sim_->udiRingFalls = static_cast<uint32_t>(master.counters().ringFalls);
  const size_t shown = std::min(master.driveCount(), std::size(sim_->awStatus.v));
  for (size_t i = 0; i < shown; ++i) {
    const Slave &slave = master.drive(i);
    sim_->awAddress.v[i] = slave.config().address;
    sim_->awStatus.v[i] = slave.status().communication ? slave.axis().statusWord() : uint16_t{0};
  }
}

} // namespace stride::sercos
