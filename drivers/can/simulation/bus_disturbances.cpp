// What tests and programs do to a simulated bus.
#include "drivers/can/simulation/simulated_bus.hpp"
#include "drivers/can/simulation/simulated_port.hpp"
#include "drivers/can/simulation/wire.hpp"

namespace stride::can::simulation {

void SimulatedBus::setPiece(Station station, uint8_t piece) {
  Member &member = members_[station];
  if (piece >= wires_.size())
    wires_.resize(piece + 1U);
  Wire &old = wires_[member.piece];
  if (member.sending && old.endNs != kNever)
    old.outcome = Outcome::Disturbed; // the others see half a frame
  member.sending = false;
  member.piece = piece;
}

void SimulatedBus::setPower(Station station, bool on) {
  Member &member = members_[station];
  if (member.powered == on)
    return;
  if (member.sending && wires_[member.piece].endNs != kNever)
    wires_[member.piece].outcome = Outcome::Disturbed;
  member.powered = on;
  member.full = false;
  member.sending = false;
  member.recoverNs = kNever;
  member.controller.restart();
  if (member.port != nullptr)
    member.port->forget();
  else if (on)
    member.node->powerOn(now_);
  served(station);
}

void SimulatedBus::forceBusOff(Station station) {
  Member &member = members_[station];
  if (member.sending && wires_[member.piece].endNs != kNever)
    wires_[member.piece].outcome = Outcome::Disturbed;
  member.controller.switchOff();
  note(member);
}

void SimulatedBus::restart(Station station) {
  if (members_[station].controller.off())
    members_[station].recoverNs = now_ + bitsNs(kRecoveryBits);
}

} // namespace stride::can::simulation
