#include "runtime/monitor/symbol_list.hpp"

#include <fmt/format.h>

namespace stride::monitor {

namespace {

/// Collects the entries of one page.
class Lister {
public:
  Lister(const StrideAppV1 &app, uint64_t first, size_t most)
      : app_(&app), first_(first), most_(most) {}

  void roots() {
    for (uint32_t i = 0; i < app_->rootCount; ++i) {
      const RootDesc &root = app_->roots[i];
      if ((root.flags & kSymHidden) != 0)
        continue;
      const std::string name =
          root.list != nullptr ? fmt::format("{}.{}", root.list, root.name) : root.name;
      add(name, name, root.type, root.flags);
    }
  }
  void below(std::string_view path, const TypeDesc &type) {
    if (type.kind == Kind::Array)
      elements(path, type);
    else if (type.kind >= Kind::Struct && type.kind <= Kind::Program)
      members(path, type);
  }
  SymbolPage take() { return std::move(page_); }

private:
  void members(std::string_view path, const TypeDesc &type) {
    for (uint32_t i = 0; i < type.memberCount; ++i) {
      const MemberDesc &member = app_->members[type.firstMember + i];
      if ((member.flags & kSymBase) != 0)
        members(path, app_->types[member.type]);
      else if ((member.flags & kSymHidden) == 0)
        add(member.name, fmt::format("{}.{}", path, member.name), member.type, member.flags);
    }
  }
  void elements(std::string_view path, const TypeDesc &type) {
    page_.total = type.elementCount;
    for (uint64_t i = first_; i < type.elementCount && page_.entries.size() < most_; ++i) {
      const std::string name = fmt::format("[{}]", type.lowerBound + static_cast<int64_t>(i));
      entry(name, fmt::format("{}{}", path, name), type.element, 0);
    }
  }
  void add(std::string name, std::string path, uint32_t type, uint32_t flags) {
    if (page_.total++ >= first_ && page_.entries.size() < most_)
      entry(std::move(name), std::move(path), type, flags);
  }
  void entry(std::string name, std::string path, uint32_t type, uint32_t flags) {
    const TypeDesc &desc = app_->types[type];
    page_.entries.push_back(
        {std::move(name), std::move(path), desc.name, desc.kind, flags, countBelow(desc)});
  }
  uint64_t countBelow(const TypeDesc &type) const {
    if (type.kind == Kind::Array)
      return type.elementCount;
    if (type.kind < Kind::Struct || type.kind > Kind::Program)
      return 0;
    uint64_t count = 0;
    for (uint32_t i = 0; i < type.memberCount; ++i) {
      const MemberDesc &member = app_->members[type.firstMember + i];
      if ((member.flags & kSymBase) != 0)
        count += countBelow(app_->types[member.type]);
      else if ((member.flags & kSymHidden) == 0)
        ++count;
    }
    return count;
  }

  const StrideAppV1 *app_;
  uint64_t first_;
  size_t most_;
  SymbolPage page_;
};

} // namespace

SymbolPage listSymbols(const app::SymbolTable &symbols, std::string_view path, uint64_t first,
                       size_t most) {
  Lister lister(symbols.app(), first, most);
  if (path.empty())
    lister.roots();
  else
    lister.below(path, symbols.type(symbols.resolve(path)));
  return lister.take();
}

} // namespace stride::monitor
