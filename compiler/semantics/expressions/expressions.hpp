#ifndef STRIDE_COMPILER_SEMANTICS_EXPRESSIONS_EXPRESSIONS_HPP
#define STRIDE_COMPILER_SEMANTICS_EXPRESSIONS_EXPRESSIONS_HPP
// Expressions.

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/conversions.hpp"

namespace stc::sema {

/// The value of an integer constant; nothing (reported) when it is none. `what` it is, for the
/// words.
std::optional<int64_t> constantInteger(Context &c, ast::Expr *expr, std::string_view what);
/// Checks an expression and gives its type, the error type when something has been reported.
/// `expected`: the type that its place asks for, which decides about enumerators; null: any.
const Type *check(Context &c, ast::Expr *expr, const Type *expected = nullptr);
/// `expr` whose base has been checked to be of type `base` and is no namespace.
const Type *checkMemberOf(Context &c, ast::MemberExpr *expr, const Type *base);
/// What stands before a dot, if that is a library, namespace, list or type; null: a value.
Symbol *resolveNamespace(Context &c, ast::Expr *expr);
/// Checks `expr` and converts it to `type`.
void checkAs(Context &c, ast::Expr *expr, const Type *type, std::string_view what);
/// Checks an expression that must be BOOL. `what`: for the words.
void checkCondition(Context &c, ast::Expr *expr, std::string_view what);
/// Reports what is no variable, or cannot be written, for the action `what`: `assign to`, `pass`,
/// `refer to`, `call` …
bool requireVariable(Context &c, ast::Expr *expr, std::string_view what);
/// Reports a variable that cannot be referred to because it is misaligned.
bool requireAligned(Context &c, const ast::Expr *expr, std::string_view what);
/// Reports a strict enumeration where a number is needed.
bool refuseStrict(Context &c, ast::Expr *expr);
/// Converts a checked expression to `type`; reports what does not convert.
void coerce(Context &c, ast::Expr *expr, const Type *type, std::string_view what);
/// Reports a conversion that is not done silently, with what to write.
void reportConversion(Context &c, ast::Expr *expr, const Type *from, const Type *to,
                      Conversion conversion, std::string_view what);
/// Gives an untyped constant a type of its own.
const Type *settle(ast::Expr *expr);
/// Notes the implicit conversion of a checked expression.
void setTarget(ast::Expr *expr, const Type *type);
/// Whether the expression names a member of an AXIS_REF. V2.3 had REAL there, Stride has LREAL.
bool isAxisField(const ast::Expr *expr);
/// A member or a pin whose value becomes one of that type without a word: {attribute 'narrows_to'}.
bool narrowsTo(const VarSymbol *variable, const Type *type);
/// The expression names a REFERENCE (that is followed where its value is meant).
bool isReference(ast::Expr *expr);
/// `a REF= b`, whose targets have been checked.
void checkReferenceAssign(Context &c, ast::AssignStmt *stmt);
/// The checked value is the 0 (or NULL) with which a REFERENCE TO `type` refers to nothing; it is
/// given the type of such a reference then.
[[nodiscard]] bool refersToNothing(Context &c, ast::Expr *value, const Type *type);
/// Edition 3 writes `THIS.x` and `SUPER()` for what CODESYS writes as `THIS^.x` and `SUPER^()`.
void followSelf(Context &c, ast::Expr *&expr);
/// Reports a place in a block's own variables, which only its own code may change.
bool requireOwn(Context &c, const ast::Expr *place);
/// Reports a member that may not be used here.
bool requireAccess(Context &c, Span span, const Symbol *member, const PouSymbol *owner,
                   ast::Access access);
/// A property is no variable: nothing can refer to it.
bool rejectProperty(Context &c, const ast::Expr *expr, std::string_view action);
/// Checks an expression that is going to be assigned to.
const Type *checkTarget(Context &c, ast::Expr *expr);

} // namespace stc::sema

#endif // STRIDE_COMPILER_SEMANTICS_EXPRESSIONS_EXPRESSIONS_HPP
