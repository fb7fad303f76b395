// What an online change costs: the plan, made while the old build goes on running, and the
// carry-over itself, for which the tasks wait.
#include "runtime/app/carry_over.hpp"
#include "runtime/app/state_block.hpp"
#include "tests/unit/app/app_model.hpp"

#include <benchmark/benchmark.h>

#include <bit>
#include <memory>
#include <string>

namespace {

using namespace stride;
using stride::test::AppModel;
using stride::test::ModelField;
using stride::test::ModelType;

/// A machine: 1,000 axes of 2.5 kB with a program that holds blocks bound to them, 100,000 single
/// variables, and recipes to fill 10 MB.
class Machine : public AppModel {
public:
  /// `changed`: some variables before everything and in the types.
  explicit Machine(bool changed) {
    const ModelType *real = elementary(Kind::LREAL);
    const ModelType *integer = elementary(Kind::INT);
    std::vector<ModelField> fields;
    for (int i = 0; i < 300; ++i)
      fields.push_back({"f" + std::to_string(i), real});
    for (int i = 0; i < 50; ++i)
      fields.push_back({"i" + std::to_string(i), integer});
    const ModelType *axis = structure("AXIS_REF", std::move(fields));
    fields = {{"Axis", pointer(axis, Kind::InOut)}, {"Execute", elementary(Kind::BOOL)}};
    if (changed)
      fields.push_back({"Fresh", integer});
    for (int i = 0; i < 20; ++i)
      fields.push_back({"p" + std::to_string(i), real});
    const ModelType *move = structure("Move", std::move(fields), nullptr, Kind::FunctionBlock);
    const ModelType *recipe =
        structure("Recipe", {{"values", array(real, 1, 100)}, {"name", string(80)}});
    if (changed)
      root("G", "first", array(integer, 1, 7));
    for (int i = 0; i < 1000; ++i)
      root("G", "Axis" + std::to_string(i), axis);
    for (int i = 0; i < 100'000; ++i)
      root("H", "v" + std::to_string(i), i % 3 == 0 ? integer : real);
    root("", "Moves", structure("Main", {{"moves", array(move, 0, 999)}}, nullptr, Kind::Program));
    root("R", "recipes", array(recipe, 1, 7000));
    finish();
    state_ = app::StateBlock(app().stateSize);
    std::memset(state_.data(), 0, state_.size());
  }
  std::byte *state() { return state_.data(); }

  /// Every block is bound to its axis.
  void bind() {
    const ModelRoot &main = roots[roots.size() - 2];
    const ModelType *move = main.type->fields[0].type->element;
    for (uint64_t i = 0; i < 1000; ++i) {
      const uint64_t address = std::bit_cast<uint64_t>(state()) + roots[i].offset;
      std::memcpy(state() + main.offset + i * move->size, &address, 8);
    }
  }

private:
  using ModelRoot = stride::test::ModelRoot;
  app::StateBlock state_;
};

void plan(benchmark::State &state) {
  const auto a = std::make_unique<Machine>(false);
  const auto b = std::make_unique<Machine>(state.range(0) != 0);
  for (auto _ : state) {
    const app::CarryOver plan(a->app(), b->app());
    benchmark::DoNotOptimize(plan.stepCount());
  }
}
BENCHMARK(plan)->ArgName("changed")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void apply(benchmark::State &state) {
  const auto a = std::make_unique<Machine>(false);
  const auto b = std::make_unique<Machine>(state.range(0) != 0);
  a->bind();
  const app::CarryOver plan(a->app(), b->app());
  app::CarryResult result;
  for (auto _ : state)
    plan.apply(a->state(), b->state(), result);
  if (result.nulled() != 0)
    state.SkipWithError("an axis was lost");
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations()) *
                          static_cast<int64_t>(a->app().stateSize));
  state.counters["state_MB"] = static_cast<double>(a->app().stateSize) / 1e6;
  state.counters["steps"] = static_cast<double>(plan.stepCount());
}
BENCHMARK(apply)->ArgName("changed")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

/// The bound of apply: one copy of as many bytes.
void copyOnly(benchmark::State &state) {
  const auto a = std::make_unique<Machine>(false);
  const auto b = std::make_unique<Machine>(false);
  for (auto _ : state) {
    std::memcpy(b->state(), a->state(), a->app().stateSize);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations()) *
                          static_cast<int64_t>(a->app().stateSize));
}
BENCHMARK(copyOnly)->Unit(benchmark::kMicrosecond);

/// Rebasing alone: pointers into structures that changed.
void pointers(benchmark::State &state) {
  const auto build = [](AppModel &model, bool changed) {
    const ModelType *real = model.elementary(Kind::LREAL);
    std::vector<ModelField> fields = {{"x", real}, {"y", real}};
    if (changed)
      fields.insert(fields.begin(), {"added", real});
    const ModelType *point = model.structure("Point", std::move(fields));
    model.root("G", "points", model.array(point, 0, 9999));
    model.root("G", "pointers", model.array(model.pointer(real), 0, 9999));
    model.finish();
    return point->size;
  };
  AppModel a;
  AppModel b;
  const uint64_t size = build(a, false);
  build(b, true);
  std::vector<uint64_t> from(a.app().stateSize / 8);
  std::vector<uint64_t> to(b.app().stateSize / 8);
  for (uint64_t i = 0; i < 10'000; ++i)
    from[a.roots[1].offset / 8 + i] =
        std::bit_cast<uint64_t>(from.data()) + ((i * 7919) % 10'000) * size + 8;
  const app::CarryOver plan(a.app(), b.app());
  app::CarryResult result;
  for (auto _ : state)
    plan.apply(reinterpret_cast<const std::byte *>(from.data()),
               reinterpret_cast<std::byte *>(to.data()), result);
  if (result.nulled() != 0)
    state.SkipWithError("a pointer was lost");
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations()) * 10'000);
}
BENCHMARK(pointers)->Unit(benchmark::kMicrosecond);

} // namespace
