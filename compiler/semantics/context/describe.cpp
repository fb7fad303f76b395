// What a symbol is, in words.

#include "compiler/semantics/context/describe.hpp"

namespace stc::sema {

using namespace ast;

std::string describe(const Symbol *symbol) {
  switch (symbol->kind) {
  case SymbolKind::variable:
    return "a variable";
  case SymbolKind::pou: {
    switch (static_cast<const PouSymbol *>(symbol)->decl->kind) {
    case DeclKind::program:
      return "a program";
    case DeclKind::function:
      return "a function";
    case DeclKind::classD:
      return "a class";
    case DeclKind::interface:
      return "an interface";
    case DeclKind::method:
      return "a method";
    case DeclKind::action:
      return "an action";
    default:
      return "a function block";
    }
  }
  case SymbolKind::type:
    return "a type";
  case SymbolKind::enumerator:
    return "an enumerator";
  case SymbolKind::builtin:
    return "a standard function";
  case SymbolKind::library:
    return "a library";
  case SymbolKind::globals:
    return "a list of global variables";
  case SymbolKind::property:
    return "a property";
  case SymbolKind::self:
    return static_cast<const SelfSymbol *>(symbol)->isSuper ? "the base of this block"
                                                            : "this block's own instance";
  case SymbolKind::space:
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
