// PDOs that a node does not let be changed, at its start-up.
#include "drivers/can/master/start_up.hpp"
#include "drivers/can/master/texts.hpp"

namespace stride::can {
namespace {

/// A parameter of a PDO, communication or mapping.
bool isOfPdo(Object object) {
  return object.index >= object::kRpdoCommunication && object.index < object::kTpdoMapping + 0x200;
}

/// Only makes a PDO ready to be changed: it is switched off, or has no objects for a while.
bool preparesPdo(const SdoWrite &write) {
  const bool mapping = (write.object.index & 0x200U) != 0; // 1600h …, 1A00h …
  if (mapping)
    return write.object.sub == 0 && write.value == 0;
  return write.object.sub == 1 && (write.value & kPdoInvalid) != 0 && !write.optional;
}

} // namespace

/// It refuses to change it.
bool StartUp::isFixedPdo(const SdoClient &sdo) const {
  const uint32_t code = sdo.abortCode();
  const bool isFixed = code == abort_code::kReadOnly || code == abort_code::kUnsupported;
  return now().op == StartOp::Write && isOfPdo(now().object.object) && isFixed && !compares_ &&
         !sdo.timedOut();
}

/// A device may have PDOs that cannot be changed: they will do if they are what is wanted.
StartUp::Outcome StartUp::fixedPdo(const SdoWrite &write) {
  if (preparesPdo(write))
    return Outcome::Next;
  compares_ = true;
  asked_ = false;
  return Outcome::Busy;
}

StartUp::Outcome StartUp::compared(uint32_t value, const StartParts &parts,
                                   bus::Message &message) const {
  const SdoWrite &write = now().object;
  const uint32_t wanted = valueOf(write, parts.facts);
  if (value == wanted)
    return Outcome::Next;
  message.set("node ", uint32_t{node_}, ", ", ObjectText(write.object), " is fixed: it is ",
              HexText(value), ", and would have to be ", HexText(wanted));
  return Outcome::Failed;
}

} // namespace stride::can
