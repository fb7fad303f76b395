#include "compiler/project/include_graph.hpp"

#include "compiler/source/content_hash.hpp"

#include <string_view>
#include <unordered_set>

namespace stc {

namespace {

/// Names in `#include "…"` of a generated text.
std::vector<std::string> includesOf(std::string_view text) {
  constexpr std::string_view kInclude = "#include \"";
  std::vector<std::string> names;
  for (size_t at = text.find(kInclude); at != std::string_view::npos;
       at = text.find(kInclude, at)) {
    at += kInclude.size();
    const size_t end = text.find('"', at);
    if (end == std::string_view::npos)
      break;
    names.emplace_back(text.substr(at, end - at));
  }
  return names;
}

} // namespace

IncludeGraph::IncludeGraph(const std::vector<GeneratedFile> &files) {
  for (const GeneratedFile &file : files)
    byPath_.emplace(file.path, &file);
}

const IncludeGraph::Content &IncludeGraph::of(const GeneratedFile &file) {
  const auto [at, isNew] = contents_.try_emplace(&file);
  if (isNew) {
    at->second.hash = ContentHash().add(file.path).add(file.text).hex();
    for (const std::string &name : includesOf(file.text))
      if (const auto found = byPath_.find(name); found != byPath_.end())
        at->second.includes.push_back(found->second);
  }
  return at->second;
}

std::vector<const GeneratedFile *> IncludeGraph::closureOf(const std::string &path) {
  std::vector<const GeneratedFile *> all = {byPath_.at(path)};
  std::unordered_set<const GeneratedFile *> seen = {all.front()};
  for (size_t i = 0; i < all.size(); ++i)
    for (const GeneratedFile *included : of(*all[i]).includes)
      if (seen.insert(included).second)
        all.push_back(included);
  return all;
}

} // namespace stc
