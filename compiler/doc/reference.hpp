#ifndef STRIDE_COMPILER_DOC_REFERENCE_HPP
#define STRIDE_COMPILER_DOC_REFERENCE_HPP
// What a reference says of ST declarations: data between the syntax tree and HTML.

#include "compiler/source/sources.hpp"
#include "compiler/syntax/ast.hpp"

#include <span>
#include <string>
#include <vector>

namespace stc::doc {

/// A parameter, field, enumerator or variable.
struct Member {
  std::string name;
  std::string type; ///< as written; empty: none (an enumerator)
  std::string init; ///< as written; empty: none
  std::string text; ///< its doc comment
};

/// Members under one title: "Inputs", "Outputs" …
struct Group {
  std::string title;
  std::vector<Member> members;
};

/// One declaration.
struct Entry {
  std::string kind;   ///< "Function block", "Enumeration" …
  std::string name;   ///< "MC_Power"; a method's "Block.Method"; with the NAMESPACE around it
  std::string suffix; ///< what follows the name: ": REAL", "EXTENDS Base"
  std::string text;
  std::vector<Group> groups;
  std::vector<Entry> parts;              ///< methods, actions and properties
  std::vector<std::string> aliases = {}; ///< other names under which the search finds it
  std::string figure = {};               ///< page of a picture, `figures/Lib/Block.svg`; or empty
  std::string caption = {};              ///< what the picture shows
};

/// What stands on one page: a library, a namespace, or the operators of the language.
struct Module {
  std::string name;
  std::string text;
  std::vector<Entry> entries; ///< sorted by name
};

/// Everything in `files` that other code can use: nothing that is PRIVATE or has
/// `{attribute 'hide'}`, and no VAR of a block or function.
[[nodiscard]] Module describe(std::string name, std::span<const ast::File *const> files,
                              const Sources &sources);

/// The functions that the compiler implements itself (`LEN`, `LIMIT`, `TO_INT` …).
[[nodiscard]] Module builtinFunctions();

/// The text up to its first full stop.
[[nodiscard]] std::string firstSentence(const std::string &text);

} // namespace stc::doc

#endif // STRIDE_COMPILER_DOC_REFERENCE_HPP
