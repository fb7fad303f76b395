// Initial values.

#include "compiler/syntax/ast_builder.hpp"
#include "compiler/syntax/parser.hpp"
#include <algorithm>
#include <string>

namespace stc {

using namespace ast;

bool AstBuilder::isRepetition(Context *expression) const {
  if (expression->children.size() != 1)
    return false;
  const Context *only = child(expression, 0);
  const size_t at = first(only);
  return token(at).type == Tok::INTEGER && token(at + 1).type == Tok::LPAREN &&
         only->children.size() == 1 &&
         last(only) == (child(only, 0)->children.empty() ? at + 2 : last(child(only, 0)) + 1);
}

AggregateItem AstBuilder::item(Context *expression) {
  AggregateItem out;
  out.span = span(expression);
  if (!isRepetition(expression)) {
    out.value = initialValue(expression);
    return out;
  }
  Context *only = child(expression, 0);
  out.repeat = literal(token(first(only)));
  Context *inside = child(only, 0);
  std::vector<AggregateItem> values;
  for (size_t i = 0; i < inside->children.size(); ++i) {
    Context *argument = child(inside, i);
    if (argument->children.size() != 1) {
      // `3(a := 1)` repeats a structure written without its own parentheses.
      out.value = structAggregate(inside, span(inside));
      return out;
    }
    values.push_back(item(child(argument, 0)));
  }
  if (values.size() == 1 && values[0].repeat == nullptr)
    out.value = values[0].value;
  else
    out.values = arena_.copy(values);
  return out;
}

Expr *AstBuilder::aggregate(const std::vector<AggregateItem> &items, bool isStruct, Span whole) {
  auto *node = arena_.make<AggregateExpr>();
  node->span = whole;
  node->items = arena_.copy(items);
  node->isStruct = isStruct;
  return node;
}

Expr *AstBuilder::structAggregate(Context *inside, Span whole) {
  std::vector<AggregateItem> fields;
  std::vector<AggregateItem> elements; // of an array field in V2.3's way: `(a := 1, 2, 3, b := 0)`
  const auto closeField = [&] {
    if (!fields.empty() && elements.size() > 1) {
      const Span of = elements.front().span.to(elements.back().span);
      fields.back().value = aggregate(elements, false, of);
      fields.back().span = fields.back().span.to(of);
    }
    elements.clear();
  };
  for (size_t i = 0; i < inside->children.size(); ++i) {
    Context *argument = child(inside, i);
    Context *front = child(argument, 0);
    if (last(front) == last(argument)) { // no name
      if (fields.empty()) {
        diagnostics_
            .report(Code::UnexpectedToken, span(argument), "this value has no name",
                    "expected `name := value`")
            .help("the elements of an array stand in brackets: `[1, 2, 3]`");
        return error(whole);
      }
      elements.push_back(item(front));
      continue;
    }
    closeField();
    const Token *plain = plainName(front);
    if (plain == nullptr || token(last(front) + 1).type != Tok::ASSIGN ||
        argument->children.size() < 2) {
      Diagnostic &d = diagnostics_.report(Code::ArgumentName, span(argument),
                                          "expected `name := value` in the list of fields");
      if (inside->children.size() == 1)
        d.help("an assignment is a statement of its own; to compare, write `=`");
      return error(whole);
    }
    AggregateItem field;
    field.field = name(*plain);
    field.span = span(argument);
    elements.push_back(item(child(argument, 1)));
    field.value = elements.front().repeat == nullptr
                      ? elements.front().value
                      : aggregate({elements.front()}, false, elements.front().span);
    fields.push_back(field);
  }
  closeField();
  return aggregate(fields, true, whole);
}

Expr *AstBuilder::initialValue(Context *context) {
  if (isRepetition(context))
    return aggregate({item(context)}, false, span(context));
  return expression(context);
}

Expr *AstBuilder::initializer(Context *context) {
  if (context->children.size() == 1)
    return initialValue(child(context, 0));
  std::vector<AggregateItem> items;
  for (size_t i = 0; i < context->children.size(); ++i)
    items.push_back(item(child(context, i)));
  return aggregate(items, false, span(context));
}

} // namespace stc
