// Reading, writing and forcing while cycles run.
#include "runtime/monitor/symbol_list.hpp"
#include "tests/unit/monitor/served_app.hpp"

#include <cstring>
#include <gmock/gmock-more-matchers.h>

namespace stride::test {
size_t allocations();
}

namespace {

using namespace stride::monitor;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

class SymbolServing : public stride::test::ServedApp {};

TEST_F(SymbolServing, ReadsAtTheEndOfTheCycle) {
  const auto request = server.read({"PLC_PRG.count", "PLC_PRG.pt", "PLC_PRG.p.x", "kMax"});
  EXPECT_FALSE(request->done());
  run();
  ASSERT_TRUE(request->done());
  EXPECT_TRUE(server.valid(*request));
  EXPECT_EQ(shown(*request), "1 0.1 0.0 0.1 70000"); // the pointer is set in the first cycle
  EXPECT_EQ(request->timeNs(), 0);
  server.again(request);
  EXPECT_FALSE(request->done());
  run();
  EXPECT_EQ(shown(*request), "2 0.2 0.0 0.2 70000");
  EXPECT_EQ(request->timeNs(), 10'000'000);
}

TEST_F(SymbolServing, WritesAtTheStartOfTheCycle) {
  const auto write = server.write({{"PLC_PRG.count", "41"}, {"PLC_PRG.color", "blue"}});
  const auto read = server.read({"PLC_PRG.count", "PLC_PRG.color"});
  run();
  EXPECT_TRUE(write->done());
  EXPECT_EQ(shown(*read), "42 blue"); // the program has counted on
}

TEST_F(SymbolServing, TheOrderOfRequestsIsKept) {
  const auto before = server.read({"total"});
  const auto write = server.write({{"total", "100"}});
  const auto after = server.read({"total"});
  run();
  EXPECT_EQ(shown(*before), "2");
  EXPECT_FALSE(write->done());
  run();
  EXPECT_EQ(shown(*after), "102");
}

TEST_F(SymbolServing, EachTaskServesItsProgram) {
  const auto request = server.read({"PLC_PRG.count", "Slow.runs", "total", "Slow.runs"});
  run();
  EXPECT_FALSE(request->done());
  tasks.runCycle(1, timeNs, 0);
  ASSERT_TRUE(request->done());
  EXPECT_EQ(shown(*request), "1 1 2 1");
}

TEST_F(SymbolServing, WorkPerCycleIsBounded) {
  std::vector<std::string> names(SymbolServer::kValuesPerRequest, "PLC_PRG.flag");
  const auto first = server.read(names);
  const auto second = server.read({"total"});
  run();
  EXPECT_TRUE(first->done());
  EXPECT_FALSE(second->done());
  run();
  EXPECT_TRUE(second->done());
  names.push_back("total");
  EXPECT_THAT(errorOf([&] { (void)server.read(names); }), HasSubstr("2001 values at once"));
}

TEST_F(SymbolServing, NullPointersAreNotReached) {
  const auto read = server.read({"PLC_PRG.p.x"});
  const auto write = server.write({{"PLC_PRG.p.x", "1.0"}});
  application.initialise(stride::test::kThrowingHost);
  run();
  EXPECT_EQ(shown(*read), "0.1");
  application.initialise(stride::test::kThrowingHost);
  run();
  ASSERT_TRUE(write->done());
  EXPECT_FALSE(write->values()[0].reached);
}

TEST_F(SymbolServing, ForcedVariablesKeepTheirValue) {
  server.force({{"PLC_PRG.count", "7"}, {"plc_prg.pt.X", "2.5"}});
  EXPECT_FALSE(server.forcesTaken());
  run();
  EXPECT_EQ(read("PLC_PRG.count"), "7");
  EXPECT_EQ(read("PLC_PRG.a[2,-1]"), "8"); // the program has counted and copied
  EXPECT_EQ(read("PLC_PRG.pt.x"), "2.5");
  EXPECT_THAT(server.forced(),
              ElementsAre(Pair("PLC_PRG.count", "7"), Pair("plc_prg.pt.X", "2.5")));
  server.force({{"PLC_PRG.COUNT", "70"}});
  server.release({"PLC_PRG.pt.x"});
  run();
  EXPECT_EQ(read("PLC_PRG.count"), "70");
  EXPECT_EQ(read("PLC_PRG.pt.x"), "0.2");
  EXPECT_THAT(server.forced(), ElementsAre(Pair("PLC_PRG.count", "70")));
  server.releaseAll();
  run();
  EXPECT_EQ(read("PLC_PRG.count"), "71");
  EXPECT_THAT(server.forced(), IsEmpty());
}

TEST_F(SymbolServing, ForcesApplyInEveryTask) {
  server.force({{"Slow.runs", "5"}});
  tasks.runCycle(0, 0, 0);
  EXPECT_FALSE(server.forcesTaken());
  tasks.runCycle(1, 0, 0);
  EXPECT_TRUE(server.forcesTaken());
  EXPECT_EQ(read("Slow.runs"), "5");
}

TEST_F(SymbolServing, MistakesChangeNothing) {
  server.force({{"total", "1"}});
  EXPECT_THAT(errorOf([&] {
                server.force({{"total", "2"}, {"totel", "2"}});
              }),
              HasSubstr("did you mean 'total'?"));
  EXPECT_THAT(errorOf([&] {
                server.release({"total", "GVL.limit"});
              }),
              HasSubstr("'GVL.limit' is not forced"));
  EXPECT_THAT(errorOf([&] { server.force({{"kMax", "2"}}); }), HasSubstr("it is a constant"));
  EXPECT_THAT(errorOf([&] { (void)server.write({{"PLC_PRG.pt", "2"}}); }), HasSubstr("its parts"));
  EXPECT_THAT(errorOf([&] { (void)server.read({"PLC_PRG.p"}); }), HasSubstr("has no value"));
  EXPECT_THAT(errorOf([&] { (void)server.read({}); }), HasSubstr("no variable is named"));
  EXPECT_THAT(server.forced(), ElementsAre(Pair("total", "1")));
}

TEST_F(SymbolServing, ATaskThatDoesNotRun) {
  for (size_t i = 0; i < SymbolServer::kMostWaiting; ++i)
    (void)server.read({"total"});
  EXPECT_THAT(errorOf([&] { (void)server.read({"total"}); }), HasSubstr("wait for task 'Fast'"));
  const auto done = [&] {
    run();
    return server.read({"total"});
  }();
  run();
  EXPECT_TRUE(done->done());
}

TEST_F(SymbolServing, AWriteToSeveralTasksIsDoneOrRefusedAsAWhole) {
  for (size_t i = 0; i < SymbolServer::kMostWaiting; ++i)
    (void)server.read({"Slow.runs"});
  EXPECT_THAT(errorOf([&] {
                (void)server.write({{"GVL.limit", "5"}, {"Slow.runs", "1"}});
              }),
              HasSubstr("wait for task 'Background'"));
  run();
  EXPECT_EQ(read("GVL.limit"), "100");
}

TEST_F(SymbolServing, TheEndOfTheRun) {
  const auto request = server.read({"total"});
  server.close();
  EXPECT_TRUE(request->done());
  EXPECT_TRUE(request->dropped());
  EXPECT_FALSE(SymbolServer::wait(*request, std::chrono::milliseconds(1)));
  EXPECT_THAT(errorOf([&] { (void)server.read({"total"}); }), HasSubstr("does not run any more"));
}

TEST_F(SymbolServing, AnotherBuild) {
  server.force({{"total", "9"}, {"PLC_PRG.count", "3"}});
  run();
  const auto waiting = server.read({"total"});
  stride::app::Application other = stride::app::Application::fromDescription(*stride_app_v1());
  other.initialise(stride::test::kThrowingHost);
  SymbolServer::Change change =
      server.prepareChange(std::make_unique<stride::app::SymbolTable>(other.description()));
  EXPECT_THAT(change.lostForces(), IsEmpty());
  tasks.rebind(other.description(), other.state());
  server.changeApplication(change);
  EXPECT_TRUE(waiting->dropped());
  run();
  EXPECT_EQ(read("total"), "9"); // in the old state, which nobody touches any more
  const auto now = server.read({"total", "PLC_PRG.count"});
  run();
  EXPECT_EQ(shown(*now), "9 3");
  EXPECT_THAT(errorOf([&] { server.again(waiting); }), HasSubstr("another build"));
}

TEST_F(SymbolServing, AForcedEnumeratorIsForcedByNameInAnotherBuild) {
  server.force({{"PLC_PRG.color", "blue"}});
  run();
  const stride::EnumeratorDesc moved[] = {{"blue", 3}, {"red", 4}, {"grey", 6}};
  stride::StrideAppV1 description = *stride_app_v1();
  description.enumerators = moved;
  const auto other = [&] {
    return server.prepareChange(std::make_unique<stride::app::SymbolTable>(description));
  };
  SymbolServer::Change change = other();
  EXPECT_THAT(change.lostForces(), IsEmpty());
  server.changeApplication(change);
  EXPECT_THAT(server.forced(), ElementsAre(Pair("PLC_PRG.color", "blue")));
  run();
  EXPECT_EQ(read("PLC_PRG.color"), "3");
  server.force({{"PLC_PRG.color", "grey"}});
  EXPECT_THAT(
      server.prepareChange(std::make_unique<stride::app::SymbolTable>(application.description()))
          .lostForces(),
      ElementsAre("PLC_PRG.color"));
}

TEST_F(SymbolServing, WhatIsWrittenFromOutsideIsLoggedWhenItChangesSomething) {
  struct Log final : stride::monitor::WriteLog {
    void wrote(const std::byte *place, size_t size, bool) noexcept override {
      last = place;
      bytes += size;
      ++count;
    }
    const std::byte *last = nullptr;
    size_t bytes = 0;
    int count = 0;
  } log;
  server.setWriteLog(log);
  (void)server.write({{"GVL.limit", "100"}}); // its initial value
  run();
  EXPECT_EQ(log.count, 0);
  (void)server.write({{"GVL.limit", "101"}});
  run();
  EXPECT_EQ(log.count, 1);
  EXPECT_EQ(log.bytes, 2U);
  int16_t written = 0;
  std::memcpy(&written, log.last, sizeof written);
  EXPECT_EQ(written, 101);
  server.force({{"GVL.limit", "7"}});
  run();
  run();
  EXPECT_EQ(log.count, 2); // the program does not write it: it stays
}

TEST_F(SymbolServing, CyclesAllocateNothing) {
  const auto read = server.read({"PLC_PRG"});
  const auto write = server.write({{"PLC_PRG.name", "'x'"}});
  server.force({{"PLC_PRG.count", "7"}});
  run();
  RecorderSettings settings;
  settings.names = {"PLC_PRG"};
  server.setRecorder(std::make_shared<Recorder>(symbols, settings));
  server.force({{"PLC_PRG.count", "8"}});
  server.again(read);
  const size_t before = stride::test::allocations();
  for (int i = 0; i < 10; ++i)
    run();
  EXPECT_EQ(stride::test::allocations(), before);
  EXPECT_TRUE(read->done());
  EXPECT_TRUE(write->done());
}

TEST_F(SymbolServing, ListsPageByPage) {
  const auto names = [](const SymbolPage &page) {
    std::string text;
    for (const SymbolEntry &entry : page.entries)
      text += entry.path + ":" + entry.type + ":" + std::to_string(entry.children) + " ";
    return text;
  };
  EXPECT_EQ(names(listSymbols(symbols, "", 0, 100)),
            "GVL.limit:INT:0 kMax:DINT:0 total:DINT:0 PLC_PRG:PLC_PRG:13 Slow:Slow:1 ");
  const SymbolPage page = listSymbols(symbols, "PLC_PRG", 4, 3);
  EXPECT_EQ(page.total, 13U);
  EXPECT_EQ(names(page), "PLC_PRG.a:ARRAY[1..3, -1..0] OF INT:3 PLC_PRG.pt:Point:2 "
                         "PLC_PRG.fb:Counter:3 ");
  EXPECT_EQ(names(listSymbols(symbols, "PLC_PRG.a", 1, 1)), "PLC_PRG.a[2]:ARRAY[-1..0] OF INT:2 ");
  EXPECT_EQ(names(listSymbols(symbols, "PLC_PRG.a[2]", 0, 9)),
            "PLC_PRG.a[2][-1]:INT:0 PLC_PRG.a[2][0]:INT:0 ");
  EXPECT_EQ(names(listSymbols(symbols, "PLC_PRG.a[2][-1]", 0, 9)), "");
  EXPECT_EQ(names(listSymbols(symbols, "PLC_PRG.p^", 1, 9)), "PLC_PRG.p^.y:LREAL:0 ");
  EXPECT_THAT(errorOf([&] { (void)listSymbols(symbols, "PLC_PRG.ab", 0, 9); }),
              HasSubstr("has no member 'ab'"));
}

} // namespace
