#include "compiler/source/identifier.hpp"
#include "compiler/syntax/ast_builder.hpp"
#include "compiler/syntax/chart_nodes.hpp"

#include <string>

#include <fmt/format.h>

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

/// The type of a variable that holds the literal; null: only its use says the type. Texts get the
/// usual length at least, so that a POINTER TO STRING may point to them.
TypeExpr *AstBuilder::typeOfPlaced(const Literal *literal) {
  constexpr size_t kUsual = 80;
  if (literal->literal == LiteralKind::String || literal->literal == LiteralKind::Wstring) {
    auto *node = arena_.make<StringTypeExpr>();
    node->span = literal->span;
    node->wide = literal->literal == LiteralKind::Wstring;
    if (literal->text.size() > kUsual) {
      auto *length = arena_.make<Literal>();
      length->integer = literal->text.size(); // bytes of UTF-8: no fewer than characters
      length->text = arena_.copy(std::to_string(literal->text.size()));
      length->span = literal->span;
      node->length = length;
    }
    return node;
  }
  const char *type = literal->literal == LiteralKind::Boolean ? "BOOL"
                     : literal->literal == LiteralKind::Time  ? "TIME"
                     : literal->literal == LiteralKind::Ltime ? "LTIME"
                                                              : nullptr;
  if (type == nullptr && !literal->typeName)
    return nullptr;
  auto *node = arena_.make<NamedTypeExpr>();
  node->span = literal->span;
  const Name name =
      literal->typeName ? literal->typeName : Name{interner_.intern(type), type, literal->span};
  node->path = arena_.copy(std::vector<Name>{name});
  return node;
}

/// `ADR('text')` is the address of a variable that holds the text, as CODESYS has it.
void AstBuilder::placeLiteral(CallExpr *call) {
  if (literalPlaces_ == nullptr || call->callee->kind != ExprKind::Name ||
      !equalIgnoringCase(as<NameExpr>(call->callee)->name.text, "adr") ||
      call->arguments.size() != 1 || call->arguments[0].name ||
      call->arguments[0].value == nullptr || call->arguments[0].value->kind != ExprKind::Literal)
    return;
  auto *literal = as<Literal>(call->arguments[0].value);
  TypeExpr *type = typeOfPlaced(literal);
  if (type == nullptr)
    return;
  const std::string_view text = arena_.copy(fmt::format("adr__{}", ++placedLiterals_));
  const Name name{interner_.intern(text), text, literal->span};
  auto *place = arena_.make<VarDecl>();
  place->name = name;
  place->section = Section::Stat;
  place->type = type;
  place->init = literal;
  ChartNodes make(interner_, arena_);
  make.hide(place);
  literalPlaces_->push_back(place);
  call->arguments[0].value = make.variable(name);
}

} // namespace stc
