#ifndef STRIDE_COMPILER_SYNTAX_FORMAT_LAYOUT_HPP
#define STRIDE_COMPILER_SYNTAX_FORMAT_LAYOUT_HPP
// The structure of a text to be formatted: which tokens make a line, and how deep it is indented.
// Internal to compiler/syntax.

#include "compiler/syntax/format_line.hpp"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

class FormatLayout {
public:
  FormatLayout(std::vector<FormatItem> items, const FormatStyle &style);

  std::string run();

private:
  enum class Kind : uint8_t {
    File,
    Space,         ///< NAMESPACE
    Configuration, ///< also RESOURCE
    Pou,           ///< also a member
    Property,
    Accessor, ///< GET, SET
    Actions,
    Section, ///< VAR
    Types,
    Structure,
    Enumeration,
    Condition, ///< IF
    Choice,    ///< CASE
    Branch,    ///< after the labels of a CASE
    Loop,
    Attempt, ///< __TRY
  };
  /// Something that is open.
  struct Block {
    Kind kind = Kind::File;
    uint16_t type = 0;    ///< of the keyword that opened it
    unsigned level = 0;   ///< of that keyword
    unsigned content = 0; ///< of what stands inside
  };
  struct Line {
    unsigned level = 0;
    std::string text;    ///< without indentation; may hold further lines
    std::string comment; ///< after it
    bool blank = false;  ///< an empty line before it
    bool declaration = false;
  };

  [[nodiscard]] uint16_t type(size_t i) const {
    return i < items_.size() ? items_[i].type : Token::kEnd;
  }
  [[nodiscard]] bool isWordAt(size_t i, std::string_view lower) const;
  [[nodiscard]] bool hasComments(size_t from, size_t to) const;

  // format_layout.cpp: lines and comments
  /// The comments before the current token: after the last line, on lines of their own, or in
  /// `prefix_`.
  void comments();
  /// The comments of `prefix_` before a line of that level.
  [[nodiscard]] std::string prefixAt(unsigned level) const;
  void commentLine(size_t from, size_t to);
  void conditional(std::string_view comment);
  /// Items [at_, to) become a line; `at_` moves on.
  void emit(size_t to, unsigned level, LineKind kind);
  void emitText(unsigned level, std::string text, bool blank);
  [[nodiscard]] unsigned commentLevel() const;
  [[nodiscard]] size_t colonOf(size_t from, size_t to, unsigned level);
  [[nodiscard]] std::string join() const;
  void alignComments();

  // format_structure.cpp: what a line is
  void line();
  bool closer();
  bool declaration();
  void section();
  void typeBlock();
  void accessor();
  bool configurationPart();
  bool insideSection();
  void typeDeclaration();
  void enumerationLine();
  void statement();
  void branchLabel();
  void open(Kind kind, size_t to, LineKind line, bool indents);
  /// Closes the nearest block of that kind and what is open in it; the level of its keyword.
  unsigned closeBlock(Kind kind);
  unsigned closeBlock(uint16_t opener);
  void closeStatements();
  /// Where the closing line that begins at `i` ends.
  [[nodiscard]] size_t withSemicolons(size_t i) const;
  [[nodiscard]] size_t through(size_t i, uint16_t last) const;
  [[nodiscard]] size_t statementEnd(size_t i) const;
  [[nodiscard]] size_t headEnd(size_t i) const;
  [[nodiscard]] size_t headRest(size_t i, uint16_t keyword) const;
  [[nodiscard]] size_t headType(size_t i) const;
  [[nodiscard]] bool stopsStatement(size_t i) const;
  [[nodiscard]] bool startsDeclaration(size_t i) const;
  [[nodiscard]] bool startsSection(size_t i) const;
  [[nodiscard]] bool startsAccessor(size_t i) const;
  [[nodiscard]] size_t labelEnd(size_t i) const;
  [[nodiscard]] bool isOnlyType(size_t i) const;

  std::vector<FormatItem> items_;
  const FormatStyle &style_;
  std::set<std::string> jumpTargets_;
  std::vector<Block> blocks_{Block{}};
  std::vector<std::vector<Block>> conditionals_; ///< what was open at each open `{IF …}`
  std::vector<Line> lines_;
  std::vector<const FormatComment *> prefix_; ///< on the line of the token after them
  size_t at_ = 0;
  bool blank_ = false;      ///< an empty line is wanted before the next line
  bool afterOpener_ = true; ///< none is
  bool separate_ = false;   ///< one must be there, after a POU
  bool closing_ = false;    ///< the next line closes a block
  size_t runEnd_ = 0;       ///< declarations up to this item have their colons in one column
  size_t runColon_ = 0;     ///< that column
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_FORMAT_LAYOUT_HPP
