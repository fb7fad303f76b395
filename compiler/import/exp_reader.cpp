#include "compiler/import/exp_reader.hpp"

#include "compiler/import/exp_lines.hpp"

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

/// First lines of bodies that are drawn, not written.
constexpr std::array<std::string_view, 3> kDrawnBodies = {"_LD_BODY", "_FBD_BODY", "_CFC_BODY"};

class Reader {
public:
  Reader(const std::string &file, std::string_view text, Model &model)
      : file(file), lines(linesOf(text)), model(model) {}

  void read() {
    while (at < lines.size())
      if (!readAttribute() && !readSection())
        skipLine();
  }

private:
  [[nodiscard]] Origin originOf(size_t line) const { return {file, line + 1}; }

  void leaveOut(size_t line, std::string object, std::string why) {
    model.leftOut.push_back({originOf(line), std::move(object), std::move(why)});
  }

  /// `(* @KEY := 'value' *)`, over several lines for a few keys.
  bool readAttribute() {
    const std::string_view text = trimmed(lines[at]);
    if (!text.starts_with("(* @"))
      return false;
    const size_t end = text.find_first_of(" :", 4);
    const std::string key(text.substr(4, end == std::string_view::npos ? end : end - 4));
    attributes[key] = quoted(text);
    while (at < lines.size() && lines[at].find("*)") == std::string_view::npos)
      ++at;
    ++at;
    return true;
  }

  bool readSection() {
    const std::string_view word = firstWord(lines[at]);
    for (const SectionWord &each : kSections)
      if (word == each.begin)
        return take(each.section, each.end), true;
    if (word.size() > 1 && word.front() == '_')
      return take(Section::LeftOut, fmt::format("_END{}", word)), true;
    return false;
  }

  /// A line between the objects; only comments and pragmas may stand there.
  void skipLine() {
    const std::string_view text = trimmed(lines[at]);
    CommentState state{attributes["NESTEDCOMMENTS"] != "No"};
    if (text.starts_with("(*")) {
      model.changed.push_back({originOf(at), "comment", "dropped: it stands between objects"});
      do
        (void)state.line(lines[at++]);
      while (state.inside() && at < lines.size());
      return;
    }
    if (!text.empty() && text.front() != '{') {
      if (!strayEnd || *strayEnd != at)
        leaveOut(at, fmt::format("from line `{}` on", text), "lines that belong to no section");
      strayEnd = at + 1;
    }
    ++at;
  }

  void take(Section section, std::string_view endWord) {
    const size_t begin = at;
    const std::string object(trimmed(lines[begin]));
    CommentState comments{attributes["NESTEDCOMMENTS"] != "No"};
    const bool source = section != Section::LeftOut && section != Section::Library;
    std::vector<std::string> content;
    for (; at < lines.size(); ++at) {
      const bool code = !source || !comments.inside();
      content.push_back(source ? comments.line(lines[at]) : std::string(lines[at]));
      if (code && firstWord(lines[at]) == endWord)
        break;
    }
    if (at == lines.size()) {
      leaveOut(begin, object, fmt::format("the file ends before {}; export it again", endWord));
      return;
    }
    ++at;
    if (firstWord(content.front()) == kOldFunctionBlock) {
      content.front().insert(content.front().find(kOldFunctionBlock) + 8, "_");
      model.changed.push_back({originOf(begin), object, "FUNCTIONBLOCK became FUNCTION_BLOCK"});
    }
    if (comments.changes() != 0)
      model.changed.push_back({originOf(begin), object,
                               fmt::format("{} `(*` inside comments became `( *`: comments are not "
                                           "nested in this object",
                                           comments.changes())});
    finish(section, begin, object, content);
    if (section != Section::Globals)
      attributes.clear();
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
    model.objects.push_back(
        {kind, std::move(name), foldersOf(attributes["PATH"]), std::move(text), originOf(begin)});
  }

  /// The text without the attributes inside it. A drawn body becomes an error of the compiler.
  std::string sourceOf(size_t begin, const std::string &object,
                       const std::vector<std::string> &content) {
    std::string text;
    std::string_view drawn;
    for (size_t i = 0; i < content.size(); ++i) {
      const std::string_view line = trimmed(content[i]);
      if (line.starts_with("(* @") && line.ends_with("*)") &&
          line.find(":=") != std::string_view::npos)
        continue;
      for (const std::string_view body : kDrawnBodies)
        if (drawn.empty() && line == body) {
          drawn = body;
          leaveOut(begin + i, object, fmt::format("its body is drawn ({})", body));
          text += fmt::format("{{error 'body not imported: {}'}}\n", body);
        }
      if (drawn.empty() || i + 1 == content.size())
        text += content[i] + "\n";
    }
    return text;
  }

  void addPou(size_t begin, const std::string &object, const std::vector<std::string> &content) {
    add(ObjectKind::Pou, begin, declaredName(content), sourceOf(begin, object, content));
    lastPou = model.objects.size() - 1;
  }

  /// Actions stand after the POU that they belong to; ours stand before its last line.
  void addAction(size_t begin, const std::string &object, const std::vector<std::string> &content) {
    if (!lastPou)
      return leaveOut(begin, object, "no POU stands before this action");
    std::string &pou = model.objects[*lastPou].text;
    const size_t lastLine = pou.rfind('\n', pou.size() - 2);
    pou.insert(lastLine == std::string::npos ? 0 : lastLine + 1,
               "\n" + sourceOf(begin, object, content));
  }

  /// Blocks of one list have one attribute @GLOBAL_VARIABLE_LIST before the first of them.
  void addGlobals(size_t begin, const std::vector<std::string> &content) {
    std::string name = attributes["GLOBAL_VARIABLE_LIST"];
    if (name.empty())
      name = "Global_Variables";
    for (Object &each : model.objects)
      if (each.kind == ObjectKind::GlobalList && each.name == name && each.origin.file == file) {
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
        model.tasks.push_back(taskOf(line));
        model.tasks.back().origin = originOf(begin + i);
        inTask = true;
      } else if (word == "END_TASK") {
        inTask = false;
      } else if (inTask && line.ends_with("();")) {
        model.tasks.back().programs.emplace_back(trimmed(line.substr(0, line.size() - 3)));
      } else if (line.find("'handler'") != std::string_view::npos) {
        leaveOut(begin + i, "system event", "handlers of system events are not imported");
      } else if (inTask && !line.empty() && line.front() != '{') {
        leaveOut(begin + i, fmt::format("line `{}`", line), "it is no call of a program");
      }
    }
  }

  const std::string &file;
  const std::vector<std::string_view> lines;
  Model &model;
  size_t at = 0;
  std::map<std::string, std::string> attributes; ///< of the object that comes next
  std::optional<size_t> lastPou;
  std::optional<size_t> strayEnd; ///< the line after the last one that belongs to no section
};

} // namespace

void readExp(const std::string &file, std::string_view text, Model &model) {
  Reader(file, text, model).read();
}

} // namespace stc::import
