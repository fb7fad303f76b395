// What a symbol is, in words.

#include "compiler/semantics/context/describe.hpp"

namespace stc::sema {

using namespace ast;

std::string describe(const Symbol *symbol) {
  switch (symbol->kind) {
  case SymbolKind::Variable:
    return "a variable";
  case SymbolKind::Pou: {
    switch (static_cast<const PouSymbol *>(symbol)->decl->kind) {
    case DeclKind::Program:
      return "a program";
    case DeclKind::Function:
      return "a function";
    case DeclKind::Class:
      return "a class";
    case DeclKind::Interface:
      return "an interface";
    case DeclKind::Method:
      return "a method";
    case DeclKind::Action:
      return "an action";
    default:
      return "a function block";
    }
  }
  case SymbolKind::Type:
    return "a type";
  case SymbolKind::Enumerator:
    return "an enumerator";
  case SymbolKind::Builtin:
    return "a standard function";
  case SymbolKind::Library:
    return "a library";
  case SymbolKind::Globals:
    return "a list of global variables";
  case SymbolKind::Property:
    return "a property";
  case SymbolKind::Self:
    return static_cast<const SelfSymbol *>(symbol)->isSuper ? "the base of this block"
                                                            : "this block's own instance";
  case SymbolKind::Space:
    return "a namespace";
  }
  return {};
}

void noteDeclaration(Diagnostic &diagnostic, const Symbol *symbol) {
  if (symbol->name.span.valid())
    diagnostic.label(symbol->name.span,
                     "`" + std::string(symbol->name.text) + "` is declared here");
}

} // namespace stc::sema
