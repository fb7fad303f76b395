#include "runtime/embed/stride.hpp"

#include "runtime/app/condition.hpp"
#include "runtime/app/error.hpp"
#include "runtime/app/value_text.hpp"
#include "runtime/host/axis_hooks.hpp"
#include "runtime/host/instance.hpp"
#include "runtime/monitor/symbol_server.hpp"
#include "runtime/task/virtual_scheduler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

namespace stride::embed {

namespace {

/// Calls `f`; what it throws is returned.
template <class F> Status attempt(F f) {
  try {
    f();
    return Nothing{};
  } catch (const StException &exception) {
    return Failure{task::describe({exception, "initialisation", 0, 0})};
  } catch (const std::exception &error) {
    return Failure{error.what()};
  }
}

} // namespace

struct Place::Impl {
  app::Symbol symbol;
  std::byte *state = nullptr;
  size_t size = 0;
};

bool Place::load(void *value) const noexcept {
  std::byte bit{};
  const void *from = impl_->symbol.read(impl_->state, bit);
  if (from == nullptr)
    return false;
  std::copy_n(static_cast<const std::byte *>(from), impl_->size, static_cast<std::byte *>(value));
  return true;
}

bool Place::store(const void *value) const noexcept {
  return impl_->symbol.write(impl_->state, value, impl_->size);
}

struct Application::Impl {
  explicit Impl(const std::string &file)
      : instance(std::make_unique<app::Application>(
                     app::Application::load(file, host::runtimeLayouts())),
                 task::LoopLimit::Budget),
        served(instance.tasks()), scheduler(instance.tasks()), name(instance.app().name) {
    served.addOuterHooks();
    const StrideAppV1 &app = instance.app();
    for (uint32_t i = 0; i < app.taskCount; ++i)
      tasks.push_back({app.tasks[i].name, std::chrono::nanoseconds(app.tasks[i].intervalNs),
                       app.tasks[i].priority});
  }

  Status state() {
    if (const std::optional<task::Fault> fault = instance.tasks().fault())
      return Failure{task::describe(*fault)};
    return Nothing{};
  }
  std::span<std::byte> area(ImageArea number) {
    const ImageAreaDesc &image = instance.app().image[number];
    return {instance.state() + image.offset, image.size};
  }

  host::Instance instance;
  monitor::SymbolServer served;
  task::VirtualScheduler scheduler;
  std::string name;
  std::vector<TaskInfo> tasks;
  bool initialised = false;
  int64_t timeNs = 0;
};

namespace {

/// Once for each thread that calls cycles.
void guardThread() { thread_local const task::MemoryGuard guard; }

} // namespace

Application::Application(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Application::Application(Application &&) noexcept = default;
Application &Application::operator=(Application &&) noexcept = default;

Application::~Application() {
  if (!impl_ || !impl_->initialised)
    return;
  guardThread();
  (void)impl_->instance.exit(impl_->timeNs);
}

Result<Application> Application::load(const std::string &file) {
  try {
    return Application(std::make_unique<Impl>(file));
  } catch (const std::exception &error) {
    return Failure{error.what()};
  }
}

const std::string &Application::name() const { return impl_->name; }
const std::vector<TaskInfo> &Application::tasks() const { return impl_->tasks; }

Status Application::initialise() {
  if (impl_->initialised)
    return Failure{"the application has been initialised already"};
  return attempt([this] {
    guardThread();
    impl_->instance.initialise();
    impl_->served.addInnerHooks();
    impl_->initialised = true;
  });
}

Status Application::cycle(size_t task, std::chrono::nanoseconds time) {
  if (!impl_->initialised)
    return Failure{"the application has not been initialised"};
  if (task >= impl_->tasks.size())
    return Failure{
        fmt::format("there is no task {}; the application has {}", task, impl_->tasks.size())};
  if (time.count() < impl_->timeNs)
    return Failure{"time does not go back"};
  impl_->timeNs = time.count();
  guardThread();
  impl_->instance.tasks().runCycle(static_cast<uint32_t>(task), time.count(), 0);
  return impl_->state();
}

Status Application::advance(std::chrono::nanoseconds time) {
  if (!impl_->initialised)
    return Failure{"the application has not been initialised"};
  return attempt([&] {
    guardThread();
    impl_->timeNs = impl_->scheduler.runUntil(time.count()).timeNs;
    if (const std::optional<task::Fault> fault = impl_->instance.tasks().fault())
      throw app::Error(task::describe(*fault));
  });
}

bool Application::stopped() const { return impl_->instance.tasks().stopped(); }

Result<std::string> Application::read(std::string_view name) const {
  try {
    const app::SymbolTable &symbols = impl_->instance.symbols();
    const app::Symbol symbol = app::resolveElementary(symbols, name);
    std::byte bit{};
    const void *value = symbol.read(impl_->instance.state(), bit);
    if (value == nullptr)
      return Failure{fmt::format("symbol '{}': a pointer on the way is null", name)};
    return app::formatLiteral(symbols.app(), symbols.type(symbol), value);
  } catch (const std::exception &error) {
    return Failure{error.what()};
  }
}

Status Application::write(std::string_view name, std::string_view literal) {
  return attempt([&] {
    const app::SymbolTable &symbols = impl_->instance.symbols();
    const app::Symbol symbol = app::resolveWritable(symbols, name);
    const std::vector<std::byte> value = app::literalBytes(symbols, symbol, literal);
    if (!symbol.write(impl_->instance.state(), value.data(), value.size()))
      throw app::Error(fmt::format("symbol '{}': a pointer on the way is null", name));
  });
}

Status Application::force(std::string_view name, std::string_view literal) {
  return attempt([&] { impl_->served.force({{std::string(name), std::string(literal)}}); });
}

Status Application::release(std::string_view name) {
  return attempt([&] { impl_->served.release({std::string(name)}); });
}

Result<Place> Application::findPlace(std::string_view name, size_t size, ValueClass kind) const {
  try {
    const app::SymbolTable &symbols = impl_->instance.symbols();
    auto place = std::make_shared<Place::Impl>();
    place->symbol = app::resolveElementary(symbols, name);
    place->state = impl_->instance.state();
    place->size = size;
    const TypeDesc &type = symbols.type(place->symbol);
    const Kind base = type.kind == Kind::Enum ? symbols.app().types[type.element].kind : type.kind;
    ValueClass has = ValueClass::Unsigned;
    if (base == Kind::BOOL)
      has = ValueClass::Bool;
    else if (base == Kind::REAL || base == Kind::LREAL)
      has = ValueClass::Real;
    else if (base <= Kind::LINT || base == Kind::LTIME || base == Kind::LDATE ||
             base == Kind::LTOD || base == Kind::LDT)
      has = ValueClass::Signed;
    if (has != kind || type.size != size || base == Kind::STRING || base == Kind::WSTRING)
      return Failure{fmt::format("symbol '{}': it is {}, which is not the type that it was "
                                 "looked up with",
                                 name, type.name)};
    return Place(std::move(place));
  } catch (const std::exception &error) {
    return Failure{error.what()};
  }
}

std::span<std::byte> Application::inputs() { return impl_->area(kImageInput); }
std::span<const std::byte> Application::outputs() const { return impl_->area(kImageOutput); }
std::span<std::byte> Application::memory() { return impl_->area(kImageMemory); }

std::vector<std::string> Application::problems() const { return impl_->instance.remarks(); }
std::vector<std::string> Application::takeMessages() { return impl_->instance.takeNews(); }

} // namespace stride::embed
