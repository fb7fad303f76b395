#include "runtime/numeric/csy/register_map.hpp"

namespace stride::csy {

namespace {

using enum RegisterArea;
using enum RegisterType;

/// Of axes and groups.
constexpr uint8_t kFull = kRing | kInd | kFollow | kCoord;
/// What takes commands.
constexpr uint8_t kAny = kFull | kCmd;
constexpr uint8_t kExchanged = kFull | kCam;
constexpr uint8_t kCommanded = kAny | kCam;
constexpr uint8_t kTransferred = kRing | kTrf | kInd | kFollow | kCam;

} // namespace

const RegisterRow kRegisters[] = {
    {"CH_ERROR", Input, Bool, kNoWord, kErrorBit, kCommanded, false, "the channel has a fault"},
    {"MOD_ERROR", Input, Bool, kNoWord, kErrorBit, kModule, false, "the module has a fault"},
    {"RAMPING", Input, Bool, kNoWord, 0, kFull, false, "accelerating or decelerating"},
    {"STEADY", Input, Bool, kNoWord, 1, kFull, false, "at a constant speed"},
    {"STOPPING", Input, Bool, kNoWord, 2, kFull, false, "decelerating to rest"},
    {"PROFILE_END", Input, Bool, kNoWord, 3, kAny, false,
     "the last command has been sent to the module"},
    {"IN_POSITION", Input, Bool, kNoWord, 4, kAny, false,
     "the position is within the in-position window"},
    {"AXIS_HOMING", Input, Bool, kNoWord, 5, kFull, false, "homing is in progress"},
    {"AXIS_HOMED", Input, Bool, kNoWord, 6, kAny, false, "the position is referenced"},
    {"AXIS_NOT_FOLLOWING", Input, Bool, kNoWord, 7, kFull, false,
     "the drive does not take commands of the module"},
    {"HOLDING", Input, Bool, kNoWord, 8, kAny, false, "at rest in hold"},
    {"RESUMING", Input, Bool, kNoWord, 9, kAny, false, "moving again after hold"},
    {"DRIVE_ENABLED", Input, Bool, kNoWord, 10, kAny, false, "the drive is enabled"},
    {"DRIVE_DIAG", Input, Bool, kNoWord, 11, kFull, false, "the drive has a diagnostic of class 3"},
    {"DRIVE_WARNING", Input, Bool, kNoWord, 12, kFull, false,
     "the drive has a diagnostic of class 2"},
    {"DRIVE_FLT", Input, Bool, kNoWord, 13, kAny, false, "the drive has a diagnostic of class 1"},
    {"DRIVE_DISABLED", Input, Bool, kNoWord, 14, kFull, false, "the drive is disabled"},
    {"AXIS_SUMMARY_FLT", Input, Bool, kNoWord, 15, kAny, false, "any fault of the drive"},
    {"AXIS_COM_OK", Input, Bool, kNoWord, 16, kFull, false, "module and drive are in touch"},
    {"AXIS_IS_LINKED", Input, Bool, kNoWord, 17, kFull, false, "the axis belongs to a set of axes"},
    {"AXIS_IN_CMD", Input, Bool, kNoWord, 18, kAny, false, "active: it can be commanded"},
    {"AXIS_AT_TARGET", Input, Bool, kNoWord, 20, kFull, false,
     "within the window around the target"},
    {"AXIS_POS_LIMIT", Input, Bool, kNoWord, 21, kFull, false, "the positive limit is reached"},
    {"AXIS_NEG_LIMIT", Input, Bool, kNoWord, 22, kFull, false, "the negative limit is reached"},
    {"AXIS_WARNING", Input, Bool, kNoWord, 23, kFull, false, "the drive warns of the motion"},
    {"BIAS_REMAIN", Input, Bool, kNoWord, 24, kInd, false,
     "an offset is added to the commanded position"},
    {"AXIS_MANUAL_MODE", Input, Bool, kNoWord, 25, kInd, false, "manual mode"},
    {"DRIVE_REALTIME_BIT1", Input, Bool, kNoWord, 26, kInd, false,
     "real-time status bit 1 of the drive"},
    {"DRIVE_REALTIME_BIT2", Input, Bool, kNoWord, 27, kInd, false,
     "real-time status bit 2 of the drive"},
    {"AXIS_HOLD", Input, Bool, kNoWord, 28, kAny, false, "at rest, waiting for a command"},
    {"AXIS_HALT", Input, Bool, kNoWord, 29, kAny, false, "halted"},
    {"AXIS_FASTSTOP", Input, Bool, kNoWord, 30, kAny, false, "stopped fast"},
    {"AXIS_READY", Input, Bool, kNoWord, 31, kAny, false, "ready for commands"},
    {"CONF_OK", Input, Bool, kNoWord, 32, kFull, false, "the channel is configured"},
    {"LSUB_STATUS_IN_USE", Input, Bool, kNoWord, 33, kRing, false, "a special application runs"},
    {"LSUB_STATUS_DATA_READY", Input, Bool, kNoWord, 34, kRing, false,
     "data of the special application are ready"},
    {"CONTROL_ACQUIRE", Output, Bool, kNoWord, 2, kAny, true, "acquire the channel (rising edge)"},
    {"CONTROL_JOG_POS", Output, Bool, kNoWord, 4, kInd, true, "manual mode: jog forwards"},
    {"CONTROL_JOG_NEG", Output, Bool, kNoWord, 5, kInd, true, "manual mode: jog backwards"},
    {"REAL_TIME_CTRL_BIT1", Output, Bool, kNoWord, 6, kInd, true,
     "real-time control bit 1 of the drive"},
    {"REAL_TIME_CTRL_BIT2", Output, Bool, kNoWord, 7, kInd, true,
     "real-time control bit 2 of the drive"},
    {"OPERATION_MODE_1", Output, Bool, kNoWord, 8, kInd, true, "operating mode, bit 1"},
    {"OPERATION_MODE_2", Output, Bool, kNoWord, 9, kInd, true, "operating mode, bit 2"},
    {"CONTROL_ENABLE", Output, Bool, kNoWord, 10, kAny, true, "enable (rising edge)"},
    {"CONTROL_FOLLOW", Output, Bool, kNoWord, 11, kFull, true, "start following (rising edge)"},
    {"CONTROL_RESUME", Output, Bool, kNoWord, 12, kAny, true, "resume after a stop (rising edge)"},
    {"CONTROL_INC_POS", Output, Bool, kNoWord, 13, kInd, true,
     "manual mode: an increment forwards"},
    {"CONTROL_INC_NEG", Output, Bool, kNoWord, 14, kInd, true,
     "manual mode: an increment backwards"},
    {"CONTROL_CLEAR_FLT", Output, Bool, kNoWord, 15, kAny, true, "clear faults (rising edge)"},
    {"ALLOW_ACQUIRE", Output, Bool, kNoWord, 18, kAny, true, "the channel may be acquired"},
    {"ALLOW_ENABLE", Output, Bool, kNoWord, 26, kAny, true,
     "the channel may be enabled; 0 disables it"},
    {"ALLOW_FOLLOW", Output, Bool, kNoWord, 27, kFull, true, "it may follow; 0 ends following"},
    {"ALLOW_RESUME", Output, Bool, kNoWord, 28, kAny, true, "it may go on; 0 holds it"},
    {"ALLOW_MOVE", Output, Bool, kNoWord, 29, kAny, true, "it may move; 0 halts it"},
    {"ALLOW_NOT_FASTSTOP", Output, Bool, kNoWord, 30, kFull, true, "0 stops it fast"},
    {"ALLOW_NOT_FLT", Output, Bool, kNoWord, 31, kFull, true, "0 is a fault"},
    {"POSITION", Input, Real, 0, 0, kInd | kFollow, false, "present position"},
    {"PARAM_RPT", Input, Int, 2, 0, kFull, false,
     "report of parameters: error in the low byte, address in the high one"},
    {"REMOTE_POSITION", Output, Dint, 0, 0, kInd, true,
     "increment of manual mode; simulated position of a remote axis"},
    {"EXCH_STS", Memory, Int, 0, 0, kCommanded | kTrf | kModule, false,
     "explicit exchanges in progress"},
    {"STS_IN_PROGR", Memory, Bool, 0, 0, kExchanged | kModule, false, "the status is being read"},
    {"CMD_IN_PROGR", Memory, Bool, 0, 1, kCommanded, false, "a command is being sent"},
    {"ADJ_IN_PROGR", Memory, Bool, 0, 2, kExchanged, false, "parameters are being exchanged"},
    {"TRF_IN_PROGR", Memory, Bool, 0, 3, kExchanged | kTrf, false, "a transfer is in progress"},
    {"RECONF_IN_PROGR", Memory, Bool, 0, 15, kExchanged, false,
     "the channel is being configured again"},
    {"EXCH_RPT", Memory, Int, 1, 0, kCommanded | kTrf | kModule, false,
     "reports of explicit exchanges"},
    {"STS_ERR", Memory, Bool, 1, 0, kExchanged | kModule, false, "reading the status has failed"},
    {"CMD_ERR", Memory, Bool, 1, 1, kCommanded, false, "sending a command has failed"},
    {"ADJ_ERR", Memory, Bool, 1, 2, kExchanged, false, "exchanging parameters has failed"},
    {"TRF_ERR", Memory, Bool, 1, 3, kExchanged | kTrf, false, "a transfer has failed"},
    {"RECONF_ERR", Memory, Bool, 1, 15, kExchanged, false, "configuring again has failed"},
    {"CH_FLT", Memory, Int, 2, 0, kExchanged, false, "faults of the channel, by READ_STS"},
    {"MOD_FLT", Memory, Int, 2, 0, kModule, false, "faults of the module, by READ_STS"},
    {"EXT_FLT0", Memory, Bool, 2, 0, kExchanged, false, "fault of the drive"},
    {"EXT_FLT1", Memory, Bool, 2, 1, kExchanged, false, "the axis is out of touch"},
    {"EXT_FLT2", Memory, Bool, 2, 3, kExchanged, false, "external fault 2"},
    {"INT_FLT", Memory, Bool, 2, 4, kExchanged, false, "internal fault"},
    {"CONF_FLT", Memory, Bool, 2, 5, kExchanged | kModule, false,
     "hardware and configuration differ"},
    {"COM_FLT", Memory, Bool, 2, 6, kExchanged, false, "communication fault"},
    {"APPLI_FLT", Memory, Bool, 2, 7, kExchanged, false,
     "fault of configuration, parameters or command"},
    {"FAN_STOPPED", Memory, Bool, 2, 8, kRing, false, "the fan stands still"},
    {"OVER_TEMP", Memory, Bool, 2, 9, kRing, false, "too hot"},
    {"SENSOR_FLT", Memory, Bool, 2, 10, kRing, false, "fault of the temperature sensor"},
    {"PROCESS_CONF", Memory, Bool, 2, 11, kExchanged, false, "the object is being made"},
    {"PROCESS_CONF_FAILED", Memory, Bool, 2, 12, kInd | kFollow | kCoord | kCam, false,
     "the object could not be made"},
    {"MOD_FAIL", Memory, Bool, 2, 0, kModule, false, "the module does not work"},
    {"CH_FLT", Memory, Bool, 2, 1, kModule, false, "a channel has a fault"},
    {"BLK", Memory, Bool, 2, 2, kModule, false, "fault of the terminal block"},
    {"NO_MOD", Memory, Bool, 2, 6, kModule, false, "the module is absent"},
    {"EXT_MOD_FLT", Memory, Bool, 2, 7, kModule, false, "fault of the remote module"},
    {"MOD_FAIL_EXT", Memory, Bool, 2, 8, kModule, false, "the remote module does not work"},
    {"CH_FLT_EXT", Memory, Bool, 2, 9, kModule, false,
     "a channel of the remote module has a fault"},
    {"BLK_EXT", Memory, Bool, 2, 10, kModule, false, "fault of the remote terminal block"},
    {"CONF_FLT_EXT", Memory, Bool, 2, 13, kModule, false,
     "remote hardware and configuration differ"},
    {"NO_MOD_EXT", Memory, Bool, 2, 14, kModule, false, "the remote module is absent"},
    {"ERROR_TRF", Memory, Int, 3, 0, kTransferred, false, "error of the last transfer"},
    {"RETURN_TRF_1", Memory, Dint, 4, 0, kTransferred, false,
     "first value that a transfer returns"},
    {"RETURN_TRF_2", Memory, Real, 6, 0, kTransferred, false,
     "second value that a transfer returns"},
    {"RETURN_TRF_3", Memory, Real, 8, 0, kTransferred, false,
     "third value that a transfer returns"},
    {"ACTION_TRF", Memory, Int, 10, 0, kTransferred, true, "action of the next transfer"},
    {"PARAM_TRF_1", Memory, Dint, 11, 0, kTransferred, true, "its first parameter"},
    {"PARAM_TRF_2", Memory, Dint, 13, 0, kTransferred, true, "its second parameter"},
    {"PARAM_TRF_3", Memory, Real, 15, 0, kTransferred, true, "its third parameter"},
    {"PARAM_TRF_4", Memory, Real, 17, 0, kTransferred, true, "its fourth parameter"},
    {"ERROR_CMD", Memory, Int, 19, 0, kCommanded, true, "error of the last command"},
    {"RETURN_CMD_1", Memory, Dint, 20, 0, kCommanded, true, "first value that a command returns"},
    {"RETURN_CMD_2", Memory, Real, 22, 0, kCommanded, true, "second value that a command returns"},
    {"RETURN_CMD_3", Memory, Real, 24, 0, kCommanded, true, "third value that a command returns"},
    {"ACTION_CMD", Memory, Int, 26, 0, kCommanded, true, "action of the next command"},
    {"PARAM_CMD_1", Memory, Dint, 27, 0, kCommanded, true, "its first parameter"},
    {"PARAM_CMD_2", Memory, Dint, 29, 0, kCommanded, true, "its second parameter"},
    {"PARAM_CMD_3", Memory, Real, 31, 0, kCommanded, true, "its third parameter"},
    {"PARAM_CMD_4", Memory, Real, 33, 0, kCommanded, true, "its fourth parameter"},
    {"PARAM_CMD", Memory, Real, 35, 0, kCoord, true, "its further parameters", 5, 14, 2},
    {"AXIS_MEMBER", Memory, Int, 63, 0, kCoord, true, "channel of a member", 1, 8, 1},
    {"CYCLE_TIME", Memory, Int, 35, 0, kRing, true, "cycle time of the ring"},
    {"BAUD_RATE", Memory, Int, 36, 0, kRing, true, "bit rate of the ring"},
    {"OPTICAL_POWER", Memory, Int, 37, 0, kRing, true, "optical power of the ring"},
    {"FUNCTION_VALIDATION", Memory, Int, 35, 0, kInd, true, "functions that are enabled, by bits"},
    {"ACCEL", Memory, Real, 36, 0, kInd, true, "acceleration of moves"},
    {"DECEL", Memory, Real, 38, 0, kInd, true, "deceleration of moves"},
    {"ACCEL_TYPE", Memory, Int, 40, 0, kInd, true, "shape of ramps: 100, 125, 150, 175 or 200 %"},
    {"IN_POSITION_BAND", Memory, Real, 41, 0, kInd, true, "in-position window"},
    {"ENABLE_POSITION_BAND", Memory, Real, 43, 0, kInd, true,
     "window of the position check when enabling"},
    {"ROLLOVER_MAX", Memory, Real, 45, 0, kInd, true, "upper end of the modulo"},
    {"ROLLOVER_MIN", Memory, Real, 47, 0, kInd, true, "lower end of the modulo"},
    {"ACCEL_MAX", Memory, Real, 49, 0, kInd, true, "greatest acceleration"},
    {"DECEL_MAX", Memory, Real, 51, 0, kInd, true, "greatest deceleration"},
    {"SPEED_MAX", Memory, Real, 53, 0, kInd, true, "greatest speed; 0: not checked"},
    {"POSITION_MAX", Memory, Real, 55, 0, kInd, true, "upper software limit"},
    {"POSITION_MIN", Memory, Real, 57, 0, kInd, true, "lower software limit"},
    {"SCALE_NUMERATOR", Memory, Real, 59, 0, kInd, true, "numerator of the scale"},
    {"SCALE_DENOMINATOR", Memory, Real, 61, 0, kInd, true, "denominator of the scale"},
    {"ACCEL_UNIT", Memory, Int, 63, 0, kInd, true, "unit of accelerations"},
    {"SPEED_UNIT", Memory, Int, 64, 0, kInd, true, "unit of speeds"},
    {"POSITION_UNIT", Memory, Int, 65, 0, kInd, true, "unit of positions"},
    {"MASTER_CHANNEL", Memory, Int, 35, 0, kFollow, true, "channel of the master"},
    {"SLAVE_CHANNEL", Memory, Int, 36, 0, kFollow, true, "channel of a slave", 1, 6, 8},
    {"FOLL_DESCRIPTION", Memory, Int, 37, 0, kFollow, true, "how it follows, by bits", 1, 6, 8},
    {"FOLL_WHERE", Memory, Bool, 37, 0, kFollow, false, "0: by the module", 1, 6, 8},
    {"FOLL_TYPE", Memory, Bool, 37, 1, kFollow, false, "0: by a ratio, 1: by a cam", 1, 6, 8},
    {"FOLL_POSITION", Memory, Bool, 37, 2, kFollow, false,
     "0: the measured position of the master, 1: its setpoint", 1, 6, 8},
    {"FOLL_FOL_ON_HALT", Memory, Bool, 37, 3, kFollow, false,
     "1: the slave halts when the link changes", 1, 6, 8},
    {"FOLL_HALT_MASTER", Memory, Bool, 37, 6, kFollow, false,
     "1: its following error halts the master", 1, 6, 8},
    {"FOLL_BIAS_REMAIN", Memory, Bool, 37, 7, kFollow, false,
     "1: a dynamic offset is added to the master", 1, 6, 8},
    {"NUMERATOR", Memory, Real, 38, 0, kFollow, true, "numerator of the ratio", 1, 6, 8},
    {"DENOMINATOR", Memory, Real, 40, 0, kFollow, true, "denominator of the ratio", 1, 6, 8},
    {"TRIGGER_POSITION", Memory, Real, 42, 0, kFollow, true, "threshold where following starts", 1,
     6, 8},
    {"EXCH_ADJ", Memory, Int, kOwnWord, 0, kCommanded | kTrf | kModule, false,
     "which exchange of parameters: 1 read, 2 write, 3 save, 4 restore"},
    {"EXCH_LENGTH", Memory, Dint, kOwnWord + 1, 0, kCommanded | kTrf | kModule, false,
     "words of the table of a transfer"},
    {"EXCH_TABLE", Memory, Dint, kOwnWord + 3, 0, kCommanded | kTrf | kModule, false,
     "number of its first word, %MW"},
    {"ACTUAL_PHASE", Memory, Int, kOwnWord + 5, 0, kRing, false, "phase of the ring"},
    {"COMMANDED_PHASE", Memory, Int, kOwnWord + 6, 0, kRing, false,
     "phase that the ring shall come to"},
};

const size_t kRegisterRows = sizeof kRegisters / sizeof kRegisters[0];

namespace {

/// `name_12`
void name(const RegisterRow &row, uint8_t number, char (&symbol)[32]) noexcept {
  size_t at = 0;
  for (; row.symbol[at] != '\0' && at < sizeof symbol - 4; ++at)
    symbol[at] = row.symbol[at];
  if (row.repeats > 1) {
    symbol[at++] = '_';
    if (number >= 10)
      symbol[at++] = static_cast<char>('0' + number / 10);
    symbol[at++] = static_cast<char>('0' + number % 10);
  }
  symbol[at] = '\0';
}

struct KindName {
  uint8_t kind;
  const char *name;
};

constexpr KindName kKindNames[] = {
    {kCmd, "T_CSY_CMD"},     {kRing, "T_CSY_RING"},     {kTrf, "T_CSY_TRF"}, {kInd, "T_CSY_IND"},
    {kCoord, "T_CSY_COORD"}, {kFollow, "T_CSY_FOLLOW"}, {kCam, "T_CSY_CAM"}, {kModule, "T_GEN_MOD"},
};

} // namespace

bool registerAt(uint8_t kind, size_t index, Register &found) noexcept {
  for (const RegisterRow &row : kRegisters) {
    if ((row.kinds & kind) == 0)
      continue;
    if (index >= row.repeats) {
      index -= row.repeats;
      continue;
    }
    found.row = &row;
    name(row, static_cast<uint8_t>(row.first + index), found.symbol);
    found.word = row.word == kNoWord ? kNoWord : static_cast<uint8_t>(row.word + index * row.step);
    return true;
  }
  return false;
}

uint8_t kindOfChannel(uint32_t channel) noexcept {
  return channel == 0                ? kRing
         : channel <= 16             ? kInd
         : channel <= 20             ? kCoord
         : channel <= 24             ? kFollow
         : channel < kModuleChannel  ? kCam
         : channel == kModuleChannel ? kModule
                                     : 0;
}

const char *nameOfKind(uint8_t kind) noexcept {
  for (const KindName &each : kKindNames)
    if (each.kind == kind)
      return each.name;
  return "";
}

ImagePlace placeOfBit(uint8_t number) noexcept {
  // The last bit of the eight bytes is ERR.
  const uint8_t bit = number == kErrorBit ? 63 : number;
  return {bit / 8U, static_cast<int8_t>(bit % 8)};
}

ImagePlace placeOfWord(RegisterArea area, uint32_t word) noexcept {
  switch (area) {
  case RegisterArea::Input:
    return {8 + 2 * word, -1};
  case RegisterArea::Output:
    return {4 + 2 * word, -1};
  case RegisterArea::Memory:
    break;
  }
  return {4 * word, -1};
}

ImagePlace placeOf(const Register &found) noexcept {
  const RegisterRow &row = *found.row;
  if (found.word == kNoWord)
    return placeOfBit(row.bit);
  ImagePlace place = placeOfWord(row.area, found.word);
  if (row.type == RegisterType::Bool)
    place = {place.byte + row.bit / 8U, static_cast<int8_t>(row.bit % 8)};
  return place;
}

} // namespace stride::csy
