// Two applications made by hand, and the state of the first carried over to the second.
#ifndef STRIDE_TESTS_UNIT_APP_CARRY_FIXTURE_HPP
#define STRIDE_TESTS_UNIT_APP_CARRY_FIXTURE_HPP

#include "app_model.hpp"

#include "runtime/app/carry_over.hpp"
#include "runtime/app/validate.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

namespace stride::test {

/// A model with its state.
struct Build : AppModel {
  std::vector<uint64_t> memory;
  void ready() {
    finish();
    app::validate(app(), {});
    memory.assign(app().stateSize / 8 + 1, 0);
  }
  std::byte *state() { return reinterpret_cast<std::byte *>(memory.data()); }
  uint64_t address(uint64_t offset) { return std::bit_cast<uint64_t>(state()) + offset; }
  template <class T> void set(uint64_t offset, T value) {
    std::memcpy(state() + offset, &value, sizeof value);
  }
  template <class T> T get(uint64_t offset) {
    T value;
    std::memcpy(&value, state() + offset, sizeof value);
    return value;
  }
  uint64_t at(size_t root) const { return roots[root].offset; }
};

class CarryOverTest : public ::testing::Test {
protected:
  Build a;
  Build b;
  app::CarryResult result;
  std::vector<std::string> words;

  std::string apply(app::MatchOptions options = {}) {
    const app::CarryOver plan(a.app(), b.app(), options);
    plan.apply(a.state(), b.state(), result);
    words = plan.describe(result, a.state());
    return plan.report().text(true);
  }
};

} // namespace stride::test

#endif
