#ifndef STRIDE_COMPILER_SYNTAX_SCANNER_HPP
#define STRIDE_COMPILER_SYNTAX_SCANNER_HPP
// From characters to tokens. Internal to compiler/syntax.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/conditions.hpp"
#include "compiler/syntax/pragmas.hpp"
#include "compiler/syntax/token.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// Reads one file's tokens from front to back. Decides by the neighbouring tokens whether a soft
/// keyword is one.
class Scanner {
public:
  /// Without `conditions` every branch of conditional pragmas is read and messages are ignored.
  Scanner(const SourceFile &file, Diagnostics &diagnostics, Conditions *conditions = nullptr);

  /// The next token; of type Token::kEnd at the end of the text, again and again.
  Token next();
  /// Pragmas and doc comments so far; tokens refer to it.
  [[nodiscard]] const std::vector<Trivia> &trivia() const { return trivia_; }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] std::string_view text(const Token &token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }
  /// After the comment that begins at `place`; `place` when there is none.
  [[nodiscard]] size_t comment(size_t place) const;
  /// After the `}` of the pragma that begins at `begin`; npos when it has none.
  [[nodiscard]] size_t pragmaEnd(size_t begin) const;

private:
  [[nodiscard]] char at(size_t place) const { return place < text_.size() ? text_[place] : '\0'; }
  [[nodiscard]] Span span(size_t begin, size_t end) const {
    return {file_, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
  }
  [[nodiscard]] bool afterOperand() const;
  [[nodiscard]] bool atLineStart(size_t place) const;
  /// The place of the next character that is neither blank nor comment.
  [[nodiscard]] size_t significant(size_t place) const;
  [[nodiscard]] std::string_view wordAt(size_t place) const;
  [[nodiscard]] bool nameFollows(size_t place) const;
  [[nodiscard]] bool declaresName(size_t wordEnd) const;
  [[nodiscard]] bool pointerBegins(Keyword keyword, size_t wordEnd) const;
  [[nodiscard]] bool statementBegins(size_t wordEnd) const;
  [[nodiscard]] bool modifies(size_t wordEnd) const;
  [[nodiscard]] bool constructBegins(Keyword keyword, size_t wordEnd) const;
  [[nodiscard]] bool isKeywordHere(Keyword keyword, size_t wordEnd) const;

  void skipBlanks();
  void blockComment(size_t begin);
  void nestedComment(size_t begin);
  void lineComment(size_t begin);
  /// A conditional pragma that is open.
  struct Branch {
    Span place;
    bool taken;   ///< one of its branches is compiled
    bool sawElse; ///< `{ELSE}` was there
  };
  /// A pragma, as far as it has been read.
  struct Pragma {
    PragmaWord word;
    std::string_view spelling; ///< of the word
    Span whole;
    size_t place; ///< what comes next
    size_t end;   ///< the place of its `}`
  };
  void pragma(size_t begin);
  [[nodiscard]] Pragma pragmaAt(size_t begin, size_t end) const;
  [[nodiscard]] size_t afterBlanks(size_t place, size_t end) const;
  void attributePragma(const Pragma &pragma);
  void directive(const Pragma &pragma);
  void otherBranch(const Pragma &pragma);
  void definition(const Pragma &pragma);
  void message(const Pragma &pragma, Code code);
  void warningPragma(size_t place, size_t end);
  void checkElse(const Pragma &pragma);
  void branch(size_t p, size_t end);
  void skipInactive();
  [[nodiscard]] bool endsInactive(const Pragma &pragma, size_t &depth);
  void reportOpenBranches();

  struct Word {
    std::string_view text;
    uint32_t hash = 0;
    bool foreignLetters = false;
    bool doubled = false; ///< two underscores in a row
  };
  [[nodiscard]] inline Word wordFrom(size_t begin) const;
  void reportForeignLetters(size_t begin, const Word &word);
  inline uint16_t keywordOf(size_t begin, const Word &word, Token &token);
  inline void checkName(size_t begin, const Word &word, Token &token);
  uint16_t word(size_t begin, Token &token);
  uint16_t prefixedLiteral(size_t begin, Token &token);
  uint16_t number(size_t begin, Token &token);
  uint16_t quoted(size_t begin, char quote, Token &token);
  uint16_t address(size_t begin, Token &token);
  [[nodiscard]] size_t afterNumbers(size_t place, bool ofWord) const;
  inline uint16_t signOfOthers(size_t begin, Token &token);
  uint16_t sign(size_t begin, Token &token);
  uint16_t foreign(size_t begin, size_t length, uint16_t meant, Token &token);
  // foreign.cpp
  uint16_t misspelledKeyword(size_t begin, std::string_view spelling, Token &token);
  uint16_t foreignPair(size_t begin, Token &token);
  uint16_t foreignSign(size_t begin, size_t length, uint16_t meant, Token &token, std::string help);
  [[nodiscard]] std::string targetBefore(size_t place) const;
  void bracesAsBlock(size_t begin, size_t end);
  void numberBody();
  void badCharacters(size_t begin);
  /// True for the first of several equal names, so that one mistake is reported once.
  [[nodiscard]] bool firstOf(uint32_t hash);

  static constexpr unsigned kMaxBadCharacters = 20;

  std::string_view text_;
  FileId file_;
  Diagnostics &diagnostics_;
  size_t place_ = 0;
  uint16_t previous_ = 0;       ///< type of the last token
  uint16_t beforePrevious_ = 0; ///< and of the one before it
  bool sectionHead_ = false;    ///< after VAR… and its qualifiers
  uint16_t pending_ = 0;        ///< a token that was read together with the last one
  uint32_t pendingTrivia_ = 0;
  unsigned badCharacters_ = 0;
  std::vector<uint32_t> badNames_; ///< hashes of names that were reported
  std::vector<Trivia> trivia_;
  Conditions *conditions_;
  std::vector<Branch> branches_;
};

/// True when the bytes cannot be meant as text.
[[nodiscard]] bool looksBinary(std::string_view text);

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_SCANNER_HPP
