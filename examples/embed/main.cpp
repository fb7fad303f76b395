// Two tanks, each controlled by an application of its own, and the plant around them.
//
//   stride build Tank.st -o Tank.so
//   stride_embed_example Tank.so
#include "runtime/embed/stride.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>

namespace {

using namespace std::chrono_literals;
using stride::embed::Application;
using stride::embed::Result;
using stride::embed::Status;

/// A tank: water flows out all the time, and in while the valve is open.
struct Plant {
  double level;
  double outflow;

  void step(bool valve) { level += (valve ? 25.0 : 0.0) - outflow; }
};

/// Shows why something failed; true if it did.
template <class T> bool failed(const Result<T> &result) {
  if (!result)
    std::fprintf(stderr, "error: %s\n", result.message().c_str());
  return !result;
}

/// One cycle: the plant's level goes in, the valve comes out.
Status control(Application &tank, Plant &plant, std::chrono::nanoseconds time) {
  const auto level = static_cast<uint16_t>(plant.level);
  std::memcpy(tank.inputs().data(), &level, sizeof level);
  Status done = tank.cycle(0, time);
  if (done)
    plant.step((tank.outputs()[0] & std::byte{1}) != std::byte{0});
  return done;
}

int run(const std::string &file) {
  Result<Application> first = Application::load(file);
  Result<Application> second = Application::load(file);
  if (failed(first) || failed(second))
    return 1;
  std::array<Application *, 2> tanks = {&first.value(), &second.value()};
  std::array<Plant, 2> plants = {Plant{500.0, 5.0}, Plant{500.0, 12.0}};
  for (Application *tank : tanks)
    if (failed(tank->initialise()))
      return 1;

  // The second one by other marks: the two share nothing.
  if (failed(tanks[1]->write("Tank.low", "400")) || failed(tanks[1]->write("Tank.high", "450")))
    return 1;

  const std::chrono::nanoseconds interval = tanks[0]->tasks()[0].interval;
  for (std::chrono::nanoseconds time = 0ns; time < 10s; time += interval)
    for (size_t i = 0; i < tanks.size(); ++i)
      if (failed(control(*tanks[i], plants[i], time)))
        return 1;

  for (size_t i = 0; i < tanks.size(); ++i) {
    const auto fillings = tanks[i]->find<int16_t>("Tank.fillings");
    const Result<std::string> high = tanks[i]->read("Tank.high");
    if (failed(fillings) || failed(high))
      return 1;
    std::printf("tank %zu: filled %d times up to %s, level %.0f\n", i + 1,
                int{fillings.value().get().value_or(0)}, high.value().c_str(), plants[i].level);
  }
  // Mistakes are values, too.
  std::printf("%s\n", tanks[0]->read("Tank.levle").message().c_str());
  return 0;
}

} // namespace

int main(int argc, char **argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s APPLICATION\n", argv[0]);
    return 1;
  }
  return run(argv[1]);
}
