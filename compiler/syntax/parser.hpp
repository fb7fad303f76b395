#ifndef STRIDE_COMPILER_SYNTAX_PARSER_HPP
#define STRIDE_COMPILER_SYNTAX_PARSER_HPP
// From text to syntax tree.

#include "compiler/source/arena.hpp"
#include "compiler/source/diagnostic.hpp"
#include "compiler/source/identifier.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/source/workers.hpp"
#include "compiler/syntax/ast.hpp"
#include "compiler/syntax/conditions.hpp"

#include <span>
#include <vector>

namespace stc {

/// Deepest nesting of parentheses, brackets and statement blocks that is accepted.
inline constexpr unsigned kMaxNesting = 256;

/// Longest name, in characters.
inline constexpr size_t kMaxName = 255;

/// Parses one file. Always returns a tree (what could be read); reports every syntax error to
/// `diagnostics`. The tree lives in `arena` and refers to the file's text, which must outlive it.
/// `options` answer the conditions of `{IF …}`.
ast::File *parse(const SourceFile &file, Interner &interner, Arena &arena, Diagnostics &diagnostics,
                 const ParseOptions *options = nullptr);

/// Parses several files at once. Trees, diagnostics and their order are those of one parse() after
/// the other, whatever the number of threads.
[[nodiscard]] std::vector<ast::File *>
parseFiles(std::span<const SourceFile *const> files, Interner &interner, Arena &arena,
           Diagnostics &diagnostics, const ParseOptions *options, const Workers &workers);

/// Gives the methods, properties and actions that name a block of another file (`METHOD Block.m`)
/// to that block; reports those that find none.
void attachMembers(std::span<ast::File *const> files, Arena &arena, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_PARSER_HPP
