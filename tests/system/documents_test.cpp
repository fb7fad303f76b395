// Does what the pages for users say: README.md, the pages of docs/ (not those for developers) and
// the READMEs of the examples. Their ST and TOML become files, and their commands are run in order
// with the built `stride`.
//
//   ```st, ```toml, …  a file; named by `<!-- file: NAME -->` before it. Without a name ST is
//                      checked, and everything else only looked at
//   ```console         `$ command` lines, each followed by its output if it is to be compared; a
//                      line `...` stands for any lines. Where the output shows an error the command
//                      must fail
//   ```sh              a script for the shell, all of whose commands must succeed; `./dev …` lines
//                      must name one of its commands
//
// Every block names its language, so that no command hides in one of them. Comments before a block:
//
//   <!-- not run: REASON -->     its commands are not run
//   <!-- background: FILE -->    its only command goes on to the end of the page; the page waits
//                                until the command has made FILE
//   <!-- setup: COMMANDS -->     what a reader has already, and the test has not
//   <!-- check: COMMANDS -->     run after the block, to see whether it is right
//
// The page begins in a folder with the examples; what `cd` does counts until the end of the page.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <gtest/gtest.h>
#include <set>
#include <thread>

namespace stride::test {
namespace {

namespace fs = std::filesystem;

struct Block {
  std::string language;
  std::string file;       // from the comments before the block
  std::string notRun;     // a reason
  std::string background; // a file that the command makes
  std::string setup;      // commands
  std::string check;      // commands
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

/// Takes a comment `<!-- WORD: TEXT -->` into the next block; false when it is none of ours.
bool readComment(const std::string &line, Block &next) {
  const std::pair<const char *, std::string Block::*> words[] = {
      {"<!-- file: ", &Block::file},
      {"<!-- not run: ", &Block::notRun},
      {"<!-- background: ", &Block::background},
      {"<!-- setup: ", &Block::setup},
      {"<!-- check: ", &Block::check}};
  const size_t end = line.rfind(" -->");
  for (const auto &[word, member] : words)
    if (const size_t length = std::string(word).size();
        line.starts_with(word) && end != std::string::npos && end > length) {
      next.*member = line.substr(length, end - length);
      return true;
    }
  return false;
}

std::vector<Block> fencedBlocks(const std::string &markdown) {
  const std::string fence = "```";
  std::vector<Block> blocks;
  Block next;
  bool inside = false;
  size_t number = 0;
  for (const std::string &line : splitLines(markdown)) {
    ++number;
    if (inside && line == fence) {
      inside = false;
    } else if (inside) {
      blocks.back().lines.push_back(line);
    } else if (line.starts_with(fence)) {
      inside = true;
      next.language = line.substr(fence.size());
      next.line = number;
      blocks.push_back(std::exchange(next, {}));
    } else if (!line.empty() && !readComment(line, next)) {
      next = {};
    }
  }
  return blocks;
}

std::vector<Command> consoleCommands(const Block &block) {
  std::vector<Command> commands;
  size_t number = block.line;
  for (const std::string &line : block.lines) {
    ++number;
    if (line.starts_with("$ "))
      commands.push_back({line.substr(2), "", number});
    else if (!commands.empty())
      commands.back().output += line + '\n';
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

/// Whether a command stands in text that is not one for the shell.
bool looksLikeACommand(const std::string &line) {
  return line.starts_with("stride ") || line.starts_with("stride-host ") ||
         line.starts_with("$ ") || line.starts_with("./dev ");
}

/// Waits until `condition` holds; false when it does not within ten seconds.
template <typename Condition> bool waitUntil(const Condition &condition) {
  for (int round = 0; round < 1000; ++round) {
    if (condition())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return condition();
}

class Documents : public ::testing::TestWithParam<std::string> {
protected:
  // The examples lie in the working directory as they do in the repository.
  void SetUp() override {
    fs::create_directory(page_);
    fs::copy(fs::path(STRIDE_SOURCE_DIR) / "examples", page_ / "examples",
             fs::copy_options::recursive);
  }

  void TearDown() override {
    for (const fs::path &name : backgrounds_)
      endBackground(name);
  }

  void write(const Block &block) {
    const fs::path path = folder_ / block.file;
    fs::create_directories(path.parent_path());
    writeFile(path, block.text());
  }

  ProcessResult shell(const std::string &command) {
    const char *path = std::getenv("PATH");
    const fs::path where = scratch_.path() / "where";
    ProcessResult result = runProcess(
        {"timeout", "60", "sh", "-c", "trap 'pwd > \"$PAGE_FOLDER\"' EXIT\n" + command}, folder_,
        {{"PATH", std::string(STRIDE_BINARY_DIR ":") + (path ? path : "")},
         {"PAGE_FOLDER", where.string()}});
    if (fs::exists(where)) // not after it took too long
      folder_ = splitLines(readFile(where)).at(0);
    return result;
  }

  void expectSuccess(const std::string &script, size_t line) {
    const ProcessResult result = shell("set -ex\n" + script); // x: shows which command has failed
    EXPECT_EQ(result.exitCode, 0) << "line " << line << '\n' << result.out << result.err;
  }

  void runConsole(const Command &command) {
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

  /// At most for a minute, whatever becomes of us, as every command.
  void startBackground(const Block &block) {
    const fs::path name = scratch_.path() / ("background" + std::to_string(backgrounds_.size()));
    const std::string n = name.string();
    ASSERT_EQ(block.lines.size(), 1) << "line " << block.line;
    backgrounds_.push_back(name);
    shell("( timeout 60 " + block.lines[0] + " > " + n +
          ".out 2>&1 < /dev/null & p=$!; echo $p > " + n + ".pid; wait $p; echo $? > " + n +
          ".code.new; mv " + n + ".code.new " + n + ".code ) > /dev/null 2>&1 &");
    EXPECT_TRUE(waitUntil([&] { return fs::exists(folder_ / block.background); }))
        << "line " << block.line << ": no " << block.background << '\n'
        << readFile(n + ".out");
  }

  static void endBackground(const fs::path &name) {
    const fs::path code = name.string() + ".code";
    if (!fs::exists(code) && fs::exists(name.string() + ".pid"))
      kill(std::stoi(readFile(name.string() + ".pid")), SIGTERM);
    ASSERT_TRUE(waitUntil([&] { return fs::exists(code); })) << "it does not end";
    EXPECT_EQ(readFile(code), "0\n") << readFile(name.string() + ".out");
  }

  void runScript(const Block &block) {
    std::string script;
    for (const std::string &line : block.lines)
      if (line.starts_with("./dev ")) {
        static const std::string kHelp =
            runProcess({STRIDE_SOURCE_DIR "/dev", "help"}, STRIDE_SOURCE_DIR).out;
        EXPECT_NE(kHelp.find("\n  " + splitWords(line).at(1)), std::string::npos) << line;
      } else {
        script += line + '\n';
      }
    if (!block.background.empty())
      startBackground(block);
    else
      expectSuccess(script, block.line);
  }

  void runBlock(const Block &block) {
    if (!block.setup.empty())
      expectSuccess(block.setup, block.line);
    if (!block.notRun.empty())
      return;
    if (block.language == "console") {
      for (const Command &command : consoleCommands(block))
        runConsole(command);
    } else if (block.language == "sh") {
      runScript(block);
    } else if (!block.file.empty()) {
      write(block);
    } else if (block.language == "st") {
      expectSuccess("cat > snippet.st <<'END_OF_SNIPPET'\n" + block.text() +
                        "END_OF_SNIPPET\nstride check snippet.st; rm snippet.st",
                    block.line);
    }
    if (!block.check.empty())
      expectSuccess(block.check, block.line);
  }

  ScratchDirectory scratch_;
  fs::path page_ = scratch_.path() / "page";
  fs::path folder_ = page_; ///< where the page's next command is given
  std::vector<fs::path> backgrounds_;
};

TEST_P(Documents, WhatTheySayWorks) {
  for (const Block &block : fencedBlocks(readFile(fs::path(STRIDE_SOURCE_DIR) / GetParam())))
    runBlock(block);
}

TEST_P(Documents, NoCommandHides) {
  const std::set<std::string> languages = {"st",  "iecst", "toml",  "sh",  "console", "text",
                                           "cpp", "c",     "cmake", "cnc", "json"};
  for (const Block &block : fencedBlocks(readFile(fs::path(STRIDE_SOURCE_DIR) / GetParam()))) {
    EXPECT_TRUE(languages.contains(block.language))
        << "line " << block.line << ": a block in the language '" << block.language << "'";
    if (block.language == "sh" || block.language == "console")
      continue;
    EXPECT_TRUE(block.notRun.empty()) << "line " << block.line << " has no commands";
    for (const std::string &line : block.lines)
      EXPECT_FALSE(looksLikeACommand(line)) << "line " << block.line << ": " << line;
  }
}

std::vector<std::string> userPages() {
  const fs::path root = STRIDE_SOURCE_DIR;
  std::vector<std::string> result{"README.md"};
  for (const fs::directory_entry &page : fs::directory_iterator(root / "docs"))
    if (page.path().extension() == ".md")
      result.push_back("docs/" + page.path().filename().string());
  for (const fs::directory_entry &example : fs::directory_iterator(root / "examples"))
    if (fs::exists(example.path() / "README.md"))
      result.push_back("examples/" + example.path().filename().string() + "/README.md");
  std::sort(result.begin(), result.end());
  return result;
}

INSTANTIATE_TEST_SUITE_P(All, Documents, ::testing::ValuesIn(userPages()),
                         [](const ::testing::TestParamInfo<std::string> &info) {
                           std::string name;
                           for (const char c : info.param)
                             name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(DocumentsOutput, ThreeDotsMatchAnyLines) {
  EXPECT_TRUE(outputMatches("a\n...\nd\n", "a\nb\nc\nd\n"));
  EXPECT_TRUE(outputMatches("a\n...\n", "a\n"));
  EXPECT_FALSE(outputMatches("a\n...\nd\n", "a\nb\n"));
  EXPECT_FALSE(outputMatches("a\n", "a\nb\n"));
}

TEST(DocumentsComments, BelongToTheNextBlockOnly) {
  const std::vector<Block> blocks =
      fencedBlocks("<!-- setup: mkdir a -->\n<!-- not run: it lasts for ever -->\n\n```sh\nb\n```\n"
                   "```sh\nc\n```\n<!-- file: d -->\ntext\n```st\ne\n```\n");
  ASSERT_EQ(blocks.size(), 3);
  EXPECT_EQ(blocks[0].setup, "mkdir a");
  EXPECT_EQ(blocks[0].notRun, "it lasts for ever");
  EXPECT_EQ(blocks[1].setup + blocks[1].notRun, "");
  EXPECT_EQ(blocks[1].line, 7);
  EXPECT_EQ(blocks[2].file, ""); // text in between
}

} // namespace
} // namespace stride::test
