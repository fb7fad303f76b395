#include "compiler/project/include_graph.hpp"

#include "compiler/source/content_hash.hpp"

#include <string_view>

namespace stc {

namespace {

/// Names in `#include "…"` of a generated text.
std::vector<std::string_view> includesOf(std::string_view text) {
  constexpr std::string_view kInclude = "#include \"";
  std::vector<std::string_view> names;
  for (size_t at = text.find(kInclude); at != std::string_view::npos;
       at = text.find(kInclude, at)) {
    at += kInclude.size();
    const size_t end = text.find('"', at);
    if (end == std::string_view::npos)
      break;
    names.push_back(text.substr(at, end - at));
  }
  return names;
}

} // namespace

IncludeGraph::IncludeGraph(const std::vector<GeneratedFile> &files, const Workers &workers)
    : files_(files), contents_(files.size()) {
  size_t bytes = 0;
  for (const GeneratedFile &file : files) {
    byPath_.emplace(file.path, &file);
    bytes += file.text.size();
  }
  Workers::each(files.size(), workers.threadsFor(files.size(), bytes),
                [&](size_t i, unsigned) { contents_[i] = read(files[i]); });
}

IncludeGraph::Content IncludeGraph::read(const GeneratedFile &file) const {
  Content content{ContentHash().add(file.path).add(file.text).hex(), {}};
  for (const std::string_view name : includesOf(file.text))
    if (const auto found = byPath_.find(name); found != byPath_.end())
      content.includes.push_back(found->second);
  return content;
}

std::vector<const GeneratedFile *> IncludeGraph::closureOf(const std::string &path) const {
  std::vector<const GeneratedFile *> all = {byPath_.at(path)};
  std::vector<bool> seen(files_.size());
  seen[indexOf(*all.front())] = true;
  for (size_t i = 0; i < all.size(); ++i)
    for (const GeneratedFile *included : contents_[indexOf(*all[i])].includes) {
      if (!seen[indexOf(*included)])
        all.push_back(included);
      seen[indexOf(*included)] = true;
    }
  return all;
}

} // namespace stc
