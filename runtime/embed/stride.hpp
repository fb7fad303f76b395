// Compiled applications inside of another C++ program.
//
// The program decides when a task's cycle runs and what time it is; this library owns the
// application's memory. Nothing here throws: what can fail returns a Result. Only this header is
// meant to be included. See docs/embedding.md and examples/embed.
#ifndef STRIDE_RUNTIME_EMBED_STRIDE_HPP
#define STRIDE_RUNTIME_EMBED_STRIDE_HPP

#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace stride::embed {

/// Why something was not possible: a sentence for people.
struct Failure {
  std::string message;
};

/// A value, or why there is none.
template <class T> class Result {
public:
  Result(T value) : content_(std::move(value)) {}
  Result(Failure failure) : content_(std::move(failure)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }
  /// Only if ok().
  T &value() { return *std::get_if<0>(&content_); }
  const T &value() const { return *std::get_if<0>(&content_); }
  /// Only if not ok().
  const std::string &message() const { return std::get_if<1>(&content_)->message; }

private:
  std::variant<T, Failure> content_;
};

struct Nothing {};
/// Done, or why not.
using Status = Result<Nothing>;

/// A task of an application.
struct TaskInfo {
  std::string name;
  std::chrono::nanoseconds interval{}; ///< 0: only on an event.
  unsigned priority = 0;               ///< 0 is the highest.
};

/// Types that a Variable can have.
template <class T>
concept Elementary = std::same_as<T, bool> || std::same_as<T, int8_t> || std::same_as<T, int16_t> ||
    std::same_as<T, int32_t> || std::same_as<T, int64_t> || std::same_as<T, uint8_t> ||
    std::same_as<T, uint16_t> || std::same_as<T, uint32_t> || std::same_as<T, uint64_t> ||
    std::same_as<T, float> || std::same_as<T, double>;

/// Where a variable is; see Application::find. Not after the end of its application.
class Place {
public:
  /// Copies the value; false where a pointer on the way is null.
  bool load(void *value) const noexcept;
  bool store(const void *value) const noexcept;

private:
  friend class Application;
  struct Impl;
  explicit Place(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// A variable whose name is resolved: access without allocation. Between cycles.
template <Elementary T> class Variable {
public:
  explicit Variable(Place place) : place_(std::move(place)) {}

  /// Nothing where a pointer on the way is null.
  std::optional<T> get() const noexcept {
    T value{};
    return place_.load(&value) ? std::optional<T>(value) : std::nullopt;
  }
  bool set(T value) const noexcept { return place_.store(&value); }

private:
  Place place_;
};

/// One compiled application with its state. Any number of them live side by side and share nothing,
/// also several of the same file. Functions of one application are not called at the same time from
/// several threads.
class Application {
public:
  /// Loads what `stride build` has made.
  static Result<Application> load(const std::string &file);
  Application(Application &&) noexcept;
  Application &operator=(Application &&) noexcept;
  /// Calls FB_Exit of the instances.
  ~Application();

  const std::string &name() const;
  const std::vector<TaskInfo> &tasks() const;

  /// Sets the initial values and makes ready the drives of the PLC configuration. Once, first.
  Status initialise();

  /// One cycle of a task at that time of the program. Not earlier than the cycle before. Drives are
  /// served by the cycles of their task. Fails when an exception has stopped the application.
  Status cycle(size_t task, std::chrono::nanoseconds time);
  /// All cycles of all tasks that are due before that time, in their order, also those that events
  /// start. Either this or cycle(), not both.
  Status advance(std::chrono::nanoseconds time);
  /// The exception has stopped it, or nothing has.
  bool stopped() const;

  /// The value as an ST literal: `TRUE`, `50`, `T#1s500ms`, `'text'`.
  Result<std::string> read(std::string_view name) const;
  Status write(std::string_view name, std::string_view literal);
  /// From its next cycles on the variable has the value, whatever the program writes.
  Status force(std::string_view name, std::string_view literal);
  Status release(std::string_view name);
  /// For access again and again; the type must be that of the variable (BOOL: bool, WORD:
  /// uint16_t, LREAL: double; an enumeration: its base type).
  template <Elementary T> Result<Variable<T>> find(std::string_view name) const {
    Result<Place> place = findPlace(name, sizeof(T), classOf<T>());
    if (!place)
      return Failure{place.message()};
    return Variable<T>(std::move(place.value()));
  }

  /// The process image, between cycles: %I, %Q, %M. Empty where the application uses none. A Q
  /// that nobody writes keeps what is put there.
  std::span<std::byte> inputs();
  std::span<const std::byte> outputs() const;
  std::span<std::byte> memory();

  /// What keeps the drives from working, to be shown; empty if nothing does.
  std::vector<std::string> problems() const;
  /// What was to be said since the last call: a failed assertion, a drive that has reported an
  /// error, a file that could not be written. Nothing is written to standard error.
  std::vector<std::string> takeMessages();

private:
  enum class ValueClass : uint8_t { Bool, Signed, Unsigned, Real };
  template <class T> static constexpr ValueClass classOf() {
    if constexpr (std::same_as<T, bool>)
      return ValueClass::Bool;
    else if constexpr (std::same_as<T, float> || std::same_as<T, double>)
      return ValueClass::Real;
    else
      return static_cast<T>(-1) < T{0} ? ValueClass::Signed : ValueClass::Unsigned;
  }
  Result<Place> findPlace(std::string_view name, size_t size, ValueClass kind) const;

  struct Impl;
  explicit Application(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

} // namespace stride::embed

#endif
