#include "runtime/app/address_map.hpp"

#include <algorithm>
#include <numeric>

namespace stride::app {

namespace {

uint32_t typeIdOf(const StrideAppV1 &app) {
  for (uint32_t i = 0; i < app.memberCount; ++i) {
    if ((app.members[i].flags & kSymTypeId) != 0)
      return app.members[i].type;
  }
  return kNoIndex;
}

} // namespace

AddressMap::AddressMap(const TypeMatch &match, const LayoutIndex &oldIndex,
                       const LayoutIndex &newIndex)
    : match_(&match), oldIndex_(&oldIndex), newIndex_(&newIndex),
      oldTypeId_(typeIdOf(match.oldApp())), newTypeId_(typeIdOf(match.newApp())) {
  const std::vector<FieldPair> &roots = match.roots();
  roots_.resize(roots.size());
  std::iota(roots_.begin(), roots_.end(), 0U);
  std::stable_sort(roots_.begin(), roots_.end(),
                   [&](uint32_t a, uint32_t b) { return roots[a].oldOffset < roots[b].oldOffset; });
  uint64_t reach = 0;
  for (const uint32_t r : roots_) {
    const TypeDesc &type = match.oldApp().types[match.pair(roots[r].pair).oldType];
    reach = std::max(reach, roots[r].oldOffset + type.size);
    rootReach_.push_back(reach);
  }
}

AddressMap::Slot AddressMap::slot(uint32_t oldType, uint32_t newType) const {
  const TypeDesc &from = match_->oldApp().types[oldType];
  const TypeDesc &to = match_->newApp().types[newType];
  const uint32_t a =
      from.kind == Kind::Interface ? oldTypeId_ : baseType(match_->oldApp(), from.element);
  const uint32_t b =
      to.kind == Kind::Interface ? newTypeId_ : baseType(match_->newApp(), to.element);
  if (a == kNoIndex || b == kNoIndex)
    return {a, b, false};
  return {a, b, match_->sameTypeName(a, b)};
}

/// The only root around a place, or null when there is none or several.
const FieldPair *AddressMap::rootAt(uint64_t oldOffset) const noexcept {
  const std::vector<FieldPair> &roots = match_->roots();
  const auto after =
      std::upper_bound(roots_.begin(), roots_.end(), oldOffset,
                       [&](uint64_t place, uint32_t r) { return place < roots[r].oldOffset; });
  if (after == roots_.begin())
    return nullptr;
  const auto i = static_cast<size_t>(after - roots_.begin()) - 1;
  if (i > 0 && rootReach_[i - 1] > oldOffset)
    return nullptr;
  return &roots[roots_[i]];
}

bool AddressMap::findField(const FieldPair &field, uint64_t rel, uint64_t newStart,
                           uint32_t oldType, Found &found) const noexcept {
  const TypeDesc &type = match_->oldApp().types[match_->pair(field.pair).oldType];
  return field.oldOffset <= rel && rel - field.oldOffset < type.size &&
         find(field.pair, rel - field.oldOffset, newStart + field.newOffset, oldType, found);
}

/// The counterpart of the object of `oldType` that starts at `rel` within a pair's old object.
bool AddressMap::find(uint32_t index, uint64_t rel, uint64_t newStart, uint32_t oldType,
                      Found &found) const noexcept {
  const TypePair &pair = match_->pair(index);
  if (rel == 0 && pair.oldType == oldType) {
    found = {newStart, &pair};
    return true;
  }
  if (pair.element != kNoIndex) {
    const uint64_t oldSize = match_->oldApp().types[match_->pair(pair.element).oldType].size;
    const uint64_t newSize = match_->newApp().types[match_->pair(pair.element).newType].size;
    const uint64_t number = oldSize == 0 ? 0 : rel / oldSize;
    if (number < pair.oldFirst || number - pair.oldFirst >= pair.count)
      return false;
    return find(pair.element, rel - number * oldSize,
                newStart + (number - pair.oldFirst + pair.newFirst) * newSize, oldType, found);
  }
  for (const FieldPair &base : pair.bases) {
    if (findField(base, rel, newStart, oldType, found))
      return true;
  }
  if (pair.carry == Carry::Fields) {
    const auto after = std::upper_bound(
        pair.byOldOffset.begin(), pair.byOldOffset.end(), rel,
        [&](uint64_t offset, uint32_t f) { return offset < pair.fields[f].oldOffset; });
    return after != pair.byOldOffset.begin() &&
           findField(pair.fields[*(after - 1)], rel, newStart, oldType, found);
  }
  return std::any_of(pair.fields.begin(), pair.fields.end(), [&](const FieldPair &field) {
    return findField(field, rel, newStart, oldType, found);
  });
}

bool AddressMap::translate(const Target &target, Found &found) const noexcept {
  const std::vector<FieldPair> &roots = match_->roots();
  const auto after =
      std::upper_bound(roots_.begin(), roots_.end(), target.start,
                       [&](uint64_t place, uint32_t r) { return place < roots[r].oldOffset; });
  for (auto i = static_cast<size_t>(after - roots_.begin());
       i > 0 && rootReach_[i - 1] > target.start; --i) {
    if (findField(roots[roots_[i - 1]], target.start, 0, target.type, found))
      return true;
  }
  return false;
}

bool AddressMap::mayPointTo(uint64_t newStart, uint32_t newType,
                            uint32_t newPointee) const noexcept {
  const StrideAppV1 &app = match_->newApp();
  const TypeDesc &is = app.types[newType];
  if (baseType(app, newType) == newPointee)
    return true;
  if (newPointee == kNoIndex)
    return false;
  const TypeDesc &wanted = app.types[newPointee];
  if (is.kind == wanted.kind && (is.kind == Kind::STRING || is.kind == Kind::WSTRING))
    return is.stringLength >= wanted.stringLength;
  if (is.kind == Kind::Array && wanted.kind == Kind::Array &&
      baseType(app, is.element) == baseType(app, wanted.element))
    return is.elementCount >= wanted.elementCount;
  return newIndex_->startsAt(newStart, newPointee);
}

AddressMap::Status AddressMap::map(uint64_t oldOffset, const Slot &slot,
                                   uint64_t &newOffset) const noexcept {
  // Inside of something that did not change nothing needs to be looked up.
  if (const FieldPair *root = rootAt(oldOffset); root != nullptr && slot.sameName) {
    const TypePair &pair = match_->pair(root->pair);
    const uint64_t rel = oldOffset - root->oldOffset;
    if (pair.bitwise && rel > 0 && rel < match_->oldApp().types[pair.oldType].size) {
      newOffset = root->newOffset + rel;
      return Status::Kept;
    }
  }
  const Target target = oldIndex_->target(oldOffset, slot.oldPointee);
  if (target.relation == Target::Relation::None)
    return Status::Unknown;
  Found found{};
  if (!translate(target, found))
    return Status::Gone;
  const TypePair &pair = *found.pair;
  const TypeDesc &is = match_->newApp().types[pair.newType];
  const bool exact = baseType(match_->oldApp(), target.type) == slot.oldPointee;
  const bool sameMemory = slot.sameName && pair.carry != Carry::Initial &&
                          pair.carry != Carry::Number && pair.carry != Carry::Names;
  if (target.relation == Target::Relation::Inside) {
    const bool reaches = pair.carry == Carry::Text && target.delta < is.size;
    if (!slot.sameName || (pair.carry != Carry::Bytes && pair.carry != Carry::Slot && !reaches))
      return Status::OtherType;
    newOffset = found.newStart + target.delta;
    return Status::Kept;
  }
  bool allowed = sameMemory;
  if (exact)
    allowed = target.relation == Target::Relation::End
                  ? baseType(match_->newApp(), pair.newType) == slot.newPointee
                  : mayPointTo(found.newStart, pair.newType, slot.newPointee);
  else if (!allowed && target.relation == Target::Relation::Start && slot.newPointee != kNoIndex)
    allowed = newIndex_->startsAt(found.newStart, slot.newPointee);
  if (!allowed)
    return Status::OtherType;
  newOffset = found.newStart + (target.relation == Target::Relation::End ? is.size : 0);
  return Status::Kept;
}

} // namespace stride::app
