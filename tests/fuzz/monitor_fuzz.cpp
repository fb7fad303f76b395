// Any bytes as lines of the monitor's protocol, for an application that runs its cycles between
// them.
#include "runtime/app/application.hpp"
#include "runtime/monitor/service.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stride;
  app::Application application = app::Application::fromDescription(*stride_app_v1());
  application.initialise(task::hostApi());
  task::TaskSet tasks(application.description(), application.state(), task::hostApi(),
                      task::LoopLimit::Budget);
  monitor::SymbolServer server(tasks);
  server.addOuterHooks();
  server.addInnerHooks();
  size_t sent = 0;
  monitor::Service service(
      [&](monitor::Service::ClientId, const std::string &line) { sent += line.size(); });
  service.attach(0, {"handmade", &server, &tasks, [] { return int64_t{0}; }});
  std::string_view text(reinterpret_cast<const char *>(data), size);
  for (int64_t time = 1; !text.empty() && !tasks.stopped(); time += 10'000'000) {
    const size_t end = std::min(text.find('\n'), text.size());
    service.handle(1, text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    tasks.runCycle(0, time, 0);
    tasks.runCycle(1, time, 0);
    service.poll(time);
  }
  service.detach(0);
  return 0;
}
