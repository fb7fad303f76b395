// MC_ReadParameter, MC_ReadBoolParameter, MC_WriteParameter, MC_WriteBoolParameter.
#include "runtime/axis/axis_parameters.hpp"
#include "runtime/axis/parameter_channel.hpp"

#include "st/SM_PLCopen/MC_ReadBoolParameter.h"
#include "st/SM_PLCopen/MC_ReadParameter.h"
#include "st/SM_PLCopen/MC_WriteBoolParameter.h"
#include "st/SM_PLCopen/MC_WriteParameter.h"

namespace {

namespace axis = ::stride::axis;
using axis::AxisRef;

constexpr uint16_t kLongest = 1000; ///< Calls that find the channel occupied.

bool isBool(double /*value*/) noexcept { return false; }
bool isBool(::stride::BOOL /*value*/) noexcept { return true; }
void assign(double &to, double value) noexcept { to = value; }
void assign(::stride::BOOL &to, double value) noexcept { to = value != 0.0; }

/// The parameter of AXIS_REF, if it is of the block's type.
const axis::AxisParameter *parameterOf(int32_t number, bool boolean) noexcept {
  const axis::AxisParameter *parameter = axis::findParameter(number);
  if (parameter == nullptr || (parameter->kind == axis::ParameterKind::Bool) != boolean)
    return nullptr;
  return parameter;
}

/// Whether a number is one of the drive's own, and there is a drive.
bool drives(const AxisRef &ref, int32_t number) noexcept {
  return ref.bRealDrive != 0 && number < 0 && number != INT32_MIN;
}

/// Nobody waits for the drive any more.
template <class Block> void leave(Block &block) noexcept {
  if (block.udiClaim != 0 && block.pAxis != nullptr)
    axis::leaveDrive(*block.pAxis, block.udiClaim);
  block.udiClaim = 0;
  block.uiCycles = 0;
}

template <class Block> void fail(Block &block, int16_t errorId) noexcept {
  block.Done = 0;
  block.Busy = 0;
  block.Error = 1;
  block.ErrorID = errorId;
  if (block.Axis != nullptr)
    axis::noteError(*block.Axis, errorId);
}

/// Asks for the way to the drive. False: it has been occupied for too long.
template <class Block>
bool ask(Block &block, axis::ChannelKind kind, bool boolean, double value) noexcept {
  block.udiClaim =
      axis::askDrive(*block.Axis, kind, -block.diNumber,
                     boolean ? axis::ChannelForm::Bool : axis::ChannelForm::Number, value);
  if (block.udiClaim == 0)
    return block.uiCycles++ < kLongest;
  block.uiCycles = 0;
  return true;
}

// ---- reading

template <class Block> void clearRead(Block &block) noexcept {
  leave(block);
  block.Done = 0;
  block.Valid = 0;
  block.Busy = 0;
  block.Error = 0;
  block.ErrorID = axis::error::kNone;
}

template <class Block> void failRead(Block &block, int16_t errorId) noexcept {
  leave(block);
  block.Valid = 0;
  fail(block, errorId);
}

template <class Block> void readDrive(Block &block) noexcept {
  if (block.udiClaim == 0) {
    if (!ask(block, axis::ChannelKind::Read, isBool(block.Value), 0.0))
      failRead(block, axis::error::kReadTransfer);
    return;
  }
  const axis::Asked asked = axis::pollDrive(*block.Axis, block.udiClaim);
  if (asked == axis::Asked::Waiting)
    return;
  if (asked == axis::Asked::Lost) {
    failRead(block, axis::error::kReadTransfer);
    return;
  }
  switch (static_cast<axis::ChannelResult>(block.Axis->stChannel.byResult)) {
  case axis::ChannelResult::Done:
    assign(block.Value, block.Axis->stChannel.fValue);
    block.Done = 1;
    block.Valid = 1;
    leave(block); // others may ask before this block does again
    return;
  case axis::ChannelResult::Unknown:
    failRead(block, axis::error::kReadUnknown);
    return;
  default:
    failRead(block, axis::error::kReadTransfer);
    return;
  }
}

template <class Block> void read(Block &block) noexcept {
  if (block.Enable == 0) {
    clearRead(block);
    return;
  }
  if (block.Axis == nullptr) {
    clearRead(block);
    fail(block, axis::error::kNoAxis);
    return;
  }
  AxisRef &ref = *block.Axis;
  if (block.pAxis != &ref || block.diNumber != block.ParameterNumber ||
      block.ErrorID == axis::error::kNoAxis) {
    clearRead(block);
    block.pAxis = &ref;
    block.diNumber = block.ParameterNumber;
  }
  if (block.Error != 0)
    return;
  block.Busy = 1;
  if (drives(ref, block.diNumber)) {
    readDrive(block);
    return;
  }
  const axis::AxisParameter *parameter = parameterOf(block.diNumber, isBool(block.Value));
  if (parameter == nullptr) {
    failRead(block, axis::error::kReadUnknown);
    return;
  }
  assign(block.Value, axis::readParameter(ref, *parameter));
  block.Done = 1;
  block.Valid = 1;
}

// ---- writing

template <class Block> void failWrite(Block &block, int16_t errorId) noexcept {
  leave(block);
  fail(block, errorId);
}

template <class Block> void writeDrive(Block &block) noexcept {
  if (block.udiClaim == 0) {
    if (!ask(block, axis::ChannelKind::Write, isBool(block.Value), block.fValue))
      failWrite(block, axis::error::kWriteTransfer);
    return;
  }
  const axis::Asked asked = axis::pollDrive(*block.Axis, block.udiClaim);
  if (asked == axis::Asked::Waiting)
    return;
  if (asked == axis::Asked::Lost) {
    failWrite(block, axis::error::kWriteTransfer);
    return;
  }
  switch (static_cast<axis::ChannelResult>(block.Axis->stChannel.byResult)) {
  case axis::ChannelResult::Done:
    leave(block);
    block.Done = 1;
    block.Busy = 0;
    return;
  case axis::ChannelResult::Unknown:
  case axis::ChannelResult::ReadOnly:
    failWrite(block, axis::error::kWriteInvalid);
    return;
  default:
    failWrite(block, axis::error::kWriteTransfer);
    return;
  }
}

template <class Block> void startWrite(Block &block) noexcept {
  leave(block);
  block.Done = 0;
  block.Error = 0;
  block.ErrorID = axis::error::kNone;
  block.Busy = 0;
  if (block.Axis == nullptr) {
    fail(block, axis::error::kNoAxis);
    return;
  }
  AxisRef &ref = *block.Axis;
  block.pAxis = &ref;
  block.diNumber = block.ParameterNumber;
  block.fValue = block.Value;
  if (drives(ref, block.diNumber)) {
    block.Busy = 1;
    writeDrive(block);
    return;
  }
  const axis::AxisParameter *parameter = parameterOf(block.diNumber, isBool(block.Value));
  if (parameter == nullptr || !axis::writeParameter(ref, *parameter, block.fValue))
    fail(block, axis::error::kWriteInvalid);
  else
    block.Done = 1;
}

template <class Block> void write(Block &block) noexcept {
  const bool rising = block.Execute != 0 && block.bExecuteOld == 0;
  block.bExecuteOld = block.Execute;
  if (rising) {
    startWrite(block);
  } else if (block.Busy != 0) {
    if (block.Axis != block.pAxis)
      failWrite(block, axis::error::kAxisChanged);
    else
      writeDrive(block);
  } else if (block.Execute == 0) {
    block.Done = 0;
    block.Error = 0;
    block.ErrorID = axis::error::kNone;
  }
}

} // namespace

namespace st::SM_PLCopen {

void MC_ReadParameter::body__(::stride::Ctx & /*ctx__*/) { read(*this); }
void MC_ReadBoolParameter::body__(::stride::Ctx & /*ctx__*/) { read(*this); }
void MC_WriteParameter::body__(::stride::Ctx & /*ctx__*/) { write(*this); }
void MC_WriteBoolParameter::body__(::stride::Ctx & /*ctx__*/) { write(*this); }

} // namespace st::SM_PLCopen
