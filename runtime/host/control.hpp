// `stride-host ctl`: a running application from the command line.
#ifndef STRIDE_RUNTIME_HOST_CONTROL_HPP
#define STRIDE_RUNTIME_HOST_CONTROL_HPP

#include <memory>

namespace CLI {
class App;
}

namespace stride::host {

/// The command `ctl` with its own commands.
class Control {
public:
  Control();
  ~Control();
  Control(const Control &) = delete;
  Control &operator=(const Control &) = delete;

  /// Declares its options; the command lives as long as this.
  void declare(CLI::App &command);
  /// After parsing. Returns the exit code; throws app::Error.
  int run();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace stride::host

#endif
