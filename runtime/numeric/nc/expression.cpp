#include "runtime/numeric/nc/expression.hpp"

#include "runtime/numeric/nc/function_table.hpp"

namespace stride::nc {
namespace {

bool readInfix(Parser &parser, int32_t least, ValueType &type) noexcept;

/// Counts how deep it is, as long as it lives.
struct Depth {
  explicit Depth(Parser &of) noexcept : parser(of) { ++parser.depth; }
  Depth(const Depth &) = delete;
  Depth &operator=(const Depth &) = delete;
  ~Depth() { --parser.depth; }
  Parser &parser;
};

bool readClose(Parser &parser, int32_t open, Error surplus) noexcept {
  const Token token = peek(parser);
  if (token.kind == TokenKind::Bad)
    return fail(parser, token.error, token.at);
  if (token.kind == TokenKind::End)
    return fail(parser, Error::OpenBracket, open);
  if (token.kind != TokenKind::Close)
    return fail(parser, surplus, token.at);
  parser.at = token.end;
  return true;
}

/// Checks an argument of a function; `any` is what Any stands for.
bool checkArgument(Parser &parser, ValueType wanted, ValueType type, ValueType &any,
                   int32_t at) noexcept {
  if (wanted == ValueType::Any) {
    if (any == ValueType::Any)
      any = type;
    wanted = any;
  }
  return wanted == type || fail(parser, Error::ArgumentType, at);
}

/// The arguments in brackets; `open` is the bracket.
bool readArguments(Parser &parser, const Function &function, const Token &open,
                   ValueType &any) noexcept {
  parser.at = open.end;
  for (int32_t i = 0; i < function.count; ++i) {
    const Token first = peek(parser);
    if (first.kind == TokenKind::Close)
      return fail(parser, Error::TooFewArguments, first.at);
    ValueType type{};
    if (!readInfix(parser, 0, type) ||
        !checkArgument(parser, function.arguments[i], type, any, first.at))
      return false;
    const Token comma = peek(parser);
    const bool isComma = comma.kind == TokenKind::Symbol && comma.symbol == symbol(',');
    if (i + 1 == function.count)
      return readClose(parser, open.at, isComma ? Error::TooManyArguments : Error::SurplusTerms);
    if (!isComma)
      return fail(parser,
                  comma.kind == TokenKind::End ? Error::OpenBracket : Error::TooFewArguments,
                  comma.at);
    parser.at = comma.end;
  }
  return true;
}

bool readFunction(Parser &parser, const Token &name, ValueType &type) noexcept {
  const Function *const function = functionOf(parser.line, name);
  if (function == nullptr)
    return fail(parser, Error::UnknownPrefix, name.at);
  parser.at = name.end;
  ValueType any = ValueType::Any;
  const Token next = peek(parser);
  if (function->count > 0 && next.kind == TokenKind::Open) {
    if (!readArguments(parser, *function, next, any))
      return false;
  } else if (function->count == 1) {
    // One argument needs no brackets: sin 3.
    ValueType argument{};
    if (!readTerm(parser, argument) ||
        !checkArgument(parser, function->arguments[0], argument, any, next.at))
      return false;
  } else if (function->count > 1) {
    return fail(parser, Error::TooFewArguments, name.at);
  }
  put(parser.code, function->op);
  type = function->result == ValueType::Any ? any : function->result;
  return true;
}

bool readSign(Parser &parser, const Token &sign, ValueType &type) noexcept {
  parser.at = sign.end;
  if (!readTerm(parser, type))
    return false;
  if (type != ValueType::Real)
    return fail(parser, Error::ArgumentType, sign.at);
  if (sign.symbol == symbol('-'))
    put(parser.code, Op::Negate);
  return true;
}

/// Values with operators between them that bind at least so much.
bool readInfix(Parser &parser, int32_t least, ValueType &type) noexcept {
  if (!readTerm(parser, type))
    return false;
  for (;;) {
    const Token token = peek(parser);
    const Infix *const infix = infixOf(parser.line, token);
    if (infix == nullptr || infix->precedence < least)
      return true;
    parser.at = token.end;
    ValueType right{};
    if (!readInfix(parser, infix->precedence + 1, right))
      return false;
    const bool any = infix->arguments == ValueType::Any;
    if (any ? type != right : type != infix->arguments || right != infix->arguments)
      return fail(parser, Error::ArgumentType, token.at);
    put(parser.code, infix->op);
    type = infix->result;
  }
}

} // namespace

bool fail(Parser &parser, Error error, int32_t at) noexcept {
  if (parser.error == Error::None) {
    parser.error = error;
    parser.errorAt = at;
  }
  return false;
}

bool readReference(Parser &parser, const Token &token, ValueType &type) noexcept {
  if (token.kind == TokenKind::Local) {
    if (!parser.locals)
      return fail(parser, Error::WrongToken, token.at);
    const int32_t index = findLocal(parser.symbols, parser.scope, parser.line, token, type);
    if (index < 0)
      return fail(parser, Error::NoLocal, token.at);
    put(parser.code, Op::Local);
    put(parser.code, static_cast<uint8_t>(index));
    return true;
  }
  uint8_t variable = 0;
  const int32_t index = findVariable(parser.variables, parser.line, token, variable);
  if (index < 0)
    return fail(parser, Error::NoVariable, token.at);
  type = typeOfVariable(variable);
  put(parser.code, Op::Variable);
  put(parser.code, variable);
  put(parser.code, static_cast<uint16_t>(index));
  return true;
}

bool readTerm(Parser &parser, ValueType &type) noexcept {
  const Depth depth(parser);
  const Token token = peek(parser);
  if (parser.depth > kMostDepth)
    return fail(parser, Error::TooDeep, token.at);
  switch (token.kind) {
  case TokenKind::Number:
    put(parser.code, Op::Number);
    put(parser.code, token.number);
    type = ValueType::Real;
    break;
  case TokenKind::Text:
    put(parser.code, Op::Text);
    put(parser.code, static_cast<uint8_t>(token.length));
    putBytes(parser.code, parser.line.text + token.start, token.length);
    type = ValueType::Text;
    break;
  case TokenKind::Variable:
  case TokenKind::Local:
    if (!readReference(parser, token, type))
      return false;
    if (type == ValueType::Any) // a structure
      return fail(parser, Error::ArgumentType, token.at);
    break;
  case TokenKind::Name:
    return readFunction(parser, token, type);
  case TokenKind::Open:
    parser.at = token.end;
    return readInfix(parser, 0, type) && readClose(parser, token.at, Error::SurplusTerms);
  case TokenKind::Symbol:
    if (token.symbol == symbol('-') || token.symbol == symbol('+'))
      return readSign(parser, token, type);
    return fail(parser, Error::TermExpected, token.at);
  case TokenKind::Bad:
    return fail(parser, token.error, token.at);
  case TokenKind::Close:
  case TokenKind::End:
    return fail(parser, Error::TermExpected, token.at);
  }
  parser.at = token.end;
  return true;
}

bool readExpression(Parser &parser, ValueType &type) noexcept { return readInfix(parser, 0, type); }

} // namespace stride::nc
