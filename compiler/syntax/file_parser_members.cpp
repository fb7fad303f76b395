// Methods, actions and properties, within their block or after it.

#include "compiler/syntax/file_parser.hpp"
#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/token_sets.hpp"
#include <algorithm>
#include <utility>

namespace stc {

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
        .report(Code::MemberWithoutOwner, head.span,
                "this " + std::string(tokenSpelling(head.keyword.type)) + " belongs to no block",
                "outside of every block")
        .help("put it into the block or after it, or write `" +
              std::string(tokenSpelling(head.keyword.type)) + " Block." +
              std::string(head.node->name.text) + "`");
    return nullptr;
  }
  if (owner->node == nullptr)
    return nullptr;
  const ast::DeclKind kind = owner->node->kind;
  const bool isAction = head.keyword.type == Tok::ACTION;
  if (kind == ast::DeclKind::Function ||
      (isAction && (kind == ast::DeclKind::Interface || kind == ast::DeclKind::Class))) {
    const std::string what = kind == ast::DeclKind::Function    ? "a FUNCTION"
                             : kind == ast::DeclKind::Interface ? "an INTERFACE"
                                                                : "a CLASS";
    diagnostics_
        .report(Code::MemberWithoutOwner, head.span,
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
  const uint16_t wanted = endOf(head.keyword.type);
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
  if (owner->node->kind == ast::DeclKind::Interface && !head.node->body.empty()) {
    diagnostics_
        .report(Code::BodyNotAllowed, head.node->body.front()->span,
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
  static constexpr Word kWords[] = {{"public", ast::Access::Public},
                                    {"private", ast::Access::Private},
                                    {"protected", ast::Access::Protected},
                                    {"internal", ast::Access::Internal}};
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
  node->kind = ast::DeclKind::Method;
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
    value->section = ast::Section::Input;
    value->type = property->type;
    content.variables.push_back(value);
  } else {
    node->returnType = property->type;
  }
  const uint16_t wanted = isSet ? Tok::END_SET : Tok::END_GET;
  closers_.push_back(wanted);
  this->content(content, nullptr);
  closers_.pop_back();
  if (now_.type == wanted) {
    node->endSpan = span(now_);
    advance();
  } else if (!content.statements.empty() || content.variables.size() > (isSet ? 1U : 0U)) {
    // Without statements the next accessor or END_PROPERTY closes it: `GET SET END_PROPERTY`.
    const std::string text(tokenSpelling(wanted));
    diagnostics_.report(Code::MissingEnd, head.span, "missing `" + text + "`", "this is not closed")
        .label(span(now_), "expected `" + text + "` before this");
  }
  finishBody(node, content);
  return node;
}

ast::PropertyDecl *FileParser::propertyNode(const Head &head) {
  auto *node = arena_.make<ast::PropertyDecl>();
  if (head.node == nullptr)
    return node;
  static_cast<ast::Decl &>(*node) = *head.node;
  node->type = head.node->returnType;
  if (node->type == nullptr) {
    diagnostics_.report(Code::ExpectedToken, {file_.id(), head.span.end, head.span.end},
                        "expected `:` and the type of the property", "add `: TYPE` here");
    node->type = builder_.errorType(head.span);
  }
  return node;
}

/// GET or SET, with its body.
void FileParser::addAccessor(ast::PropertyDecl *node) {
  const bool isSet = isNow("set");
  const Span where = span(now_);
  ast::PouDecl *&slot = isSet ? node->set : node->get;
  ast::PouDecl *one = accessor(node, isSet);
  if (slot != nullptr)
    diagnostics_
        .report(Code::PropertyAccessor, where,
                std::string("the property has a second ") + (isSet ? "SET" : "GET"),
                "only one is possible")
        .label(slot->span, "the first one");
  else
    slot = one;
}

/// Leaves out what stands in a property, but in none of its accessors.
void FileParser::strayInProperty(bool report) {
  const Span where = span(now_);
  Content stray;
  content(stray, nullptr);
  if (report)
    diagnostics_
        .report(Code::PropertyAccessor, where,
                "statements and variables of a property stand in GET or SET",
                "expected GET, SET or END_PROPERTY")
        .help("write `GET … END_GET` around what reads the property");
  sawExternal_ = false;
}

/// A property of an interface has no statements.
void FileParser::emptyAccessors(ast::PropertyDecl *node) {
  for (ast::PouDecl *one : {node->get, node->set}) {
    if (one == nullptr || one->body.empty())
      continue;
    diagnostics_
        .report(Code::BodyNotAllowed, one->body.front()->span,
                "a property of an INTERFACE has no statements", "this would never run")
        .help("put them into the property of a block that implements the interface");
    one->body = {};
  }
}

void FileParser::property(OpenPou *enclosing) {
  const bool outer = std::exchange(inProperty_, true);
  const Head head = this->head();
  ast::PropertyDecl *node = propertyNode(head);
  closers_.push_back(Tok::END_PROPERTY);
  bool strayReported = false;
  for (;;) {
    if (startsAccessor()) {
      addAccessor(node);
    } else if (now_.type == Tok::SEMICOLON) {
      advance();
    } else if (endsUnit() || isMember(now_.type) || startsDeclaration()) {
      break;
    } else {
      strayInProperty(!strayReported);
      strayReported = true;
    }
  }
  closers_.pop_back();
  inProperty_ = outer;
  Span endSpan;
  close(Tok::END_PROPERTY, head, endSpan);
  sawExternal_ = false;
  if (head.node == nullptr)
    return;
  node->kind = ast::DeclKind::Property; // not the head's
  if (node->get == nullptr && node->set == nullptr && !strayReported)
    diagnostics_
        .report(Code::PropertyAccessor, node->name.span,
                "the property `" + std::string(node->name.text) + "` has neither GET nor SET",
                "cannot be read or written")
        .help("write `GET … END_GET` or `SET … END_SET` before END_PROPERTY");
  OpenPou *owner = ownerOf(head, enclosing, node);
  if (owner == nullptr)
    return;
  if (owner->node->kind == ast::DeclKind::Interface)
    emptyAccessors(node);
  owner->properties.push_back(node);
}

/// A member after its POU, or in a file of its own.
void FileParser::lateMember() {
  const bool first = units_ == 0;
  units_ += first;
  member(pous_.empty() ? nullptr : &pous_.back());
  if (now_.type != Token::kEnd || !first)
    reportMissingEnds();
  missing_.clear();
}

} // namespace stc
