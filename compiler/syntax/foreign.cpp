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

/// Between VAR and END_VAR, or in a TYPE: `before found`, of which one was meant for a keyword or
/// the name of a type.
std::string helpForTwoNames(std::string_view before, const std::string &found) {
  struct Meant {
    std::string_view lower;
    std::string_view help;
  };
  static constexpr Meant kMeant[] = {
      {"pointer", "a pointer is declared `POINTER TO …`"},
      {"reference", "a reference is declared `REFERENCE TO …`"},
      {"enum", "an enumeration is declared `TYPE Name : (first, second); END_TYPE`"},
      {"extend", "the base of a block stands after EXTENDS"},
      {"implement", "the interfaces of a block stand after IMPLEMENTS"},
      {"goto", "a jump is written `JMP label;`"},
      {"at", "an address begins with a %: `AT %IX0.0`"},
      {"array", "an array is declared `ARRAY [0..9] OF …`"},
  };
  for (const Meant &meant : kMeant)
    if (isWord(before, meant.lower))
      return std::string(meant.help);
  return "variables are declared between VAR and END_VAR, the name first: `" + found + " : " +
         std::string(before) + ";`";
}

/// A word that every programmer knows as a type.
bool isTypeWord(std::string_view word) {
  static constexpr std::string_view kTypes[] = {
      "bool",  "byte",  "word", "dword", "sint", "int",  "dint",  "lint",   "usint", "uint",
      "udint", "ulint", "real", "lreal", "time", "char", "float", "double", "string"};
  return std::any_of(std::begin(kTypes), std::end(kTypes),
                     [&](std::string_view type) { return isWord(word, type); });
}

/// `T#5`, which a unit follows after a blank.
bool isDurationPrefix(std::string_view text) {
  const size_t sign = text.find('#');
  const std::string_view type = text.substr(0, sign == std::string_view::npos ? 0 : sign);
  return isWord(type, "t") || isWord(type, "time") || isWord(type, "lt") || isWord(type, "ltime");
}

/// What else to say about text that the grammar does not take.
std::string ReportStrategy::foreignHelp(const Token &found, const Token *previous,
                                        const Token *next) const {
  const auto is = [&](const Token *token, uint16_t type) {
    return token != nullptr && token->type == type;
  };
  const auto quoted = [&](const Token &token) { return std::string(spelling(token)); };
  if (is(previous, Tok::RETURN) && found.type != Tok::COLON)
    return "RETURN takes no value: assign the result to the function's name first";
  if (is(previous, Tok::CARET))
    return "`^` follows a pointer; a power is written `**`";
  switch (found.type) {
  case Tok::AMPERSAND:
    return "the address of a variable is `ADR(…)`; `&` stands for AND";
  case Tok::COLON:
    if (is(previous, Tok::ELSE))
      return "ELSE stands without a colon";
    return insideBrackets()
               ? "a value is given with `:=`; what a FUNCTION takes is declared between "
                 "VAR_INPUT and END_VAR"
               : "an assignment is written `:=`";
  case Tok::SEMICOLON:
    if (is(previous, Tok::ASSIGN) &&
        text_.substr(previous->end, found.begin - previous->end).find('{') !=
            std::string_view::npos)
      return "braces hold pragmas; the values of an array stand in brackets: `[1, 2, 3]`";
    break;
  case Tok::MINUS:
    if (is(previous, Tok::IDENT) && is(next, Tok::IDENT))
      return "a name has no `-`: `" + quoted(*previous) + "_" + quoted(*next) + "`";
    break;
  case Tok::STAR:
    if (is(previous, Tok::COLON))
      return "a pointer is declared `POINTER TO …`";
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
    if (found.type == Tok::IDENT && previous != nullptr && isDurationPrefix(spelling(*previous)))
      return "there is no blank in a duration: `" + quoted(*previous) + quoted(found) + "`";
    if (is(previous, Tok::RPAREN) && previous->index > 0 &&
        isTypeWord(spelling(parser_.stream().token(previous->index - 1))))
      return "a value is converted with `TO_" +
             std::string(spelling(parser_.stream().token(previous->index - 1))) + "(…)`";
    if (found.type == Tok::IDENT && is(previous, Tok::IDENT) && is(next, Tok::COLON) &&
        !isTypeWord(spelling(*previous)))
      return "a name is one word: `" + quoted(*previous) + "_" + quoted(found) + "`";
    if (found.type == Tok::IDENT && is(previous, Tok::IDENT))
      return helpForTwoNames(spelling(*previous), quoted(found));
    if (is(previous, Tok::IDENT))
      return "arguments stand in parentheses: `" + quoted(*previous) + "(…)`";
    break;
  default:
    break;
  }
  return {};
}

/// `INT i;`, `my count : INT;`
std::string ReportStrategy::helpForTypeFirst(const Token &type, const Token &name) const {
  const std::string first(spelling(type));
  const std::string second(spelling(name));
  if (isTypeWord(first))
    return "the name stands before its type: `" + second + " : " + first + ";`";
  const bool colonFollows = name.index + 1 < parser_.stream().size() &&
                            parser_.stream().token(name.index + 1).type == Tok::COLON;
  return colonFollows && type.type == Tok::IDENT
             ? "a name is one word: `" + first + "_" + second + "`"
             : std::string();
}

} // namespace stc
