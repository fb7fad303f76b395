// Namespaces, CONFIGURATION.

#include "compiler/syntax/ast_builder.hpp"
#include <algorithm>
#include <string>

namespace stc {

using namespace ast;

NamePath AstBuilder::namespaceNames(Grammar::NamespaceHeadContext *context) {
  return context->children.size() > 1 && !failed(context) ? path(child(context, 1)) : NamePath{};
}

void AstBuilder::usings(Grammar::UsingDirectiveContext *context, std::vector<NamePath> &out) {
  const std::span<NamePath> list = paths(context);
  out.insert(out.end(), list.begin(), list.end());
}

void AstBuilder::resourceHead(Grammar::ResourceHeadContext *context, ResourceDecl &out) {
  for (size_t i = first(context); i <= last(context); ++i) {
    if (token(i).type != Tok::IDENT)
      continue;
    (token(i - 1).type == Tok::ON ? out.processor : out.name) = name(token(i));
  }
}

void AstBuilder::task(Grammar::TaskDeclarationContext *context, std::vector<TaskDecl> &out) {
  const size_t at = first(context) + 1;
  if (failed(context) || at > last(context) || token(at).type != Tok::IDENT)
    return;
  TaskDecl node;
  node.name = name(token(at));
  node.span = span(context);
  if (!context->children.empty())
    node.arguments = arguments(child(context, 0));
  out.push_back(node);
}

void AstBuilder::programInstance(Grammar::ProgramInstanceContext *context,
                                 std::vector<ProgramInstanceDecl> &out) {
  if (failed(context))
    return;
  ProgramInstanceDecl node;
  node.span = span(context);
  for (size_t i = first(context) + 1; i <= last(context); ++i) {
    const Token &one = token(i);
    if (one.type == Tok::RETAIN)
      node.qualifiers |= kQualRetain;
    else if (one.type == Tok::NON_RETAIN)
      node.qualifiers |= kQualNonRetain;
    else if (one.type == Tok::IDENT && token(i - 1).type == Tok::WITH)
      node.task = name(one);
    else if (one.type == Tok::IDENT && !node.name)
      node.name = name(one);
    else if (one.type == Tok::COLON || one.type == Tok::LPAREN)
      break;
  }
  for (size_t i = 0; i < context->children.size(); ++i) {
    Context *part = child(context, i);
    if (part->getRuleIndex() == Grammar::RulePath)
      node.type = path(part);
    else
      node.arguments = arguments(part);
  }
  if (node.name)
    out.push_back(node);
}

} // namespace stc
