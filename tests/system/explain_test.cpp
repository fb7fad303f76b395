// The examples of `stride explain` are programs: every wrong one must be reported with its code,
// every right one must be accepted. How a fragment becomes a program is said in
// docs/developers/contributing.md.
#include "tests/support/process.hpp"
#include "tests/support/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace stride::test {
namespace {

ProcessResult stride(std::vector<std::string> arguments, const std::filesystem::path &folder) {
  arguments.insert(arguments.begin(), STRIDE_BINARY_DIR "/stride");
  return runProcess(arguments, folder);
}

struct Example {
  std::string st;
  std::string toml;
  std::string cam; ///< of a cam file
  std::string cnc; ///< of a CNC file
};

bool startsWord(const std::string &line, std::string_view word) {
  return line.starts_with(word) &&
         (line.size() == word.size() ||
          (std::isalnum(static_cast<unsigned char>(line[word.size()])) == 0 &&
           line[word.size()] != '_'));
}

std::string trimmed(const std::string &line) {
  const size_t first = line.find_first_not_of(' ');
  return first == std::string::npos ? std::string() : line.substr(first);
}

/// The word that ends the unit or section which the line begins; empty for other lines.
std::string closerOf(const std::string &line) {
  static constexpr std::array<std::array<std::string_view, 2>, 21> kOpeners = {
      {{"PROGRAM", "END_PROGRAM"},
       {"FUNCTION", "END_FUNCTION"},
       {"FUNCTION_BLOCK", "END_FUNCTION_BLOCK"},
       {"CLASS", "END_CLASS"},
       {"INTERFACE", "END_INTERFACE"},
       {"NAMESPACE", "END_NAMESPACE"},
       {"CONFIGURATION", "END_CONFIGURATION"},
       {"TYPE", "END_TYPE"},
       {"VAR_GLOBAL", "END_VAR"},
       {"VAR_CONFIG", "END_VAR"},
       {"VAR_ACCESS", "END_VAR"},
       {"VAR", "END_VAR"},
       {"VAR_INPUT", "END_VAR"},
       {"VAR_OUTPUT", "END_VAR"},
       {"VAR_IN_OUT", "END_VAR"},
       {"VAR_TEMP", "END_VAR"},
       {"VAR_STAT", "END_VAR"},
       {"VAR_INST", "END_VAR"},
       {"VAR_EXTERNAL", "END_VAR"},
       {"METHOD", "END_METHOD"},
       {"PROPERTY", "END_PROPERTY"}}};
  for (const auto &[opener, closer] : kOpeners)
    if (startsWord(line, opener))
      return std::string(closer);
  return {};
}

bool isSection(const std::string &line) {
  return startsWord(line, "VAR") ||
         (line.starts_with("VAR_") && !startsWord(line, "VAR_GLOBAL") &&
          !startsWord(line, "VAR_CONFIG") && !startsWord(line, "VAR_ACCESS"));
}

/// `a, b : INT := 5;`: names, a colon that is not that of `:=`, a `;` at the end.
bool isDeclaration(const std::string &line) {
  const size_t end =
      line.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_, ");
  if (end == std::string::npos || line.find(';') == std::string::npos)
    return false;
  const size_t at = line.find(" AT %");
  const size_t colon = at != std::string::npos ? line.find(':', at) : end;
  return colon != std::string::npos && line[colon] == ':' && colon + 1 < line.size() &&
         line[colon + 1] != '=' && colon != 0 &&
         std::isdigit(static_cast<unsigned char>(line[0])) == 0;
}

/// Units stay; VAR sections, declarations and statements become a PROGRAM after them.
std::string wrapped(const std::string &text) {
  std::string units;
  std::string sections;
  std::string declarations;
  std::string statements;
  std::string closer;
  std::string *to = nullptr;
  bool inStatement = false; // labels of CASE look like declarations
  for (const std::string &raw : splitLines(text)) {
    const std::string line = trimmed(raw);
    if (closer.empty()) {
      closer = inStatement ? std::string() : closerOf(line);
      if (!closer.empty()) {
        to = isSection(line) ? &sections : &units;
      } else if (line.starts_with("{attribute") || line.starts_with("USING ")) {
        to = &units;
      } else if (!inStatement && isDeclaration(line)) {
        to = &declarations;
      } else {
        to = &statements;
        inStatement = inStatement || startsWord(line, "CASE");
      }
    }
    *to += raw + "\n";
    if (!closer.empty()) {
      const size_t found = raw.rfind(closer);
      const size_t behind = found == std::string::npos ? 0 : found + closer.size();
      if (found != std::string::npos &&
          (behind == raw.size() ||
           (std::isalnum(static_cast<unsigned char>(raw[behind])) == 0 && raw[behind] != '_')))
        closer.clear();
    }
  }
  if (trimmed(sections + declarations + statements).find_first_not_of(" \n") == std::string::npos)
    return units;
  if (!declarations.empty())
    declarations = "VAR\n" + declarations + "END_VAR\n";
  return units + "PROGRAM Example\n" + sections + declarations + statements + "END_PROGRAM\n";
}

/// The code blocks after "Wrong" or "Right", up to the next of these words.
Example exampleOf(const std::string &text, std::string_view which) {
  Example example;
  bool inside = false;
  std::string *fence = nullptr;
  std::string indented;
  for (const std::string &line : splitLines(text)) {
    if (fence != nullptr) {
      if (line == "```")
        fence = nullptr;
      else if (inside)
        *fence += line + "\n";
      continue;
    }
    static std::string ignored;
    if (line == "```st" || line == "```toml" || line == "```cam" || line == "```cnc") {
      std::string &text = line == "```st"     ? example.st
                          : line == "```toml" ? example.toml
                          : line == "```cam"  ? example.cam
                                              : example.cnc;
      fence = inside ? &text : &ignored;
      continue;
    }
    if (line.starts_with("Wrong") || line.starts_with("Right"))
      inside = line.starts_with(which);
    else if (inside && line.starts_with("    "))
      example.st += line.substr(4) + "\n";
  }
  return example;
}

struct Answer {
  std::set<std::string> codes;
  bool errors = false;
  std::string shown;
};

Answer check(const Example &example, const std::string &code, bool isOff) {
  const ScratchDirectory folder;
  // Text outside of declarations must stay there.
  const bool isProject = !example.toml.empty() || !example.cam.empty() || !example.cnc.empty();
  const bool asItStands = isProject || code == "SE0209";
  std::string st = asItStands ? example.st : wrapped(example.st);
  if (isProject) {
    if (!example.toml.empty())
      writeFile(folder.path() / "stride.toml", example.toml);
    if (!example.cam.empty())
      writeFile(folder.path() / "Cam1.cam.toml", example.cam);
    if (!example.cnc.empty())
      writeFile(folder.path() / "Path1.cnc", example.cnc);
    if (st.empty())
      st = "PROGRAM Main\nVAR\n  n : INT;\nEND_VAR\nn := n + 1;\nEND_PROGRAM\n";
  }
  writeFile(folder.path() / "Main.st", st);
  std::vector<std::string> arguments = {"check", isProject ? "." : "Main.st", "--format", "json",
                                        "-W",    "off=unused-variable"};
  if (isOff || code == "SE0390")
    arguments.insert(arguments.end(), {"-W", "warning=" + code});
  const ProcessResult result = stride(arguments, folder.path());
  Answer answer;
  answer.errors = result.exitCode != 0;
  answer.shown = st + example.toml + example.cam + example.cnc + "\n" + result.out + result.err;
  for (const std::string &line : splitLines(result.out)) {
    const auto json = nlohmann::json::parse(line);
    answer.codes.insert(json.at("code").get<std::string>());
  }
  return answer;
}

/// What no check of a file can show: missing files, commands that change programs, a broken tool
/// chain, an internal error, sizes that nobody wants to read.
bool needsNoExample(const std::string &code) {
  static const std::set<std::string> kCodes = {
      "SE0101", "SE0102", "SE0114", "SE0117", "SE0118", "SE0119", "SE0830", "SE0831",
      "SE0832", "SE0833", "SE0834", "SE0835", "SE0836", "SE0837", "SE0838", "SE0839",
      "SE0853", "SE0856", "SE0857", "SE0815", "SE0816", "SE0892", "SE0893", "SE0894",
      "SE0895", "SE0896", "SE0897", "SE0898", "SE0990", "SE0991"};
  return kCodes.contains(code);
}

class Explain : public ::testing::TestWithParam<char> {};

TEST_P(Explain, ExamplesAreWhatTheySay) {
  const ScratchDirectory here;
  for (const std::string &line : splitLines(stride({"explain", "--list"}, here.path()).out)) {
    const std::string code = line.substr(0, line.find(' '));
    if (code.size() != 6 || code[3] != GetParam() || needsNoExample(code))
      continue;
    const std::string text = stride({"explain", code}, here.path()).out;
    const bool isOff = text.find("severity: off") != std::string::npos;
    const Example wrong = exampleOf(text, "Wrong");
    const Example right = exampleOf(text, "Right");
    if (wrong.st.empty() && wrong.toml.empty() && wrong.cam.empty() && wrong.cnc.empty()) {
      ADD_FAILURE() << code << " has no wrong example";
      continue;
    }
    const Answer bad = check(wrong, code, isOff);
    EXPECT_TRUE(bad.codes.contains(code)) << code << ", wrong example:\n" << bad.shown;
    if (right.st.empty() && right.toml.empty() && right.cam.empty() && right.cnc.empty()) {
      ADD_FAILURE() << code << " has no right example";
      continue;
    }
    const Answer good = check(right, code, isOff);
    EXPECT_FALSE(good.errors || good.codes.contains(code)) << code << ", right example:\n"
                                                           << good.shown;
  }
}

INSTANTIATE_TEST_SUITE_P(Codes, Explain,
                         ::testing::Values('1', '2', '3', '4', '5', '6', '7', '8', '9'));

} // namespace
} // namespace stride::test
