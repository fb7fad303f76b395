#include "runtime/app/application.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/validate.hpp"

#include <fmt/format.h>

#include <dlfcn.h>
#include <sys/stat.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace stride::app {

namespace {

using EntryPoint = const StrideAppV1 *();

/// Loads what dlopen finds under exactly this name (a bare name would search the library path).
std::string exactPath(const std::string &path) {
  return path.find('/') == std::string::npos ? "./" + path : path;
}

} // namespace

void Application::Closer::operator()(void *library) const { ::dlclose(library); }

Application::Application(std::unique_ptr<const DescribedApplication> described)
    : described_(std::move(described)), name_(description().name), state_(description().stateSize) {
}

std::unique_ptr<const DescribedApplication> Application::checked(const StrideAppV1 &description,
                                                                 const RuntimeLayouts &layouts) {
  checkHead(description, layouts);
  auto described = std::make_unique<const DescribedApplication>(description);
  validate(described->description(), layouts);
  return described;
}

void Application::setDefaultName(const std::string &name) {
  if (*description().name == 0)
    name_ = name;
}

Application Application::load(const std::string &path, const RuntimeLayouts &layouts) {
  struct ::stat info {};
  if (::stat(path.c_str(), &info) != 0)
    throw Error(fmt::format("cannot open application '{}': {}", path, std::strerror(errno)));
  if (!S_ISREG(info.st_mode))
    throw Error(
        fmt::format("'{}' is not a file; give the application that 'stride build' made", path));
  ::dlerror();
  std::unique_ptr<void, Closer> library(::dlopen(exactPath(path).c_str(), RTLD_NOW | RTLD_LOCAL));
  if (library == nullptr) {
    const char *reason = ::dlerror();
    throw Error(fmt::format("'{}' is not a loadable application: {}\n"
                            "  build it with 'stride build' on this kind of machine",
                            path, reason != nullptr ? reason : "unknown reason"));
  }
  void *symbol = ::dlsym(library.get(), "stride_app_v1");
  if (symbol == nullptr)
    throw Error(fmt::format("'{}' is a shared object, but not a Stride application: it does not "
                            "define stride_app_v1\n  build it with 'stride build'",
                            path));
  const StrideAppV1 *description = std::bit_cast<EntryPoint *>(symbol)();
  std::unique_ptr<const DescribedApplication> described;
  try {
    if (description == nullptr)
      throw Error("it describes nothing");
    described = checked(*description, layouts);
  } catch (const Error &error) {
    throw Error(fmt::format("cannot run '{}': {}", path, error.what()));
  }
  Application application(std::move(described));
  application.library_ = std::move(library);
  application.setDefaultName(std::filesystem::path(path).stem().string());
  return application;
}

Application Application::fromDescription(const StrideAppV1 &description,
                                         const RuntimeLayouts &layouts) {
  Application application(checked(description, layouts));
  application.setDefaultName("app");
  return application;
}

void Application::initialise(const HostApi &host, bool inCopyCode, bool keepRetains,
                             const InitCall &call) {
  std::memset(state_.data(), 0, state_.size());
  Ctx ctx{};
  ctx.state = state_.data();
  ctx.host = &host;
  ctx.loopBudget = INT64_MAX;
  ctx.firstCycle = 1;
  ctx.inCopyCode = inCopyCode ? 1 : 0;
  ctx.keepRetains = keepRetains ? 1 : 0;
  call(description().init, ctx);
}

void Application::settle() {
  if (description().settle == nullptr)
    return;
  Ctx ctx{};
  ctx.state = state_.data();
  description().settle(&ctx);
}

} // namespace stride::app
