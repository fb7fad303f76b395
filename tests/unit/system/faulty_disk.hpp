// A disk that is slow or reports errors: pwrite, write and fsync of this program.
#ifndef STRIDE_TESTS_UNIT_SYSTEM_FAULTY_DISK_HPP
#define STRIDE_TESTS_UNIT_SYSTEM_FAULTY_DISK_HPP

#include <atomic>

namespace stride::test {

struct FaultyDisk {
  std::atomic<int> delayMs{0};
  std::atomic<int> error{0}; ///< errno of everything that writes.
};
FaultyDisk &faultyDisk();

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_SYSTEM_FAULTY_DISK_HPP
