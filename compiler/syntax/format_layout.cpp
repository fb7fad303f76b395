#include "compiler/syntax/format_layout.hpp"

#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

namespace {

/// Names wider than this do not move the colons of other declarations.
constexpr size_t kWidestAligned = 40;

/// A comment that begins a line, whose further lines move as its first one does.
std::string moved(const FormatComment &comment, size_t margin, bool tabs) {
  std::string text = commentText(comment.text);
  if (!comment.startsLine || margin == comment.margin || text.find('\n') == std::string::npos)
    return text;
  std::string out;
  size_t begin = 0;
  for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    out.append(text, begin, end - begin + 1);
    begin = end + 1;
    if (margin > comment.margin) {
      if (begin < text.size() && text[begin] != '\n')
        out.append(margin - comment.margin, tabs ? '\t' : ' ');
    } else {
      for (size_t k = comment.margin - margin;
           k > 0 && begin < text.size() && (text[begin] == ' ' || text[begin] == '\t'); --k)
        ++begin;
    }
  }
  return out.append(text, begin);
}

} // namespace

FormatLayout::FormatLayout(std::vector<FormatItem> items, const FormatStyle &style)
    : items_(std::move(items)), style_(style), jumpTargets_(jumpTargets(items_)) {}

std::string FormatLayout::run() {
  for (;;) {
    separate_ |= isMember(type(at_)) && !afterOpener_;
    comments();
    if (type(at_) == Token::kEnd)
      break;
    line();
  }
  if (style_.align)
    alignComments();
  return join();
}

bool FormatLayout::isWordAt(size_t i, std::string_view lower) const {
  return type(i) == Tok::IDENT && isWord(items_[i].text, lower);
}

bool FormatLayout::hasComments(size_t from, size_t to) const {
  return std::any_of(items_.begin() + static_cast<ptrdiff_t>(from),
                     items_.begin() + static_cast<ptrdiff_t>(to),
                     [](const FormatItem &item) { return !item.comments.empty(); });
}

// -------------------------------------------------------------------------------------------------
// comments

/// Comments directly before a label or ELSE belong to what it begins.
unsigned FormatLayout::commentLevel() const {
  const Block &now = blocks_.back();
  if (now.kind == Kind::Branch && (type(at_) == Tok::ELSE || labelEnd(at_) != 0))
    return now.level;
  if (isMember(type(at_)) || startsDeclaration(at_)) {
    for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block)
      if (block->kind <= Kind::Actions)
        return block->content;
  }
  return now.content;
}

/// Each branch of a conditional pragma begins with what was open before the first one.
void FormatLayout::conditional(std::string_view comment) {
  const PragmaWord word = pragmaOf(comment);
  if (word == PragmaWord::If) {
    conditionals_.push_back(blocks_);
  } else if (conditionals_.empty()) {
    return;
  } else if (word == PragmaWord::Elsif || word == PragmaWord::Else) {
    blocks_ = conditionals_.back();
  } else if (word == PragmaWord::EndIf) {
    conditionals_.pop_back();
  }
}

void FormatLayout::comments() {
  const FormatItem &item = items_[at_];
  const std::vector<FormatComment> &list = item.comments;
  const bool atEnd = item.type == Token::kEnd;
  const auto newlinesAt = [&](size_t k) {
    return k < list.size() ? list[k].newlines : atEnd ? 1U : item.newlines;
  };
  prefix_.clear();
  blank_ = false;
  size_t k = 0;
  // Those on the last token's line.
  while (k < list.size() && newlinesAt(k) == 0)
    ++k;
  const bool trailing = k > 0 && newlinesAt(k) > 0 && !lines_.empty();
  for (size_t i = 0; trailing && i < k; ++i) {
    std::string &text = lines_.back().comment;
    text += (text.empty() ? "" : " ") + commentText(list[i].text);
    conditional(list[i].text);
  }
  if (!trailing)
    k = 0;
  while (k < list.size()) {
    const size_t begin = k;
    blank_ = newlinesAt(k) > 1;
    do
      ++k;
    while (k < list.size() && newlinesAt(k) == 0);
    if (newlinesAt(k) > 0) {
      commentLine(begin, k);
      continue;
    }
    for (size_t i = begin; i < k; ++i) {
      conditional(list[i].text);
      prefix_.push_back(&list[i]);
    }
    return; // the token follows on this line
  }
  blank_ = item.newlines > 1;
}

/// Only the line itself knows how deep it is: `END_VAR` after a comment is less so than the
/// comment would be alone.
std::string FormatLayout::prefixAt(unsigned level) const {
  std::string out;
  for (const FormatComment *comment : prefix_)
    out += out.empty() ? moved(*comment, indentation(style_, level).size(), style_.tabs)
                       : " " + commentText(comment->text);
  return out;
}

void FormatLayout::commentLine(size_t from, size_t to) {
  const std::vector<FormatComment> &list = items_[at_].comments;
  std::string text;
  unsigned level = 0;
  for (size_t i = from; i < to; ++i) {
    conditional(list[i].text);
    if (i == from)
      level = commentLevel();
    text += i > from ? " " + commentText(list[i].text)
                     : moved(list[i], indentation(style_, level).size(), style_.tabs);
  }
  emitText(level, std::move(text), blank_);
}

// -------------------------------------------------------------------------------------------------
// lines

void FormatLayout::emitText(unsigned level, std::string text, bool blank) {
  Line out;
  out.level = level;
  out.text = std::move(text);
  out.blank = !lines_.empty() && (separate_ || (blank && !afterOpener_));
  lines_.push_back(std::move(out));
  afterOpener_ = separate_ = false;
}

void FormatLayout::emit(size_t to, unsigned level, LineKind kind) {
  to = std::min(to, items_.size() - 1); // a wrong text may end anywhere
  if (to <= at_)
    return;
  LineRequest request;
  request.from = at_;
  request.to = to;
  request.level = level;
  request.kind = kind;
  request.prefix = prefixAt(level);
  if (kind == LineKind::Declaration && style_.align)
    request.colon = colonOf(at_, to, level);
  if (closing_)
    separate_ = false;
  emitText(level, layLine(items_, request, style_), blank_ && !closing_);
  lines_.back().declaration = kind == LineKind::Declaration;
  closing_ = false;
  prefix_.clear();
  blank_ = false;
  at_ = to;
}

/// The column, after the indentation, in which the declaration [from, to) has its colon: that of
/// the widest name among the declarations that follow each other.
size_t FormatLayout::colonOf(size_t from, size_t to, unsigned level) {
  if (from < runEnd_)
    return runColon_;
  const auto nameWidth = [&](size_t begin, size_t end) -> size_t {
    unsigned depth = 0;
    for (size_t i = begin; i < end; ++i) {
      depth += type(i) == Tok::LPAREN || type(i) == Tok::LBRACKET;
      depth -= (type(i) == Tok::RPAREN || type(i) == Tok::RBRACKET) && depth > 0;
      if (type(i) == Tok::COLON && depth == 0 && !hasComments(begin + 1, i + 1)) {
        LineRequest names;
        names.from = begin;
        names.to = i;
        names.level = level;
        names.kind = LineKind::Declaration;
        const std::string text = layLine(items_, names, style_);
        return text.find('\n') == std::string::npos ? widthOf(text) : 0;
      }
    }
    return 0;
  };
  size_t widest = 0;
  size_t begin = from;
  size_t end = to;
  for (;;) {
    const size_t width = nameWidth(begin, end);
    if (width <= kWidestAligned)
      widest = std::max(widest, width);
    begin = end;
    const FormatItem &next = items_[begin];
    // Comments after the declaration before, on its line, do not end the run.
    const bool ownLine =
        std::any_of(next.comments.begin(), next.comments.end(),
                    [](const FormatComment &comment) { return comment.newlines > 0; });
    if (next.type == Token::kEnd || stopsStatement(begin) || next.newlines > 1 || ownLine ||
        (next.newlines == 0 && !next.comments.empty()))
      break;
    end = statementEnd(begin);
  }
  runEnd_ = begin;
  runColon_ = widest + 1;
  return runColon_;
}

/// Comments after declarations that follow each other begin in one column.
void FormatLayout::alignComments() {
  const auto lastWidth = [](const Line &line) {
    const size_t newline = line.text.rfind('\n');
    return newline == std::string::npos
               ? widthOf(line.text)
               : 0; // further lines have a width that does not count from the indentation
  };
  for (size_t begin = 0; begin < lines_.size();) {
    size_t end = begin + 1;
    if (!lines_[begin].declaration) {
      begin = end;
      continue;
    }
    while (end < lines_.size() && lines_[end].declaration && !lines_[end].blank &&
           lines_[end].level == lines_[begin].level)
      ++end;
    size_t widest = 0;
    for (size_t i = begin; i < end; ++i)
      if (!lines_[i].comment.empty())
        widest = std::max(widest, lastWidth(lines_[i]));
    for (size_t i = begin; i < end; ++i)
      if (!lines_[i].comment.empty() && lines_[i].text.find('\n') == std::string::npos)
        lines_[i].text.append(widest - lastWidth(lines_[i]), ' ');
    begin = end;
  }
}

std::string FormatLayout::join() const {
  std::string out;
  for (const Line &line : lines_) {
    if (line.blank)
      out += '\n';
    out += indentation(style_, line.level) + line.text;
    if (!line.comment.empty())
      out += " " + line.comment;
    out += '\n';
  }
  return out;
}

} // namespace stc
