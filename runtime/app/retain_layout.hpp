// Which variables of an application are retained, where they lie, and how a file says so.
#ifndef STRIDE_RUNTIME_APP_RETAIN_LAYOUT_HPP
#define STRIDE_RUNTIME_APP_RETAIN_LAYOUT_HPP

#include "runtime/app/abi.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace stride::app {

/// Everything that is stored: RETAIN and PERSISTENT, which implies it.
inline constexpr uint32_t kRetained = kSymRetain | kSymPersistent;

/// The name of the structure that stands for what lies in the process image.
inline constexpr const char *kLocated = "%";

/// The SymbolFlags that a layout keeps.
inline constexpr uint32_t kKept =
    kRetained | kSymBase | kSymHidden | kSymBit | (7U << kSymBitShift) | kSymNonRetain;

/// Bytes of the state that are stored.
struct RetainRange {
  uint64_t offset; ///< From the start of the state.
  uint64_t size;
  uint32_t task; ///< Whose cycle changes them: RootDesc::task.

  bool operator==(const RetainRange &) const = default;
};

/// The retained variables of one build: a description like that of the application, with the same
/// offsets, but of nothing else than what is stored. No pointers, references, in-outs, interfaces,
/// type ids, constants, NON_RETAIN variables, and no unions that hold an address. What lies in the
/// process image is a member `Program.name` or `List.name` of a structure `%`, with its place in
/// the state.
class RetainLayout {
public:
  /// Of the variables that have one of these SymbolFlags, or are inside of one that has, except
  /// those of types for which `leaveOut` is true. The application is valid (validate.hpp); it is
  /// not needed afterwards.
  RetainLayout(const StrideAppV1 &app, uint32_t flags,
               std::function<bool(const TypeDesc &)> leaveOut = {});

  /// What encode() wrote, out of a file: nothing about it is taken for granted. Throws Error.
  static RetainLayout decode(std::span<const std::byte> bytes);

  RetainLayout(RetainLayout &&) noexcept = default;
  RetainLayout &operator=(RetainLayout &&) noexcept = default;
  RetainLayout(const RetainLayout &) = delete;
  RetainLayout &operator=(const RetainLayout &) = delete;
  ~RetainLayout() = default;

  /// Valid (validate.hpp); lives as long as the layout. Name and hashes are empty, there are no
  /// tasks. Its state size reaches to the end of the last stored byte.
  const StrideAppV1 &description() const { return app_; }
  bool empty() const { return ranges_.empty(); }

  /// By task, then offset; together they hold every stored variable, and bytes between them that
  /// are never put back.
  std::span<const RetainRange> ranges() const { return ranges_; }
  /// Sum of their sizes.
  uint64_t bytes() const { return bytes_; }

  /// Description and ranges as bytes; equal layouts give equal bytes.
  std::vector<std::byte> encode() const;
  /// True if both store the same variables at the same places.
  bool sameAs(const RetainLayout &other) const { return encode() == other.encode(); }

  /// The outermost stored variables, as messages name them: `Main.count`, `GVL.x`,
  /// `Main.a[1..3].b`.
  std::vector<std::string> variables() const;

private:
  class Pruner;
  class Decoder;
  RetainLayout() = default;
  const char *keep(std::string_view text);
  void setTables();
  void setRanges(std::vector<RetainRange> ranges);

  std::deque<std::string> texts_;
  std::vector<TypeDesc> types_; ///< A type comes after those it consists of.
  std::vector<MemberDesc> members_;
  std::vector<EnumeratorDesc> enumerators_;
  std::vector<RootDesc> roots_;
  std::vector<RetainRange> ranges_;
  uint64_t bytes_ = 0;
  StrideAppV1 app_{};
};

} // namespace stride::app

#endif
