// Reading CNC files.

#include "compiler/assets/cnc/cnc_source.hpp"

#include "runtime/numeric/cnc/decoder.hpp"
#include "runtime/numeric/cnc/gcode_scanner.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::cnc;

struct TextWords {
  std::string message;
  std::string label;
  std::string help;
};

TextWords describeText(GCodeError error) {
  switch (error) {
  case GCodeError::UnknownWord:
    return {"there is no such word", "not a word of this language",
            "words are a letter and a number, as X10; docs/cnc.md lists them"};
  case GCodeError::MissingValue:
    return {"a word needs a value", "neither a number nor a variable follows", ""};
  case GCodeError::BadNumber:
    return {"this is no number", "numbers are written 10, -0.5 or 3.25", ""};
  case GCodeError::Exponent:
    return {"numbers have no exponent here", "this would be an acceleration",
            "write the number out, as 0.00001; a word E stands after a blank"};
  case GCodeError::NotWhole:
    return {"this word needs a whole number", "it has a fraction", ""};
  case GCodeError::UnclosedComment:
    return {"a comment must end in its line", "no `)` follows", ""};
  case GCodeError::UnclosedVariable:
    return {"the name of a variable must end with `$`", "no `$` follows in the line", ""};
  case GCodeError::BadVariable:
    return {"this is no name of a variable",
            fmt::format("empty, or longer than {} characters", kMostName), ""};
  default:
    return {"a word begins with a letter", "unexpected character",
            "comments stand between ( and ), or after //"};
  }
}

class CncReader {
public:
  CncReader(const SourceFile &file, Diagnostics &diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  std::optional<CncProgram> read() {
    const size_t errors = diagnostics_.errorCount();
    program_.name = std::filesystem::path(file_.name()).stem().string();
    program_.span = {file_.id(), 0, 0};
    const std::string_view whole = file_.text();
    program_.lines = static_cast<uint32_t>(std::count(whole.begin(), whole.end(), '\n')) +
                     (whole.empty() || whole.ends_with('\n') ? 0 : 1);
    const std::string_view text = file_.text();
    size_t at = 0;
    while (at < text.size()) {
      int64_t used = 0;
      const ScanEvent event = scan(scanner_, reinterpret_cast<const uint8_t *>(text.data()) + at,
                                   static_cast<int64_t>(text.size() - at), used);
      at += static_cast<size_t>(used);
      take(event);
    }
    for (ScanEvent event = scanEnd(scanner_); event != ScanEvent::None; event = scanEnd(scanner_))
      take(event);
    if (diagnostics_.errorCount() != errors)
      return std::nullopt;
    return std::move(program_);
  }

private:
  [[nodiscard]] Span spanOf() const {
    const auto begin = static_cast<uint32_t>(scanner_.wordOffset);
    return {file_.id(), begin, std::max(begin + 1, static_cast<uint32_t>(scanner_.offset))};
  }

  /// After an error: `Z-$x$`, which people write for other controls.
  [[nodiscard]] bool isSignOfVariable() const {
    const std::string_view text = file_.text();
    const auto at = static_cast<size_t>(scanner_.offset);
    return scanner_.error == GCodeError::BadNumber && at > 0 && at < text.size() &&
           text[at] == '$' && (text[at - 1] == '-' || text[at - 1] == '+');
  }

  void take(ScanEvent event) {
    switch (event) {
    case ScanEvent::Word:
      if (++inSentence_ == kMostWords + 1)
        diagnostics_.report(Code::CncText, spanOf(),
                            fmt::format("a sentence has {} words at most", kMostWords), "one more");
      program_.words.push_back(
          {scanner_.word, scanner_.variable ? scanner_.name : std::string(), spanOf(), {}});
      if (scanner_.variable && scanner_.word.letter == 'N')
        diagnostics_.report(Code::CncText, spanOf(), "the number of a sentence is no variable",
                            "write a number");
      break;
    case ScanEvent::EndOfSentence: {
      CncWord end;
      end.word.letter = kEndOfSentence;
      end.word.integer = scanner_.line + 1;
      end.span = program_.words.empty() ? program_.span : program_.words.back().span;
      program_.words.push_back(end);
      inSentence_ = 0;
      break;
    }
    case ScanEvent::ProgramName:
      program_.title = scanner_.name;
      break;
    case ScanEvent::Error: {
      const TextWords words =
          isSignOfVariable() ? TextWords{"a variable has no sign before it", "this is no number",
                                         "give the variable the negative value; only programs that "
                                         "SMC_ReadNCFile2 reads can calculate"}
                             : describeText(scanner_.error);
      Diagnostic &diagnostic =
          diagnostics_.report(Code::CncText, spanOf(), words.message, words.label);
      if (!words.help.empty())
        diagnostic.help(words.help);
      break;
    }
    case ScanEvent::None:
    case ScanEvent::EndOfProgram:
      break;
    }
  }

  const SourceFile &file_;
  Diagnostics &diagnostics_;
  Scanner scanner_{};
  CncProgram program_;
  int inSentence_ = 0;
};

} // namespace

std::optional<CncProgram> readCnc(const SourceFile &file, Diagnostics &diagnostics) {
  return CncReader(file, diagnostics).read();
}

} // namespace stc
