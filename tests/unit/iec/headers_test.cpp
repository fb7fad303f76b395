// The headers that generated code includes: small and free of the C++ standard library.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace {

std::string preprocessed(const std::string &header) {
  const std::string command = "printf '#include \"" + header +
                              "\"\\n' | " STRIDE_CXX " -std=c++20 -E -x c++ -I '" STRIDE_SOURCE_DIR
                              "' - 2>&1";
  std::string text;
  std::FILE *pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr)
    return text;
  char buffer[4096];
  for (size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    text.append(buffer, n);
  return ::pclose(pipe) == 0 ? text : "";
}

TEST(Headers, OfGeneratedCodeAreFreeOfTheStandardLibraryAndSmall) {
  for (const char *header : {"runtime/iec/ops.h", "runtime/app/abi.h", "runtime/app/ctx.h"}) {
    const std::string text = preprocessed(header);
    ASSERT_FALSE(text.empty()) << header;
    size_t lines = 0;
    for (const char c : text)
      lines += c == '\n' ? 1 : 0;
    EXPECT_LT(lines, 3000U) << header;
    EXPECT_EQ(text.find("/bits/c++config.h"), std::string::npos) << header;
    EXPECT_EQ(text.find("namespace std"), std::string::npos) << header;
  }
}

} // namespace
