#include "compiler/syntax/file_parser.hpp"

#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

namespace {

/// After that many errors the rest of a file is not looked at.
constexpr std::size_t kMaxErrors = 100;

} // namespace

FileParser::FileParser(const SourceFile &file, Interner &interner, Arena &arena,
                       Diagnostics &diagnostics)
    : file_(file), arena_(arena), diagnostics_(diagnostics), scanner_(file, diagnostics),
      parser_(&stream_), builder_(scanner_, file.id(), stream_, interner, arena, diagnostics),
      giveUp_(std::make_shared<GiveUpStrategy>()),
      report_(std::make_shared<ReportStrategy>(parser_, file.text(), file.id(), diagnostics)) {
  unit_.reserve(3072);
  stream_.reset(unit_);
}

ast::File *FileParser::run() {
  auto *out = arena_.make<ast::File>();
  out->id = file_.id();
  if (looksBinary(file_.text())) {
    diagnostics_.report(Code::binaryFile, {}, "`" + file_.name() + "` is not a text file");
    return out;
  }
  now_ = scanner_.next();
  ahead_ = scanner_.next();
  const std::size_t before = diagnostics_.errorCount();
  while (now_.type != Token::kEnd) {
    if (diagnostics_.errorCount() - before >= kMaxErrors) {
      diagnostics_.report(Code::unexpectedToken, span(now_),
                          "too many errors; the rest of the file is not checked");
      break;
    }
    switch (now_.type) {
    case Tok::SEMICOLON:
      advance();
      break;
    case Tok::PROGRAM:
    case Tok::FUNCTION:
    case Tok::FUNCTION_BLOCK:
      pou();
      break;
    case Tok::TYPE:
      types();
      break;
    case Tok::VAR_GLOBAL:
      globals();
      break;
    default:
      if (isConstruct(now_.type) || now_.type == Tok::VAR_CONFIG || now_.type == Tok::VAR_ACCESS)
        unsupportedConstruct();
      else
        outside();
    }
  }
  out->declarations = arena_.copy(declarations_);
  return out;
}

// ---------------------------------------------------------------------------------------------------------
// tokens

void FileParser::advance() {
  for (std::size_t i = 0; i < now_.triviaCount; ++i) {
    const Trivia &trivia = scanner_.trivia()[now_.triviaBegin + i];
    if (trivia.kind == Trivia::Kind::external) {
      sawExternal_ = true;
      externalSpan_ = {file_.id(), trivia.begin, trivia.end};
    }
  }
  now_ = ahead_;
  ahead_ = scanner_.next();
}

void FileParser::take() {
  unit_.push_back(now_);
  advance();
}

bool FileParser::startsDeclaration() const {
  switch (now_.type) {
  case Tok::PROGRAM:
  case Tok::FUNCTION:
  case Tok::FUNCTION_BLOCK:
  case Tok::TYPE:
    return ahead_.type == Tok::IDENT || isModifier(ahead_.type);
  case Tok::VAR_GLOBAL:
  case Tok::VAR_CONFIG:
  case Tok::VAR_ACCESS:
    return ahead_.type != Tok::COLON;
  default:
    return false;
  }
}

bool FileParser::endsPou() const {
  return now_.type == Token::kEnd || now_.type == Tok::END_PROGRAM ||
         now_.type == Tok::END_FUNCTION || now_.type == Tok::END_FUNCTION_BLOCK;
}

bool FileParser::startsSection() const {
  return now_.type >= Tok::VAR && now_.type <= Tok::VAR_INST && ahead_.type != Tok::COLON;
}

void FileParser::finishUnit() {
  Token end;
  end.begin = now_.begin;
  end.end = now_.end;
  unit_.push_back(end);
  for (std::size_t i = 0; i < unit_.size(); ++i)
    unit_[i].index = static_cast<std::uint32_t>(i);
  stream_.reset(unit_);
}

// -----------------------------------------------------------------------------------------------
// program units

void FileParser::readHead() {
  unit_.clear();
  take();
  while (isModifier(now_.type))
    take();
  if (now_.type == Tok::IDENT ||
      (isKeywordType(now_.type) && !startsSection() && !endsPou() &&
       (ahead_.type == Tok::COLON || (ahead_.type >= Tok::VAR && ahead_.type <= Tok::VAR_INST))))
    take();
  const auto path = [&] {
    while (now_.type == Tok::IDENT || now_.type == Tok::DOT || now_.type == Tok::COMMA) {
      const bool name = now_.type == Tok::IDENT;
      take();
      if (name && now_.type == Tok::IDENT)
        break;
    }
  };
  while (now_.type == Tok::EXTENDS || now_.type == Tok::IMPLEMENTS) {
    take();
    path();
  }
  if (now_.type == Tok::COLON && unit_.front().type == Tok::FUNCTION) {
    take();
    for (std::size_t guard = 0; guard <= kMaxNesting; ++guard) {
      if (now_.type == Tok::ARRAY) {
        while (now_.type != Tok::OF && now_.type != Tok::SEMICOLON && !startsSection() &&
               !endsPou())
          take();
        if (now_.type != Tok::OF)
          break;
        take();
      } else if (now_.type == Tok::POINTER || now_.type == Tok::REFERENCE) {
        take();
        if (now_.type == Tok::TO)
          take();
      } else {
        break;
      }
    }
    if (now_.type == Tok::STRING || now_.type == Tok::WSTRING) {
      take();
      if (now_.type == Tok::LPAREN || now_.type == Tok::LBRACKET) {
        const std::uint16_t closer = now_.type == Tok::LPAREN ? Tok::RPAREN : Tok::RBRACKET;
        while (now_.type != closer && now_.type != Tok::SEMICOLON && !startsSection() && !endsPou())
          take();
        if (now_.type == closer)
          take();
      }
    } else if (now_.type == Tok::IDENT) {
      take();
      while (now_.type == Tok::DOT) {
        take();
        if (now_.type == Tok::IDENT)
          take();
      }
    }
  }
}

void FileParser::pou() {
  ++pous_;
  sawExternal_ = false;
  reportedDepth_ = false;
  const Token keyword = now_;
  readHead();
  const Span headSpan{file_.id(), keyword.begin, unit_.back().end};
  auto *unit = parseUnit(&Grammar::headUnit);
  auto *context = unit == nullptr || unit->children.empty()
                      ? nullptr
                      : static_cast<Grammar::PouHeadContext *>(unit->children[0]);
  ast::PouDecl *node = context == nullptr ? nullptr : builder_.head(context);
  std::vector<ast::VarDecl *> variables;
  std::vector<ast::Stmt *> statements;
  bool late = false;
  bool inBody = false;
  // VAR_GLOBAL among the declarations is taken for one of them; the checker says that it must not
  // be there.
  const auto misplacedGlobals = [&] { return !inBody && now_.type == Tok::VAR_GLOBAL; };
  while (!endsPou() && (!startsDeclaration() || misplacedGlobals())) {
    if (now_.type == Tok::SEMICOLON && !inBody) {
      advance();
    } else if (now_.type == Tok::VAR_INST) {
      unsupportedConstruct();
    } else if (startsSection()) {
      if (inBody && !late) {
        diagnostics_.report(Code::lateDeclaration, span(now_),
                            "declarations must stand before the first statement");
        late = true;
      }
      sections(variables);
    } else if (isConstruct(now_.type)) {
      unsupportedConstruct();
    } else {
      if (!inBody && unsupportedBody())
        break;
      inBody = true;
      body(statements);
    }
  }
  const std::uint16_t wanted = keyword.type == Tok::PROGRAM ? std::uint16_t{Tok::END_PROGRAM}
                               : keyword.type == Tok::FUNCTION
                                   ? std::uint16_t{Tok::END_FUNCTION}
                                   : std::uint16_t{Tok::END_FUNCTION_BLOCK};
  const Token end = now_;
  const std::string wantedText(tokenSpelling(wanted));
  if (end.type == Token::kEnd || startsDeclaration()) {
    // The end of the file may close its only POU: so CODESYS stores them.
    if (end.type != Token::kEnd || pous_ != 1)
      diagnostics_
          .report(Code::missingEnd, headSpan, "missing `" + wantedText + "`", "this is not closed")
          .label({file_.id(), end.begin, end.end == end.begin ? end.begin : end.end},
                 "expected `" + wantedText + "` before this");
    // An `{external}` in front of the end of the file.
    if (end.type == Token::kEnd && end.triviaCount != 0)
      advance();
  } else {
    if (end.type != wanted)
      diagnostics_
          .report(Code::mismatchedEnd, span(end),
                  "`" + std::string(tokenSpelling(end.type)) + "` does not close a " +
                      std::string(tokenSpelling(keyword.type)),
                  "expected `" + wantedText + "`")
          .label(headSpan, "this is what is open");
    advance();
  }
  if (node == nullptr)
    return;
  node->external = sawExternal_;
  sawExternal_ = false;
  if (node->external && !statements.empty()) {
    diagnostics_
        .report(Code::externalBody, statements.front()->span, "an external block has no statements",
                "this would never run")
        .label(externalSpan_, "the body is written in C++");
    statements.clear();
  }
  node->variables = arena_.copy(variables);
  node->body = arena_.copy(statements);
  declarations_.push_back(node);
}

/// SFC and IL: reports them and skips the body.
bool FileParser::unsupportedBody() {
  if (now_.type != Tok::IDENT || (!isOperandStart(ahead_.type) && ahead_.type != Tok::DIRECT))
    return false;
  static constexpr std::string_view kInstructions[] = {"ld", "ldn", "st", "cal", "calc", "jmpc"};
  const std::string_view word = scanner_.text(now_);
  if (std::none_of(std::begin(kInstructions), std::end(kInstructions),
                   [&](std::string_view name) { return isWord(word, name); }))
    return false;
  diagnostics_
      .report(Code::notSupported, span(now_),
              "instruction list (IL) is not supported by this version")
      .help("write the body in Structured Text");
  while (!endsPou() && !startsDeclaration())
    advance();
  return true;
}

void FileParser::unsupportedConstruct() {
  const Token keyword = now_;
  std::string what(tokenSpelling(keyword.type));
  std::uint16_t closer = 0;
  bool nested = false; // holds declarations of its own
  switch (keyword.type) {
  case Tok::METHOD:
    closer = Tok::END_METHOD;
    break;
  case Tok::PROPERTY:
    closer = Tok::END_PROPERTY;
    break;
  case Tok::ACTION:
    closer = Tok::END_ACTION;
    break;
  case Tok::INTERFACE:
    closer = Tok::END_INTERFACE;
    nested = true;
    break;
  case Tok::CLASS:
    closer = Tok::END_CLASS;
    nested = true;
    break;
  case Tok::NAMESPACE:
    closer = Tok::END_NAMESPACE;
    nested = true;
    break;
  case Tok::CONFIGURATION:
    closer = Tok::END_CONFIGURATION;
    nested = true;
    break;
  case Tok::USING:
    closer = Tok::SEMICOLON;
    break;
  case Tok::VAR_INST:
  case Tok::VAR_CONFIG:
  case Tok::VAR_ACCESS:
    closer = Tok::END_VAR;
    break;
  case Tok::STEP:
  case Tok::INITIAL_STEP:
  case Tok::TRANSITION:
    what = "sequential function chart (SFC)";
    break;
  default: // an END_… without its beginning
    diagnostics_.report(Code::mismatchedEnd, span(now_), "`" + what + "` closes nothing");
    advance();
    return;
  }
  advance();
  const bool named = closer != Tok::END_VAR && now_.type == Tok::IDENT;
  diagnostics_.report(Code::notSupported, named ? span(keyword).to(span(now_)) : span(keyword),
                      what + " is not supported by this version");
  while (now_.type != Token::kEnd && (closer == 0 || now_.type != closer)) {
    if (!nested && (endsPou() || startsDeclaration()))
      return;
    if (closer == Tok::END_METHOD && now_.type == Tok::METHOD)
      return;
    advance();
  }
  if (now_.type == closer)
    advance();
}

/// Text between declarations.
void FileParser::outside() {
  const Token start = now_;
  const std::string found(scanner_.text(start).substr(0, 40));
  if (openerOf(start.type) != 0 || endsPou() || start.type == Tok::END_TYPE ||
      start.type == Tok::END_VAR || start.type == Tok::END_STRUCT) {
    diagnostics_.report(Code::mismatchedEnd, span(start), "`" + found + "` closes nothing");
    advance();
    return;
  }
  if (startsSection())
    diagnostics_
        .report(Code::outsideDeclaration, span(start),
                "`" + found + "` outside a program, function or function block")
        .help("global variables are declared in VAR_GLOBAL … END_VAR");
  else
    diagnostics_
        .report(Code::outsideDeclaration, span(start),
                "expected a declaration, found `" + found + "`", "outside every declaration")
        .help("statements stand inside PROGRAM, FUNCTION or FUNCTION_BLOCK");
  while (now_.type != Token::kEnd) {
    advance();
    if (startsDeclaration() || (now_.type >= Tok::METHOD && now_.type <= Tok::CONFIGURATION))
      return;
    if (endsPou()) { // probably of what we skipped
      if (now_.type != Token::kEnd)
        advance();
      return;
    }
  }
}

} // namespace stc
