#include "runtime/app/type_match.hpp"

#include "runtime/app/layout_index.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <numeric>

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

/// The fields, without gaps other than those that alignment makes (without `padding`: without
/// any), fill both types alike.
bool fillsAlike(const StrideAppV1 &app, const TypeDesc &type,
                const std::vector<FieldPair> &fieldsByNewOffset, const std::vector<TypePair> &pairs,
                bool padding) {
  const auto most = [&](uint32_t align) { return padding ? std::max<uint64_t>(align, 1) : 1; };
  uint64_t end = 0;
  for (const FieldPair &field : fieldsByNewOffset) {
    const TypeDesc &own = app.types[pairs[field.pair].newType];
    if (field.oldOffset != field.newOffset || field.newOffset < end ||
        field.newOffset - end >= most(own.align) ||
        (app.members[field.newMember].flags & kSymBit) != 0)
      return false;
    end = field.newOffset + own.size;
  }
  return end <= type.size && type.size - end < most(type.align);
}

} // namespace

bool sameName(const char *a, const char *b) {
  if (a == nullptr || b == nullptr)
    return a == b;
  for (; *a != 0 && common::lowerCase(*a) == common::lowerCase(*b); ++a, ++b) {
  }
  return common::lowerCase(*a) == common::lowerCase(*b);
}

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

/// A field or root of one build on its way to its counterpart.
struct TypeMatch::Field {
  std::string key;
  std::string renamedKey; ///< Empty without one.
  uint64_t offset;
  uint32_t type;
  uint32_t flags;
  uint32_t member;
};

namespace {

/// The fields of a type with those of its embedded bases.
template <class Field>
void flatten(const StrideAppV1 &app, uint32_t type, uint64_t offset, std::vector<Field> &out) {
  const TypeDesc &desc = app.types[type];
  for (uint32_t i = 0; i < desc.memberCount; ++i) {
    const uint32_t m = desc.firstMember + i;
    const MemberDesc &member = app.members[m];
    if ((member.flags & kSymLocated) != 0)
      continue; // its bytes are those of the process image
    if ((member.flags & kSymBase) != 0) {
      flatten(app, member.type, offset + member.offset, out);
      continue;
    }
    std::string key = common::lowerCase(member.name);
    std::string renamed =
        member.renamedFrom != nullptr ? common::lowerCase(member.renamedFrom) : "";
    // VAR_INST of a method: METHOD__NAME
    if (const size_t end = key.rfind("__"); end != std::string::npos && !renamed.empty())
      renamed.insert(0, key, 0, end + 2);
    out.push_back(
        {std::move(key), std::move(renamed), offset + member.offset, member.type, member.flags, m});
  }
}

struct Base {
  uint64_t offset;
  uint32_t type;
  uint32_t member;
};

std::vector<Base> basesOf(const StrideAppV1 &app, uint32_t type) {
  std::vector<Base> out;
  uint64_t offset = 0;
  for (bool more = true; more;) {
    more = false;
    const TypeDesc &desc = app.types[type];
    for (uint32_t i = 0; i < desc.memberCount && !more; ++i) {
      const MemberDesc &member = app.members[desc.firstMember + i];
      if ((member.flags & kSymBase) == 0)
        continue;
      offset += member.offset;
      type = member.type;
      out.push_back({offset, type, desc.firstMember + i});
      more = true;
    }
  }
  return out;
}

} // namespace

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

bool TypeMatch::extends(const StrideAppV1 &app, uint32_t type, const char *base) const {
  const std::vector<Base> bases = basesOf(app, type);
  return std::any_of(bases.begin(), bases.end(),
                     [&](const Base &b) { return sameName(app.types[b.type].name, base); });
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
    pair.bitwise = pair.carry == Carry::Bytes;
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

Hold TypeMatch::holdOf(uint32_t flags, bool whole, uint32_t pair) const {
  if ((flags & (kSymTypeId | kSymSlot)) != 0)
    return Hold::TypeId;
  if ((flags & kSymConstant) != 0)
    return Hold::Constant;
  if ((flags & kSymInitOnChange) != 0)
    return Hold::Asked;
  return whole || anything(pair) ? Hold::No : Hold::Filtered;
}

bool TypeMatch::anything(uint32_t pair) const {
  const TypePair &p = pairs_[pair];
  if (p.whole)
    return true;
  if (p.carry == Carry::Elements)
    return anything(p.element);
  return p.carry == Carry::Fields &&
         std::any_of(p.fields.begin(), p.fields.end(),
                     [](const FieldPair &f) { return f.hold == Hold::No; });
}

void TypeMatch::matchFields(const std::vector<Field> &oldFields,
                            const std::vector<Field> &newFields, bool whole,
                            std::vector<FieldPair> &fields, std::vector<LoneField> &added,
                            std::vector<LoneField> &dropped) {
  constexpr size_t kNone = ~size_t{0};
  std::unordered_map<std::string_view, size_t> byKey;
  for (size_t i = 0; i < oldFields.size(); ++i)
    byKey.emplace(oldFields[i].key, i);
  const auto find = [&](const std::string &key) {
    const auto found = byKey.find(key);
    return found == byKey.end() ? kNone : found->second;
  };
  std::vector<size_t> source(newFields.size(), kNone);
  std::vector<bool> renamed(newFields.size());
  std::vector<bool> taken(oldFields.size());
  const auto take = [&](size_t to, size_t from) {
    source[to] = from;
    taken[from] = true;
  };
  for (size_t i = 0; i < newFields.size(); ++i) {
    const Field &field = newFields[i];
    if (field.renamedKey.empty() || field.renamedKey == field.key)
      continue;
    const size_t from = find(field.renamedKey);
    const size_t own = find(field.key);
    // The attribute stays in the source; it counts when the old build did not have it yet.
    const bool done = own != kNone && oldFields[own].renamedKey == field.renamedKey;
    if (from != kNone && !taken[from] && !done) {
      take(i, from);
      renamed[i] = true;
    }
  }
  for (size_t i = 0; i < newFields.size(); ++i) {
    const size_t own = find(newFields[i].key);
    if (source[i] == kNone && own != kNone && !taken[own])
      take(i, own);
  }
  for (size_t i = 0; i < newFields.size(); ++i) {
    const Field &to = newFields[i];
    if (source[i] == kNone) {
      added.push_back({to.offset, to.member});
      continue;
    }
    const Field &from = oldFields[source[i]];
    const bool all = whole || (to.flags & options_.only) != 0;
    const uint32_t pair = pairOf(from.type, to.type, all);
    fields.push_back({from.offset, to.offset, pair, from.member, to.member,
                      holdOf(from.flags | to.flags, all, pair), renamed[i]});
  }
  for (size_t i = 0; i < oldFields.size(); ++i) {
    if (!taken[i])
      dropped.push_back({oldFields[i].offset, oldFields[i].member});
  }
  std::stable_sort(fields.begin(), fields.end(), [](const FieldPair &x, const FieldPair &y) {
    return x.newOffset < y.newOffset;
  });
}

void TypeMatch::fillStructure(TypePair &pair) {
  std::vector<Field> oldFields;
  std::vector<Field> newFields;
  flatten(*old_, pair.oldType, 0, oldFields);
  flatten(*new_, pair.newType, 0, newFields);
  pair.carry = Carry::Fields;
  matchFields(oldFields, newFields, pair.whole, pair.fields, pair.added, pair.dropped);
  pair.byOldOffset.resize(pair.fields.size());
  std::iota(pair.byOldOffset.begin(), pair.byOldOffset.end(), 0U);
  std::stable_sort(pair.byOldOffset.begin(), pair.byOldOffset.end(), [&](uint32_t x, uint32_t y) {
    return pair.fields[x].oldOffset < pair.fields[y].oldOffset;
  });
  const std::vector<Base> oldBases = basesOf(*old_, pair.oldType);
  const std::vector<Base> newBases = basesOf(*new_, pair.newType);
  size_t inPlace = 0;
  for (const Base &from : oldBases) {
    for (const Base &to : newBases) {
      if (!sameTypeName(from.type, to.type))
        continue;
      const uint32_t base = pairOf(from.type, to.type, pair.whole);
      pair.bases.push_back({from.offset, to.offset, base, from.member, to.member, Hold::No, false});
      if (from.offset == to.offset && old_->types[from.type].size == new_->types[to.type].size)
        ++inPlace;
    }
  }
  const TypeDesc &a = old_->types[pair.oldType];
  const TypeDesc &b = new_->types[pair.newType];
  // An instance of a block and of one that extends it: the common part is kept.
  pair.changedName = a.kind != Kind::Program && !sameTypeName(pair.oldType, pair.newType);
  bool alike = pair.whole && a.size == b.size && pair.added.empty() && pair.dropped.empty() &&
               !pair.changedName && inPlace == oldBases.size() && inPlace == newBases.size();
  for (const FieldPair &field : pair.fields) {
    if (field.hold == Hold::No && pairs_[field.pair].hasSlots)
      pair.hasSlots = true;
    alike = alike && field.hold == Hold::No && pairs_[field.pair].bitwise;
  }
  pair.bitwise = alike && (fillsAlike(*new_, b, pair.fields, pairs_, options_.padding) ||
                           (pair.fields.empty() && b.size == 1)); // C++'s empty structure
}

void TypeMatch::fillUnion(TypePair &pair) {
  const TypeDesc &a = old_->types[pair.oldType];
  const TypeDesc &b = new_->types[pair.newType];
  std::vector<Field> oldFields;
  std::vector<Field> newFields;
  flatten(*old_, pair.oldType, 0, oldFields);
  flatten(*new_, pair.newType, 0, newFields);
  // What is in it is known as bytes only: all of it is wanted, or none.
  matchFields(oldFields, newFields, pair.whole, pair.fields, pair.added, pair.dropped);
  pair.changedName = !sameTypeName(pair.oldType, pair.newType);
  bool alike = pair.whole && a.size == b.size && pair.added.empty() && pair.dropped.empty() &&
               !pair.changedName;
  for (const FieldPair &field : pair.fields) {
    const TypePair &own = pairs_[field.pair];
    const bool same = field.hold == Hold::No && own.bitwise && field.oldOffset == field.newOffset;
    alike = alike && same;
    if (!same)
      continue;
    pair.bytes = std::max(pair.bytes, field.newOffset + new_->types[own.newType].size);
    pair.hasSlots = pair.hasSlots || own.hasSlots;
  }
  pair.bitwise = alike;
  if (pair.bytes != 0 && pair.whole)
    pair.carry = Carry::Union;
}

void TypeMatch::matchRoots() {
  const auto fieldsOf = [](const StrideAppV1 &app) {
    std::vector<Field> out;
    out.reserve(app.rootCount);
    for (uint32_t i = 0; i < app.rootCount; ++i) {
      const RootDesc &root = app.roots[i];
      if ((root.flags & kSymLocated) != 0)
        continue; // another name for what lies in the process image or in another root
      const std::string list =
          root.list == nullptr ? std::string() : common::lowerCase(root.list) + ".";
      std::string renamed =
          root.renamedFrom == nullptr ? std::string() : common::lowerCase(root.renamedFrom);
      if (!renamed.empty() && renamed.find('.') == std::string::npos)
        renamed.insert(0, list);
      out.push_back({list + common::lowerCase(root.name), std::move(renamed), root.offset,
                     root.type, root.flags, i});
    }
    return out;
  };
  matchFields(fieldsOf(*old_), fieldsOf(*new_), options_.only == 0, roots_, addedRoots_,
              droppedRoots_);
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
