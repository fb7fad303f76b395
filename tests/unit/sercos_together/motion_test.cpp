// Drives in operation: positions, velocities, torques, homing, probes, parameters.
#include "tests/unit/sercos_together/together.hpp"

#include <cmath>

namespace stride::sercos {
namespace {

TEST(SercosMotion, PositionsToTheIncrement) {
  for (const bool rotary : {false, true}) {
    Together all({.drives = 4, .rotary = rotary});
    all.runUp();
    ASSERT_TRUE(all.allStarted());
    all.powerOn();
    std::vector<uint32_t> sent(4);
    size_t n = 0;
    std::vector<std::vector<uint32_t>> history(4);
    all.move = [&](size_t i) {
      const double place =
          5000 * std::sin(0.01 * static_cast<double>(n)) * static_cast<double>(i + 1);
      all.commands[i].position = sent[i] + static_cast<uint32_t>(static_cast<int32_t>(place));
      history[i].push_back(all.commands[i].position);
    };
    for (size_t i = 0; i < 4; ++i)
      sent[i] = all.status(i).position;
    for (n = 0; n < 1500; ++n) {
      all.cycle();
      // It goes with the MDT of its cycle, is valid from the next MST on, and reached at the one
      // after that.
      for (size_t i = 0; i < 4 && n > 10; ++i)
        ASSERT_EQ(all.status(i).position, history[i][n - 2]) << i << ' ' << n << ' ' << rotary;
    }
  }
}

TEST(SercosMotion, RotaryOverManyTurns) {
  Together all({.drives = 1, .rotary = true});
  all.runUp();
  all.powerOn();
  uint32_t place = all.status(0).position;
  const int64_t start = all.drives[0]->mechanics().position();
  for (int i = 0; i < 1000; ++i) {
    all.commands[0].position = place += 500;
    all.cycle();
  }
  all.run(4);
  EXPECT_EQ(all.drives[0]->mechanics().position(), start + 500'000) << "nearly 14 turns";
  EXPECT_EQ(all.status(0).position, place);
}

TEST(SercosMotion, Velocities) {
  for (const bool rotary : {false, true}) {
    Together all({.drives = 2, .rotary = rotary});
    all.runUp();
    for (bus::DriveCommand &command : all.commands)
      command.controllerMode = 2;
    all.powerOn();
    EXPECT_EQ(all.status(0).controllerMode, 2);
    all.commands[0].velocity = 12345;
    all.commands[1].velocity = -777;
    all.run(5);
    EXPECT_NEAR(all.drives[0]->mechanics().velocity(), 12345, 0.1);
    EXPECT_NEAR(all.drives[1]->mechanics().velocity(), -777, 0.1);
    EXPECT_NEAR(all.status(0).velocity, 12345, 0.1);
    EXPECT_NEAR(all.status(1).velocity, -777, 0.1);
    for (bus::DriveCommand &command : all.commands)
      command.velocity = 0;
    all.run(5);
    for (size_t i = 0; i < 2; ++i) {
      all.commands[i].position = all.status(i).position;
      all.commands[i].controllerMode = 3;
    }
    all.run(10);
    EXPECT_EQ(all.status(0).controllerMode, 3) << "and back";
  }
}

TEST(SercosMotion, Torques) {
  Together all({.drives = 1,
                .controlType = 1,
                .more = {{51, 4}, {84, 2}},
                .setup = [](size_t, simulation::DriveSetup &setup) {
                  setup.drive.mechanics.model = dummy::Model::SecondOrder;
                  setup.drive.mechanics.torqueLimit = 5;
                  setup.drive.mechanics.inertia = 1e-3;
                  setup.ratedTorque = 2;
                }});
  all.runUp();
  ASSERT_TRUE(all.allStarted()) << all.messages[0].text();
  all.commands[0].controllerMode = 1;
  all.powerOn();
  all.commands[0].torque = 0.5;
  all.run(4);
  EXPECT_DOUBLE_EQ(all.drives[0]->mechanics().torque(), 0.5);
  EXPECT_DOUBLE_EQ(all.status(0).torque, 0.5);
}

TEST(SercosMotion, Homing) {
  Together all({.drives = 2, .setup = [](size_t, simulation::DriveSetup &setup) {
                  setup.drive.home = {true, -4000, -3000};
                }});
  all.runUp();
  all.powerOn();
  all.drives[1]->list().at(idns::kReferenceDistance1).value = 5000;
  for (bus::DriveCommand &command : all.commands)
    command.homing = true;
  for (int i = 0; i < 5000 && (all.status(0).homing != bus::Homing::Found ||
                               all.status(1).homing != bus::Homing::Found);
       ++i)
    all.cycle();
  for (size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(all.status(i).homing, bus::Homing::Found) << i;
    // The master's counter goes on; the reference is where the edge of the switch is in it.
    const auto edge = static_cast<int32_t>(all.status(i).homePosition - all.status(i).position);
    EXPECT_EQ(all.drives[i]->mechanics().position() + edge, -3000) << i;
  }
  const int64_t before = all.drives[0]->mechanics().position();
  for (size_t i = 0; i < 2; ++i) {
    all.commands[i].homing = false;
    all.commands[i].position = all.status(i).position;
  }
  all.run(50);
  EXPECT_EQ(all.drives[0]->mechanics().position(), before) << "it stays";
  EXPECT_FALSE(all.drives[0]->hasError());
  all.commands[0].position += 250;
  all.run(5);
  EXPECT_EQ(all.drives[0]->mechanics().position(), before + 250);
}

TEST(SercosMotion, HomingFails) {
  Together all({.drives = 1, .setup = [](size_t, simulation::DriveSetup &setup) {
                  setup.drive.hasLimitNegative = true;
                  setup.drive.limitNegative = -3000;
                }});
  all.runUp();
  all.powerOn();
  all.commands[0].homing = true;
  for (int i = 0; i < 3000 && all.status(0).homing != bus::Homing::Failed; ++i)
    all.cycle();
  EXPECT_EQ(all.status(0).homing, bus::Homing::Failed);
}

TEST(SercosMotion, Probes) {
  Together all({.drives = 1});
  all.runUp();
  all.powerOn();
  for (uint8_t edge = 0; edge < 4; ++edge) {
    all.commands[0].capture = static_cast<uint8_t>(1U << edge);
    all.run(60);
    EXPECT_EQ(all.status(0).captured, 0) << int{edge};
    const uint32_t there = all.status(0).position;
    all.drives[0]->probe(edge);
    all.commands[0].position = there + 100;
    all.run(60);
    EXPECT_EQ(all.status(0).captured, 1U << edge);
    EXPECT_EQ(all.status(0).capturedPosition[edge], there);
    all.commands[0].capture = 0;
    all.run(60);
  }
}

TEST(SercosMotion, ParametersMeanwhile) {
  Together all({.drives = 1, .controlType = 4});
  all.runUp();
  all.powerOn();
  bus::ParameterRequest request;
  request.number = idns::kAcceleration;
  Slave &drive = all.master->drive(0);
  drive.ask(request);
  bus::ParameterAnswer answer;
  int cycles = 0;
  for (; cycles < 100 && !drive.poll(answer); ++cycles)
    all.cycle();
  EXPECT_EQ(answer.result, bus::ParameterAnswer::Result::Done);
  EXPECT_EQ(answer.value, 10'000'000);
  // Open, attribute (2 words), value (2 words): each of them a cycle.
  EXPECT_GE(cycles, 5);
  EXPECT_LE(cycles, 8);
}

} // namespace
} // namespace stride::sercos
