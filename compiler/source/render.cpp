#include "compiler/source/render.hpp"

#include "runtime/common/text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace stc {

namespace {

constexpr size_t kMaxExcerpt = 160; ///< longest shown part of a line, in columns
constexpr size_t kContext = 40;     ///< columns shown before a span in a line that is cut
constexpr size_t kTab = 4;

struct Style {
  const char *error = "";
  const char *warning = "";
  const char *note = "";
  const char *bold = "";
  const char *frame = "";
  const char *reset = "";
};

constexpr Style kColors{"\033[1;31m", "\033[1;33m", "\033[1;36m",
                        "\033[1m",    "\033[1;34m", "\033[0m"};

const char *severityName(Severity severity) {
  switch (severity) {
  case Severity::Error:
    return "error";
  case Severity::Warning:
    return "warning";
  case Severity::Note:
    return "note";
  case Severity::Off:
    return "off";
  }
  return "error";
}

bool startsCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

/// Columns as they are on the screen: tabs are widened, other characters count one.
size_t widthOf(std::string_view text) {
  size_t columns = 0;
  for (const char c : text)
    columns += c == '\t' ? kTab : startsCharacter(c) ? 1 : 0;
  return columns;
}

/// A part of a line, without tabs and control characters.
std::string excerptOf(std::string_view line) {
  std::string out;
  for (const char c : line) {
    if (c == '\t')
      out.append(kTab, ' ');
    else
      out += c;
  }
  return visible(out);
}

/// One marked range on one line, in bytes of that line.
struct Mark {
  size_t begin;
  size_t end;
  bool primary;
  std::string_view text;
};

/// The marks of one file by line number, and which lines are bridged by `...`.
struct FileMarks {
  FileId file;
  std::map<uint32_t, std::vector<Mark>> lines;
};

/// A mark in columns of the shown excerpt.
struct Drawn {
  size_t column;
  size_t width;
  const Mark *mark;
};

class TextRenderer {
public:
  TextRenderer(const Diagnostic &diagnostic, const Sources &sources, const Style &style)
      : diagnostic_(diagnostic), sources_(sources), style_(style) {}

  std::string run() {
    collect();
    head();
    for (size_t i = 0; i < files_.size(); ++i)
      file(files_[i], i == 0);
    trailer();
    out_ += '\n';
    return std::move(out_);
  }

private:
  [[nodiscard]] const char *severityStyle() const {
    switch (diagnostic_.severity) {
    case Severity::Error:
      return style_.error;
    case Severity::Warning:
      return style_.warning;
    case Severity::Note:
    case Severity::Off:
      break;
    }
    return style_.note;
  }

  void collect() {
    uint32_t largest = 0;
    for (size_t i = 0; i < diagnostic_.labels.size(); ++i) {
      const Label &label = diagnostic_.labels[i];
      if (!label.span.valid())
        continue;
      const SourceFile &source = sources_.file(label.span.file);
      auto known = std::find_if(files_.begin(), files_.end(), [&](const FileMarks &marks) {
        return marks.file == label.span.file;
      });
      if (known == files_.end())
        known = files_.insert(files_.end(), FileMarks{label.span.file, {}});
      const auto size = static_cast<uint32_t>(source.text().size());
      const uint32_t begin = std::min(label.span.begin, size);
      const uint32_t end = std::clamp(label.span.end, begin, size);
      const uint32_t first = source.lineNumber(begin);
      // A span that ends at a line's start ends on the line before.
      const uint32_t last = end > begin ? source.lineNumber(end - 1) : first;
      const auto mark = [&](uint32_t line, size_t from, size_t to, std::string_view text) {
        known->lines[line].push_back({from, to, i == 0, text});
        largest = std::max(largest, line);
      };
      const size_t from = begin - source.lineStart(first);
      if (first == last) {
        mark(first, from, end - source.lineStart(first), label.text);
      } else { // its first and its last line
        const std::string_view lastLine = source.line(last);
        const size_t indent = std::min(lastLine.find_first_not_of(" \t"), lastLine.size());
        const size_t to = end - source.lineStart(last);
        mark(first, from, std::max(source.line(first).size(), from + 1), {});
        mark(last, std::min(indent, to), to, label.text);
      }
    }
    gutter_ = std::to_string(largest).size();
  }

  void head() {
    out_ += severityStyle();
    out_ += severityName(diagnostic_.severity);
    out_ += "[" + codeName(diagnostic_.code) + "]";
    out_ += style_.reset;
    out_ += style_.bold;
    out_ += ": " + visible(diagnostic_.message);
    out_ += style_.reset;
    out_ += '\n';
  }

  void bar(std::string_view number = {}) {
    out_ += style_.frame;
    out_ += number;
    out_.append(gutter_ - number.size(), ' ');
    out_ += " |";
    out_ += style_.reset;
  }

  void file(const FileMarks &marks, bool isFirst) {
    const SourceFile &source = sources_.file(marks.file);
    LineColumn place{};
    if (isFirst) {
      place = source.position(diagnostic_.labels.front().span.begin);
    } else {
      const auto &line = *marks.lines.begin();
      place = source.position(
          static_cast<uint32_t>(source.lineStart(line.first) + line.second.front().begin));
    }
    out_.append(gutter_, ' ');
    out_ += style_.frame;
    out_ += isFirst ? "--> " : "::: ";
    out_ += style_.reset;
    out_ += visible(source.name()) + ":" + std::to_string(place.line) + ":" +
            std::to_string(place.column) + "\n";
    bar();
    out_ += '\n';
    uint32_t previous = 0;
    for (const auto &[number, list] : marks.lines) {
      if (previous != 0 && number > previous + 1) {
        if (number == previous + 2) { // one line between is shorter than dots
          codeLine(source, previous + 1, {});
        } else {
          out_ += style_.frame;
          out_ += "...";
          out_ += style_.reset;
          out_ += '\n';
        }
      }
      codeLine(source, number, list);
      previous = number;
    }
  }

  /// The line's text, cut around the marks when it is long, and the marks below it.
  void codeLine(const SourceFile &source, uint32_t number, std::vector<Mark> marks) {
    const std::string_view line = source.line(number);
    size_t from = 0;
    size_t to = line.size();
    if (to > kMaxExcerpt) {
      size_t anchor = marks.empty() ? 0 : marks.front().begin;
      for (const Mark &mark : marks)
        if (mark.primary)
          anchor = mark.begin;
      anchor = std::min(anchor, line.size());
      from = anchor > kContext ? anchor - kContext : 0;
      to = std::min(line.size(), from + kMaxExcerpt);
      while (from > 0 && !startsCharacter(line[from]))
        --from;
      while (to < line.size() && !startsCharacter(line[to]))
        ++to;
    }
    bar(std::to_string(number));
    const std::string excerpt = excerptOf(line.substr(from, to - from));
    if (!line.empty()) {
      out_ += ' ';
      out_ += from > 0 ? "…" : "";
      out_ += excerpt;
      out_ += to < line.size() ? "…" : "";
    }
    out_ += '\n';
    if (marks.empty())
      return;
    const size_t lead = from > 0 ? 1 : 0;
    std::vector<Drawn> drawn;
    for (const Mark &mark : marks) {
      const size_t begin = std::clamp(mark.begin, from, to);
      const size_t end = std::clamp(mark.end, begin, to);
      drawn.push_back({lead + widthOf(line.substr(from, begin - from)),
                       std::max<size_t>(1, widthOf(line.substr(begin, end - begin))), &mark});
    }
    std::stable_sort(drawn.begin(), drawn.end(),
                     [](const Drawn &a, const Drawn &b) { return a.column < b.column; });
    underline(drawn);
    // The rightmost label stands after its marks; the others hang below, from right to left.
    size_t last = drawn.size() - 1;
    const bool overlapped = last > 0 && drawn[last - 1].column + drawn[last - 1].width >
                                            drawn[last].column + drawn[last].width;
    if (!overlapped && !drawn[last].mark->text.empty()) {
      out_ += ' ';
      paint(*drawn[last].mark, drawn[last].mark->text);
    } else if (overlapped) {
      ++last;
    }
    out_ += '\n';
    std::vector<Drawn> hanging;
    for (size_t i = 0; i < last; ++i)
      if (!drawn[i].mark->text.empty())
        hanging.push_back(drawn[i]);
    for (size_t i = hanging.size(); i-- > 0;) {
      connectors(hanging, i + 1, nullptr);
      connectors(hanging, i, &hanging[i]);
    }
  }

  void underline(const std::vector<Drawn> &drawn) {
    size_t end = 0;
    for (const Drawn &one : drawn)
      end = std::max(end, one.column + one.width);
    std::vector<const Mark *> cells(end, nullptr);
    for (const bool primary : {false, true})
      for (const Drawn &one : drawn)
        if (one.mark->primary == primary)
          std::fill(cells.begin() + static_cast<ptrdiff_t>(one.column),
                    cells.begin() + static_cast<ptrdiff_t>(one.column + one.width), one.mark);
    bar();
    out_ += ' ';
    for (size_t i = 0; i < end;) {
      size_t next = i;
      while (next < end && cells[next] == cells[i])
        ++next;
      if (cells[i] == nullptr)
        out_.append(next - i, ' ');
      else
        paint(*cells[i], std::string(next - i, cells[i]->primary ? '^' : '-'));
      i = next;
    }
  }

  /// A row of `|` below the first `count` labels, and the text of one more.
  void connectors(const std::vector<Drawn> &list, size_t count, const Drawn *text) {
    bar();
    out_ += ' ';
    size_t column = 0;
    for (size_t i = 0; i < count; ++i) {
      if (list[i].column < column)
        continue;
      out_.append(list[i].column - column, ' ');
      paint(*list[i].mark, "|");
      column = list[i].column + 1;
    }
    if (text != nullptr) {
      out_.append(text->column > column ? text->column - column : 0, ' ');
      paint(*text->mark, text->mark->text);
    }
    out_ += '\n';
  }

  void paint(const Mark &mark, std::string_view text) {
    out_ += mark.primary ? severityStyle() : style_.frame;
    out_ += visible(text);
    out_ += style_.reset;
  }

  void trailer() {
    if (diagnostic_.notes.empty() && diagnostic_.helps.empty())
      return;
    if (!files_.empty()) {
      bar();
      out_ += '\n';
    }
    const auto line = [&](std::string_view kind, const std::string &text) {
      out_.append(gutter_, ' ');
      out_ += style_.frame;
      out_ += " = ";
      out_ += style_.reset;
      out_ += style_.bold;
      out_ += kind;
      out_ += style_.reset;
      out_ += ": ";
      // Further lines are aligned under the first.
      size_t at = 0;
      for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', at)) {
        out_ += visible(std::string_view(text).substr(at, end - at)) + "\n" +
                std::string(gutter_ + 5 + kind.size(), ' ');
        at = end + 1;
      }
      out_ += visible(std::string_view(text).substr(at)) + "\n";
    };
    for (const std::string &note : diagnostic_.notes)
      line("note", note);
    for (const std::string &help : diagnostic_.helps)
      line("help", help);
  }

  const Diagnostic &diagnostic_;
  const Sources &sources_;
  const Style &style_;
  std::vector<FileMarks> files_;
  size_t gutter_ = 1;
  std::string out_;
};

} // namespace

std::string visible(std::string_view text, std::string_view kept) {
  std::string out(text);
  stride::common::hideControls(out, kept);
  return out;
}

std::string renderText(const Diagnostic &diagnostic, const Sources &sources,
                       const RenderOptions &options) {
  static constexpr Style kPlain;
  return TextRenderer(diagnostic, sources, options.color ? kColors : kPlain).run();
}

namespace {

nlohmann::ordered_json jsonOf(Span span, const Sources &sources, const std::string &text) {
  const SourceFile &source = sources.file(span.file);
  const LineColumn begin = source.position(span.begin);
  const LineColumn end = source.position(span.end);
  return {{"file", source.name()}, {"line", begin.line},      {"column", begin.column},
          {"endLine", end.line},   {"endColumn", end.column}, {"text", text}};
}

} // namespace

std::string renderJson(const Diagnostic &diagnostic, const Sources &sources) {
  nlohmann::ordered_json json;
  json["code"] = codeName(diagnostic.code);
  json["name"] = kebabName(diagnostic.code);
  json["severity"] = severityName(diagnostic.severity);
  json["message"] = diagnostic.message;
  json["labels"] = nlohmann::ordered_json::array();
  for (const Label &label : diagnostic.labels) {
    if (!label.span.valid())
      continue;
    json["labels"].push_back(jsonOf(label.span, sources, label.text));
  }
  json["notes"] = diagnostic.notes;
  json["helps"] = diagnostic.helps;
  json["suggestions"] = nlohmann::ordered_json::array();
  for (const Suggestion &suggestion : diagnostic.suggestions) {
    nlohmann::ordered_json edits = nlohmann::ordered_json::array();
    for (const Edit &edit : suggestion.edits) {
      if (edit.span.valid())
        edits.push_back(jsonOf(edit.span, sources, edit.text));
    }
    json["suggestions"].push_back({{"message", suggestion.message}, {"edits", edits}});
  }
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace stc
