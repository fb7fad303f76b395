// Fields and roots: which of one build is which of the other, with those of bases.
#include "runtime/app/type_match.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>
#include <numeric>

namespace stride::app {

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

bool TypeMatch::extends(const StrideAppV1 &app, uint32_t type, const char *base) const {
  const std::vector<Base> bases = basesOf(app, type);
  return std::any_of(bases.begin(), bases.end(),
                     [&](const Base &b) { return sameName(app.types[b.type].name, base); });
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

} // namespace stride::app
