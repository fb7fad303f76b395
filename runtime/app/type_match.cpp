#include "runtime/app/type_match.hpp"

#include "runtime/app/layout_index.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>

namespace stride::app {

namespace {

/// Values of an integer type as lowest bit count: signed types hold -2^(bits-1) … 2^(bits-1)-1.
struct IntegerRange {
  bool isInteger;
  bool isSigned;
  unsigned bits;
};

IntegerRange rangeOf(Kind kind) {
  switch (kind) {
  case Kind::SINT:
    return {true, true, 8};
  case Kind::INT:
    return {true, true, 16};
  case Kind::DINT:
    return {true, true, 32};
  case Kind::LINT:
    return {true, true, 64};
  case Kind::USINT:
  case Kind::BYTE:
    return {true, false, 8};
  case Kind::UINT:
  case Kind::WORD:
    return {true, false, 16};
  case Kind::UDINT:
  case Kind::DWORD:
    return {true, false, 32};
  case Kind::ULINT:
  case Kind::LWORD:
    return {true, false, 64};
  default:
    return {false, false, 0};
  }
}

/// Numbers, times, characters: what has a kind of its own.
bool isPlain(Kind kind) { return kind >= Kind::BOOL && kind < Kind::Enum && !isString(kind); }

} // namespace

bool sameName(const char *a, const char *b) {
  if (a == nullptr || b == nullptr)
    return a == b;
  for (; *a != 0 && common::lowerCase(*a) == common::lowerCase(*b); ++a, ++b) {
  }
  return common::lowerCase(*a) == common::lowerCase(*b);
}

bool isInRange(const TypeDesc &range, int64_t value) {
  return value >= range.lowerBound && value <= static_cast<int64_t>(range.elementCount);
}

namespace {

/// The new type is a subrange, and not all of the old one's values are known to lie in it.
bool narrows(const TypeDesc &from, const TypeDesc &to) {
  if ((to.flags & kTypeRange) == 0)
    return false;
  return (from.flags & kTypeRange) == 0 || !isInRange(to, from.lowerBound) ||
         !isInRange(to, static_cast<int64_t>(from.elementCount));
}

} // namespace

bool keepsEveryValue(Kind from, Kind to) {
  if (from == to)
    return true;
  const IntegerRange a = rangeOf(from);
  const IntegerRange b = rangeOf(to);
  if (a.isInteger && b.isInteger)
    return a.isSigned == b.isSigned ? a.bits <= b.bits : !a.isSigned && a.bits < b.bits;
  if (a.isInteger)
    return (to == Kind::REAL && a.bits <= 16) || (to == Kind::LREAL && a.bits <= 32);
  return (from == Kind::REAL && to == Kind::LREAL) || (from == Kind::TIME && to == Kind::LTIME) ||
         (from == Kind::DATE && to == Kind::LDATE) || (from == Kind::TOD && to == Kind::LTOD) ||
         (from == Kind::DT && to == Kind::LDT);
}

TypeMatch::TypeMatch(const StrideAppV1 &oldApp, const StrideAppV1 &newApp, MatchOptions options)
    : old_(&oldApp), new_(&newApp), options_(options) {
  matchRoots();
  if (options.addresses && options.only == 0)
    matchPools();
}

bool TypeMatch::sameTypeName(uint32_t oldType, uint32_t newType) const {
  const TypeDesc &a = old_->types[oldType];
  const TypeDesc &b = new_->types[newType];
  return sameName(a.name, b.name) || (b.renamedFrom != nullptr && sameName(a.name, b.renamedFrom));
}

/// Blocks of other names are other blocks, unless one extends the other.
bool TypeMatch::sameFamily(uint32_t oldType, uint32_t newType) const {
  return sameTypeName(oldType, newType) || extends(*old_, oldType, new_->types[newType].name) ||
         extends(*new_, newType, old_->types[oldType].name);
}

uint32_t TypeMatch::pairOf(uint32_t oldType, uint32_t newType, bool whole) {
  const uint64_t key = (uint64_t{oldType} << 32) | (uint64_t{newType} << 1) | (whole ? 1U : 0U);
  const auto found = indices_.find(key);
  if (found != indices_.end())
    return found->second;
  TypePair pair;
  pair.oldType = oldType;
  pair.newType = newType;
  pair.whole = whole;
  fill(pair); // types contain each other without circles
  const auto index = static_cast<uint32_t>(pairs_.size());
  pairs_.push_back(std::move(pair));
  indices_.emplace(key, index);
  return index;
}

void TypeMatch::fill(TypePair &pair) {
  const TypeDesc &a = old_->types[pair.oldType];
  const TypeDesc &b = new_->types[pair.newType];
  if (isAddressSlot(a.kind) || isAddressSlot(b.kind))
    return fillSlot(pair);
  if (isString(a.kind) || isString(b.kind)) {
    if (a.kind == b.kind)
      pair.carry = a.stringLength == b.stringLength ? Carry::Bytes : Carry::Text;
    pair.bitwise = pair.carry == Carry::Bytes;
    return;
  }
  if (a.kind == Kind::Enum && b.kind == Kind::Enum)
    return fillEnumeration(pair);
  const Kind from = a.kind == Kind::Enum ? old_->types[a.element].kind : a.kind;
  if (isPlain(from) && isPlain(b.kind)) {
    if (a.kind == b.kind)
      pair.carry = Carry::Bytes;
    else if (keepsEveryValue(from, b.kind))
      pair.carry = Carry::Number;
    pair.ranged = pair.carry != Carry::Initial && narrows(a, b);
    pair.bitwise = pair.carry == Carry::Bytes && !pair.ranged;
    return;
  }
  if (a.kind == Kind::Array && b.kind == Kind::Array)
    return fillArray(pair);
  if (a.kind != b.kind || !hasMembers(a.kind))
    return;
  if (a.kind == Kind::Union)
    return fillUnion(pair);
  if (a.kind == Kind::FunctionBlock && !sameFamily(pair.oldType, pair.newType))
    return;
  fillStructure(pair);
}

void TypeMatch::fillSlot(TypePair &pair) const {
  const TypeDesc &a = old_->types[pair.oldType];
  const TypeDesc &b = new_->types[pair.newType];
  const auto typed = [](Kind kind) { return kind == Kind::Pointer || kind == Kind::Reference; };
  if (!options_.addresses || a.size != b.size ||
      !(a.kind == b.kind || (typed(a.kind) && typed(b.kind))))
    return;
  pair.carry = Carry::Slot;
  pair.bitwise = true;
  pair.hasSlots = true;
}

void TypeMatch::fillEnumeration(TypePair &pair) {
  const TypeDesc &a = old_->types[pair.oldType];
  const TypeDesc &b = new_->types[pair.newType];
  const EnumeratorDesc *const oldNames = old_->enumerators + a.firstMember;
  const EnumeratorDesc *const newNames = new_->enumerators + b.firstMember;
  std::unordered_map<std::string, int64_t> byName;
  std::unordered_map<int64_t, const char *> byValue;
  for (uint32_t i = 0; i < b.memberCount; ++i) {
    byName.emplace(common::lowerCase(newNames[i].name), newNames[i].value);
    byValue.emplace(newNames[i].value, newNames[i].name);
  }
  std::unordered_map<std::string, int64_t> before;
  for (uint32_t i = 0; i < a.memberCount; ++i)
    before.emplace(common::lowerCase(oldNames[i].name), oldNames[i].value);
  bool moved = false;
  bool lost = false;
  for (uint32_t i = 0; i < a.memberCount; ++i) {
    const int64_t from = oldNames[i].value;
    EnumeratorMove move{from, from, false};
    const auto own = byName.find(common::lowerCase(oldNames[i].name));
    if (own != byName.end()) {
      move.to = own->second;
    } else {
      // A new name for the same number is a renamed enumerator.
      const auto other = byValue.find(from);
      move.gone = other == byValue.end() || before.contains(common::lowerCase(other->second));
    }
    const auto same = std::find_if(pair.moves.begin(), pair.moves.end(),
                                   [&](const EnumeratorMove &m) { return m.from == from; });
    if (same == pair.moves.end())
      pair.moves.push_back(move);
    else if (same->gone) // two names of one number: any of them will do
      *same = move;
  }
  for (const EnumeratorMove &move : pair.moves) {
    moved = moved || move.gone || move.from != move.to;
    lost = lost || move.gone;
  }
  if (!sameTypeName(pair.oldType, pair.newType) && lost) {
    pair.moves.clear();
    return; // another enumeration
  }
  if (!moved && old_->types[a.element].kind == new_->types[b.element].kind) {
    pair.carry = Carry::Bytes;
    pair.bitwise = true;
    pair.moves.clear();
    return;
  }
  pair.carry = Carry::Names;
  std::sort(pair.moves.begin(), pair.moves.end(),
            [](const EnumeratorMove &x, const EnumeratorMove &y) { return x.from < y.from; });
}

void TypeMatch::fillArray(TypePair &pair) {
  const TypeDesc &a = old_->types[pair.oldType];
  const TypeDesc &b = new_->types[pair.newType];
  const int64_t low = std::max(a.lowerBound, b.lowerBound);
  const int64_t high = std::min(a.lowerBound + static_cast<int64_t>(a.elementCount),
                                b.lowerBound + static_cast<int64_t>(b.elementCount));
  if (high <= low)
    return;
  pair.element = pairOf(a.element, b.element, pair.whole);
  const TypePair &element = pairs_[pair.element];
  if (element.carry != Carry::Initial)
    pair.carry = Carry::Elements;
  pair.oldFirst = static_cast<uint64_t>(low - a.lowerBound);
  pair.newFirst = static_cast<uint64_t>(low - b.lowerBound);
  pair.count = static_cast<uint64_t>(high - low);
  pair.hasSlots = element.hasSlots;
  pair.bitwise = element.bitwise && a.lowerBound == b.lowerBound &&
                 a.elementCount == b.elementCount &&
                 old_->types[a.element].size == new_->types[b.element].size;
}

const RootDesc *poolRoot(const StrideAppV1 &app) {
  for (uint32_t i = 0; i < app.rootCount; ++i) {
    if (app.roots[i].list == nullptr && sameName(app.roots[i].name, "__pool"))
      return &app.roots[i];
  }
  return nullptr;
}

/// The objects of __NEW are known by the hash of their type only.
void TypeMatch::matchPools() {
  if (poolRoot(*old_) == nullptr || poolRoot(*new_) == nullptr)
    return;
  std::unordered_map<uint64_t, uint32_t> byHash;
  for (uint32_t i = 0; i < old_->typeCount; ++i)
    byHash.emplace(old_->types[i].layoutHash, i);
  for (uint32_t i = 0; i < new_->typeCount; ++i) {
    const auto found = byHash.find(new_->types[i].layoutHash);
    if (found == byHash.end())
      continue;
    poolTypes_.push_back({found->first, pairOf(found->second, i, true)});
    byHash.erase(found);
  }
  std::sort(poolTypes_.begin(), poolTypes_.end(),
            [](const PoolType &a, const PoolType &b) { return a.hash < b.hash; });
}

} // namespace stride::app
