// PROGRAM, FUNCTION, FUNCTION_BLOCK, CLASS, INTERFACE and what belongs to them: METHOD, PROPERTY,
// ACTION.
#include "compiler/syntax/file_parser.hpp"

#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>
#include <utility>

namespace stc {

namespace {

std::uint16_t endOf(std::uint16_t keyword) {
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

std::string article(std::uint16_t keyword) {
  const std::string word(tokenSpelling(keyword));
  return (keyword == Tok::ACTION || keyword == Tok::INTERFACE ? "an " : "a ") + word;
}

} // namespace

// -----------------------------------------------------------------------------------------------
// heads

void FileParser::readHead(std::vector<Token> &usings) {
  unit_.clear();
  const std::uint16_t keyword = now_.type;
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
  if (now_.type == Tok::COLON) {
    if (keyword == Tok::ACTION) // V2.3: `ACTION name:`
      advance();
    else if (keyword == Tok::FUNCTION || keyword == Tok::METHOD || keyword == Tok::PROPERTY)
      readHeadType();
  }
  readUsings();
}

void FileParser::readHeadType() {
  take(); // the colon
  for (std::size_t guard = 0; guard <= kMaxNesting; ++guard) {
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
  if (now_.type == Tok::STRING || now_.type == Tok::WSTRING) {
    take();
    if (now_.type == Tok::LPAREN || now_.type == Tok::LBRACKET) {
      const std::uint16_t closer = now_.type == Tok::LPAREN ? Tok::RPAREN : Tok::RBRACKET;
      while (now_.type != closer && now_.type != Tok::SEMICOLON && !startsSection() && !endsUnit())
        take();
      if (now_.type == closer)
        take();
    }
  } else if (now_.type == Tok::IDENT && !startsAccessor()) {
    take();
    while (now_.type == Tok::DOT) {
      take();
      if (now_.type == Tok::IDENT)
        take();
    }
  }
}

FileParser::Head FileParser::head() {
  Head out;
  out.keyword = now_;
  std::vector<Token> usings;
  readHead(usings);
  out.span = {file_.id(), out.keyword.begin, unit_.back().end};
  auto *unit = parseUnit(&Grammar::headUnit);
  if (unit != nullptr && !unit->children.empty())
    out.node = builder_.head(static_cast<Grammar::PouHeadContext *>(unit->children[0]), out.owner);
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
    diagnostics_.report(Code::unexpectedToken, head.owner.front().span.to(head.owner.back().span),
                        "the name of " + article(head.keyword.type) + " has no point",
                        "expected one name");
  const std::uint16_t wanted = endOf(head.keyword.type);
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
  if (!content.statements.empty()) {
    const Span first = content.statements.front()->span;
    if (node->kind == ast::DeclKind::interface || node->kind == ast::DeclKind::classD) {
      const bool isClass = node->kind == ast::DeclKind::classD;
      diagnostics_
          .report(Code::bodyNotAllowed, first,
                  std::string(isClass ? "a CLASS" : "an INTERFACE") + " has no statements",
                  "this would never run")
          .help(isClass ? "put them into a METHOD, or write FUNCTION_BLOCK"
                        : "put them into the methods of a block that implements it");
      content.statements.clear();
    } else if (node->external) {
      diagnostics_
          .report(Code::externalBody, first, "an external block has no statements",
                  "this would never run")
          .label(externalSpan_, "the body is written in C++");
      content.statements.clear();
    }
  }
  node->variables = arena_.copy(content.variables);
  node->body = arena_.copy(content.statements);
}

void FileParser::content(Content &out, OpenPou *members) {
  bool late = false;
  bool inBody = false;
  // VAR_GLOBAL among the declarations is taken for one of them; the checker says that it must not
  // be there.
  const auto misplacedGlobals = [&] { return !inBody && now_.type == Tok::VAR_GLOBAL; };
  const auto ownAccess = [&] {
    return !inBody && now_.type == Tok::VAR_ACCESS && members != nullptr &&
           members->node != nullptr && members->node->kind == ast::DeclKind::program;
  };
  while (!endsUnit() && (!startsDeclaration() || misplacedGlobals() || ownAccess())) {
    if (now_.type == Tok::SEMICOLON && !inBody) {
      advance();
    } else if (ownAccess()) {
      globals(members->node);
    } else if (startsSection()) {
      if (inBody && !late) {
        diagnostics_.report(Code::lateDeclaration, span(now_),
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
    } else if (isChart(now_.type)) {
      chart();
    } else if (inBody || !instructionList()) {
      inBody = true;
      body(out.statements);
    }
  }
}

bool FileParser::close(std::uint16_t wanted, const Head &head, Span &endSpan) {
  const Token end = now_;
  if (end.type == wanted) {
    endSpan = span(end);
    advance();
    return false;
  }
  const bool closesOuter = std::find(closers_.begin(), closers_.end(), end.type) != closers_.end();
  if (end.type == Token::kEnd || !endsUnit() || closesOuter) {
    missing_.push_back({wanted, head.span, span(end)});
    // An `{external}` in front of the end of the file.
    if (end.type == Token::kEnd && end.triviaCount != 0)
      advance();
    // The end of the file may close its only POU: so CODESYS stores them.
    return end.type == Token::kEnd && units_ == 1;
  }
  const std::string wantedText(tokenSpelling(wanted));
  diagnostics_
      .report(Code::mismatchedEnd, span(end),
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
    diagnostics_.report(Code::missingEnd, one.head, "missing `" + text + "`", "this is not closed")
        .label(one.found, "expected `" + text + "` before this");
  }
  missing_.clear();
}

// -----------------------------------------------------------------------------------------------
// members

void FileParser::member(OpenPou *owner) {
  const bool external = sawExternal_;
  sawExternal_ = false;
  if (now_.type == Tok::ACTIONS) {
    advance();
    if (now_.type == Tok::IDENT) // whose they are
      advance();
    closers_.push_back(Tok::END_ACTIONS);
    while (now_.type == Tok::ACTION || now_.type == Tok::SEMICOLON) {
      if (now_.type == Tok::ACTION)
        method(owner);
      else
        advance();
    }
    closers_.pop_back();
    if (now_.type == Tok::END_ACTIONS)
      advance();
  } else if (now_.type == Tok::PROPERTY) {
    property(owner);
  } else {
    method(owner);
  }
  sawExternal_ = external;
}

/// The POU that the member belongs to; null after saying that there is none, or when it is in
/// another file.
FileParser::OpenPou *FileParser::ownerOf(const Head &head, OpenPou *enclosing, ast::Decl *member) {
  OpenPou *owner = enclosing;
  if (!head.owner.empty()) {
    const ast::Name &name = head.owner.back();
    const auto found = std::find_if(pous_.begin(), pous_.end(), [&](const OpenPou &open) {
      return open.node->name.id == name.id;
    });
    if (found == pous_.end()) {
      strays_.push_back({name, member, head.keyword.type});
      return nullptr;
    }
    owner = &*found;
  }
  if (owner == nullptr) {
    diagnostics_
        .report(Code::memberWithoutOwner, head.span,
                "this " + std::string(tokenSpelling(head.keyword.type)) + " belongs to no block",
                "outside of every block")
        .help("put it into the block or behind it, or write `" +
              std::string(tokenSpelling(head.keyword.type)) + " Block." +
              std::string(head.node->name.text) + "`");
    return nullptr;
  }
  if (owner->node == nullptr)
    return nullptr;
  const ast::DeclKind kind = owner->node->kind;
  const bool isAction = head.keyword.type == Tok::ACTION;
  if (kind == ast::DeclKind::function ||
      (isAction && (kind == ast::DeclKind::interface || kind == ast::DeclKind::classD))) {
    const std::string what = kind == ast::DeclKind::function    ? "a FUNCTION"
                             : kind == ast::DeclKind::interface ? "an INTERFACE"
                                                                : "a CLASS";
    diagnostics_
        .report(Code::memberWithoutOwner, head.span,
                what + " cannot have " + article(head.keyword.type),
                isAction ? "actions belong to programs and function blocks"
                         : "methods and properties belong to blocks, classes and programs")
        .label(owner->node->name.span, "declared here");
    return nullptr;
  }
  return owner;
}

/// METHOD and ACTION.
void FileParser::method(OpenPou *enclosing) {
  reportedDepth_ = false;
  const Head head = this->head();
  const std::uint16_t wanted = endOf(head.keyword.type);
  Content content;
  closers_.push_back(wanted);
  const bool inProperty = std::exchange(inProperty_, false);
  this->content(content, nullptr);
  inProperty_ = inProperty;
  closers_.pop_back();
  Span endSpan;
  close(wanted, head, endSpan);
  if (head.node == nullptr)
    return;
  head.node->endSpan = endSpan;
  finishBody(head.node, content);
  OpenPou *owner = ownerOf(head, enclosing, head.node);
  if (owner == nullptr)
    return;
  if (owner->node->kind == ast::DeclKind::interface && !head.node->body.empty()) {
    diagnostics_
        .report(Code::bodyNotAllowed, head.node->body.front()->span,
                "a method of an INTERFACE has no statements", "this would never run")
        .help("put them into the method of a block that implements the interface");
    head.node->body = {};
  }
  (head.keyword.type == Tok::ACTION ? owner->actions : owner->methods).push_back(head.node);
}

/// `SET PRIVATE`: an accessor may be reached by fewer than its property.
void FileParser::accessorAccess(ast::Access &access) {
  struct Word {
    const char *text;
    ast::Access access;
  };
  static constexpr Word kWords[] = {{"public", ast::Access::publicA},
                                    {"private", ast::Access::privateA},
                                    {"protected", ast::Access::protectedA},
                                    {"internal", ast::Access::internalA}};
  switch (ahead_.type) { // a variable of this name
  case Tok::ASSIGN:
  case Tok::DOT:
  case Tok::LPAREN:
  case Tok::LBRACKET:
  case Tok::CARET:
  case Tok::COLON:
    return;
  default:
    break;
  }
  for (const Word &word : kWords) {
    if (!isNow(word.text))
      continue;
    access = word.access;
    advance();
    return;
  }
}

ast::PouDecl *FileParser::accessor(ast::PropertyDecl *property, bool isSet) {
  Head head;
  head.keyword = now_;
  head.keyword.type = Tok::METHOD;
  head.span = span(now_);
  auto *node = arena_.make<ast::PouDecl>();
  node->kind = ast::DeclKind::method;
  node->name = property->name;
  node->span = head.span;
  node->attributes = builder_.attributes(now_);
  node->doc = builder_.doc(now_);
  node->access = property->access;
  node->modifiers = property->modifiers;
  reportedDepth_ = false;
  sawExternal_ = false;
  advance();
  accessorAccess(node->access);
  Content content;
  if (isSet) {
    auto *value = arena_.make<ast::VarDecl>();
    value->name = property->name;
    value->section = ast::Section::input;
    value->type = property->type;
    content.variables.push_back(value);
  } else {
    node->returnType = property->type;
  }
  const std::uint16_t wanted = isSet ? Tok::END_SET : Tok::END_GET;
  closers_.push_back(wanted);
  this->content(content, nullptr);
  closers_.pop_back();
  if (now_.type == wanted) {
    node->endSpan = span(now_);
    advance();
  } else if (!content.statements.empty() || content.variables.size() > (isSet ? 1U : 0U)) {
    // Without statements the next accessor or END_PROPERTY closes it: `GET SET END_PROPERTY`.
    const std::string text(tokenSpelling(wanted));
    diagnostics_.report(Code::missingEnd, head.span, "missing `" + text + "`", "this is not closed")
        .label(span(now_), "expected `" + text + "` before this");
  }
  finishBody(node, content);
  return node;
}

void FileParser::property(OpenPou *enclosing) {
  const bool outer = std::exchange(inProperty_, true);
  const Head head = this->head();
  auto *node = arena_.make<ast::PropertyDecl>();
  if (head.node != nullptr) {
    static_cast<ast::Decl &>(*node) = *head.node;
    node->type = head.node->returnType;
    if (node->type == nullptr) {
      diagnostics_.report(Code::expectedToken, {file_.id(), head.span.end, head.span.end},
                          "expected `:` and the type of the property", "add `: TYPE` here");
      node->type = builder_.errorType(head.span);
    }
  }
  closers_.push_back(Tok::END_PROPERTY);
  bool strayReported = false;
  for (;;) {
    if (startsAccessor()) {
      const bool isSet = isNow("set");
      const Span where = span(now_);
      ast::PouDecl *&slot = isSet ? node->set : node->get;
      ast::PouDecl *one = accessor(node, isSet);
      if (slot != nullptr)
        diagnostics_
            .report(Code::propertyAccessor, where,
                    std::string("the property has a second ") + (isSet ? "SET" : "GET"),
                    "only one is possible")
            .label(slot->span, "the first one");
      else
        slot = one;
    } else if (now_.type == Tok::SEMICOLON) {
      advance();
    } else if (endsUnit() || isMember(now_.type) || startsDeclaration()) {
      break;
    } else {
      const Span where = span(now_);
      Content stray;
      content(stray, nullptr);
      if (!strayReported)
        diagnostics_
            .report(Code::propertyAccessor, where,
                    "statements and variables of a property stand in GET or SET",
                    "expected GET, SET or END_PROPERTY")
            .help("write `GET … END_GET` around what reads the property");
      strayReported = true;
      sawExternal_ = false;
    }
  }
  closers_.pop_back();
  inProperty_ = outer;
  Span endSpan;
  close(Tok::END_PROPERTY, head, endSpan);
  sawExternal_ = false;
  if (head.node == nullptr)
    return;
  node->kind = ast::DeclKind::property; // not the head's
  if (node->get == nullptr && node->set == nullptr && !strayReported)
    diagnostics_
        .report(Code::propertyAccessor, node->name.span,
                "the property `" + std::string(node->name.text) + "` has neither GET nor SET",
                "cannot be read or written")
        .help("write `GET … END_GET` or `SET … END_SET` in front of END_PROPERTY");
  OpenPou *owner = ownerOf(head, enclosing, node);
  if (owner == nullptr)
    return;
  if (owner->node->kind == ast::DeclKind::interface) {
    for (ast::PouDecl *one : {node->get, node->set}) {
      if (one == nullptr || one->body.empty())
        continue;
      diagnostics_
          .report(Code::bodyNotAllowed, one->body.front()->span,
                  "a property of an INTERFACE has no statements", "this would never run")
          .help("put them into the property of a block that implements the interface");
      one->body = {};
    }
  }
  owner->properties.push_back(node);
}

/// A member behind its POU, or in a file of its own.
void FileParser::lateMember() {
  const bool first = units_ == 0;
  units_ += first;
  member(pous_.empty() ? nullptr : &pous_.back());
  if (now_.type != Token::kEnd || !first)
    reportMissingEnds();
  missing_.clear();
}

// -----------------------------------------------------------------------------------------------
// other languages

/// Reports an instruction list and skips it.
bool FileParser::instructionList() {
  if (now_.type != Tok::IDENT || (!isOperandStart(ahead_.type) && ahead_.type != Tok::DIRECT))
    return false;
  static constexpr std::string_view kInstructions[] = {"ld", "ldn", "st", "cal", "calc", "jmpc"};
  if (std::none_of(std::begin(kInstructions), std::end(kInstructions),
                   [&](std::string_view name) { return isNow(name); }))
    return false;
  diagnostics_
      .report(Code::notSupported, span(now_),
              "instruction list (IL) is not supported by this version")
      .help("write the body in Structured Text");
  while (!endsUnit() && !startsDeclaration() && !isMember(now_.type))
    advance();
  return true;
}

/// Reports a sequential function chart and skips it, with the actions that belong to it.
void FileParser::chart() {
  if (now_.type == Tok::END_STEP || now_.type == Tok::END_TRANSITION) {
    diagnostics_.report(Code::mismatchedEnd, span(now_),
                        "`" + std::string(tokenSpelling(now_.type)) + "` closes nothing");
    advance();
    return;
  }
  diagnostics_
      .report(Code::notSupported, span(now_),
              "a sequential function chart (SFC) is not supported by this version")
      .help("write the steps as a CASE over a state variable");
  while (!startsDeclaration()) {
    if (endsUnit() && now_.type != Tok::END_ACTION)
      return;
    advance();
  }
}

} // namespace stc
