#ifndef STRIDE_TESTS_PROPERTY_COMMAND_BLOCK_HPP
#define STRIDE_TESTS_PROPERTY_COMMAND_BLOCK_HPP
// A motion block as random programs of commands see it.

#include "tests/support/random.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stride::test {

/// A course as it was asked for, judged by its points alone.
struct Asked {
  bool fresh = false;         ///< Its edge comes with the next call.
  std::vector<double> times;  ///< From the edge on. [s]
  std::vector<double> values; ///< Absolute.
};

/// A block behind what all have in common.
struct CommandBlock {
  std::string name;
  std::function<void(bool)> call;     ///< With Execute.
  std::function<void(Random &)> draw; ///< New inputs.
  std::function<bool()> done, aborted, failed, busy;
  std::function<int()> error;
  std::function<int()> mode;                  ///< BufferMode.
  std::function<double()> steepest;           ///< Acceleration that its course may have. [u/s^2]
  std::function<double(const Asked &)> judge; ///< How far the axis is off the course now.
  std::shared_ptr<Asked> asked;
  bool execute = false;
  bool wasBusy = false;
  double age = 0; ///< Since the edge. [s]
};

/// What all blocks have in common; inputs, the call and how it is judged are the caller's.
template <class Block>
CommandBlock commandBlock(const std::string &name, std::shared_ptr<Block> b) {
  CommandBlock i;
  i.name = name;
  i.aborted = [] { return false; };
  if constexpr (requires { b->CommandAborted; })
    i.aborted = [b] { return b->CommandAborted != 0; };
  i.failed = [b] { return b->Error != 0; };
  i.busy = [b] { return b->Busy != 0; };
  i.error = [b] { return static_cast<int>(b->stBlock.iError); };
  i.done = [] { return false; };
  if constexpr (requires { b->Done; })
    i.done = [b] { return b->Done != 0; };
  else if constexpr (requires { b->InVelocity; })
    i.done = [b] { return b->InVelocity != 0; };
  else if constexpr (requires { b->InEndVelocity; })
    i.done = [b] { return b->InEndVelocity != 0; };
  i.draw = [](Random &) {};
  if constexpr (requires { b->BufferMode; })
    i.mode = [b] { return static_cast<int>(b->BufferMode); };
  i.steepest = [] { return 0.0; };
  return i;
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_COMMAND_BLOCK_HPP
