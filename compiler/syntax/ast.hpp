#ifndef STRIDE_COMPILER_SYNTAX_AST_HPP
#define STRIDE_COMPILER_SYNTAX_AST_HPP
// The typed syntax tree. Nodes live in an Arena and are trivially destructible; children are
// pointers and spans into the same arena. Fields marked [sema] are empty after parsing and filled
// in by compiler/semantics.

#include "compiler/syntax/ast_declarations.hpp"
#include "compiler/syntax/ast_expressions.hpp"
#include "compiler/syntax/ast_statements.hpp"

#endif // STRIDE_COMPILER_SYNTAX_AST_HPP
