// Any bytes as an input script: read, and stepped if it is one.
#include "runtime/app/application.hpp"
#include "runtime/app/error.hpp"
#include "runtime/script/script.hpp"
#include "runtime/task/fault.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stride;
  app::Application application = app::Application::fromDescription(*stride_app_v1());
  application.initialise(task::hostApi());
  const app::SymbolTable symbols(application.description());
  try {
    script::Script script(symbols, std::string_view(reinterpret_cast<const char *>(data), size),
                          "fuzz");
    for (int64_t time = 0; time < 1'000'000'000; time += 100'000'000)
      script.step(time, application.state());
    (void)script.nextNs();
    (void)script.remarks();
  } catch (const app::Error &) { // what a bad script is told
  }
  return 0;
}
