// Retained values of random types through a file into the same build and into another one: every
// variable that is stored and wanted holds what an online change would have given it, every other
// one its initial value.
#include "runtime/app/retain_image.hpp"
#include "tests/property/random_builds.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace stride;
using stride::test::AppModel;
using stride::test::ModelField;
using stride::test::ModelRoot;
using stride::test::ModelType;
using stride::test::World;

struct Leaf {
  const ModelType *type;
  uint64_t offset;
  uint32_t flags; ///< All on the way to it.
  bool renamed;
};

bool holdsAddress(const ModelType *type) {
  if (type->kind == Kind::Pointer)
    return true;
  if (type->kind == Kind::Array)
    return holdsAddress(type->element);
  return std::any_of(type->fields.begin(), type->fields.end(),
                     [](const ModelField &f) { return holdsAddress(f.type); });
}

void collect(const ModelType *type, const std::string &id, uint64_t offset, uint32_t flags,
             bool renamed, std::map<std::string, Leaf> &out) {
  if (type->kind == Kind::Array) {
    for (uint64_t i = 0; i < type->count; ++i)
      collect(type->element, id + "[" + std::to_string(type->low + static_cast<int64_t>(i)) + "]",
              offset + i * type->element->size, flags, renamed, out);
    return;
  }
  if (type->kind != Kind::Struct && type->kind != Kind::FunctionBlock) {
    out[id] = {type, offset, flags, renamed};
    return;
  }
  for (const ModelType *owner = type; owner != nullptr; owner = owner->base)
    for (size_t i = 0; i < owner->fields.size(); ++i) {
      const ModelField &f = owner->fields[i];
      collect(f.type, id + "." + std::to_string(f.id), offset + owner->offsets[i], flags | f.flags,
              renamed || !f.renamedFrom.empty(), out);
    }
}

std::map<std::string, Leaf> leavesOf(const AppModel &model) {
  std::map<std::string, Leaf> out;
  for (const ModelRoot &root : model.roots)
    collect(root.type, std::to_string(root.id), root.offset, root.flags, !root.renamedFrom.empty(),
            out);
  return out;
}

/// What {attribute 'init_on_onlchange'} says is about online changes only.
void withoutInitOnChange(StrideAppV1 &app) {
  for (uint32_t i = 0; i < app.memberCount; ++i)
    const_cast<MemberDesc &>(app.members[i]).flags &= ~uint32_t{kSymInitOnChange};
  for (uint32_t i = 0; i < app.rootCount; ++i)
    const_cast<RootDesc &>(app.roots[i]).flags &= ~uint32_t{kSymInitOnChange};
}

class Memory {
public:
  Memory(World &world, uint64_t size, bool random) : words_(size / 8 + 2) {
    for (uint64_t &word : words_)
      word = random ? world.bits() : 0xABABABABABABABABULL;
  }
  std::byte *data() { return reinterpret_cast<std::byte *>(words_.data()); }

private:
  std::vector<uint64_t> words_;
};

void checkWorld(uint64_t seed, bool sameBuild) {
  World world(seed);
  StrideAppV1 &before = world.before.app();
  StrideAppV1 &after = sameBuild ? before : world.after.app();
  withoutInitOnChange(before);
  withoutInitOnChange(after);
  before.buildHash = 1;
  after.buildHash = sameBuild ? 1 : 2;
  Memory old(world, before.stateSize, true);
  Memory restored(world, after.stateSize, false);
  Memory carried(world, after.stateSize, false);
  Memory initial(world, after.stateSize, false);

  const app::RetainLayout layout(before, app::kRetained);
  std::vector<std::byte> values(layout.bytes());
  app::copyRetained(old.data(), layout.ranges(), values.data());
  const app::RetainImage image =
      app::decodeImage(app::encodeImage({"model", 1, 1}, layout.encode(), values));
  const app::RetainLayout own(after, app::kRetained);
  const app::RetainRestore plan(after, own, image);
  RC_ASSERT(plan.keepsRetains() == sameBuild || !sameBuild);
  static_cast<void>(plan.apply(restored.data()));

  const app::CarryOver online(before, after, app::MatchOptions{0, false});
  app::CarryResult result;
  online.apply(old.data(), carried.data(), result);
  const std::map<std::string, Leaf> olds = leavesOf(world.before);
  for (const auto &[id, leaf] : leavesOf(sameBuild ? world.before : world.after)) {
    const auto found = olds.find(id);
    if (found == olds.end() || (!sameBuild && (leaf.renamed || found->second.renamed)))
      continue; // may be found under another name that is not stored
    const uint32_t flags = leaf.flags;
    const bool wanted = (flags & (sameBuild ? app::kRetained : uint32_t{kSymPersistent})) != 0 &&
                        (found->second.flags & app::kRetained) != 0 &&
                        ((flags | found->second.flags) & kSymConstant) == 0 &&
                        !holdsAddress(leaf.type) && !holdsAddress(found->second.type);
    std::byte *const expected = (wanted ? carried : initial).data() + leaf.offset;
    if (std::memcmp(restored.data() + leaf.offset, expected, leaf.type->size) != 0)
      RC_FAIL("seed " + std::to_string(seed) + ": " + id + " : " + leaf.type->name +
              (wanted ? " wanted" : " not wanted"));
  }
}

RC_GTEST_PROP(RetainProperty, TheSameBuildGetsEverythingBack, (uint64_t seed)) {
  for (uint64_t i = 0; i < 25; ++i)
    checkWorld(seed * 1000003 + i, true);
}

RC_GTEST_PROP(RetainProperty, AnotherBuildGetsWhatIsPersistent, (uint64_t seed)) {
  for (uint64_t i = 0; i < 25; ++i)
    checkWorld(seed * 1000003 + i, false);
}

} // namespace
