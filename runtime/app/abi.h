// The C ABI between a compiled application and the program that runs it.
//
// An application is one shared object (or the same objects linked statically) with one exported
// function, stride_app_v1, that returns a constant description. All tables are constant arrays and
// refer to each other by index; tests/unit/app/handmade_app.cpp is a complete example by hand.
// Generated code has its types, members, enumerators and roots as text and numbers (SymbolLines),
// of which the host makes such tables when it loads an application: runtime/app/symbol_text.hpp.
// Free of the C++ standard library; see runtime/iec/types.h.
//
// State is one block of plain memory: trivially copyable and relocatable, addressed by offset. The
// type table says where addresses are stored inside it (the kinds Pointer, Reference, InOut and
// Interface), so that the block can be moved, saved and carried over to a new build.
#ifndef STRIDE_RUNTIME_APP_ABI_H
#define STRIDE_RUNTIME_APP_ABI_H

#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

namespace stride {

/// The first member of StrideAppV1. Grows with every change that an older host cannot read.
inline constexpr uint32_t kAbiVersion = 11;
/// The second member: tells a description from other data ("STRD").
inline constexpr uint32_t kAbiMagic = 0x44525453;
/// "No index" in the tables below.
inline constexpr uint32_t kNoIndex = 0xFFFFFFFFU;

/// What a member or a root is and how it may be used. Combined with |.
enum SymbolFlags : uint32_t {
  kSymInput = 1U << 0,
  kSymOutput = 1U << 1,
  kSymInOut = 1U << 2,
  kSymRetain = 1U << 3,
  kSymPersistent = 1U << 4,
  kSymConstant = 1U << 5,      ///< Not to be written.
  kSymHidden = 1U << 6,        ///< Private state of a library block: not listed, but reachable.
  kSymBase = 1U << 7,          ///< The embedded base of EXTENDS: its members count as our own.
  kSymQualifiedOnly = 1U << 8, ///< A global reachable only with its list's name in front.
  kSymTypeId = 1U << 9, ///< The hidden `type__` of an instance (UDINT): init sets it, nobody else
                        ///< writes it, and it is not carried over. Interface slots point to it.
  kSymInitOnChange = 1U << 10, ///< {attribute 'init_on_onlchange'}: an online change does not keep
                               ///< the value.
  kSymLocated = 1U << 12,      ///< Lies in the process image (or is a second name of something, by
                          ///< VAR_ACCESS): the offset counts from the start of the state, also that
                          ///< of a member.
  kSymSlot = 1U << 13, ///< `AT %I*`: at the offset the instance holds a UDINT, the variable's place
                       ///< in its area: the byte's number, the bit's for kSymBit. Set by init,
                       ///< never carried over. The area is in bits 24 and 25: 0 = I, 1 = Q, 2 = M.
  kSymBit = 1U << 14,  ///< A BOOL that is one bit of the byte. For kSymLocated and for a BIT of a
                       ///< structure or block the number of the bit is in the bits 28 to 30.
  kSymNonRetain = 1U << 15, ///< NON_RETAIN: not stored, whatever it is in.
};
inline constexpr uint32_t kSymAreaShift = 24;
inline constexpr uint32_t kSymBitShift = 28;
/// SymbolFlags in lines of symbols: the letter at n stands for 1 << n. A digit after `s` (Slot) is
/// the area, one after `b` (Bit) the number of the bit.
inline constexpr char kSymbolFlagLetters[] = "ioxrpchBqtn.lsbN";

/// What a type is. Combined with |.
enum TypeFlags : uint32_t {
  kTypeHasAddress = 1U << 0, ///< It or something inside it is an address slot.
  kTypeExternal = 1U << 1,   ///< A library type whose body is native.
  kTypeRange = 1U << 2,      ///< A subrange: an integer kind with bounds, TypeDesc::lowerBound.
};

/// One enumerator.
struct EnumeratorDesc {
  const char *name; ///< Spelling of the declaration.
  int64_t value;
};

/// One field of a structure, union, function block or program, in declaration order.
struct MemberDesc {
  const char *name; ///< ST spelling of the declaration (never the C++ spelling).
  uint64_t offset;  ///< From the start of the enclosing type, in bytes.
  uint32_t type;    ///< Index into the type table.
  uint32_t flags;   ///< SymbolFlags.
  /// {attribute 'renamed_from' := '…'}: the name of this field in an earlier build, or null.
  const char *renamedFrom = nullptr;
};

/// One type. Aliases do not appear: they are resolved to what they stand for. A subrange is its
/// base type with bounds (kTypeRange).
struct TypeDesc {
  Kind kind;
  uint32_t flags;        ///< TypeFlags.
  const char *name;      ///< ST name ("INT", "AXIS_REF", "STRING(80)", "ARRAY[1..3] OF INT").
  uint64_t size;         ///< Bytes.
  uint64_t layoutHash;   ///< Changes when size, members or member types change; equal in all builds
                         ///< for equal layouts.
  uint32_t align;        ///< Bytes.
  uint32_t firstMember;  ///< Struct, Union, FunctionBlock, Program: into the member table.
                         ///< Enum: into the enumerator table.
  uint32_t memberCount;  ///< Number of members or enumerators.
  uint32_t element;      ///< Array: element type. Pointer, Reference, InOut: type pointed to.
                         ///< Enum, kTypeRange: base type. Else kNoIndex.
  int64_t lowerBound;    ///< Array: first index of this dimension. kTypeRange: smallest value.
  uint64_t elementCount; ///< Array: number of elements of this dimension. kTypeRange: the largest
                         ///< value, an int64_t.
  uint32_t stringLength; ///< STRING, WSTRING: declared length.
  uint32_t typeId;       ///< FunctionBlock: what init writes to the member with kSymTypeId; else 0.
  /// {attribute 'renamed_from' := '…'}: the type's name in an earlier build, or null.
  const char *renamedFrom = nullptr;
};

/// A place in the state where paths begin: a program instance or a global variable.
struct RootDesc {
  const char *list; ///< Name of the global variable list before the name, or null.
  const char *name; ///< "Ipo", "Drive", "g_x": ST spelling.
  uint64_t offset;  ///< From the start of the state.
  uint32_t type;    ///< Index into the type table.
  uint32_t flags;   ///< SymbolFlags.
  /// Its name in an earlier build, "name" (in a list of the same name) or "list.name", or null.
  const char *renamedFrom = nullptr;
  /// The one task that writes the variable or calls the program; kNoIndex: none, or several.
  uint32_t task = kNoIndex;
};

/// Numbers of lines of symbols that only the C++ compiler knows, in the order of the lines. A type
/// has three: Kind, size and alignment in bytes; a member and a root one: its offset, as MemberDesc
/// and RootDesc have it; an enumerator none.
struct SymbolNumbers {
  const uint64_t *values;
  uint64_t count;
};

/// Types, members, enumerators and roots as generated code gives them. A row of a table takes a C++
/// compiler 20 us, a line of text next to nothing, and its number 5.
///
/// A line ends with a line feed. Its first character says what it is; columns are separated by
/// tabs, and empty ones at the end of a line are left out:
///
///     T flags  name  layoutHash  element  lowerBound  elementCount  stringLength  typeId
///     renamedFrom M flags  name  type  renamedFrom             of the last type E name  value of
///     the last type R flags  name  type  list  task  renamedFrom
///
/// Types are numbered from 0 in the order of their lines. Flags of types are TypeFlags as a number,
/// others are letters (kSymbolFlagLetters); layoutHash is in base 16, the rest in base 10. What is
/// empty is 0, null or kNoIndex.
struct SymbolLines {
  const char *text;
  uint64_t length; ///< Of the text, in bytes.
  const SymbolNumbers *numbers;
  uint32_t numberLists; ///< How many `numbers` there are: they follow each other.
  uint32_t reserved;    ///< 0.
};

/// How a task is started.
enum class TaskKind : uint32_t { Cyclic = 0, Freewheeling = 1, Event = 2, Status = 3 };

/// One task. The order of the table is the order of declaration.
struct TaskDesc {
  const char *name;
  TaskKind kind;
  uint32_t priority; ///< 0 (highest) to 31.
  /// Cyclic: the period. Freewheeling: the period in virtual time. Status: from cycle to cycle
  /// while the event is TRUE. Event: 0, or the period while the event is FALSE (IEC: INTERVAL
  /// beside SINGLE).
  int64_t intervalNs;
  int64_t watchdogNs;           ///< Longest run time of a cycle, 0: none.
  uint32_t watchdogSensitivity; ///< Number of violations that stop the application; 0 counts as 1.
  uint32_t core;                ///< The processor it runs on with the real clock; kNoIndex: any.
  void (*run)(Ctx *ctx);        ///< Calls the task's POUs in their order.
  BOOL (*event)(Ctx *ctx) = nullptr; ///< Event, Status: what starts it. Else null.
  /// Event: the axis group whose bSync it is; the driver of that bus starts the task. For the task
  /// that serves the group, intervalNs is the time from SYNC to SYNC. Else kNoIndex.
  uint32_t sync = kNoIndex;
  /// Called in place of `run` while the PLC is in STOP: what devices that are served by programs (a
  /// TSX CSY 85) go on with. Null: nothing.
  void (*runInStop)(Ctx *ctx) = nullptr;
};

/// One parameter of the PLC configuration, as the driver gets it. Which there are, the driver's
/// documentation says; names are those of stride.toml, in a table below with its name in front
/// ("physics.model").
struct ParameterDesc {
  const char *name;
  const char *text; ///< Texts and choices by name; else null.
  double number;    ///< Numbers, choices by value, BOOLs as 0 and 1, durations in seconds.
};

/// One bus of the PLC configuration.
struct BusDesc {
  const char *name;
  const char *interfaceType; ///< InterfaceType: "Dummy (simulated drives)".
  const char *driverName;    ///< Its first word: "Dummy".
  uint32_t firstParameter;   ///< Into the parameter table.
  uint32_t parameterCount;
};

/// One drive of an axis group. Its configured parameters are already in its AXIS_REF when init
/// returns.
struct DriveDesc {
  const char *name;
  uint64_t axisOffset; ///< Of its AXIS_REF, from the start of the state.
  uint32_t driveId;    ///< wDriveId.
  uint32_t reserved;   ///< 0.
  /// The structure in the state that driver and program share about this drive (Dummy:
  /// DUMMY_DRIVE_SIM), and its layout hash; 0: there is none.
  uint64_t dataOffset = 0;
  uint64_t dataLayout = 0;
  uint32_t firstParameter = 0; ///< Into the parameter table.
  uint32_t parameterCount = 0;
};

/// One encoder of an axis group.
struct EncoderDesc {
  const char *name;
  uint64_t encoderOffset; ///< Of its SMC_ENCODER_REF, from the start of the state.
  uint32_t encoderId;     ///< wEncoderId.
  uint32_t firstParameter;
  uint32_t parameterCount;
  uint32_t reserved; ///< 0.
};

/// One axis group of the PLC configuration.
struct AxisGroupDesc {
  const char *name;
  const char *busName;
  const char *driverName; ///< First word of InterfaceType: "Dummy".
  uint64_t groupOffset;   ///< Of its SMC_AXISGROUP_REF, from the start of the state.
  uint32_t task;          ///< Index of the task named by sTask.
  uint32_t cycleUs;       ///< dwCycle.
  uint32_t firstDrive;    ///< Into the drive table.
  uint32_t driveCount;
  uint32_t bus = kNoIndex;   ///< Into the bus table.
  uint32_t firstEncoder = 0; ///< Into the encoder table.
  uint32_t encoderCount = 0;
  uint32_t firstParameter = 0; ///< Into the parameter table.
  uint32_t parameterCount = 0;
  /// The structure in the state that driver and program share about the group (CAN:
  /// SMC_CAN_COUNTERS), and its layout hash; 0: there is none.
  uint64_t dataOffset = 0;
  uint64_t dataLayout = 0;
};

/// What one technical unit of a drive or an axis is.
struct UnitDesc {
  const char *variable; ///< Its AXIS_REF: "Drive".
  const char *unit;     ///< "mm".
};

/// The areas of the process image.
enum ImageArea : uint32_t { kImageInput = 0, kImageOutput = 1, kImageMemory = 2 };

/// One area of the process image; its bytes are also the hidden root `%I`, `%Q` or `%M`.
struct ImageAreaDesc {
  uint64_t offset; ///< From the start of the state, a multiple of 8.
  uint64_t size;   ///< Bytes; 0: the application does not use the area.
};

/// Bytes of the process image that the programs of a task use, found by the compiler. Sorted by
/// task, area, direction and place; a byte is written by one task at most in the output area.
struct ImageUseDesc {
  uint32_t task;
  uint32_t area;   ///< ImageArea.
  uint32_t writes; ///< 1: the task writes them, 0: it reads them.
  uint32_t first;
  uint32_t count;
};

/// A device of the process image ([[io]] of stride.toml). Bytes are counted in the area.
struct IoDeviceDesc {
  const char *name;
  const char *driverName; ///< `device`: "Simulated", "SharedMemory".
  uint64_t stateOffset;   ///< Of its IO_DEVICE, from the start of the state.
  uint32_t inputFirst;
  uint32_t inputCount; ///< Bytes; 0: it has no inputs.
  uint32_t outputFirst;
  uint32_t outputCount;
  const uint8_t *safeOutputs; ///< One byte per output byte, for when the application stops or the
                              ///< device is lost; null: zeros.
  const uint8_t *safeInputs;  ///< What inputs become when the device is lost; null: they stay.
  uint32_t firstParameter;    ///< Into the parameter table.
  uint32_t parameterCount;
  /// While the PLC is in STOP: 0: its outputs have their safe values (fallback), 1: the last ones
  /// of RUN (hold).
  uint32_t holdsInStop = 0;
};

/// What the numbers of direct addresses count (stride.toml: [image] addressing).
enum class ImageAddressing : uint32_t {
  Units = 0, ///< Units of their size, bits by byte: %MW3 is bytes 6 and 7, %MX3.1 bit 1 of byte 3.
  Bytes = 1, ///< Bytes: %MW3 is bytes 3 and 4.
  Words = 2, ///< Units of their size, bits by word: %MX3.9 is bit 1 of byte 7.
};

/// One ST source file; positions in messages name it.
struct SourceFileDesc {
  const char *path; ///< As given to the compiler, relative to the project where possible.
  uint64_t hash;    ///< Of its contents.
};

/// Everything the host knows about an application.
struct StrideAppV1 {
  uint32_t abiVersion;  ///< kAbiVersion.
  uint32_t magic;       ///< kAbiMagic.
  uint32_t size;        ///< sizeof(StrideAppV1) of the build.
  uint32_t flags;       ///< 0.
  const char *name;     ///< Name of the application.
  const char *compiler; ///< Version of Stride that built it.
  uint64_t buildHash;   ///< Of all sources and options.

  uint64_t stateSize;
  uint32_t stateAlign;
  uint32_t reserved; ///< 0.
  /// Sets defaults in zeroed state: libraries first, then files by path, then declaration order.
  /// ctx->state is valid, the times in ctx are 0.
  /// Calls FB_Init and the methods with 'call_after_init' too; ctx->keepRetains and
  /// ctx->inCopyCode (both 0 at a first start) are what FB_Init is told.
  void (*init)(Ctx *ctx);
  /// Calls FB_Exit of every instance, before the state is given up (also the old one of an online
  /// change: with ctx->inCopyCode). Null when no instance has one.
  void (*exit)(Ctx *ctx);
  /// Calls FB_Reinit of every instance of the new state after values were carried over. Null when
  /// no instance has one.
  void (*reinit)(Ctx *ctx);

  const TypeDesc *types; ///< This table and the next three: null and empty with `symbols`.
  const MemberDesc *members;
  const EnumeratorDesc *enumerators;
  const RootDesc *roots;
  const TaskDesc *tasks;
  const AxisGroupDesc *axisGroups;
  const DriveDesc *drives;
  const SourceFileDesc *files;
  uint32_t typeCount;
  uint32_t memberCount;
  uint32_t enumeratorCount;
  uint32_t rootCount;
  uint32_t taskCount;
  uint32_t axisGroupCount;
  uint32_t driveCount;
  uint32_t fileCount;

  /// Layout hashes (TypeDesc::layoutHash) of AXIS_REF and SMC_AXISGROUP_REF as this build sees
  /// them; 0 when the application has no axis group.
  uint64_t axisRefLayout;
  uint64_t axisGroupRefLayout;

  ImageAreaDesc image[3]; ///< By ImageArea.
  ImageAddressing imageAddressing;
  uint32_t reserved2; ///< 0.

  /// stride.toml, [retain]: the file for RETAIN and PERSISTENT variables (null: none is named) and
  /// the time from one saving to the next (0: the runtime's own).
  const char *retainFile = nullptr;
  int64_t retainPeriodNs = 0;

  const ImageUseDesc *imageUses = nullptr;
  uint32_t imageUseCount = 0;

  const IoDeviceDesc *ioDevices = nullptr;
  uint32_t ioDeviceCount = 0;

  const ParameterDesc *parameters = nullptr;
  const BusDesc *buses = nullptr;
  const EncoderDesc *encoders = nullptr;
  uint32_t parameterCount = 0;
  uint32_t busCount = 0;
  uint32_t encoderCount = 0;
  uint32_t bootupErrorLength =
      0; ///< STRING length of g_strBootupError; 0: the application has none.
  uint64_t bootupErrorOffset = 0; ///< From the start of the state.
  uint64_t encoderRefLayout = 0;  ///< Layout hash of SMC_ENCODER_REF; 0 when there is no encoder.

  /// Prepares what tasks read of each other. init does so at its end; to be called again when
  /// values have been put into the state before the tasks run (retained ones, those of another
  /// build). Raises no exception. Null when there is nothing to prepare.
  void (*settle)(Ctx *ctx) = nullptr;

  /// stride.toml, [files]: the folder for the program's files, relative to the current one where
  /// nobody says otherwise; null: `files`.
  const char *filesRoot = nullptr;
  uint32_t filesAnywhere = 0; ///< 1: names may lead out of it.
  uint32_t filesDelay = 1;    ///< In virtual time answers come so many cycles later.

  const UnitDesc *units = nullptr;
  uint32_t unitCount = 0;
  uint32_t reserved3 = 0; ///< 0.

  /// What the host makes the tables of types, members, enumerators and roots of; null: they are
  /// here.
  const SymbolLines *symbols = nullptr;
};

/// Number of elements of a table, for StrideAppV1's counts.
template <class T, size_t N> constexpr uint32_t tableSize(const T (&)[N]) {
  return static_cast<uint32_t>(N);
}

} // namespace stride

/// The only exported symbol of an application.
extern "C" __attribute__((visibility("default"))) const ::stride::StrideAppV1 *stride_app_v1(void);

#endif
