#ifndef STRIDE_TESTS_UNIT_SYNTAX_PRINT_EXPRESSION_HPP
#define STRIDE_TESTS_UNIT_SYNTAX_PRINT_EXPRESSION_HPP
// Types and expressions of the syntax tree, for print_ast.cpp.

#include "compiler/syntax/ast.hpp"

#include <span>
#include <sstream>
#include <string>
#include <string_view>

namespace stc::test {

using namespace ast;

inline const char *symbol(BinaryOp op) {
  static constexpr const char *kSymbols[] = {
      "+",  "-", "*",  "/",   "MOD", "**",  "=",        "<>",     "<",
      "<=", ">", ">=", "AND", "OR",  "XOR", "AND_THEN", "OR_ELSE"};
  return kSymbols[static_cast<size_t>(op)];
}

inline const char *suffix(LiteralKind kind) {
  switch (kind) {
  case LiteralKind::Time:
    return "ms";
  case LiteralKind::Ltime:
    return "ns";
  case LiteralKind::Date:
    return "s(date)";
  case LiteralKind::Ldate:
    return "ns(ldate)";
  case LiteralKind::Tod:
    return "ms(tod)";
  case LiteralKind::Ltod:
    return "ns(ltod)";
  case LiteralKind::Dt:
    return "s(dt)";
  case LiteralKind::Ldt:
    return "ns(ldt)";
  default:
    return "";
  }
}

/// Types and expressions as text with parentheses.
class ExpressionPrinter {
public:
  std::string take() { return out_.str(); }

  void literal(const Literal *node) {
    if (node->typeName)
      out_ << node->typeName.text << '#' << (node->negative ? "-" : "");
    switch (node->literal) {
    case LiteralKind::Boolean:
      out_ << (node->integer != 0 ? "TRUE" : "FALSE");
      break;
    case LiteralKind::Real:
      out_ << node->real;
      break;
    case LiteralKind::String:
      out_ << '\'' << node->text << '\'';
      break;
    case LiteralKind::Wstring:
      out_ << '"' << node->text << '"';
      break;
    case LiteralKind::Ltime:
      out_ << static_cast<int64_t>(node->integer) << suffix(node->literal);
      break;
    default:
      out_ << node->integer << suffix(node->literal);
    }
  }

  void items(std::span<AggregateItem> list) {
    for (const AggregateItem &item : list) {
      out_ << ' ';
      if (item.field)
        out_ << item.field.text << ":=";
      if (item.repeat != nullptr) {
        expression(item.repeat);
        out_ << '*';
      }
      if (item.value != nullptr) {
        expression(item.value);
      } else {
        out_ << '{';
        items(item.values);
        out_ << " }";
      }
    }
  }

  void arguments(std::span<Argument> list) {
    for (const Argument &argument : list) {
      out_ << ' ';
      if (argument.name)
        out_ << argument.name.text << (argument.output ? "=>" : ":=");
      if (argument.value != nullptr || !argument.name)
        expression(argument.value);
    }
  }

  void address(const DirectAddress *node) {
    out_ << '%' << node->area << node->size;
    const char *separator = "";
    for (const uint32_t number : node->numbers) {
      out_ << separator << number;
      separator = ".";
    }
    out_ << (node->incomplete ? "*" : "");
  }

  void path(NamePath names) {
    const char *separator = "";
    for (const Name &name : names) {
      out_ << separator << name.text;
      separator = ".";
    }
  }

  void expression(const Expr *node) {
    if (node == nullptr) {
      out_ << "null";
      return;
    }
    if (node->parenthesized)
      out_ << "p";
    switch (node->kind) {
    case ExprKind::Literal:
      literal(as<Literal>(node));
      break;
    case ExprKind::Name:
      out_ << as<NameExpr>(node)->name.text;
      break;
    case ExprKind::Member: {
      const auto *m = as<MemberExpr>(node);
      out_ << "(. ";
      expression(m->base);
      if (m->bit >= 0 && m->width != 1)
        out_ << " part" << int{m->width} << ' ' << m->bit << ')';
      else if (m->bit >= 0)
        out_ << " bit " << m->bit << ')';
      else
        out_ << ' ' << m->name.text << ')';
      break;
    }
    case ExprKind::Index: {
      const auto *i = as<IndexExpr>(node);
      out_ << "([] ";
      expression(i->base);
      for (const Expr *index : i->indices) {
        out_ << ' ';
        expression(index);
      }
      out_ << ')';
      break;
    }
    case ExprKind::Deref:
      out_ << "(^ ";
      expression(as<DerefExpr>(node)->base);
      out_ << ')';
      break;
    case ExprKind::Call: {
      const auto *c = as<CallExpr>(node);
      out_ << "(call ";
      expression(c->callee);
      arguments(c->arguments);
      out_ << ')';
      break;
    }
    case ExprKind::Unary: {
      const auto *u = as<UnaryExpr>(node);
      out_ << '(' << (u->op == UnaryOp::Negate ? "-" : u->op == UnaryOp::Plus ? "+" : "NOT") << ' ';
      expression(u->operand);
      out_ << ')';
      break;
    }
    case ExprKind::Binary: {
      const auto *b = as<BinaryExpr>(node);
      out_ << '(' << symbol(b->op) << ' ';
      expression(b->left);
      out_ << ' ';
      expression(b->right);
      out_ << ')';
      break;
    }
    case ExprKind::Direct:
      address(as<DirectExpr>(node)->address);
      break;
    case ExprKind::TypeName:
      out_ << "(type ";
      type(as<TypeNameExpr>(node)->name);
      out_ << ')';
      break;
    case ExprKind::Aggregate: {
      const auto *a = as<AggregateExpr>(node);
      out_ << (a->isStruct ? "(struct" : "(list");
      items(a->items);
      out_ << ')';
      break;
    }
    case ExprKind::EnumLiteral:
      out_ << as<EnumLiteralExpr>(node)->typeName.text << '#'
           << as<EnumLiteralExpr>(node)->enumerator.text;
      break;
    case ExprKind::Error:
      out_ << "error";
      break;
    }
  }

  void type(const TypeExpr *node) {
    switch (node->kind) {
    case TypeExprKind::Named: {
      const auto *named = as<NamedTypeExpr>(node);
      path(named->path);
      if (named->hasArguments && named->elements.empty()) {
        out_ << '(';
        arguments(named->arguments);
        out_ << ')';
      }
      for (const std::span<Argument> &one : named->elements) {
        out_ << '[';
        arguments(one);
        out_ << ']';
      }
      break;
    }
    case TypeExprKind::Array: {
      const auto *a = as<ArrayTypeExpr>(node);
      out_ << "(array";
      for (const ArrayRange &range : a->ranges) {
        out_ << ' ';
        if (range.low == nullptr) {
          out_ << '*';
          continue;
        }
        expression(range.low);
        out_ << "..";
        expression(range.high);
      }
      out_ << ' ';
      type(a->element);
      out_ << ')';
      break;
    }
    case TypeExprKind::String: {
      const auto *s = as<StringTypeExpr>(node);
      out_ << (s->wide ? "WSTRING" : "STRING");
      if (s->length != nullptr) {
        out_ << '(';
        expression(s->length);
        out_ << ')';
      }
      break;
    }
    case TypeExprKind::Inferred:
      out_ << "inferred";
      break;
    case TypeExprKind::Pointer:
    case TypeExprKind::Reference:
      out_ << (as<PointerTypeExpr>(node)->refTo      ? "(ref-to "
               : node->kind == TypeExprKind::Pointer ? "(pointer "
                                                     : "(reference ");
      type(as<PointerTypeExpr>(node)->pointee);
      out_ << ')';
      break;
    case TypeExprKind::Subrange: {
      const auto *s = as<SubrangeTypeExpr>(node);
      out_ << "(range ";
      type(s->base);
      out_ << ' ';
      expression(s->low);
      out_ << ' ';
      expression(s->high);
      out_ << ')';
      break;
    }
    case TypeExprKind::Enumeration: {
      const auto *e = as<EnumTypeExpr>(node);
      out_ << "(enum";
      if (e->base != nullptr) {
        out_ << " of ";
        type(e->base);
      }
      for (const EnumeratorDecl &one : e->enumerators) {
        out_ << ' ' << one.name.text;
        if (!one.doc.empty())
          out_ << "///" << one.doc;
        if (one.value != nullptr) {
          out_ << ":=";
          expression(one.value);
        }
      }
      out_ << ')';
      break;
    }
    case TypeExprKind::Error:
      out_ << "error";
      break;
    }
  }

protected:
  std::ostringstream out_;
};

} // namespace stc::test

#endif // STRIDE_TESTS_UNIT_SYNTAX_PRINT_EXPRESSION_HPP
