// The hand-written application with a symbol server, its cycles called one by one.
#ifndef STRIDE_TESTS_UNIT_MONITOR_SERVED_APP_HPP
#define STRIDE_TESTS_UNIT_MONITOR_SERVED_APP_HPP

#include "runtime/monitor/symbol_server.hpp"
#include "tests/unit/app/fixture.hpp"

#include <memory>

namespace stride::test {

class ServedApp : public HandmadeApp {
protected:
  ServedApp()
      : tasks(application.description(), application.state(), task::hostApi(),
              task::LoopLimit::Budget),
        server(tasks) {
    server.addOuterHooks();
    server.addInnerHooks();
  }

  /// One cycle of the fast task.
  void run() {
    tasks.runCycle(0, timeNs, 0);
    timeNs += 10'000'000;
  }
  /// The values of a request that is done, as literals with blanks between.
  std::string shown(const monitor::SymbolRequest &request) const {
    std::string text;
    for (const monitor::SymbolRequest::Value &value : request.values())
      text += (text.empty() ? "" : " ") +
              (value.reached ? app::formatLiteral(symbols.app(), symbols.type(value.symbol),
                                                  request.bytes(value))
                             : std::string("null"));
    return text;
  }

  task::TaskSet tasks;
  monitor::SymbolServer server;
  int64_t timeNs = 0;
};

} // namespace stride::test

#endif
