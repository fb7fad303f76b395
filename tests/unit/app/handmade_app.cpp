// A compiled application written by hand: what the code generator emits for the ST below, file by
// file. It documents the contract of runtime/app/abi.h and is the fixture of the runtime's tests.
//
//   TYPE Color : (red, green := 5, blue); END_TYPE
//   TYPE Point : STRUCT x : LREAL := 1.5; y : LREAL; END_STRUCT END_TYPE
//
//   FUNCTION_BLOCK Counter
//   VAR_INPUT step : INT := 1; END_VAR
//   VAR_IN_OUT total : DINT; END_VAR
//   VAR_OUTPUT count : INT; END_VAR
//   VAR hidden_ {attribute 'hide'} : UDINT; END_VAR
//     count := count + step;  total := total + step;
//   END_FUNCTION_BLOCK
//
//   {attribute 'qualified_only'}
//   VAR_GLOBAL (list GVL) limit : INT := 100; END_VAR
//   VAR_GLOBAL CONSTANT kMax : DINT := 70000; END_VAR
//   VAR_GLOBAL total : DINT; END_VAR
//
//   PROGRAM PLC_PRG
//   VAR
//     count : INT; value : LREAL; flag : BOOL; name : STRING(10) := 'it''s';
//     a : ARRAY[1..3, -1..0] OF INT; pt : Point; fb : Counter; color : Color := green;
//     p : POINTER TO Point; t : TIME := T#1s500ms; table : ARRAY[0..1] OF Point;
//     divisor : INT := 1; quotient : INT;
//   END_VAR
//     count := count + 1;  value := value + 0.1;  flag := NOT flag;
//     a[2, -1] := count;   pt.x := value;  p := ADR(pt);
//     fb(step := 2, total := total);
//     quotient := count / divisor;
//   END_PROGRAM
//
//   PROGRAM Slow  VAR runs : UDINT; END_VAR  runs := runs + 1;  END_PROGRAM
//
//   tasks: Fast (10 ms, priority 1) : PLC_PRG;  Background (30 ms, priority 5) : Slow

#include "runtime/app/abi.h"
#include "runtime/iec/ops.h"

// --- st/user/<Type>.h: one layout per type ------------------------------------------------------

namespace st::user {

// An enumeration is an alias of its base type plus constants.
using Color = ::stride::INT;
inline constexpr ::stride::INT Color__red = 0;
inline constexpr ::stride::INT Color__green = 5;
inline constexpr ::stride::INT Color__blue = 6;

struct Point {
  ::stride::LREAL x;
  ::stride::LREAL y;
  void init__(::stride::Ctx &ctx__);
};

struct Counter {
  ::stride::INT step;
  ::stride::DINT *total; // VAR_IN_OUT: an address slot
  ::stride::INT count;
  ::stride::UDINT hidden_;
  void init__(::stride::Ctx &ctx__);
  void body__(::stride::Ctx &ctx__);
};

struct PLC_PRG {
  ::stride::INT count;
  ::stride::LREAL value;
  ::stride::BOOL flag;
  ::stride::STRING<10> name;
  ::stride::Array<::stride::Array<::stride::INT, -1, 0>, 1, 3> a;
  Point pt;
  Counter fb;
  Color color;
  Point *p;
  ::stride::TIME t;
  ::stride::Array<Point, 0, 1> table;
  ::stride::INT divisor;
  ::stride::INT quotient;
  void init__(::stride::Ctx &ctx__);
  void body__(::stride::Ctx &ctx__);
};

struct Slow {
  ::stride::UDINT runs;
  void init__(::stride::Ctx &ctx__);
  void body__(::stride::Ctx &ctx__);
};

// --- st/user/App__.h: the application object ----------------------------------------------------

// All state. One member per global variable list (a nested struct per list keeps C++ names free of
// collisions) and one per program.
struct App__ {
  struct {
    ::stride::INT limit;
  } GVL;
  struct {
    ::stride::DINT kMax;
    ::stride::DINT total;
  } Globals;
  PLC_PRG PLC_PRG__;
  Slow Slow__;
};

inline App__ &app__(::stride::Ctx &ctx__) { return *static_cast<App__ *>(ctx__.state); }

// --- Point.cpp, Counter.cpp, PLC_PRG.cpp, Slow.cpp: one translation unit per POU
// ------------------

// Memory is zero when init__ is called, so only non-zero defaults are set.
void Point::init__(::stride::Ctx &) { this->x = 1.5; }

void Counter::init__(::stride::Ctx &) { this->step = 1; }

void Counter::body__(::stride::Ctx &ctx__) {
#line 10 "src/counter.st"
  this->count = static_cast<::stride::INT>(this->count + this->step);
  // The position is passed to every check; the path is the one in the file table.
  ::stride::DINT &total = ::stride::bound(ctx__, this->total, "src/counter.st", 10, 26);
  total = total + this->step;
}

void PLC_PRG::init__(::stride::Ctx &ctx__) {
  ::stride::assign(this->name, "it's");
  this->pt.init__(ctx__);
  this->fb.init__(ctx__);
  this->color = Color__green;
  this->t = 1500;
  for (auto &e__ : this->table.v)
    e__.init__(ctx__);
  this->divisor = 1;
}

void PLC_PRG::body__(::stride::Ctx &ctx__) {
#line 30 "src/plc_prg.st"
  this->count = static_cast<::stride::INT>(this->count + 1);
  this->value = this->value + 0.1;
  this->flag = static_cast<::stride::BOOL>(this->flag == 0);
  this->a.v[::stride::index<1, 3>(ctx__, 2, "src/plc_prg.st", 33, 3)]
      .v[::stride::index<-1, 0>(ctx__, -1, "src/plc_prg.st", 33, 3)] = this->count;
  this->pt.x = this->value;
  this->p = &this->pt;
  this->fb.step = 2;
  this->fb.total = &app__(ctx__).Globals.total; // bound anew at each call
  this->fb.body__(ctx__);
  this->quotient = static_cast<::stride::INT>(::stride::divide<::stride::DINT>(
      ctx__, this->count, this->divisor, "src/plc_prg.st", 38, 21));
}

void Slow::init__(::stride::Ctx &) {}

void Slow::body__(::stride::Ctx &) { this->runs = this->runs + 1; }

} // namespace st::user

// --- app__.cpp: initialisation, tasks and tables
// ---------------------------------------------------
#line 159 "handmade_app.cpp"

namespace {

using ::st::user::App__;
using ::stride::Kind;

void init__(::stride::Ctx *ctx__) {
  App__ &app = ::st::user::app__(*ctx__);
  app.GVL.limit = 100;
  app.Globals.kMax = 70000;
  app.PLC_PRG__.init__(*ctx__);
  app.Slow__.init__(*ctx__);
}

void task0__(::stride::Ctx *ctx__) { ::st::user::app__(*ctx__).PLC_PRG__.body__(*ctx__); }
void task1__(::stride::Ctx *ctx__) { ::st::user::app__(*ctx__).Slow__.body__(*ctx__); }

// Indices are literals in emitted code; the names here are for the reader.
enum : uint32_t {
  tBOOL,
  tINT,
  tDINT,
  tUDINT,
  tLREAL,
  tTIME,
  tString10,
  tColor,
  tPoint,
  tCounter,
  tInOutDint,
  tRow,
  tMatrix,
  tPointerPoint,
  tPoints,
  tPrg,
  tSlow,
};

constexpr uint32_t kNo = ::stride::kNoIndex;
constexpr uint32_t kAddr = ::stride::kTypeHasAddress;

// {kind, flags, name, size, layoutHash, align, firstMember, memberCount, element, lowerBound,
//  elementCount, stringLength, 0}
constexpr ::stride::TypeDesc kTypes[] = {
    {Kind::BOOL, 0, "BOOL", 1, 0x01, 1, 0, 0, kNo, 0, 0, 0, 0},
    {Kind::INT, 0, "INT", 2, 0x02, 2, 0, 0, kNo, 0, 0, 0, 0},
    {Kind::DINT, 0, "DINT", 4, 0x03, 4, 0, 0, kNo, 0, 0, 0, 0},
    {Kind::UDINT, 0, "UDINT", 4, 0x04, 4, 0, 0, kNo, 0, 0, 0, 0},
    {Kind::LREAL, 0, "LREAL", 8, 0x05, 8, 0, 0, kNo, 0, 0, 0, 0},
    {Kind::TIME, 0, "TIME", 4, 0x06, 4, 0, 0, kNo, 0, 0, 0, 0},
    {Kind::STRING, 0, "STRING(10)", 11, 0x07, 1, 0, 0, kNo, 0, 0, 10, 0},
    {Kind::Enum, 0, "Color", 2, 0x08, 2, 0, 3, tINT, 0, 0, 0, 0},
    {Kind::Struct, 0, "Point", sizeof(::st::user::Point), 0x09, alignof(::st::user::Point), 0, 2,
     kNo, 0, 0, 0, 0},
    {Kind::FunctionBlock, kAddr, "Counter", sizeof(::st::user::Counter), 0x0A,
     alignof(::st::user::Counter), 2, 4, kNo, 0, 0, 0, 0},
    {Kind::InOut, kAddr, "DINT", 8, 0x0B, 8, 0, 0, tDINT, 0, 0, 0, 0},
    {Kind::Array, 0, "ARRAY[-1..0] OF INT", 4, 0x0C, 2, 0, 0, tINT, -1, 2, 0, 0},
    {Kind::Array, 0, "ARRAY[1..3, -1..0] OF INT", 12, 0x0D, 2, 0, 0, tRow, 1, 3, 0, 0},
    {Kind::Pointer, kAddr, "POINTER TO Point", 8, 0x0E, 8, 0, 0, tPoint, 0, 0, 0, 0},
    {Kind::Array, 0, "ARRAY[0..1] OF Point", 32, 0x0F, 8, 0, 0, tPoint, 0, 2, 0, 0},
    {Kind::Program, kAddr, "PLC_PRG", sizeof(::st::user::PLC_PRG), 0x10,
     alignof(::st::user::PLC_PRG), 6, 13, kNo, 0, 0, 0, 0},
    {Kind::Program, 0, "Slow", sizeof(::st::user::Slow), 0x11, alignof(::st::user::Slow), 19, 1,
     kNo, 0, 0, 0, 0},
};

// {name, offset, type, flags}
constexpr ::stride::MemberDesc kMembers[] = {
    // Point
    {"x", offsetof(::st::user::Point, x), tLREAL, 0},
    {"y", offsetof(::st::user::Point, y), tLREAL, 0},
    // Counter
    {"step", offsetof(::st::user::Counter, step), tINT, ::stride::kSymInput},
    {"total", offsetof(::st::user::Counter, total), tInOutDint, ::stride::kSymInOut},
    {"count", offsetof(::st::user::Counter, count), tINT, ::stride::kSymOutput},
    {"hidden_", offsetof(::st::user::Counter, hidden_), tUDINT, ::stride::kSymHidden},
    // PLC_PRG
    {"count", offsetof(::st::user::PLC_PRG, count), tINT, 0},
    {"value", offsetof(::st::user::PLC_PRG, value), tLREAL, 0},
    {"flag", offsetof(::st::user::PLC_PRG, flag), tBOOL, 0},
    {"name", offsetof(::st::user::PLC_PRG, name), tString10, 0},
    {"a", offsetof(::st::user::PLC_PRG, a), tMatrix, 0},
    {"pt", offsetof(::st::user::PLC_PRG, pt), tPoint, 0},
    {"fb", offsetof(::st::user::PLC_PRG, fb), tCounter, 0},
    {"color", offsetof(::st::user::PLC_PRG, color), tColor, 0},
    {"p", offsetof(::st::user::PLC_PRG, p), tPointerPoint, 0},
    {"t", offsetof(::st::user::PLC_PRG, t), tTIME, 0},
    {"table", offsetof(::st::user::PLC_PRG, table), tPoints, 0},
    {"divisor", offsetof(::st::user::PLC_PRG, divisor), tINT, 0},
    {"quotient", offsetof(::st::user::PLC_PRG, quotient), tINT, 0},
    // Slow
    {"runs", offsetof(::st::user::Slow, runs), tUDINT, 0},
};

constexpr ::stride::EnumeratorDesc kEnumerators[] = {{"red", 0}, {"green", 5}, {"blue", 6}};

// {list, name, offset, type, flags, renamedFrom, task}
constexpr ::stride::RootDesc kRoots[] = {
    {"GVL", "limit", offsetof(App__, GVL.limit), tINT, ::stride::kSymQualifiedOnly},
    {nullptr, "kMax", offsetof(App__, Globals.kMax), tDINT, ::stride::kSymConstant},
    {nullptr, "total", offsetof(App__, Globals.total), tDINT, 0},
    {nullptr, "PLC_PRG", offsetof(App__, PLC_PRG__), tPrg, 0, nullptr, 0},
    {nullptr, "Slow", offsetof(App__, Slow__), tSlow, 0, nullptr, 1},
};

// {name, kind, priority, intervalNs, watchdogNs, watchdogSensitivity, 0, run}
constexpr ::stride::TaskDesc kTasks[] = {
    {"Fast", ::stride::TaskKind::Cyclic, 1, 10000000, 0, 0, ::stride::kNoIndex, task0__},
    {"Background", ::stride::TaskKind::Cyclic, 5, 30000000, 0, 0, ::stride::kNoIndex, task1__},
};

constexpr ::stride::SourceFileDesc kFiles[] = {{"src/counter.st", 0x1}, {"src/plc_prg.st", 0x2}};

constexpr ::stride::StrideAppV1 kApp = {
    .abiVersion = ::stride::kAbiVersion,
    .magic = ::stride::kAbiMagic,
    .size = sizeof(::stride::StrideAppV1),
    .flags = 0,
    .name = "handmade",
    .compiler = "by hand",
    .buildHash = 0x1234,
    .stateSize = sizeof(App__),
    .stateAlign = alignof(App__),
    .reserved = 0,
    .init = init__,
    .exit = nullptr,
    .reinit = nullptr,
    .types = kTypes,
    .members = kMembers,
    .enumerators = kEnumerators,
    .roots = kRoots,
    .tasks = kTasks,
    .axisGroups = nullptr, // an empty table
    .drives = nullptr,
    .files = kFiles,
    .typeCount = ::stride::tableSize(kTypes),
    .memberCount = ::stride::tableSize(kMembers),
    .enumeratorCount = ::stride::tableSize(kEnumerators),
    .rootCount = ::stride::tableSize(kRoots),
    .taskCount = ::stride::tableSize(kTasks),
    .axisGroupCount = 0,
    .driveCount = 0,
    .fileCount = ::stride::tableSize(kFiles),
    .axisRefLayout = 0,
    .axisGroupRefLayout = 0,
    .image = {},
    .imageAddressing = ::stride::ImageAddressing::Units,
    .reserved2 = 0,
    .parameters = nullptr,
    .buses = nullptr,
    .encoders = nullptr,
    .parameterCount = 0,
    .busCount = 0,
    .encoderCount = 0,
    .bootupErrorLength = 0,
    .bootupErrorOffset = 0,
    .encoderRefLayout = 0,
};

} // namespace

extern "C" const ::stride::StrideAppV1 *stride_app_v1(void) { return &kApp; }
