// Variables: VAR sections, and what is declared in them.

#include "compiler/syntax/ast_builder.hpp"

#include <string>

namespace stc {

using namespace ast;

namespace {

Section sectionOf(uint16_t keyword) {
  switch (keyword) {
  case Tok::VAR_INPUT:
    return Section::Input;
  case Tok::VAR_OUTPUT:
    return Section::Output;
  case Tok::VAR_IN_OUT:
    return Section::InOut;
  case Tok::VAR_TEMP:
    return Section::Temp;
  case Tok::VAR_STAT:
    return Section::Stat;
  case Tok::VAR_EXTERNAL:
    return Section::External;
  case Tok::VAR_GLOBAL:
    return Section::Global;
  case Tok::VAR_INST:
    return Section::Instance;
  case Tok::VAR_CONFIG:
    return Section::Config;
  case Tok::VAR_ACCESS:
    return Section::Access;
  default:
    return Section::Local;
  }
}

/// A qualifier's bit; 0: the word is none.
uint8_t qualifierOf(uint16_t keyword) {
  switch (keyword) {
  case Tok::CONSTANT:
    return kQualConstant;
  case Tok::RETAIN:
    return kQualRetain;
  case Tok::PERSISTENT:
    return kQualPersistent;
  case Tok::NON_RETAIN:
    return kQualNonRetain;
  default:
    return 0;
  }
}

} // namespace

void AstBuilder::section(Grammar::VarSectionContext *context, std::vector<VarDecl *> &out) {
  const Section section = sectionOf(token(first(context)).type);
  uint8_t qualifiers = 0;
  Access access = Access::None;
  for (size_t i = first(context) + 1;; ++i) {
    const uint16_t type = token(i).type;
    if (const uint8_t qualifier = qualifierOf(type); qualifier != 0)
      qualifiers |= qualifier;
    else if (type >= Tok::PUBLIC && type <= Tok::INTERNAL)
      access = accessOf(type);
    else if (type == Tok::ABSTRACT || type == Tok::FINAL || type == Tok::OVERRIDE)
      diagnostics_.report(Code::UnexpectedToken, span(token(i)),
                          "variables cannot be " + std::string(text(token(i))),
                          "only methods and blocks can");
    else
      break;
  }
  const size_t before = out.size();
  for (size_t i = 1; i < context->children.size(); ++i) {
    Context *part = child(context, i);
    if (section == Section::Config)
      configVariable(part, qualifiers, out);
    else if (section == Section::Access)
      accessVariable(part, out);
    else
      declaration(part, section, qualifiers, out);
  }
  for (size_t i = before; i < out.size(); ++i)
    out[i]->access = access;
}

void AstBuilder::declarations(Context *context, size_t from, Section section, uint8_t qualifiers,
                              std::vector<VarDecl *> &out) {
  for (size_t i = from; i < context->children.size(); ++i)
    declaration(child(context, i), section, qualifiers, out);
}

/// `AT %IX0.0 : BOOL;` says what lies there; programs use the address itself.
VarDecl *AstBuilder::unnamed(const Token &start, const Token &direct) {
  const Attribute hide{AttributeId::Hide, "hide", {}, {}};
  auto *node = arena_.make<VarDecl>();
  const std::string_view own = arena_.copy(std::string_view("at__" + std::to_string(direct.begin)));
  node->name = {interner_.intern(own), own, span(direct)};
  node->doc = doc(start);
  node->address = address(direct);
  const Attributes written = attributes(start);
  std::vector<Attribute> all(written.begin(), written.end());
  all.push_back(hide);
  node->attributes = arena_.copy(all);
  return node;
}

/// The variable that keeps what the input was in the last call.
VarDecl *AstBuilder::lastCallOf(const VarDecl *input) {
  auto *node = arena_.make<VarDecl>();
  const std::string_view own =
      arena_.copy(std::string_view(std::string(input->name.text) + "__edge"));
  node->name = {interner_.intern(own), own, input->name.span};
  node->type = input->type;
  const Attribute hide{AttributeId::Hide, "hide", {}, {}};
  node->attributes = arena_.copy(std::vector<Attribute>{hide});
  return node;
}

/// R_EDGE or F_EDGE after the type.
Edge AstBuilder::edgeOf(const Context *type, Section section) {
  const Token &word = token(last(type) + 1);
  if (word.type != Tok::R_EDGE && word.type != Tok::F_EDGE)
    return Edge::None;
  if (section == Section::Input)
    return word.type == Tok::R_EDGE ? Edge::Rising : Edge::Falling;
  diagnostics_
      .report(Code::SectionNotAllowed, span(word),
              "only inputs of a function block or program can be edges", "not a VAR_INPUT")
      .help("use R_TRIG or F_TRIG");
  return Edge::None;
}

void AstBuilder::declaration(Context *context, Section section, uint8_t qualifiers,
                             std::vector<VarDecl *> &out) {
  Context *names = child(context, 0);
  TypeExpr *type = nullptr;
  Expr *init = nullptr;
  Edge edge = Edge::None;
  if (failed(context)) {
    type = errorType(span(context));
  } else {
    type = this->type(child(context, 1));
    edge = edgeOf(child(context, 1), section);
    if (context->children.size() > 2) {
      init = initializer(child(context, 2));
      if (const Token &sign = token(first(child(context, 2)) - 1);
          sign.type == Tok::REF_ASSIGN && type->kind != TypeExprKind::Reference)
        diagnostics_
            .report(Code::NotAReference, span(sign), "only a REFERENCE is bound with REF=",
                    "this variable is declared with another type")
            .help("write `:=` for an initial value, or declare it as `REFERENCE TO` the type");
    }
  }
  const Token &start = token(first(names));
  const size_t end = last(names);
  if (start.type == Tok::AT && end > first(names)) {
    auto *node = unnamed(start, token(end));
    node->section = section;
    node->qualifiers = qualifiers;
    node->type = type;
    node->init = init;
    out.push_back(node);
    return;
  }
  for (size_t i = first(names); i <= end && token(i).type == Tok::IDENT;) {
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
      node->address = address(token(i + 2));
      i += 2;
    }
    out.push_back(node);
    node->edge = edge;
    if (edge != Edge::None) {
      node->lastCall = lastCallOf(node);
      out.push_back(node->lastCall);
    }
    i += 2; // the name and the comma
  }
}

/// `Main.fb.x AT %IX0.0 : BOOL := TRUE;` of VAR_CONFIG
void AstBuilder::configVariable(Context *context, uint8_t qualifiers, std::vector<VarDecl *> &out) {
  Context *front = child(context, 0);
  if (failed(context) || context->children.size() < 2)
    return;
  auto *node = arena_.make<VarDecl>();
  const Token &start = token(first(front));
  node->section = Section::Config;
  node->qualifiers = qualifiers;
  node->attributes = attributes(start);
  node->doc = doc(start);
  node->path = operand(front);
  const std::string_view spelling =
      scanner_.text().substr(start.begin, span(front).end - start.begin);
  node->name = {interner_.intern(spelling), spelling, span(front)};
  node->type = type(child(context, 1));
  if (context->children.size() > 2)
    node->init = initializer(child(context, 2));
  if (const size_t at = last(front) + 1; token(at).type == Tok::AT)
    node->address = address(token(at + 1));
  out.push_back(node);
}

/// `x : Station.Main.y : INT READ_ONLY;` of VAR_ACCESS
void AstBuilder::accessVariable(Context *context, std::vector<VarDecl *> &out) {
  const Token &start = token(first(context));
  if (failed(context) || context->children.size() < 2 || start.type != Tok::IDENT)
    return;
  auto *node = arena_.make<VarDecl>();
  node->section = Section::Access;
  node->attributes = attributes(start);
  node->doc = doc(start);
  node->name = name(start);
  node->path = operand(child(context, 0));
  Context *type = child(context, 1);
  node->type = this->type(type);
  const uint16_t direction = token(last(type) + 1).type;
  node->readOnly = direction == Tok::READ_ONLY;
  node->readWrite = direction == Tok::READ_WRITE;
  out.push_back(node);
}

} // namespace stc
