#include "compiler/import/exp_reader.hpp"

#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/exp_tasks.hpp"
#include "compiler/import/networks/exp_networks.hpp"
#include "compiler/import/plc_configuration.hpp"
#include "compiler/import/st_words.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace stc::import {

namespace {

enum class Section {
  Pou,
  Action,
  Type,
  Globals,
  Config,   ///< VAR_CONFIG
  Resource, ///< tasks
  Library,  ///< a reference
  Hardware, ///< PLC_CONFIGURATION
  Picture,  ///< visualizations
  Settings, ///< of the other tool's windows
  Unknown   ///< its text is kept
};

struct SectionWord {
  std::string_view begin;
  std::string_view end;
  Section section;
};

constexpr std::string_view kOldFunctionBlock = "FUNCTIONBLOCK";

constexpr std::array<SectionWord, 13> kSections = {{
    {"FUNCTION_BLOCK", "END_FUNCTION_BLOCK", Section::Pou},
    {kOldFunctionBlock, "END_FUNCTION_BLOCK", Section::Pou},
    {"FUNCTION", "END_FUNCTION", Section::Pou},
    {"PROGRAM", "END_PROGRAM", Section::Pou},
    {"ACTION", "END_ACTION", Section::Action},
    {"TYPE", "END_TYPE", Section::Type},
    {"VAR_GLOBAL", "END_VAR", Section::Globals},
    {"VAR_CONFIG", "END_VAR", Section::Config},
    {"RESOURCE", "END_RESOURCE", Section::Resource},
    {"LIBRARY", "END_LIBRARY", Section::Library},
    {"PLC_CONFIGURATION", "PLC_END", Section::Hardware},
    {"VISUALISATION", "END_VISUALISATION", Section::Picture},
    {"_WORKSPACE", "_END_WORKSPACE", Section::Settings},
}};

/// Keys of `(* @KEY := … *)` that say nothing which Stride needs.
constexpr std::array<std::string_view, 6> kSilentKeys = {"OBJECTFLAGS",     "SYMFILEFLAGS",
                                                         "END_DECLARATION", "OBJECT_END",
                                                         "CONNECTIONS",     "LIBRARYSYMFILEINFO"};
/// And those that are used.
constexpr std::array<std::string_view, 3> kUsedKeys = {"NESTEDCOMMENTS", "PATH",
                                                       "GLOBAL_VARIABLE_LIST"};

/// Whether a line begins a body that is drawn: `_LD_BODY`, `_FBD_BODY`, `_CFC_BODY`, or others that
/// nobody has documented.
bool beginsDrawnBody(std::string_view line) {
  return line.starts_with('_') && line.ends_with("_BODY") && firstWord(line) == line &&
         !line.starts_with("_END_") && line != "_IL_BODY";
}

class Reader {
public:
  Reader(const std::string &file, std::string_view text, Model &model)
      : file_(file), lines_(linesOf(text)), model_(model) {
    for (size_t i = 0; i < lines_.size(); ++i) {
      if (const std::string_view word = firstWord(lines_[i]); word.starts_with("_END"))
        ends_[word] = i;
      if (lines_[i].find("*)") != std::string_view::npos)
        commentsEnd_ = i + 1;
    }
  }

  void read() {
    while (at_ < lines_.size())
      if (!readAttribute() && !readSection())
        skipLine();
    keepLastComment();
  }

private:
  [[nodiscard]] Origin originOf(size_t line) const { return {file_, line + 1}; }

  void leaveOut(size_t line, std::string object, std::string why) {
    model_.leftOut.push_back({originOf(line), std::move(object), std::move(why)});
  }

  /// The key of `(* @KEY := …`; empty: the line is something else.
  static std::string_view keyOf(std::string_view line) {
    line = trimmed(line);
    if (!line.starts_with("(* @"))
      return {};
    line.remove_prefix(4);
    const std::string_view key = firstWord(line);
    return trimmed(line.substr(std::min(key.size(), line.size()))).starts_with(":=")
               ? key
               : std::string_view();
  }

  static bool isKnown(std::string_view key) {
    return std::find(kSilentKeys.begin(), kSilentKeys.end(), key) != kSilentKeys.end() ||
           std::find(kUsedKeys.begin(), kUsedKeys.end(), key) != kUsedKeys.end();
  }

  /// `(* @KEY := 'value' *)`, over several lines for a few keys.
  bool readAttribute() {
    const std::string_view key = keyOf(lines_[at_]);
    if (key.empty())
      return false;
    if (key == "OBJECT_END")
      attributes_.clear();
    if (!isKnown(key))
      model_.changed.push_back({originOf(at_), fmt::format("attribute @{}", key),
                                "dropped: what it means is not known"});
    attributes_[std::string(key)] = quoted(lines_[at_]);
    if (at_ >= commentsEnd_)
      leaveOut(at_, fmt::format("attribute @{}", key),
               "the file ends before its `*)`; only its first line is taken for it");
    else
      while (lines_[at_].find("*)") == std::string_view::npos)
        ++at_;
    ++at_;
    return true;
  }

  bool readSection() {
    const std::string_view word = firstWord(lines_[at_]);
    for (const SectionWord &each : kSections)
      if (word == each.begin)
        return take(each.section, each.end), true;
    if (word.size() > 1 && word.front() == '_' && endsLater(word))
      return take(Section::Unknown, fmt::format("_END{}", word)), true;
    return false;
  }

  /// Whether an end of the section comes; if not, the line is none, and takes nothing with it.
  bool endsLater(std::string_view word) {
    const auto end = ends_.find(std::string_view(fmt::format("_END{}", word)));
    return end != ends_.end() && end->second > at_;
  }

  /// A line between the objects; only comments and pragmas may stand there.
  void skipLine() {
    const std::string_view text = trimmed(lines_[at_]);
    CommentState state{attributes_["NESTEDCOMMENTS"] != "No"};
    if (text.starts_with("(*")) {
      if (comment_.empty())
        commentBegin_ = at_;
      do
        comment_ += state.line(lines_[at_++]) + "\n";
      while (state.inside() && at_ < lines_.size());
      if (state.inside())
        comment_ += "*)\n"; // the file ends in it
      return;
    }
    if (!text.empty() && text.front() != '{') {
      if (!strayEnd_ || *strayEnd_ != at_)
        leaveOut(at_, fmt::format("from line `{}` on", text), "lines that belong to no section");
      strayEnd_ = at_ + 1;
    }
    ++at_;
  }

  /// Comments after the last object belong to it.
  void keepLastComment() {
    if (comment_.empty())
      return;
    if (!model_.objects.empty() && model_.objects.back().origin.file == file_) {
      model_.objects.back().text += comment_;
      return;
    }
    model_.kept.push_back({keptName("comments"), comment_});
    model_.changed.push_back(
        {originOf(commentBegin_), "comment", "kept in import/kept: no object comes after it"});
  }

  [[nodiscard]] std::string keptName(std::string_view section) const {
    const size_t slash = file_.find_last_of('/');
    return fmt::format("{}_{}", file_.substr(slash == std::string::npos ? 0 : slash + 1), section);
  }

  void take(Section section, const std::string_view endWord) {
    const size_t begin = at_;
    const std::string object = objectOf(lines_[begin]);
    CommentState comments{attributes_["NESTEDCOMMENTS"] != "No"};
    const bool source = section <= Section::Resource;
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

  /// `PROGRAM Pump`: kind and name.
  static std::string objectOf(std::string_view line) {
    const std::string_view kind = firstWord(line);
    const std::string_view rest = trimmed(line).substr(kind.size());
    const std::string_view name = firstWord(rest);
    return name.empty() ? std::string(kind) : fmt::format("{} {}", kind, name);
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
      return addGlobals(begin, content, "Global_Variables");
    case Section::Config:
      return addConfig(begin, content);
    case Section::Resource:
      return readExpTasks(content, originOf(begin), model_);
    case Section::Library:
      return addLibrary(begin, content);
    case Section::Hardware:
      return addHardware(begin, object, content);
    case Section::Picture:
      return leaveOut(begin, object, "visualizations are not imported");
    case Section::Settings:
      return;
    case Section::Unknown:
      return keep(begin, object, content);
    }
  }

  void add(ObjectKind kind, size_t begin, std::string name, const std::string &text) {
    model_.objects.push_back({kind, std::move(name), foldersOf(attributes_["PATH"]),
                              std::exchange(comment_, {}) + text, originOf(begin)});
  }

  /// The text without the attributes inside it.
  std::string sourceOf(size_t begin, const std::string &object,
                       const std::vector<std::string> &content) {
    std::string text;
    for (size_t i = 0; i < content.size(); ++i) {
      const std::string_view line = trimmed(content[i]);
      if (beginsDrawnBody(line)) {
        const std::vector<std::string> body(content.begin() + static_cast<ptrdiff_t>(i),
                                            content.end() - 1);
        return text + drawnBody(begin + i, object, body) + content.back() + "\n";
      }
      // The compiler sees by itself what instructions are.
      if (line != "_IL_BODY" && !isKnown(keyOf(content[i])))
        text += content[i] + "\n";
    }
    return text;
  }

  /// The mark for a body that is drawn; `body` begins with `_LD_BODY` or the like.
  std::string drawnBody(size_t begin, const std::string &object,
                        const std::vector<std::string> &body) {
    KeptText kept{keptName(fmt::format("{}_{}", object, begin + 1)), joined(body)};
    std::string_view kind = trimmed(body.front());
    if (!networks::isTranslatedBody(kind)) {
      leaveOut(begin, object, fmt::format("its body is drawn ({}); its text is kept", kind));
      model_.kept.push_back(std::move(kept));
      return fmt::format("{{error 'body not imported: {}'}}\n", kind);
    }
    std::vector<networks::NumberedLine> lines;
    for (size_t i = 0; i < body.size(); ++i)
      lines.push_back({body[i], begin + i + 1});
    kind = kind.substr(1, kind.find("_BODY") - 1);
    return markDrawnBody(
        model_, originOf(begin), object, std::string(kind),
        [lines = std::move(lines)](networks::Scope &scope) {
          return networks::translatedExpBody(lines, scope);
        },
        std::move(kept));
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
    const std::string comment = std::exchange(comment_, {});
    const size_t lastLine = pou.rfind('\n', pou.size() - 2);
    pou.insert(lastLine == std::string::npos ? 0 : lastLine + 1,
               "\n" + comment + sourceOf(begin, object, content));
  }

  /// Blocks of one list have one attribute @GLOBAL_VARIABLE_LIST before the first of them.
  void addGlobals(size_t begin, const std::vector<std::string> &content, const char *byDefault) {
    std::string name = attributes_["GLOBAL_VARIABLE_LIST"];
    if (name.empty())
      name = byDefault;
    const auto [list, isNew] = lists_.try_emplace(name, model_.objects.size());
    if (!isNew) {
      model_.objects[list->second].text += "\n" + std::exchange(comment_, {}) + joined(content);
      return;
    }
    add(ObjectKind::GlobalList, begin, name, joined(content));
  }

  /// Every export has such a list; most are empty.
  void addConfig(size_t begin, const std::vector<std::string> &content) {
    if (wordsOf(joined(content)).size() > 2)
      addGlobals(begin, content, "Variable_Configuration");
  }

  /// `STANDARD.LIB 4.10.05 11:14:46`, then the names of what it holds: `TON: 0`
  void addLibrary(size_t begin, const std::vector<std::string> &content) {
    LibraryReference library;
    library.origin = originOf(begin);
    for (size_t i = 1; i + 1 < content.size(); ++i) {
      const std::string_view line = trimmed(content[i]);
      const std::string_view word = firstWord(line);
      if (line.empty() || line.starts_with("(*"))
        continue;
      if (library.name.empty()) {
        const size_t blank = std::min(line.find(' '), line.size());
        library.name = line.substr(0, blank);
        library.version = trimmed(line.substr(blank));
      } else if (!word.empty() && word != "NumOfPOUs" && word != "NumOfGVLs" &&
                 trimmed(line.substr(word.size())).starts_with(':')) {
        library.contents.emplace_back(word);
      }
    }
    model_.libraries.push_back(std::move(library));
  }

  void addHardware(size_t begin, const std::string &object,
                   const std::vector<std::string> &content) {
    const std::string text = joined(content);
    if (model_.configuration) {
      if (model_.kept[*model_.configuration].text == text)
        model_.changed.push_back({originOf(begin), object, "taken once, it is there twice"});
      else
        leaveOut(begin, object, "another one was read before; import one project at a time");
      return;
    }
    model_.configuration = model_.kept.size();
    model_.kept.push_back({keptName(object), text});
    readPlcConfiguration(content, originOf(begin), model_);
  }

  /// What nobody has documented is not guessed.
  void keep(size_t begin, const std::string &object, const std::vector<std::string> &content) {
    const std::string word(firstWord(object));
    model_.kept.push_back({keptName(word), joined(content)});
    if (word == "_ALARMCONFIG" && hasNoAlarms(content)) // of every project
      return;
    leaveOut(begin, object,
             fmt::format("{} lines of a section that is not imported; they are kept in import/kept",
                         content.size()));
  }

  static bool hasNoAlarms(const std::vector<std::string> &content) {
    return std::all_of(content.begin(), content.end(), [](const std::string &line) {
      const std::string_view text = trimmed(line);
      return firstWord(text) != "_ALARMGROUPLIST" || text.ends_with(": 0");
    });
  }

  const std::string &file_;
  const std::vector<std::string_view> lines_;
  Model &model_;
  size_t at_ = 0;
  std::map<std::string, std::string> attributes_; ///< of the object that comes next
  std::optional<size_t> lastPou_;
  std::string comment_; ///< that stands before the object that comes next
  size_t commentBegin_ = 0;
  size_t commentsEnd_ = 0;                  ///< the line after the last one that ends a comment
  std::map<std::string_view, size_t> ends_; ///< the last line of each `_END_…`
  std::map<std::string, size_t> lists_;     ///< the file's lists, by name
  std::optional<size_t> strayEnd_; ///< the line after the last one that belongs to no section
};

} // namespace

void readExp(const std::string &file, std::string_view text, Model &model) {
  Reader(file, text, model).read();
  model.addressing = "words"; // as long as the target settings do not say otherwise
}

} // namespace stc::import
