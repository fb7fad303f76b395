// The command line of stride-host.
#ifndef STRIDE_RUNTIME_HOST_OPTIONS_HPP
#define STRIDE_RUNTIME_HOST_OPTIONS_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stride::host {

/// `--set T,PATH=VALUE`.
struct SetOption {
  int64_t timeNs = 0;
  std::string path;
  std::string value;
  std::string text; ///< As it was given, for messages.
};

/// `--change T,FILE`: a new build takes over.
struct ChangeOption {
  int64_t timeNs = 0;
  std::string path;
};

/// `stride-host sim`.
struct SimOptions {
  std::string application;
  int64_t durationNs = 0;
  std::vector<std::string> trace;    ///< Paths, in the order given.
  std::string out;                   ///< File of the trace; empty or "-": standard output.
  std::vector<SetOption> sets;       ///< In the order given.
  std::vector<ChangeOption> changes; ///< In the order of their times.
  std::vector<std::string> print;    ///< Paths, in the order given.
  std::string script;                ///< File of an input script; or empty.
  std::string replay;                ///< A recording to be repeated; or empty.
  int64_t loopBudget = 0;            ///< Loop iterations per cycle; 0: the default.
  bool stateHash = false;            ///< Print a hash of the state at the end.
  bool quiet = false;                ///< No progress and no summary.
  bool summary = false;              ///< A summary even when standard error is no terminal.
  std::string retain;    ///< File for RETAIN and PERSISTENT variables; empty: they are not kept.
  std::string files;     ///< Folder for the program's files; empty: the application's own.
  std::string canLog;    ///< File for the frames of CAN buses; or empty.
  std::string canReplay; ///< Such a file, in place of the bus; or empty.
};

/// What happens when an exception has stopped an application.
enum class OnFault : uint8_t {
  Stop,    ///< It stays stopped.
  Restart, ///< It starts anew, with its initial values (and what is retained).
};

/// `stride-host run`.
struct RunOptions {
  std::vector<std::string> applications;
  std::string name;   ///< Of the one application, where it carries none; or empty.
  std::string latest; ///< Where an online change finds the new build; empty: where the old one is.
  int64_t durationNs = 0;           ///< 0: until a signal.
  std::vector<std::string> trace;   ///< Paths, or NAME:PATH, in the order given.
  std::string out;                  ///< File of the trace; empty or "-": standard output.
  std::vector<std::string> print;   ///< Paths, or NAME:PATH, in the order given.
  std::vector<std::string> scripts; ///< Input scripts: FILE or NAME=FILE.
  std::string listen;               ///< `unix:PATH`, the socket of the monitor; or empty.
  std::string record;               ///< File for the inputs of the run; or empty.
  OnFault onFault = OnFault::Stop;
  bool acceptLosses = false; ///< An online change may lose values.
  std::string retain; ///< File for RETAIN and PERSISTENT variables; empty: the application's own.
  std::string files;  ///< Folder for the program's files; empty: the application's own.
  std::string canLog; ///< File for the frames of CAN buses; or empty.
  std::optional<uint32_t> core; ///< For tasks that choose none; empty: the last one allowed.
  bool turns = false;           ///< One cycle at a time.
  bool histogram = false;       ///< Distributions after the table of statistics.
  std::string statistics;       ///< File for the statistics as JSON; or empty.
  bool quiet = false;           ///< Neither warnings about real time nor statistics.
};

/// A duration in nanoseconds: T#1s500ms, LTIME#2us, or without the prefix 5s, 500ms. Throws
/// app::Error when the text is no duration or not positive (zero is allowed with `zeroAllowed`).
int64_t parseDuration(std::string_view text, bool zeroAllowed);

/// Splits at commas outside of brackets, without blanks around the parts: "a[1,2], b" is two paths.
std::vector<std::string> splitPaths(std::string_view text);

/// `T#3s,Ipo.p=50`. Throws app::Error.
SetOption parseSet(const std::string &text);

/// `T#3s,build/app.so`. Throws app::Error.
ChangeOption parseChange(const std::string &text);

} // namespace stride::host

#endif
