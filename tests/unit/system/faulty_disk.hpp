// A disk that is slow or reports errors: pwrite, write and fsync of this program.
#pragma once

#include <atomic>

namespace stride::test {

struct FaultyDisk {
  std::atomic<int> delayMs{0};
  std::atomic<int> error{0}; ///< errno of everything that writes.
};
FaultyDisk &faultyDisk();

} // namespace stride::test
