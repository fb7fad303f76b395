#include "compiler/syntax/ast_builder.hpp"

#include <string>

namespace stc {

using namespace ast;

Expr *AstBuilder::literal(const Token &start) {
  if (start.reported)
    return error(span(start));
  auto *node = arena_.make<Literal>();
  node->span = span(start);
  const std::string_view spelling = text(start);
  bool good = true;
  switch (start.type) {
  case Tok::INTEGER:
    good = literals_.integer(spelling, node->span, *node);
    break;
  case Tok::REAL:
    good = literals_.real(spelling, node->span, *node);
    break;
  case Tok::STRING_LITERAL:
  case Tok::WSTRING_LITERAL:
    good = literals_.string(spelling, node->span, *node);
    break;
  case Tok::TRUE:
  case Tok::FALSE:
    node->literal = LiteralKind::Boolean;
    node->integer = start.type == Tok::TRUE;
    node->text = spelling;
    break;
  case Tok::TIME_LITERAL: {
    const size_t hash = spelling.find('#');
    const std::string prefix = lowerCase(spelling.substr(0, hash));
    std::string_view value = spelling.substr(hash + 1);
    const bool negative = value[0] == '-';
    if (negative || value[0] == '+')
      value.remove_prefix(1);
    node->text = spelling;
    node->negative = negative && prefix[0] == 'l'; // LTIME has a sign
    good = literals_.timeOrDate(prefix, value, node->span, *node);
    if (good && negative && !node->negative) {
      auto *negated = arena_.make<UnaryExpr>();
      negated->span = node->span;
      negated->op = UnaryOp::Negate;
      negated->operand = node;
      return negated;
    }
    break;
  }
  default:
    good = false;
    break;
  }
  return good ? static_cast<Expr *>(node) : error(node->span);
}

Expr *AstBuilder::typedLiteral(const Token &start) {
  const Span whole = span(start);
  if (start.reported)
    return error(whole);
  const std::string_view spelling = text(start);
  const auto hash = static_cast<uint32_t>(spelling.find('#'));
  auto *node = arena_.make<Literal>();
  node->span = whole;
  const std::string_view typeName = spelling.substr(0, hash);
  node->typeName = {interner_.intern(typeName), typeName, {file_, whole.begin, whole.begin + hash}};
  std::string_view value = spelling.substr(hash + 1);
  Span at{file_, whole.begin + hash + 1, whole.end};
  const bool negative = value[0] == '-';
  if (negative || value[0] == '+') {
    value.remove_prefix(1);
    ++at.begin;
  }
  bool good = true;
  const bool based = value.find('#') != std::string_view::npos;
  if (value[0] == '\'' && isWord(typeName, "utf8")) {
    node->typeName = {}; // an encoding, no type
    good = literals_.string(value, at, *node, true);
  } else if (value[0] == '\'' || value[0] == '"') {
    good = literals_.string(value, at, *node);
  } else if (isWord(value, "true") || isWord(value, "false")) {
    node->literal = LiteralKind::Boolean;
    node->integer = isWord(value, "true");
    node->text = value;
  } else if (!based && value.find_first_of(".eE") != std::string_view::npos) {
    good = literals_.real(value, at, *node);
  } else {
    good = literals_.integer(value, at, *node);
  }
  if (!good)
    return error(whole);
  node->negative = negative;
  return node;
}

Expr *AstBuilder::enumLiteral(const Token &start) {
  const Span whole = span(start);
  const std::string_view spelling = text(start);
  const auto hash = static_cast<uint32_t>(spelling.find('#'));
  const std::string_view typeName = spelling.substr(0, hash);
  const std::string_view enumerator = spelling.substr(hash + 1);
  auto *node = arena_.make<EnumLiteralExpr>();
  node->span = whole;
  node->typeName = {interner_.intern(typeName), typeName, {file_, whole.begin, whole.begin + hash}};
  node->enumerator = {
      interner_.intern(enumerator), enumerator, {file_, whole.begin + hash + 1, whole.end}};
  return node;
}

} // namespace stc
