// PROGRAM, FUNCTION, FUNCTION_BLOCK, CLASS, INTERFACE and what belongs to them: METHOD, PROPERTY,
// ACTION.
#include "compiler/syntax/file_parser.hpp"

#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>
#include <utility>

namespace stc {

uint16_t FileParser::endOf(uint16_t keyword) {
  switch (keyword) {
  case Tok::PROGRAM:
    return Tok::END_PROGRAM;
  case Tok::FUNCTION:
    return Tok::END_FUNCTION;
  case Tok::FUNCTION_BLOCK:
    return Tok::END_FUNCTION_BLOCK;
  case Tok::CLASS:
    return Tok::END_CLASS;
  case Tok::INTERFACE:
    return Tok::END_INTERFACE;
  case Tok::METHOD:
    return Tok::END_METHOD;
  case Tok::PROPERTY:
    return Tok::END_PROPERTY;
  case Tok::ACTION:
    return Tok::END_ACTION;
  default:
    return 0;
  }
}

std::string FileParser::article(uint16_t keyword) {
  const std::string word(tokenSpelling(keyword));
  return (keyword == Tok::ACTION || keyword == Tok::INTERFACE ? "an " : "a ") + word;
}

// -----------------------------------------------------------------------------------------------
// heads

/// `EXTENDS A,` before a member: the scanner took METHOD for a name. Reports the comma and leaves
/// it out.
bool FileParser::memberAfterComma() {
  if (unit_.back().type != Tok::COMMA || now_.type != Tok::IDENT || ahead_.type != Tok::IDENT)
    return false;
  const Keyword keyword =
      findKeyword(file_.text().substr(now_.begin, now_.end - now_.begin), now_.hash);
  if (!isMember(keyword.type))
    return false;
  diagnostics_.report(Code::UnexpectedToken, span(unit_.back()), "expected a name after this `,`",
                      "nothing follows");
  unit_.pop_back();
  now_.type = keyword.type;
  return true;
}

/// CODESYS: `VAR_GENERIC CONSTANT … END_VAR` between the name of a block and EXTENDS. One report,
/// and they are left out.
bool FileParser::genericConstants() {
  if (!isNow("var_generic"))
    return false;
  diagnostics_
      .report(Code::UnexpectedToken, span(now_), "there are no generic constants",
              "VAR_GENERIC is not known")
      .help("write `VAR CONSTANT`, and one block for each value; a VAR_IN_OUT of type `ARRAY[*] OF "
            "…` takes arrays of any length");
  while (now_.type != Tok::END_VAR && !endsUnit())
    advance();
  if (now_.type == Tok::END_VAR)
    advance();
  return true;
}

bool FileParser::readHead(std::vector<Token> &usings) {
  unit_.clear();
  const uint16_t keyword = now_.type;
  take();
  while (isModifier(now_.type))
    take();
  if (now_.type == Tok::IDENT ||
      (isKeywordType(now_.type) && !startsSection() && !endsUnit() &&
       (ahead_.type == Tok::COLON || (ahead_.type >= Tok::VAR && ahead_.type <= Tok::VAR_INST))))
    take();
  while (now_.type == Tok::DOT) {
    take();
    if (now_.type == Tok::IDENT)
      take();
  }
  const auto readUsings = [&] {
    while (now_.type == Tok::USING) {
      do {
        usings.push_back(now_);
        advance();
      } while (usings.back().type != Tok::SEMICOLON &&
               (now_.type == Tok::IDENT || now_.type == Tok::DOT || now_.type == Tok::COMMA ||
                now_.type == Tok::SEMICOLON));
    }
  };
  readUsings();
  const bool isGeneric = genericConstants();
  const auto path = [&] {
    while (now_.type == Tok::IDENT || now_.type == Tok::DOT || now_.type == Tok::COMMA) {
      if (memberAfterComma())
        break;
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
  if (now_.type == Tok::COLON) {
    if (keyword == Tok::ACTION) // V2.3: `ACTION name:`
      advance();
    else if (keyword == Tok::FUNCTION || keyword == Tok::METHOD || keyword == Tok::PROPERTY)
      readHeadType();
  }
  readUsings();
  return isGeneric;
}

void FileParser::readHeadType() {
  take(); // the colon
  for (size_t guard = 0; guard <= kMaxNesting; ++guard) {
    if (now_.type == Tok::ARRAY) {
      while (now_.type != Tok::OF && now_.type != Tok::SEMICOLON && !startsSection() && !endsUnit())
        take();
      if (now_.type != Tok::OF)
        break;
      take();
    } else if (now_.type == Tok::POINTER || now_.type == Tok::REFERENCE) {
      take();
      if (now_.type == Tok::TO)
        take();
    } else if (now_.type == Tok::REF_TO) {
      take();
    } else {
      break;
    }
  }
  const auto bracketed = [this](uint16_t closer) {
    const uint16_t opener = now_.type;
    size_t depth = 0;
    while (now_.type != Tok::SEMICOLON && !startsSection() && !endsUnit()) {
      depth += now_.type == opener ? 1 : 0;
      depth -= now_.type == closer ? 1 : 0;
      take();
      if (depth == 0)
        break;
    }
  };
  if (now_.type == Tok::STRING || now_.type == Tok::WSTRING) {
    take();
    if (now_.type == Tok::LPAREN || now_.type == Tok::LBRACKET)
      bracketed(now_.type == Tok::LPAREN ? Tok::RPAREN : Tok::RBRACKET);
  } else if (now_.type == Tok::IDENT && !startsAccessor()) {
    take();
    while (now_.type == Tok::DOT) {
      take();
      if (now_.type == Tok::IDENT)
        take();
    }
    if (now_.type == Tok::LPAREN) // INT(0..10)
      bracketed(Tok::RPAREN);
  }
}

FileParser::Head FileParser::head() {
  Head out;
  out.keyword = now_;
  std::vector<Token> usings;
  const bool isGeneric = readHead(usings);
  out.span = {file_.id(), out.keyword.begin, unit_.back().end};
  auto *unit = parseUnit(&Grammar::headUnit);
  if (unit != nullptr && !unit->children.empty())
    out.node = builder_.head(static_cast<Grammar::PouHeadContext *>(unit->children[0]), out.owner);
  if (out.node != nullptr)
    out.node->hasGenerics = isGeneric;
  if (!usings.empty()) {
    std::vector<ast::NamePath> list = usings_;
    for (auto at = usings.begin(); at != usings.end();) {
      const auto next = std::find_if(at + 1, usings.end(),
                                     [](const Token &token) { return token.type == Tok::USING; });
      unit_.assign(at, next);
      at = next;
      auto *directive = parseUnit(&Grammar::usingUnit);
      if (directive != nullptr && !directive->children.empty())
        builder_.usings(static_cast<Grammar::UsingDirectiveContext *>(directive->children[0]),
                        list);
    }
    if (out.node != nullptr)
      out.node->usings = arena_.copy(list);
  }
  return out;
}

// -----------------------------------------------------------------------------------------------
// program units

void FileParser::pou() {
  ++units_;
  sawExternal_ = false;
  reportedDepth_ = false;
  const Head head = this->head();
  OpenPou unnamed;
  OpenPou &open = head.node == nullptr ? unnamed : pous_.emplace_back();
  open.node = head.node;
  if (head.node != nullptr && !head.owner.empty())
    diagnostics_.report(Code::UnexpectedToken, head.owner.front().span.to(head.owner.back().span),
                        "the name of " + article(head.keyword.type) + " has no point",
                        "expected one name");
  const uint16_t wanted = endOf(head.keyword.type);
  closers_.push_back(wanted);
  Content content;
  this->content(content, &open);
  closers_.pop_back();
  Span endSpan;
  if (!close(wanted, head, endSpan))
    reportMissingEnds();
  missing_.clear();
  if (head.node == nullptr)
    return;
  head.node->endSpan = endSpan;
  finishBody(head.node, content);
  add(head.node);
}

void FileParser::finishBody(ast::PouDecl *node, Content &content) {
  node->external = sawExternal_;
  sawExternal_ = false;
  if (content.chart != nullptr)
    finishChart(node, content);
  if (!content.statements.empty()) {
    const Span first = content.statements.front()->span;
    if (node->kind == ast::DeclKind::Interface || node->kind == ast::DeclKind::Class) {
      const bool isClass = node->kind == ast::DeclKind::Class;
      diagnostics_
          .report(Code::BodyNotAllowed, first,
                  std::string(isClass ? "a CLASS" : "an INTERFACE") + " has no statements",
                  "this would never run")
          .help(isClass ? "put them into a METHOD, or write FUNCTION_BLOCK"
                        : "put them into the methods of a block that implements it");
      content.statements.clear();
    } else if (node->external) {
      diagnostics_
          .report(Code::ExternalBody, first, "an external block has no statements",
                  "this would never run")
          .label(externalSpan_, "the body is written in C++");
      content.statements.clear();
    }
  }
  node->variables = arena_.copy(content.variables);
  node->body = arena_.copy(content.statements);
}

void FileParser::content(Content &out, OpenPou *members) {
  struct Places { // of literals whose address is taken; a member has its own
    AstBuilder &builder;
    std::vector<ast::VarDecl *> *before;
    ~Places() { builder.setLiteralPlaces(before); }
  };
  const Places places{builder_, builder_.setLiteralPlaces(&out.variables)};
  bool late = false;
  bool inBody = false;
  // VAR_GLOBAL among the declarations is taken for one of them; the checker says that it must not
  // be there.
  const auto misplacedGlobals = [&] { return !inBody && now_.type == Tok::VAR_GLOBAL; };
  const auto ownAccess = [&] {
    return !inBody && now_.type == Tok::VAR_ACCESS && members != nullptr &&
           members->node != nullptr && members->node->kind == ast::DeclKind::Program;
  };
  while (!endsUnit() && (!startsDeclaration() || misplacedGlobals() || ownAccess())) {
    if (now_.type == Tok::SEMICOLON && !inBody) {
      advance();
    } else if (ownAccess()) {
      globals(members->node);
    } else if (startsSection()) {
      if (inBody && !late) {
        diagnostics_.report(Code::LateDeclaration, span(now_),
                            "declarations must stand before the first statement");
        late = true;
      }
      sections(out.variables);
    } else if (isMember(now_.type)) {
      if (members == nullptr)
        return;
      member(members);
    } else if (startsAccessor()) {
      return;
    } else if (startsChart(out.chart != nullptr)) {
      chart(out.chart);
    } else {
      if (inBody || !instructionList(out))
        body(out.statements);
      inBody = true;
    }
  }
}

bool FileParser::close(uint16_t wanted, const Head &head, Span &endSpan) {
  const Token end = now_;
  if (end.type == wanted) {
    endSpan = span(end);
    advance();
    return false;
  }
  const bool closesOuter = std::find(closers_.begin(), closers_.end(), end.type) != closers_.end();
  if (end.type == Token::kEnd || !endsUnit() || closesOuter) {
    missing_.push_back({wanted, head.span, span(end)});
    // An `{external}` before the end of the file.
    if (end.type == Token::kEnd && end.triviaCount != 0)
      advance();
    // The end of the file may close its only POU: so CODESYS stores them.
    return end.type == Token::kEnd && units_ == 1;
  }
  const std::string wantedText(tokenSpelling(wanted));
  diagnostics_
      .report(Code::MismatchedEnd, span(end),
              "`" + std::string(tokenSpelling(end.type)) + "` does not close " +
                  article(head.keyword.type),
              "expected `" + wantedText + "`")
      .label(head.span, "this is what is open");
  endSpan = span(end);
  advance();
  return false;
}

void FileParser::reportMissingEnds() {
  for (const MissingEnd &one : missing_) {
    const std::string text(tokenSpelling(one.wanted));
    diagnostics_.report(Code::MissingEnd, one.head, "missing `" + text + "`", "this is not closed")
        .label(one.found, "expected `" + text + "` before this");
  }
  missing_.clear();
}

} // namespace stc
