#include "compiler/import/scl_reader.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/scl_constants.hpp"
#include "compiler/import/scl_text.hpp"
#include "compiler/import/scl_tokens.hpp"
#include "compiler/source/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include <fmt/format.h>

namespace stc::import {

namespace scl_blocks {
namespace {

struct BlockWord {
  std::string_view begin;
  std::string_view end;
  std::string_view st; ///< what it becomes
};

constexpr std::array<BlockWord, 5> kBlocks = {{
    {"FUNCTION_BLOCK", "END_FUNCTION_BLOCK", "FUNCTION_BLOCK"},
    {"FUNCTION", "END_FUNCTION", "FUNCTION"},
    {"ORGANIZATION_BLOCK", "END_ORGANIZATION_BLOCK", "PROGRAM"},
    {"DATA_BLOCK", "END_DATA_BLOCK", ""},
    {"TYPE", "END_TYPE", ""},
}};

constexpr std::array<std::string_view, 5> kSections = {"VAR", "VAR_INPUT", "VAR_OUTPUT",
                                                       "VAR_IN_OUT", "VAR_TEMP"};

/// Words of a block's head; the rest of their line belongs to them.
constexpr std::array<std::string_view, 10> kHeadWords = {
    "TITLE",      "VERSION",          "AUTHOR",   "FAMILY",   "NAME",
    "NON_RETAIN", "KNOW_HOW_PROTECT", "STANDARD", "UNLINKED", "READ_ONLY"};

bool isOneOf(const SclToken &token, std::span<const std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view each) { return isSclWord(token, each); });
}

bool isBlankText(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// Values that a data block's BEGIN part gives, by the names of its members in lower case.
using Initial = std::map<std::string, std::string>;

class Blocks {
public:
  Blocks(const std::string &file, std::string_view text, Model &model)
      : file_(file), tokens_(sclTokens(text)), model_(model) {}

  void read() {
    while (at_ < tokens_.size()) {
      const SclToken &token = tokens_[at_];
      const auto *block = std::ranges::find_if(
          kBlocks, [&](const BlockWord &each) { return isSclWord(token, each.begin); });
      if (block != kBlocks.end()) {
        take(*block);
      } else if (token.kind == SclKind::Comment) {
        before_ += std::string(token.text) + "\n";
        ++at_;
      } else {
        if (token.kind != SclKind::Blank && token.kind != SclKind::Attribute)
          stray(token);
        ++at_;
      }
    }
  }

private:
  void stray(const SclToken &token) {
    if (strayLine_ != token.line)
      model_.leftOut.push_back(
          {{file_, token.line}, fmt::format("`{}` …", token.text), "it belongs to no block"});
    strayLine_ = token.line;
  }

  void take(const BlockWord &block) {
    const size_t begin = at_;
    SclText text(file_, tokens_, at_ + 1, model_);
    text.setObject(std::string(block.begin));
    const std::string name = text.takeName();
    text.setObject(fmt::format("{} {}", block.begin, name));
    const size_t end = name.empty() ? begin : endOf(block, begin);
    const std::string object = fmt::format("{} {}", block.begin, name);
    if (name.empty())
      leaveOut(begin, object, "it has no name");
    else if (end == tokens_.size())
      leaveOut(begin, object, fmt::format("the file ends before {}; export it again", block.end));
    else if (text.setLimit(end + 1); !takeBlock(block, name, begin, end, text))
      leaveOut(begin, object, fmt::format("its declarations do not end before {}", block.end));
    at_ = end + 1;
    before_.clear();
  }

  void leaveOut(size_t token, std::string object, std::string why) {
    model_.leftOut.push_back({{file_, tokens_[token].line}, std::move(object), std::move(why)});
  }

  bool takeBlock(const BlockWord &block, const std::string &name, size_t begin, size_t end,
                 SclText &text) {
    if (block.begin == "TYPE")
      return takeType(name, begin, text);
    if (block.begin == "DATA_BLOCK")
      return takeData(name, begin, end, text);
    return takeCode(block, name, begin, text);
  }

  [[nodiscard]] size_t endOf(const BlockWord &block, size_t from) const {
    while (from < tokens_.size() && !isSclWord(tokens_[from], block.end))
      ++from;
    return from;
  }

  void add(ObjectKind kind, const std::string &name, size_t begin, const SclText &text,
           std::string source) {
    source = before_ + text.hoisted() + source;
    if (source.back() != '\n')
      source += '\n';
    model_.objects.push_back({kind, name, {}, std::move(source), {file_, tokens_[begin].line}});
  }

  /// Title, version and the like, as comments. `retain`: whether the block keeps its values.
  static std::string head(SclText &text) {
    std::string out;
    while (!text.atEnd()) {
      const SclToken &token = text.now();
      const bool word = isOneOf(token, kHeadWords);
      if (!word && token.kind != SclKind::Blank && token.kind != SclKind::Comment &&
          token.kind != SclKind::Attribute)
        break;
      if (!word) {
        out += token.kind == SclKind::Comment ? text.plain(token) : std::string();
        out += token.kind == SclKind::Blank && token.text.find('\n') != std::string_view::npos &&
                       !out.empty() && out.back() != '\n'
                   ? "\n"
                   : "";
        text.skip();
        continue;
      }
      out += "// ";
      for (; !text.atEnd() && text.now().text.find('\n') == std::string_view::npos; text.skip())
        out += text.now().text;
      out += '\n';
    }
    if (!out.empty() && out.back() != '\n')
      out += '\n';
    return out;
  }

  bool takeType(const std::string &name, size_t begin, SclText &text) {
    std::string out = fmt::format("TYPE {} :\n", name);
    std::string comments = head(text);
    if (!text.atEnd() && text.now().text == ":")
      text.skip();
    comments += head(text);
    if (!text.isNow("STRUCT")) {
      text.leaveOut(tokens_[begin].line, "it is no structure");
      return skipTo("END_TYPE", text);
    }
    text.skip();
    std::string members;
    text.members(members, name, "END_STRUCT", {});
    out += "STRUCT" + members + "END_STRUCT\nEND_TYPE\n";
    if (!skipTo("END_TYPE", text))
      return false;
    add(ObjectKind::Type, name, begin, text, comments + out);
    return true;
  }

  static bool skipTo(std::string_view word, SclText &text) {
    while (!text.atEnd() && !text.isNow(word))
      text.skip();
    if (text.atEnd())
      return false;
    text.skip();
    return true;
  }

  // ---------------------------------------------------------------------------------------------
  // data blocks

  /// Assignments between BEGIN and the end.
  Initial initialOf(size_t from, size_t end) {
    Initial initial;
    while (from < end && !isSclWord(tokens_[from], "BEGIN"))
      ++from;
    SclText text(file_, tokens_, std::min(from + 1, end), model_);
    text.setLimit(end);
    while (text.at() < end) {
      std::string passed;
      text.pass(passed);
      if (text.at() >= end)
        break;
      std::string path;
      for (; text.at() < end && text.now().text != ":=" && text.now().text != ";"; text.skip())
        path += text.plain(text.now());
      const bool assigned = text.at() < end && text.now().text == ":=";
      const bool more = text.at() < end;
      if (more)
        text.skip();
      if (assigned)
        initial.emplace(stride::common::lowerCase(trimmed(path)), text.value());
    }
    return initial;
  }

  void reportUnused(const Initial &initial, size_t line, SclText &text) {
    for (const auto &[path, value] : initial)
      text.leaveOut(line, fmt::format("the initial value `{} := {}` is not a variable's alone: "
                                      "write it into the declaration",
                                      path, value));
  }

  bool takeData(const std::string &name, size_t begin, size_t end, SclText &text) {
    Initial initial = initialOf(begin, end);
    const std::string comments = head(text);
    const size_t line = tokens_[begin].line;
    std::string out;
    if (text.isNow("STRUCT") || text.isNow("VAR")) {
      out = takeVariables(name, end, text, initial);
    } else {
      const std::string type = text.takeName();
      std::string values;
      for (auto each = initial.begin(); each != initial.end();) {
        if (each->first.find_first_of(".[") != std::string::npos) {
          ++each;
          continue;
        }
        values += fmt::format("{}{} := {}", values.empty() ? "" : ", ", each->first, each->second);
        each = initial.erase(each);
      }
      out = fmt::format("VAR_GLOBAL\n  {} : {}{};\nEND_VAR\n", name, type,
                        values.empty() ? "" : fmt::format(" := ({})", values));
    }
    reportUnused(initial, line, text);
    if (!skipTo("END_DATA_BLOCK", text))
      return false;
    add(ObjectKind::GlobalList, name, begin, text, comments + out);
    return true;
  }

  /// Variables of a block are those of a list of this name: `"Block".x` stays `Block.x`.
  static std::string takeVariables(const std::string &name, size_t end, SclText &text,
                                   Initial &initial) {
    std::string out;
    while (text.at() < end && (text.isNow("STRUCT") || text.isNow("VAR"))) {
      const bool structure = text.isNow("STRUCT");
      text.skip();
      std::string qualifier;
      std::string passed;
      text.pass(passed);
      if (!structure && (text.isNow("RETAIN") || text.isNow("NON_RETAIN"))) {
        qualifier = text.isNow("RETAIN") ? " RETAIN" : "";
        text.skip();
      }
      std::string members;
      text.members(members, name, structure ? "END_STRUCT" : "END_VAR", {&initial, false});
      out += fmt::format("{{attribute 'qualified_only'}}\nVAR_GLOBAL{}{}{}END_VAR\n", qualifier,
                         passed.empty() ? "\n" : passed, members);
      std::string between;
      text.pass(between);
      if (!text.atEnd() && text.now().text == ";")
        text.skip();
      text.pass(between);
    }
    return out;
  }

  // ---------------------------------------------------------------------------------------------
  // code blocks

  bool takeCode(const BlockWord &block, const std::string &name, size_t begin, SclText &text) {
    std::string out = fmt::format("{} {}", block.st, name);
    std::string returned;
    std::string passed;
    text.pass(passed);
    if (!text.atEnd() && text.now().text == ":") {
      text.skip();
      returned = text.takeName();
      if (stride::common::lowerCase(returned) != "void")
        out += " : " + returned;
    }
    out += '\n';
    const std::string comments = head(text);
    sections(name, text, out);
    if (text.isNow("BEGIN"))
      text.skip();
    std::string body;
    if (!text.statements(body, block.end))
      return false;
    const std::string own = text.ownSections() + text.viewStatements();
    if (!own.empty() && out.back() != '\n')
      out += '\n';
    out += own + body;
    if (out.back() != '\n')
      out += '\n';
    out += fmt::format("END_{}\n", block.st);
    add(ObjectKind::Pou, name, begin, text, comments + out);
    if (block.st == "PROGRAM")
      addTask(name, tokens_[begin].line, text);
    return true;
  }

  void sections(const std::string &name, SclText &text, std::string &out) {
    for (;;) {
      text.pass(out);
      if (text.atEnd())
        return;
      const SclToken &token = text.now();
      if (isSclWord(token, "LABEL")) {
        skipTo("END_LABEL", text);
        if (!text.atEnd() && text.now().text == ";")
          text.skip();
      } else if (isSclWord(token, "CONST")) {
        constants(text, out);
      } else if (isOneOf(token, kSections)) {
        section(name, text, out);
      } else {
        return;
      }
    }
  }

  /// `name := value;` of a CONST section: the value says the type.
  static void constants(SclText &text, std::string &out) {
    text.skip();
    out += "VAR CONSTANT";
    for (text.pass(out); !text.atEnd() && !text.isNow("END_CONST"); text.pass(out)) {
      const size_t line = text.now().line;
      const std::string name = text.takeName();
      std::string passed;
      text.pass(passed);
      if (!isBlankText(passed))
        out += passed;
      const bool assigned = !text.atEnd() && text.now().text == ":=";
      if (assigned)
        text.skip();
      const std::string value(trimmed(text.value()));
      const std::string_view type = sclConstantType(value);
      if (name.empty() || !assigned || type.empty())
        text.leaveOut(line, fmt::format("the constant `{} := {}` is no plain value: declare it in "
                                        "VAR CONSTANT",
                                        name, value));
      else
        out += fmt::format("{} : {} := {};", name, type, value);
    }
    out += "END_VAR";
    if (!text.atEnd())
      text.skip();
  }

  static void section(const std::string &name, SclText &text, std::string &out) {
    const bool inOut = text.isNow("VAR_IN_OUT");
    out += text.now().text;
    text.skip();
    std::string passed;
    text.pass(passed);
    if (text.isNow("RETAIN") || text.isNow("CONSTANT")) {
      out += fmt::format(" {}", text.now().text);
      text.skip();
    } else if (text.isNow("DB_SPECIFIC") || text.isNow("NON_RETAIN")) {
      text.skip();
    }
    if (isBlankText(passed) && passed.find('\n') == std::string::npos)
      passed.clear(); // between VAR and its qualifier
    out += passed;
    text.members(out, name, "END_VAR", {nullptr, inOut, true});
    out += "END_VAR";
  }

  /// OB1, which TIA calls Main, runs all the time. When others run, their source does not say.
  void addTask(const std::string &name, size_t line, SclText &text) {
    const std::string lower = stride::common::lowerCase(name);
    if (lower != "ob1" && lower != "main")
      return text.leaveOut(line, "no task calls it: its source does not say what starts it");
    Task task;
    task.name = name == "OB1" ? "Main" : "OB1";
    task.programs = {name};
    task.origin = {file_, line};
    model_.tasks.push_back(std::move(task));
  }

  const std::string &file_;
  const std::vector<SclToken> tokens_;
  Model &model_;
  size_t at_ = 0;
  std::string before_; ///< comments between blocks
  size_t strayLine_ = 0;
};

/// DTL is a structure that S7-1200 and S7-1500 bring along.
void addDateType(const std::string &file, std::string_view text, Model &model) {
  const std::vector<SclToken> tokens = sclTokens(text);
  const auto used = std::ranges::find_if(tokens, [](const SclToken &each) {
    return isSclWord(each, "DTL") || (each.kind == SclKind::Literal &&
                                      stride::common::lowerCase(each.text).starts_with("dtl#"));
  });
  const bool known = std::ranges::any_of(model.objects, [](const Object &each) {
    return stride::common::upperCase(each.name) == "DTL";
  });
  if (used == tokens.end() || known)
    return;
  model.objects.push_back({ObjectKind::Type,
                           "DTL",
                           {},
                           "TYPE DTL :\nSTRUCT\n  YEAR : UINT := 1970;\n  MONTH : USINT := 1;\n"
                           "  DAY : USINT := 1;\n  WEEKDAY : USINT := 5;\n  HOUR : USINT;\n"
                           "  MINUTE : USINT;\n  SECOND : USINT;\n  NANOSECOND : UDINT;\n"
                           "END_STRUCT\nEND_TYPE\n",
                           {file, used->line}});
  model.changed.push_back({{file, used->line}, "DTL", "became a structure of the project"});
}

} // namespace
} // namespace scl_blocks

bool isScl(std::string_view text) {
  constexpr std::array<std::string_view, 4> kSigns = {"S7_Optimized_Access", "ORGANIZATION_BLOCK",
                                                      "DATA_BLOCK", "S7_SetPoint"};
  if (text.find("<?xml") != std::string_view::npos)
    return false;
  return std::ranges::any_of(
      kSigns, [&](std::string_view sign) { return text.find(sign) != std::string_view::npos; });
}

void readScl(const std::string &file, std::string_view text, Model &model) {
  scl_blocks::Blocks(file, text, model).read();
  scl_blocks::addDateType(file, text, model);
}

} // namespace stc::import
