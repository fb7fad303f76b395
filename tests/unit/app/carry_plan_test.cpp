// The plan of an online change: what it costs, what it refuses, what it tells.
#include "carry_fixture.hpp"

#include <chrono>
#include <gmock/gmock-more-matchers.h>

namespace stride::test {
size_t allocations();
}

namespace {

using namespace stride;
using namespace stride::app;
using stride::test::AppModel;
using stride::test::CarryOverTest;
using stride::test::ModelType;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST_F(CarryOverTest, OnlyPersistentVariables) {
  const auto build = [](AppModel &m) {
    const ModelType *i = m.elementary(Kind::INT);
    const auto *s = m.structure("S", {{"x", i}, {"kept", i, kSymPersistent}, {"y", i}});
    m.root("", "s", s);
    m.root("", "all", m.structure("T", {{"s", s}}), kSymPersistent);
    m.root("", "p", m.pointer(i), kSymPersistent);
  };
  build(a);
  build(b);
  a.ready();
  b.ready();
  std::memset(a.state(), 0x11, a.app().stateSize);
  std::memset(b.state(), 0x22, b.app().stateSize);
  apply({kSymPersistent, false});
  EXPECT_EQ(b.get<int16_t>(0), 0x2222);
  EXPECT_EQ(b.get<int16_t>(2), 0x1111);
  EXPECT_EQ(b.get<int16_t>(4), 0x2222);
  EXPECT_EQ(b.get<int16_t>(6), 0x1111);
  EXPECT_EQ(b.get<int16_t>(10), 0x1111);
  EXPECT_EQ(b.get<uint64_t>(b.at(2)), 0x2222222222222222U);
  EXPECT_EQ(result.nulled(), 0U);
}

TEST_F(CarryOverTest, ThePlanOfManyVariablesIsMadeQuickly) {
  const auto build = [](stride::test::Build &model, const char *first) {
    const ModelType *integer = model.elementary(Kind::INT);
    model.root("G", first, integer);
    for (int i = 0; i < 100'000; ++i)
      model.root("G", "v" + std::to_string(i), integer);
    model.ready();
  };
  build(a, "was");
  build(b, "is");
  const auto begin = std::chrono::steady_clock::now();
  const app::CarryOver plan(a.app(), b.app());
  const auto took = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(plan.report().keptValues(), 100'000U);
  // Comparing each with each takes ten seconds and more.
  EXPECT_LT(took, std::chrono::seconds(3));
}

TEST_F(CarryOverTest, UnchangedIsOneCopy) {
  for (AppModel *m : {static_cast<AppModel *>(&a), static_cast<AppModel *>(&b)}) {
    const auto *s = m->structure("S", {{"a", m->elementary(Kind::BOOL)},
                                       {"b", m->elementary(Kind::LREAL)},
                                       {"c", m->elementary(Kind::INT)}});
    for (int i = 0; i < 50; ++i) {
      m->root("G", "s" + std::to_string(i), m->array(s, 1, 3));
      m->root("G", "b" + std::to_string(i), m->elementary(Kind::BOOL));
    }
  }
  a.ready();
  b.ready();
  const CarryOver plan(a.app(), b.app());
  EXPECT_EQ(plan.stepCount(), 1U);
  EXPECT_EQ(plan.report().verdict(), Verdict::Silent);
  EXPECT_EQ(plan.report().keptValues(), 500U);
}

TEST_F(CarryOverTest, ApplyAllocatesNothing) {
  const auto build = [](AppModel &m, bool changed) {
    const ModelType *i = m.elementary(changed ? Kind::DINT : Kind::INT);
    const auto *s =
        m.structure("S", {{"x", i},
                          {"t", m.string(changed ? 3 : 9)},
                          {"p", m.pointer(i)},
                          {"e", m.enumeration("E", {{"a", 0}, {"b", changed ? 2 : 1}})}});
    m.root("", "s", m.array(s, 1, 50));
  };
  build(a, false);
  build(b, true);
  a.ready();
  b.ready();
  std::memset(a.state(), 'x', a.app().stateSize);
  const CarryOver plan(a.app(), b.app());
  CarryResult few(5);
  const size_t before = stride::test::allocations();
  plan.apply(a.state(), b.state(), few);
  EXPECT_EQ(stride::test::allocations(), before);
  EXPECT_EQ(few.total(), 100U); // texts cut, pointers nulled
}

TEST_F(CarryOverTest, Refusals) {
  const auto build = [](AppModel &m, uint64_t hash) {
    auto *fb =
        m.structure("MC_Native", {{"x", m.elementary(Kind::INT)}}, nullptr, Kind::FunctionBlock);
    fb->flags = kTypeExternal;
    fb->hash = hash;
    m.root("", "fb", fb);
  };
  build(a, 1);
  build(b, 2);
  a.ready();
  b.ready();
  a.app().axisRefLayout = 5;
  b.app().axisRefLayout = 6;
  static const DriveDesc drives[] = {{"D1", 0, 1, 0}, {"D2", 0, 2, 0}};
  static const TaskDesc tasks[] = {{"T", TaskKind::Cyclic, 0, 1000, 0, 0, 0, nullptr},
                                   {"T", TaskKind::Cyclic, 0, 2000, 0, 0, 0, nullptr}};
  static const AxisGroupDesc groups[] = {{"G", "Bus", "Dummy", 0, 0, 1, 0, 1},
                                         {"G", "Bus", "CAN", 0, 0, 2, 0, 2},
                                         {"H", "Bus", "Dummy", 0, 0, 1, 0, 1}};
  a.app().axisGroups = groups;
  a.app().axisGroupCount = 1;
  a.app().tasks = tasks;
  a.app().taskCount = 1;
  a.app().drives = drives;
  a.app().driveCount = 2;
  b.app().axisGroups = groups + 1;
  b.app().axisGroupCount = 2;
  b.app().tasks = tasks + 1;
  b.app().taskCount = 1;
  b.app().drives = drives;
  b.app().driveCount = 2;
  const CarryOver plan(a.app(), b.app());
  EXPECT_EQ(plan.report().verdict(), Verdict::Refused);
  EXPECT_THAT(plan.report().refusals(),
              ElementsAre("AXIS_REF has other fields in the new build",
                          "MC_Native has a native body and other fields in the new build",
                          "axis group G has another driver in the new build",
                          "axis group G has another dwCycle in the new build",
                          "axis group G has another task in the new build",
                          "axis group G has other drives in the new build",
                          "axis group H is only in the new build"));
  EXPECT_THAT(CarryOver(a.app(), a.app()).report().refusals(), IsEmpty());
}

TEST_F(CarryOverTest, EventsBeyondTheCapacityAreCounted) {
  const auto build = [](AppModel &m, uint32_t length) {
    m.root("", "t", m.array(m.string(length), 1, 10));
  };
  build(a, 5);
  build(b, 2);
  a.ready();
  b.ready();
  std::memset(a.state(), 'x', 60);
  CarryResult few(3);
  const CarryOver plan(a.app(), b.app());
  plan.apply(a.state(), b.state(), few);
  EXPECT_EQ(few.textsCut(), 10U);
  EXPECT_EQ(few.events().size(), 3U);
  EXPECT_THAT(plan.describe(few, a.state()),
              ElementsAre("t[1]: its text was cut to 2 characters",
                          "t[2]: its text was cut to 2 characters",
                          "t[3]: its text was cut to 2 characters", "and 7 more"));
  few.clear();
  EXPECT_EQ(few.total(), 0U);
}

} // namespace
