#include "compiler/import/exp_reader.hpp"

#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/networks/exp_networks.hpp"

#include <array>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace stc::import {

namespace {

enum class Section { Pou, Action, Type, Globals, Resource, Library, LeftOut };

struct SectionWord {
  std::string_view begin;
  std::string_view end;
  Section section;
};

constexpr std::string_view kOldFunctionBlock = "FUNCTIONBLOCK";

constexpr std::array<SectionWord, 12> kSections = {{
    {"FUNCTION_BLOCK", "END_FUNCTION_BLOCK", Section::Pou},
    {kOldFunctionBlock, "END_FUNCTION_BLOCK", Section::Pou},
    {"FUNCTION", "END_FUNCTION", Section::Pou},
    {"PROGRAM", "END_PROGRAM", Section::Pou},
    {"ACTION", "END_ACTION", Section::Action},
    {"TYPE", "END_TYPE", Section::Type},
    {"VAR_GLOBAL", "END_VAR", Section::Globals},
    {"VAR_CONFIG", "END_VAR", Section::LeftOut},
    {"RESOURCE", "END_RESOURCE", Section::Resource},
    {"LIBRARY", "END_LIBRARY", Section::Library},
    {"PLC_CONFIGURATION", "PLC_END", Section::LeftOut},
    {"VISUALISATION", "END_VISUALISATION", Section::LeftOut},
}};

class Reader {
public:
  Reader(const std::string &file, std::string_view text, Model &model)
      : file_(file), lines_(linesOf(text)), model_(model) {}

  void read() {
    while (at_ < lines_.size())
      if (!readAttribute() && !readSection())
        skipLine();
  }

private:
  [[nodiscard]] Origin originOf(size_t line) const { return {file_, line + 1}; }

  void leaveOut(size_t line, std::string object, std::string why) {
    model_.leftOut.push_back({originOf(line), std::move(object), std::move(why)});
  }

  /// `(* @KEY := 'value' *)`, over several lines for a few keys.
  bool readAttribute() {
    const std::string_view text = trimmed(lines_[at_]);
    if (!text.starts_with("(* @"))
      return false;
    const size_t end = text.find_first_of(" :", 4);
    const std::string key(text.substr(4, end == std::string_view::npos ? end : end - 4));
    attributes_[key] = quoted(text);
    while (at_ < lines_.size() && lines_[at_].find("*)") == std::string_view::npos)
      ++at_;
    ++at_;
    return true;
  }

  bool readSection() {
    const std::string_view word = firstWord(lines_[at_]);
    for (const SectionWord &each : kSections)
      if (word == each.begin)
        return take(each.section, each.end), true;
    if (word.size() > 1 && word.front() == '_')
      return take(Section::LeftOut, fmt::format("_END{}", word)), true;
    return false;
  }

  /// A line between the objects; only comments and pragmas may stand there.
  void skipLine() {
    const std::string_view text = trimmed(lines_[at_]);
    CommentState state{attributes_["NESTEDCOMMENTS"] != "No"};
    if (text.starts_with("(*")) {
      model_.changed.push_back({originOf(at_), "comment", "dropped: it stands between objects"});
      do
        (void)state.line(lines_[at_++]);
      while (state.inside() && at_ < lines_.size());
      return;
    }
    if (!text.empty() && text.front() != '{') {
      if (!strayEnd_ || *strayEnd_ != at_)
        leaveOut(at_, fmt::format("from line `{}` on", text), "lines that belong to no section");
      strayEnd_ = at_ + 1;
    }
    ++at_;
  }

  void take(Section section, std::string_view endWord) {
    const size_t begin = at_;
    const std::string object(trimmed(lines_[begin]));
    CommentState comments{attributes_["NESTEDCOMMENTS"] != "No"};
    const bool source = section != Section::LeftOut && section != Section::Library;
    std::vector<std::string> content;
    for (; at_ < lines_.size(); ++at_) {
      const bool code = !source || !comments.inside();
      content.push_back(source ? comments.line(lines_[at_]) : std::string(lines_[at_]));
      if (code && firstWord(lines_[at_]) == endWord)
        break;
    }
    if (at_ == lines_.size()) {
      leaveOut(begin, object, fmt::format("the file ends before {}; export it again", endWord));
      return;
    }
    ++at_;
    if (firstWord(content.front()) == kOldFunctionBlock) {
      content.front().insert(content.front().find(kOldFunctionBlock) + 8, "_");
      model_.changed.push_back({originOf(begin), object, "FUNCTIONBLOCK became FUNCTION_BLOCK"});
    }
    if (comments.changes() != 0)
      model_.changed.push_back(
          {originOf(begin), object,
           fmt::format("{} `(*` inside comments became `( *`: comments are not "
                       "nested in this object",
                       comments.changes())});
    finish(section, begin, object, content);
    if (section != Section::Globals)
      attributes_.clear();
  }

  void finish(Section section, size_t begin, const std::string &object,
              const std::vector<std::string> &content) {
    switch (section) {
    case Section::Pou:
      return addPou(begin, object, content);
    case Section::Action:
      return addAction(begin, object, content);
    case Section::Type:
      return add(ObjectKind::Type, begin, declaredName(content), joined(content));
    case Section::Globals:
      return addGlobals(begin, content);
    case Section::Resource:
      return addTasks(begin, content);
    case Section::Library:
      return leaveOut(begin, object, "a library's blocks are not in an export");
    case Section::LeftOut:
      return leaveOut(begin, object,
                      fmt::format("{} lines of a section that is not imported", content.size()));
    }
  }

  void add(ObjectKind kind, size_t begin, std::string name, std::string text) {
    model_.objects.push_back(
        {kind, std::move(name), foldersOf(attributes_["PATH"]), std::move(text), originOf(begin)});
  }

  /// The text without the attributes inside it.
  std::string sourceOf(size_t begin, const std::string &object,
                       const std::vector<std::string> &content) {
    std::string text;
    for (size_t i = 0; i < content.size(); ++i) {
      const std::string_view line = trimmed(content[i]);
      if (line.starts_with("(* @") && line.ends_with("*)") &&
          line.find(":=") != std::string_view::npos)
        continue;
      if (networks::beginsDrawnBody(line)) {
        const std::vector<std::string> body(content.begin() + static_cast<ptrdiff_t>(i),
                                            content.end() - 1);
        return text + drawnBody(begin + i, object, body) + content.back() + "\n";
      }
      text += content[i] + "\n";
    }
    return text;
  }

  /// The mark for a body that is drawn; `body` begins with `_LD_BODY` or the like.
  std::string drawnBody(size_t begin, const std::string &object,
                        const std::vector<std::string> &body) {
    std::vector<networks::NumberedLine> lines;
    for (size_t i = 0; i < body.size(); ++i)
      lines.push_back({body[i], begin + i + 1});
    std::string_view kind = trimmed(body.front());
    kind = kind.substr(1, kind.find("_BODY") - 1);
    return markDrawnBody(
        model_, originOf(begin), object, std::string(kind),
        [lines = std::move(lines)](const networks::Scope &scope) {
          return networks::translatedExpBody(lines, scope);
        });
  }

  void addPou(size_t begin, const std::string &object, const std::vector<std::string> &content) {
    add(ObjectKind::Pou, begin, declaredName(content), sourceOf(begin, object, content));
    lastPou_ = model_.objects.size() - 1;
  }

  /// Actions stand after the POU that they belong to; ours stand before its last line.
  void addAction(size_t begin, const std::string &object, const std::vector<std::string> &content) {
    if (!lastPou_)
      return leaveOut(begin, object, "no POU stands before this action");
    std::string &pou = model_.objects[*lastPou_].text;
    const size_t lastLine = pou.rfind('\n', pou.size() - 2);
    pou.insert(lastLine == std::string::npos ? 0 : lastLine + 1,
               "\n" + sourceOf(begin, object, content));
  }

  /// Blocks of one list have one attribute @GLOBAL_VARIABLE_LIST before the first of them.
  void addGlobals(size_t begin, const std::vector<std::string> &content) {
    std::string name = attributes_["GLOBAL_VARIABLE_LIST"];
    if (name.empty())
      name = "Global_Variables";
    for (Object &each : model_.objects)
      if (each.kind == ObjectKind::GlobalList && each.name == name && each.origin.file == file_) {
        each.text += "\n" + joined(content);
        return;
      }
    add(ObjectKind::GlobalList, begin, name, joined(content));
  }

  void addTasks(size_t begin, const std::vector<std::string> &content) {
    bool inTask = false;
    for (size_t i = 0; i < content.size(); ++i) {
      const std::string_view line = trimmed(content[i]);
      const std::string_view word = firstWord(line);
      if (word == "TASK") {
        model_.tasks.push_back(taskOf(line));
        model_.tasks.back().origin = originOf(begin + i);
        inTask = true;
      } else if (word == "END_TASK") {
        inTask = false;
      } else if (inTask && line.ends_with("();")) {
        model_.tasks.back().programs.emplace_back(trimmed(line.substr(0, line.size() - 3)));
      } else if (line.find("'handler'") != std::string_view::npos) {
        leaveOut(begin + i, "system event", "handlers of system events are not imported");
      } else if (inTask && !line.empty() && line.front() != '{') {
        leaveOut(begin + i, fmt::format("line `{}`", line), "it is no call of a program");
      }
    }
  }

  const std::string &file_;
  const std::vector<std::string_view> lines_;
  Model &model_;
  size_t at_ = 0;
  std::map<std::string, std::string> attributes_; ///< of the object that comes next
  std::optional<size_t> lastPou_;
  std::optional<size_t> strayEnd_; ///< the line after the last one that belongs to no section
};

} // namespace

void readExp(const std::string &file, std::string_view text, Model &model) {
  Reader(file, text, model).read();
}

} // namespace stc::import
