// The three open files a program is started with.
#ifndef STRIDE_RUNTIME_COMMON_STANDARD_HANDLES_HPP
#define STRIDE_RUNTIME_COMMON_STANDARD_HANDLES_HPP

#include <array>

#include <fcntl.h>
#include <unistd.h>

namespace stride::common {

/// Gives standard input, output and error a file each where whoever started the program has closed
/// them; else the next file that is opened gets their number, and whatever is said goes into it.
/// To be called before any file is opened. Reading input and writing output then fail, as they do
/// with a closed file, so that results are not lost in silence; messages that nobody wanted are.
inline void openStandardHandles() noexcept {
  constexpr std::array<int, 3> kModes = {O_WRONLY, O_RDONLY, O_WRONLY};
  for (int handle = 0; handle < 3; ++handle) {
    // The lowest free number is taken: the one that was looked for.
    if (::fcntl(handle, F_GETFD) < 0)
      static_cast<void>(::open("/dev/null", kModes[static_cast<size_t>(handle)]));
  }
}

} // namespace stride::common

#endif
