#include "runtime/app/retain_layout.hpp"

#include "runtime/app/layout_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace stride::app {

namespace {

/// Bytes between two ranges that are cheaper to copy than to leave out.
constexpr uint64_t kGap = 16;
std::string dotted(const char *first, const char *second) {
  return first == nullptr ? std::string(second) : fmt::format("{}.{}", first, second);
}

/// The earlier name of an element `name` of `owner`, where either has one.
std::string earlierName(const char *owner, const char *ownerBefore, const char *name,
                        const char *before) {
  if (before == nullptr && ownerBefore == nullptr)
    return {};
  if (before != nullptr && std::string_view(before).find('.') != std::string_view::npos)
    return before;
  return dotted(ownerBefore != nullptr ? ownerBefore : owner, before != nullptr ? before : name);
}

} // namespace

/// Copies what is wanted of an application's description.
class RetainLayout::Pruner {
public:
  Pruner(const StrideAppV1 &app, uint32_t flags, RetainLayout &to,
         std::function<bool(const TypeDesc &)> leaveOut)
      : app_(app), flags_(flags), to_(to), leaveOut_(std::move(leaveOut)) {}

  void run() {
    located_.kind = Kind::Struct;
    located_.name = kLocated;
    located_.size = app_.stateSize;
    located_.align = 1;
    located_.element = kNoIndex;
    for (uint32_t i = 0; i < app_.rootCount; ++i)
      root(app_.roots[i]);
    if (!places_.empty()) {
      located_.firstMember = static_cast<uint32_t>(to_.members_.size());
      located_.memberCount = static_cast<uint32_t>(places_.size());
      to_.members_.insert(to_.members_.end(), places_.begin(), places_.end());
      to_.types_.push_back(located_);
      to_.roots_.push_back({nullptr, kLocated, 0, static_cast<uint32_t>(to_.types_.size() - 1), 0});
    }
    to_.setTables();
    to_.setRanges(std::move(ranges_));
  }

private:
  bool wanted(uint32_t flags) const { return (flags & flags_) != 0; }

  static bool never(uint32_t flags) {
    return (flags & (kSymConstant | kSymNonRetain | kSymTypeId | kSymSlot)) != 0;
  }

  void root(const RootDesc &root) {
    if (never(root.flags))
      return;
    const TypeDesc &type = app_.types[root.type];
    if (root.list == nullptr && std::string_view(root.name) == kLocated) {
      // A layout made of a layout.
      for (uint32_t i = 0; i < type.memberCount; ++i) {
        const MemberDesc &member = app_.members[type.firstMember + i];
        if (wanted(member.flags))
          place(member.name, member, root.task,
                member.renamedFrom != nullptr ? member.renamedFrom : "");
      }
      return;
    }
    if ((root.flags & kSymLocated) != 0) {
      if (wanted(root.flags)) {
        const MemberDesc member{root.name, root.offset, root.type, root.flags};
        place(dotted(root.list, root.name), member, root.task,
              root.renamedFrom == nullptr
                  ? std::string()
                  : earlierName(root.list, nullptr, root.name, root.renamedFrom));
      }
      return;
    }
    if (type.kind == Kind::Program) {
      for (uint32_t i = 0; i < type.memberCount; ++i) {
        const MemberDesc &member = app_.members[type.firstMember + i];
        if ((member.flags & kSymLocated) != 0 && !never(member.flags) && wanted(member.flags))
          place(dotted(root.name, member.name), member, root.task,
                earlierName(root.name, root.renamedFrom, member.name, member.renamedFrom));
      }
    }
    const bool whole = wanted(root.flags);
    const uint32_t own = prune(root.type, whole);
    if (own == kNoIndex)
      return;
    to_.roots_.push_back({root.list == nullptr ? nullptr : to_.keep(root.list), to_.keep(root.name),
                          root.offset, own, root.flags & kKept,
                          root.renamedFrom == nullptr ? nullptr : to_.keep(root.renamedFrom)});
    collect(own, root.offset, root.task, whole);
  }

  /// A variable in the process image.
  void place(const std::string &name, const MemberDesc &member, uint32_t task,
             const std::string &renamed) {
    const uint32_t own = prune(member.type, true);
    if (own == kNoIndex)
      return;
    places_.push_back({to_.keep(name), member.offset, own, member.flags & kKept,
                       renamed.empty() ? nullptr : to_.keep(renamed)});
    ranges_.push_back({member.offset, app_.types[member.type].size, task});
  }

  uint32_t prune(uint32_t type, bool whole) {
    const uint64_t key = uint64_t{type} * 2 + (whole ? 1 : 0);
    const auto found = known_.find(key);
    if (found != known_.end())
      return found->second;
    const uint32_t own = fresh(type, whole);
    known_.emplace(key, own);
    return own;
  }

  uint32_t fresh(uint32_t index, bool whole) {
    TypeDesc type = app_.types[index];
    if (isAddressSlot(type.kind) || (leaveOut_ && leaveOut_(type)))
      return kNoIndex;
    if (type.kind == Kind::Array) {
      type.element = prune(type.element, whole);
      return type.element == kNoIndex ? kNoIndex : add(type);
    }
    if (type.kind == Kind::Enum) {
      if (!whole)
        return kNoIndex;
      type.element = prune(type.element, true);
      const uint32_t first = static_cast<uint32_t>(to_.enumerators_.size());
      for (uint32_t i = 0; i < type.memberCount; ++i) {
        const EnumeratorDesc &own = app_.enumerators[type.firstMember + i];
        to_.enumerators_.push_back({to_.keep(own.name), own.value});
      }
      type.firstMember = first;
      return add(type);
    }
    if ((type.flags & kTypeRange) != 0 && whole)
      type.element = prune(type.element, true);
    if (!hasMembers(type.kind))
      return whole ? add(type) : kNoIndex;
    if (type.kind == Kind::Union && (!whole || (type.flags & kTypeHasAddress) != 0))
      return kNoIndex; // known as bytes only: all of it, or nothing
    std::vector<MemberDesc> members;
    for (uint32_t i = 0; i < type.memberCount; ++i) {
      const MemberDesc &member = app_.members[type.firstMember + i];
      if (never(member.flags) || (member.flags & kSymLocated) != 0)
        continue;
      const uint32_t own = prune(member.type, whole || wanted(member.flags));
      if (own != kNoIndex)
        members.push_back({to_.keep(member.name), member.offset, own, member.flags & kKept,
                           member.renamedFrom == nullptr ? nullptr : to_.keep(member.renamedFrom)});
    }
    if (members.empty())
      return kNoIndex;
    type.firstMember = static_cast<uint32_t>(to_.members_.size());
    type.memberCount = static_cast<uint32_t>(members.size());
    to_.members_.insert(to_.members_.end(), members.begin(), members.end());
    return add(type);
  }

  uint32_t add(TypeDesc type) {
    type.name = to_.keep(type.name);
    if (type.renamedFrom != nullptr)
      type.renamedFrom = to_.keep(type.renamedFrom);
    type.flags &= kTypeExternal | kTypeRange;
    to_.types_.push_back(type);
    return static_cast<uint32_t>(to_.types_.size() - 1);
  }

  /// A variable that is stored as a whole is one range, whatever is inside.
  void collect(uint32_t type, uint64_t offset, uint32_t task, bool whole) {
    const TypeDesc &desc = to_.types_[type];
    if (whole) {
      ranges_.push_back({offset, desc.size, task});
    } else if (desc.kind == Kind::Array) {
      const uint64_t size = to_.types_[desc.element].size;
      for (uint64_t i = 0; i < desc.elementCount; ++i)
        collect(desc.element, offset + i * size, task, false);
    } else {
      for (uint32_t i = 0; i < desc.memberCount; ++i) {
        const MemberDesc &member = to_.members_[desc.firstMember + i];
        collect(member.type, offset + member.offset, task, wanted(member.flags));
      }
    }
  }

  const StrideAppV1 &app_;
  uint32_t flags_;
  RetainLayout &to_;
  std::function<bool(const TypeDesc &)> leaveOut_;
  std::unordered_map<uint64_t, uint32_t> known_;
  std::vector<RetainRange> ranges_;
  std::vector<MemberDesc> places_;
  TypeDesc located_{};
};

RetainLayout::RetainLayout(const StrideAppV1 &app, uint32_t flags,
                           std::function<bool(const TypeDesc &)> leaveOut) {
  Pruner(app, flags, *this, std::move(leaveOut)).run();
}

const char *RetainLayout::keep(std::string_view text) {
  texts_.emplace_back(text);
  return texts_.back().c_str();
}

void RetainLayout::setTables() {
  app_.abiVersion = kAbiVersion;
  app_.magic = kAbiMagic;
  app_.size = sizeof app_;
  app_.name = "";
  app_.compiler = "";
  app_.stateAlign = 16;
  app_.init = [](Ctx *) {};
  app_.types = types_.data();
  app_.members = members_.data();
  app_.enumerators = enumerators_.data();
  app_.roots = roots_.data();
  app_.typeCount = static_cast<uint32_t>(types_.size());
  app_.memberCount = static_cast<uint32_t>(members_.size());
  app_.enumeratorCount = static_cast<uint32_t>(enumerators_.size());
  app_.rootCount = static_cast<uint32_t>(roots_.size());
  for (const RootDesc &root : roots_)
    app_.stateSize = std::max(app_.stateSize, root.offset + types_[root.type].size);
}

void RetainLayout::setRanges(std::vector<RetainRange> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const RetainRange &a, const RetainRange &b) {
    return a.task != b.task ? a.task < b.task
                            : (a.offset != b.offset ? a.offset < b.offset : a.size > b.size);
  });
  for (const RetainRange &range : ranges) {
    if (!ranges_.empty() && ranges_.back().task == range.task &&
        range.offset <= ranges_.back().offset + ranges_.back().size + kGap) {
      RetainRange &last = ranges_.back();
      last.size = std::max(last.size, range.offset + range.size - last.offset);
    } else {
      ranges_.push_back(range);
    }
  }
  for (const RetainRange &range : ranges_)
    bytes_ += range.size;
}

namespace {

/// The outermost variables with a flag below a type.
void appendVariables(const StrideAppV1 &app, uint32_t type, uint32_t flags, const std::string &path,
                     std::vector<std::string> &out) {
  const TypeDesc &desc = app.types[type];
  if ((flags & kRetained) != 0) {
    out.push_back(path);
  } else if (desc.kind == Kind::Array) {
    const int64_t last = desc.lowerBound + static_cast<int64_t>(desc.elementCount) - 1;
    const std::string index = fmt::format("{}..{}]", desc.lowerBound, last);
    appendVariables(app, desc.element, 0,
                    path.back() == ']' ? path.substr(0, path.size() - 1) + "," + index
                                       : path + "[" + index,
                    out);
  } else if (hasMembers(desc.kind)) {
    for (uint32_t i = 0; i < desc.memberCount; ++i) {
      const MemberDesc &member = app.members[desc.firstMember + i];
      if ((member.flags & kSymBase) != 0)
        appendVariables(app, member.type, 0, path, out);
      else
        appendVariables(app, member.type, member.flags,
                        path == kLocated ? std::string(member.name)
                                         : fmt::format("{}.{}", path, member.name),
                        out);
    }
  }
}

} // namespace

std::vector<std::string> RetainLayout::variables() const {
  std::vector<std::string> out;
  for (const RootDesc &root : roots_)
    appendVariables(app_, root.type, root.flags, dotted(root.list, root.name), out);
  return out;
}

} // namespace stride::app
