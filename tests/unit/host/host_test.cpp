// The command line's parts and the trace.
#include "runtime/host/options.hpp"
#include "runtime/host/set_list.hpp"
#include "runtime/host/trace_writer.hpp"
#include "runtime/task/virtual_scheduler.hpp"
#include "tests/unit/app/fixture.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <new>
#include <sstream>

namespace stride::test {
size_t allocations();
}

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace stride::host;

using stride::task::VirtualScheduler;

constexpr int64_t kMs = 1000000;

class Rows final : public stride::task::InstantObserver {
public:
  Rows(TraceWriter &writer, SetList &sets, std::byte *state)
      : writer_(&writer), sets_(&sets), state_(state) {}
  void beforeInstant(int64_t timeNs) override { sets_->apply(timeNs, state_); }
  void afterInstant(int64_t timeNs, bool fastest) override {
    if (fastest) {
      writer_->row(timeNs, state_);
      ++count;
    }
  }
  int count = 0;

private:
  TraceWriter *writer_;
  SetList *sets_;
  std::byte *state_;
};

class Host : public stride::test::HandmadeApp {
protected:
  std::string traceOf(const std::vector<std::string> &paths) {
    const std::string file = ::testing::TempDir() + "stride_trace_test.csv";
    TraceWriter writer(symbols, paths, file);
    writer.row(0, application.state());
    cycle();
    writer.row(3 * kMs, application.state());
    writer.finish();
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    std::remove(file.c_str());
    return text.str();
  }
};

TEST_F(Host, Durations) {
  EXPECT_EQ(parseDuration("T#5s", false), 5000 * kMs);
  EXPECT_EQ(parseDuration("t#1s500ms", false), 1500 * kMs);
  EXPECT_EQ(parseDuration("LTIME#2us", false), 2000);
  EXPECT_EQ(parseDuration("5s", false), 5000 * kMs);
  EXPECT_EQ(parseDuration("500ms", false), 500 * kMs);
  EXPECT_EQ(parseDuration("1m30s", false), 90000 * kMs);
  EXPECT_EQ(parseDuration("0s", true), 0);
  for (const char *bad : {"", "5", "s", "5 s", "5s x", "-5s", "0s", "T#", "300000d"})
    EXPECT_NE(errorOf([&] { (void)parseDuration(bad, false); }), "no error") << bad;
}

TEST_F(Host, PathLists) {
  EXPECT_THAT(splitPaths("a"), ElementsAre("a"));
  EXPECT_THAT(splitPaths("a[1,2].b, c"), ElementsAre("a[1,2].b", "c"));
  EXPECT_THAT(errorOf([] { (void)splitPaths("a,,b"); }), HasSubstr("a name is missing"));
  EXPECT_THAT(errorOf([] { (void)splitPaths(""); }), HasSubstr("a name is missing"));
}

TEST_F(Host, SetOptions) {
  const SetOption option = parseSet("T#3s,PLC_PRG.a[1,0]=50");
  EXPECT_EQ(option.timeNs, 3000 * kMs);
  EXPECT_EQ(option.path, "PLC_PRG.a[1,0]");
  EXPECT_EQ(option.value, "50");
  EXPECT_EQ(parseSet("0s,x:='a=b'").value, "'a=b'");
  EXPECT_EQ(parseSet("0s, x := 5").path, "x");
  EXPECT_EQ(parseSet("a[1,2]=5").path, "a[1,2]");
  EXPECT_EQ(parseSet("x=LT#1s").timeNs, 0);
  for (const char *bad : {"", "x", "=1", "T#3s,x", "T#3s", "3,x=1", "T#3s,=1"})
    EXPECT_THAT(errorOf([&] { (void)parseSet(bad); }), HasSubstr("--set '")) << bad;
}

TEST_F(Host, SetsAreWrittenInTheOrderOfTheirTimes) {
  SetList sets(symbols, {parseSet("20ms,total=2"), parseSet("10ms,total=1"),
                         parseSet("10ms,PLC_PRG.color=blue"), parseSet("1s,total=9")});
  sets.apply(9 * kMs, application.state());
  EXPECT_EQ(read("total"), "0");
  sets.apply(10 * kMs, application.state());
  EXPECT_EQ(read("total"), "1");
  EXPECT_EQ(read("PLC_PRG.color"), "blue");
  sets.apply(25 * kMs, application.state());
  EXPECT_EQ(read("total"), "2");
  EXPECT_THAT(sets.left(), ElementsAre("1s,total=9"));
}

TEST_F(Host, SetsAreCheckedFirst) {
  const auto errorFor = [&](const char *text) {
    return errorOf([&] { SetList(symbols, {parseSet(text)}); });
  };
  EXPECT_THAT(errorFor("0s,kMax=1"), HasSubstr("'kMax' is a constant"));
  EXPECT_THAT(errorFor("0s,totel=1"), HasSubstr("did you mean 'total'?"));
  EXPECT_THAT(errorFor("0s,PLC_PRG.count=70000"), HasSubstr("out of range for INT"));
  SetList early(symbols, {parseSet("0s,PLC_PRG.p.x=1")});
  EXPECT_THAT(errorOf([&] { early.apply(0, application.state()); }), HasSubstr("is null"));
}

TEST_F(Host, TraceHasTheNamesAsGivenAndExactTimes) {
  EXPECT_EQ(traceOf({"plc_prg.COUNT", "PLC_PRG.value"}), "t,plc_prg.COUNT,PLC_PRG.value\n"
                                                         "0,0,0\n"
                                                         "0.003,1,0.1\n");
}

TEST_F(Host, TraceExpandsStructuresAndLeavesUnreachableFieldsEmpty) {
  EXPECT_EQ(traceOf({"PLC_PRG.pt", "PLC_PRG.p.x", "PLC_PRG.flag", "PLC_PRG.color", "PLC_PRG.name"}),
            "t,PLC_PRG.pt.x,PLC_PRG.pt.y,PLC_PRG.p.x,PLC_PRG.flag,PLC_PRG.color,PLC_PRG.name\n"
            "0,1.5,0,,0,5,\"it's\"\n"
            "0.003,0.1,0,0.1,1,5,\"it's\"\n");
  EXPECT_EQ(traceOf({"PLC_PRG.a[2,-1]"}), "t,\"PLC_PRG.a[2,-1]\"\n0,1\n0.003,2\n");
}

TEST_F(Host, TraceErrors) {
  EXPECT_THAT(errorOf([&] { traceOf({"PLC_PRG.p"}); }), HasSubstr("no value to trace"));
  EXPECT_THAT(errorOf([&] { TraceWriter(symbols, {"total"}, "/nonexistent/x.csv"); }),
              HasSubstr("cannot write '/nonexistent/x.csv'"));
}

TEST_F(Host, NothingIsAllocatedInCyclesAndRows) {
  stride::task::TaskSet tasks(application.description(), application.state(),
                              stride::task::hostApi(), stride::task::LoopLimit::Budget);
  VirtualScheduler scheduler(tasks);
  TraceWriter writer(symbols, {"PLC_PRG", "total", "GVL.limit"}, "/dev/null");
  SetList sets(symbols, {parseSet("50ms,total=2")});
  Rows rows(writer, sets, application.state());
  scheduler.setObserver(&rows);
  scheduler.runUntil(20 * kMs);
  const size_t before = stride::test::allocations();
  scheduler.runUntil(100000 * kMs);
  EXPECT_EQ(stride::test::allocations(), before);
  EXPECT_EQ(rows.count, 10000);
}

TEST_F(Host, Seconds) {
  const auto text = [](int64_t ns) {
    std::string out;
    stride::app::appendSeconds(ns, out);
    return out;
  };
  EXPECT_EQ(text(0), "0");
  EXPECT_EQ(text(1), "0.000000001");
  EXPECT_EQ(text(1500 * kMs), "1.5");
  EXPECT_EQ(text(86400000 * kMs), "86400");
}

} // namespace
