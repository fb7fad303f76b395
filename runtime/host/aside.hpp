// What serves a run besides its cycles may fail without harm to it.
#ifndef STRIDE_RUNTIME_HOST_ASIDE_HPP
#define STRIDE_RUNTIME_HOST_ASIDE_HPP

#include "runtime/host/messages.hpp"

#include <exception>
#include <new>
#include <string_view>

namespace stride::host {

/// One service of a run: its trace, its monitor. What goes wrong in it is said, once until it works
/// again, and the run goes on: the axes need their cycles.
class Aside {
public:
  /// `what`: the service, as the message begins; `then`: how it ends. Literals.
  Aside(Messages &messages, std::string_view what,
        std::string_view then = "; the run goes on") noexcept
      : messages_(&messages), what_(what), then_(then) {}

  /// Does it. False when it has failed with an exception.
  template <class F> bool operator()(const F &work) noexcept {
    try {
      work();
      failing_ = false;
      return true;
    } catch (const std::bad_alloc &) {
      fail("there is not enough memory");
    } catch (const std::exception &error) {
      fail(error.what());
    } catch (...) {
      fail("it has failed");
    }
    return false;
  }

private:
  void fail(std::string_view reason) noexcept {
    if (!failing_)
      messages_->say({"warning: ", what_, ": ", reason, then_});
    failing_ = true;
  }

  Messages *messages_;
  std::string_view what_;
  std::string_view then_;
  bool failing_ = false;
};

} // namespace stride::host

#endif
