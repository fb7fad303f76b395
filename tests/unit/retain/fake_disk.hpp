#ifndef STRIDE_TESTS_UNIT_RETAIN_FAKE_DISK_HPP
#define STRIDE_TESTS_UNIT_RETAIN_FAKE_DISK_HPP
// Files of retained data on a disk that may lose its power after every call.

#include "runtime/app/retain_store.hpp"
#include "tests/unit/app/app_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace stride::test {

using app::RetainImage;
using app::RetainLayout;
using app::RetainStore;

/// What was done and is not known to be on the disk.
struct Written {
  int file;
  size_t offset;
  std::vector<std::byte> bytes;
};
struct Named {
  std::string name;
  int file; ///< -1: the name goes away.
};
using Pending = std::variant<Written, Named>;

using Bytes = std::vector<std::byte>;

/// The disk as it is after a power failure.
struct Disk {
  std::map<int, Bytes> files;
  std::map<std::string, int> names;

  void apply(const Pending &pending) {
    if (const auto *written = std::get_if<Written>(&pending)) {
      Bytes &bytes = files[written->file];
      bytes.resize(std::max(bytes.size(), written->offset + written->bytes.size()));
      std::copy(written->bytes.begin(), written->bytes.end(),
                bytes.begin() + static_cast<ptrdiff_t>(written->offset));
    } else if (const auto *named = std::get_if<Named>(&pending)) {
      if (named->file < 0)
        names.erase(named->name);
      else
        names[named->name] = named->file;
    }
  }
};

/// The power is gone.
struct PowerCut {};

/// A disk with a cache before it. Write, sync and rename come as the calls of the interface
/// do; every write is split, so that it can be torn.
class FakeFiles final : public app::RetainFiles {
public:
  int callsLeft = 1 << 30; ///< The power is gone after so many calls.
  int failing = -1;        ///< This call, counted from 0, fails with `error`.
  int error = ENOSPC;
  int calls = 0;

  int create(const std::string &path, int &handle) override {
    return call([&] {
      // Emptying an existing file is like a new one in its place, in any order with the rest.
      handle = ++lastFile_;
      disk_.files[handle] = {};
      seen_.files[handle] = {};
      change({Named{path, handle}});
    });
  }
  int write(int handle, std::span<const std::byte> bytes) override {
    return call([&] {
      const size_t piece = std::max<size_t>(1, bytes.size() / 3 + 1);
      for (size_t at = 0; at < bytes.size(); at += piece) {
        const auto part = bytes.subspan(at, std::min(piece, bytes.size() - at));
        change({Written{handle, seen_.files[handle].size(), {part.begin(), part.end()}}});
      }
    });
  }
  int sync(int handle) override {
    return call([&] {
      std::vector<Pending> left;
      for (const Pending &pending : pending_) {
        const auto *written = std::get_if<Written>(&pending);
        if (written != nullptr && written->file == handle)
          disk_.apply(pending);
        else
          left.push_back(pending);
      }
      pending_ = std::move(left);
    });
  }
  int close(int) override {
    return call([] {});
  }
  int rename(const std::string &from, const std::string &to) override {
    return call([&] {
      const int file = seen_.names.at(from);
      // Both names of one rename change together, or the old one stays.
      change({Named{to, file}});
      change({Named{from, -1}});
    });
  }
  int remove(const std::string &path) override {
    if (!seen_.names.contains(path))
      return ENOENT;
    return call([&] { change({Named{path, -1}}); });
  }
  int syncFolder(const std::string &) override {
    return call([&] {
      std::vector<Pending> left;
      for (const Pending &pending : pending_) {
        if (std::holds_alternative<Named>(pending))
          disk_.apply(pending);
        else
          left.push_back(pending);
      }
      pending_ = std::move(left);
    });
  }
  int read(const std::string &path, std::vector<std::byte> &bytes) override {
    const auto found = seen_.names.find(path);
    if (found == seen_.names.end())
      return ENOENT;
    bytes = seen_.files[found->second];
    return 0;
  }

  const std::vector<Pending> &pending() const { return pending_; }
  /// After the failure, with these of the pending changes, in this order.
  void restart(const std::vector<size_t> &order) {
    for (const size_t i : order)
      disk_.apply(pending_[i]);
    pending_.clear();
    seen_ = disk_;
    callsLeft = 1 << 30;
    failing = -1;
  }
  /// The process ends, the machine goes on.
  void processEnds() { callsLeft = 1 << 30; }

  FakeFiles() = default;
  std::unique_ptr<FakeFiles> copy() const {
    auto other = std::make_unique<FakeFiles>();
    other->disk_ = disk_;
    other->seen_ = seen_;
    other->pending_ = pending_;
    other->lastFile_ = lastFile_;
    return other;
  }

private:
  template <class Do> int call(Do action) {
    if (callsLeft == 0)
      throw PowerCut();
    --callsLeft;
    if (calls++ == failing)
      return error;
    action();
    return 0;
  }
  void change(Pending pending) {
    seen_.apply(pending);
    pending_.push_back(std::move(pending));
  }

  Disk disk_; ///< What is safe.
  Disk seen_; ///< What the processes see.
  std::vector<Pending> pending_;
  int lastFile_ = 0;
};

/// Every subset of `count` things in every order (orders only up to four things: the combinations
/// grow with the factorial).
inline std::vector<std::vector<size_t>> outcomes(size_t count) {
  std::vector<std::vector<size_t>> out;
  for (size_t set = 0; set < size_t{1} << count; ++set) {
    std::vector<size_t> order;
    for (size_t i = 0; i < count; ++i)
      if ((set >> i & 1U) != 0)
        order.push_back(i);
    out.push_back(order);
    if (order.size() > 4) {
      std::reverse(order.begin(), order.end());
      out.push_back(order);
      continue;
    }
    while (std::next_permutation(order.begin(), order.end()))
      out.push_back(order);
  }
  return out;
}

/// Values that show which generation they are, and whether they are complete.
class Generations {
public:
  Generations() {
    model_.root("G", "x", model_.array(model_.elementary(Kind::UDINT), 0, 9), kSymRetain);
    layout_.emplace(model_.finish(), app::kRetained);
    encoded_ = layout_->encode();
  }
  void save(RetainStore &store, uint32_t generation) const {
    std::vector<uint32_t> values(10, generation);
    store.save("model", 1, encoded_, std::as_bytes(std::span(values)));
  }
  /// 0: there is none.
  static uint32_t load(RetainStore &store, std::vector<std::string> &problems) {
    const std::optional<RetainImage> image = store.load(problems);
    if (!image)
      return 0;
    std::vector<uint32_t> values(10);
    EXPECT_EQ(image->values.size(), 40U);
    std::memcpy(values.data(), image->values.data(), 40);
    EXPECT_TRUE(std::all_of(values.begin(), values.end(), [&](uint32_t value) {
      return value == values[0];
    })) << "torn";
    return values[0];
  }

private:
  AppModel model_;
  std::optional<RetainLayout> layout_;
  std::vector<std::byte> encoded_;
};

} // namespace stride::test

#endif // STRIDE_TESTS_UNIT_RETAIN_FAKE_DISK_HPP
