#ifndef STRIDE_COMPILER_SYNTAX_TOKEN_HPP
#define STRIDE_COMPILER_SYNTAX_TOKEN_HPP
// Tokens between scanner and parser. Internal to compiler/syntax: includes ANTLR.

#include "StLexer.h"

#include <cstdint>
#include <limits>
#include <string_view>

namespace stc {

/// Token types are those of grammar/StLexer.g4.
using Tok = grammar::StLexer;

/// A token of one parse unit: 32 bytes, no text of its own.
class Token final : public antlr4::Token {
public:
  static constexpr uint16_t kEnd = std::numeric_limits<uint16_t>::max();

  uint16_t type = kEnd;
  /// An error in it was reported already: do not report another one that follows from it.
  bool reported = false;
  /// Pragmas and doc comments before it: that many, from Scanner::trivia()[triviaBegin] on.
  uint8_t triviaCount = 0;
  uint32_t begin = 0;
  uint32_t end = 0;
  uint32_t index = 0; ///< in its unit
  uint32_t hash = 0;  ///< hashIdent() of a word
  uint32_t triviaBegin = 0;

  [[nodiscard]] size_t getType() const override { return type == kEnd ? EOF : type; }
  [[nodiscard]] size_t getTokenIndex() const override { return index; }
  [[nodiscard]] size_t getStartIndex() const override { return begin; }
  [[nodiscard]] size_t getStopIndex() const override { return end; }
  // ANTLR asks for the following only to print messages, which we do ourselves.
  [[nodiscard]] std::string getText() const override { return {}; }
  [[nodiscard]] size_t getLine() const override { return 0; }
  [[nodiscard]] size_t getCharPositionInLine() const override { return 0; }
  [[nodiscard]] size_t getChannel() const override { return 0; }
  [[nodiscard]] antlr4::TokenSource *getTokenSource() const override { return nullptr; }
  [[nodiscard]] antlr4::CharStream *getInputStream() const override { return nullptr; }
  [[nodiscard]] std::string toString() const override { return {}; }
};

/// What may stand before a token and belongs to the declaration that begins there.
struct Trivia {
  enum class Kind : uint8_t { Attribute, Doc, External };
  Kind kind = Kind::Doc;
  uint32_t begin = 0;
  uint32_t end = 0;
  std::string_view name;  ///< attribute: its name; doc: the line's text
  std::string_view value; ///< attribute: what stands after `:=`
};

/// What a word means where it is a keyword.
struct Keyword {
  /// When the word is a keyword.
  enum class Kind : uint8_t {
    None,       ///< a plain identifier
    Hard,       ///< everywhere
    Operation,  ///< everywhere but as a function's name, `AND(a, b)`
    Qualifier,  ///< after VAR…: CONSTANT, RETAIN, …
    At,         ///< before an address
    Pointer,    ///< in a type, before TO
    Infix,      ///< after an operand: AND_THEN, OR_ELSE
    Statement,  ///< as a whole statement: CONTINUE
    Clause,     ///< between two names: EXTENDS, IMPLEMENTS
    Modifier,   ///< after the keyword that opens a declaration
    Construct,  ///< opens a declaration, before a name
    Local,      ///< in PROPERTY, CONFIGURATION, VAR_ACCESS: FileParser decides
    Assignment, ///< S, R, REF directly before `=`
  };
  Kind kind = Kind::None;
  uint16_t type = 0;
};

/// `hash` is hashIdent(word).
[[nodiscard]] Keyword findKeyword(std::string_view word, uint32_t hash);

/// Case-insensitive comparison with a lower-case word.
[[nodiscard]] bool isWord(std::string_view text, std::string_view lower);

/// The sign or word of a token type as the user writes it (`:=`, `END_IF`); empty for identifiers
/// and literals.
[[nodiscard]] std::string_view tokenSpelling(uint16_t type);

/// True for keywords, that is for types whose token looks like a name.
[[nodiscard]] bool isKeywordType(uint16_t type);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_TOKEN_HPP
