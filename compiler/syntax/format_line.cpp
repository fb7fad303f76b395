#include "compiler/syntax/format_line.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>
#include <array>

namespace stc {

namespace {

constexpr unsigned kNoBreak = ~0U;
constexpr unsigned kLevelsPerBracket = 16;
constexpr unsigned kComma = 0;

/// How tightly a binary operator binds; 0: it is none.
unsigned bindingOf(uint16_t type) {
  switch (type) {
  case Tok::OR:
  case Tok::OR_ELSE:
    return 2;
  case Tok::XOR:
    return 3;
  case Tok::AND:
  case Tok::AMPERSAND:
  case Tok::AND_THEN:
    return 4;
  case Tok::EQUAL:
  case Tok::NOT_EQUAL:
    return 5;
  case Tok::LESS:
  case Tok::LESS_EQUAL:
  case Tok::GREATER:
  case Tok::GREATER_EQUAL:
    return 6;
  case Tok::PLUS:
  case Tok::MINUS:
    return 7;
  case Tok::STAR:
  case Tok::SLASH:
  case Tok::MOD:
  case Tok::POWER:
    return 8;
  default:
    return 0;
  }
}

bool endsOperand(uint16_t type) {
  switch (type) {
  case Tok::DIRECT:
  case Tok::WSTRING_LITERAL:
    return true;
  default:
    return isOperandEnd(type);
  }
}

bool opens(uint16_t type) { return type == Tok::LPAREN || type == Tok::LBRACKET; }
bool closes(uint16_t type) { return type == Tok::RPAREN || type == Tok::RBRACKET; }
bool assigns(uint16_t type) {
  return type == Tok::ASSIGN || type == Tok::ARROW || type == Tok::SET_ASSIGN ||
         type == Tok::RESET_ASSIGN || type == Tok::REF_ASSIGN;
}

/// A token or a comment of the line.
struct Piece {
  std::string text;
  size_t width = 0;
  uint16_t type = 0;
  unsigned breakLevel = kNoBreak; ///< a line may end before it; the smaller, the sooner
  bool comment = false;
  bool blank = false;  ///< one before it
  bool forced = false; ///< a line must end before it
  bool toLineEnd = false;
  bool isUnary = false;
};

class LineLayout {
public:
  LineLayout(const std::vector<FormatItem> &items, const LineRequest &request,
             const FormatStyle &style)
      : items_(items), request_(request), style_(style),
        start_(size_t{request.level} * style.indent) {}

  std::string run() {
    makePieces();
    setBreaks();
    column_ = start_;
    const size_t inner = start_ + size_t{2} * style_.indent;
    const bool list = request_.kind == LineKind::Label || request_.kind == LineKind::Declaration;
    brackets_.push_back({list ? start_ : inner, inner});
    if (!request_.prefix.empty())
      write(request_.prefix + " ");
    for (at_ = 0; at_ < pieces_.size(); ++at_)
      place();
    return std::move(out_);
  }

private:
  struct Bracket {
    size_t content; ///< where its elements begin
    size_t operand; ///< where the expression begins
  };

  void makePieces() {
    unsigned depth = 0;
    bool forced = false; // after a comment that ends its line
    bool operand = false;
    for (size_t i = request_.from; i < request_.to; ++i) {
      const FormatItem &item = items_[i];
      if (i != request_.from) { // those of the first token stand before the line
        for (size_t k = 0; k < item.comments.size(); ++k) {
          const FormatComment &comment = item.comments[k];
          Piece piece;
          piece.text = commentText(comment.text);
          piece.comment = true;
          piece.blank = true;
          piece.forced = forced || comment.newlines > 0;
          piece.toLineEnd = comment.toLineEnd;
          add(std::move(piece));
          const unsigned behind =
              k + 1 < item.comments.size() ? item.comments[k + 1].newlines : item.newlines;
          forced = comment.toLineEnd || behind > 0;
        }
      }
      Piece piece;
      piece.type = item.type;
      piece.text = spelling(i);
      piece.forced = forced;
      forced = false;
      piece.isUnary = item.type == Tok::NOT ||
                      ((item.type == Tok::PLUS || item.type == Tok::MINUS) && !operand);
      piece.blank = i != request_.from && needsBlank(i, piece, depth);
      depth += opens(item.type);
      depth -= closes(item.type) && depth > 0;
      operand = endsOperand(item.type);
      add(std::move(piece));
    }
  }

  void add(Piece piece) {
    piece.width = widthOf(piece.text);
    pieces_.push_back(std::move(piece));
  }

  [[nodiscard]] std::string spelling(size_t i) const {
    const FormatItem &item = items_[i];
    std::string out(item.text);
    const bool assignment = item.type == Tok::SET_ASSIGN || item.type == Tok::RESET_ASSIGN ||
                            item.type == Tok::REF_ASSIGN;
    const bool type = item.type == Tok::IDENT && declares() && i > request_.from &&
                      isElementaryName(item.text) && isTypePlace(items_[i - 1].type);
    if (!type && !assignment && !isKeywordType(item.type))
      return out;
    if (style_.keywords == KeywordCase::Lower)
      out = lowerCase(out);
    else if (style_.keywords == KeywordCase::Upper)
      std::transform(out.begin(), out.end(), out.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
      });
    return out;
  }

  [[nodiscard]] bool declares() const {
    return request_.kind == LineKind::Declaration || request_.kind == LineKind::Head;
  }

  static bool isTypePlace(uint16_t before) {
    return before == Tok::COLON || before == Tok::OF || before == Tok::TO || before == Tok::REF_TO;
  }

  /// Between the last piece and item `i`, which becomes `piece`, inside of `depth` brackets.
  [[nodiscard]] bool needsBlank(size_t i, const Piece &piece, unsigned depth) const {
    const Piece &before = pieces_.back();
    switch (piece.type) {
    case Tok::SEMICOLON:
      return before.type == Tok::THEN || before.type == Tok::COLON;
    case Tok::COMMA:
    case Tok::RPAREN:
    case Tok::RBRACKET:
    case Tok::DOTDOT:
    case Tok::CARET:
      return false;
    case Tok::DOT: // `2 .5` is no number, and must not become one
      return before.type == Tok::INTEGER;
    case Tok::COLON:
      return before.comment || (request_.kind != LineKind::Label && request_.from < i &&
                                items_[request_.from].type != Tok::ACTION);
    default:
      break;
    }
    if (before.comment)
      return true;
    switch (before.type) {
    case Tok::LPAREN:
    case Tok::LBRACKET:
    case Tok::DOT:
    case Tok::DOTDOT:
      return false;
    case Tok::NOT:
      return true;
    case Tok::PLUS:
    case Tok::MINUS: // not `--`, which would be another sign
      return !before.isUnary || piece.type == before.type;
    default:
      break;
    }
    if (piece.type == Tok::LPAREN) {
      if (request_.kind == LineKind::Configuration && depth == 0)
        return true;
      switch (before.type) {
      case Tok::IDENT:
        return declares() && isIntegerName(before.text) && pieces_.size() > 1 &&
               isTypePlace(pieces_[pieces_.size() - 2].type);
      case Tok::RPAREN:
      case Tok::RBRACKET:
      case Tok::CARET:
      case Tok::STRING:
      case Tok::WSTRING:
      case Tok::CATCH:
        return false;
      default:
        return true;
      }
    }
    if (piece.type == Tok::LBRACKET)
      return !(before.type == Tok::IDENT || before.type == Tok::RPAREN ||
               before.type == Tok::RBRACKET || before.type == Tok::CARET ||
               before.type == Tok::ARRAY || before.type == Tok::STRING ||
               before.type == Tok::WSTRING);
    return true;
  }

  /// Where the line may be broken: after commas and operators.
  void setBreaks() {
    unsigned depth = 0;
    unsigned level = kNoBreak;
    for (Piece &piece : pieces_) {
      if (level != kNoBreak && !piece.toLineEnd) { // what is said at the end of a line stays there
        piece.breakLevel = level;
        level = kNoBreak;
      }
      depth += opens(piece.type);
      depth -= closes(piece.type) && depth > 0;
      if (piece.comment)
        continue;
      if (piece.type == Tok::COMMA)
        level = depth * kLevelsPerBracket + kComma;
      else if (const unsigned binding = bindingOf(piece.type); binding != 0 && !piece.isUnary)
        level = depth * kLevelsPerBracket + binding;
    }
  }

  /// Width of the pieces from `i` up to the next place of level `level` or below; no more than a
  /// little over the width of a line.
  [[nodiscard]] size_t chunk(size_t i, unsigned level) const {
    size_t width = pieces_[i].toLineEnd ? 0 : pieces_[i].width;
    for (size_t k = i + 1; k < pieces_.size() && width <= style_.width; ++k) {
      if (pieces_[k].breakLevel != kNoBreak && pieces_[k].breakLevel <= level)
        break;
      if (!pieces_[k].toLineEnd)
        width += pieces_[k].width + (pieces_[k].blank ? 1 : 0);
    }
    return width;
  }

  /// The widest element of the bracket whose content begins with piece `i`.
  [[nodiscard]] size_t widestElement(size_t i) const {
    size_t widest = 0;
    size_t width = 0;
    unsigned depth = 0;
    for (size_t k = i; k < pieces_.size() && widest <= style_.width; ++k) {
      const Piece &piece = pieces_[k];
      if (closes(piece.type) && depth-- == 0)
        return std::max(widest, width + 1);
      depth += opens(piece.type);
      if (!piece.toLineEnd)
        width += piece.width + (piece.blank && width != 0 ? 1 : 0);
      if (piece.type == Tok::COMMA && depth == 0) {
        widest = std::max(widest, width);
        width = 0;
      }
    }
    return widest;
  }

  void place() {
    const Piece &piece = pieces_[at_];
    const bool behindOpener = at_ > 0 && opens(pieces_[at_ - 1].type);
    Bracket &now = brackets_.back();
    const bool element = previous_ == Tok::COMMA;
    const size_t target = element || closes(piece.type) ? now.content : now.operand;
    if (piece.forced && at_ > 0) {
      newLine(target);
    } else if (behindOpener && !closes(piece.type) && !piece.comment) {
      // Elements that are too wide where the bracket stands begin on the next line.
      const size_t inner = lineStart_ + size_t{2} * style_.indent;
      const size_t widest = widestElement(at_);
      if (inner < column_ && column_ + widest > style_.width && inner + widest <= style_.width) {
        newLine(inner);
        now = {inner, inner};
      }
    } else if (piece.breakLevel != kNoBreak && target < column_ &&
               column_ + (piece.blank ? 1 : 0) + chunk(at_, piece.breakLevel) > style_.width) {
      newLine(target);
    }
    if (piece.type == Tok::COLON && brackets_.size() == 1 && request_.colon != 0 && !sawColon_) {
      sawColon_ = true;
      const size_t wanted = start_ + request_.colon;
      if (column_ + 1 < wanted)
        write(std::string(wanted - column_ - 1, ' '));
    }
    if (piece.blank && at_ > 0 && !freshLine_)
      write(" ");
    if (element && !piece.comment)
      now.operand = column_;
    write(piece.text);
    freshLine_ = false;
    if (piece.comment)
      return;
    previous_ = piece.type;
    follow(piece);
  }

  /// What the piece changes for those after it.
  void follow(const Piece &piece) {
    Bracket &now = brackets_.back();
    if (opens(piece.type)) {
      brackets_.push_back({column_, column_});
    } else if (closes(piece.type)) {
      if (brackets_.size() > 1)
        brackets_.pop_back();
    } else if (assigns(piece.type)) {
      now.operand = column_ + 1;
      if (brackets_.size() == 1)
        now.content = column_ + 1;
    } else if (at_ == 0 && isKeywordType(piece.type)) { // IF, WHILE, CASE …
      now.operand = column_ + 1;
    }
  }

  void newLine(size_t column) {
    out_ += '\n';
    const size_t level = std::min(column, start_);
    out_ += style_.tabs ? std::string(level / style_.indent, '\t') : std::string(level, ' ');
    out_.append(column - level, ' ');
    column_ = lineStart_ = column;
    freshLine_ = true;
  }

  void write(const std::string &text) {
    if (column_ == start_ && out_.empty())
      lineStart_ = start_;
    out_ += text;
    const size_t newline = text.rfind('\n');
    column_ = newline == std::string::npos ? column_ + widthOf(text)
                                           : widthOf(std::string_view(text).substr(newline + 1));
  }

  const std::vector<FormatItem> &items_;
  const LineRequest &request_;
  const FormatStyle &style_;
  size_t start_; ///< column of the indentation
  std::vector<Piece> pieces_;
  std::vector<Bracket> brackets_; ///< the first one stands for the line
  size_t at_ = 0;
  size_t column_ = 0;
  size_t lineStart_ = 0;
  uint16_t previous_ = 0; ///< type of the last token
  bool sawColon_ = false;
  bool freshLine_ = false;
  std::string out_;
};

} // namespace

std::string indentation(const FormatStyle &style, unsigned level) {
  return style.tabs ? std::string(level, '\t') : std::string(size_t{level} * style.indent, ' ');
}

size_t widthOf(std::string_view text) {
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string commentText(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r' || i + 1 == text.size() || text[i + 1] != '\n')
      out += text[i];
  return out;
}

std::string layLine(const std::vector<FormatItem> &items, const LineRequest &request,
                    const FormatStyle &style) {
  return LineLayout(items, request, style).run();
}

} // namespace stc
