// Random reads, writes and forces against a model of what a symbol server promises.
#include "tests/unit/monitor/served_app.hpp"

#include <rapidcheck/gtest.h>

#include <deque>
#include <map>
#include <optional>

namespace {

using namespace stride::monitor;

/// Variables that the program itself leaves alone.
const std::vector<std::string> kNames = {"GVL.limit", "PLC_PRG.divisor", "PLC_PRG.fb.step",
                                         "PLC_PRG.a[1,0]"};

struct Asked {
  std::shared_ptr<SymbolRequest> request;
  std::vector<std::pair<std::string, int>> writes; ///< Empty: a read.
  std::vector<std::string> reads;
};

class Served : public stride::test::ServedApp {
public:
  void TestBody() override {}

  void check() {
    for (const std::string &name : kNames)
      values_[name] = 1;
    values_["GVL.limit"] = 100;
    values_["PLC_PRG.a[1,0]"] = 0;
    // The program itself sets the block's step to 2 in each cycle.
    const int cycles = *rc::gen::inRange(1, 30);
    for (int i = 0; i < cycles; ++i) {
      const int operations = *rc::gen::inRange(0, 5);
      for (int j = 0; j < operations; ++j)
        operate();
      cycle();
    }
  }

private:
  void operate() {
    const std::string name = *rc::gen::elementOf(kNames);
    const int value = *rc::gen::inRange(1, 1000);
    switch (*rc::gen::inRange(0, 4)) {
    case 0: {
      const std::string other = *rc::gen::elementOf(kNames);
      queue_.push_back({server.read({name, other}), {}, {name, other}});
      break;
    }
    case 1:
      queue_.push_back({server.write({{name, std::to_string(value)}}), {{name, value}}, {}});
      break;
    case 2:
      server.force({{name, std::to_string(value)}});
      forced_[name] = value;
      break;
    default:
      if (forced_.erase(name) != 0)
        server.release({name});
      break;
    }
  }
  void cycle() {
    for (; !queue_.empty() && !queue_.front().writes.empty(); queue_.pop_front())
      for (const auto &[name, value] : queue_.front().writes)
        values_[name] = value;
    force();
    values_["PLC_PRG.fb.step"] = 2;
    force();
    run();
    for (; !queue_.empty() && queue_.front().writes.empty(); queue_.pop_front()) {
      const Asked &asked = queue_.front();
      RC_ASSERT(asked.request->done());
      std::string expected;
      for (const std::string &name : asked.reads)
        expected += (expected.empty() ? "" : " ") + std::to_string(values_[name]);
      RC_ASSERT(shown(*asked.request) == expected);
    }
    for (const Asked &asked : queue_)
      RC_ASSERT(!asked.request->done());
    for (const auto &[name, value] : values_)
      RC_ASSERT(read(name) == std::to_string(value));
  }
  void force() {
    for (const auto &[name, value] : forced_)
      values_[name] = value;
  }

  std::map<std::string, int> values_;
  std::map<std::string, int> forced_;
  std::deque<Asked> queue_;
};

RC_GTEST_PROP(Monitor, RequestsAndForcesDoWhatTheModelSays, ()) { Served().check(); }

} // namespace
