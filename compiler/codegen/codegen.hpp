#ifndef STRIDE_COMPILER_CODEGEN_CODEGEN_HPP
#define STRIDE_COMPILER_CODEGEN_CODEGEN_HPP
// From a checked program to C++20.

#include "compiler/semantics/program.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// A generated file; `path` is relative to the output folder.
struct GeneratedFile {
  std::string path;
  std::string text;
  /// Each statement in it runs at most once in a call of a program: the C++ compiler need not take
  /// much time for it.
  bool runsOnce = false;
  size_t tables = 0; ///< bytes of the text that are numbers in tables
  /// A loop in it computes with arrays of reals within another one.
  bool isNumeric = false;
};

/// How a task is started.
enum class TaskStart : uint8_t { Cyclic, Freewheeling, Event, Status };

/// A parameter of the PLC configuration, for the driver: ParameterDesc.
struct ConfigParameter {
  std::string name;
  std::string text; ///< texts and choices; else empty
  double number = 0;
};

/// Tasks and axis groups of the application, from stride.toml.
struct AppConfig {
  struct Task {
    std::string name;
    TaskStart start = TaskStart::Cyclic;
    int64_t intervalNs = 0;            ///< as TaskDesc::intervalNs
    unsigned priority = 0;             ///< 0 highest … 31
    const PouSymbol *event = nullptr;  ///< a FUNCTION : BOOL without parameters
    int64_t watchdogNs = 0;            ///< 0: none
    unsigned watchdogSensitivity = 1;  ///< violations that stop the application
    std::optional<unsigned> core;      ///< processor to run on
    std::vector<PouSymbol *> programs; ///< called in this order
    std::optional<size_t> sync;        ///< axis group whose bSync is the event
    /// Called in place of programs while the PLC is in STOP. What they use, programs use, too.
    std::vector<PouSymbol *> stopPrograms;
  };
  struct Drive {
    std::string name; ///< of the global AXIS_REF
    std::string data; ///< of the global that belongs to the driver; empty: none
    uint32_t id = 0;  ///< wDriveId
    std::vector<ConfigParameter> parameters;
  };
  struct Encoder {
    std::string name; ///< of the global SMC_ENCODER_REF
    uint32_t id = 0;  ///< wEncoderId
    std::vector<ConfigParameter> parameters;
  };
  struct Bus {
    std::string name;
    std::string interfaceType;
    std::string driver; ///< first word of InterfaceType: `Dummy`
    std::vector<ConfigParameter> parameters;
  };
  struct AxisGroup {
    std::string name; ///< of the global SMC_AXISGROUP_REF
    size_t bus = 0;   ///< index into buses
    std::string task;
    uint32_t cycleUs = 0; ///< dwCycle
    std::vector<ConfigParameter> parameters;
    std::vector<Drive> drives;
    std::vector<Encoder> encoders;
    std::string data; ///< of the global variable that driver and program share; empty: none
  };
  /// A device of the process image, [[io]].
  struct IoDevice {
    std::string name; ///< of the global IO_DEVICE, too
    std::string driver;
    uint32_t inputFirst = 0; ///< bytes of the areas
    uint32_t inputCount = 0;
    uint32_t outputFirst = 0;
    uint32_t outputCount = 0;
    std::vector<uint8_t> safeOutputs;
    std::vector<uint8_t> safeInputs; ///< empty: inputs of a lost device stay
    bool holdsInStop = false;        ///< outputs keep their values in STOP
    std::vector<ConfigParameter> parameters;
  };
  /// What one technical unit is, where stride.toml says so.
  struct TechnicalUnit {
    std::string variable; ///< the global AXIS_REF
    std::string unit;
  };
  std::string name;
  std::vector<IoDevice> ioDevices;
  std::vector<Task> tasks;
  std::vector<Bus> buses;
  std::vector<AxisGroup> axisGroups;
  std::vector<TechnicalUnit> units;
  std::string retainFile;     ///< [retain] file
  int64_t retainPeriodNs = 0; ///< [retain] period; 0: the runtime's own
  std::string filesRoot;      ///< [files] root; empty: the runtime's own
  bool filesAnywhere = false; ///< [files] anywhere
  uint32_t filesDelay = 1;    ///< [files] delay
};

/// Defined where the source `path` and sources that may call it are one translation unit: its small
/// body is inlined from there, and `.inline.h` does not give it a second time.
[[nodiscard]] std::string besideMacro(std::string_view path);

/// Headers `st/<Library>/<Name>.h` and sources `<Library>/<Name>.cpp` of one library (everything
/// declared in it;
/// `{external}` bodies are declared only).
std::vector<GeneratedFile> generateLibrary(const Program &program, const Library &library);

/// Headers `st/user/<Name>.h`, `user/<Name>.cpp` per POU, `user/init__.cpp` with the initial values
/// of structures and variable lists, `app.cpp` with the application object (state layout,
/// initialisation, type table, roots, tasks: runtime/app/abi.h) and `build.cpp` with the hashes of
/// the sources. Library headers are not generated again; they are included from where Stride
/// installed them. The same program gives the same texts; a change in a body changes only that
/// source and build.cpp.
std::vector<GeneratedFile> generateApplication(const Program &program, const AppConfig &config);

} // namespace stc

#endif // STRIDE_COMPILER_CODEGEN_CODEGEN_HPP
