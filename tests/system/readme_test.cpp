// Does what the READMEs say: their ST and TOML snippets become files, their commands are run in
// order with the built `stride`, and the output they show must come out. README.md says to readers:
//
//   ```st, ```toml     a file; named by `<!-- file: NAME -->` before it, else only checked (st)
//   ```console         `$ command` lines, each followed by its output if it is to be compared; a
//   line
//                      `...` stands for any lines. Where the output shows an error the command must
//                      fail.
//   ```sh              `stride …` lines are run; `./dev …` lines must name one of its commands
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <cstdlib>
#include <gtest/gtest.h>

namespace stride::test {
namespace {

namespace fs = std::filesystem;

struct Block {
  std::string language;
  std::string file; // from the comment before the block
  std::vector<std::string> lines;
  size_t line = 0; // of the opening fence, from 1

  std::string text() const {
    std::string all;
    for (const std::string &l : lines)
      all += l + '\n';
    return all;
  }
};

struct Command {
  std::string text;
  std::string output; // empty: not compared
  size_t line = 0;
};

std::vector<Block> fencedBlocks(const std::string &markdown) {
  const std::string fence = "```";
  const std::string fileMark = "<!-- file: ";
  std::vector<Block> blocks;
  std::string file;
  bool inside = false;
  size_t number = 0;
  for (const std::string &line : splitLines(markdown)) {
    ++number;
    if (inside && line == fence) {
      inside = false;
      file.clear();
    } else if (inside) {
      blocks.back().lines.push_back(line);
    } else if (line.starts_with(fence)) {
      inside = true;
      blocks.push_back({line.substr(fence.size()), file, {}, number});
    } else if (line.starts_with(fileMark)) {
      file = line.substr(fileMark.size(), line.find(" -->") - fileMark.size());
    } else if (!line.empty()) {
      file.clear();
    }
  }
  return blocks;
}

std::vector<Command> commandsOf(const Block &block) {
  std::vector<Command> commands;
  size_t number = block.line;
  for (const std::string &line : block.lines) {
    ++number;
    if (block.language == "console" && line.starts_with("$ "))
      commands.push_back({line.substr(2), "", number});
    else if (block.language == "console" && !commands.empty())
      commands.back().output += line + '\n';
    else if (block.language == "sh" && line.starts_with("stride "))
      commands.push_back({line, "", number});
  }
  return commands;
}

// Whether the lines from `i` and `k` on match; a pattern line `...` matches any number of lines.
bool matches(const std::vector<std::string> &pattern, size_t i,
             const std::vector<std::string> &lines, size_t k) {
  for (; i < pattern.size(); ++i, ++k) {
    if (pattern[i] == "...") {
      for (size_t rest = k; rest <= lines.size(); ++rest)
        if (matches(pattern, i + 1, lines, rest))
          return true;
      return false;
    }
    if (k >= lines.size() || pattern[i] != lines[k])
      return false;
  }
  return k == lines.size();
}

bool outputMatches(const std::string &expected, const std::string &actual) {
  return matches(splitLines(canonical(expected)), 0, splitLines(canonical(actual)), 0);
}

class Readme : public ::testing::TestWithParam<std::string> {
protected:
  // The examples lie in the working directory as they do in the repository.
  void SetUp() override {
    fs::copy(fs::path(STRIDE_SOURCE_DIR) / "examples", scratch_.path() / "examples",
             fs::copy_options::recursive);
  }

  void write(const Block &block) {
    const fs::path path = scratch_.path() / block.file;
    fs::create_directories(path.parent_path());
    writeFile(path, block.text());
  }

  ProcessResult shell(const std::string &command) {
    const char *path = std::getenv("PATH");
    return runProcess({"sh", "-c", command}, scratch_.path(),
                      {{"PATH", std::string(STRIDE_BINARY_DIR ":") + (path ? path : "")}});
  }

  void run(const Command &command) {
    const ProcessResult result = shell(command.text);
    const bool failure = command.output.find("error") != std::string::npos;
    EXPECT_EQ(result.exitCode != 0, failure)
        << "line " << command.line << ": " << command.text << '\n'
        << result.out << result.err;
    if (!command.output.empty()) {
      EXPECT_TRUE(outputMatches(command.output, result.out + result.err))
          << "line " << command.line << ": " << command.text << '\n'
          << diff(command.output, result.out + result.err);
    }
  }

  ScratchDirectory scratch_;
};

TEST_P(Readme, ItsSnippetsWork) {
  const std::string markdown = readFile(fs::path(STRIDE_SOURCE_DIR) / GetParam());
  const std::string devHelp = runProcess({STRIDE_SOURCE_DIR "/dev", "help"}, STRIDE_SOURCE_DIR).out;
  for (const Block &block : fencedBlocks(markdown)) {
    if (block.language == "st" || block.language == "toml") {
      if (!block.file.empty())
        write(block);
      else if (block.language == "st")
        run({"cat > snippet.st <<'END_OF_SNIPPET'\n" + block.text() +
                 "END_OF_SNIPPET\nstride check snippet.st",
             "", block.line});
      else
        ADD_FAILURE() << "line " << block.line << ": a TOML snippet needs a file name";
    }
    for (const Command &command : commandsOf(block))
      run(command);
    for (const std::string &line : block.lines)
      if (block.language == "sh" && line.starts_with("./dev ")) {
        const std::string name = splitWords(line).at(1);
        EXPECT_NE(devHelp.find("\n  " + name), std::string::npos) << line;
      }
  }
}

std::vector<std::string> allReadmes() {
  std::vector<std::string> result{"README.md", "docs/language.md"};
  for (const fs::directory_entry &example :
       fs::directory_iterator(fs::path(STRIDE_SOURCE_DIR) / "examples"))
    if (fs::exists(example.path() / "README.md"))
      result.push_back("examples/" + example.path().filename().string() + "/README.md");
  return result;
}

INSTANTIATE_TEST_SUITE_P(All, Readme, ::testing::ValuesIn(allReadmes()),
                         [](const ::testing::TestParamInfo<std::string> &info) {
                           std::string name;
                           for (const char c : info.param)
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(ReadmeOutput, ThreeDotsMatchAnyLines) {
  EXPECT_TRUE(outputMatches("a\n...\nd\n", "a\nb\nc\nd\n"));
  EXPECT_TRUE(outputMatches("a\n...\n", "a\n"));
  EXPECT_FALSE(outputMatches("a\n...\nd\n", "a\nb\n"));
  EXPECT_FALSE(outputMatches("a\n", "a\nb\n"));
}

} // namespace
} // namespace stride::test
