#include "compiler/syntax/ast_builder.hpp"

#include "compiler/syntax/attributes.hpp"

#include <algorithm>
#include <string>

namespace stc {

using namespace ast;

AstBuilder::AstBuilder(const Scanner &scanner, FileId file, UnitStream &stream, Interner &interner,
                       Arena &arena, Diagnostics &diagnostics)
    : scanner_(scanner), file_(file), stream_(stream), interner_(interner), arena_(arena),
      diagnostics_(diagnostics), literals_(arena, diagnostics) {}

// --------------------------------------------------------------------------------------------
// contexts and tokens

size_t AstBuilder::last(const Context *context) {
  return context->stop == nullptr ? first(context) - 1 : context->stop->getTokenIndex();
}

Span AstBuilder::span(const Context *context) const {
  const auto *start = static_cast<const Token *>(context->start);
  const auto *stop = static_cast<const Token *>(context->stop);
  if (stop == nullptr || stop->index < start->index || stop->end < start->begin) // empty
    return {file_, start->begin, start->begin};
  return {file_, start->begin, stop->end};
}

Name AstBuilder::name(const Token &token) {
  const std::string_view spelling = text(token);
  return {interner_.intern(spelling, token.hash), spelling, span(token)};
}

std::span<Name> AstBuilder::path(const Context *context) {
  std::vector<Name> names;
  for (size_t i = first(context); context->stop != nullptr && i <= last(context); i += 2)
    if (token(i).type == Tok::IDENT)
      names.push_back(name(token(i)));
  return arena_.copy(names);
}

std::span<NamePath> AstBuilder::paths(const Context *context) {
  std::vector<NamePath> list;
  for (size_t i = 0; i < context->children.size(); ++i)
    if (const NamePath names = path(child(context, i)); !names.empty())
      list.push_back(names);
  return arena_.copy(list);
}

Attributes AstBuilder::attributes(const Token &token) {
  std::vector<Attribute> list;
  for (size_t i = 0; i < token.triviaCount; ++i)
    if (const Trivia &trivia = scanner_.trivia()[token.triviaBegin + i];
        trivia.kind == Trivia::Kind::Attribute)
      list.push_back({findAttribute(trivia.name),
                      trivia.name,
                      trivia.value,
                      {file_, trivia.begin, trivia.end}});
  if (list.empty())
    return {};
  auto *data = static_cast<Attribute *>(
      arena_.allocate(sizeof(Attribute) * list.size(), alignof(Attribute)));
  std::copy(list.begin(), list.end(), data);
  return {data, list.size()};
}

std::string_view AstBuilder::doc(const Token &token) {
  std::string_view only;
  std::string joined;
  for (size_t i = 0; i < token.triviaCount; ++i) {
    const Trivia &trivia = scanner_.trivia()[token.triviaBegin + i];
    if (trivia.kind != Trivia::Kind::Doc)
      continue;
    if (only.data() == nullptr) {
      only = trivia.name;
      continue;
    }
    if (joined.empty())
      joined = only;
    joined += '\n';
    joined += trivia.name;
  }
  return joined.empty() ? only : arena_.copy(std::string_view(joined));
}

// ---------------------------------------------------------------------------------------------------
// declarations

Access AstBuilder::accessOf(uint16_t type) {
  switch (type) {
  case Tok::PUBLIC:
    return Access::Public;
  case Tok::PRIVATE:
    return Access::Private;
  case Tok::PROTECTED:
    return Access::Protected;
  default:
    return Access::Internal;
  }
}

void AstBuilder::modifiers(const Context *context, Decl &out) {
  const size_t end = last(context);
  const Token *access = nullptr;
  for (size_t i = first(context); i <= end && context->stop != nullptr; ++i) {
    const Token &one = token(i);
    switch (one.type) {
    case Tok::ABSTRACT:
      out.modifiers |= kModAbstract;
      continue;
    case Tok::FINAL:
      out.modifiers |= kModFinal;
      continue;
    case Tok::OVERRIDE:
      out.modifiers |= kModOverride;
      continue;
    default:
      break;
    }
    if (access != nullptr) {
      diagnostics_
          .report(Code::UnexpectedToken, span(one), "there is a second access specifier here",
                  "only one is possible")
          .label(span(*access), "the first one");
      continue;
    }
    access = &one;
    out.access = accessOf(one.type);
  }
}

namespace {

DeclKind pouKindOf(uint16_t keyword) {
  switch (keyword) {
  case Tok::PROGRAM:
    return DeclKind::Program;
  case Tok::FUNCTION:
    return DeclKind::Function;
  case Tok::CLASS:
    return DeclKind::Class;
  case Tok::INTERFACE:
    return DeclKind::Interface;
  case Tok::METHOD:
  case Tok::PROPERTY:
    return DeclKind::Method;
  case Tok::ACTION:
    return DeclKind::Action;
  default:
    return DeclKind::FunctionBlock;
  }
}

} // namespace

/// `what`: the keyword of the head.
void AstBuilder::extendsClause(const Context *clause, const std::string &what, PouDecl &out) {
  if (out.kind == DeclKind::Interface) {
    out.interfaces = paths(clause);
    return;
  }
  if (out.kind != DeclKind::FunctionBlock && out.kind != DeclKind::Class) {
    diagnostics_.report(Code::UnexpectedToken, span(clause),
                        "only blocks, classes, interfaces and structures can extend another one",
                        "not possible for a " + what);
    return;
  }
  out.base = path(child(clause, 0));
  if (clause->children.size() > 1)
    diagnostics_
        .report(Code::UnexpectedToken, span(child(clause, 1)),
                "a " + what + " extends one other only", "a second base")
        .help("several INTERFACEs can be implemented: `IMPLEMENTS A, B`");
}

void AstBuilder::implementsClause(const Context *clause, const std::string &what, PouDecl &out) {
  if (out.kind == DeclKind::FunctionBlock || out.kind == DeclKind::Class) {
    out.interfaces = paths(clause);
    return;
  }
  Diagnostic &d = diagnostics_.report(
      Code::UnexpectedToken, span(clause), "only blocks and classes can implement an interface",
      "not possible for " + std::string(what == "INTERFACE" ? "an " : "a ") + what);
  if (out.kind == DeclKind::Interface)
    d.help("an INTERFACE takes in others with EXTENDS");
}

PouDecl *AstBuilder::head(Grammar::PouHeadContext *context, NamePath &owner) {
  const Token &keyword = token(first(context));
  auto *node = arena_.make<PouDecl>();
  node->kind = pouKindOf(keyword.type);
  node->span = span(context);
  node->attributes = attributes(keyword);
  node->doc = doc(keyword);
  const std::string what(tokenSpelling(keyword.type));
  for (size_t i = 0; i < context->children.size(); ++i) {
    Context *part = child(context, i);
    switch (part->getRuleIndex()) {
    case Grammar::RuleModifiers:
      modifiers(part, *node);
      break;
    case Grammar::RulePath:
      if (const std::span<Name> names = path(part); !names.empty()) {
        node->name = names.back();
        owner = names.first(names.size() - 1);
      }
      break;
    case Grammar::RuleTypeSpec:
      node->returnType = failed(part) ? errorType(span(part)) : type(part);
      break;
    case Grammar::RuleExtendsClause:
      extendsClause(part, what, *node);
      break;
    default:
      implementsClause(part, what, *node);
      break;
    }
  }
  return node->name ? node : nullptr;
}

void AstBuilder::types(Grammar::TypeBlockContext *context, std::vector<Decl *> &out) {
  for (size_t i = 0; i < context->children.size(); ++i) {
    if (Decl *node = typeDeclaration(child(context, i)); node != nullptr) {
      // What stands before TYPE belongs to its first type.
      if (i == 0) {
        const Token &keyword = token(first(context));
        if (node->doc.empty())
          node->doc = doc(keyword);
        if (node->attributes.empty())
          node->attributes = attributes(keyword);
      }
      out.push_back(node);
    }
  }
}

/// `EXTENDS b` of a structure, after its name or after STRUCT.
void AstBuilder::structBase(const Context *clause, StructBase &out) {
  if (failed(clause) || clause->children.empty())
    return;
  out.path = path(child(clause, 0));
  out.span = span(clause);
  if (clause->children.size() > 1)
    diagnostics_.report(Code::UnexpectedToken, span(child(clause, 1)),
                        "a structure extends one other only", "a second base");
}

StructDecl *AstBuilder::structure(Context *body, StructBase base) {
  auto *node = arena_.make<StructDecl>();
  node->isUnion = token(first(body)).type == Tok::UNION;
  size_t firstField = 0;
  if (!body->children.empty() &&
      child(body, 0)->getRuleIndex() == Grammar::RuleExtendsClause) { // STRUCT EXTENDS b
    structBase(child(body, 0), base);
    firstField = 1;
  }
  node->base = base.path;
  std::vector<VarDecl *> fields;
  declarations(body, firstField, Section::Local, 0, fields);
  node->fields = arena_.copy(fields);
  return node;
}

/// An enumeration or another name for a type; the children of `context` from `i` on are the type
/// and the initial value.
Decl *AstBuilder::plainType(const Context *context, size_t i) {
  TypeExpr *type = this->type(child(context, i), true);
  Expr *init = i + 1 < context->children.size() ? initializer(child(context, i + 1)) : nullptr;
  if (type->kind == TypeExprKind::Enumeration) {
    auto *node = arena_.make<EnumDecl>();
    node->type = as<EnumTypeExpr>(type);
    node->init = init;
    return node;
  }
  auto *node = arena_.make<AliasDecl>();
  node->type = type;
  node->init = init;
  return node;
}

Decl *AstBuilder::typeDeclaration(Context *context) {
  Context *modifierList = child(context, 0);
  const size_t at = modifierList->stop == nullptr || last(modifierList) < first(modifierList)
                        ? first(modifierList)
                        : last(modifierList) + 1;
  if (token(at).type != Tok::IDENT || at > last(context))
    return nullptr;
  const Token &start = token(first(context));
  const Name name = this->name(token(at));
  size_t i = 1;
  StructBase base;
  if (i < context->children.size() &&
      child(context, i)->getRuleIndex() == Grammar::RuleExtendsClause)
    structBase(child(context, i++), base);
  Decl *node = nullptr;
  if (failed(context) || i >= context->children.size()) {
    auto *alias = arena_.make<AliasDecl>();
    alias->type = errorType(name.span);
    node = alias;
  } else if (Context *body = child(context, i); body->getRuleIndex() == Grammar::RuleStructBody) {
    node = structure(body, base);
  } else {
    if (!base.path.empty())
      diagnostics_.report(Code::UnexpectedToken, base.span,
                          "only a STRUCT can extend another type");
    node = plainType(context, i);
  }
  node->name = name;
  node->span = span(context);
  node->attributes = attributes(start);
  node->doc = doc(start);
  modifiers(modifierList, *node);
  return node;
}

} // namespace stc
