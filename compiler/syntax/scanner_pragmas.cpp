// Pragmas: attributes, messages, conditional compilation.
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>

namespace stc {

size_t Scanner::pragmaEnd(size_t begin) const {
  size_t end = begin + 1;
  while (end < text_.size() && text_[end] != '}') {
    const char c = text_[end];
    if (c == '\'' ||
        c == '"') { // a quoted text may hold a brace, unless it does not end on its line
      const auto stop = text_.find_first_of(c == '\'' ? "'\n" : "\"\n", end + 1);
      if (stop != std::string_view::npos && text_[stop] == c)
        end = stop;
    }
    ++end;
  }
  return end < text_.size() ? end + 1 : std::string_view::npos;
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
  const size_t end = behind - 1;
  const auto from = static_cast<uint32_t>(begin);
  const auto to = static_cast<uint32_t>(place_);
  size_t p = begin + 1;
  const auto skip = [&] {
    while (p < end && classOf(text_[p]) == kBlank)
      ++p;
  };
  const auto quotedText = [&]() -> std::string_view {
    skip();
    const char quote = p < end ? text_[p] : '\0';
    if (quote != '\'' && quote != '"')
      return {};
    const auto close = text_.find(quote, p + 1);
    if (close >= end)
      return {};
    const std::string_view content = text_.substr(p + 1, close - p - 1);
    p = close + 1;
    return content;
  };
  skip();
  const std::string_view keyword = wordAt(p);
  p += keyword.size();
  if (isWord(keyword, "external")) {
    trivia_.push_back({Trivia::Kind::External, from, to, {}, {}});
  } else if (isWord(keyword, "attribute")) {
    const std::string_view name = quotedText();
    skip();
    std::string_view value;
    if (p + 1 < end && text_.compare(p, 2, ":=") == 0) {
      p += 2;
      value = quotedText();
    }
    if (!name.empty())
      trivia_.push_back({Trivia::Kind::Attribute, from, to, name, value});
  } else if (conditions_ != nullptr) {
    directive(keyword, begin, p, end);
  }
}

/// The pragmas that a scanner without conditions passes over.
void Scanner::directive(std::string_view keyword, size_t begin, size_t p, size_t end) {
  const Span whole = span(begin, end + 1);
  if (isWord(keyword, "if")) {
    branches_.push_back({whole, false, false});
    branch(p, end);
  } else if (isWord(keyword, "elsif") || isWord(keyword, "else") || isWord(keyword, "end_if")) {
    if (branches_.empty()) {
      diagnostics_
          .report(Code::UnbalancedConditional, whole,
                  "`{" + std::string(keyword) + "}` without an `{IF …}`", "no `{IF …}` is open")
          .help(isWord(keyword, "end_if") ? "remove it" : "write `{IF …}` for the first condition");
    } else if (isWord(keyword, "end_if")) {
      branches_.pop_back();
    } else {
      checkElse(keyword, whole);
      branches_.back().sawElse |= isWord(keyword, "else");
      skipInactive(); // what stood in front of it was compiled
    }
  } else if (isWord(keyword, "define") || isWord(keyword, "undefine")) {
    size_t at = p;
    while (at < end && classOf(text_[at]) == kBlank)
      ++at;
    const std::string_view name = wordAt(at);
    if (name.empty() || at + name.size() > end) {
      diagnostics_
          .report(Code::MalformedPragma, whole, "`{" + std::string(keyword) + "}` needs a name",
                  "expected a name here")
          .help("write `{" + std::string(keyword) + " NAME}`");
      return;
    }
    at += name.size();
    while (at < end && classOf(text_[at]) == kBlank)
      ++at;
    std::string_view value = text_.substr(at, end - at);
    while (!value.empty() && classOf(value.back()) == kBlank)
      value.remove_suffix(1);
    if (value.size() >= 2 && (value[0] == '\'' || value[0] == '"') && value.back() == value[0])
      value = value.substr(1, value.size() - 2);
    if (isWord(keyword, "define"))
      conditions_->define(name, value);
    else
      conditions_->undefine(name);
  } else {
    message(keyword, whole, p, end);
  }
}

void Scanner::message(std::string_view keyword, Span whole, size_t p, size_t end) {
  const bool isError = isWord(keyword, "error");
  const bool isWarning = isWord(keyword, "warning");
  if (!isError && !isWarning && !isWord(keyword, "info") && !isWord(keyword, "text"))
    return bracesAsBlock(whole.begin, whole.end); // region, analysis, unknown ones
  while (p < end && classOf(text_[p]) == kBlank)
    ++p;
  if (p >= end || (text_[p] != '\'' && text_[p] != '"'))
    return isWarning ? warningPragma(p, end) : void();
  const size_t close = text_.find(text_[p], p + 1);
  if (close >= end)
    return;
  diagnostics_.report(isError     ? Code::ErrorPragma
                      : isWarning ? Code::WarningPragma
                                  : Code::MessagePragma,
                      whole, std::string(text_.substr(p + 1, close - p - 1)), "written here");
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

void Scanner::checkElse(std::string_view keyword, Span whole) {
  if (!branches_.back().sawElse)
    return;
  diagnostics_
      .report(Code::UnbalancedConditional, whole,
              "`{" + std::string(keyword) + "}` after the `{ELSE}` of the same `{IF …}`",
              "`{ELSE}` is the last one")
      .label(branches_.back().place, "of this `{IF …}`");
}

/// Goes on behind the condition in [p, end) when it holds, else at the next branch.
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

/// Passes over text that is not compiled, up to the branch that is or behind `{END_IF}`.
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
    size_t p = begin + 1;
    while (p < behind && classOf(text_[p]) == kBlank)
      ++p;
    const std::string_view keyword = wordAt(p);
    p += keyword.size();
    if (isWord(keyword, "if")) {
      ++depth;
    } else if (isWord(keyword, "end_if")) {
      if (depth == 0) {
        branches_.pop_back();
        return;
      }
      --depth;
    } else if (depth == 0 && (isWord(keyword, "elsif") || isWord(keyword, "else"))) {
      const bool isElse = isWord(keyword, "else");
      checkElse(keyword, span(begin, behind));
      branches_.back().sawElse |= isElse;
      if (branches_.back().taken)
        continue;
      const std::optional<bool> value =
          isElse ? std::optional(true)
                 : conditions_->evaluate(text_.substr(p, behind - 1 - p), span(p, behind - 1),
                                         diagnostics_);
      branches_.back().taken = value.value_or(true);
      if (value.value_or(false))
        return;
    }
  }
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
