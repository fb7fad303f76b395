#include "compiler/syntax/ast_builder.hpp"

#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <string>

namespace stc {

using namespace ast;

namespace {

constexpr size_t kMaxOperands = 16384;
constexpr size_t kMaxPostfix = 1024;

struct Operator {
  BinaryOp op;
  int precedence;
};

Operator operatorOf(uint16_t type) {
  switch (type) {
  case Tok::POWER:
    return {BinaryOp::Power, 7};
  case Tok::STAR:
    return {BinaryOp::Multiply, 6};
  case Tok::SLASH:
    return {BinaryOp::Divide, 6};
  case Tok::MOD:
    return {BinaryOp::Modulo, 6};
  case Tok::PLUS:
    return {BinaryOp::Add, 5};
  case Tok::MINUS:
    return {BinaryOp::Subtract, 5};
  case Tok::LESS:
    return {BinaryOp::Less, 4};
  case Tok::LESS_EQUAL:
    return {BinaryOp::LessEqual, 4};
  case Tok::GREATER:
    return {BinaryOp::Greater, 4};
  case Tok::GREATER_EQUAL:
    return {BinaryOp::GreaterEqual, 4};
  case Tok::EQUAL:
    return {BinaryOp::Equal, 3};
  case Tok::NOT_EQUAL:
    return {BinaryOp::NotEqual, 3};
  case Tok::AMPERSAND:
  case Tok::AND:
    return {BinaryOp::LogicalAnd, 2};
  case Tok::AND_THEN:
    return {BinaryOp::AndThen, 2};
  case Tok::XOR:
    return {BinaryOp::LogicalXor, 1};
  case Tok::OR_ELSE:
    return {BinaryOp::OrElse, 0};
  default:
    return {BinaryOp::LogicalOr, 0};
  }
}

} // namespace

Expr *AstBuilder::error(Span span) {
  auto *node = arena_.make<Expr>();
  node->span = span;
  return node;
}

const Token *AstBuilder::plainName(const Context *expression) const {
  const size_t at = first(expression);
  return last(expression) == at && token(at).type == Tok::IDENT ? &token(at) : nullptr;
}

// --------------------------------------------------------------------------------------------
// operators, operands

Expr *AstBuilder::binary(const Token &op, Expr *left, Expr *right) {
  auto *node = arena_.make<BinaryExpr>();
  node->span = left->span.to(right->span);
  node->op = operatorOf(op.type).op;
  node->opSpan = span(op);
  node->left = left;
  node->right = right;
  return node;
}

Expr *AstBuilder::expression(Context *context) {
  if (context->children.empty())
    return error(span(context));
  return flat(context, 0, context->children.size());
}

Expr *AstBuilder::flat(Context *context, size_t begin, size_t end) {
  if (end - begin == 1)
    return operand(child(context, begin));
  if (end - begin > kMaxOperands) {
    diagnostics_.report(Code::ExpressionTooLong, span(context),
                        "this expression has " + std::to_string(end - begin) + " operands",
                        "at most " + std::to_string(kMaxOperands) + " are possible");
    return error(span(context));
  }
  // Precedence climbing without recursion: operators wait on a stack for their right operand.
  struct Waiting {
    Expr *left;
    const Token *op;
    int precedence;
  };
  std::vector<Waiting> stack;
  Expr *right = operand(child(context, begin));
  for (size_t i = begin + 1; i < end; ++i) {
    const Token &op = token(last(child(context, i - 1)) + 1);
    const int precedence = operatorOf(op.type).precedence;
    while (!stack.empty() && stack.back().precedence >= precedence) {
      right = binary(*stack.back().op, stack.back().left, right);
      stack.pop_back();
    }
    stack.push_back({right, &op, precedence});
    right = operand(child(context, i));
  }
  while (!stack.empty()) {
    right = binary(*stack.back().op, stack.back().left, right);
    stack.pop_back();
  }
  return right;
}

Expr *AstBuilder::prefixed(Context *context, size_t operators, Expr *operand) {
  // Three equal operators in a row are one: NOT NOT NOT x = NOT x, with the same type rules.
  const size_t begin = first(context);
  std::vector<const Token *> chain;
  for (size_t i = 0; i < operators; ++i) {
    const Token &op = token(begin + i);
    const size_t n = chain.size();
    if (n >= 2 && chain[n - 1]->type == op.type && chain[n - 2]->type == op.type)
      chain.pop_back();
    else
      chain.push_back(&op);
  }
  if (chain.size() > kMaxNesting) {
    diagnostics_.report(Code::TooDeep, span(*chain.front()),
                        "too many operators before one operand",
                        "more than " + std::to_string(kMaxNesting));
    return error(span(context));
  }
  for (size_t i = chain.size(); i-- > 0;) {
    auto *node = arena_.make<UnaryExpr>();
    node->span = span(*chain[i]).to(operand->span);
    node->op = chain[i]->type == Tok::NOT     ? UnaryOp::LogicalNot
               : chain[i]->type == Tok::MINUS ? UnaryOp::Negate
                                              : UnaryOp::Plus;
    node->operand = operand;
    operand = node;
  }
  return operand;
}

Expr *AstBuilder::operand(Context *context) {
  size_t at = first(context);
  const size_t begin = at;
  while (token(at).type == Tok::NOT || token(at).type == Tok::MINUS || token(at).type == Tok::PLUS)
    ++at;
  const size_t operators = at - begin;
  size_t nextChild = 0;
  Expr *node = primary(context, at, nextChild);
  if (at <= last(context))
    node = postfix(context, node, at, nextChild);
  return operators == 0 ? node : prefixed(context, operators, node);
}

Expr *AstBuilder::nameOperand(const Token &name) {
  if (name.reported) // not a name of anything
    return error(span(name));
  auto *node = arena_.make<NameExpr>();
  node->name = this->name(name);
  node->span = node->name.span;
  return node;
}

Expr *AstBuilder::directOperand(const Token &direct) {
  DirectAddress *place = address(direct);
  if (place == nullptr)
    return error(span(direct));
  auto *node = arena_.make<DirectExpr>();
  node->span = span(direct);
  node->address = place;
  return node;
}

/// Reports commas with nothing between them and the next one or the closing bracket.
void AstBuilder::requireArguments(const Context *inside, bool mayEndWithComma) {
  const size_t count = inside->children.size();
  for (size_t i = 0; i < count; ++i) {
    const bool isLast = i + 1 == count;
    const size_t next = isLast ? last(inside) + 1 : first(child(inside, i + 1));
    const size_t comma = last(child(inside, i)) + 1 + (isLast && !mayEndWithComma ? 0 : 1);
    if (comma < next && token(comma).type == Tok::COMMA) {
      diagnostics_.report(Code::UnexpectedToken, span(token(comma)),
                          "expected an expression beside this `,`", "there is none");
      return;
    }
  }
}

/// `[1, 2(3)]`
Expr *AstBuilder::arrayAggregate(const Context *inside, Span whole) {
  requireArguments(inside, false);
  std::vector<AggregateItem> items;
  for (size_t i = 0; i < inside->children.size(); ++i) {
    Context *argument = child(inside, i);
    if (argument->children.size() != 1 || last(argument) != last(child(argument, 0))) {
      diagnostics_.report(Code::UnexpectedToken, span(argument), "an array element has no name")
          .help("initial values of a structure stand in parentheses: `(x := 1, y := 2)`");
      return error(whole);
    }
    items.push_back(item(child(argument, 0)));
  }
  return aggregate(items, false, whole);
}

/// What begins with a bracket at `at`; `at` moves past it.
Expr *AstBuilder::bracketOperand(Context *inside, size_t &at) {
  const Token &start = token(at);
  at = inside->children.empty() ? at + 1 : last(inside) + 1;
  Span whole = span(start).to(span(inside));
  const uint16_t closer = start.type == Tok::LPAREN ? Tok::RPAREN : Tok::RBRACKET;
  if (token(at).type == closer)
    whole = whole.to(span(token(at++)));
  return start.type == Tok::LPAREN ? parentheses(inside, whole) : arrayAggregate(inside, whole);
}

Expr *AstBuilder::primary(Context *context, size_t &at, size_t &nextChild) {
  const Token &start = token(at);
  switch (start.type) {
  case Tok::LPAREN:
  case Tok::LBRACKET:
    return bracketOperand(child(context, nextChild++), at);
  case Tok::TYPE_ARGUMENT: {
    Context *type = child(context, nextChild++);
    at = last(type) + 1;
    auto *node = arena_.make<TypeNameExpr>();
    node->span = span(type);
    node->name = this->type(type);
    return node;
  }
  default:
    break;
  }
  ++at; // the others are one token
  switch (start.type) {
  case Tok::IDENT:
    return nameOperand(start);
  case Tok::DIRECT:
    return directOperand(start);
  case Tok::ENUM_LITERAL:
    return enumLiteral(start);
  case Tok::TYPED_LITERAL:
    return typedLiteral(start);
  default:
    return literal(start);
  }
}

Expr *AstBuilder::parentheses(Context *inside, Span whole) {
  requireArguments(inside, false);
  const size_t count = inside->children.size();
  if (count == 0)
    return aggregate({}, true, whole); // `x : Block := ();`
  Context *only = child(inside, 0);
  if (count == 1 && only->children.size() == 1 && last(only) == last(child(only, 0))) {
    Expr *node = initialValue(child(only, 0));
    node->parenthesized = true;
    node->span = whole;
    return node;
  }
  return structAggregate(inside, whole);
}

Expr *AstBuilder::memberOf(Expr *base, const Token &member) {
  if (member.type == Tok::DIRECT && !member.reported)
    return partOf(base, member);
  if (member.reported)
    return error(base->span.to(span(member)));
  auto *node = arena_.make<MemberExpr>();
  node->base = base;
  node->span = base->span.to(span(member));
  if (member.type == Tok::INTEGER) {
    int32_t bit = 0;
    for (const char c : text(member))
      bit = c >= '0' && c <= '9' && bit < 100000 ? bit * 10 + (c - '0') : 100000;
    node->bit = bit;
    node->name.span = span(member);
  } else {
    node->name = name(member);
  }
  return node;
}

Expr *AstBuilder::indexOf(Expr *base, Context *inside, Span brackets, Span whole) {
  requireArguments(inside, false);
  auto *node = arena_.make<IndexExpr>();
  node->base = base;
  node->span = whole;
  std::vector<Expr *> indices;
  for (size_t i = 0; i < inside->children.size(); ++i) {
    Context *argument = child(inside, i);
    indices.push_back(expression(child(argument, 0)));
    if (last(argument) != last(child(argument, 0)))
      diagnostics_.report(Code::UnexpectedToken, span(token(last(child(argument, 0)) + 1)),
                          "an index has no name", "expected `,` or `]`");
  }
  if (indices.empty()) {
    diagnostics_.report(Code::UnexpectedToken, brackets, "expected an index between the brackets");
    indices.push_back(error(brackets));
  }
  node->indices = arena_.copy(indices);
  return node;
}

/// A call or an index; `at` is at its bracket, and is after the closing one afterwards.
Expr *AstBuilder::bracketed(Expr *base, Context *inside, size_t &at, size_t end) {
  const Token &start = token(at);
  at = inside->children.empty() ? at + 1 : last(inside) + 1;
  Span whole = base->span.to(span(start)).to(span(inside));
  const uint16_t closer = start.type == Tok::LPAREN ? Tok::RPAREN : Tok::RBRACKET;
  if (at > end || token(at).type != closer)
    return error(whole); // reported; what it holds may have been meant to stand outside
  whole = whole.to(span(token(at++)));
  if (start.type == Tok::LPAREN) {
    auto *node = arena_.make<CallExpr>();
    node->callee = base;
    node->arguments = arguments(inside);
    node->span = whole;
    placeLiteral(node);
    return node;
  }
  return indexOf(base, inside, {file_, start.begin, whole.end}, whole);
}

Expr *AstBuilder::postfix(Context *context, Expr *base, size_t &at, size_t &nextChild) {
  const size_t end = last(context);
  size_t count = 0;
  while (at <= end) {
    const Token &start = token(at);
    if (++count > kMaxPostfix) {
      diagnostics_.report(Code::TooDeep, span(start), "too many accesses after one another",
                          "more than " + std::to_string(kMaxPostfix));
      return error(span(context));
    }
    if (start.type == Tok::DOT) {
      base = memberOf(base, token(at + 1));
      at += 2;
    } else if (start.type == Tok::CARET) {
      auto *node = arena_.make<DerefExpr>();
      node->base = base;
      node->span = base->span.to(span(start));
      base = node;
      ++at;
    } else { // LPAREN, LBRACKET
      base = bracketed(base, child(context, nextChild++), at, end);
    }
  }
  return base;
}

/// `base.%X3`: bits of `base`; `resource.%IX0.0` of VAR_ACCESS: that address.
Expr *AstBuilder::partOf(Expr *base, const Token &member) {
  const Span whole = base->span.to(span(member));
  std::string_view spelling = text(member).substr(1);
  const char letter = lowerCase(spelling[0]);
  if (letter == 'i' || letter == 'q' || letter == 'm') {
    DirectAddress *direct = address(member);
    if (direct == nullptr)
      return error(whole);
    auto *node = arena_.make<DirectExpr>();
    node->span = whole;
    node->address = direct;
    return node;
  }
  spelling.remove_prefix(1);
  auto *node = arena_.make<MemberExpr>();
  node->base = base;
  node->span = whole;
  node->name.span = span(member);
  node->width = letter == 'x'   ? uint8_t{1}
                : letter == 'b' ? uint8_t{8}
                : letter == 'w' ? uint8_t{16}
                : letter == 'd' ? uint8_t{32}
                                : uint8_t{64};
  node->bit = 0;
  for (const char c : spelling) {
    if (c < '0' || c > '9') {
      diagnostics_
          .report(Code::InvalidAddress, span(member), "malformed partial access",
                  "expected one number")
          .note("a part of a variable is written `.%X3`, `.%B1`, `.%W0`, `.%D1` or `.%L0`");
      return error(whole);
    }
    node->bit = node->bit < 100000 ? node->bit * 10 + (c - '0') : 100000;
  }
  return node;
}

std::span<Argument> AstBuilder::arguments(Context *context, size_t begin) {
  if (context->getRuleIndex() == Grammar::RuleArguments)
    requireArguments(context, true);
  const size_t count = context->children.size() - begin;
  if (count == 0)
    return {};
  auto *list =
      static_cast<Argument *>(arena_.allocate(sizeof(Argument) * count, alignof(Argument)));
  for (size_t i = 0; i < count; ++i) {
    Context *argument = child(context, begin + i);
    Argument &out = *::new (&list[i]) Argument{};
    out.span = span(argument);
    Context *front = child(argument, 0);
    const size_t sign = last(front) + 1;
    if (sign > last(argument)) {
      out.value = expression(front);
      continue;
    }
    out.output = token(sign).type == Tok::ARROW;
    if (token(sign).type == Tok::DOTDOT) {
      diagnostics_.report(Code::UnexpectedToken, out.span, "a range cannot be an argument",
                          "expected one value");
      out.value = error(out.span);
      continue;
    }
    if (const Token *plain = plainName(front); plain != nullptr) {
      out.name = name(*plain);
    } else {
      const std::string written(tokenSpelling(token(sign).type));
      Diagnostic &d = diagnostics_.report(
          Code::ArgumentName, span(front),
          "expected the name of a parameter before `" + written + "`", "not a plain name");
      if (out.output)
        d.help("a comparison is written `>=`");
      out.value = error(out.span);
      out.output = false;
      continue;
    }
    if (argument->children.size() > 1)
      out.value = expression(child(argument, 1));
  }
  return {list, count};
}

} // namespace stc
