// The layout in a file of retained data: written as it is, read with distrust.
#include "runtime/app/byte_stream.hpp"
#include "runtime/app/layout_index.hpp"
#include "runtime/app/retain_layout.hpp"
#include "runtime/app/validate.hpp"

#include <algorithm>

namespace stride::app {

namespace {

/// The largest state that a file may speak of.
constexpr uint64_t kMostState = uint64_t{1} << 30;
/// Types inside of each other.
constexpr uint32_t kMostDepth = 256;
/// More ranges than any program needs.
constexpr size_t kMostRanges = size_t{1} << 24;

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

} // namespace

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
  for (TypeDesc t : types_) {
    // Of a subrange the base type: its values are looked at when they are put back.
    if ((t.flags & kTypeRange) != 0)
      t = types_[t.element];
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
        // Others have no members, whatever they say.
        check((member.flags & kSymBase) == 0 || hasMembers(to_.types_[member.type].kind));
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

} // namespace stride::app
