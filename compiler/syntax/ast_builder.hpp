#ifndef STRIDE_COMPILER_SYNTAX_AST_BUILDER_HPP
#define STRIDE_COMPILER_SYNTAX_AST_BUILDER_HPP
// From ANTLR's parse tree to our own. Internal to compiler/syntax: includes ANTLR.

#include "compiler/source/arena.hpp"
#include "compiler/source/diagnostic.hpp"
#include "compiler/source/identifier.hpp"
#include "compiler/syntax/ast.hpp"
#include "compiler/syntax/literals.hpp"
#include "compiler/syntax/scanner.hpp"
#include "compiler/syntax/unit_parser.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace stc {

/// Builds AST nodes from the parse tree of one unit at a time. The tree holds rule contexts only;
/// tokens are looked up by their index. Also says what the grammar is too lenient to say.
class AstBuilder {
public:
  AstBuilder(const Scanner &scanner, FileId file, UnitStream &stream, Interner &interner,
             Arena &arena, Diagnostics &diagnostics);

  /// Null when the head has no name. `owner` gets the names before the last one.
  ast::PouDecl *head(Grammar::PouHeadContext *context, ast::NamePath &owner);
  void section(Grammar::VarSectionContext *context, std::vector<ast::VarDecl *> &out);
  void types(Grammar::TypeBlockContext *context, std::vector<ast::Decl *> &out);
  void statements(Grammar::StatementsContext *context, std::vector<ast::Stmt *> &out);
  [[nodiscard]] ast::NamePath namespaceNames(Grammar::NamespaceHeadContext *context);
  void usings(Grammar::UsingDirectiveContext *context, std::vector<ast::NamePath> &out);
  void resourceHead(Grammar::ResourceHeadContext *context, ast::ResourceDecl &out);
  void task(Grammar::TaskDeclarationContext *context, std::vector<ast::TaskDecl> &out);
  void programInstance(Grammar::ProgramInstanceContext *context,
                       std::vector<ast::ProgramInstanceDecl> &out);

  /// Where variables go that hold literals whose address is taken (`ADR('text')`); null: they are
  /// left to the checker, which refuses them. Gives the place before.
  std::vector<ast::VarDecl *> *setLiteralPlaces(std::vector<ast::VarDecl *> *places) {
    return std::exchange(literalPlaces_, places);
  }

  [[nodiscard]] ast::Name name(const Token &token);
  [[nodiscard]] Interner &interner() { return interner_; }
  void declarationInBody(const ast::Name &variable);
  ast::TypeExpr *errorType(Span span);
  [[nodiscard]] ast::Attributes attributes(const Token &token);
  [[nodiscard]] std::string_view doc(const Token &token);
  [[nodiscard]] Span span(const Token &token) const { return {file_, token.begin, token.end}; }

private:
  using Context = grammar::ContextBase;

  // contexts and tokens
  static Context *child(const Context *context, size_t i) { return context->children[i]; }
  static size_t first(const Context *context) { return context->start->getTokenIndex(); }
  /// Index of the last token; first() - 1 when the context is empty.
  static size_t last(const Context *context);
  static bool failed(const Context *context) { return context->exception.failed(); }
  [[nodiscard]] const Token &token(size_t index) const { return stream_.token(index); }
  [[nodiscard]] std::string_view text(const Token &token) const { return scanner_.text(token); }
  [[nodiscard]] Span span(const Context *context) const;
  [[nodiscard]] std::span<ast::Name> path(const Context *context);
  /// The paths that are the children, without those that hold no name (`EXTENDS A,`).
  [[nodiscard]] std::span<ast::NamePath> paths(const Context *context);

  // declarations
  void modifiers(const Context *context, ast::Decl &out);
  void extendsClause(const Context *clause, const std::string &what, ast::PouDecl &out);
  void implementsClause(const Context *clause, const std::string &what, ast::PouDecl &out);
  void configVariable(Context *context, uint8_t qualifiers, std::vector<ast::VarDecl *> &out);
  void accessVariable(Context *context, std::vector<ast::VarDecl *> &out);
  void declarations(Context *context, size_t from, ast::Section section, uint8_t qualifiers,
                    std::vector<ast::VarDecl *> &out);
  void declaration(Context *context, ast::Section section, uint8_t qualifiers,
                   std::vector<ast::VarDecl *> &out);
  ast::Decl *typeDeclaration(Context *context);
  /// What a structure extends, and where that is written.
  struct StructBase {
    ast::NamePath path;
    Span span;
  };
  void structBase(const Context *clause, StructBase &out);
  ast::StructDecl *structure(Context *body, StructBase base);
  ast::Decl *plainType(const Context *context, size_t i);

  // types
  /// `declared`: of a TYPE, where `INT (a, b)` is an enumeration whatever INT is.
  ast::TypeExpr *type(Context *context, bool declared = false);
  ast::TypeExpr *arrayType(const Context *context);
  ast::TypeExpr *listedType(Context *context);
  ast::TypeExpr *namedType(Context *context, bool declared);
  ast::DirectAddress *address(const Token &token);
  ast::EnumTypeExpr *enumeration(Context *context, size_t firstArgument, size_t arguments);
  void blockArguments(Context *argumentList, ast::NamedTypeExpr &out);

  // statements
  ast::Block block(Context *context);
  ast::Stmt *statement(Context *context);
  ast::Stmt *wordStatement(const Context *context);
  ast::Stmt *jump(const Context *context);
  ast::Stmt *conditionalReturn(Context *context);
  ast::Stmt *simpleStatement(Context *context);
  ast::Stmt *assignment(ast::AssignOp op, const Token &sign,
                        const std::vector<ast::Expr *> &targets, ast::Expr *value);
  ast::Stmt *withoutSign(Context *context);
  ast::Stmt *mixedAssignment(const std::vector<ast::Expr *> &targets,
                             const std::vector<const Token *> &signs, ast::Expr *value);
  ast::Stmt *ifStatement(Context *context);
  ast::Stmt *caseStatement(Context *context);
  ast::Stmt *forStatement(Context *context);
  ast::Stmt *tryStatement(Context *context);
  ast::Expr *condition(Context *context);
  bool assignsCondition(Context *context);
  ast::IfBranch branch(Context *context);
  ast::IfStmt *ifFrom(Context *context, size_t at);

  // expressions
  ast::Expr *expression(Context *context);
  /// The operands [begin, end) among the children, with the operators between them.
  ast::Expr *flat(Context *context, size_t begin, size_t end);
  ast::Expr *operand(Context *context);
  ast::Expr *primary(Context *context, size_t &at, size_t &nextChild);
  ast::Expr *nameOperand(const Token &name);
  ast::Expr *directOperand(const Token &direct);
  ast::Expr *bracketOperand(Context *inside, size_t &at);
  ast::Expr *arrayAggregate(const Context *inside, Span whole);
  ast::Expr *postfix(Context *context, ast::Expr *base, size_t &at, size_t &nextChild);
  ast::Expr *memberOf(ast::Expr *base, const Token &member);
  ast::Expr *bracketed(ast::Expr *base, Context *inside, size_t &at, size_t end);
  void placeLiteral(ast::CallExpr *call);
  ast::TypeExpr *typeOfPlaced(const ast::Literal *literal);
  ast::Expr *indexOf(ast::Expr *base, Context *inside, Span brackets, Span whole);
  void requireArguments(const Context *inside, bool mayEndWithComma);
  ast::Expr *partOf(ast::Expr *base, const Token &member);
  ast::Expr *parentheses(Context *arguments, Span span);
  ast::Expr *prefixed(Context *context, size_t operators, ast::Expr *operand);
  ast::Expr *literal(const Token &token);
  ast::Expr *typedLiteral(const Token &token);
  ast::Expr *enumLiteral(const Token &token);
  ast::Expr *binary(const Token &op, ast::Expr *left, ast::Expr *right);
  /// `context` holds arguments or typeArguments from child `begin` on.
  std::span<ast::Argument> arguments(Context *context, size_t begin = 0);
  ast::Expr *error(Span span);

  // initial values
  ast::Expr *initializer(Context *context);
  ast::Expr *initialValue(Context *expression);
  ast::AggregateItem item(Context *expression);
  [[nodiscard]] static ast::Access accessOf(uint16_t type); ///< PUBLIC, PRIVATE …
  [[nodiscard]] ast::Edge edgeOf(const Context *type, ast::Section section);
  ast::VarDecl *lastCallOf(const ast::VarDecl *input);
  ast::VarDecl *unnamed(const Token &start, const Token &direct);
  ast::Expr *aggregate(const std::vector<ast::AggregateItem> &items, bool isStruct, Span span);
  ast::Expr *structAggregate(Context *arguments, Span span);
  bool isRepetition(Context *expression) const;
  /// The single identifier that the expression consists of; null otherwise.
  [[nodiscard]] const Token *plainName(const Context *expression) const;

  const Scanner &scanner_;
  FileId file_;
  UnitStream &stream_;
  Interner &interner_;
  Arena &arena_;
  Diagnostics &diagnostics_;
  LiteralReader literals_;
  std::vector<ast::VarDecl *> *literalPlaces_ = nullptr;
  size_t placedLiterals_ = 0;       ///< of the file
  std::vector<ast::Stmt *> before_; ///< what the statement being built begins with
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_AST_BUILDER_HPP
