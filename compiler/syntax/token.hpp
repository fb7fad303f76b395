#pragma once
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
  static constexpr std::uint16_t kEnd = std::numeric_limits<std::uint16_t>::max();

  std::uint16_t type = kEnd;
  /// An error in it was reported already: do not report another one that follows from it.
  bool reported = false;
  /// Pragmas and doc comments in front of it: that many, from Scanner::trivia()[triviaBegin] on.
  std::uint8_t triviaCount = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t index = 0; ///< in its unit
  std::uint32_t hash = 0;  ///< hashIdent() of a word
  std::uint32_t triviaBegin = 0;

  [[nodiscard]] std::size_t getType() const override { return type == kEnd ? EOF : type; }
  [[nodiscard]] std::size_t getTokenIndex() const override { return index; }
  [[nodiscard]] std::size_t getStartIndex() const override { return begin; }
  [[nodiscard]] std::size_t getStopIndex() const override { return end; }
  // ANTLR asks for the following only to print messages, which we do ourselves.
  [[nodiscard]] std::string getText() const override { return {}; }
  [[nodiscard]] std::size_t getLine() const override { return 0; }
  [[nodiscard]] std::size_t getCharPositionInLine() const override { return 0; }
  [[nodiscard]] std::size_t getChannel() const override { return 0; }
  [[nodiscard]] antlr4::TokenSource *getTokenSource() const override { return nullptr; }
  [[nodiscard]] antlr4::CharStream *getInputStream() const override { return nullptr; }
  [[nodiscard]] std::string toString() const override { return {}; }
};

/// What may stand in front of a token and belongs to the declaration that begins there.
struct Trivia {
  enum class Kind : std::uint8_t { attribute, doc, external };
  Kind kind = Kind::doc;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::string_view name;  ///< attribute: its name; doc: the line's text
  std::string_view value; ///< attribute: what stands behind `:=`
};

/// What a word means where it is a keyword.
struct Keyword {
  /// When the word is a keyword.
  enum class Kind : std::uint8_t {
    none,       ///< a plain identifier
    hard,       ///< everywhere
    operation,  ///< everywhere but as a function's name, `AND(a, b)`
    qualifier,  ///< after VAR…: CONSTANT, RETAIN, …
    at,         ///< in front of an address
    pointer,    ///< in a type, in front of TO
    infix,      ///< after an operand: AND_THEN, OR_ELSE
    statement,  ///< as a whole statement: CONTINUE
    clause,     ///< between two names: EXTENDS, IMPLEMENTS
    modifier,   ///< after the keyword that opens a declaration
    construct,  ///< opens a declaration, in front of a name
    local,      ///< in PROPERTY, CONFIGURATION, VAR_ACCESS: FileParser decides
    assignment, ///< S, R, REF directly in front of `=`
  };
  Kind kind = Kind::none;
  std::uint16_t type = 0;
};

/// `hash` is hashIdent(word).
[[nodiscard]] Keyword findKeyword(std::string_view word, std::uint32_t hash);

/// Case-insensitive comparison with a lower-case word.
[[nodiscard]] bool isWord(std::string_view text, std::string_view lower);

/// The sign or word of a token type as the user writes it (`:=`, `END_IF`); empty for identifiers
/// and literals.
[[nodiscard]] std::string_view tokenSpelling(std::uint16_t type);

/// True for keywords, that is for types whose token looks like a name.
[[nodiscard]] bool isKeywordType(std::uint16_t type);

} // namespace stc
