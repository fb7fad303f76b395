#include "drivers/sercos/simulation/simulated_ring.hpp"

#include "drivers/sercos/protocol/timing.hpp"

#include <algorithm>

namespace stride::sercos::simulation {
namespace {

bool understands(Device &device, uint8_t baudRate) {
  const uint8_t own = device.faults().baudRate;
  return own == 0 || own == baudRate;
}

} // namespace

void SimulatedRing::attach(Device &device) {
  if (devices_.size() == kMostDrives)
    return;
  devices_.push_back(&device);
  spans_.resize(devices_.size());
}

/// The first device that no light comes to; as many as there are devices: all have it, but the
/// master only if that is one more.
size_t SimulatedRing::firstDark() const noexcept {
  if (light_ < std::max<uint8_t>(faults_.leastLight, 1))
    return 0;
  size_t first = faults_.open ? std::min(faults_.openBefore, devices_.size()) : devices_.size() + 1;
  for (size_t i = 0; i < devices_.size() && i < first; ++i)
    if (devices_[i]->faults().off)
      first = i; // after it nobody has light
  return first;
}

void SimulatedRing::sendMst(const MasterTelegrams &sent, size_t lit, bool lost,
                            bool distorted) noexcept {
  for (size_t i = 0; i < devices_.size(); ++i) {
    Device &device = *devices_[i];
    device.beginCycle(sent.periodNs, baudRate_);
    const bool hears = sent.mst && i < lit && !lost && !distorted && !device.faults().off &&
                       understands(device, baudRate_);
    if (hears)
      device.receiveMst(static_cast<uint8_t>(sent.phase));
    else
      device.missMst();
  }
}

void SimulatedRing::collectAts(const MasterTelegrams &sent, size_t lit,
                               RingAnswers &answers) noexcept {
  const bool closed = lit > devices_.size();
  const bool cyclic = sent.phase == Phase::Three || sent.phase == Phase::Four;
  for (size_t i = 0; i < devices_.size(); ++i) {
    Device &device = *devices_[i];
    if (answers.count == answers.telegrams.size() || device.faults().off ||
        !understands(device, baudRate_))
      continue;
    DriveTelegram &telegram = answers.telegrams[answers.count];
    telegram.distorted = false;
    // Where the ring is open the light of what is before that place does not come back.
    if (!device.transmit(telegram) || !closed)
      continue;
    Span &span = spans_[answers.count++];
    span.from = device.list().value(idns::kAtStart);
    span.to = span.from + telegramUs(telegram.length, baudRate_);
    const bool timed = device.phase() == Phase::Three || device.phase() == Phase::Four;
    if (!cyclic || !timed)
      continue;
    for (size_t k = 0; k + 1 < answers.count; ++k)
      if (span.from < spans_[k].to && spans_[k].from < span.to)
        telegram.distorted = answers.telegrams[k].distorted = true;
  }
}

void SimulatedRing::sendMdt(const MasterTelegrams &sent, size_t lit) noexcept {
  const size_t length = std::min<size_t>(sent.mdtLength, sent.mdtData.size());
  for (size_t i = 0; i < devices_.size(); ++i) {
    Device &device = *devices_[i];
    const bool hears =
        sent.mdt && i < lit && !device.faults().off && understands(device, baudRate_);
    if (hears)
      device.receiveMdt(sent.mdtAddress, {sent.mdtData.data(), length});
    else
      device.missMdt();
  }
}

void SimulatedRing::cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept {
  const size_t lit = firstDark();
  const bool lost = sent.mst && occurs(faults_.loseMsts);
  const bool distorted = sent.mst && !lost && occurs(faults_.distortMsts);
  answers.count = 0;
  answers.light = lit > devices_.size();
  answers.mstReturned = answers.light && sent.mst && !lost && !distorted;
  answers.mstDistorted = answers.light && distorted;
  sendMdt(sent, lit);
  sendMst(sent, lit, lost, distorted);
  collectAts(sent, lit, answers);
}

} // namespace stride::sercos::simulation
