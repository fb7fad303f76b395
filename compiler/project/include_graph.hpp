#ifndef STRIDE_COMPILER_PROJECT_INCLUDE_GRAPH_HPP
#define STRIDE_COMPILER_PROJECT_INCLUDE_GRAPH_HPP
// What generated files include of each other: what a translation unit depends on, and needs.

#include "compiler/codegen/codegen.hpp"
#include "compiler/source/workers.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stc {

class IncludeGraph {
public:
  /// `files` must outlive it and stay as they are; `workers` read them.
  IncludeGraph(const std::vector<GeneratedFile> &files, const Workers &workers);

  /// The file of that path, and those that it includes by itself or by others, each once. Headers
  /// that are not generated are none of them.
  [[nodiscard]] std::vector<const GeneratedFile *> closureOf(const std::string &path) const;
  /// A hash of the path and text of one of the files.
  [[nodiscard]] const std::string &hashOf(const GeneratedFile &file) const {
    return contents_[indexOf(file)].hash;
  }

private:
  struct Content {
    std::string hash;
    std::vector<const GeneratedFile *> includes;
  };
  [[nodiscard]] Content read(const GeneratedFile &file) const;
  [[nodiscard]] size_t indexOf(const GeneratedFile &file) const {
    return static_cast<size_t>(&file - files_.data());
  }

  const std::vector<GeneratedFile> &files_;
  std::unordered_map<std::string_view, const GeneratedFile *> byPath_;
  std::vector<Content> contents_; ///< of each file
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_INCLUDE_GRAPH_HPP
