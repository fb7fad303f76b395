// What a run has to say, on standard error.
#ifndef STRIDE_RUNTIME_HOST_MESSAGES_HPP
#define STRIDE_RUNTIME_HOST_MESSAGES_HPP

#include "runtime/host/output.hpp"

#include <cstdint>
#include <initializer_list>
#include <mutex>
#include <string_view>

namespace stride::host {

/// The one way to standard error. Saying something neither throws nor allocates, and with
/// Output::Wait::Never it waits for nobody: a full disk, a log collector that has gone or does not
/// read must not end a run. Lines that cannot be written are counted; that is said as soon as
/// something can be written again. From any thread but a task's.
class Messages {
public:
  explicit Messages(Output::Wait wait, int handle = 2);

  /// One message: the parts one after the other, and a line's end where there is none.
  void say(std::initializer_list<std::string_view> parts) noexcept;
  void say(std::string_view text) noexcept { say({text}); }
  /// As it is, for a line that is shown again and again; it counts as no message.
  void show(std::string_view text) noexcept;
  /// A line that stays below the messages until the next one takes its place; empty: none any more.
  /// For terminals only.
  void showStatus(std::string_view text) noexcept;
  /// Every now and then: tries again what waits for its reader.
  void lookAfter() noexcept;
  /// At the end, when nothing moves any more: waits for a reader who reads. False: there are lines
  /// that nobody will see.
  bool finish() noexcept;

private:
  void hideStatus() noexcept;
  void tellLosses() noexcept;
  void push() noexcept;

  std::mutex mutex_;
  Output output_;
  uint64_t lost_ = 0; ///< Lines, since that was said.
  int reason_ = 0;    ///< errno; 0: nobody has read them.
  bool cutOff_ = false;
  bool status_ = false; ///< There is a status line.
};

} // namespace stride::host

#endif
