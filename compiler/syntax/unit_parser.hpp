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
#include <vector>

namespace stc {

using Grammar = grammar::StParser;

/// A unit's tokens; the last one is of type Token::kEnd and lies where the text goes on.
class UnitStream final : public antlr4::TokenStream {
public:
  void reset(std::vector<Token> &tokens) {
    tokens_ = &tokens;
    place_ = 0;
  }
  void rewind() { place_ = 0; }
  [[nodiscard]] Token &current() { return (*tokens_)[place_]; }
  [[nodiscard]] Token &token(size_t index) { return (*tokens_)[index]; }
  void advance() {
    if (place_ + 1 < tokens_->size())
      ++place_;
  }

  void consume() override { advance(); }
  size_t LA(ssize_t i) override { return LT(i)->getType(); }
  Token *LT(ssize_t k) override {
    if (k == 1)
      return tokens_->data() + place_;
    const auto at = static_cast<ssize_t>(place_) + (k > 0 ? k - 1 : k);
    if (at < 0)
      return nullptr;
    return tokens_->data() + std::min(static_cast<size_t>(at), tokens_->size() - 1);
  }
  ssize_t mark() override { return 0; }
  void release(ssize_t) override {}
  size_t index() override { return place_; }
  void seek(size_t index) override { place_ = index; }
  size_t size() override { return tokens_->size(); }
  std::string getSourceName() const override { return {}; }
  antlr4::Token *get(size_t index) const override { return tokens_->data() + index; }
  antlr4::TokenSource *getTokenSource() const override { return nullptr; }
  std::string getText(const antlr4::misc::Interval &) override { return {}; }
  std::string getText() override { return {}; }
  std::string getText(antlr4::RuleContext *) override { return {}; }
  std::string getText(antlr4::Token *, antlr4::Token *) override { return {}; }

private:
  std::vector<Token> *tokens_ = nullptr;
  size_t place_ = 0;
};

/// The generated parser without what we do not need: its tree holds rule contexts only, the tokens
/// between them are found by their index in the unit.
class UnitParser final : public Grammar {
public:
  using Context = antlr4::ParserRuleContext;

  explicit UnitParser(UnitStream *stream) : Grammar(stream), stream_(*stream) {}

  antlr4::Token *match(size_t type) override {
    Token &token = stream_.current();
    if (token.getType() == type) {
      if (reporting_)
        _errHandler->reportMatch(this);
      stream_.advance();
      return &token;
    }
    expected_ = type == Token::EOF ? Token::kEnd : static_cast<uint16_t>(type);
    return _errHandler->recoverInline(this);
  }
  antlr4::Token *consume() override {
    Token &token = stream_.current();
    stream_.advance();
    expected_ = 0;
    return &token;
  }
  void enterRule(antlr4::ParserRuleContext *context, size_t state, size_t) override {
    setState(state);
    _ctx = context;
    context->start = &stream_.current();
    if (context->parent != nullptr)
      context->parent->children.push_back(context);
  }

  /// The token type that the failed match() wanted; 0 when it was one of a set.
  [[nodiscard]] uint16_t expected() const { return expected_; }
  void clearExpected() { expected_ = 0; }
  void enterOuterAlt(antlr4::ParserRuleContext *, size_t) override {}
  void setReporting(bool on) { reporting_ = on; }
  [[nodiscard]] Context *context() const { return _ctx; }
  [[nodiscard]] UnitStream &stream() { return stream_; }

private:
  UnitStream &stream_;
  uint16_t expected_ = 0;
  bool reporting_ = false;
};

/// First run: gives up at the first error.
class GiveUpStrategy final : public antlr4::ANTLRErrorStrategy {
public:
  void reset(antlr4::Parser *) override {}
  antlr4::Token *recoverInline(antlr4::Parser *) override { giveUp(); }
  void recover(antlr4::Parser *, std::exception_ptr) override { giveUp(); }
  void sync(antlr4::Parser *) override {}
  bool inErrorRecoveryMode(antlr4::Parser *) override { return false; }
  void reportMatch(antlr4::Parser *) override {}
  void reportError(antlr4::Parser *, const antlr4::RecognitionException &) override {}

private:
  [[noreturn]] static void giveUp() { throw antlr4::ParseCancellationException(); }
};

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
  using Context = antlr4::ParserRuleContext;

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
  void skipTo(bool (*stop)(uint16_t));
  bool startsDeclaration(const Token &token);
  void syncStatements();
  void takeForCloserOf(const Context *block);
  void skipStrayCloser();
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
