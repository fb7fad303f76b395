// A process that saves without a pause is killed at random moments, again and again.
#include "runtime/app/retain_store.hpp"
#include "tests/unit/app/app_model.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <csignal>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using namespace stride;

#ifdef __SANITIZE_ADDRESS__ // a fork takes a hundred times as long, and saving is the smaller part
constexpr int kKills = 50;
constexpr int kWithin = 0;
#else
constexpr int kKills = 500;
constexpr int kWithin = 5;
#endif
constexpr int64_t kWords = 20000;

struct Subject {
  test::AppModel model;
  std::optional<app::RetainLayout> layout;
  std::vector<std::byte> encoded;
  Subject() {
    model.root("G", "x", model.array(model.elementary(Kind::UDINT), 1, kWords), kSymRetain);
    layout.emplace(model.finish(), app::kRetained);
    encoded = layout->encode();
  }
};

struct Folder {
  explicit Folder(std::string pattern) : path(std::move(pattern)) {
    if (::mkdtemp(path.data()) == nullptr)
      throw std::runtime_error("no folder like " + path);
  }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;
  ~Folder() { std::filesystem::remove_all(path); }
  std::string path;
};

/// The child: goes on from what it finds, and says each generation that is safe.
[[noreturn]] void saveWithoutEnd(const Subject &subject, const std::string &file, int pipe) {
  app::RetainStore store(file);
  std::vector<std::string> problems;
  uint32_t generation = 0;
  if (const std::optional<app::RetainImage> image = store.load(problems))
    std::memcpy(&generation, image->values.data(), sizeof generation);
  for (;;) {
    ++generation;
    const std::vector<uint32_t> values(kWords, generation);
    store.save("model", 1, subject.encoded, std::as_bytes(std::span(values)));
    if (::write(pipe, &generation, sizeof generation) != sizeof generation)
      ::_exit(1);
  }
}

std::chrono::microseconds durationOfASave(const Subject &subject, const std::string &file) {
  app::RetainStore store(file);
  const std::vector<uint32_t> values(kWords);
  const auto start = std::chrono::steady_clock::now();
  store.save("model", 1, subject.encoded, std::as_bytes(std::span(values)));
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() -
                                                               start);
}

TEST(RetainKill, EveryKillLeavesACompleteImageThatIsNotOlderThanTheLastAcknowledged) {
  // In memory where possible: a kill leaves the system's cache alone, so the disk shows nothing
  // more.
  const Folder folder(std::filesystem::is_directory("/dev/shm") ? "/dev/shm/stride-XXXXXX"
                                                                : "/tmp/stride-XXXXXX");
  const std::string file = folder.path + "/retain";
  const Subject subject;
  std::mt19937 random(12345);
  const std::chrono::microseconds aSave = durationOfASave(subject, folder.path + "/measured");
  uint32_t acknowledged = 0;
  int within = 0; // kills while a save was under way
  for (int kill = 0; kill < kKills; ++kill) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
      saveWithoutEnd(subject, file, ends[1]);
    ::close(ends[1]);
    // Some saves, then a part of the next one, however fast they are here.
    uint32_t generation = 0;
    for (int saves = std::uniform_int_distribution<int>(0, 3)(random); saves > 0; --saves) {
      ASSERT_EQ(::read(ends[0], &generation, sizeof generation), ssize_t{sizeof generation});
      acknowledged = generation;
    }
    ::usleep(std::uniform_int_distribution<useconds_t>(0, static_cast<useconds_t>(aSave.count()))(
        random));
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
    while (::read(ends[0], &generation, sizeof generation) == sizeof generation)
      acknowledged = generation;
    ::close(ends[0]);
    app::RetainStore store(file);
    std::vector<std::string> problems;
    const std::optional<app::RetainImage> image = store.load(problems);
    ASSERT_TRUE(problems.empty()) << problems[0];
    if (!image) {
      ASSERT_EQ(acknowledged, 0U);
      continue;
    }
    std::vector<uint32_t> values(kWords);
    ASSERT_EQ(image->values.size(), kWords * sizeof(uint32_t));
    std::memcpy(values.data(), image->values.data(), image->values.size());
    for (const uint32_t value : values)
      ASSERT_EQ(value, values[0]) << "torn";
    ASSERT_GE(values[0], acknowledged);
    within += values[0] > acknowledged || ::access((file + ".new").c_str(), F_OK) == 0 ? 1 : 0;
    acknowledged = values[0];
  }
  EXPECT_GE(acknowledged, static_cast<uint32_t>(kKills));
  EXPECT_GE(within, kWithin);
}

} // namespace
