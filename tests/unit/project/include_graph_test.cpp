#include "compiler/project/include_graph.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

namespace stc {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> paths(const std::vector<const GeneratedFile *> &files) {
  std::vector<std::string> result;
  for (const GeneratedFile *file : files)
    result.push_back(file->path);
  return result;
}

TEST(IncludeGraph, FollowsIncludesOnceAndThroughCircles) {
  const std::vector<GeneratedFile> files = {
      {"a.cpp", "#include \"st/a.h\"\n#include \"st/b.h\"\n#include \"runtime/x.h\"\n"},
      {"st/a.h", "#include \"st/b.h\"\n#include \"st/c.h\"\n"},
      {"st/b.h", "#include \"st/a.h\"\n"},
      {"st/c.h", "#include \"unfinished"},
      {"other.cpp", "int x;"},
  };
  for (const unsigned threads : {1U, 3U}) {
    const IncludeGraph graph(files, Workers(threads));
    EXPECT_THAT(paths(graph.closureOf("a.cpp")),
                ElementsAre("a.cpp", "st/a.h", "st/b.h", "st/c.h"));
    EXPECT_THAT(paths(graph.closureOf("st/b.h")), ElementsAre("st/b.h", "st/a.h", "st/c.h"));
    EXPECT_THAT(paths(graph.closureOf("other.cpp")), ElementsAre("other.cpp"));
  }
}

TEST(IncludeGraph, HashesPathAndText) {
  const std::vector<GeneratedFile> files = {
      {"a.h", "x"}, {"a.h", "x"}, {"b.h", "x"}, {"a.h", "y"}, {"a.hx", ""}};
  const IncludeGraph graph(files, Workers(1));
  EXPECT_EQ(graph.hashOf(files[0]), graph.hashOf(files[1]));
  for (size_t i = 2; i < files.size(); ++i)
    EXPECT_NE(graph.hashOf(files[0]), graph.hashOf(files[i])) << i;
}

} // namespace
} // namespace stc
