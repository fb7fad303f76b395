// Names that hide other names. Standard functions do not count: `left` and `max` are good names for
// variables, and calling the function anyway is an error that says so.

#include "compiler/semantics/checker.hpp"

namespace stc {

using namespace ast;

void Checker::checkShadowing(Module &module) {
  if (!program_.diagnostics.wants(Code::shadowedName))
    return;
  const auto hides = [&](const VarSymbol *v, const Symbol *hidden, const std::string &what,
                         std::string help) {
    auto &d = report(Code::shadowedName, v->name.span,
                     "`" + std::string(v->name.text) + "` hides " + what, "declared again here");
    if (hidden->name.span.valid())
      d.label(hidden->name.span, "this one cannot be reached by its plain name");
    d.help(std::move(help));
  };
  for (const PouSymbol *pou : module.library->pous) {
    for (const VarSymbol *v : pou->variables) {
      if (v->hidden || v->decl == nullptr || v->section == Section::external)
        continue;
      const std::string name(v->name.text);
      // Inputs and outputs are named for the caller, so only what the body could mean counts.
      if (const auto it = module.names.find(v->name.id); it != module.names.end()) {
        const Symbol *symbol = it->second;
        if (symbol->kind == SymbolKind::variable) {
          const auto *global = static_cast<const VarSymbol *>(symbol);
          if (global->decl != nullptr &&
              program_.sources.file(global->name.span.file).name().front() == '<')
            continue; // a drive of the PLC configuration
          hides(v, symbol, "the global variable of the same name",
                global->globals == nullptr ? std::string("give one of them another name")
                                           : "give one of them another name, or write `" +
                                                 std::string(global->globals->name.text) + "." +
                                                 name + "` for the global one");
        } else if (symbol->kind == SymbolKind::pou && symbol != pou &&
                   static_cast<const PouSymbol *>(symbol)->decl->kind != DeclKind::functionBlock) {
          const bool function = static_cast<const PouSymbol *>(symbol)->isFunction();
          hides(v, symbol,
                function ? "the function of the same name" : "the program of the same name",
                "give one of them another name");
        }
      } else if (const auto e = module.enumerators.find(v->name.id);
                 e != module.enumerators.end()) {
        const EnumeratorSymbol *enumerator = e->second.front();
        hides(v, enumerator, "the enumerator of `" + typeName(enumerator->type) + "`",
              "give the variable another name, or write `" + typeName(enumerator->type) + "." +
                  name + "` for the enumerator");
      }
    }
  }
}

void Checker::checkHiddenLibrary(Module &module) {
  if (!module.library->isUser || !program_.diagnostics.wants(Code::hidesLibrary))
    return;
  const auto look = [&](const Symbol *symbol, std::string_view what) {
    for (const LibraryIndex::Entry &entry : index_.find(symbol->name.id->lower)) {
      const std::string library(entry.library);
      report(Code::hidesLibrary, symbol->name.span,
             "the " + std::string(what) + " `" + std::string(symbol->name.text) +
                 "` hides the one of the library `" + library + "`",
             "the library has this name too")
          .help("give it another name; the library's is `" + library + "." +
                std::string(symbol->name.text) + "`");
      return;
    }
  };
  for (const PouSymbol *pou : module.library->pous)
    look(pou, pou->isFunction()                      ? "function"
              : pou->decl->kind == DeclKind::program ? "program"
                                                     : "function block");
  for (const TypeSymbol *type : module.declaredTypes) {
    if (type->decl != nullptr)
      look(type, "type");
  }
}

} // namespace stc
