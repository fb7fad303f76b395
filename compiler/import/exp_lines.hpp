#ifndef STRIDE_COMPILER_IMPORT_EXP_LINES_HPP
#define STRIDE_COMPILER_IMPORT_EXP_LINES_HPP
// Lines of CoDeSys V2.3 exports and what stands in them.

#include "compiler/import/model.hpp"
#include "compiler/source/st_scan.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc::import {

/// The lines without their ends.
[[nodiscard]] std::vector<std::string_view> linesOf(std::string_view text);
[[nodiscard]] std::string joined(const std::vector<std::string> &lines);
/// Letters, digits and `_` at the beginning, after blanks.
[[nodiscard]] std::string_view firstWord(std::string_view line);
/// What stands between the first and the last apostrophe.
[[nodiscard]] std::string quoted(std::string_view text);
/// `\/Motion\/Axes`: Motion, Axes. Parts that are no name of a folder anywhere are changed.
[[nodiscard]] std::vector<std::string> foldersOf(std::string_view path);
/// The identifier after the keyword; in the next lines when the first has none.
[[nodiscard]] std::string declaredName(const std::vector<std::string> &lines);
/// `TASK Fast (PRIORITY := 1, INTERVAL := T#5ms);`
[[nodiscard]] Task taskOf(std::string_view line);

/// Follows comments and texts through the lines of an object. Where comments are not nested, it
/// takes the `(*` inside them apart, for Stride nests them.
class CommentState {
public:
  explicit CommentState(bool nested) : nested_(nested) {}
  /// The line as Stride is to read it.
  [[nodiscard]] std::string line(std::string_view text);
  /// Whether the last line ended inside a comment.
  [[nodiscard]] bool inside() const { return depth_ != 0; }
  [[nodiscard]] size_t changes() const { return changed_; }

private:
  bool nested_;
  size_t depth_ = 0;
  size_t changed_ = 0;
};

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_EXP_LINES_HPP
