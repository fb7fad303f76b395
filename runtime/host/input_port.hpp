// Where everything passes that a program can see and that does not follow from its own state.
#ifndef STRIDE_RUNTIME_HOST_INPUT_PORT_HPP
#define STRIDE_RUNTIME_HOST_INPUT_PORT_HPP

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace stride::host {

/// What a device, a drive or a clock has given passes here on its way into the program, inside of
/// the cycle: live, nothing happens to it; a recording notes it; a replay puts the noted value in
/// its place. So a replay repeats a recorded run bit for bit. See docs/recording.md.
class InputPort {
public:
  InputPort() = default;
  InputPort(const InputPort &) = delete;
  InputPort &operator=(const InputPort &) = delete;
  virtual ~InputPort() = default;

  /// `value` is plain memory of `size` bytes. Neither allocates, locks nor throws.
  virtual void pass(void *value, size_t size) noexcept = 0;
  template <class T> void pass(T &value) noexcept {
    static_assert(std::is_trivially_copyable_v<T>);
    pass(&value, sizeof value);
  }

  /// The values are those of a recording: the devices behind need not exist.
  virtual bool replays() const noexcept { return false; }
};

/// Values pass as they are.
class LiveInputs final : public InputPort {
public:
  using InputPort::pass;
  void pass(void *, size_t) noexcept override {}
};

} // namespace stride::host

#endif
