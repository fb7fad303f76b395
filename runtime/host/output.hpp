// Bytes on their way to a file, a pipe, a terminal or a socket.
#ifndef STRIDE_RUNTIME_HOST_OUTPUT_HPP
#define STRIDE_RUNTIME_HOST_OUTPUT_HPP

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace stride::host {

/// The text as the file may show it: to a terminal without control characters.
std::string shownOn(std::FILE *file, std::string text);

/// Text that waits in memory until it is written. Once it exists, nothing throws or allocates, and
/// what cannot be written is no exception but an error() to look at: whoever writes for a running
/// application has axes to serve.
class Output {
public:
  /// What a pipe, a terminal or a socket whose reader does not read means.
  enum class Wait : uint8_t {
    Always, ///< advance() waits for it.
    Never,  ///< The text stays where it is; settle() waits for a limited time.
  };
  /// For a reader who does not read, when nothing else is to be done any more.
  static constexpr std::chrono::milliseconds kPatience{2000};

  /// Creates the file, or empties it. Throws app::Error. `capacity`: of the memory. [bytes]
  Output(const std::string &path, size_t capacity, Wait wait);
  /// Standard output or standard error, which stay open and as they are for others who have them.
  Output(int handle, size_t capacity, Wait wait);
  Output(const Output &) = delete;
  Output &operator=(const Output &) = delete;
  ~Output();

  /// Whether so many bytes can be appended to text().
  bool room(size_t size) noexcept;
  /// The same, after what waits has been tried once more; with Wait::Always append() always can.
  bool ready(size_t size) noexcept;
  /// What is not written yet; to append to, as far as there is room.
  std::string &text() noexcept { return text_; }
  /// Appends all of it, in pieces if need be. With Wait::Never false, and nothing of it is there,
  /// when there is no room.
  bool append(std::string_view text) noexcept;
  /// As append(), for text that moves the cursor on purpose: all other control characters, but line
  /// ends and tabs, are shown to a terminal as `?`. They come from the application.
  bool appendControls(std::string_view text) noexcept;
  bool empty() const noexcept { return text_.size() == written_; }
  /// What is not written yet.
  std::string_view rest() const noexcept { return std::string_view(text_).substr(written_); }

  /// Writes what there is. False when something is left, or an error has come: after one nothing
  /// is written any more, until forgive().
  bool advance() noexcept;
  /// As advance(), and waits as long as at least something is taken in each `patience`.
  bool settle(std::chrono::milliseconds patience = kPatience) noexcept;
  /// The errno of what could not be written, or 0.
  int error() const noexcept { return error_; }
  /// Forgets the error and what could not be written; the next text is tried again.
  void forgive() noexcept;
  /// settle(), then closes a file of its own; what comes after it is lost. False: not all of the
  /// text is written.
  bool finish(std::chrono::milliseconds patience = kPatience) noexcept;

private:
  void screen() noexcept;
  long writeSome(std::string_view text) const noexcept;
  bool waitForReader(int limitMs) const noexcept;

  int handle_ = -1;
  bool owned_ = false;    ///< To be closed.
  bool isSocket_ = false; ///< Not waited for by a flag of its own.
  bool byPoll_ = false;   ///< Others have it, too: not waited for by looking before.
  Wait wait_;
  size_t capacity_;
  std::string text_;
  size_t written_ = 0;
  bool isTerminal_ = false;
  size_t screened_ = 0; ///< So much of the text is fit for a terminal.
  int error_ = 0;
};

} // namespace stride::host

#endif
