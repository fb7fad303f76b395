#pragma once
// From characters to tokens. Internal to compiler/syntax.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"
#include "compiler/syntax/conditions.hpp"
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
  /// Behind the comment that begins at `place`; `place` when there is none.
  [[nodiscard]] std::size_t comment(std::size_t place) const;
  /// Behind the `}` of the pragma that begins at `begin`; npos when it has none.
  [[nodiscard]] std::size_t pragmaEnd(std::size_t begin) const;

private:
  [[nodiscard]] char at(std::size_t place) const {
    return place < text_.size() ? text_[place] : '\0';
  }
  [[nodiscard]] Span span(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }
  [[nodiscard]] bool afterOperand() const;
  [[nodiscard]] bool atLineStart(std::size_t place) const;
  /// The place of the next character that is neither blank nor comment.
  [[nodiscard]] std::size_t significant(std::size_t place) const;
  [[nodiscard]] std::string_view wordAt(std::size_t place) const;
  [[nodiscard]] bool nameFollows(std::size_t place) const;
  [[nodiscard]] bool declaresName(std::size_t wordEnd) const;
  [[nodiscard]] bool isKeywordHere(Keyword keyword, std::size_t wordEnd) const;

  void skipBlanks();
  void blockComment(std::size_t begin);
  void nestedComment(std::size_t begin);
  void lineComment(std::size_t begin);
  /// A conditional pragma that is open.
  struct Branch {
    Span place;
    bool taken;   ///< one of its branches is compiled
    bool sawElse; ///< `{ELSE}` was there
  };
  void pragma(std::size_t begin);
  void warningPragma(std::size_t place, std::size_t end);
  void directive(std::string_view keyword, std::size_t begin, std::size_t p, std::size_t end);
  void message(std::string_view keyword, Span whole, std::size_t p, std::size_t end);
  void checkElse(std::string_view keyword, Span whole);
  void branch(std::size_t p, std::size_t end);
  void skipInactive();
  void reportOpenBranches();

  std::uint16_t word(std::size_t begin, Token &token);
  std::uint16_t prefixedLiteral(std::size_t begin, Token &token);
  std::uint16_t number(std::size_t begin, Token &token);
  std::uint16_t quoted(std::size_t begin, char quote, Token &token);
  std::uint16_t address(std::size_t begin, Token &token);
  std::uint16_t sign(std::size_t begin, Token &token);
  std::uint16_t foreign(std::size_t begin, std::size_t length, std::uint16_t meant, Token &token);
  // foreign.cpp
  std::uint16_t misspelledKeyword(std::size_t begin, std::string_view spelling, Token &token);
  std::uint16_t foreignPair(std::size_t begin, Token &token);
  std::uint16_t foreignSign(std::size_t begin, std::size_t length, std::uint16_t meant,
                            Token &token, std::string help);
  [[nodiscard]] std::string targetBefore(std::size_t place) const;
  void bracesAsBlock(std::size_t begin, std::size_t end);
  void numberBody();
  void badCharacters(std::size_t begin);
  /// True for the first of several equal names, so that one mistake is reported once.
  [[nodiscard]] bool firstOf(std::uint32_t hash);

  std::string_view text_;
  FileId file_;
  Diagnostics &diagnostics_;
  std::size_t place_ = 0;
  std::uint16_t previous_ = 0;       ///< type of the last token
  std::uint16_t beforePrevious_ = 0; ///< and of the one before it
  bool sectionHead_ = false;         ///< behind VAR… and its qualifiers
  std::uint16_t pending_ = 0;        ///< a token that was read together with the last one
  std::uint32_t pendingTrivia_ = 0;
  unsigned badCharacters_ = 0;
  std::vector<std::uint32_t> badNames_; ///< hashes of names that were reported
  std::vector<Trivia> trivia_;
  Conditions *conditions_;
  std::vector<Branch> branches_;
};

/// True when the bytes cannot be meant as text.
[[nodiscard]] bool looksBinary(std::string_view text);

} // namespace stc
