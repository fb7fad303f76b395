// Commands whose calls of the system fail: the third write, every rename from the second on.
#ifndef STRIDE_TESTS_SUPPORT_FAULT_INJECTION_HPP
#define STRIDE_TESTS_SUPPORT_FAULT_INJECTION_HPP

#include "tests/support/process.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace stride::test {

/// Calls that are counted together.
enum class CallClass : uint8_t {
  Open,   ///< of files to be written or made, in the folder of the command or below it
  Write,  ///< to files there, pipes and what standard output and error are
  Sync,   ///< fsync, fdatasync
  Rename, ///< and link, symlink
  Folder, ///< mkdir
  Resize, ///< ftruncate, fallocate, chmod
  Socket, ///< socket, bind, listen, accept
  Send,   ///< to sockets
};

/// Which call fails, and how.
struct Fault {
  CallClass what = CallClass::Write;
  unsigned nth = 0;     ///< From 1; 0: none, they are only counted.
  int error = 0;        ///< errno
  bool onwards = false; ///< All after it, too.
};

/// What came of it.
struct FaultedRun {
  ProcessResult result; ///< 128 + n: signal n has ended it; 128 + SIGKILL: it took too long.
  unsigned calls = 0;   ///< Of that class, in the command and all that it started.
  bool tooLong = false;
};

/// As runProcess(), with a fault in the command and in all that it starts, whatever libraries they
/// use. A command that takes longer than `seconds` is killed. Nothing when the system does not let
/// calls be intercepted (seccomp's user notification).
FaultedRun runWithFault(const std::vector<std::string> &arguments,
                        const std::filesystem::path &directory, const Fault &fault,
                        const std::vector<std::pair<std::string, std::string>> &environment = {},
                        int seconds = 60);

/// Whether this system lets calls be intercepted.
bool canInjectFaults();

} // namespace stride::test

#endif // STRIDE_TESTS_SUPPORT_FAULT_INJECTION_HPP
