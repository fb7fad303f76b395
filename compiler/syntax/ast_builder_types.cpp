// Types in declarations.

#include "compiler/syntax/ast_builder.hpp"

#include <algorithm>
#include <string>

namespace stc {

using namespace ast;

namespace {

/// Types that an enumeration may be based on; every other `T(a := 1)` calls FB_Init.
bool isElementaryInteger(std::string_view word) {
  static constexpr std::string_view kNames[] = {"sint",  "int",   "dint", "lint", "usint", "uint",
                                                "udint", "ulint", "byte", "word", "dword", "lword"};
  return std::any_of(std::begin(kNames), std::end(kNames),
                     [&](std::string_view name) { return isWord(word, name); });
}

} // namespace

TypeExpr *AstBuilder::errorType(Span span) {
  auto *node = arena_.make<TypeExpr>();
  node->span = span;
  return node;
}

TypeExpr *AstBuilder::arrayType(const Context *context) {
  auto *node = arena_.make<ArrayTypeExpr>();
  node->span = span(context);
  std::vector<ArrayRange> ranges;
  for (size_t i = 0; i + 1 < context->children.size(); ++i) {
    Context *part = child(context, i);
    ArrayRange range;
    range.span = span(part);
    if (part->children.size() > 1) {
      range.low = expression(child(part, 0));
      range.high = expression(child(part, 1));
    }
    ranges.push_back(range);
  }
  node->ranges = arena_.copy(ranges);
  node->element = type(child(context, context->children.size() - 1));
  return node;
}

/// `(a, b)` and `(a, b) INT`
TypeExpr *AstBuilder::listedType(Context *context) {
  size_t arguments = context->children.size();
  TypeExpr *base = nullptr;
  if (Context *end = child(context, arguments - 1); end->getRuleIndex() == Grammar::RulePath) {
    --arguments;
    auto *named = arena_.make<NamedTypeExpr>();
    named->span = span(end);
    named->path = path(end);
    base = named;
  }
  EnumTypeExpr *node = enumeration(context, 0, arguments);
  if (node == nullptr)
    return errorType(span(context));
  node->base = base;
  return node;
}

TypeExpr *AstBuilder::type(Context *context, bool declared) {
  const Token &start = token(first(context));
  switch (start.type) {
  case Tok::ARRAY:
    return arrayType(context);
  case Tok::POINTER:
  case Tok::REF_TO:
  case Tok::REFERENCE: {
    auto *node = arena_.make<PointerTypeExpr>();
    node->kind = start.type == Tok::REFERENCE ? TypeExprKind::Reference : TypeExprKind::Pointer;
    node->refTo = start.type == Tok::REF_TO;
    node->span = span(context);
    node->pointee = type(child(context, 0));
    return node;
  }
  case Tok::STRING:
  case Tok::WSTRING: {
    auto *node = arena_.make<StringTypeExpr>();
    node->span = span(context);
    node->wide = start.type == Tok::WSTRING;
    if (!context->children.empty())
      node->length = expression(child(context, 0));
    return node;
  }
  case Tok::LPAREN:
    return listedType(context);
  default:
    return namedType(context, declared);
  }
}

TypeExpr *AstBuilder::namedType(Context *context, bool declared) {
  Context *names = child(context, 0);
  auto *named = arena_.make<NamedTypeExpr>();
  named->span = span(names);
  named->path = path(names);
  if (last(names) == last(context))
    return named;
  if (context->children.size() == 1) { // `Block()`
    named->hasArguments = true;
    return named;
  }
  Context *argument = child(context, 1);
  if (argument->getRuleIndex() == Grammar::RuleArguments) {
    blockArguments(argument, *named);
    return named;
  }
  const uint16_t sign =
      argument->children.size() > 1 ? token(last(child(argument, 0)) + 1).type : uint16_t{0};
  if (sign == Tok::DOTDOT) {
    auto *node = arena_.make<SubrangeTypeExpr>();
    node->span = span(context);
    node->base = named;
    node->low = expression(child(argument, 0));
    node->high = expression(child(argument, 1));
    if (context->children.size() > 2)
      diagnostics_.report(Code::UnexpectedToken, span(child(context, 2)),
                          "a subrange has one range");
    return node;
  }
  // INT (a, b := 5): edition 3's way to give an enumeration its base type.
  if (plainName(child(argument, 0)) != nullptr &&
      (declared || (named->path.size() == 1 && isElementaryInteger(named->path[0].text)))) {
    if (EnumTypeExpr *node = enumeration(context, 1, context->children.size()); node != nullptr) {
      node->base = named;
      return node;
    }
    return errorType(span(context));
  }
  named->hasArguments = true;
  named->arguments = arguments(context, 1);
  return named;
}

/// `Block[(a := 1), (a := 2)]`, the type of an array's elements.
void AstBuilder::blockArguments(Context *list, NamedTypeExpr &out) {
  std::vector<std::span<Argument>> elements;
  for (size_t i = 0; i < list->children.size(); ++i) {
    Context *argument = child(list, i);
    Context *only = argument->children.size() == 1 ? child(argument, 0) : nullptr;
    Context *operand = only != nullptr && only->children.size() == 1 ? child(only, 0) : nullptr;
    if (operand == nullptr || token(first(operand)).type != Tok::LPAREN ||
        operand->children.size() != 1 || last(operand) != last(argument)) {
      diagnostics_
          .report(Code::UnexpectedToken, span(argument),
                  "expected the arguments of one element, in parentheses", "not `(…)`")
          .help("an array is declared `ARRAY [0..9] OF …`; FB_Init of an array's elements is given "
                "as "
                "`Block[(a := 1), (a := 2)]`");
      return;
    }
    elements.push_back(arguments(child(operand, 0)));
  }
  out.elements = arena_.copy(elements);
}

/// Null for one that was reported.
DirectAddress *AstBuilder::address(const Token &token) {
  if (token.type != Tok::DIRECT || token.reported)
    return nullptr;
  auto *node = arena_.make<DirectAddress>();
  node->span = span(token);
  node->text = text(token);
  const auto upper = [](char c) { return c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c; };
  std::string_view rest = node->text.substr(1);
  node->area = upper(rest[0]);
  rest.remove_prefix(1);
  if (!rest.empty() && rest[0] != '*' && (rest[0] < '0' || rest[0] > '9')) {
    node->size = upper(rest[0]);
    rest.remove_prefix(1);
  }
  if (rest == "*") {
    node->incomplete = true;
    return node;
  }
  std::vector<uint32_t> numbers{0};
  for (const char c : rest) {
    if (c == '.' || c == ':') {
      numbers.push_back(0);
    } else if (c < '0' || c > '9') { // of MOD, ERR or X
      if (c == 'm' || c == 'M')
        numbers.back() = DirectAddress::kModule;
      else if (c == 'e' || c == 'E')
        numbers.back() = DirectAddress::kError;
    } else {
      const uint64_t value = uint64_t{numbers.back()} * 10 + static_cast<unsigned>(c - '0');
      if (value > 0xFFFF'FFFF) {
        diagnostics_.report(Code::InvalidAddress, node->span,
                            "the number in this address is too large", "at most 4294967295");
        return nullptr;
      }
      numbers.back() = static_cast<uint32_t>(value);
    }
  }
  node->numbers = arena_.copy(numbers);
  return node;
}

// --------------------------------------------------------------------------------------------
// namespaces and configurations

EnumTypeExpr *AstBuilder::enumeration(Context *context, size_t firstArgument, size_t arguments) {
  auto *node = arena_.make<EnumTypeExpr>();
  node->span = span(context);
  std::vector<EnumeratorDecl> list;
  for (size_t i = firstArgument; i < arguments; ++i) {
    Context *argument = child(context, i);
    Context *front = child(argument, 0);
    const Token *plain = plainName(front);
    if (plain == nullptr ||
        (argument->children.size() > 1 && token(last(front) + 1).type != Tok::ASSIGN)) {
      diagnostics_.report(Code::UnexpectedToken, span(argument),
                          "expected the name of an enumerator", "not `name` or `name := value`");
      return nullptr;
    }
    EnumeratorDecl one;
    one.name = name(*plain);
    if (argument->children.size() > 1)
      one.value = expression(child(argument, 1));
    one.doc = doc(*plain);
    list.push_back(one);
  }
  node->enumerators = arena_.copy(list);
  return node;
}

} // namespace stc
