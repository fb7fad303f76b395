// Input scripts.
#include "runtime/script/script.hpp"
#include "runtime/task/task_set.hpp"
#include "tests/unit/app/fixture.hpp"

#include <cstdio>
#include <fstream>
#include <gmock/gmock-more-matchers.h>
#include <limits>

namespace stride::test {
size_t allocations();
}

namespace {

using namespace stride::script;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int64_t kMs = 1000000;
constexpr int64_t kNever = std::numeric_limits<int64_t>::max();

class Scripts : public stride::test::HandmadeApp {
protected:
  Script script(const std::string &text) const { return Script(symbols, text, "test.script"); }
  void step(Script &script, int64_t ms) { script.step(ms * kMs, application.state()); }
  std::string mistakes(const std::string &text) const {
    return errorOf([&] { (void)script(text); });
  }
};

TEST_F(Scripts, NothingInIt) {
  EXPECT_EQ(script("").nextNs(), kNever);
  EXPECT_EQ(script("\xEF\xBB\xBF// only a comment\r\n\n   \n").nextNs(), kNever);
}

TEST_F(Scripts, AtATime) {
  Script s = script("at T#30ms: total := 3\n"
                    "AT 10ms: total := 1; PLC_PRG.color := blue; // both\n");
  EXPECT_EQ(s.nextNs(), 10 * kMs);
  step(s, 9);
  EXPECT_EQ(read("total"), "0");
  step(s, 12);
  EXPECT_EQ(read("total"), "1");
  EXPECT_EQ(read("PLC_PRG.color"), "blue");
  EXPECT_EQ(s.nextNs(), 30 * kMs);
  EXPECT_THAT(s.remarks(),
              ElementsAre("warning: test.script:1:1: the run ended while the script still waited "
                          "here"));
  step(s, 30);
  EXPECT_EQ(read("total"), "3");
  EXPECT_EQ(s.nextNs(), kNever);
  EXPECT_THAT(s.remarks(), IsEmpty());
}

TEST_F(Scripts, StopAndStart) {
  stride::task::TaskSet tasks(application.description(), application.state(),
                              stride::task::hostApi(), stride::task::LoopLimit::Budget);
  using stride::task::OperatingMode;
  Script s = script("at T#20ms: STOP; total := 4 // both\n"
                    "wait T#30ms; start\n"
                    "at T#25ms: PLC_PRG.divisor := 3\n");
  s.switchModeOf(tasks);
  step(s, 10);
  EXPECT_EQ(tasks.mode(), OperatingMode::Run);
  step(s, 20);
  EXPECT_EQ(tasks.mode(), OperatingMode::Stop);
  EXPECT_EQ(read("total"), "4");
  step(s, 39); // other steps do not start it
  EXPECT_EQ(read("PLC_PRG.divisor"), "3");
  EXPECT_EQ(tasks.mode(), OperatingMode::Stop);
  step(s, 40);
  EXPECT_EQ(tasks.mode(), OperatingMode::Run);
  EXPECT_THAT(s.remarks(), IsEmpty());
  EXPECT_THAT(mistakes("stop now\n"), HasSubstr("test.script:1:6: 'now' was not expected there"));
  EXPECT_THAT(mistakes("stop := 1\n"), HasSubstr("stop")) << "a variable, which is missing";
}

TEST_F(Scripts, WhenOnceWheneverAgain) {
  Script s = script("when PLC_PRG.count > 2: total := 1\n"
                    "whenever PLC_PRG.flag: PLC_PRG.divisor := 7\n");
  step(s, 0);
  EXPECT_EQ(read("total"), "0");
  write("PLC_PRG.count", "3");
  write("PLC_PRG.flag", "TRUE");
  step(s, 10);
  EXPECT_EQ(read("total"), "1");
  EXPECT_EQ(read("PLC_PRG.divisor"), "7");
  write("total", "0");
  write("PLC_PRG.divisor", "1");
  step(s, 20); // the condition has not become true again
  EXPECT_EQ(read("total"), "0");
  EXPECT_EQ(read("PLC_PRG.divisor"), "1");
  write("PLC_PRG.flag", "FALSE");
  step(s, 30);
  write("PLC_PRG.flag", "TRUE");
  step(s, 40);
  EXPECT_EQ(read("PLC_PRG.divisor"), "7");
  EXPECT_THAT(s.remarks(), IsEmpty());
}

TEST_F(Scripts, WheneverThatEndsItsOwnCondition) {
  Script s = script("whenever PLC_PRG.count >= 100: PLC_PRG.count := 0");
  for (int i = 0; i < 3; ++i) {
    write("PLC_PRG.count", "100");
    step(s, i);
    EXPECT_EQ(read("PLC_PRG.count"), "0") << i;
  }
}

TEST_F(Scripts, StepsInTheirOrder) {
  Script s = script("total := 1\n"
                    "wait 10ms\n"
                    "total := 2\n"
                    "wait until PLC_PRG.count = 4 AND NOT (PLC_PRG.flag OR PLC_PRG.pt.x < 0)\n"
                    "total := 3; wait T#5ms; total := 4\n");
  EXPECT_EQ(s.nextNs(), 0);
  step(s, 100);
  EXPECT_EQ(read("total"), "1");
  EXPECT_EQ(s.nextNs(), 110 * kMs);
  step(s, 110);
  EXPECT_EQ(read("total"), "2");
  EXPECT_EQ(s.nextNs(), kNever);
  write("PLC_PRG.count", "4");
  step(s, 120);
  EXPECT_EQ(read("total"), "3");
  step(s, 125);
  EXPECT_EQ(read("total"), "4");
}

TEST_F(Scripts, SequencesRunSideBySide) {
  Script s = script("sequence Left\n"
                    "  wait until PLC_PRG.flag\n"
                    "  total := 1\n"
                    "end_sequence\n"
                    "wait until total = 1\n"
                    "sequence Right\n"
                    "  wait until PLC_PRG.count = 1\n"
                    "  GVL.limit := 5\n"
                    "end_sequence\n"
                    "GVL.limit := 6\n");
  write("PLC_PRG.count", "1");
  step(s, 0);
  EXPECT_EQ(read("GVL.limit"), "5");
  write("PLC_PRG.flag", "TRUE");
  step(s, 1);
  EXPECT_EQ(read("GVL.limit"), "6");
}

TEST_F(Scripts, ForcesHoldAgainstTheProgram) {
  Script s = script("at 0s: force PLC_PRG.count := 50\n"
                    "at 20ms: force PLC_PRG.count := 60; total := 9\n"
                    "at 40ms: release PLC_PRG.count\n");
  stride::task::TaskSet tasks(application.description(), application.state(),
                              stride::task::hostApi(), stride::task::LoopLimit::Budget);
  tasks.addHook(0, s.forces());
  std::string seen;
  for (int64_t t = 0; t < 60; t += 10) {
    step(s, t);
    tasks.runCycle(0, t * kMs, 0);
    seen += read("PLC_PRG.count") + "," + read("PLC_PRG.a[2,-1]") + " ";
  }
  // The program counts up and copies its count; after it the force holds again.
  EXPECT_EQ(seen, "50,51 50,51 60,61 60,61 61,61 62,62 ");
}

TEST_F(Scripts, NullPointersAreReportedAtTheEnd) {
  Script s = script("at 1ms: PLC_PRG.p.x := 1.0\n");
  step(s, 1);
  EXPECT_THAT(s.remarks(), ElementsAre("warning: test.script:1:9: 'PLC_PRG.p.x' was not written at "
                                       "0.001 s: a pointer on the way was null"));
}

TEST_F(Scripts, EveryMistakeWithItsPlace) {
  EXPECT_EQ(
      mistakes("at T#1s: PLC_PRG.coumt := 1\n"
               "  when kMax > x: total := 1\n"
               "at 5: total := 1\n"
               "at 1s: kMax := 1\n"
               "at 1s: total = 1\n"
               "/*\xC3\xA4*/ total\n"),
      "test.script:1:10: symbol 'PLC_PRG.coumt': PLC_PRG has no member 'coumt'; did you mean "
      "'count'?\n"
      "error: test.script:2:15: 'x' is not a value of type DINT; write for example 50, -3 or "
      "16#FF\n"
      "error: test.script:3:4: '5' is not a time; write for example T#1s500ms, 5s or 500ms\n"
      "error: test.script:4:8: symbol 'kMax': it is a constant\n"
      "error: test.script:5:14: a value is assigned with ':='\n"
      "error: test.script:6:1: '/*\xC3\xA4*/' is not understood; a line is 'at TIME: …', 'when "
      "CONDITION: …', 'whenever CONDITION: …', 'wait TIME', 'wait until CONDITION', 'NAME := "
      "VALUE', 'force NAME := VALUE', 'release NAME', 'stop', 'start', 'sequence NAME' or "
      "'end_sequence'");
}

TEST_F(Scripts, MoreMistakes) {
  EXPECT_THAT(mistakes("when total: total := 1"), HasSubstr("1:6: 'total' is DINT, not BOOL"));
  EXPECT_THAT(mistakes("when PLC_PRG.flag total := 1"), HasSubstr("':' is missing"));
  EXPECT_THAT(mistakes("when (PLC_PRG.flag: total := 1"), HasSubstr("')' is missing"));
  EXPECT_THAT(mistakes("at 1s:"), HasSubstr("1:7: what is to be done is missing"));
  EXPECT_THAT(mistakes("at : total := 1"), HasSubstr("1:4: a time is missing"));
  EXPECT_THAT(mistakes("when : total := 1"), HasSubstr("1:6: the name of a variable is missing"));
  EXPECT_THAT(mistakes("total := 1 2"), HasSubstr("1:12: '2' was not expected there"));
  EXPECT_THAT(mistakes("total :="), HasSubstr("1:9: a value is missing"));
  EXPECT_THAT(mistakes("force total"), HasSubstr("':=' is missing after the name"));
  EXPECT_THAT(mistakes("PLC_PRG.pt := 1"), HasSubstr("name one of its parts"));
  EXPECT_THAT(mistakes("sequence a\ntotal := 1"), HasSubstr("1:1: this sequence has no"));
  EXPECT_THAT(mistakes("end_sequence"), HasSubstr("no sequence begins"));
  EXPECT_THAT(mistakes("sequence a\nsequence b\nend_sequence"),
              HasSubstr("of line 1 has not ended"));
  EXPECT_THAT(mistakes("sequence a\nat 1s: total := 1\nend_sequence"), HasSubstr("'wait TIME'"));
  EXPECT_THAT(mistakes("when " + std::string(100, '(') + "PLC_PRG.flag: total := 1"),
              HasSubstr("nested too deeply"));
  EXPECT_EQ(errorOf([&] { (void)Script::fromFile(symbols, "/nonexistent/s"); }),
            "cannot read '/nonexistent/s': No such file or directory");
}

TEST_F(Scripts, KeywordsAreNamesToo) {
  EXPECT_THAT(mistakes("when := 1"), HasSubstr("1:1: symbol 'when': there is no program"));
  EXPECT_THAT(mistakes("at.x := 1"), HasSubstr("1:1: symbol 'at.x': there is no program"));
}

TEST_F(Scripts, StepsAllocateNothing) {
  Script s = script("whenever PLC_PRG.flag: total := 1; force PLC_PRG.count := 5\n"
                    "whenever NOT PLC_PRG.flag: release PLC_PRG.count\n"
                    "at 500ms: PLC_PRG.name := 'x'\n");
  stride::task::TaskSet tasks(application.description(), application.state(),
                              stride::task::hostApi(), stride::task::LoopLimit::Budget);
  tasks.addHook(0, s.forces());
  const size_t before = stride::test::allocations();
  for (int64_t t = 0; t < 1000; t += 10) {
    step(s, t);
    tasks.runCycle(0, t * kMs, 0);
  }
  EXPECT_EQ(stride::test::allocations(), before);
  EXPECT_EQ(read("PLC_PRG.name"), "'x'");
}

} // namespace
