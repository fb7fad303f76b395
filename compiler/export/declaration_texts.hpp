#ifndef STRIDE_COMPILER_EXPORT_DECLARATION_TEXTS_HPP
#define STRIDE_COMPILER_EXPORT_DECLARATION_TEXTS_HPP
// A source file cut into the texts of its declarations, with the comments that belong to them.

#include "compiler/syntax/ast.hpp"

#include <string>
#include <string_view>
#include <unordered_map>

namespace stc::exporting {

/// The text of a POU, a member of one, a type or a list of variables.
struct DeclarationText {
  std::string leading;     ///< comments and pragmas before it
  std::string declaration; ///< head and variables; of types and lists everything
  std::string body;        ///< statements, without members and END_…
  std::string tail;        ///< comments after it
};

/// By declaration: those of a file, their members, and members that belong to blocks of other
/// files.
using DeclarationTexts = std::unordered_map<const ast::Decl *, DeclarationText>;

struct FileTexts {
  DeclarationTexts texts;
  /// The file has conditional pragmas, namespaces or something else that its declarations do not
  /// say one by one.
  bool onlyAsAWhole = false;
};

/// `text`: of the file. It has no errors.
[[nodiscard]] FileTexts declarationTexts(const ast::File &file, std::string_view text);

/// Whether the text of a body is an instruction list, as the parser decides it.
[[nodiscard]] bool isListBody(std::string_view body);

} // namespace stc::exporting

#endif // STRIDE_COMPILER_EXPORT_DECLARATION_TEXTS_HPP
