// How a file is cut into units: VAR sections, TYPE blocks and groups of statements.
#include "compiler/syntax/file_parser.hpp"

#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

namespace {

/// A unit of statements or declarations ends at the next boundary behind that many tokens.
constexpr std::size_t kUnitTokens = 2048;

} // namespace

// -------------------------------------------------------------------------------------------------
// declarations

void FileParser::sections(std::vector<ast::VarDecl *> &out) {
  unit_.clear();
  take();
  while (now_.type >= Tok::CONSTANT && now_.type <= Tok::NON_RETAIN)
    take();
  std::vector<Token> head = unit_;
  for (Token &token : head)
    token.triviaCount = 0;
  const auto parseSection = [&] {
    auto *unit = parseUnit(&Grammar::sectionUnit);
    if (unit != nullptr && !unit->children.empty())
      builder_.section(static_cast<Grammar::VarSectionContext *>(unit->children[0]), out);
  };
  unsigned depth = 0; // of brackets
  unsigned types = 0; // ARRAY OF, POINTER TO in one declaration
  std::size_t start = unit_.size();
  for (;;) {
    if (endsPou() || startsDeclaration() || startsSection() ||
        (isConstruct(now_.type) && ahead_.type == Tok::IDENT) ||
        (startsBlock(now_.type) && ahead_.type != Tok::COLON && ahead_.type != Tok::COMMA))
      break;
    switch (now_.type) {
    case Tok::LPAREN:
    case Tok::LBRACKET:
      ++depth;
      break;
    case Tok::RPAREN:
    case Tok::RBRACKET:
      depth -= depth > 0;
      break;
    case Tok::ARRAY:
    case Tok::POINTER:
    case Tok::REFERENCE:
      ++types;
      break;
    default:
      break;
    }
    const std::uint16_t type = now_.type;
    if (depth + types > kMaxNesting) {
      diagnostics_.report(Code::tooDeep, span(now_), "this declaration is nested too deeply",
                          "deeper than " + std::to_string(kMaxNesting));
      unit_.resize(start);
      while (now_.type != Tok::SEMICOLON && now_.type != Tok::END_VAR && !endsPou() &&
             !startsDeclaration())
        advance();
      if (now_.type == Tok::SEMICOLON)
        advance();
      depth = types = 0;
      continue;
    }
    take();
    if (type == Tok::END_VAR)
      break;
    if (type == Tok::SEMICOLON) {
      types = depth = 0;
      start = unit_.size();
      if (unit_.size() >= kUnitTokens) {
        Token end = now_;
        end.type = Tok::END_VAR;
        end.end = end.begin;
        end.triviaCount = 0;
        unit_.push_back(end);
        parseSection();
        unit_ = head;
        start = unit_.size();
      }
    }
  }
  parseSection();
}

void FileParser::globals() {
  auto *node = arena_.make<ast::GlobalsDecl>();
  node->kind = ast::DeclKind::globals;
  node->attributes = builder_.attributes(now_);
  node->doc = builder_.doc(now_);
  const std::uint32_t begin = now_.begin;
  std::vector<ast::VarDecl *> variables;
  sections(variables);
  node->span = {file_.id(), begin, unit_[unit_.size() >= 2 ? unit_.size() - 2 : 0].end};
  node->variables = arena_.copy(variables);
  declarations_.push_back(node);
}

void FileParser::types() {
  unit_.clear();
  take();
  Token head = unit_.front();
  head.triviaCount = 0;
  const auto parseTypes = [&] {
    auto *unit = parseUnit(&Grammar::typeUnit);
    if (unit != nullptr && !unit->children.empty())
      builder_.types(static_cast<Grammar::TypeBlockContext *>(unit->children[0]), declarations_);
  };
  unsigned depth = 0;
  unsigned chain = 0;
  bool inStruct = false;
  std::size_t start = unit_.size();
  for (bool first = true;; first = false) {
    if ((!first && startsDeclaration()) || endsPou() || startsSection())
      break;
    switch (now_.type) {
    case Tok::LPAREN:
    case Tok::LBRACKET:
      ++depth;
      break;
    case Tok::RPAREN:
    case Tok::RBRACKET:
      depth -= depth > 0;
      break;
    case Tok::ARRAY:
    case Tok::POINTER:
    case Tok::REFERENCE:
      ++chain;
      break;
    case Tok::STRUCT:
    case Tok::UNION:
      inStruct = inStruct || ahead_.type != Tok::COLON;
      break;
    case Tok::END_STRUCT:
    case Tok::END_UNION:
      inStruct = false;
      break;
    default:
      break;
    }
    const std::uint16_t type = now_.type;
    if (depth + chain > kMaxNesting) {
      diagnostics_.report(Code::tooDeep, span(now_), "this declaration is nested too deeply",
                          "deeper than " + std::to_string(kMaxNesting));
      unit_.resize(start);
      while (now_.type != Tok::SEMICOLON && now_.type != Tok::END_TYPE && !endsPou() &&
             !startsDeclaration())
        advance();
      if (now_.type == Tok::SEMICOLON)
        advance();
      depth = chain = 0;
      continue;
    }
    take();
    if (type == Tok::END_TYPE)
      break;
    if (type == Tok::SEMICOLON) {
      chain = depth = 0;
      start = unit_.size();
      if (!inStruct && unit_.size() >= kUnitTokens && now_.type != Tok::SEMICOLON) {
        Token end = now_;
        end.type = Tok::END_TYPE;
        end.end = end.begin;
        end.triviaCount = 0;
        unit_.push_back(end);
        parseTypes();
        unit_.assign(1, head);
        start = unit_.size();
      }
    }
  }
  parseTypes();
}

// ---------------------------------------------------------------------------------------------------
// statements

void FileParser::body(std::vector<ast::Stmt *> &out) {
  readStatements();
  auto *unit = parseUnit(&Grammar::bodyUnit);
  if (unit != nullptr && !unit->children.empty())
    builder_.statements(static_cast<Grammar::StatementsContext *>(unit->children[0]), out);
}

/// Puts a LABEL in front of the CASE labels that end at the colon just ahead.
void FileParser::markLabel() {
  if (std::find(blocks_.begin(), blocks_.end(), std::uint16_t{Tok::CASE}) == blocks_.end() ||
      ahead_.type == Tok::EQUAL || boundary_ >= unit_.size())
    return;
  // With a `;` missing in front of the label, it begins where two operands meet.
  std::size_t begin = boundary_;
  bool assignment = false;
  for (std::size_t i = boundary_; i < unit_.size(); ++i) {
    if (i > boundary_ && isOperandEnd(unit_[i - 1].type) && isOperandStart(unit_[i].type)) {
      begin = i;
      assignment = false;
    }
    assignment |= unit_[i].type == Tok::ASSIGN;
  }
  if (assignment)
    return;
  Token label = unit_[begin];
  label.type = Tok::LABEL;
  label.end = label.begin;
  label.triviaCount = 0;
  unit_.insert(unit_.begin() + static_cast<std::ptrdiff_t>(begin), label);
}

/// Skips `__TRY`, `__CATCH (…)`, `__FINALLY` and `__ENDTRY`; the first of them is reported.
bool FileParser::skipExceptionWord() {
  const std::string_view word = scanner_.text(now_);
  if (!word.starts_with("__"))
    return false;
  const auto is = [&](std::string_view upper) {
    return std::equal(word.begin(), word.end(), upper.begin(), upper.end(), [](char a, char b) {
      return (a >= 'a' && a <= 'z' ? static_cast<char>(a - 'a' + 'A') : a) == b;
    });
  };
  const bool opens = is("__TRY");
  const bool handles = is("__CATCH");
  if (!opens && !handles && !is("__FINALLY") && !is("__ENDTRY"))
    return false;
  if (opens)
    diagnostics_.report(Code::notSupported, span(now_), "`__TRY` is not supported by this version");
  advance();
  if (handles && now_.type == Tok::LPAREN) {
    while (now_.type != Tok::RPAREN && now_.type != Tok::SEMICOLON && !endsPou())
      advance();
    if (now_.type == Tok::RPAREN)
      advance();
  }
  if (now_.type == Tok::SEMICOLON)
    advance();
  return true;
}

void FileParser::readStatements() {
  unit_.clear();
  blocks_.clear();
  brackets_ = 0;
  boundary_ = statement_ = 0;
  bool dropping = false;
  for (;;) {
    const std::uint16_t type = now_.type;
    if (endsPou() || startsDeclaration() || startsSection() || isConstruct(type))
      break;
    if (unit_.size() >= kUnitTokens && unit_.size() == statement_)
      break;
    const std::uint16_t opener = openerOf(type);
    if (opener != 0) {
      const auto open = std::find(blocks_.rbegin(), blocks_.rend(), opener);
      if (open != blocks_.rend())
        blocks_.erase(std::prev(open.base()), blocks_.end());
      brackets_ = 0;
    } else if (startsBlock(type)) {
      blocks_.push_back(type);
      brackets_ = 0;
    } else if (type == Tok::SEMICOLON) {
      brackets_ = 0;
    } else if (type == Tok::LPAREN || type == Tok::LBRACKET) {
      ++brackets_;
    } else if (type == Tok::RPAREN || type == Tok::RBRACKET) {
      brackets_ -= brackets_ > 0;
    } else if (type == Tok::COLON && brackets_ == 0 && !dropping) {
      const std::size_t before = unit_.size();
      markLabel();
      if (unit_.size() == before && before == boundary_ + 1 && unit_.back().type == Tok::IDENT &&
          ahead_.type != Tok::EQUAL) {
        diagnostics_.report(Code::notSupported, span(unit_.back()),
                            "a jump label is not supported by this version");
        unit_.pop_back();
        advance();
        continue;
      }
    } else if (type == Tok::JMP) {
      diagnostics_.report(Code::notSupported, span(now_), "JMP is not supported by this version");
      advance();
      if (now_.type == Tok::IDENT)
        advance();
      continue;
    } else if (type == Tok::IDENT && skipExceptionWord()) {
      continue;
    }
    if (dropping)
      advance();
    else
      take();
    if (blocks_.size() + brackets_ > kMaxNesting && !dropping) {
      if (!reportedDepth_)
        diagnostics_.report(Code::tooDeep, span(unit_.back()),
                            "this statement is nested too deeply",
                            "deeper than " + std::to_string(kMaxNesting));
      reportedDepth_ = true;
      unit_.resize(statement_);
      dropping = true;
    }
    const bool ends = type == Tok::SEMICOLON || opener != 0;
    if (ends || type == Tok::THEN || type == Tok::DO || type == Tok::OF || type == Tok::ELSE ||
        type == Tok::REPEAT || type == Tok::COLON)
      boundary_ = unit_.size();
    if (ends && blocks_.empty() && (type == Tok::SEMICOLON || now_.type != Tok::SEMICOLON)) {
      dropping = false;
      statement_ = boundary_ = unit_.size();
    }
  }
}

} // namespace stc
