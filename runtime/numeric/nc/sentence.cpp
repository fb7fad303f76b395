#include "runtime/numeric/nc/sentence.hpp"

#include "runtime/numeric/cnc/decoder.hpp"
#include "runtime/numeric/nc/function_table.hpp"

namespace stride::nc {
namespace {

constexpr double kMostNumber = 4294967295.0; // 16#FFFFFFFF
constexpr int32_t kLeastName = 3;

/// A line being read, with its head.
struct Reading {
  LineTask &task;
  Parser parser;
  SentenceHead head;
};

bool isSymbol(const Token &token, uint16_t wanted) noexcept {
  return token.kind == TokenKind::Symbol && token.symbol == wanted;
}

bool failAt(Reading &in, Error error, const Token &token) noexcept {
  return fail(in.parser, token.kind == TokenKind::Bad ? token.error : error, token.at);
}

bool expect(Reading &in, bool good, const Token &token) noexcept {
  if (!good)
    return failAt(in, token.kind == TokenKind::End ? Error::Incomplete : Error::WrongToken, token);
  in.parser.at = token.end;
  return true;
}

bool expectEnd(Reading &in) noexcept {
  const Token token = peek(in.parser);
  return token.kind == TokenKind::End || failAt(in, Error::WrongToken, token);
}

/// `LREAL`, `BOOL` or `STRING`.
bool readType(Reading &in, ValueType &type) noexcept {
  const Token token = peek(in.parser);
  const ProgramLine &line = in.parser.line;
  if (isWordText(line, token, "LREAL"))
    type = ValueType::Real;
  else if (isWordText(line, token, "BOOL"))
    type = ValueType::Bool;
  else if (isWordText(line, token, "STRING"))
    type = ValueType::Text;
  else
    return failAt(in, token.kind == TokenKind::End ? Error::Incomplete : Error::BadType, token);
  in.parser.at = token.end;
  return true;
}

/// `#name : TYPE`; the name is new.
bool readDeclaration(Reading &in, Token &name, ValueType &type, Error twice) noexcept {
  name = peek(in.parser);
  if (!expect(in, name.kind == TokenKind::Local, name))
    return false;
  ValueType old{};
  if (findLocal(in.task.symbols, in.task.program.scope, in.parser.line, name, old) >= 0)
    return fail(in.parser, twice, name.at);
  const Token colon = peek(in.parser);
  return expect(in, isSymbol(colon, symbol(':')), colon) && readType(in, type);
}

bool declare(Reading &in, const Token &name, ValueType type, Error tooMany) noexcept {
  if (in.task.program.scope.count == kMostLocals)
    return fail(in.parser, tooMany, name.at);
  return addLocal(in.task.symbols, in.task.program.scope, in.parser.line, name, type) ||
         fail(in.parser, Error::SymbolsFull, name.at);
}

/// LET #x : LREAL := 3
bool readLet(Reading &in, const Token &let) noexcept {
  Program &program = in.task.program;
  if (program.phase == Phase::Body || (program.sub && program.phase == Phase::Start))
    return fail(in.parser, Error::LateLet, let.at);
  in.parser.at = let.end;
  in.head.kind = SentenceKind::Let;
  Token name{};
  ValueType type{};
  if (!readDeclaration(in, name, type, Error::Conflict))
    return false;
  put(in.task.code, type);
  const Token assign = peek(in.parser);
  if (isSymbol(assign, symbol(':', '='))) {
    in.parser.at = assign.end;
    const Token first = peek(in.parser);
    ValueType initial{};
    if (!readExpression(in.parser, initial))
      return false;
    if (initial != type)
      return fail(in.parser, Error::InitialType, first.at);
  }
  if (!expectEnd(in))
    return false;
  if (in.task.code.size > in.task.code.capacity)
    return true; // again when there is room
  program.phase = Phase::Declarations;
  return declare(in, name, type, Error::TooManyLocals);
}

/// The name of a subprogram.
bool checkName(Reading &in, const Token &name) noexcept {
  if (name.length < kLeastName)
    return fail(in.parser, Error::NameTooShort, name.at);
  if (isReserved(in.parser.line, name))
    return fail(in.parser, Error::ReservedWord, name.at);
  return true;
}

bool isProgramName(const Reading &in, const Token &name) noexcept {
  const char *const wanted = in.task.program.name;
  int32_t i = 0;
  while (i < name.length && wanted[i] != 0 &&
         upperCase(wanted[i]) == upperCase(in.parser.line.text[name.start + i]))
    ++i;
  return i == name.length && wanted[i] == 0;
}

/// SUBPROGRAM Name{#a : LREAL, …}
bool readHeader(Reading &in, const Token &keyword) noexcept {
  Program &program = in.task.program;
  if (!program.sub || program.phase != Phase::Start)
    return fail(in.parser, program.sub ? Error::OneSubprogram : Error::NotDeclaredHere, keyword.at);
  in.parser.at = keyword.end;
  in.head.kind = SentenceKind::Header;
  const Token name = peek(in.parser);
  if (!expect(in, name.kind == TokenKind::Name, name) || !checkName(in, name))
    return false;
  if (!isProgramName(in, name))
    return fail(in.parser, Error::NotDeclaredHere, name.at);
  Token token = peek(in.parser);
  if (!expect(in, token.kind == TokenKind::Open, token))
    return false;
  // The worst case, so that nothing is declared twice.
  const bool fits = in.task.code.capacity - in.task.code.size > kMostLocals + 1;
  const Scope before = program.scope;
  const int32_t used = in.task.symbols.used;
  uint8_t types[kMostLocals + 1] = {};
  for (token = peek(in.parser); token.kind != TokenKind::Close; token = peek(in.parser)) {
    if (program.scope.count > before.count) {
      if (!expect(in, isSymbol(token, symbol(',')), token))
        return false;
    }
    ValueType type{};
    Token parameter{};
    if (!readDeclaration(in, parameter, type, Error::DuplicateParameter) ||
        !declare(in, parameter, type, Error::TooManyParameters))
      return false;
    types[program.scope.count - 1] = static_cast<uint8_t>(type);
  }
  in.parser.at = token.end;
  put(in.task.code, static_cast<uint8_t>(program.scope.count));
  putBytes(in.task.code, types, fits ? program.scope.count : kMostLocals + 1);
  if (!fits) {
    program.scope = before;
    in.task.symbols.used = used;
    return expectEnd(in);
  }
  program.phase = Phase::Declarations;
  return expectEnd(in);
}

bool readEnd(Reading &in, const Token &keyword) noexcept {
  Program &program = in.task.program;
  if (!program.sub)
    return fail(in.parser, Error::EndWithoutSubprogram, keyword.at);
  in.parser.at = keyword.end;
  in.head.kind = SentenceKind::End;
  if (!expectEnd(in))
    return false;
  if (in.task.code.size <= in.task.code.capacity)
    program.phase = Phase::Ended;
  return true;
}

/// Arguments in brackets; their types stand before their instructions.
bool readArguments(Reading &in) noexcept {
  Token token = peek(in.parser);
  if (!expect(in, token.kind == TokenKind::Open, token))
    return false;
  const int32_t open = token.at;
  CodeWriter &code = in.task.code;
  const int32_t place = code.size;
  uint8_t types[kMostLocals + 2] = {};
  int32_t count = 0;
  putBytes(code, types, sizeof types);
  for (token = peek(in.parser); token.kind != TokenKind::Close; token = peek(in.parser)) {
    if (token.kind == TokenKind::End)
      return fail(in.parser, Error::OpenBracket, open);
    if (count > 0 && !expect(in, isSymbol(token, symbol(',')), token))
      return false;
    ValueType type{};
    if (count > kMostLocals)
      return fail(in.parser, Error::TooManyArguments, token.at);
    if (!readExpression(in.parser, type))
      return false;
    types[++count] = static_cast<uint8_t>(type);
  }
  in.parser.at = token.end;
  types[0] = static_cast<uint8_t>(count);
  if (code.size <= code.capacity)
    __builtin_memcpy(code.bytes + place, types, sizeof types);
  return expectEnd(in);
}

bool readDynamicCall(Reading &in, const Token &keyword) noexcept {
  in.parser.at = keyword.end;
  in.head.kind = SentenceKind::DynamicCall;
  const int32_t place = in.task.code.size;
  if (!readArguments(in))
    return false;
  if (in.task.code.size > in.task.code.capacity)
    return true;
  const uint8_t *const types = in.task.code.bytes + place;
  if (types[0] == 0)
    return fail(in.parser, Error::TooFewArguments, keyword.at);
  return types[1] == static_cast<uint8_t>(ValueType::Text) ||
         fail(in.parser, Error::ArgumentType, keyword.at);
}

bool readCall(Reading &in, const Token &name) noexcept {
  if (!checkName(in, name))
    return false;
  in.parser.at = name.end;
  in.head.kind = SentenceKind::Call;
  put(in.task.code, static_cast<uint8_t>(name.length));
  putBytes(in.task.code, in.parser.line.text + name.start, name.length);
  return readArguments(in);
}

/// How many letters begin at the index, at most six; in upper case.
int32_t lettersAt(const ProgramLine &line, int32_t at, char *letters) noexcept {
  int32_t count = 0;
  while (count < cnc::kMostLetters + 1 && isLetter(line.text[at + count])) {
    letters[count] = upperCase(line.text[at + count]);
    ++count;
  }
  return count;
}

/// Whether a name begins as a word does: letters of a word, and then its value.
bool beginsWord(const ProgramLine &line, const Token &name) noexcept {
  char letters[cnc::kMostLetters + 1];
  const int32_t count = lettersAt(line, name.start, letters);
  if (count > cnc::kMostLetters || cnc::codeOf(letters, count) == cnc::kNoWord)
    return false;
  return count == name.length || isDigit(line.text[name.start + count]);
}

/// N: a whole number and nothing else.
bool readNumber(Reading &in, int32_t after) noexcept {
  in.parser.at = after;
  const Token token = peek(in.parser);
  if (token.kind != TokenKind::Number)
    return failAt(in, token.kind == TokenKind::End ? Error::MissingValue : Error::NumberLiteral,
                  token);
  if (!(token.number <= kMostNumber) ||
      static_cast<double>(static_cast<int64_t>(token.number)) != token.number)
    return fail(in.parser, Error::NumberRange, token.at);
  in.parser.at = token.end;
  in.head.number = static_cast<uint32_t>(token.number);
  in.head.numbered = true;
  return true;
}

/// O with a variable and nothing else: the variable is meant, not its value.
bool readTarget(Reading &in, WordHead &word) noexcept {
  const Token token = peek(in.parser);
  if (token.kind != TokenKind::Variable && token.kind != TokenKind::Local)
    return false;
  const Token next = tokenAt(in.parser.line, token.end);
  if (infixOf(in.parser.line, next) != nullptr)
    return false;
  if (readReference(in.parser, token, word.type))
    in.parser.at = token.end;
  word.form = WordForm::Variable;
  return true;
}

bool takes(const WordHead &word) noexcept {
  if (word.type == ValueType::Real || word.code == 'D')
    return true;
  return word.code == 'K' && word.type == ValueType::Bool;
}

bool readValue(Reading &in, WordHead &word) noexcept {
  if (word.code == 'O' && readTarget(in, word))
    return in.parser.error == Error::None;
  const Token first = peek(in.parser);
  if (word.code == 'L' && (isSymbol(first, symbol('!')) || isSymbol(first, symbol('?')))) {
    word.form = first.symbol == symbol('!') ? WordForm::Label : WordForm::LabelJump;
    in.parser.at = first.end;
    in.parser.locals = false;
  }
  const Token value = peek(in.parser);
  if (value.kind == TokenKind::End)
    return fail(in.parser, Error::MissingValue, value.at);
  if (!readExpression(in.parser, word.type))
    return false;
  in.parser.locals = true;
  return takes(word) || fail(in.parser, Error::BadType, value.at);
}

/// A word: letters and a value.
bool readWord(Reading &in) noexcept {
  const ProgramLine &line = in.parser.line;
  const int32_t at = skipBlanks(line, in.parser.at);
  if (!isLetter(line.text[at]))
    return failAt(in, Error::AddressExpected, peek(in.parser));
  char letters[cnc::kMostLetters + 1];
  const int32_t count = lettersAt(line, at, letters);
  WordHead word{};
  if (count <= cnc::kMostLetters)
    word.code = cnc::codeOf(letters, count);
  if (word.code == cnc::kNoWord)
    return fail(in.parser, Error::UnknownWord, at);
  if (word.code == 'N')
    return readNumber(in, at + count);
  in.parser.at = at + count;
  word.column = line.column[at];
  CodeWriter &code = in.task.code;
  const int32_t place = code.size;
  put(code, word);
  if (!readValue(in, word))
    return false;
  const int32_t size = code.size - place - static_cast<int32_t>(sizeof word);
  word.size = static_cast<uint16_t>(size);
  if (code.size <= code.capacity)
    __builtin_memcpy(code.bytes + place, &word, sizeof word);
  return true;
}

bool readWords(Reading &in) noexcept {
  in.head.kind = SentenceKind::Words;
  CodeWriter &code = in.task.code;
  const int32_t place = code.size;
  int32_t count = 0;
  put(code, static_cast<uint8_t>(0));
  while (skipBlanks(in.parser.line, in.parser.at) < in.parser.line.length) {
    const int32_t size = code.size;
    const int32_t at = in.parser.at;
    if (!readWord(in))
      return false;
    count += code.size > size ? 1 : 0;
    if (count >= cnc::kMostWords)
      return fail(in.parser, Error::BufferTooSmall, at);
  }
  if (code.size <= code.capacity)
    code.bytes[place] = static_cast<uint8_t>(count);
  return true;
}

/// What stands behind `/` and N.
bool readRest(Reading &in) noexcept {
  const Token token = peek(in.parser);
  const ProgramLine &line = in.parser.line;
  if (isWordText(line, token, "RETURN")) {
    if (!in.task.program.sub)
      return fail(in.parser, Error::ReturnInMain, token.at);
    in.parser.at = token.end;
    in.head.kind = SentenceKind::Return;
    return expectEnd(in);
  }
  if (isWordText(line, token, "DYNCALL"))
    return readDynamicCall(in, token);
  if (token.kind == TokenKind::Name && !beginsWord(line, token) &&
      tokenAt(line, token.end).kind == TokenKind::Open)
    return readCall(in, token);
  return readWords(in);
}

bool readBody(Reading &in) noexcept {
  Program &program = in.task.program;
  const ProgramLine &line = in.parser.line;
  if (program.sub && program.phase == Phase::Start)
    return fail(in.parser, Error::DeclarationFirst, skipBlanks(line, 0));
  int32_t at = skipBlanks(line, 0);
  if (line.text[at] == '/') {
    in.head.skip = true;
    at = skipBlanks(line, at + 1);
  }
  in.parser.at = at;
  if (upperCase(line.text[at]) == 'N' && !isLetter(line.text[at + 1]) && !readNumber(in, at + 1))
    return false;
  if (!readRest(in))
    return false;
  if (in.task.code.size <= in.task.code.capacity)
    program.phase = Phase::Body;
  return true;
}

bool readAny(Reading &in) noexcept {
  const Token token = peek(in.parser);
  const ProgramLine &line = in.parser.line;
  if (in.task.program.phase == Phase::Ended)
    return fail(in.parser, Error::TextAfterEnd, token.at);
  if (isWordText(line, token, "LET"))
    return readLet(in, token);
  if (isWordText(line, token, "SUBPROGRAM"))
    return readHeader(in, token);
  if (isWordText(line, token, "END_SUBPROGRAM"))
    return readEnd(in, token);
  return readBody(in);
}

} // namespace

LineResult readSentence(LineTask &task) noexcept {
  const ProgramLine &line = task.line;
  const int32_t first = skipBlanks(line, 0);
  if (first >= line.length)
    return LineResult::Nothing;
  if (line.text[first] == '%') {
    const bool finish = task.program.titled || task.program.phase != Phase::Start;
    task.program.titled = true;
    return finish ? LineResult::Finish : LineResult::Title;
  }
  Reading in{task,
             Parser{line, task.symbols, task.program.scope, task.variables, task.code, 0, 0, true,
                    Error::None, 0},
             SentenceHead{}};
  in.head.line = line.number;
  in.head.next = line.offset;
  in.head.nextState = stateOf(line);
  task.code.size = static_cast<int32_t>(sizeof(SentenceHead));
  if (!readAny(in)) {
    task.error = in.parser.error;
    task.errorAt = in.parser.errorAt;
    return LineResult::Wrong;
  }
  in.head.size = static_cast<uint32_t>(task.code.size);
  if (task.code.size <= task.code.capacity)
    __builtin_memcpy(task.code.bytes, &in.head, sizeof in.head);
  return LineResult::Sentence;
}

} // namespace stride::nc
