#ifndef STRIDE_COMPILER_SYNTAX_CHART_NODES_HPP
#define STRIDE_COMPILER_SYNTAX_CHART_NODES_HPP
// Makes the nodes of the statements that a chart becomes. Internal to compiler/syntax.

#include "compiler/source/arena.hpp"
#include "compiler/source/identifier.hpp"
#include "compiler/syntax/ast.hpp"

#include <string>
#include <vector>

namespace stc {

class ChartNodes {
public:
  using Statements = std::vector<ast::Stmt *>;

  ChartNodes(Interner &interner, Arena &arena) : interner_(interner), arena_(arena) {}

  ast::Name name(const std::string &text, Span span);
  ast::Expr *variable(const ast::Name &of);
  /// `of.field`, standing at `span`.
  ast::Expr *member(const ast::Name &of, const char *field, Span span);
  ast::Expr *member(const ast::Name &of, const char *field) { return member(of, field, of.span); }
  ast::Expr *boolean(bool value, Span span);
  ast::Expr *text(const ast::Name &of);
  /// T#0ms
  ast::Expr *noTime(Span span);
  ast::Expr *negated(ast::Expr *operand);
  ast::Expr *binary(ast::BinaryOp op, ast::Expr *left, ast::Expr *right);
  /// All of them, or some of them; null for an empty list. Balanced, so that no list of operands is
  /// nested too deeply.
  ast::Expr *combined(ast::BinaryOp op, const std::vector<ast::Expr *> &operands);

  ast::Stmt *empty(Span span);
  ast::Stmt *assign(ast::Expr *target, ast::Expr *value);
  ast::Stmt *when(ast::Expr *condition, const Statements &then, const Statements &otherwise = {});
  ast::Stmt *call(const ast::Name &callee, const std::vector<ast::Argument> &arguments);
  ast::Argument argument(const char *parameter, ast::Expr *value);

  /// A variable of the type with this path.
  ast::VarDecl *declaration(const ast::Name &what, const std::vector<const char *> &type,
                            ast::Section section);
  /// Leaves it out of lists of variables.
  void hide(ast::VarDecl *variable);

private:
  ast::Expr *combined(ast::BinaryOp op, ast::Expr *const *operands, size_t count);

  Interner &interner_;
  Arena &arena_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_CHART_NODES_HPP
