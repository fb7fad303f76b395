#ifndef STRIDE_COMPILER_PROJECT_INCLUDE_GRAPH_HPP
#define STRIDE_COMPILER_PROJECT_INCLUDE_GRAPH_HPP
// What generated files include of each other: what a translation unit depends on, and needs.

#include "compiler/codegen/codegen.hpp"

#include <string>
#include <unordered_map>
#include <vector>

namespace stc {

class IncludeGraph {
public:
  /// `files` must outlive it and stay as they are.
  explicit IncludeGraph(const std::vector<GeneratedFile> &files);

  /// The file of that path, and those that it includes by itself or by others, each once. Headers
  /// that are not generated are none of them.
  [[nodiscard]] std::vector<const GeneratedFile *> closureOf(const std::string &path);
  /// A hash of the file's path and text.
  [[nodiscard]] const std::string &hashOf(const GeneratedFile &file) { return of(file).hash; }

private:
  struct Content {
    std::string hash;
    std::vector<const GeneratedFile *> includes;
  };
  const Content &of(const GeneratedFile &file);

  std::unordered_map<std::string, const GeneratedFile *> byPath_;
  std::unordered_map<const GeneratedFile *, Content> contents_; ///< of those that were asked for
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_INCLUDE_GRAPH_HPP
