#include "compiler/syntax/ast_builder.hpp"

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

std::size_t AstBuilder::last(const Context *context) {
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
  for (std::size_t i = first(context); i <= last(context); i += 2)
    names.push_back(name(token(i)));
  return arena_.copy(names);
}

Attributes AstBuilder::attributes(const Token &token) {
  std::vector<Attribute> list;
  for (std::size_t i = 0; i < token.triviaCount; ++i)
    if (const Trivia &trivia = scanner_.trivia()[token.triviaBegin + i];
        trivia.kind == Trivia::Kind::attribute)
      list.push_back({trivia.name, trivia.value, {file_, trivia.begin, trivia.end}});
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
  for (std::size_t i = 0; i < token.triviaCount; ++i) {
    const Trivia &trivia = scanner_.trivia()[token.triviaBegin + i];
    if (trivia.kind != Trivia::Kind::doc)
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

void AstBuilder::notSupported(Span span, std::string what) {
  diagnostics_.report(Code::notSupported, span, what + " is not supported by this version");
}

// ---------------------------------------------------------------------------------------------------
// declarations

PouDecl *AstBuilder::head(Grammar::PouHeadContext *context) {
  const Token &keyword = token(first(context));
  auto *node = arena_.make<PouDecl>();
  node->kind = keyword.type == Tok::PROGRAM    ? DeclKind::program
               : keyword.type == Tok::FUNCTION ? DeclKind::function
                                               : DeclKind::functionBlock;
  node->span = span(context);
  node->attributes = attributes(keyword);
  node->doc = doc(keyword);
  for (std::size_t i = 0; i < context->children.size(); ++i) {
    Context *part = child(context, i);
    switch (part->getRuleIndex()) {
    case Grammar::RuleModifiers: {
      const std::size_t after =
          part->stop == nullptr || last(part) < first(part) ? first(part) : last(part) + 1;
      for (std::size_t k = first(part); k < after; ++k)
        if (token(k).type == Tok::ABSTRACT)
          notSupported(span(token(k)), "ABSTRACT");
      if (token(after).type == Tok::IDENT)
        node->name = name(token(after));
      break;
    }
    case Grammar::RuleTypeSpec:
      node->returnType = failed(part) ? errorType(span(part)) : type(part);
      break;
    case Grammar::RuleExtendsClause:
      notSupported(span(part), "inheritance of function blocks");
      break;
    default:
      notSupported(span(part), "implementing an interface");
      break;
    }
  }
  return node->name ? node : nullptr;
}

void AstBuilder::section(Grammar::VarSectionContext *context, std::vector<VarDecl *> &out) {
  Section section = Section::local;
  switch (token(first(context)).type) {
  case Tok::VAR_INPUT:
    section = Section::input;
    break;
  case Tok::VAR_OUTPUT:
    section = Section::output;
    break;
  case Tok::VAR_IN_OUT:
    section = Section::inOut;
    break;
  case Tok::VAR_TEMP:
    section = Section::temp;
    break;
  case Tok::VAR_STAT:
    section = Section::stat;
    break;
  case Tok::VAR_EXTERNAL:
    section = Section::external;
    break;
  case Tok::VAR_GLOBAL:
    section = Section::global;
    break;
  default:
    break;
  }
  std::uint8_t qualifiers = 0;
  for (std::size_t i = first(context) + 1;; ++i) {
    const std::uint16_t type = token(i).type;
    if (type == Tok::CONSTANT)
      qualifiers |= qualConstant;
    else if (type == Tok::RETAIN)
      qualifiers |= qualRetain;
    else if (type == Tok::PERSISTENT)
      qualifiers |= qualPersistent;
    else if (type == Tok::NON_RETAIN)
      qualifiers |= qualNonRetain;
    else
      break;
  }
  declarations(context, 1, section, qualifiers, out);
}

void AstBuilder::declarations(Context *context, std::size_t from, Section section,
                              std::uint8_t qualifiers, std::vector<VarDecl *> &out) {
  for (std::size_t i = from; i < context->children.size(); ++i)
    declaration(child(context, i), section, qualifiers, out);
}

void AstBuilder::declaration(Context *context, Section section, std::uint8_t qualifiers,
                             std::vector<VarDecl *> &out) {
  Context *names = child(context, 0);
  TypeExpr *type = nullptr;
  Expr *init = nullptr;
  if (failed(context)) {
    type = errorType(span(context));
  } else {
    type = this->type(child(context, 1));
    if (context->children.size() > 2)
      init = initializer(child(context, 2));
  }
  const Token &start = token(first(names));
  const std::size_t end = last(names);
  for (std::size_t i = first(names); i <= end && token(i).type == Tok::IDENT;) {
    auto *node = arena_.make<VarDecl>();
    const Token &own = token(i);
    node->name = name(own);
    node->section = section;
    node->qualifiers = qualifiers;
    node->type = type;
    node->init = init;
    const Token &documented = own.triviaCount != 0 ? own : start;
    node->attributes = attributes(documented);
    node->doc = doc(documented);
    if (i + 2 <= end && token(i + 1).type == Tok::AT) {
      if (!token(i + 2).reported) {
        node->address = arena_.make<DirectAddress>();
        node->address->span = span(token(i + 2));
        node->address->text = text(token(i + 2));
      }
      i += 2;
    }
    out.push_back(node);
    i += 2; // the name and the comma
  }
}

void AstBuilder::types(Grammar::TypeBlockContext *context, std::vector<Decl *> &out) {
  for (std::size_t i = 0; i < context->children.size(); ++i) {
    if (Decl *node = typeDeclaration(child(context, i)); node != nullptr) {
      // What stands in front of TYPE belongs to its first type.
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

Decl *AstBuilder::typeDeclaration(Context *context) {
  Context *modifiers = child(context, 0);
  const std::size_t at = modifiers->stop == nullptr || last(modifiers) < first(modifiers)
                             ? first(modifiers)
                             : last(modifiers) + 1;
  if (token(at).type != Tok::IDENT || at > last(context))
    return nullptr;
  const Token &start = token(first(context));
  const Name name = this->name(token(at));
  std::size_t i = 1;
  Name base;
  if (i < context->children.size() &&
      child(context, i)->getRuleIndex() == Grammar::RuleExtendsClause) {
    const Context *clause = child(context, i);
    if (last(clause) == first(clause) + 1)
      base = this->name(token(first(clause) + 1));
    else
      notSupported(span(clause), "a base type of another namespace");
    ++i;
  }
  const auto common = [&](Decl *node, DeclKind kind) {
    node->kind = kind;
    node->name = name;
    node->span = span(context);
    node->attributes = attributes(start);
    node->doc = doc(start);
    return node;
  };
  const auto failedType = [&] {
    auto *node = arena_.make<AliasDecl>();
    node->type = errorType(name.span);
    return common(node, DeclKind::alias);
  };
  if (failed(context) || i >= context->children.size())
    return failedType();
  Context *body = child(context, i);
  if (body->getRuleIndex() == Grammar::RuleStructBody) {
    if (token(first(body)).type == Tok::UNION) {
      notSupported(span(token(first(body))), "UNION");
      return failedType();
    }
    auto *node = arena_.make<StructDecl>();
    if (base)
      node->base = arena_.copy(std::vector<Name>{base});
    std::vector<VarDecl *> fields;
    declarations(body, 0, Section::local, 0, fields);
    node->fields = arena_.copy(fields);
    return common(node, DeclKind::structure);
  }
  if (base)
    diagnostics_.report(Code::unexpectedToken, base.span, "only a STRUCT can extend another type");
  TypeExpr *type = this->type(body);
  Expr *init = i + 1 < context->children.size() ? initializer(child(context, i + 1)) : nullptr;
  if (type->kind == TypeExprKind::enumeration) {
    auto *node = arena_.make<EnumDecl>();
    node->type = as<EnumTypeExpr>(type);
    node->init = init;
    return common(node, DeclKind::enumeration);
  }
  auto *node = arena_.make<AliasDecl>();
  node->type = type;
  node->init = init;
  return common(node, DeclKind::alias);
}

// ---------------------------------------------------------------------------------------------------------
// types

TypeExpr *AstBuilder::errorType(Span span) {
  auto *node = arena_.make<TypeExpr>();
  node->kind = TypeExprKind::error;
  node->span = span;
  return node;
}

TypeExpr *AstBuilder::type(Context *context) {
  const Token &start = token(first(context));
  const Span whole = span(context);
  switch (start.type) {
  case Tok::ARRAY: {
    auto *node = arena_.make<ArrayTypeExpr>();
    node->kind = TypeExprKind::array;
    node->span = whole;
    std::vector<ArrayRange> ranges;
    for (std::size_t i = 0; i + 1 < context->children.size(); ++i) {
      Context *part = child(context, i);
      ArrayRange range;
      range.span = span(part);
      if (part->children.size() > 1) {
        range.low = expression(child(part, 0));
        range.high = expression(child(part, 1));
      }
      ranges.push_back(range);
    }
    node->ranges = arena_.copy(ranges);
    node->element = type(child(context, context->children.size() - 1));
    return node;
  }
  case Tok::POINTER:
  case Tok::REFERENCE: {
    auto *node = arena_.make<PointerTypeExpr>();
    node->kind = start.type == Tok::POINTER ? TypeExprKind::pointer : TypeExprKind::reference;
    node->span = whole;
    node->pointee = type(child(context, 0));
    return node;
  }
  case Tok::STRING:
  case Tok::WSTRING: {
    auto *node = arena_.make<StringTypeExpr>();
    node->kind = TypeExprKind::string;
    node->span = whole;
    node->wide = start.type == Tok::WSTRING;
    if (!context->children.empty())
      node->length = expression(child(context, 0));
    return node;
  }
  case Tok::LPAREN: {
    std::size_t arguments = context->children.size();
    TypeExpr *base = nullptr;
    if (Context *end = child(context, arguments - 1); end->getRuleIndex() == Grammar::RulePath) {
      --arguments;
      auto *named = arena_.make<NamedTypeExpr>();
      named->kind = TypeExprKind::named;
      named->span = span(end);
      named->path = path(end);
      base = named;
    }
    EnumTypeExpr *node = enumeration(context, 0, arguments);
    if (node == nullptr)
      return errorType(whole);
    node->base = base;
    return node;
  }
  default:
    return namedType(context);
  }
}

TypeExpr *AstBuilder::namedType(Context *context) {
  Context *names = child(context, 0);
  auto *named = arena_.make<NamedTypeExpr>();
  named->kind = TypeExprKind::named;
  named->span = span(names);
  named->path = path(names);
  if (context->children.size() == 1)
    return named;
  Context *argument = child(context, 1);
  const std::uint16_t sign =
      argument->children.size() > 1 ? token(last(child(argument, 0)) + 1).type : std::uint16_t{0};
  if (sign == Tok::DOTDOT) {
    auto *node = arena_.make<SubrangeTypeExpr>();
    node->kind = TypeExprKind::subrange;
    node->span = span(context);
    node->base = named;
    node->low = expression(child(argument, 0));
    node->high = expression(child(argument, 1));
    if (context->children.size() > 2)
      diagnostics_.report(Code::unexpectedToken, span(child(context, 2)),
                          "a subrange has one range");
    return node;
  }
  // INT (a, b := 5): edition 3's way to give an enumeration its base type.
  if (plainName(child(argument, 0)) != nullptr) {
    if (EnumTypeExpr *node = enumeration(context, 1, context->children.size()); node != nullptr) {
      node->base = named;
      return node;
    }
    return errorType(span(context));
  }
  notSupported(span(context), "an instance with arguments for FB_Init");
  return errorType(span(context));
}

EnumTypeExpr *AstBuilder::enumeration(Context *context, std::size_t firstArgument,
                                      std::size_t arguments) {
  auto *node = arena_.make<EnumTypeExpr>();
  node->kind = TypeExprKind::enumeration;
  node->span = span(context);
  std::vector<EnumeratorDecl> list;
  for (std::size_t i = firstArgument; i < arguments; ++i) {
    Context *argument = child(context, i);
    Context *front = child(argument, 0);
    const Token *plain = plainName(front);
    if (plain == nullptr ||
        (argument->children.size() > 1 && token(last(front) + 1).type != Tok::ASSIGN)) {
      diagnostics_.report(Code::unexpectedToken, span(argument),
                          "expected the name of an enumerator", "not `name` or `name := value`");
      return nullptr;
    }
    EnumeratorDecl one;
    one.name = name(*plain);
    if (argument->children.size() > 1)
      one.value = expression(child(argument, 1));
    one.doc = doc(*plain);
    list.push_back(one);
  }
  node->enumerators = arena_.copy(list);
  return node;
}

} // namespace stc
