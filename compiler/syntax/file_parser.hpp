#pragma once
// Cuts a file into units, parses one after the other and puts the results together. Internal to
// compiler/syntax.

#include "compiler/syntax/ast_builder.hpp"
#include "compiler/syntax/scanner.hpp"
#include "compiler/syntax/unit_parser.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

class FileParser {
public:
  FileParser(const SourceFile &file, Interner &interner, Arena &arena, Diagnostics &diagnostics);

  ast::File *run();

private:
  // Reading tokens. `now_` is the next token to take, `ahead_` the one behind it.
  void advance();
  void take();
  [[nodiscard]] Span span(const Token &token) const { return builder_.span(token); }
  [[nodiscard]] bool startsDeclaration() const;
  [[nodiscard]] bool endsPou() const;
  [[nodiscard]] bool startsSection() const;
  void finishUnit();

  // Parts of a file.
  void pou();
  void readHead();
  void sections(std::vector<ast::VarDecl *> &out);
  void types();
  void body(std::vector<ast::Stmt *> &out);
  void readStatements();
  void markLabel();
  void globals();
  void unsupportedConstruct();
  bool unsupportedBody();
  bool skipExceptionWord();
  void outside();

  /// Runs the rule over the unit; a second time, with reports, when it has an error.
  template <class Context> Context *parseUnit(Context *(Grammar::*rule)());

  const SourceFile &file_;
  Arena &arena_;
  Diagnostics &diagnostics_;
  Scanner scanner_;
  UnitStream stream_;
  UnitParser parser_;
  AstBuilder builder_;
  std::shared_ptr<GiveUpStrategy> giveUp_;
  std::shared_ptr<ReportStrategy> report_;

  Token now_;
  Token ahead_;
  std::vector<Token> unit_;
  bool sawExternal_ = false; ///< `{external}` since the current POU began
  Span externalSpan_;
  std::vector<ast::Decl *> declarations_;
  unsigned pous_ = 0;

  // While reading a unit.
  std::vector<std::uint16_t> blocks_; ///< open IF, CASE, …
  unsigned brackets_ = 0;
  std::size_t boundary_ = 0;   ///< index in unit_ of the token after the last `;`, THEN, `:` …
  std::size_t statement_ = 0;  ///< index in unit_ where the current outermost statement begins
  bool reportedDepth_ = false; ///< in this POU
};

template <class Context> Context *FileParser::parseUnit(Context *(Grammar::*rule)()) {
  finishUnit();
  parser_.setErrorHandler(giveUp_);
  parser_.setReporting(false);
  parser_.reset();
  try {
    return (parser_.*rule)();
  } catch (antlr4::ParseCancellationException &) {
    parser_.setErrorHandler(report_);
    parser_.setReporting(true);
    parser_.reset();
  }
  try {
    return (parser_.*rule)();
  } catch (antlr4::ParseCancellationException &) { // too many errors
    return nullptr;
  }
}

} // namespace stc
