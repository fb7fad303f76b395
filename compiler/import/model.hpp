#ifndef STRIDE_COMPILER_IMPORT_MODEL_HPP
#define STRIDE_COMPILER_IMPORT_MODEL_HPP
// What readers of other tools' project files find, whatever the format.

#include "compiler/import/networks/scope.hpp"
#include "compiler/import/networks/translation.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stc::import {

/// Where something stands in an imported file.
struct Origin {
  std::string file;
  size_t line = 1; ///< from 1
};

/// A line of the report about something that was changed or left out.
struct Remark {
  Origin origin;
  std::string object; ///< its kind and name, as in the file
  std::string text;   ///< what was done, and why
};

/// What a piece of source text declares.
enum class ObjectKind {
  Pou,
  Type,
  GlobalList,
  Source, ///< a file as a whole, of which only the name of the file is known
};

/// Source text of a declaration with its body, in ST (or IL, or textual SFC).
struct Object {
  ObjectKind kind = ObjectKind::Pou;
  std::string name;                ///< of the POU, the type or the list
  std::vector<std::string> folder; ///< names from the outermost one
  std::string text;                ///< complete, in UTF-8, lines end with \n
  Origin origin;
};

/// A task; texts as the file has them.
struct Task {
  std::string name;
  std::string priority; ///< number; empty: not given
  std::string interval; ///< TIME literal; empty: none
  std::string event;    ///< BOOL expression; empty: none
  std::vector<std::string> programs;
  Origin origin;
  std::string watchdog{}; ///< duration; empty: none
  unsigned watchdogSensitivity = 1;
  bool status = false; ///< it runs while `event` is TRUE, not once at its rising edge
};

/// A library that the project refers to.
struct LibraryReference {
  std::string name;
  std::string version; ///< empty: not given
  Origin origin;
  std::vector<std::string> contents{}; ///< names that it declares; empty: not said
};

/// Text of a section that is not imported; it is kept beside the report.
struct KeptText {
  std::string path; ///< name of its file, without ending
  std::string text;
};

/// A body that is drawn and waits for all declarations; see drawn_bodies.hpp.
struct DrawnBody {
  Origin origin;
  std::string object; ///< its kind and name, as in the file
  std::string kind;   ///< `LD`, `FBD` or `CFC`
  std::string mark;   ///< stands for it in the object's text
  std::function<networks::Translation(networks::Scope &)> translate;
  KeptText kept; ///< where it cannot be translated; empty path: nothing
};

/// How far a value of another tool's configuration can be trusted.
enum class Certainty {
  Sure,    ///< the file says it
  Guessed, ///< the user must look at it: it is marked in stride.toml and in the report
  Missing, ///< the file does not say it: written as a comment that the user fills in
};

/// A parameter of stride.toml.
struct Parameter {
  std::string key;   ///< as in stride.toml: `wDriveId`
  std::string value; ///< as TOML: `10000`, `"linear"`, `true`; of a missing one what to write there
  Certainty certainty = Certainty::Sure;
  std::string source; ///< where it comes from, for the report; empty: the file itself
};

/// A parameter of which the file says only the number.
struct NumberedParameter {
  int number = 0;
  std::string value;
};

/// A drive (an axis), or an encoder.
struct DriveSetup {
  std::string name; ///< that of its AXIS_REF or SMC_ENCODER_REF
  std::vector<Parameter> parameters;
  Origin origin;
  std::vector<NumberedParameter> numbered{}; ///< what a configuration file gives names to
};

/// Drives that one task serves.
struct DriveGroupSetup {
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<DriveSetup> drives;
  Origin origin;
  std::vector<DriveSetup> encoders{};
  std::vector<NumberedParameter> numbered{};
};

/// A bus; always of simulated drives, for other tools' drivers are not ours.
struct BusSetup {
  std::string name;
  std::vector<DriveGroupSetup> groups;
  Origin origin;
};

/// A named input or output of the hardware: it becomes a global variable at its address.
struct IoChannel {
  std::string name;    ///< of the variable
  std::string address; ///< `%IX0.0`
  std::string type;    ///< `BOOL`
  std::string comment; ///< empty: none
  Origin origin;
};

/// A channel of the hardware, named or not: what addresses are counted by.
struct HardwareChannel {
  std::string address; ///< as in the file: `%IW0.4.2`
  Origin origin;
};

/// An address that had to change.
struct MovedAddress {
  std::string from; ///< as in the file: `%IX0.0.0.0`
  std::string to;   ///< `%IX0.0`
};

/// A section of stride.toml that an export of Stride has kept.
struct ManifestSection {
  std::string name; ///< `bus`
  std::string text; ///< as it is written
  Origin origin;
};

/// A file that belongs to a project as well: it is read when it exists and has not been read.
struct FileReference {
  std::string path; ///< with `/`, from the folder of the file that names it
  Origin origin;
};

/// Which drive a variable of the program stands for, where the tool keeps both apart.
struct AxisLink {
  std::string variable; ///< `MAIN.Feed`
  std::string drive;    ///< as DriveSetup::name
  Origin origin;
};

/// All files of one import.
struct Model {
  size_t files = 0;                         ///< that were read
  std::vector<std::string> assumedEncoding; ///< those that do not say their encoding
  std::vector<std::string> notes;           ///< what the user is to look at, a sentence each
  std::vector<Object> objects;
  std::vector<Task> tasks;
  std::vector<LibraryReference> libraries;
  std::vector<BusSetup> buses;
  std::vector<IoChannel> channels;
  std::vector<HardwareChannel> hardware; ///< in the order of the configuration
  std::vector<MovedAddress> addresses;
  std::vector<ManifestSection> sections;
  std::string addressing; ///< [image] addressing of stride.toml; empty: not said
  std::vector<FileReference> references;
  std::vector<FileReference> excluded; ///< files that a project has, but does not build
  std::vector<AxisLink> axisLinks;
  std::vector<std::string> named; ///< Stride's libraries that stride.toml must name
  std::vector<KeptText> kept;
  std::vector<DrawnBody> drawn;        ///< marks in the objects' texts
  std::optional<size_t> configuration; ///< which of `kept` is the PLC configuration that was read
  std::vector<Remark> changed;
  std::vector<Remark> leftOut;    ///< losses
  std::vector<Remark> unreadable; ///< files of which nothing was taken
};

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_MODEL_HPP
