#pragma once
// The typed syntax tree. Nodes live in an Arena and are trivially destructible; children are
// pointers and spans into the same arena. Fields marked [sema] are empty after parsing and filled
// in by compiler/semantics.

#include "compiler/syntax/ast_declarations.hpp"
#include "compiler/syntax/ast_expressions.hpp"
#include "compiler/syntax/ast_statements.hpp"
