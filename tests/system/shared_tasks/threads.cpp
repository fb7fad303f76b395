// Calls the tasks of a generated application from one thread each, without the runtime's
// scheduler: whatever order there is comes from the generated code. Linked with it, under
// ThreadSanitizer. Prints `program.variable = value` for all members of programs called errors,
// changes, taken.
#include "runtime/app/symbol_text.hpp"
#include "tests/support/data_stack.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>
#include <vector>

namespace {

constexpr uint64_t kCycles = 10000;

[[noreturn]] void raised(stride::Ctx *, stride::ExceptionCode code, const char *file, uint32_t line,
                         uint32_t, const char *detail) {
  std::printf("exception %u at %s:%u %s\n", static_cast<unsigned>(code), file, line,
              detail != nullptr ? detail : "");
  std::_Exit(3);
}
int64_t refill(stride::Ctx *) { return 1'000'000'000; }

void print(const stride::StrideAppV1 &app, const char *state) {
  for (uint32_t i = 0; i < app.rootCount; ++i) {
    const stride::RootDesc &root = app.roots[i];
    const stride::TypeDesc &type = app.types[root.type];
    if (type.kind != stride::Kind::Program)
      continue;
    for (uint32_t m = type.firstMember; m < type.firstMember + type.memberCount; ++m) {
      const stride::MemberDesc &member = app.members[m];
      const std::string_view name = member.name;
      if (name != "errors" && name != "changes" && name != "taken")
        continue;
      int32_t value = 0;
      std::memcpy(&value, state + root.offset + member.offset, sizeof value);
      std::printf("%s.%s = %d\n", root.name, member.name, value);
    }
  }
}

} // namespace

int main() {
  const stride::app::DescribedApplication described(*stride_app_v1());
  const stride::StrideAppV1 &app = described.description();
  std::vector<char> memory(app.stateSize + 64);
  char *state = memory.data() + (64 - reinterpret_cast<uintptr_t>(memory.data()) % 64);
  stride::HostApi host{};
  host.size = sizeof host;
  host.raise = raised;
  host.refillLoopBudget = refill;
  stride::Ctx first{};
  first.state = state;
  first.host = &host;
  first.loopBudget = refill(nullptr);
  app.init(&first);

  std::atomic<uint32_t> ready = 0;
  std::atomic<bool> done = false;
  std::vector<std::thread> threads;
  for (uint32_t task = 0; task < app.taskCount; ++task) {
    threads.emplace_back([&, task] {
      stride::Ctx ctx = first;
      stride::test::DataStack dataStack;
      dataStack.giveTo(ctx);
      ctx.taskIndex = task;
      ready.fetch_add(1, std::memory_order_relaxed);
      while (ready.load(std::memory_order_relaxed) < app.taskCount) {
      }
      // The first one counts; the others go on until it is through.
      while (task == 0 ? ctx.cycle < kCycles : !done.load(std::memory_order_relaxed)) {
        ctx.loopBudget = refill(&ctx);
        app.tasks[task].run(&ctx);
        ++ctx.cycle;
      }
      if (task == 0)
        done.store(true, std::memory_order_relaxed);
    });
  }
  for (std::thread &thread : threads)
    thread.join();
  print(app, state);
  return 0;
}
