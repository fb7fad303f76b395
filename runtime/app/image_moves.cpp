#include "runtime/app/image_moves.hpp"

#include "runtime/common/text.hpp"

#include <fmt/format.h>

#include <functional>
#include <string_view>
#include <unordered_map>

namespace stride::app {

namespace {

/// Where %Q and %M lie in a state.
struct Areas {
  const RootDesc *outputs = nullptr;
  const RootDesc *memory = nullptr;

  explicit Areas(const StrideAppV1 &app) {
    for (uint32_t i = 0; i < app.rootCount; ++i) {
      if (app.roots[i].list != nullptr)
        continue;
      if (std::string_view(app.roots[i].name) == "%Q")
        outputs = &app.roots[i];
      else if (std::string_view(app.roots[i].name) == "%M")
        memory = &app.roots[i];
    }
  }
};

/// A place in an area.
struct Spot {
  char area = 0; ///< 'Q', 'M', or 0: in none of them.
  uint64_t byte = 0;
};

Spot spotOf(const StrideAppV1 &app, const Areas &areas, uint64_t offset) {
  const auto lies = [&](const RootDesc *root) {
    return root != nullptr && offset >= root->offset &&
           offset - root->offset < app.types[root->type].size;
  };
  if (lies(areas.outputs))
    return {'Q', offset - areas.outputs->offset};
  if (lies(areas.memory))
    return {'M', offset - areas.memory->offset};
  return {};
}

std::string joined(const char *first, const char *second) {
  return first == nullptr ? std::string(second) : fmt::format("{}.{}", first, second);
}

/// A variable at a fixed address.
struct Located {
  std::string path;
  std::string earlier; ///< Its path in an earlier build, where an attribute says it; or empty.
  uint64_t offset;
  uint32_t type;
  uint32_t flags;
};

void forLocated(const StrideAppV1 &app, const std::function<void(Located)> &take) {
  for (uint32_t i = 0; i < app.rootCount; ++i) {
    const RootDesc &root = app.roots[i];
    // Without a list it is a second name, by VAR_ACCESS.
    if ((root.flags & kSymLocated) != 0 && root.list != nullptr) {
      std::string earlier;
      if (root.renamedFrom != nullptr)
        earlier = std::string_view(root.renamedFrom).find('.') != std::string_view::npos
                      ? root.renamedFrom
                      : joined(root.list, root.renamedFrom);
      take({joined(root.list, root.name), std::move(earlier), root.offset, root.type, root.flags});
    }
    const TypeDesc &type = app.types[root.type];
    for (uint32_t m = 0; type.kind == Kind::Program && m < type.memberCount; ++m) {
      const MemberDesc &member = app.members[type.firstMember + m];
      if ((member.flags & kSymLocated) == 0)
        continue;
      std::string earlier;
      if (root.renamedFrom != nullptr || member.renamedFrom != nullptr)
        earlier = joined(root.renamedFrom != nullptr ? root.renamedFrom : root.name,
                         member.renamedFrom != nullptr ? member.renamedFrom : member.name);
      take({joined(root.name, member.name), std::move(earlier), member.offset, member.type,
            member.flags});
    }
  }
}

unsigned imageBitOf(uint32_t flags) {
  return (flags & kSymBit) != 0 ? flags >> kSymBitShift & 7U : kNoBit;
}

} // namespace

std::vector<ImageMove> imageMoves(const StrideAppV1 &oldApp, const StrideAppV1 &newApp) {
  const Areas oldAreas(oldApp);
  const Areas newAreas(newApp);
  std::unordered_map<std::string, Located> before;
  forLocated(oldApp, [&](Located variable) {
    std::string key = common::lowerCase(variable.path);
    before.emplace(std::move(key), std::move(variable));
  });
  std::vector<ImageMove> moves;
  forLocated(newApp, [&](const Located &is) {
    auto found = before.end();
    if (!is.earlier.empty())
      found = before.find(common::lowerCase(is.earlier));
    if (found == before.end())
      found = before.find(common::lowerCase(is.path));
    if (found == before.end())
      return;
    const Located &was = found->second;
    const Spot from = spotOf(oldApp, oldAreas, was.offset);
    const Spot to = spotOf(newApp, newAreas, is.offset);
    const unsigned oldBit = imageBitOf(was.flags);
    const unsigned newBit = imageBitOf(is.flags);
    if (from.area == 0 || to.area == 0 ||
        (from.area == to.area && from.byte == to.byte && oldBit == newBit))
      return;
    const TypeDesc &oldType = oldApp.types[was.type];
    const TypeDesc &newType = newApp.types[is.type];
    const bool isBit = oldBit != kNoBit || newBit != kNoBit;
    moves.push_back({is.path, was.offset, is.offset,
                     isBit ? uint64_t{oldBit} + 16 * uint64_t{newBit} : newType.size, isBit,
                     oldType.name, newType.name,
                     oldType.layoutHash == newType.layoutHash && oldType.size == newType.size});
  });
  return moves;
}

} // namespace stride::app
