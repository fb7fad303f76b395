// The SYNC of the simulated bus.
#include "drivers/dummy/dummy_drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace stride::dummy {
namespace {

/// Virtual time.
struct Clock final : bus::BusClock {
  int64_t nowNs() const noexcept override { return now; }
  void sleepUntil(int64_t timeNs) noexcept override { now = std::max(now, timeNs); }
  int64_t monotonicNs(int64_t) const noexcept override { return INT64_MAX; }
  int64_t now = 0;
};

/// What a driver says and raises.
struct Host final : bus::DriverHost {
  void raise(bus::BusEvent event) noexcept override { syncs += event == bus::BusEvent::Sync; }
  void say(const bus::Message &text) noexcept override { news.emplace_back(text.text()); }
  int syncs = 0;
  std::vector<std::string> news;
};

constexpr int64_t kUs = 1000;

/// SYNC every millisecond.
struct Sync : ::testing::Test {
  void make(double offset, double lost) {
    bus::GroupSetup setup(kSchema, 0.001);
    setup.parameters.add({"simulation.sync_offset", "", offset});
    if (lost != 0)
      setup.parameters.add({"simulation.sync_lost", "", lost});
    driver.emplace(setup);
    driver->attach(host);
  }
  /// As a scheduler does it.
  bus::SyncWake next(int64_t limit = 1500 * kUs) {
    const bus::SyncWake wake = driver->waitSync(last, std::max<int64_t>(last, 0) + limit, clock);
    last = wake.timeNs;
    return wake;
  }
  std::string problem() const {
    bus::Message text;
    driver->problem(text);
    return std::string(text.text());
  }
  std::optional<DummyDriver> driver;
  Host host;
  Clock clock;
  int64_t last = -1;
};

TEST_F(Sync, ComesEveryCycleFromTheBeginning) {
  make(0, 0);
  for (int64_t i = 0; i < 5; ++i) {
    const bus::SyncWake wake = next();
    EXPECT_EQ(wake.timeNs, i * 1000 * kUs);
    EXPECT_TRUE(wake.arrived);
    EXPECT_EQ(wake.missed, 0U);
    driver->executeStart();
    driver->executeEnd();
  }
  EXPECT_EQ(host.syncs, 5);
  EXPECT_TRUE(host.news.empty());
  EXPECT_EQ(problem(), "");
}

TEST_F(Sync, HasAnOffset) {
  make(250e-6, 0);
  EXPECT_EQ(next().timeNs, 250 * kUs);
  EXPECT_EQ(next().timeNs, 1250 * kUs);
}

TEST_F(Sync, ThatIsLostLetsTheTaskRunAtTheDeadline) {
  make(0, 3); // 0 1 . 3 4 . 6
  std::string seen;
  for (int i = 0; i < 8; ++i) {
    const bus::SyncWake wake = next();
    seen += std::to_string(wake.timeNs / kUs) + (wake.arrived ? " " : "! ");
    driver->executeStart();
    driver->executeEnd();
    EXPECT_EQ(problem(), wake.arrived ? "" : "no SYNC for 1500 us: the task has run without it");
  }
  EXPECT_EQ(seen, "0 1000 2500! 3000 4000 5500! 6000 7000 ");
  EXPECT_EQ(host.syncs, 6) << "what did not come raises nothing";
  ASSERT_EQ(host.news.size(), 2U);
  EXPECT_EQ(host.news[0], "no SYNC for 1500 us: the task has run without it");
}

TEST_F(Sync, ThatComesDuringACycleCountsAndTheLastOneServes) {
  make(0, 3);
  EXPECT_EQ(next().timeNs, 0);
  clock.now = 999 * kUs; // in time
  EXPECT_EQ(next().timeNs, 1000 * kUs);
  clock.now = 6200 * kUs; // 3, 4 and 6 have come
  const bus::SyncWake wake = next();
  EXPECT_EQ(wake.timeNs, 6000 * kUs);
  EXPECT_TRUE(wake.arrived);
  EXPECT_EQ(wake.missed, 2U);
  clock.now = 8100 * kUs; // 7 has come, 8 is a lost one
  const bus::SyncWake lost = next();
  EXPECT_EQ(lost.timeNs, 7000 * kUs);
  EXPECT_EQ(lost.missed, 0U);
  EXPECT_EQ(clock.now, 8100 * kUs) << "at once";
}

TEST_F(Sync, IsRaisedInEveryCycleWhereTheTaskGivesIt) {
  make(0, 2);
  for (int i = 0; i < 4; ++i)
    driver->executeStart(); // nobody waits
  EXPECT_EQ(host.syncs, 4);
}
} // namespace
} // namespace stride::dummy
