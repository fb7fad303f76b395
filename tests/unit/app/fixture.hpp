// The hand-written application, linked into the test program.
#ifndef STRIDE_TESTS_UNIT_APP_FIXTURE_HPP
#define STRIDE_TESTS_UNIT_APP_FIXTURE_HPP

#include "runtime/app/application.hpp"
#include "runtime/app/error.hpp"
#include "runtime/app/st_exception.hpp"
#include "runtime/app/symbols.hpp"
#include "runtime/app/value_text.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <string>

namespace stride::test {

/// A host that throws StException and knows nothing else.
inline const HostApi kThrowingHost = {
    sizeof(HostApi),
    0,
    nullptr,
    [](Ctx *, ExceptionCode code, const char *file, uint32_t line, uint32_t col,
       const char *detail) { throw StException(code, file, line, col, detail); },
    [](Ctx *) -> int64_t { return 0; },
    [](Ctx *, uint32_t, const char *) {},
};

class HandmadeApp : public ::testing::Test {
protected:
  HandmadeApp()
      : application(app::Application::fromDescription(*stride_app_v1())),
        symbols(application.description()) {
    application.initialise(kThrowingHost);
  }

  std::string read(const std::string &path) const {
    const app::Symbol symbol = symbols.resolve(path);
    const void *value = symbol.address(application.state());
    return value == nullptr ? std::string("null")
                            : app::formatLiteral(symbols.app(), symbols.type(symbol), value);
  }
  void write(const std::string &path, const std::string &text) {
    const app::Symbol symbol = symbols.resolve(path);
    app::parseLiteral(symbols.app(), symbols.type(symbol), text,
                      symbol.address(application.state()));
  }
  /// One cycle of a task.
  void cycle(uint32_t task = 0) {
    Ctx ctx{};
    ctx.state = application.state();
    ctx.host = &kThrowingHost;
    application.description().tasks[task].run(&ctx);
  }
  /// The message of the app::Error that f throws.
  template <class F> static std::string errorOf(F f) {
    try {
      f();
    } catch (const app::Error &error) {
      return error.what();
    }
    return "no error";
  }

  app::Application application;
  app::SymbolTable symbols;
};

} // namespace stride::test

#endif
