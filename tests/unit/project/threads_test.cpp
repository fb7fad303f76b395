// Projects that are read by several threads.
#include "compiler/codegen/codegen.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/source/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace stc {
namespace {

namespace fs = std::filesystem;

/// The golden projects and examples that have several sources.
std::vector<fs::path> projects() {
  std::vector<fs::path> found;
  for (const char *folder : {"/tests/golden/projects", "/examples"})
    for (const auto &entry : fs::directory_iterator(STRIDE_SOURCE_DIR + std::string(folder)))
      if (fs::exists(entry.path() / "stride.toml") &&
          std::count_if(fs::recursive_directory_iterator(entry.path()), {},
                        [](const auto &file) { return file.path().extension() == ".st"; }) > 2)
        found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// Its diagnostics, and the C++ that is made of it.
std::string outcomeWith(unsigned jobs, const fs::path &path, const LibraryIndex &index) {
  Settings settings;
  settings.jobs = jobs;
  Project project(path, Purpose::Build, settings, index);
  std::string text;
  for (const Diagnostic &d : project.diagnostics())
    text += renderText(d, project.sources());
  if (!project.hasErrors())
    for (const GeneratedFile &file : generateApplication(project.program(), project.appConfig()))
      text += "---- " + file.path + "\n" + file.text;
  return text;
}

TEST(Threads, MakeNoDifference) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const std::vector<fs::path> all = projects();
  ASSERT_GT(all.size(), 10U);
  for (const fs::path &path : all) {
    const std::string expected = outcomeWith(1, path, index);
    for (const unsigned jobs : {2U, 7U})
      EXPECT_EQ(outcomeWith(jobs, path, index), expected) << path << " with " << jobs;
  }
}

} // namespace
} // namespace stc
