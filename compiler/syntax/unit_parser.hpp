#ifndef STRIDE_COMPILER_SYNTAX_UNIT_PARSER_HPP
#define STRIDE_COMPILER_SYNTAX_UNIT_PARSER_HPP
// The generated parser on one unit of tokens. Internal to compiler/syntax: includes ANTLR.

#include "compiler/source/diagnostic.hpp"
#include "compiler/syntax/token.hpp"

#include "StParser.h"

#include <deque>
#include <set>
#include <string>
#include <string_view>

namespace stc {

using Grammar = grammar::StParser;

using UnitParser = Grammar;

/// Second run, only over a unit with an error: says what is wrong and goes on at the next statement
/// or declaration.
class ReportStrategy final : public antlr4::ANTLRErrorStrategy {
public:
  ReportStrategy(UnitParser &parser, std::string_view text, FileId file, Diagnostics &diagnostics);

  void reset(antlr4::Parser *) override;
  antlr4::Token *recoverInline(antlr4::Parser *) override;
  void recover(antlr4::Parser *, std::exception_ptr) override;
  void sync(antlr4::Parser *) override;
  bool inErrorRecoveryMode(antlr4::Parser *) override { return recovering_; }
  void reportMatch(antlr4::Parser *) override { recovering_ = false; }
  void reportError(antlr4::Parser *, const antlr4::RecognitionException &) override;

private:
  using Context = grammar::ContextBase;

  [[nodiscard]] Token &current() { return parser_.stream().current(); }
  [[nodiscard]] const Token *before();
  [[nodiscard]] Span span(const Token &token) const { return {file_, token.begin, token.end}; }
  [[nodiscard]] Span insertion();
  [[nodiscard]] std::string describe(const Token &token) const;
  [[nodiscard]] std::string_view spelling(const Token &token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }
  [[nodiscard]] std::string foreignHelp(const Token &found, const Token *previous,
                                        const Token *next) const;
  [[nodiscard]] std::string helpForTypeFirst(const Token &type, const Token &name) const;
  [[nodiscard]] bool onNewLine(const Token &token);
  [[nodiscard]] bool mayReport();
  [[nodiscard]] bool closerIsWanted(uint16_t type) const;
  [[nodiscard]] bool insideBrackets() const;
  [[nodiscard]] const Context *innermostBlock() const;
  [[nodiscard]] bool keywordAsName(const Token &token);
  void reportKeywordAsName(const Token &token);
  static void useAsName(Token &token);
  void reportUnexpected(const std::string &expected);
  [[nodiscard]] std::string_view placeOfMissing(uint16_t wanted);
  [[nodiscard]] const Token *openBracketOf(uint16_t closer);
  void reportMissing(uint16_t wanted);
  void reportMissingEnd(uint16_t wanted);
  antlr4::Token *conjure(uint16_t type);

  // report_inline.cpp: what to do with the current token where another one is wanted. They give the
  // token to go on with, or throw as giveUpAt().
  antlr4::Token *take();
  antlr4::Token *insert(uint16_t wanted);
  antlr4::Token *insertEnd(uint16_t wanted);
  /// Reports the current token; the rule cannot go on.
  [[noreturn]] void giveUpAt(const std::string &expected);
  antlr4::Token *insteadOfSemicolon();
  antlr4::Token *insteadOfHeadsEnd(uint16_t wanted);
  antlr4::Token *insteadOfEndIf();
  antlr4::Token *insteadOfBracket(uint16_t wanted);
  antlr4::Token *insteadOfColon();
  antlr4::Token *insteadOfName();
  antlr4::Token *takeEqualForAssign();
  void stepBackToAssignment();
  bool thenFollows(uint16_t wanted);

  // report_strategy.cpp: going on at the next statement or declaration
  void skipStatement();
  void skipBodyOfType();
  void skipTo(bool (*stop)(uint16_t));
  bool startsDeclaration(const Token &token);
  void syncStatements();
  void takeForCloserOf(const Context *block);
  void skipStrayCloser();
  void syncEnumerator();
  void syncDeclarations(bool (*good)(uint16_t), const std::string &expected);
  void syncCase();

  UnitParser &parser_;
  std::string_view text_;
  FileId file_;
  Diagnostics &diagnostics_;
  bool recovering_ = false;
  int64_t lastError_ = -1;             ///< token index of the last report
  size_t reports_ = 0;                 ///< in this file
  std::set<uint16_t> keywordsAsNames_; ///< token types reported as such in this file
  std::deque<Token> conjured_;
};

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_UNIT_PARSER_HPP
