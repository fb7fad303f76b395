// Blocks that set, read or watch what belongs to an axis.
#include "tests/unit/motion/actor_factories.hpp"

#include "st/SM_DriveBasic/SMC_ChangeDynamicLimits.h"
#include "st/SM_DriveBasic/SMC_CheckAxisCommunication.h"
#include "st/SM_DriveBasic/SMC_CheckLimits.h"
#include "st/SM_DriveBasic/SMC_InPosition.h"
#include "st/SM_DriveBasic/SMC_MeasureDistance.h"
#include "st/SM_DriveBasic/SMC_SetControllerMode.h"
#include "st/SM_DriveBasic/SMC_SetMovementType.h"
#include "st/SM_DriveBasic/SMC_SetSoftwareLimits.h"
#include "st/SM_DriveBasic/TRIGGER_REF.h"
#include "st/SM_PLCopen/MC_AbortTrigger.h"
#include "st/SM_PLCopen/MC_Halt.h"
#include "st/SM_PLCopen/MC_HaltSuperImposed.h"
#include "st/SM_PLCopen/MC_ReadActualPosition.h"
#include "st/SM_PLCopen/MC_ReadActualTorque.h"
#include "st/SM_PLCopen/MC_ReadActualVelocity.h"
#include "st/SM_PLCopen/MC_ReadAxisError.h"
#include "st/SM_PLCopen/MC_ReadBoolParameter.h"
#include "st/SM_PLCopen/MC_ReadParameter.h"
#include "st/SM_PLCopen/MC_ReadStatus.h"
#include "st/SM_PLCopen/MC_Reset.h"
#include "st/SM_PLCopen/MC_SetOverride.h"
#include "st/SM_PLCopen/MC_SetPosition.h"
#include "st/SM_PLCopen/MC_TouchProbe.h"
#include "st/SM_PLCopen/MC_WriteBoolParameter.h"
#include "st/SM_PLCopen/MC_WriteParameter.h"
#include "st/SM_PLCopen/SMC_ReadSetPosition.h"
#include "st/SM_PLCopen/SMC_SetTorque.h"

namespace stride::test {
namespace {

namespace basic = ::st::SM_DriveBasic;
namespace pl = ::st::SM_PLCopen;

Actor powerOff(AxisRig &rig) {
  Actor a;
  a.call = [&rig](bool execute) {
    rig.power.bRegulatorOn = execute ? 0 : 1;
    rig.power.body__(rig.ctx);
  };
  a.show = [&rig] { return showBlock(rig.power); };
  return a;
}

} // namespace

const std::map<std::string, Factory> &administrativeActors() {
  const auto velocity = [](auto &b, AxisRig &) { b.ParameterNumber = 1113; };
  const auto limits = [](auto &b, AxisRig &) { b.ParameterNumber = 1205; };
  const auto trigger = [](auto &b, basic::TRIGGER_REF &input) {
    input.iTriggerNumber = 0;
    b.TriggerInput = &input;
  };
  static const std::map<std::string, Factory> table{
      {"MC_Power off", powerOff},
      {"MC_Reset", plain<pl::MC_Reset>()},
      {"MC_SetPosition", plain<pl::MC_SetPosition>([](auto &b, AxisRig &) {
         b.Mode = 1;
         b.Position = 3;
       })},
      {"MC_SetOverride", plain<pl::MC_SetOverride>()},
      {"SMC_SetControllerMode", plain<basic::SMC_SetControllerMode>()},
      {"SMC_SetTorque", plain<pl::SMC_SetTorque>()},
      {"MC_TouchProbe", with<pl::MC_TouchProbe, basic::TRIGGER_REF>(trigger)},
      {"MC_AbortTrigger", with<pl::MC_AbortTrigger, basic::TRIGGER_REF>(trigger)},
      {"MC_ReadStatus", plain<pl::MC_ReadStatus>()},
      {"MC_ReadAxisError", plain<pl::MC_ReadAxisError>()},
      {"MC_ReadParameter", plain<pl::MC_ReadParameter>(velocity)},
      {"MC_ReadBoolParameter", plain<pl::MC_ReadBoolParameter>(limits)},
      {"MC_WriteParameter", plain<pl::MC_WriteParameter>([](auto &b, AxisRig &) {
         b.ParameterNumber = 1113;
         b.Value = 100;
       })},
      {"MC_WriteBoolParameter", plain<pl::MC_WriteBoolParameter>(limits)},
      {"MC_ReadActualPosition", plain<pl::MC_ReadActualPosition>()},
      {"MC_ReadActualVelocity", plain<pl::MC_ReadActualVelocity>()},
      {"MC_ReadActualTorque", plain<pl::MC_ReadActualTorque>()},
      {"SMC_ReadSetPosition", plain<pl::SMC_ReadSetPosition>()},
      {"SMC_CheckLimits", plain<basic::SMC_CheckLimits>()},
      {"SMC_MeasureDistance", plain<basic::SMC_MeasureDistance>()},
      {"MC_HaltSuperImposed", moving<pl::MC_HaltSuperImposed>()},
      {"SMC_SetSoftwareLimits", plain<basic::SMC_SetSoftwareLimits>()},
      {"SMC_ChangeDynamicLimits", plain<basic::SMC_ChangeDynamicLimits>([](auto &b, AxisRig &) {
         b.fMaxVelocity = b.fMaxAcceleration = b.fMaxDeceleration = b.fMaxJerk = 100;
       })},
      {"SMC_SetMovementType", plain<basic::SMC_SetMovementType>()},
      {"SMC_InPosition", plain<basic::SMC_InPosition>()},
      {"SMC_CheckAxisCommunication", plain<basic::SMC_CheckAxisCommunication>()},
  };
  return table;
}

} // namespace stride::test
