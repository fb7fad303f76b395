// Many mutated sources through the commands, each crash caught and kept.
#ifndef STRIDE_TESTS_FUZZ_MUTATION_CAMPAIGN_HPP
#define STRIDE_TESTS_FUZZ_MUTATION_CAMPAIGN_HPP

#include "tests/fuzz/token_mutator.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stride::fuzz {

/// A source that ended the process that worked on it.
struct Failure {
  uint64_t number = 0;
  int signal = 0; ///< SIGPROF: it took too long
  std::string source;
};

struct Campaign {
  std::vector<Failure> failures;
  double slowestSeconds = 0; ///< of processor time
  uint64_t slowest = 0;      ///< its number
};

/// Source `number` of all that can be made from the corpus; sometimes of several files.
[[nodiscard]] std::string mutatedSource(const TokenMutator &mutator, uint64_t number);

/// Runs the commands on the sources `first` … `first + count - 1` in child processes, which use
/// `folder`. Gives up after 20 failures. Throws std::system_error when no process can be started.
[[nodiscard]] Campaign runCampaign(const TokenMutator &mutator, uint64_t first, uint64_t count,
                                   const std::filesystem::path &folder);

} // namespace stride::fuzz

#endif // STRIDE_TESTS_FUZZ_MUTATION_CAMPAIGN_HPP
