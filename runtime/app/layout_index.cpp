#include "runtime/app/layout_index.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stride::app {

bool isAddressSlot(Kind kind) {
  return kind == Kind::Pointer || kind == Kind::Reference || kind == Kind::InOut ||
         kind == Kind::Interface;
}

bool isString(Kind kind) { return kind == Kind::STRING || kind == Kind::WSTRING; }

bool hasMembers(Kind kind) {
  return kind == Kind::Struct || kind == Kind::Union || kind == Kind::FunctionBlock ||
         kind == Kind::Program;
}

namespace {

/// It has no bytes of its type there: they lie in the process image.
bool isElsewhere(uint32_t flags) { return (flags & (kSymLocated | kSymSlot)) != 0; }

} // namespace

LayoutIndex::LayoutIndex(const StrideAppV1 &app) : app_(&app) {
  first_.resize(app.typeCount + size_t{1});
  overlapping_.resize(app.typeCount);
  for (uint32_t t = 0; t < app.typeCount; ++t) {
    const TypeDesc &type = app.types[t];
    first_[t] = static_cast<uint32_t>(order_.size());
    if (!hasMembers(type.kind))
      continue;
    for (uint32_t i = 0; i < type.memberCount; ++i) {
      if (!isElsewhere(app.members[type.firstMember + i].flags))
        order_.push_back(type.firstMember + i);
    }
    const auto begin = order_.begin() + first_[t];
    std::stable_sort(begin, order_.end(), [&](uint32_t a, uint32_t b) {
      return app.members[a].offset < app.members[b].offset;
    });
    uint64_t end = 0;
    for (auto it = begin; it != order_.end(); ++it) {
      const MemberDesc &member = app.members[*it];
      if (member.offset < end)
        overlapping_[t] = 1;
      end = std::max(end, member.offset + app.types[member.type].size);
    }
  }
  first_[app.typeCount] = static_cast<uint32_t>(order_.size());
  for (uint32_t i = 0; i < app.rootCount; ++i) {
    if (!isElsewhere(app.roots[i].flags))
      roots_.push_back(i);
  }
  std::stable_sort(roots_.begin(), roots_.end(), [&](uint32_t a, uint32_t b) {
    const RootDesc &x = app.roots[a];
    const RootDesc &y = app.roots[b];
    return x.offset != y.offset ? x.offset < y.offset
                                : app.types[x.type].size > app.types[y.type].size;
  });
  uint64_t reach = 0;
  for (const uint32_t r : roots_) {
    reach = std::max(reach, app.roots[r].offset + app.types[app.roots[r].type].size);
    rootReach_.push_back(reach);
  }
}

/// Visits the objects around a place from the largest to the smallest: visit(type, rel) with the
/// place's offset within each. With `end` those that contain the byte before the place. Ends when
/// visit returns true.
template <class Visit>
bool LayoutIndex::descend(uint32_t type, uint64_t rel, bool end, Visit visit) const {
  const uint64_t probe = end ? 1 : 0;
  for (;;) {
    if (visit(type, rel))
      return true;
    const TypeDesc &desc = app_->types[type];
    if (desc.kind == Kind::Array) {
      const uint64_t size = app_->types[desc.element].size;
      if (size == 0)
        return false;
      rel -= (rel - probe) / size * size;
      type = desc.element;
      continue;
    }
    if (!hasMembers(desc.kind))
      return false;
    const uint32_t *const begin = membersBegin(type);
    const uint32_t *const stop = begin + memberCount(type);
    const auto contains = [&](const MemberDesc &member) {
      return member.offset + probe <= rel &&
             rel - probe - member.offset < app_->types[member.type].size;
    };
    if (overlapping_[type] != 0) {
      for (const uint32_t *m = begin; m != stop; ++m) {
        const MemberDesc &member = app_->members[*m];
        if (contains(member) && descend(member.type, rel - member.offset, end, visit))
          return true;
      }
      return false;
    }
    const uint32_t *found =
        std::upper_bound(begin, stop, rel - probe, [&](uint64_t offset, uint32_t m) {
          return offset < app_->members[m].offset;
        });
    if (found == begin)
      return false;
    const MemberDesc &member = app_->members[*(found - 1)];
    if (!contains(member))
      return false;
    rel -= member.offset;
    type = member.type;
  }
}

template <class Visit>
bool LayoutIndex::descendRoots(uint64_t offset, bool end, Visit visit) const {
  const uint64_t probe = end ? 1 : 0;
  if (offset < probe)
    return false;
  const auto after =
      std::upper_bound(roots_.begin(), roots_.end(), offset - probe,
                       [&](uint64_t place, uint32_t r) { return place < app_->roots[r].offset; });
  for (auto i = static_cast<size_t>(after - roots_.begin());
       i > 0 && rootReach_[i - 1] > offset - probe; --i) {
    const RootDesc &root = app_->roots[roots_[i - 1]];
    if (root.offset + app_->types[root.type].size > offset - probe &&
        descend(root.type, offset - root.offset, end, visit))
      return true;
  }
  return false;
}

bool LayoutIndex::startsAt(uint64_t offset, uint32_t wanted) const {
  // An instance begins with its type__, which is nobody's UDINT.
  bool instance = false;
  return descendRoots(offset, false, [&](uint32_t type, uint64_t rel) {
    const Kind kind = app_->types[type].kind;
    instance = instance || (rel == 0 && kind == Kind::FunctionBlock);
    return rel == 0 && baseType(*app_, type) == wanted && (hasMembers(kind) || !instance);
  });
}

Target LayoutIndex::target(uint64_t offset, uint32_t pointee) const {
  using Relation = Target::Relation;
  Target out;
  Target largest; // of any type that starts there
  Target leaf;
  const auto take = [](Target &to, Relation relation, uint32_t type, uint64_t start,
                       uint64_t delta) {
    to.relation = relation;
    to.type = type;
    to.start = start;
    to.delta = delta;
  };
  if (descendRoots(offset, false, [&](uint32_t type, uint64_t rel) {
        const Kind kind = app_->types[type].kind;
        if (rel == 0) {
          if (baseType(*app_, type) == pointee) {
            take(out, Relation::Start, type, offset, 0);
            return true;
          }
          if (largest.relation == Relation::None && kind != Kind::Program)
            take(largest, Relation::Start, type, offset, 0);
        } else if (kind != Kind::Array && !hasMembers(kind) && leaf.relation == Relation::None) {
          take(leaf, Relation::Inside, type, offset - rel, rel);
        }
        return false;
      }))
    return out;
  Target before; // the largest object that ends there
  if (descendRoots(offset, true, [&](uint32_t type, uint64_t rel) {
        const TypeDesc &desc = app_->types[type];
        if (rel != desc.size)
          return false;
        if (baseType(*app_, type) == pointee) {
          take(out, Relation::End, type, offset - rel, 0);
          return true;
        }
        if (before.relation == Relation::None && desc.kind != Kind::Program)
          take(before, Relation::End, type, offset - rel, 0);
        return false;
      }))
    return out;
  if (largest.relation != Relation::None)
    return largest;
  return leaf.relation != Relation::None ? leaf : before;
}

/// Appends the way from an object of `type` to the place at `rel` where an object of type `wanted`
/// starts.
bool LayoutIndex::appendPath(uint32_t type, uint64_t rel, uint32_t wanted, std::string &path,
                             bool indexOpen) const {
  if (rel == 0 && type == wanted)
    return true;
  const TypeDesc &desc = app_->types[type];
  const size_t length = path.size();
  if (desc.kind == Kind::Array) {
    const uint64_t size = app_->types[desc.element].size;
    if (size == 0 || rel >= desc.size)
      return false;
    const int64_t index = desc.lowerBound + static_cast<int64_t>(rel / size);
    if (indexOpen)
      path.back() = ',';
    else
      path += '[';
    path += fmt::format("{}]", index);
    if (appendPath(desc.element, rel % size, wanted, path, true))
      return true;
    path.resize(length);
    if (indexOpen)
      path.back() = ']';
    return false;
  }
  if (!hasMembers(desc.kind))
    return false;
  for (const uint32_t *m = membersBegin(type); m != membersBegin(type) + memberCount(type); ++m) {
    const MemberDesc &member = app_->members[*m];
    if (member.offset > rel || rel - member.offset >= app_->types[member.type].size)
      continue;
    if ((member.flags & kSymBase) == 0)
      path.append(".").append(member.name);
    if (appendPath(member.type, rel - member.offset, wanted, path, false))
      return true;
    path.resize(length);
  }
  return false;
}

std::string LayoutIndex::pathOf(uint64_t offset, uint32_t type) const {
  for (const uint32_t r : roots_) {
    const RootDesc &root = app_->roots[r];
    if (root.offset > offset)
      break;
    if (offset - root.offset >= app_->types[root.type].size)
      continue;
    std::string path =
        root.list != nullptr ? fmt::format("{}.{}", root.list, root.name) : std::string(root.name);
    if (appendPath(root.type, offset - root.offset, type, path, false))
      return path;
  }
  return {};
}

std::string LayoutIndex::path(const Target &target) const {
  switch (target.relation) {
  case Target::Relation::None:
    return {};
  case Target::Relation::Start:
    return pathOf(target.start, target.type);
  case Target::Relation::End:
    return "the end of " + pathOf(target.start, target.type);
  case Target::Relation::Inside:
    return fmt::format("{} + {} bytes", pathOf(target.start, target.type), target.delta);
  }
  return {};
}

} // namespace stride::app
