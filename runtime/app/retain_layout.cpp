#include "runtime/app/retain_layout.hpp"

#include "runtime/app/byte_stream.hpp"
#include "runtime/app/layout_index.hpp"
#include "runtime/app/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace stride::app {

namespace {

/// Bytes between two ranges that are cheaper to copy than to leave out.
constexpr uint64_t kGap = 16;
/// The largest state that a file may speak of.
constexpr uint64_t kMostState = uint64_t{1} << 30;
/// Types inside of each other.
constexpr uint32_t kMostDepth = 256;
/// More ranges than any program needs.
constexpr size_t kMostRanges = size_t{1} << 24;

/// The name of the structure with what lies in the process image.
constexpr const char *kLocated = "%";

/// What SymbolFlags the file keeps.
constexpr uint32_t kKept =
    kRetained | kSymBase | kSymHidden | kSymBit | (7U << kSymBitShift) | kSymNonRetain;

/// Bytes of a value of an elementary kind; 0 for others.
uint64_t elementarySize(Kind kind) {
  switch (kind) {
  case Kind::BOOL:
  case Kind::SINT:
  case Kind::USINT:
  case Kind::BYTE:
  case Kind::CHAR:
    return 1;
  case Kind::INT:
  case Kind::UINT:
  case Kind::WORD:
  case Kind::WCHAR:
    return 2;
  case Kind::DINT:
  case Kind::UDINT:
  case Kind::DWORD:
  case Kind::REAL:
  case Kind::TIME:
  case Kind::DATE:
  case Kind::TOD:
  case Kind::DT:
    return 4;
  case Kind::LINT:
  case Kind::ULINT:
  case Kind::LWORD:
  case Kind::LREAL:
  case Kind::LTIME:
  case Kind::LDATE:
  case Kind::LTOD:
  case Kind::LDT:
    return 8;
  default:
    return 0;
  }
}

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
    type.flags &= kTypeExternal;
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

std::vector<std::byte> RetainLayout::encode() const {
  ByteWriter out;
  const auto optional = [&](const char *text) { out.text(text == nullptr ? "" : text); };
  out.number(app_.enumeratorCount);
  for (const EnumeratorDesc &e : enumerators_) {
    out.text(e.name);
    out.number(e.value);
  }
  out.number(app_.memberCount);
  for (const MemberDesc &m : members_) {
    out.text(m.name);
    out.number(m.offset);
    out.number(m.type);
    out.number(m.flags);
    optional(m.renamedFrom);
  }
  out.number(app_.typeCount);
  for (const TypeDesc &t : types_) {
    out.number(static_cast<uint32_t>(t.kind));
    out.number(t.flags);
    out.text(t.name);
    out.number(t.size);
    out.number(t.layoutHash);
    out.number(t.align);
    out.number(t.firstMember);
    out.number(t.memberCount);
    out.number(t.element);
    out.number(t.lowerBound);
    out.number(t.elementCount);
    out.number(t.stringLength);
    optional(t.renamedFrom);
  }
  out.number(app_.rootCount);
  for (const RootDesc &r : roots_) {
    optional(r.list);
    out.text(r.name);
    out.number(r.offset);
    out.number(r.type);
    out.number(r.flags);
    optional(r.renamedFrom);
  }
  out.number(static_cast<uint32_t>(ranges_.size()));
  for (const RetainRange &range : ranges_) {
    out.number(range.offset);
    out.number(range.size);
    out.number(range.task);
  }
  return out.take();
}

/// Reads and distrusts.
class RetainLayout::Decoder {
public:
  Decoder(std::span<const std::byte> bytes, RetainLayout &to) : in_(bytes), to_(to) {}

  void run() {
    for (uint32_t n = in_.count(12); n > 0; --n) {
      const char *name = text();
      to_.enumerators_.push_back({name, in_.number<int64_t>()});
    }
    for (uint32_t n = in_.count(24); n > 0; --n) {
      MemberDesc member{};
      member.name = text();
      member.offset = in_.number<uint64_t>();
      member.type = in_.number<uint32_t>();
      member.flags = in_.number<uint32_t>();
      member.renamedFrom = optional();
      check((member.flags & ~kKept) == 0);
      to_.members_.push_back(member);
    }
    for (uint32_t n = in_.count(60); n > 0; --n)
      type();
    for (uint32_t n = in_.count(28); n > 0; --n) {
      RootDesc root{};
      root.list = optional();
      root.name = text();
      root.offset = in_.number<uint64_t>();
      root.type = in_.number<uint32_t>();
      root.flags = in_.number<uint32_t>();
      root.renamedFrom = optional();
      check(root.type < to_.types_.size() && (root.flags & ~kKept) == 0 &&
            root.offset <= kMostState && to_.types_[root.type].size <= kMostState);
      to_.roots_.push_back(root);
    }
    to_.setTables();
    validate(to_.app_, {});
    for (uint32_t n = in_.count(20); n > 0; --n) {
      RetainRange range{};
      range.offset = in_.number<uint64_t>();
      range.size = in_.number<uint64_t>();
      range.task = in_.number<uint32_t>();
      check(range.offset <= to_.app_.stateSize && range.size <= to_.app_.stateSize - range.offset);
      to_.bytes_ += range.size;
      to_.ranges_.push_back(range);
    }
    check(to_.ranges_.size() <= kMostRanges && in_.left() == 0);
  }

private:
  static void check(bool good) {
    if (!good)
      throw Error("its description is damaged");
  }
  const char *text() {
    const std::string_view own = in_.text();
    check(own.find('\0') == std::string_view::npos);
    return to_.keep(own);
  }
  const char *optional() {
    const char *own = text();
    return *own == 0 ? nullptr : own;
  }

  void type() {
    const auto own = static_cast<uint32_t>(to_.types_.size());
    TypeDesc t{};
    t.kind = static_cast<Kind>(in_.number<uint32_t>());
    t.flags = in_.number<uint32_t>();
    t.name = text();
    t.size = in_.number<uint64_t>();
    t.layoutHash = in_.number<uint64_t>();
    t.align = in_.number<uint32_t>();
    t.firstMember = in_.number<uint32_t>();
    t.memberCount = in_.number<uint32_t>();
    t.element = in_.number<uint32_t>();
    t.lowerBound = in_.number<int64_t>();
    t.elementCount = in_.number<uint64_t>();
    t.stringLength = in_.number<uint32_t>();
    t.renamedFrom = optional();
    check(t.size != 0 && t.size <= kMostState && t.align != 0 && (t.flags & ~kTypeExternal) == 0);
    const uint64_t size = elementarySize(t.kind);
    uint32_t depth = 0;
    if (hasMembers(t.kind)) {
      check(t.firstMember <= to_.members_.size() &&
            t.memberCount <= to_.members_.size() - t.firstMember);
      uint64_t sum = 0;
      for (uint32_t i = 0; i < t.memberCount; ++i) {
        const MemberDesc &member = to_.members_[t.firstMember + i];
        check(member.type < own); // no circles
        depth = std::max(depth, depths_[member.type] + 1);
        sum += (member.flags & kSymBit) != 0 ? 0 : to_.types_[member.type].size;
        check(std::string_view(to_.types_[member.type].name) != kLocated);
      }
      // Only unions overlap, so that there are not more values than bytes.
      check(t.kind == Kind::Union || std::string_view(t.name) == kLocated || sum <= t.size);
    } else if (t.kind == Kind::Array || t.kind == Kind::Enum) {
      check(t.element < own);
      const TypeDesc &element = to_.types_[t.element];
      depth = depths_[t.element] + 1;
      if (t.kind == Kind::Array)
        check(t.elementCount != 0 && t.elementCount <= t.size &&
              t.elementCount * element.size == t.size && t.lowerBound >= -(int64_t{1} << 40) &&
              t.lowerBound <= int64_t{1} << 40);
      else
        check(elementarySize(element.kind) != 0 && element.kind != Kind::REAL &&
              element.kind != Kind::LREAL);
    } else {
      check(isString(t.kind) || (size != 0 && size == t.size));
    }
    check(depth <= kMostDepth);
    depths_.push_back(depth);
    to_.types_.push_back(t);
  }

  ByteReader in_;
  RetainLayout &to_;
  std::vector<uint32_t> depths_; ///< By type: how many lie inside of each other.
};

RetainLayout RetainLayout::decode(std::span<const std::byte> bytes) {
  RetainLayout layout;
  Decoder(bytes, layout).run();
  return layout;
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
