#include "runtime/app/symbols.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/layout_index.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/iec/text.h"

#include <fmt/format.h>

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
    else if (lowered(member.name) == name)
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

std::string rootName(const RootDesc &root) {
  const bool qualified = root.list != nullptr && (root.flags & kSymQualifiedOnly) != 0;
  return qualified ? fmt::format("{}.{}", root.list, root.name) : std::string(root.name);
}

} // namespace

bool isElementary(Kind kind) {
  return (kind >= Kind::BOOL && kind <= Kind::WSTRING) || kind == Kind::Enum;
}

void *Symbol::address(std::byte *state) const {
  std::byte *at = state + offsets_[0];
  for (std::size_t i = 1; i < offsets_.size(); ++i) {
    std::byte *target = nullptr;
    std::memcpy(&target, at, sizeof target);
    if (target == nullptr)
      return nullptr;
    at = target + offsets_[i];
  }
  return at;
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
    const std::size_t start = at_;
    while (at_ < path_.size() && isNameCharacter(path_[at_]))
      ++at_;
    if (at_ == start)
      fail(start == 0 ? "a name is missing"
                      : fmt::format("a name is missing after '{}'", path_.substr(0, start)));
    return std::string(path_.substr(start, at_ - start));
  }

  void enter(uint64_t offset, uint32_t type, uint32_t flags) {
    symbol_.offsets_.back() += offset;
    symbol_.type_ = type;
    symbol_.flags_ = flags | (symbol_.flags_ & kSymConstant);
  }

  void follow() {
    if (type().kind == Kind::Interface || type().element == kNoIndex)
      fail(fmt::format("'{}' points to data of no known type", path_.substr(0, at_)));
    symbol_.offsets_.push_back(0);
    symbol_.type_ = type().element;
    symbol_.flags_ &= ~uint32_t{kSymConstant};
  }

  void root() {
    const std::string first = name();
    // LIST.name before name.member: a list's name is never a variable's.
    if (at_ < path_.size() && path_[at_] == '.') {
      const std::size_t back = at_;
      ++at_;
      const std::string second = name();
      const auto found = table_.roots_.find(lowered(first) + "." + lowered(second));
      if (found != table_.roots_.end())
        return take(found->second.front());
      at_ = back;
    }
    const auto found = table_.roots_.find(lowered(first));
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

  void take(uint32_t index) {
    const RootDesc &root = app().roots[index];
    enter(root.offset, root.type, root.flags);
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
        if (type.kind == Kind::Program && findMember(app(), type, lowered(first)))
          hint = fmt::format("; did you mean '{}.{}'?", root.name, path_);
      }
    }
    if (hint.empty() && !names.empty()) {
      hint = "; there are";
      for (std::size_t i = 0; i < names.size() && i < 8; ++i)
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
    const auto found = findMember(app(), type(), lowered(name));
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
    enter(place * app().types[element].size, element, symbol_.flags_);
  }

  const SymbolTable &table_;
  std::string_view path_;
  std::size_t at_ = 0;
  Symbol symbol_;
};

SymbolTable::SymbolTable(const StrideAppV1 &app) : app_(&app) {
  for (uint32_t i = 0; i < app.rootCount; ++i) {
    const RootDesc &root = app.roots[i];
    if (root.list != nullptr)
      roots_[lowered(root.list) + "." + lowered(root.name)].push_back(i);
    if (root.list == nullptr || (root.flags & kSymQualifiedOnly) == 0)
      roots_[lowered(root.name)].push_back(i);
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
    s.offsets_.back() += offset;
    s.type_ = childType;
    s.flags_ = flags | (symbol.flags_ & kSymConstant);
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
      appendLeaves(child(i * size, type.element, symbol.flags_, fmt::format("{}{}]", stem, number)),
                   true, out);
    }
  }
}

} // namespace stride::app
