// How a file is cut into units: VAR sections, TYPE blocks and groups of statements.
#include "compiler/syntax/file_parser.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

namespace {

/// A unit of statements or declarations ends at the next boundary after that many tokens.
constexpr size_t kUnitTokens = 2048;

} // namespace

// -------------------------------------------------------------------------------------------------
// declarations

void FileParser::Nesting::count(uint16_t type) {
  switch (type) {
  case Tok::LPAREN:
  case Tok::LBRACKET:
    ++brackets;
    return;
  case Tok::RPAREN:
  case Tok::RBRACKET:
    brackets -= brackets > 0;
    return;
  case Tok::ARRAY:
  case Tok::POINTER:
  case Tok::REFERENCE:
  case Tok::REF_TO:
    ++types;
    return;
  default:
    return;
  }
}

bool FileParser::Nesting::isTooDeep() const { return brackets + types > kMaxNesting; }

void FileParser::leaveOut(size_t start, uint16_t end) {
  diagnostics_.report(Code::TooDeep, span(now_), "this declaration is nested too deeply",
                      "deeper than " + std::to_string(kMaxNesting));
  unit_.resize(start);
  while (now_.type != Tok::SEMICOLON && now_.type != end && !endsUnit() && !startsDeclaration())
    advance();
  if (now_.type == Tok::SEMICOLON)
    advance();
}

void FileParser::closeUnit(uint16_t end) {
  Token token = now_;
  token.type = end;
  token.end = token.begin;
  token.triviaCount = 0;
  unit_.push_back(token);
}

/// `start`: where the unit's last declaration begins.
bool FileParser::endsSection(size_t start) const {
  return endsUnit() || startsDeclaration() || startsSection() ||
         (isMember(now_.type) && ahead_.type == Tok::IDENT) ||
         (startsBlock(now_.type) && ahead_.type != Tok::COLON && ahead_.type != Tok::COMMA) ||
         (unit_.size() == start && unit_.front().type != Tok::VAR_CONFIG &&
          startsStatementInSection());
}

/// READ_ONLY and READ_WRITE are words of VAR_ACCESS only.
void FileParser::markAccess() {
  if (now_.type != Tok::IDENT || ahead_.type != Tok::SEMICOLON)
    return;
  if (isNow("read_only"))
    now_.type = Tok::READ_ONLY;
  else if (isNow("read_write"))
    now_.type = Tok::READ_WRITE;
}

/// R_EDGE and F_EDGE are words after a type only.
void FileParser::markEdge() {
  if (now_.type != Tok::IDENT || unit_.back().type != Tok::IDENT)
    return;
  if (isNow("r_edge"))
    now_.type = Tok::R_EDGE;
  else if (isNow("f_edge"))
    now_.type = Tok::F_EDGE;
}

void FileParser::sections(std::vector<ast::VarDecl *> &out) {
  unit_.clear();
  take();
  while ((now_.type >= Tok::CONSTANT && now_.type <= Tok::NON_RETAIN) || isModifier(now_.type))
    take();
  const bool isAccess = unit_.front().type == Tok::VAR_ACCESS;
  std::vector<Token> head = unit_;
  for (Token &token : head)
    token.triviaCount = 0;
  const auto parseSection = [&] {
    auto *unit = parseUnit(&Grammar::sectionUnit);
    if (unit != nullptr && !unit->children.empty())
      builder_.section(static_cast<Grammar::VarSectionContext *>(unit->children[0]), out);
  };
  Nesting nesting;
  size_t start = unit_.size();
  while (!endsSection(start)) {
    nesting.count(now_.type);
    if (isAccess)
      markAccess();
    markTypeArgument();
    markEdge();
    const uint16_t type = now_.type;
    if (nesting.isTooDeep()) {
      leaveOut(start, Tok::END_VAR);
      nesting = {};
      continue;
    }
    take();
    if (type == Tok::END_VAR)
      break;
    if (type != Tok::SEMICOLON)
      continue;
    nesting = {};
    start = unit_.size();
    if (unit_.size() >= kUnitTokens) {
      closeUnit(Tok::END_VAR);
      parseSection();
      unit_ = head;
      start = unit_.size();
    }
  }
  parseSection();
}

void FileParser::globals(const ast::PouDecl *program) {
  auto *node = arena_.make<ast::GlobalsDecl>();
  node->program = program;
  node->kind = now_.type == Tok::VAR_CONFIG   ? ast::DeclKind::Config
               : now_.type == Tok::VAR_ACCESS ? ast::DeclKind::Access
                                              : ast::DeclKind::Globals;
  node->attributes = builder_.attributes(now_);
  node->doc = builder_.doc(now_);
  const uint32_t begin = now_.begin;
  std::vector<ast::VarDecl *> variables;
  sections(variables);
  node->span = {file_.id(), begin, unit_[unit_.size() >= 2 ? unit_.size() - 2 : 0].end};
  node->variables = arena_.copy(variables);
  add(node);
}

void FileParser::types() {
  unit_.clear();
  take();
  Token head = unit_.front();
  head.triviaCount = 0;
  const auto parseTypes = [&] {
    auto *unit = parseUnit(&Grammar::typeUnit);
    std::vector<ast::Decl *> list;
    if (unit != nullptr && !unit->children.empty())
      builder_.types(static_cast<Grammar::TypeBlockContext *>(unit->children[0]), list);
    for (ast::Decl *one : list)
      add(one);
  };
  Nesting nesting;
  bool inStruct = false;
  size_t start = unit_.size();
  for (bool first = true;
       (first || !(startsDeclaration() || isMember(now_.type))) && !endsUnit() && !startsSection();
       first = false) {
    nesting.count(now_.type);
    if (now_.type == Tok::STRUCT || now_.type == Tok::UNION)
      inStruct = inStruct || ahead_.type != Tok::COLON;
    else if (now_.type == Tok::END_STRUCT || now_.type == Tok::END_UNION)
      inStruct = false;
    markTypeArgument();
    const uint16_t type = now_.type;
    if (nesting.isTooDeep()) {
      leaveOut(start, Tok::END_TYPE);
      nesting = {};
      continue;
    }
    take();
    if (type == Tok::END_TYPE)
      break;
    if (type != Tok::SEMICOLON)
      continue;
    nesting = {};
    start = unit_.size();
    if (!inStruct && unit_.size() >= kUnitTokens && now_.type != Tok::SEMICOLON) {
      closeUnit(Tok::END_TYPE);
      parseTypes();
      unit_.assign(1, head);
      start = unit_.size();
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

/// A type that begins with a keyword after `SIZEOF(` and the like gets a TYPE_ARGUMENT in front.
void FileParser::markTypeArgument() {
  if (!startsWrittenType(now_.type))
    return;
  const size_t size = unit_.size();
  if (size < 2 || unit_[size - 1].type != Tok::LPAREN || unit_[size - 2].type != Tok::IDENT)
    return;
  static constexpr std::string_view kTakers[] = {"sizeof", "xsizeof", "__new"};
  const std::string_view word = scanner_.text(unit_[size - 2]);
  if (std::none_of(std::begin(kTakers), std::end(kTakers),
                   [&](std::string_view name) { return isWord(word, name); }))
    return;
  Token mark = now_;
  mark.type = Tok::TYPE_ARGUMENT;
  mark.end = mark.begin;
  mark.triviaCount = 0;
  unit_.push_back(mark);
}

/// True when some JMP of the file names it.
bool FileParser::isJumpTarget(const Token &name) {
  if (!jumpTargets_) {
    jumpTargets_.emplace();
    Diagnostics ignored;
    Scanner scanner(file_, ignored);
    bool jump = false;
    for (Token token = scanner.next(); token.type != Token::kEnd; token = scanner.next()) {
      if (jump && token.type == Tok::IDENT)
        jumpTargets_->insert(lowerCase(scanner.text(token)));
      jump = token.type == Tok::JMP;
    }
  }
  return jumpTargets_->contains(lowerCase(scanner_.text(name)));
}

/// A type that no statement can begin with.
bool FileParser::isElementaryType(const Token &token) const {
  static constexpr std::string_view kNames[] = {
      "bool",  "sint", "int",   "dint",  "lint", "usint", "uint",  "udint",       "ulint",
      "byte",  "word", "dword", "lword", "real", "lreal", "time",  "ltime",       "date",
      "ldate", "tod",  "ltod",  "dt",    "ldt",  "char",  "wchar", "time_of_day", "date_and_time"};
  switch (token.type) {
  case Tok::ARRAY:
  case Tok::STRING:
  case Tok::WSTRING:
  case Tok::POINTER:
  case Tok::REFERENCE:
  case Tok::REF_TO:
    return true;
  case Tok::IDENT:
    return std::any_of(std::begin(kNames), std::end(kNames),
                       [&](std::string_view name) { return isWord(scanner_.text(token), name); });
  default:
    return false;
  }
}

/// True when END_VAR comes before the next section or the end of the POU: in a text with an error,
/// so that only the words are looked at.
bool FileParser::sectionIsClosed() const {
  const std::string_view text = scanner_.text();
  for (size_t at = now_.begin; at < text.size();) {
    if (!isLetter(text[at])) {
      ++at;
      continue;
    }
    const size_t begin = at;
    while (at < text.size() && isWordChar(text[at]))
      ++at;
    const std::string_view word = text.substr(begin, at - begin);
    const uint16_t type = findKeyword(word, hashIdent(word)).type;
    if (type == Tok::END_VAR)
      return true;
    if ((type >= Tok::VAR && type <= Tok::VAR_INST) || (type != 0 && closesUnit(type)))
      return false;
  }
  return false;
}

/// Where the declarations of a section seem to have turned into statements.
bool FileParser::startsStatementInSection() const {
  if (now_.type != Tok::IDENT)
    return false;
  switch (ahead_.type) {
  case Tok::ASSIGN:
  case Tok::LPAREN:
  case Tok::DOT:
  case Tok::LBRACKET:
  case Tok::CARET:
    return !sectionIsClosed();
  default:
    return false;
  }
}

/// Puts a LABEL before the CASE labels that end at the colon just ahead, or a JUMP_LABEL in
/// front of the name. True: it did.
bool FileParser::markLabel() {
  if (ahead_.type == Tok::EQUAL || boundary_ >= unit_.size())
    return false;
  const bool inCase =
      std::find(blocks_.begin(), blocks_.end(), uint16_t{Tok::CASE}) != blocks_.end();
  const bool plain = boundary_ + 1 == unit_.size() && unit_.back().type == Tok::IDENT;
  const auto insert = [&](size_t at, uint16_t type) {
    Token label = unit_[at];
    label.type = type;
    label.end = label.begin;
    label.triviaCount = 0;
    unit_.insert(unit_.begin() + static_cast<ptrdiff_t>(at), label);
    return true;
  };
  if (plain && (!inCase || isJumpTarget(unit_.back())))
    return insert(boundary_, Tok::JUMP_LABEL);
  if (!inCase)
    return false;
  // With a `;` missing before the label, it begins where two operands meet.
  size_t begin = boundary_;
  bool assignment = false;
  for (size_t i = boundary_; i < unit_.size(); ++i) {
    if (i > boundary_ && isOperandEnd(unit_[i - 1].type) && isOperandStart(unit_[i].type)) {
      begin = i;
      assignment = false;
    }
    assignment |= unit_[i].type == Tok::ASSIGN;
  }
  return !assignment && insert(begin, Tok::LABEL);
}

/// Whether statements end before the current token, or so many were read that a unit is full.
inline bool FileParser::endsStatements() const {
  const uint16_t type = now_.type;
  if (endsUnit() || startsDeclaration() || startsSection() || isMember(type) || isChart(type))
    return true;
  if (unit_.size() == boundary_ && startsRanked())
    return true;
  if (unit_.size() == boundary_ && startsAccessor())
    return true;
  return unit_.size() >= kUnitTokens && unit_.size() == statement_;
}

/// Counts what the current token opens or closes.
inline void FileParser::nest() {
  const uint16_t type = now_.type;
  if (const uint16_t opener = openerOf(type); opener != 0) {
    const auto open = std::find(blocks_.rbegin(), blocks_.rend(), opener);
    if (open != blocks_.rend())
      blocks_.erase(std::prev(open.base()), blocks_.end());
    brackets_ = 0;
  } else if (startsBlock(type)) {
    blocks_.push_back(type);
    brackets_ = 0;
  } else if (type == Tok::SEMICOLON || type == Tok::OF) { // labels come after `CASE (n OF`, too
    brackets_ = 0;
  } else if (type == Tok::LPAREN || type == Tok::LBRACKET) {
    ++brackets_;
  } else if (type == Tok::RPAREN || type == Tok::RBRACKET) {
    brackets_ -= brackets_ > 0;
  }
}

/// `x : INT;` among statements, of which the name was taken for a jump's label.
void FileParser::leaveOutDeclaration() {
  builder_.declarationInBody(builder_.name(unit_.back()));
  unit_.resize(boundary_);
  while (now_.type != Tok::SEMICOLON && !endsUnit() && !startsDeclaration() && !startsSection())
    advance();
  if (now_.type == Tok::SEMICOLON)
    advance();
}

/// `__CATCH` without a variable gets the brackets that the grammar wants.
void FileParser::addBrackets() {
  for (const uint16_t bracket : {Tok::LPAREN, Tok::RPAREN}) {
    Token token = now_;
    token.type = bracket;
    token.end = token.begin;
    token.triviaCount = 0;
    unit_.push_back(token);
  }
}

/// Reports that the current statement is nested too deeply, and takes it out of the unit.
void FileParser::dropStatement() {
  if (!reportedDepth_)
    diagnostics_.report(Code::TooDeep, span(unit_.back()), "this statement is nested too deeply",
                        "deeper than " + std::to_string(kMaxNesting));
  reportedDepth_ = true;
  unit_.resize(statement_);
}

void FileParser::readStatements() {
  unit_.clear();
  blocks_.clear();
  brackets_ = 0;
  boundary_ = statement_ = 0;
  bool dropping = false; // to the end of a statement that is left out
  while (!endsStatements()) {
    const uint16_t type = now_.type;
    const bool colon = type == Tok::COLON && brackets_ == 0 && !dropping;
    const bool isLabel = colon && markLabel();
    if (isLabel && unit_[boundary_].type == Tok::JUMP_LABEL && isElementaryType(ahead_)) {
      leaveOutDeclaration();
      continue;
    }
    nest();
    markTypeArgument();
    if (dropping)
      advance();
    else
      take();
    if (type == Tok::CATCH && now_.type != Tok::LPAREN && !dropping)
      addBrackets();
    if (blocks_.size() + brackets_ > kMaxNesting && !dropping) {
      dropStatement();
      dropping = true;
    }
    const bool ends = type == Tok::SEMICOLON || openerOf(type) != 0 || (isLabel && blocks_.empty());
    if (ends || type == Tok::THEN || type == Tok::DO || type == Tok::OF || type == Tok::ELSE ||
        type == Tok::REPEAT || type == Tok::COLON || type == Tok::TRY || type == Tok::FINALLY)
      boundary_ = unit_.size();
    if (ends && blocks_.empty() && (type == Tok::SEMICOLON || now_.type != Tok::SEMICOLON)) {
      dropping = false;
      statement_ = boundary_ = unit_.size();
    }
  }
}

} // namespace stc
