#ifndef STRIDE_TESTS_FUZZ_PATH_CHAIN_HPP
#define STRIDE_TESTS_FUZZ_PATH_CHAIN_HPP
// Chains of path processors with any queue and any objects whatever, for path_processors_fuzz and
// path_chain_test.

#include <cstddef>
#include <cstdint>
#include <string>

namespace stride::fuzz {

/// Makes processors, queues and objects of the bytes and runs them to the end. Returns what is
/// wrong: a processor that does not end, or that puts out more than it may. Empty: nothing. That
/// nothing else is written is up to the sanitizers.
[[nodiscard]] std::string runPathChain(const uint8_t *data, size_t size);

} // namespace stride::fuzz

#endif // STRIDE_TESTS_FUZZ_PATH_CHAIN_HPP
