// Pragmas: attributes, messages, conditional compilation.
#include "compiler/source/st_scan.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>

namespace stc {

size_t Scanner::pragmaEnd(size_t begin) const {
  const size_t end = afterPragma(text_, begin);
  return end > begin + 1 && text_[end - 1] == '}' ? end : std::string_view::npos;
}

void Scanner::pragma(size_t begin) {
  const size_t behind = pragmaEnd(begin);
  if (behind == std::string_view::npos) {
    diagnostics_
        .report(Code::UnterminatedPragma, span(begin, begin + 1), "this pragma has no end",
                "the pragma begins here")
        .help("close it with `}`");
    const auto line = text_.find('\n', begin);
    place_ = line == std::string_view::npos ? text_.size() : line;
    return;
  }
  place_ = behind;
  const Pragma read = pragmaAt(begin, place_ - 1);
  if (read.word == PragmaWord::External)
    trivia_.push_back({Trivia::Kind::External, read.whole.begin, read.whole.end, {}, {}});
  else if (read.word == PragmaWord::Attribute)
    attributePragma(read);
  else if (conditions_ != nullptr)
    directive(read);
}

size_t Scanner::afterBlanks(size_t place, size_t end) const {
  while (place < end && classOf(text_[place]) == kBlank)
    ++place;
  return place;
}

/// The one between the braces at those places.
Scanner::Pragma Scanner::pragmaAt(size_t begin, size_t end) const {
  const size_t place = afterBlanks(begin + 1, end);
  const std::string_view spelling = wordAt(place);
  return {findPragma(spelling), spelling, span(begin, end + 1), place + spelling.size(), end};
}

void Scanner::attributePragma(const Pragma &pragma) {
  size_t place = pragma.place;
  const auto quotedText = [&]() -> std::string_view {
    place = afterBlanks(place, pragma.end);
    const char quote = place < pragma.end ? text_[place] : '\0';
    if (quote != '\'' && quote != '"')
      return {};
    const auto close = text_.find(quote, place + 1);
    if (close >= pragma.end)
      return {};
    const std::string_view content = text_.substr(place + 1, close - place - 1);
    place = close + 1;
    return content;
  };
  const std::string_view name = quotedText();
  place = afterBlanks(place, pragma.end);
  std::string_view value;
  if (place + 1 < pragma.end && text_.compare(place, 2, ":=") == 0) {
    place += 2;
    value = quotedText();
  }
  if (!name.empty())
    trivia_.push_back({Trivia::Kind::Attribute, pragma.whole.begin, pragma.whole.end, name, value});
}

/// The pragmas that a scanner without conditions passes over.
void Scanner::directive(const Pragma &pragma) {
  switch (pragma.word) {
  case PragmaWord::If:
    branches_.push_back({pragma.whole, false, false});
    return branch(pragma.place, pragma.end);
  case PragmaWord::Elsif:
  case PragmaWord::Else:
  case PragmaWord::EndIf:
    return otherBranch(pragma);
  case PragmaWord::Define:
  case PragmaWord::Undefine:
    return definition(pragma);
  case PragmaWord::Error:
    return message(pragma, Code::ErrorPragma);
  case PragmaWord::Warning:
    return message(pragma, Code::WarningPragma);
  case PragmaWord::Info:
  case PragmaWord::Text:
    return message(pragma, Code::MessagePragma);
  case PragmaWord::None: // region, analysis, unknown ones
  case PragmaWord::Attribute:
  case PragmaWord::External:
    return bracesAsBlock(pragma.whole.begin, pragma.whole.end);
  }
}

void Scanner::otherBranch(const Pragma &pragma) {
  const bool ends = pragma.word == PragmaWord::EndIf;
  if (branches_.empty()) {
    diagnostics_
        .report(Code::UnbalancedConditional, pragma.whole,
                "`{" + std::string(pragma.spelling) + "}` without an `{IF …}`",
                "no `{IF …}` is open")
        .help(ends ? "remove it" : "write `{IF …}` for the first condition");
  } else if (ends) {
    branches_.pop_back();
  } else {
    checkElse(pragma);
    branches_.back().sawElse |= pragma.word == PragmaWord::Else;
    skipInactive(); // what stood before it was compiled
  }
}

/// `{define NAME value}`, `{undefine NAME}`
void Scanner::definition(const Pragma &pragma) {
  size_t at = afterBlanks(pragma.place, pragma.end);
  const std::string_view name = wordAt(at);
  if (name.empty() || at + name.size() > pragma.end) {
    const std::string spelling(pragma.spelling);
    diagnostics_
        .report(Code::MalformedPragma, pragma.whole, "`{" + spelling + "}` needs a name",
                "expected a name here")
        .help("write `{" + spelling + " NAME}`");
    return;
  }
  if (pragma.word == PragmaWord::Undefine)
    return conditions_->undefine(name);
  at = afterBlanks(at + name.size(), pragma.end);
  std::string_view value = text_.substr(at, pragma.end - at);
  while (!value.empty() && classOf(value.back()) == kBlank)
    value.remove_suffix(1);
  if (value.size() >= 2 && (value[0] == '\'' || value[0] == '"') && value.back() == value[0])
    value = value.substr(1, value.size() - 2);
  conditions_->define(name, value);
}

/// `{error 'text'}` and the like; `{warning …}` may be about diagnostics instead.
void Scanner::message(const Pragma &pragma, Code code) {
  const size_t place = afterBlanks(pragma.place, pragma.end);
  if (place >= pragma.end || (text_[place] != '\'' && text_[place] != '"')) {
    if (pragma.word == PragmaWord::Warning)
      warningPragma(place, pragma.end);
    return;
  }
  const size_t close = text_.find(text_[place], place + 1);
  if (close < pragma.end)
    diagnostics_.report(code, pragma.whole, std::string(text_.substr(place + 1, close - place - 1)),
                        "written here");
}

/// `{warning disable SE0390}`, `{warning restore unused-variable}`; codes of other compilers are
/// passed over.
void Scanner::warningPragma(size_t place, size_t end) {
  const auto nextWord = [&] {
    while (place < end && (classOf(text_[place]) == kBlank || text_[place] == ','))
      ++place;
    const size_t begin = place;
    while (place < end && classOf(text_[place]) != kBlank && text_[place] != ',')
      ++place;
    return text_.substr(begin, place - begin);
  };
  const std::string_view action = nextWord();
  const bool disable = isWord(action, "disable");
  if (!disable && !isWord(action, "restore"))
    return;
  for (std::string_view word = nextWord(); !word.empty(); word = nextWord()) {
    if (const CodeInfo *code = findCode(word)) {
      diagnostics_.setSilent(file_, static_cast<uint32_t>(place), code->code, disable);
      continue;
    }
    const bool foreign = (word[0] == 'C' || word[0] == 'c') && word.size() > 1 &&
                         word.find_first_not_of("0123456789", 1) == std::string_view::npos;
    if (!foreign)
      diagnostics_
          .report(Code::UnknownDiagnostic, span(place - word.size(), place),
                  "there is no diagnostic `" + std::string(word) + "`", "unknown")
          .help("`stride explain --list` shows all codes and names");
  }
}

void Scanner::checkElse(const Pragma &pragma) {
  if (!branches_.back().sawElse)
    return;
  diagnostics_
      .report(Code::UnbalancedConditional, pragma.whole,
              "`{" + std::string(pragma.spelling) + "}` after the `{ELSE}` of the same `{IF …}`",
              "`{ELSE}` is the last one")
      .label(branches_.back().place, "of this `{IF …}`");
}

/// Goes on after the condition in [p, end) when it holds, else at the next branch.
void Scanner::branch(size_t p, size_t end) {
  const std::optional<bool> value =
      conditions_->evaluate(text_.substr(p, end - p), span(p, end), diagnostics_);
  if (!value)
    branches_.back().taken = true; // reported: none of the branches is compiled
  if (value.value_or(false))
    branches_.back().taken = true;
  else
    skipInactive();
}

/// Passes over text that is not compiled, up to the branch that is or after `{END_IF}`.
void Scanner::skipInactive() {
  size_t depth = 0;
  while (place_ < text_.size()) {
    const char c = text_[place_];
    if (c == '\'' || c == '"') {
      const size_t stop = text_.find_first_of(c == '\'' ? "'\n" : "\"\n", place_ + 1);
      place_ = stop == std::string_view::npos ? text_.size() : stop + 1;
      continue;
    }
    if (c == '/' || c == '(') {
      const size_t next = comment(place_);
      place_ = next == place_ ? place_ + 1 : next;
      continue;
    }
    if (c != '{') {
      ++place_;
      continue;
    }
    const size_t begin = place_;
    const size_t behind = pragmaEnd(begin);
    if (behind == std::string_view::npos) {
      ++place_;
      continue;
    }
    place_ = behind;
    if (endsInactive(pragmaAt(begin, place_ - 1), depth))
      return;
  }
}

/// A pragma in text that is not compiled, inside of `depth` other conditions: true when compiled
/// text follows.
bool Scanner::endsInactive(const Pragma &pragma, size_t &depth) {
  const bool isElse = pragma.word == PragmaWord::Else;
  if (pragma.word == PragmaWord::If) {
    ++depth;
  } else if (pragma.word == PragmaWord::EndIf) {
    if (depth == 0) {
      branches_.pop_back();
      return true;
    }
    --depth;
  } else if (depth == 0 && (isElse || pragma.word == PragmaWord::Elsif)) {
    checkElse(pragma);
    branches_.back().sawElse |= isElse;
    if (branches_.back().taken)
      return false;
    const Span condition = span(pragma.place, pragma.end);
    const std::optional<bool> value =
        isElse ? std::optional(true)
               : conditions_->evaluate(text_.substr(pragma.place, pragma.end - pragma.place),
                                       condition, diagnostics_);
    branches_.back().taken = value.value_or(true);
    return value.value_or(false);
  }
  return false;
}

void Scanner::reportOpenBranches() {
  for (const Branch &open : branches_)
    diagnostics_
        .report(Code::UnbalancedConditional, open.place, "this `{IF …}` has no `{END_IF}`",
                "the file ends before it is closed")
        .help("write `{END_IF}` after the last branch");
  branches_.clear();
}

} // namespace stc
