// What programmers of other languages write: one clear report, then the text is read as it was
// meant.
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/scanner.hpp"
#include "compiler/syntax/token_sets.hpp"
#include "compiler/syntax/unit_parser.hpp"

#include <algorithm>

namespace stc {

namespace {

struct Misspelled {
  std::string_view lower;
  uint16_t meant;
};

constexpr Misspelled kJoined[] = {
    {"endif", Tok::END_IF},           {"endfor", Tok::END_FOR},
    {"endwhile", Tok::END_WHILE},     {"endcase", Tok::END_CASE},
    {"endrepeat", Tok::END_REPEAT},   {"endvar", Tok::END_VAR},
    {"endprogram", Tok::END_PROGRAM}, {"endfunction", Tok::END_FUNCTION},
    {"endtype", Tok::END_TYPE},       {"endstruct", Tok::END_STRUCT},
    {"elseif", Tok::ELSIF},           {"elif", Tok::ELSIF}};

constexpr Misspelled kSecondWords[] = {
    {"if", Tok::END_IF},           {"for", Tok::END_FOR},           {"while", Tok::END_WHILE},
    {"case", Tok::END_CASE},       {"repeat", Tok::END_REPEAT},     {"var", Tok::END_VAR},
    {"program", Tok::END_PROGRAM}, {"function", Tok::END_FUNCTION}, {"type", Tok::END_TYPE},
    {"struct", Tok::END_STRUCT}};

template <size_t n> uint16_t findWord(const Misspelled (&list)[n], std::string_view word) {
  for (const Misspelled &entry : list)
    if (isWord(word, entry.lower))
      return entry.meant;
  return 0;
}

/// Where a statement or the end of a block may begin.
bool beforeStatement(uint16_t previous) {
  switch (previous) {
  case Tok::SEMICOLON:
  case Tok::THEN:
  case Tok::DO:
  case Tok::ELSE:
  case Tok::REPEAT:
  case Tok::COLON:
  case Tok::OF:
  case Tok::VAR:
  case Tok::END_IF:
  case Tok::END_FOR:
  case Tok::END_WHILE:
  case Tok::END_CASE:
  case Tok::END_REPEAT:
  case Tok::END_VAR:
    return true;
  default:
    return false;
  }
}

} // namespace

/// `ENDIF`, `END IF`, `ELSEIF`: the keyword that is meant, or 0.
uint16_t Scanner::misspelledKeyword(size_t begin, std::string_view spelling, Token &token) {
  if (spelling.size() < 3 || spelling.size() > 11 || !beforeStatement(previous_))
    return 0;
  const size_t next = significant(place_);
  size_t end = place_;
  uint16_t meant = 0;
  if (isWord(spelling, "end")) {
    const std::string_view second = wordAt(next);
    meant = findWord(kSecondWords, second);
    end = next + second.size();
  } else {
    meant = findWord(kJoined, spelling);
    // A variable may have such a name.
    const bool isName = std::string_view(":.[=^(,").find(at(next)) != std::string_view::npos;
    if (meant == 0 || (isName && meant != Tok::ELSIF) || (isName && at(next) != '('))
      return 0;
  }
  if (meant == 0)
    return 0;
  place_ = end;
  token.reported = true;
  const std::string right(tokenSpelling(meant));
  diagnostics_
      .report(Code::MisspelledKeyword, span(begin, end),
              "`" + std::string(text_.substr(begin, end - begin)) + "` is written `" + right + "`",
              "not a keyword")
      .suggest("write `" + right + "`", span(begin, end), right);
  return meant;
}

/// The target of `x += 1`: what stands before it on its line, or `…`.
std::string Scanner::targetBefore(size_t place) const {
  size_t begin = place;
  while (begin > 0 &&
         (isWordChar(text_[begin - 1]) || text_[begin - 1] == '.' || text_[begin - 1] == '[' ||
          text_[begin - 1] == ']' || text_[begin - 1] == ' ')) {
    --begin;
  }
  std::string_view target = text_.substr(begin, place - begin);
  while (!target.empty() && target.front() == ' ')
    target.remove_prefix(1);
  while (!target.empty() && target.back() == ' ')
    target.remove_suffix(1);
  const bool one = target.find(' ') == std::string_view::npos;
  return target.empty() || target.size() > 40 || !one ? "…" : std::string(target);
}

uint16_t Scanner::foreignSign(size_t begin, size_t length, uint16_t meant, Token &token,
                              std::string help) {
  place_ = begin + length;
  token.reported = true;
  diagnostics_
      .report(Code::ForeignOperator, span(begin, place_),
              "`" + std::string(text_.substr(begin, length)) +
                  "` is not an operator of Structured Text",
              "not known here")
      .help(std::move(help));
  return meant;
}

/// Signs of two characters that Structured Text does not have; 0 when it is none of them.
uint16_t Scanner::foreignPair(size_t begin, Token &token) {
  const char first = text_[begin];
  const char next = at(begin + 1);
  const std::string target = targetBefore(begin);
  if (next == '=' && (first == '+' || first == '-' || first == '*'))
    return foreignSign(begin, 2, Tok::ASSIGN, token,
                       "write `" + target + " := " + target + " " + first + " …`");
  const char behind = at(significant(begin + 2));
  if (next == first && (first == '+' || first == '-') && afterOperand() &&
      (behind == ';' || behind == ')'))
    return foreignSign(begin, 2, Tok::ASSIGN, token,
                       "write `" + target + " := " + target + " " + first + " 1`");
  if (next == first && (first == '<' || first == '>'))
    return foreignSign(begin, 2, Tok::STAR, token,
                       std::string("shift bits with `") + (first == '<' ? "SHL" : "SHR") +
                           "(value, count)`");
  if (first == '-' && next == '>' && isLetter(at(begin + 2))) {
    pending_ = Tok::DOT;
    return foreignSign(begin, 2, Tok::CARET, token,
                       "follow the pointer, then name the member: `" + target + "^." +
                           std::string(wordAt(begin + 2)) + "`");
  }
  if (first == '=' && next == '<')
    return foreignSign(begin, 2, Tok::LESS_EQUAL, token, "write `<=`");
  return 0;
}

/// `{ a := 1; }`: braces hold pragmas, so the statements would silently be left out.
void Scanner::bracesAsBlock(size_t begin, size_t end) {
  const std::string_view content = text_.substr(begin, end - begin);
  if (content.find(';') == std::string_view::npos || content.find('\'') != std::string_view::npos ||
      (content.find(":=") == std::string_view::npos && content.find('(') == std::string_view::npos))
    return;
  auto &d = diagnostics_.report(Code::BracesAsBlock, span(begin, begin + 1),
                                "`{` begins a pragma, not a block of statements",
                                "what follows would be left out");
  d.label(span(end - 1, end), "up to here");
  d.help("blocks are closed by words: IF … THEN … END_IF, FOR … DO … END_FOR");
}

/// What else to say about text that the grammar does not take.
std::string ReportStrategy::foreignHelp(const Token &found, const Token *previous,
                                        const Token *next) const {
  const auto is = [&](const Token *token, uint16_t type) {
    return token != nullptr && token->type == type;
  };
  const auto quoted = [&](const Token &token) { return std::string(spelling(token)); };
  if (is(previous, Tok::RETURN))
    return "RETURN takes no value: assign the result to the function's name first";
  if (is(previous, Tok::CARET))
    return "`^` follows a pointer; a power is written `**`";
  switch (found.type) {
  case Tok::AMPERSAND:
    return "the address of a variable is `ADR(…)`; `&` stands for AND";
  case Tok::STAR:
    return "a pointer is followed with `^` after it";
  case Tok::MOD:
    return "MOD stands between its operands: `a MOD b`";
  case Tok::EQUAL:
    return "an initial value is given with `:=`";
  case Tok::LBRACKET:
    return "an array is declared `ARRAY [0..9] OF …`";
  case Tok::RBRACKET:
    if (is(previous, Tok::INTEGER) && parser_.context()->getRuleIndex() == Grammar::RuleArrayRange)
      return "give both bounds: `[0.." + quoted(*previous) + "]`";
    break;
  case Tok::RPAREN:
    return "there is no `(` for it";
  case Tok::COMMA:
    if (is(previous, Tok::INTEGER) && is(next, Tok::INTEGER))
      return "the decimal point is a `.`: `" + quoted(*previous) + "." + quoted(*next) + "`";
    if (is(previous, Tok::IDENT) && is(next, Tok::IDENT))
      return "a declaration ends with `;`; names of one type stand before the colon: `a, b : "
             "INT;`";
    break;
  case Tok::IDENT:
  case Tok::INTEGER:
  case Tok::REAL:
    if (found.type == Tok::IDENT && is(previous, Tok::IDENT))
      return "variables are declared between VAR and END_VAR, the name first: `" + quoted(found) +
             " : " + quoted(*previous) + ";`";
    if (is(previous, Tok::IDENT))
      return "arguments stand in parentheses: `" + quoted(*previous) + "(…)`";
    break;
  default:
    break;
  }
  return {};
}

} // namespace stc
