// The lock-free ways between the server and a task, with a thread at each end. Built with
// ThreadSanitizer, together with the sources that it is about.
#include "runtime/monitor/handover.hpp"
#include "runtime/monitor/symbol_server.hpp"
#include "tests/unit/app/fixture.hpp"

#include <random>
#include <thread>

namespace {

using namespace stride::monitor;

constexpr auto kLong = std::chrono::milliseconds(1500);

/// Calls cycles as fast as it can until it is told to end.
class Cycles {
public:
  explicit Cycles(stride::task::TaskSet &tasks)
      : thread_([this, &tasks] {
          for (int64_t time = 0; !end_.load(); time += 10'000'000) {
            tasks.runCycle(0, time, 0);
            tasks.runCycle(1, time, 0);
          }
        }) {}
  ~Cycles() {
    end_.store(true);
    thread_.join();
  }

private:
  std::atomic<bool> end_{false};
  std::thread thread_;
};

class Stress : public stride::test::HandmadeApp {
protected:
  Stress()
      : tasks(application.description(), application.state(), stride::task::hostApi(),
              stride::task::LoopLimit::Budget),
        server(tasks) {
    server.addOuterHooks();
    server.addInnerHooks();
  }
  std::string shown(const SymbolRequest &request, size_t i) const {
    const SymbolRequest::Value &value = request.values()[i];
    return stride::app::formatLiteral(symbols.app(), symbols.type(value.symbol),
                                      request.bytes(value));
  }

  stride::task::TaskSet tasks;
  SymbolServer server;
};

TEST_F(Stress, WhatIsReadTogetherBelongsTogether) {
  const Cycles cycles(tasks);
  std::mt19937 random(1);
  const auto end = std::chrono::steady_clock::now() + kLong;
  int reads = 0;
  while (std::chrono::steady_clock::now() < end) {
    const std::string number = std::to_string(random() % 10000);
    (void)server.write({{"PLC_PRG.count", number}});
    // The program copies its count into a[2,-1], and its value into pt.x.
    const auto request =
        server.read({"PLC_PRG.count", "PLC_PRG.a[2,-1]", "PLC_PRG.value", "PLC_PRG.pt.x"});
    ASSERT_TRUE(SymbolServer::wait(*request, std::chrono::seconds(20)));
    ASSERT_EQ(shown(*request, 0), shown(*request, 1));
    ASSERT_EQ(shown(*request, 2), shown(*request, 3));
    ++reads;
  }
  EXPECT_GT(reads, 10);
}

TEST_F(Stress, ForcesComeAndGo) {
  const Cycles cycles(tasks);
  const auto end = std::chrono::steady_clock::now() + kLong;
  for (int i = 0; std::chrono::steady_clock::now() < end; ++i) {
    const std::string number = std::to_string(i % 30000);
    server.force({{"PLC_PRG.count", number}});
    const auto written = server.write({{"PLC_PRG.count", "-1"}});
    const auto request = server.read({"PLC_PRG.count"});
    if (i % 3 == 0)
      server.release({"PLC_PRG.count"});
    ASSERT_TRUE(SymbolServer::wait(*request, std::chrono::seconds(20)));
    if (i % 3 != 0) {
      while (!server.forcesTaken())
        std::this_thread::yield();
      const auto again = server.read({"PLC_PRG.count"});
      ASSERT_TRUE(SymbolServer::wait(*again, std::chrono::seconds(20)));
      ASSERT_EQ(shown(*again, 0), number);
    }
  }
}

TEST_F(Stress, RecordersComeAndGo) {
  const Cycles cycles(tasks);
  const auto end = std::chrono::steady_clock::now() + kLong;
  for (int i = 0; std::chrono::steady_clock::now() < end; ++i) {
    RecorderSettings settings;
    settings.names = {"PLC_PRG.count", "PLC_PRG.a[2,-1]"};
    settings.rows = 20;
    settings.before = 0.5;
    settings.trigger = TriggerSettings{"PLC_PRG.flag", TriggerEdge::Rising, ""};
    const auto recorder = std::make_shared<Recorder>(symbols, settings);
    server.setRecorder(recorder);
    if (i % 2 == 0)
      continue; // replaced at once
    if (i % 5 == 0)
      recorder->stop();
    while (recorder->state() != Recorder::State::Done)
      std::this_thread::yield();
    for (size_t row = 0; row < recorder->rows(); ++row) {
      std::string line;
      recorder->appendLine(row, line);
      const size_t first = line.find(',');
      const size_t second = line.find(',', first + 1);
      ASSERT_EQ(line.substr(first, second - first), line.substr(second));
    }
  }
}

TEST(HandoverStress, TheNewestVersionAndNothingElse) {
  Handover<const std::vector<int>> handover;
  std::atomic<bool> end{false};
  std::atomic<bool> good{true};
  std::thread cyclic([&] {
    int last = 0;
    while (!end.load()) {
      const std::vector<int> *now = handover.take();
      if (now == nullptr)
        continue;
      if (now->front() < last || now->front() != now->back())
        good.store(false);
      last = now->front();
    }
  });
  for (int i = 1; i < 20000; ++i)
    handover.publish(std::make_unique<const std::vector<int>>(8, i));
  while (!handover.taken())
    std::this_thread::yield();
  end.store(true);
  cyclic.join();
  EXPECT_TRUE(good.load());
  EXPECT_EQ(handover.current()->front(), 19999);
}

} // namespace
