// Walks every pair of a state and a block in docs/motion-states.md.
#include "tests/unit/motion/state_scene.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace {

using stride::test::Actor;
using stride::test::axisState;
using stride::test::axisStates;
using stride::test::makeActor;
using stride::test::Shown;
using stride::test::StateScene;
using stride::test::waysInto;

struct Pair {
  std::string block;
  std::string state;
  std::string answer;
};

std::string trimmed(const std::string &text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> cellsOf(const std::string &line) {
  std::vector<std::string> cells;
  std::istringstream in(line.substr(1));
  for (std::string cell; std::getline(in, cell, '|');)
    cells.push_back(trimmed(cell));
  return cells;
}

/// The pairs of one of the page's tables.
std::vector<Pair> readTable(const std::string &name) {
  std::ifstream page(std::string(STRIDE_SOURCE_DIR) + "/docs/motion-states.md");
  std::vector<Pair> pairs;
  std::string line;
  while (std::getline(page, line) && line != "<!-- table: " + name + " -->") {
  }
  std::vector<std::string> heads;
  while (std::getline(page, line) && line.starts_with("|")) {
    const auto cells = cellsOf(line);
    if (heads.empty())
      heads = cells;
    else if (!cells[0].starts_with("---"))
      for (size_t i = 1; i + 1 < cells.size(); ++i)
        pairs.push_back({cells[0], heads[i], cells[i]});
  }
  return pairs;
}

bool isNumber(const std::string &text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) != 0;
}

enum class Order { BeforeOwner, AfterOwner };

/// A block called in a scene, with a twin of the scene in which it is not called.
struct Try {
  Try(const Pair &pair, const std::string &way)
      : scene(pair.state, way), twin(pair.state, way), block(makeActor(scene.rig, pair.block)) {}

  /// One cycle; the block is called unless `execute` is empty.
  void cycle(Order order, bool execute) {
    const auto call = [&] { block.call(execute); };
    const auto none = [] {};
    if (order == Order::BeforeOwner)
      scene.cycle(call, none);
    else
      scene.cycle(none, call);
    twin.cycle();
  }

  void expectLikeTwin() const {
    ASSERT_EQ(scene.rig.axis.fSetPosition, twin.rig.axis.fSetPosition);
    ASSERT_EQ(scene.rig.axis.fSetVelocity, twin.rig.axis.fSetVelocity);
    ASSERT_EQ(scene.rig.axis.nAxisState, twin.rig.axis.nAxisState);
    ASSERT_EQ(scene.rig.axis.iOwner, twin.rig.axis.iOwner);
    ASSERT_EQ(scene.rig.axis.iNoOwner, twin.rig.axis.iNoOwner);
    if (scene.owner) {
      const Shown is = scene.owner->show();
      const Shown would = twin.owner->show();
      ASSERT_EQ(is.busy, would.busy);
      ASSERT_EQ(is.done, would.done);
      ASSERT_EQ(is.aborted, would.aborted);
      ASSERT_EQ(is.errorId, would.errorId);
    }
  }

  StateScene scene;
  StateScene twin;
  Actor block;
};

void expectRefused(const Pair &pair, const std::string &way, Order order) {
  Try t(pair, way);
  const int number = std::stoi(pair.answer);
  for (int i = 0; i < 100; ++i) {
    t.cycle(order, true);
    const Shown shown = t.block.show();
    ASSERT_TRUE(shown.error) << "cycle " << i;
    ASSERT_EQ(shown.errorId, number);
    ASSERT_FALSE(shown.done || shown.busy || shown.active || shown.aborted);
    ASSERT_NO_FATAL_FAILURE(t.expectLikeTwin()) << "cycle " << i;
  }
  t.cycle(order, false);
  const Shown after = t.block.show();
  EXPECT_FALSE(after.error);
  EXPECT_EQ(after.errorId, 0);
  t.expectLikeTwin();
}

void expectAdded(const Pair &pair, const std::string &way, Order order) {
  Try t(pair, way);
  for (int i = 0; i < 3000 && !t.block.show().done; ++i) {
    t.cycle(order, true);
    const Shown shown = t.block.show();
    ASSERT_FALSE(shown.error) << shown.errorId;
    ASSERT_FALSE(shown.aborted);
    ASSERT_TRUE(shown.busy || shown.done);
    if (t.twin.rig.axis.iOwner == 0)
      continue; // the motion below has ended
    ASSERT_EQ(t.scene.rig.axis.iOwner, t.twin.rig.axis.iOwner);
    ASSERT_EQ(t.scene.rig.axis.iNoOwner, t.twin.rig.axis.iNoOwner);
    ASSERT_EQ(t.scene.rig.axis.nAxisState, t.twin.rig.axis.nAxisState) << "cycle " << i;
    ASSERT_EQ(t.scene.owner->show().busy, t.twin.owner->show().busy);
    ASSERT_FALSE(t.scene.owner->show().aborted);
  }
  EXPECT_TRUE(t.block.show().done);
  EXPECT_NEAR(t.scene.rig.axis.fSetPosition - t.twin.rig.axis.fSetPosition, 15, 1e-9);
}

void expectOwnerAborted(Try &t, Order order, const std::string &way) {
  if (!t.scene.owner)
    return;
  Shown owner = t.scene.owner->show();
  if (order == Order::AfterOwner) {
    EXPECT_FALSE(owner.aborted) << way << " has been called before";
    t.cycle(order, true);
    owner = t.scene.owner->show();
  }
  EXPECT_TRUE(owner.aborted);
  EXPECT_FALSE(owner.done || owner.busy || owner.active || owner.error);
  // As long as its Execute is TRUE, and not longer.
  t.cycle(order, true);
  EXPECT_TRUE(t.scene.owner->show().aborted);
  t.scene.execute = false;
  t.cycle(order, true);
  EXPECT_FALSE(t.scene.owner->show().aborted);
}

/// What the axis does afterwards: steady, and where the state says to.
void expectCourse(Try &t, Order order, const Pair &pair, bool steady) {
  auto &axis = t.scene.rig.axis;
  double before = axis.fSetVelocity;
  bool done = t.block.show().done;
  for (int i = 0; i < 10000 && !done; ++i) {
    t.cycle(order, true);
    done = t.block.show().done;
    if (steady) {
      ASSERT_LE(std::fabs(axis.fSetVelocity - before), 50 * 0.001 * (1 + 1e-9) + 1e-9)
          << "cycle " << i;
    }
    before = axis.fSetVelocity;
    ASSERT_FALSE(t.block.show().aborted);
    ASSERT_FALSE(t.block.show().error) << t.block.show().errorId;
    if (!done) {
      ASSERT_EQ(axis.nAxisState, axisState(pair.answer)) << "cycle " << i;
    }
  }
  if (pair.answer == "synchronized_motion") {
    EXPECT_NEAR(axis.fSetVelocity, 10, 1e-6);
    return;
  }
  EXPECT_TRUE(done) << "not within 10 s";
  if (pair.answer == "stopping") {
    EXPECT_EQ(axis.nAxisState, axisState("stopping"));
    EXPECT_EQ(axis.fSetVelocity, 0);
    t.cycle(order, false);
    EXPECT_EQ(axis.nAxisState, axisState("standstill"));
    EXPECT_EQ(axis.iOwner, 0);
  } else if (pair.answer == "discrete_motion" && pair.block != "MC_PositionProfile") {
    EXPECT_EQ(axis.nAxisState, axisState("standstill"));
    EXPECT_EQ(axis.fSetVelocity, 0);
    EXPECT_EQ(axis.iOwner, 0);
  } else if (pair.answer == "continuous_motion") {
    EXPECT_EQ(axis.nAxisState, axisState("continuous_motion"));
  }
}

void expectTakesOver(const Pair &pair, const std::string &way, Order order) {
  Try t(pair, way);
  auto &axis = t.scene.rig.axis;
  const auto formerOwner = axis.iOwner;
  const auto formerCount = axis.iNoOwner;
  t.cycle(order, true);
  const Shown shown = t.block.show();
  ASSERT_FALSE(shown.error) << shown.errorId;
  ASSERT_FALSE(shown.aborted);
  EXPECT_EQ(axis.nAxisState, axisState(pair.answer));
  EXPECT_EQ(axis.iNoOwner, formerCount + 1);
  if (pair.answer == "standstill") { // MC_Halt at rest
    EXPECT_TRUE(shown.done);
    EXPECT_EQ(axis.iOwner, 0);
    return;
  }
  EXPECT_NE(axis.iOwner, 0);
  EXPECT_NE(axis.iOwner, formerOwner);
  EXPECT_TRUE(shown.busy || shown.done);
  expectOwnerAborted(t, order, way);
  if (pair.answer != "homing")
    expectCourse(t, order, pair,
                 pair.block.find("Follow") == std::string::npos &&
                     pair.block.find("Control") == std::string::npos &&
                     pair.block != "MC_GearInPos" &&
                     pair.block.find("Profile") == std::string::npos);
}

std::string nameOf(const Pair &pair, const std::string &way, Order order) {
  return pair.block + " in " + pair.state + " (" + way + "), called " +
         (order == Order::BeforeOwner ? "before" : "after") + " the owner: " + pair.answer;
}

TEST(StateTable, CoversEveryState) {
  const auto pairs = readTable("motion");
  std::set<std::string> blocks;
  for (const Pair &pair : pairs)
    blocks.insert(pair.block);
  EXPECT_EQ(blocks.size(), 32U);
  EXPECT_EQ(pairs.size(), blocks.size() * axisStates().size());
}

TEST(StateTable, TheScenesAreInTheirStates) {
  for (const std::string &state : axisStates())
    for (const std::string &way : waysInto(state)) {
      SCOPED_TRACE(state + ": " + way);
      StateScene scene(state, way);
      EXPECT_EQ(scene.rig.axis.nAxisState, axisState(state));
      for (int i = 0; i < 100; ++i)
        scene.cycle();
      EXPECT_EQ(scene.rig.axis.nAxisState, axisState(state)) << "100 cycles later";
      EXPECT_EQ(scene.rig.axis.iOwner != 0, scene.owner.has_value());
    }
}

class MotionBlocks : public testing::TestWithParam<std::string> {};

TEST_P(MotionBlocks, AnswerAsTheTableSays) {
  for (const Pair &pair : readTable("motion")) {
    if (pair.block != GetParam())
      continue;
    for (const std::string &way : waysInto(pair.state))
      for (const Order order : {Order::BeforeOwner, Order::AfterOwner}) {
        SCOPED_TRACE(nameOf(pair, way, order));
        if (isNumber(pair.answer))
          expectRefused(pair, way, order);
        else if (pair.answer == "added")
          expectAdded(pair, way, order);
        else
          expectTakesOver(pair, way, order);
      }
  }
}

std::vector<std::string> blocksOf(const std::string &table) {
  std::vector<std::string> names;
  for (const Pair &pair : readTable(table))
    if (names.empty() || names.back() != pair.block)
      names.push_back(pair.block);
  return names;
}

std::string testName(const testing::TestParamInfo<std::string> &info) {
  std::string name = info.param;
  for (char &c : name)
    if (c == ' ')
      c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Table, MotionBlocks, testing::ValuesIn(blocksOf("motion")), testName);

class AdministrativeBlocks : public testing::TestWithParam<std::string> {};

/// Blocks that only look or set something: nothing else changes for the owner of the axis.
void expectWorks(const Pair &pair, const std::string &way, Order order) {
  Try t(pair, way);
  const bool shifts = pair.block == "MC_SetPosition";
  const bool follows =
      way.find("FollowPosition") != std::string::npos || way.find("ByPos") != std::string::npos;
  for (int i = 0; i < 50; ++i) {
    t.cycle(order, true);
    const Shown shown = t.block.show();
    ASSERT_FALSE(shown.error) << shown.errorId;
    ASSERT_FALSE(shown.aborted);
    if (shifts) {
      ASSERT_TRUE(shown.done);
      if (!follows) {
        ASSERT_NEAR(t.scene.rig.axis.fSetPosition, t.twin.rig.axis.fSetPosition + 3, 1e-9);
      }
      ASSERT_EQ(t.scene.rig.axis.nAxisState, t.twin.rig.axis.nAxisState);
      ASSERT_EQ(t.scene.rig.axis.iOwner, t.twin.rig.axis.iOwner);
    } else {
      ASSERT_NO_FATAL_FAILURE(t.expectLikeTwin());
    }
  }
}

void expectPowerOff(const Pair &pair, const std::string &way, Order order) {
  Try t(pair, way);
  for (int i = 0; i < 20; ++i)
    t.cycle(order, true);
  EXPECT_EQ(t.scene.rig.axis.nAxisState,
            axisState(pair.answer == "stays" ? pair.state : pair.answer));
  EXPECT_EQ(t.scene.rig.power.Status, 0);
  EXPECT_EQ(t.scene.rig.axis.iOwner, 0);
  if (t.scene.owner && pair.state != "stopping") {
    EXPECT_EQ(t.scene.owner->show().errorId, 20);
    EXPECT_FALSE(t.scene.owner->show().busy);
  }
}

void expectReset(const Pair &pair, const std::string &way, Order order) {
  Try t(pair, way);
  for (int i = 0; i < 1200 && !t.block.show().done; ++i) {
    t.cycle(order, true);
    ASSERT_FALSE(t.block.show().error) << t.block.show().errorId;
  }
  EXPECT_TRUE(t.block.show().done);
  for (int i = 0; i < 20; ++i) // a drive that had an error switches on again
    t.cycle(order, true);
  EXPECT_EQ(t.scene.rig.axis.nAxisState, axisState(pair.answer));
  EXPECT_EQ(t.scene.rig.axis.fSetVelocity, 0);
}

TEST_P(AdministrativeBlocks, AnswerAsTheTableSays) {
  for (const Pair &pair : readTable("administration")) {
    if (pair.block != GetParam())
      continue;
    for (const std::string &way : waysInto(pair.state))
      for (const Order order : {Order::BeforeOwner, Order::AfterOwner}) {
        SCOPED_TRACE(nameOf(pair, way, order));
        if (isNumber(pair.answer))
          expectRefused(pair, way, order);
        else if (pair.block == "MC_Power off")
          expectPowerOff(pair, way, order);
        else if (pair.block == "MC_Reset")
          expectReset(pair, way, order);
        else
          expectWorks(pair, way, order);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, AdministrativeBlocks, testing::ValuesIn(blocksOf("administration")),
                         testName);

class ControllerModes : public testing::TestWithParam<std::string> {};

TEST_P(ControllerModes, AnswerAsTheTableSays) {
  for (const Pair &pair : readTable("modes")) {
    if (pair.block != GetParam())
      continue;
    SCOPED_TRACE(pair.block + " while a " + pair.state + " is regulated");
    stride::test::ModeScene scene(pair.state == "torque" ? 1 : 2);
    auto &axis = scene.rig.axis;
    ASSERT_EQ(axis.byRealControllerMode, pair.state == "torque" ? 1 : 2);
    ASSERT_EQ(axis.nAxisState, axisState("standstill"));
    Actor block = makeActor(scene.rig, pair.block);
    for (int i = 0; i < 50; ++i) {
      scene.rig.cycle([&] { block.call(true); });
      const Shown shown = block.show();
      if (!isNumber(pair.answer)) {
        ASSERT_FALSE(shown.error) << shown.errorId;
        ASSERT_TRUE(shown.done || shown.busy);
        continue;
      }
      ASSERT_TRUE(shown.error) << "cycle " << i;
      ASSERT_EQ(shown.errorId, std::stoi(pair.answer));
      ASSERT_FALSE(shown.done || shown.busy || shown.active || shown.aborted);
      ASSERT_EQ(axis.nAxisState, axisState("standstill"));
      ASSERT_EQ(axis.iOwner, 0);
      ASSERT_EQ(axis.fSetVelocity, 0);
    }
  }
}

TEST(StateTable, HasTheSameBlocksForTheModes) { EXPECT_EQ(blocksOf("modes"), blocksOf("motion")); }

INSTANTIATE_TEST_SUITE_P(Table, ControllerModes, testing::ValuesIn(blocksOf("modes")), testName);

} // namespace
