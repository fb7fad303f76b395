// Which of the two files of retained data a save goes to, and which image is read.
#include "runtime/app/retain_store.hpp"
#include "tests/unit/retain/fake_disk.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace {

using namespace stride;
using app::RetainStore;
using test::FakeFiles;
using test::Generations;
using test::outcomes;
using test::PowerCut;

/// The sequence number of the image in a file; 0: there is none, or it is no image.
uint64_t sequenceIn(FakeFiles &files, const char *ending) {
  std::vector<std::byte> bytes;
  if (files.read(std::string("/folder/file") + ending, bytes) != 0)
    return 0;
  try {
    return app::decodeImage(bytes).head.sequence;
  } catch (const app::Error &) {
    return 0;
  }
}

/// What each file holds before a start: so many saves old, 0: no file, -1: one that is torn.
struct Before {
  int a, b;
};

/// The first save after a start goes to the older file: if it turns out to be damaged later, the
/// image that was loaded is still there.
TEST(RetainStore, TheFirstSaveAfterAStartKeepsTheImageThatWasLoaded) {
  const Generations generations;
  for (const Before before : {Before{0, 0}, Before{1, 0}, Before{0, 1}, Before{1, 2}, Before{2, 1},
                              Before{3, 2}, Before{2, 3}, Before{5, 2}, Before{2, 5}, Before{-1, 4},
                              Before{4, -1}, Before{-1, 0}, Before{0, -1}}) {
    SCOPED_TRACE(std::to_string(before.a) + " and " + std::to_string(before.b));
    FakeFiles files;
    const auto put = [&](const char *ending, int sequence) {
      if (sequence == 0)
        return;
      FakeFiles other;
      RetainStore store("/folder/file", other);
      for (int i = 0; i < std::max(sequence, 1); ++i)
        generations.save(store, static_cast<uint32_t>(std::max(sequence, 1)));
      std::vector<std::byte> bytes;
      ASSERT_EQ(other.read(sequence % 2 == 0 ? "/folder/file.b" : "/folder/file.a", bytes), 0);
      if (sequence < 0)
        bytes.back() ^= std::byte{1};
      int handle = -1;
      ASSERT_EQ(files.create(std::string("/folder/file") + ending, handle), 0);
      ASSERT_EQ(files.write(handle, bytes), 0);
    };
    put(".a", before.a);
    put(".b", before.b);
    const int newest = std::max({before.a, before.b, 0});

    RetainStore store("/folder/file", files);
    std::vector<std::string> problems;
    EXPECT_EQ(Generations::load(store, problems), static_cast<uint32_t>(newest));
    EXPECT_EQ(problems.size(), before.a < 0 || before.b < 0 ? 1U : 0U);
    const auto held = [&] { return std::set{sequenceIn(files, ".a"), sequenceIn(files, ".b")}; };
    uint64_t last = static_cast<uint64_t>(newest);
    for (int i = 0; i < 3; ++i) {
      generations.save(store, 77);
      EXPECT_EQ(held(), (std::set<uint64_t>{last, last + 1})) << "after save " << i + 1;
      ++last;
    }
  }
}

/// Whatever the files' times say: the newest image is the last to go.
TEST(RetainStore, ClearingNeverLeavesOnlyAnOlderImage) {
  const Generations generations;
  for (uint32_t saves = 1; saves <= 3; ++saves) {
    FakeFiles filled;
    {
      RetainStore store("/folder/file", filled);
      for (uint32_t i = 1; i <= saves; ++i)
        generations.save(store, i);
    }
    bool through = false;
    for (int cut = 0; !through; ++cut) {
      const std::unique_ptr<FakeFiles> files = filled.copy();
      files->callsLeft = cut;
      try {
        RetainStore("/folder/file", *files).clear();
        through = true;
      } catch (const PowerCut &) {
        through = false;
      }
      for (const std::vector<size_t> &order : outcomes(files->pending().size())) {
        const std::unique_ptr<FakeFiles> after = files->copy();
        after->restart(order);
        RetainStore store("/folder/file", *after);
        std::vector<std::string> problems;
        const uint32_t found = Generations::load(store, problems);
        EXPECT_TRUE(found == saves || found == 0) << found << " of " << saves;
        EXPECT_FALSE(through && found != 0);
      }
    }
  }
}
} // namespace
