#ifndef STRIDE_COMPILER_PROJECT_CONFIG_HPP
#define STRIDE_COMPILER_PROJECT_CONFIG_HPP
// What stride.toml says: tasks and PLC configuration (SoftMotion V2.3 manual, section 2.1).

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/codegen/codegen.hpp"
#include "compiler/project/csy_config.hpp"
#include "compiler/project/library_config.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/ast.hpp"
#include "compiler/syntax/conditions.hpp"
#include "compiler/toml/schema.hpp"
#include "runtime/bus/driver_schema.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stc {

struct TaskConfig {
  ConfigName name;
  TaskStart start = TaskStart::Cyclic;
  /// 0: none, or wrong, which has been reported. Beside an event: see TaskDesc::intervalNs.
  int64_t intervalNs = 0;
  unsigned priority = 1;
  ConfigName event;                 ///< an expression of ST, for event and status tasks
  int64_t watchdogNs = 0;           ///< 0: none
  unsigned watchdogSensitivity = 1; ///< violations that stop the application
  std::optional<unsigned> core;     ///< processor to run on
  std::vector<ConfigName> programs; ///< called in this order
  /// Called in place of them while the PLC is in STOP: what modules of [[csy]] go on with.
  std::vector<ConfigName> stopPrograms;
  Span section; ///< [[task]] of stride.toml
  /// The first key that a task of a CONFIGURATION cannot have; empty: it only adds to such a one.
  ConfigName own;
};

/// Members of an AXIS_REF, SMC_ENCODER_REF or SMC_AXISGROUP_REF that the configuration sets: name
/// and value as ST text.
using ConfigFields = std::vector<std::pair<std::string, std::string>>;

struct DriveConfig {
  ConfigName name;
  uint32_t id = 0;  ///< wDriveId
  std::string unit; ///< what one technical unit is: "mm"; empty: not given
  ConfigFields fields;
  std::vector<ConfigParameter> parameters;
  /// The variable that driver and program share about it; null: there is none.
  const stride::bus::SharedData *shared = nullptr;
};

/// The name of DriveConfig::shared; empty: there is none.
[[nodiscard]] inline std::string sharedVariable(const DriveConfig &drive) {
  return drive.shared != nullptr ? drive.name.text + std::string(drive.shared->suffix)
                                 : std::string();
}

/// [[axis]]: an axis without a drive.
struct AxisConfig {
  ConfigName name;
  ConfigName task; ///< sTask; empty: the only task, whose name resolveTasks puts here
  Span section;
  uint32_t cycleUs = 0; ///< dwCycle; 0: not given
  Span cycleSpan;
  std::string unit; ///< what one technical unit is; empty: not given
  ConfigFields fields;
};

struct EncoderConfig {
  ConfigName name;
  uint32_t id = 0; ///< wEncoderId
  ConfigFields fields;
  std::vector<ConfigParameter> parameters;
};

struct BusConfig {
  ConfigName name;
  std::string interfaceType;
  std::string driver; ///< first word of InterfaceType
  std::vector<ConfigParameter> parameters;
  size_t axisGroups = 0;
};

struct AxisGroupConfig {
  ConfigName name;
  size_t bus = 0;     ///< index into ProjectConfig::buses
  std::string driver; ///< first word of InterfaceType
  ConfigName task;    ///< sTask; empty: the only task
  Span groupSpan;
  uint32_t cycleUs = 0; ///< dwCycle; 0: not given
  Span cycleSpan;
  ConfigName syncProducer; ///< of a CAN bus; empty: not given
  ConfigFields fields;
  std::vector<ConfigParameter> parameters;
  std::vector<DriveConfig> drives;
  std::vector<EncoderConfig> encoders;
  /// The variable that driver and program share about it; null: there is none.
  const stride::bus::SharedData *shared = nullptr;
};

/// The name of AxisGroupConfig::shared; empty: there is none.
[[nodiscard]] inline std::string sharedVariable(const AxisGroupConfig &group) {
  return group.shared != nullptr ? group.name.text + std::string(group.shared->suffix)
                                 : std::string();
}

/// A value for an input of a block, which its key names.
struct InputValue {
  ConfigName name;
  TomlNode value;
};

/// [[axes_group]]: axes that move together on a path.
struct AxesGroupConfig {
  ConfigName name;
  std::vector<ConfigName> axes; ///< those of the kinematics, then those that go along
  Span axesSpan;
  ConfigName kinematics;   ///< a block; empty: none
  ConfigName orientation;  ///< a block that turns the tool; empty: none
  ConfigName planningTask; ///< empty: that of its axes
  std::vector<InputValue> parameters;
  std::vector<InputValue> orientationParameters;
  // As ST text, `(X := 1.0, …)`; empty: not given.
  std::string tool;
  std::string base; ///< MCS in WCS
  std::string pcs1;
  std::string pcs2;
};

/// Whether the task's event is the bSync of this axis group, which its driver gives.
[[nodiscard]] bool isSyncOf(const TaskConfig &task, const AxisGroupConfig &group);

/// What stride.toml says of one device of the process image.
struct IoConfig {
  ConfigName name;
  Span inputSpan; ///< where its places are given
  Span outputSpan;
  ConfigName axisGroup; ///< Whose bus it is at; empty: none.
  AppConfig::IoDevice device;
};

/// [[test]]: a simulation whose trace `stride test` compares with `tests/NAME.csv` of the project.
struct TraceTest {
  ConfigName name;
  int64_t durationNs = 0;         ///< virtual time
  std::vector<std::string> trace; ///< variables; those in them where one is a structure
  /// File in the project that says what is written and forced, and when; empty: nothing is.
  std::string script;
  std::vector<std::string> sets; ///< `[TIME,]NAME=VALUE`
  double tolerance = 0;          ///< how far a number may be off
  int64_t everyNs = 0;           ///< rows at multiples of it count; 0: all
};

/// [build] launcher: a program that starts the C++ compiler, here or elsewhere.
enum class Launcher : uint8_t { None, Ccache, Distcc, Icecc };

/// The configuration of one project. Without stride.toml it is empty but for the name.
struct ProjectConfig {
  std::string name;
  uint64_t poolSize = 65536; ///< new_pool: bytes for the objects of __NEW, a multiple of 16
  unsigned generation = 2;   ///< softmotion: 2 = "2.3", 3 = "3"
  bool truncIsInt = false;   ///< softmotion = "2.3" is written: TRUNC gives an INT
  unsigned pack = 0;         ///< layout: 4 = "v2.3"
  Addressing addressing = Addressing::Units;
  std::array<uint32_t, 3> imageBytes{}; ///< by Area; 0: as large as the program needs
  std::string retainFile;               ///< [retain] file; empty: not given
  int64_t retainPeriodNs = 0;           ///< [retain] period; 0: not given
  std::string filesRoot;                ///< [files] root; empty: not given
  bool filesAnywhere = false;           ///< [files] anywhere
  uint32_t filesDelay = 1;              ///< [files] delay
  Launcher launcher = Launcher::None;   ///< [build] launcher
  unsigned buildJobs = 0;               ///< [build] jobs; 0: as many as there are processors
  std::vector<Define> defines;          ///< for `{IF defined (…)}`
  std::vector<ConfigName> sources;      ///< folders and files; empty: the project's folder
  std::optional<LibraryInfo> library;   ///< [library]: the project is one
  std::vector<LibraryUse> libraries;    ///< [[library]], or [[library.uses]]
  std::vector<TaskConfig> tasks;
  std::vector<BusConfig> buses;
  std::vector<AxisGroupConfig> axisGroups;
  std::vector<AxisConfig> axes;
  std::vector<AxesGroupConfig> axesGroups;
  std::vector<IoConfig> ioDevices;
  std::vector<CncSettings> cnc; ///< [[cnc]]
  std::vector<CsyConfig> csy;   ///< [[csy]]
  std::vector<TraceTest> traceTests;
  bool incomplete = false; ///< a drive, axis group or everything had to be left out
};

/// Reads and checks stride.toml. What is wrong is reported with its place; what is right is
/// returned.
[[nodiscard]] ProjectConfig readConfig(const SourceFile &toml, Diagnostics &diagnostics);

/// What resolveTasks demands of the PROGRAMs.
enum class ProgramCheck : uint8_t {
  Skip,     ///< nothing: the sources have syntax errors, so that PROGRAMs may be missing
  Existing, ///< those named by tasks must exist; a project without any is fine (check)
  Runnable, ///< there must also be something to call (build, sim)
};

/// Completes the tasks with the sources' help: without [[task]] one cyclic task (`Task`, 10 ms or
/// the axis groups' dwCycle) calls PLC_PRG or the only PROGRAM. Then gives every axis group its
/// task, and every axis without a drive the cycle time of its own.
void resolveTasks(ProjectConfig &config, const std::vector<ast::File *> &files,
                  ProgramCheck programCheck, Diagnostics &diagnostics);

/// Reads the CONFIGURATION among the sources, if there is one: its tasks become the project's.
/// Returns declarations to be added to the sources: the instances of programs that have names of
/// their own, and hidden programs that call them; null: none.
[[nodiscard]] ast::File *
readConfigurations(ProjectConfig &config, const std::vector<ast::File *> &files, Program &program);

/// Name of the hidden FUNCTION that evaluates the event of a task.
[[nodiscard]] std::string eventFunction(const TaskConfig &task);

/// That FUNCTION as ST, in which the expression stands where the user has written it: in a file of
/// that name, at `at`.
[[nodiscard]] SyntheticSource eventDeclaration(const TaskConfig &task, const std::string &file,
                                               LineColumn at);

/// The configuration as ST: one VAR_GLOBAL with an AXIS_REF per drive and axis, an SMC_ENCODER_REF
/// per encoder and an SMC_AXISGROUP_REF per axis group, and g_DRIVESTRUCT, which leads to all of
/// them. May be empty. Drives and groups named like something in `files` are reported and left out.
[[nodiscard]] SyntheticSource plcDeclarations(const ProjectConfig &config,
                                              const std::vector<ast::File *> &files,
                                              Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_CONFIG_HPP
