// A few thousand mutated sources through check, fmt and code generation. More of them, or others:
// STRIDE_MUTATIONS=<first>:<count>; what fails is left in STRIDE_MUTATIONS_OUT, if that is a
// folder.
#include "tests/fuzz/commands.hpp"
#include "tests/fuzz/mutation_campaign.hpp"
#include "tests/support/text.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace stride::fuzz {
namespace {

struct Range {
  uint64_t first = 0;
  uint64_t count = 2000;
};

Range rangeToRun() {
  Range range;
  if (const char *given = std::getenv("STRIDE_MUTATIONS"))
    std::sscanf(given, "%lu:%lu", &range.first, &range.count);
  return range;
}

std::vector<std::string> corpus() {
  const std::filesystem::path root = STRIDE_SOURCE_DIR;
  std::vector<std::string> all = readSources(
      {root / "tests/golden", root / "examples", root / "stdlib", root / "tests/fuzz"}, 12'000);
  for (std::string &project :
       readProjects({root / "tests/golden/projects", root / "examples"}, kFileMark, 12'000))
    all.push_back(std::move(project));
  return all;
}

TEST(Mutation, PiecesMakeUpTheWhole) {
  for (const std::string &source : corpus()) {
    std::string whole;
    for (const Piece &piece : cutIntoPieces(source)) {
      ASSERT_FALSE(piece.text.empty());
      whole += piece.text;
    }
    ASSERT_EQ(whole, source);
  }
}

TEST(Mutation, CommandsSurvive) {
  const TokenMutator mutator(corpus());
  ASSERT_GT(mutator.corpus().size(), 1000U);
  const Range range = rangeToRun();
  const test::ScratchDirectory scratch;
  const Campaign campaign =
      runCampaign(mutator, range.first, range.count, scratch.path() / "project");
  for (const Failure &failure : campaign.failures) {
    ADD_FAILURE() << "source " << failure.number << " ended by signal " << failure.signal << ":\n"
                  << failure.source.substr(0, 2000);
    if (const char *out = std::getenv("STRIDE_MUTATIONS_OUT"))
      std::ofstream(std::filesystem::path(out) / (std::to_string(failure.number) + ".st"))
          << failure.source;
  }
  std::printf("slowest: source %lu, %.2f s\n", campaign.slowest, campaign.slowestSeconds);
}

} // namespace
} // namespace stride::fuzz
