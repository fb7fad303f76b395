#include "runtime/app/symbols.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/layout_index.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/common/text.hpp"
#include "runtime/iec/text.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>

namespace stride::app {

namespace {

bool isNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

struct FoundMember {
  uint64_t offset;
  const MemberDesc *member;
};

/// A member by its lower-case name, own members before those of the embedded base.
std::optional<FoundMember> findMember(const StrideAppV1 &app, const TypeDesc &type,
                                      const std::string &name) {
  const MemberDesc *base = nullptr;
  for (uint32_t i = 0; i < type.memberCount; ++i) {
    const MemberDesc &member = app.members[type.firstMember + i];
    if ((member.flags & kSymBase) != 0)
      base = &member;
    else if (common::lowerCase(member.name) == name)
      return FoundMember{member.offset, &member};
  }
  if (base == nullptr)
    return std::nullopt;
  std::optional<FoundMember> found = findMember(app, app.types[base->type], name);
  if (found)
    found->offset += base->offset;
  return found;
}

void memberNames(const StrideAppV1 &app, const TypeDesc &type, std::vector<std::string> &names) {
  for (uint32_t i = 0; i < type.memberCount; ++i) {
    const MemberDesc &member = app.members[type.firstMember + i];
    if ((member.flags & kSymBase) != 0)
      memberNames(app, app.types[member.type], names);
    else if ((member.flags & kSymHidden) == 0)
      names.emplace_back(member.name);
  }
}

/// An element lies where its array does: only the array's offset is counted in another way.
uint32_t elementFlags(uint32_t flags) { return flags & ~uint32_t{kSymLocated | kSymSlot}; }

std::string rootName(const RootDesc &root) {
  const bool qualified = root.list != nullptr && (root.flags & kSymQualifiedOnly) != 0;
  return qualified ? fmt::format("{}.{}", root.list, root.name) : std::string(root.name);
}

} // namespace

bool isElementary(Kind kind) {
  return (kind >= Kind::BOOL && kind <= Kind::WCHAR) || kind == Kind::Enum;
}

std::byte *Symbol::find(std::byte *state, int &bit) const {
  bit = bit_;
  std::byte *at = state + steps_[0].offset;
  for (size_t i = 1; i < steps_.size(); ++i) {
    const Step &step = steps_[i];
    if (step.followsSlot) {
      uint32_t number = 0;
      std::memcpy(&number, at, sizeof number);
      if (step.countsBits) {
        bit = static_cast<int>(number & 7U);
        number >>= 3U;
      }
      at = state + step.area + number + step.offset;
      continue;
    }
    std::byte *target = nullptr;
    std::memcpy(&target, at, sizeof target);
    if (target == nullptr)
      return nullptr;
    at = target + step.offset;
  }
  return at;
}

void *Symbol::address(std::byte *state) const {
  int bit = -1;
  return find(state, bit);
}

const void *Symbol::read(std::byte *state, std::byte &bit) const {
  int number = -1;
  const std::byte *place = find(state, number);
  if (place == nullptr || number < 0)
    return place;
  bit = (*place >> number) & std::byte{1};
  return &bit;
}

std::optional<uint64_t> Symbol::fixedOffset() const {
  if (steps_.size() > 1 || bit_ >= 0)
    return std::nullopt;
  return steps_[0].offset;
}

namespace {

template <class T> bool storeAs(std::byte *place, const void *value) {
  if (std::bit_cast<uintptr_t>(place) % sizeof(T) != 0)
    return false;
  T copy{};
  std::memcpy(&copy, value, sizeof copy);
  __atomic_store_n(reinterpret_cast<T *>(place), copy, __ATOMIC_RELAXED);
  return true;
}

/// What fits a register is seen whole by tasks that are in their cycles.
void storeWhole(std::byte *place, const void *value, size_t size) {
  const bool stored = (size == 8 && storeAs<uint64_t>(place, value)) ||
                      (size == 4 && storeAs<uint32_t>(place, value)) ||
                      (size == 2 && storeAs<uint16_t>(place, value));
  if (!stored)
    std::memcpy(place, value, size);
}

} // namespace

bool Symbol::write(std::byte *state, const void *value, size_t size) const {
  int number = -1;
  std::byte *place = find(state, number);
  if (place == nullptr)
    return false;
  if (number < 0) {
    storeWhole(place, value, size);
    return true;
  }
  // Other bits of the byte may belong to another task that is in its cycle.
  auto *byte = reinterpret_cast<unsigned char *>(place);
  const auto mask = static_cast<unsigned char>(1U << number);
  if (*static_cast<const std::byte *>(value) != std::byte{0})
    __atomic_fetch_or(byte, mask, __ATOMIC_RELAXED);
  else
    __atomic_fetch_and(byte, static_cast<unsigned char>(~mask), __ATOMIC_RELAXED);
  return true;
}

void Symbol::enter(const StrideAppV1 &app, uint64_t offset, uint32_t type, uint32_t flags) {
  bit_ = -1;
  if ((flags & kSymLocated) != 0) {
    steps_.assign(1, Step{.offset = offset});
    if ((flags & kSymBit) != 0)
      bit_ = static_cast<int>(flags >> kSymBitShift & 7U);
  } else if ((flags & kSymSlot) != 0) {
    steps_.back().offset += offset;
    steps_.push_back({.offset = 0,
                      .area = app.image[flags >> kSymAreaShift & 3U].offset,
                      .followsSlot = true,
                      .countsBits = (flags & kSymBit) != 0});
  } else {
    steps_.back().offset += offset;
    if ((flags & kSymBit) != 0) // BIT
      bit_ = static_cast<int>(flags >> kSymBitShift & 7U);
  }
  type_ = type;
  flags_ = flags | (flags_ & kSymConstant);
}

/// One path being read from left to right.
class SymbolTable::Resolver {
public:
  Resolver(const SymbolTable &table, std::string_view path) : table_(table), path_(path) {
    symbol_.path_ = std::string(path);
  }

  Symbol run() {
    root();
    while (at_ < path_.size()) {
      const char c = path_[at_];
      if (c == '.') {
        ++at_;
        member(name());
      } else if (c == '[') {
        ++at_;
        indices();
      } else if (c == '^') {
        ++at_;
        if (type().kind != Kind::Pointer)
          fail(fmt::format("'{}' is not a pointer", path_.substr(0, at_ - 1)));
        follow();
      } else {
        fail(fmt::format("'{}' was not expected there", path_.substr(at_)));
      }
    }
    // A reference or in-out stands for its object.
    while (type().kind == Kind::Reference || type().kind == Kind::InOut)
      follow();
    return std::move(symbol_);
  }

private:
  const StrideAppV1 &app() const { return *table_.app_; }
  const TypeDesc &type() const { return app().types[symbol_.type_]; }

  [[noreturn]] void fail(const std::string &why) const {
    throw Error(fmt::format("symbol '{}': {}", path_, why));
  }

  std::string name() {
    const size_t start = at_;
    while (at_ < path_.size() && isNameCharacter(path_[at_]))
      ++at_;
    if (at_ == start)
      fail(start == 0 ? "a name is missing"
                      : fmt::format("a name is missing after '{}'", path_.substr(0, start)));
    return std::string(path_.substr(start, at_ - start));
  }

  void enter(uint64_t offset, uint32_t type, uint32_t flags) {
    symbol_.enter(app(), offset, type, flags);
  }

  void follow() {
    if (type().kind == Kind::Interface || type().element == kNoIndex)
      fail(fmt::format("'{}' points to data of no known type", path_.substr(0, at_)));
    symbol_.steps_.emplace_back();
    symbol_.type_ = type().element;
    symbol_.flags_ &= ~uint32_t{kSymConstant};
  }

  void root() {
    if (path_.starts_with('%')) {
      directAddress();
      return;
    }
    const std::string first = name();
    // LIST.name before name.member: a list's name is never a variable's.
    if (at_ < path_.size() && path_[at_] == '.') {
      const size_t back = at_;
      if (const std::optional<uint32_t> found = inList(first))
        return take(*found);
      at_ = back;
    }
    const auto found = table_.roots_.find(common::lowerCase(first));
    if (found == table_.roots_.end())
      unknownRoot(first);
    if (found->second.size() > 1) {
      const RootDesc &a = app().roots[found->second[0]];
      const RootDesc &b = app().roots[found->second[1]];
      fail(fmt::format("'{}' is ambiguous; write '{}.{}' or '{}.{}'", first,
                       a.list != nullptr ? a.list : "", a.name, b.list != nullptr ? b.list : "",
                       b.name));
    }
    take(found->second.front());
  }

  /// After the first name: the variable of a list, `LIST.name` or, of a library,
  /// `Library.LIST.name`.
  std::optional<uint32_t> inList(const std::string &first) {
    std::string path = common::lowerCase(first);
    for (int names = 2; names <= 3 && at_ + 1 < path_.size() && path_[at_] == '.' &&
                        isNameCharacter(path_[at_ + 1]);
         ++names) {
      ++at_;
      path += "." + common::lowerCase(name());
      if (const auto found = table_.roots_.find(path); found != table_.roots_.end())
        return found->second.front();
    }
    return std::nullopt;
  }

  void take(uint32_t index) {
    const RootDesc &root = app().roots[index];
    symbol_.task_ = root.task;
    enter(root.offset, root.type, root.flags);
  }

  uint32_t number() {
    const text::Scanned digits =
        text::scanInteger(path_.data() + at_, static_cast<uint32_t>(path_.size() - at_));
    if (digits.used == 0 || digits.negative || digits.overflow || digits.magnitude > UINT32_MAX)
      fail("an address is written %IX0.0, %QW2 or %MD4");
    at_ += digits.used;
    return static_cast<uint32_t>(digits.magnitude);
  }

  /// `%MW3`, `%IX0.0`, `%MW3.2`
  void directAddress() {
    static constexpr std::string_view kAreas = "iqm";
    static constexpr std::string_view kSizes = "xbwdl";
    ++at_;
    const std::string start = common::lowerCase(std::string(path_.substr(at_, 2)));
    const size_t area = start.empty() ? std::string_view::npos : kAreas.find(start[0]);
    if (area == std::string_view::npos)
      fail("an address begins with %I, %Q or %M");
    size_t size = start.size() < 2 ? std::string_view::npos : kSizes.find(start[1]);
    at_ += size == std::string_view::npos ? 1 : 2;
    size = size == std::string_view::npos ? 0 : size;
    const ImageAddressing addressing = app().imageAddressing;
    const uint64_t unit = size == 0 ? 1 : uint64_t{1} << (size - 1);
    const bool words = addressing == ImageAddressing::Words && size == 0;
    uint64_t byte = number();
    int bit = -1;
    uint64_t width = words ? 16 : unit * 8;
    if (at_ < path_.size() && path_[at_] == '.') {
      ++at_;
      const uint32_t n = number();
      if (n >= width)
        fail(fmt::format("there is no bit {}", n));
      byte = byte * (words ? 2 : addressing == ImageAddressing::Bytes ? 1 : unit) + n / 8;
      bit = static_cast<int>(n % 8);
    } else if (size == 0) {
      bit = static_cast<int>(byte % 8);
      byte /= 8;
    } else {
      byte *= addressing == ImageAddressing::Bytes ? 1 : unit;
    }
    const ImageAreaDesc &image = app().image[area];
    if (byte + (bit >= 0 ? 1 : unit) > image.size)
      fail(image.size == 0 ? std::string("the application uses no address of this area")
                           : fmt::format("the area ends with byte {}", image.size - 1));
    static constexpr Kind kKinds[] = {Kind::BOOL, Kind::BYTE, Kind::WORD, Kind::DWORD, Kind::LWORD};
    const Kind kind = kKinds[bit >= 0 ? 0 : size];
    uint32_t index = 0;
    while (index < app().typeCount && app().types[index].kind != kind)
      ++index;
    if (index == app().typeCount)
      fail("the application does not describe direct addresses");
    const uint32_t bitFlags =
        bit < 0 ? 0U : uint32_t{kSymBit} | static_cast<uint32_t>(bit) << kSymBitShift;
    enter(image.offset + byte, index, kSymLocated | bitFlags);
  }

  [[noreturn]] void unknownRoot(const std::string &first) const {
    std::vector<std::string> names;
    for (uint32_t i = 0; i < app().rootCount; ++i) {
      const RootDesc &root = app().roots[i];
      if ((root.flags & kSymHidden) == 0)
        names.push_back(rootName(root));
    }
    std::string hint = didYouMean(first, names);
    if (hint.empty()) {
      // A variable of a program, written without the program's name?
      for (uint32_t i = 0; i < app().rootCount && hint.empty(); ++i) {
        const RootDesc &root = app().roots[i];
        const TypeDesc &type = app().types[root.type];
        if (type.kind == Kind::Program && findMember(app(), type, common::lowerCase(first)))
          hint = fmt::format("; did you mean '{}.{}'?", root.name, path_);
      }
    }
    if (hint.empty() && !names.empty()) {
      hint = "; there are";
      for (size_t i = 0; i < names.size() && i < 8; ++i)
        hint += (i == 0 ? " '" : ", '") + names[i] + "'";
      if (names.size() > 8)
        hint += " and others";
    }
    fail(fmt::format("there is no program or global variable '{}'{}", first, hint));
  }

  void member(const std::string &name) {
    while (isAddressSlot(type().kind))
      follow();
    if (!hasMembers(type().kind))
      fail(fmt::format("'{}' is of type {} and has no members",
                       path_.substr(0, at_ - name.size() - 1), type().name));
    const auto found = findMember(app(), type(), common::lowerCase(name));
    if (!found) {
      std::vector<std::string> names;
      memberNames(app(), type(), names);
      fail(fmt::format("{} has no member '{}'{}", type().name, name, didYouMean(name, names)));
    }
    enter(found->offset, found->member->type, found->member->flags);
  }

  void indices() {
    for (;;) {
      while (isAddressSlot(type().kind))
        follow();
      if (type().kind != Kind::Array)
        fail(fmt::format("too many indices: {} is not an array", type().name));
      index();
      if (at_ < path_.size() && path_[at_] == ',') {
        ++at_;
        continue;
      }
      if (at_ < path_.size() && path_[at_] == ']') {
        ++at_;
        return;
      }
      fail("']' is missing");
    }
  }

  void index() {
    while (at_ < path_.size() && path_[at_] == ' ')
      ++at_;
    const text::Scanned number =
        text::scanInteger(path_.data() + at_, static_cast<uint32_t>(path_.size() - at_));
    if (number.used == 0 || number.overflow)
      fail("an index must be a number");
    at_ += number.used;
    while (at_ < path_.size() && path_[at_] == ' ')
      ++at_;
    const int64_t i =
        static_cast<int64_t>(number.negative ? uint64_t{0} - number.magnitude : number.magnitude);
    const int64_t lo = type().lowerBound;
    const uint64_t place = static_cast<uint64_t>(i) - static_cast<uint64_t>(lo);
    if (place >= type().elementCount)
      fail(fmt::format("index {} is outside {}..{}", i, lo,
                       lo + static_cast<int64_t>(type().elementCount) - 1));
    const uint32_t element = type().element;
    enter(place * app().types[element].size, element, elementFlags(symbol_.flags_));
  }

  const SymbolTable &table_;
  std::string_view path_;
  size_t at_ = 0;
  Symbol symbol_;
};

SymbolTable::SymbolTable(const StrideAppV1 &app) : app_(&app) {
  for (uint32_t i = 0; i < app.rootCount; ++i) {
    const RootDesc &root = app.roots[i];
    if (root.list != nullptr)
      roots_[common::lowerCase(root.list) + "." + common::lowerCase(root.name)].push_back(i);
    if (root.list == nullptr || (root.flags & kSymQualifiedOnly) == 0)
      roots_[common::lowerCase(root.name)].push_back(i);
  }
}

Symbol SymbolTable::resolve(std::string_view path) const { return Resolver(*this, path).run(); }

std::vector<Symbol> SymbolTable::leaves(const Symbol &symbol) const {
  std::vector<Symbol> out;
  appendLeaves(symbol, false, out);
  return out;
}

/// `indexOpen`: the path ends with an index that a further dimension continues: a[1 -> a[1,2].
void SymbolTable::appendLeaves(const Symbol &symbol, bool indexOpen,
                               std::vector<Symbol> &out) const {
  const TypeDesc &type = app_->types[symbol.type_];
  if (isElementary(type.kind)) {
    out.push_back(symbol);
    return;
  }
  const auto child = [&](uint64_t offset, uint32_t childType, uint32_t flags, std::string path) {
    Symbol s = symbol;
    s.enter(*app_, offset, childType, flags);
    s.path_ = std::move(path);
    return s;
  };
  if (hasMembers(type.kind)) {
    for (uint32_t i = 0; i < type.memberCount; ++i) {
      const MemberDesc &member = app_->members[type.firstMember + i];
      if ((member.flags & kSymHidden) != 0)
        continue;
      const bool base = (member.flags & kSymBase) != 0;
      appendLeaves(child(member.offset, member.type, member.flags,
                         base ? symbol.path_ : symbol.path_ + "." + member.name),
                   false, out);
    }
  } else if (type.kind == Kind::Array) {
    const uint64_t size = app_->types[type.element].size;
    std::string stem = symbol.path_ + "[";
    if (indexOpen)
      stem = symbol.path_.substr(0, symbol.path_.size() - 1) + ",";
    for (uint64_t i = 0; i < type.elementCount; ++i) {
      const int64_t number = type.lowerBound + static_cast<int64_t>(i);
      appendLeaves(child(i * size, type.element, elementFlags(symbol.flags_),
                         fmt::format("{}{}]", stem, number)),
                   true, out);
    }
  }
}

} // namespace stride::app
