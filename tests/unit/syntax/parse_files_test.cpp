// Files that are parsed at once.
#include "tests/unit/syntax/print_ast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace stc::test {
namespace {

namespace fs = std::filesystem;

/// All programs of the golden tests, right and wrong ones, as if they were one project.
const std::vector<fs::path> &goldenFiles() {
  static const std::vector<fs::path> files = [] {
    std::vector<fs::path> found;
    for (const auto &entry : fs::recursive_directory_iterator(STRIDE_SOURCE_DIR "/tests/golden"))
      if (entry.path().extension() == ".st")
        found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }();
  return files;
}

/// What parsing gives.
struct Outcome {
  std::vector<std::string> trees;
  std::vector<std::string> diagnostics; ///< in the order in which they were reported
  size_t identifiers = 0;
  size_t errors = 0;
  size_t warnings = 0;
};

/// `threads` 0: one parse() after the other.
Outcome outcomeWith(unsigned threads) {
  Sources sources;
  std::vector<FileId> ids;
  for (const fs::path &path : goldenFiles()) {
    std::ifstream in(path, std::ios::binary);
    ids.push_back(sources.addBytes(path.filename().string(),
                                   std::string(std::istreambuf_iterator<char>(in), {})));
  }
  std::vector<const SourceFile *> files;
  for (const FileId id : ids)
    files.push_back(&sources.file(id));
  Interner interner;
  Arena arena;
  Diagnostics diagnostics;
  DeclaredNames names(sources, ids);
  const ParseOptions options{{}, &names};
  std::vector<ast::File *> trees;
  if (threads == 0)
    for (const SourceFile *file : files)
      trees.push_back(parse(*file, interner, arena, diagnostics, &options));
  else
    trees = parseFiles(files, interner, arena, diagnostics, &options, Workers(threads));
  Outcome outcome;
  for (const ast::File *tree : trees)
    outcome.trees.push_back(print(*tree));
  for (const Diagnostic &d : diagnostics.all())
    outcome.diagnostics.push_back(renderText(d, sources));
  // A place in each file, where {warning disable …} may have made it silent.
  for (const FileId id : ids)
    diagnostics.report(Code::UnusedVariable,
                       {id, static_cast<uint32_t>(sources.file(id).text().size()), 0}, "probe");
  outcome.identifiers = interner.size();
  outcome.errors = diagnostics.errorCount();
  outcome.warnings = diagnostics.warningCount();
  return outcome;
}

TEST(ParseFiles, GivesTheSameWithAnyNumberOfThreads) {
  const Outcome expected = outcomeWith(0);
  ASSERT_GT(expected.trees.size(), 1000U);
  ASSERT_GT(expected.diagnostics.size(), 100U);
  for (const unsigned threads : {1U, 2U, 7U}) {
    const Outcome actual = outcomeWith(threads);
    EXPECT_EQ(actual.trees, expected.trees) << threads;
    EXPECT_EQ(actual.diagnostics, expected.diagnostics) << threads;
    EXPECT_EQ(actual.identifiers, expected.identifiers) << threads;
    EXPECT_EQ(actual.errors, expected.errors) << threads;
    EXPECT_EQ(actual.warnings, expected.warnings) << threads;
  }
}

/// Conditions about what other files declare: whichever thread asks first reads them for all.
TEST(ParseFiles, AnswersConditionsAboutAllFiles) {
  Sources sources;
  std::vector<FileId> ids;
  for (int i = 0; i < 100; ++i) {
    const std::string n = std::to_string(i), next = std::to_string((i + 1) % 101);
    ids.push_back(
        sources.add(n + ".st", "FUNCTION_BLOCK B" + n + "\n{IF defined (pou: B" + next +
                                   ")}VAR yes : INT; END_VAR{END_IF}\nEND_FUNCTION_BLOCK"));
  }
  std::vector<const SourceFile *> files;
  for (const FileId id : ids)
    files.push_back(&sources.file(id));
  Interner interner;
  Arena arena;
  Diagnostics diagnostics;
  DeclaredNames names(sources, ids);
  const ParseOptions options{{}, &names};
  const auto trees = parseFiles(files, interner, arena, diagnostics, &options, Workers(7));
  std::set<Ident> variables;
  size_t with = 0;
  for (const ast::File *tree : trees)
    for (const ast::VarDecl *v : ast::as<ast::PouDecl>(tree->declarations.front())->variables) {
      variables.insert(v->name.id);
      ++with;
    }
  EXPECT_EQ(with, 99U); // there is no B100
  EXPECT_EQ(variables.size(), 1U) << "one identifier, whoever reads it";
}

} // namespace
} // namespace stc::test
