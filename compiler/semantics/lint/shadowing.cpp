// Names that hide other names. Standard functions do not count: `left` and `max` are good names for
// variables, and calling the function anyway is an error that says so.

#include "compiler/semantics/lint/shadowing.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static void checkHiddenMember(Context &c, const PouSymbol *method, const VarSymbol *v);
static void checkHidden(Context &c, Module &module, const PouSymbol *pou, const VarSymbol *v);

namespace {

/// Whether the text of a library file declares that name after `word`.
bool declares(std::string_view text, std::string_view word, std::string_view lowerName) {
  for (size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::string_view name = text.substr(at + word.size(), lowerName.size() + 1);
    if ((at == 0 || text[at - 1] == '\n') && name.size() > lowerName.size() &&
        std::equal(lowerName.begin(), lowerName.end(), name.begin(),
                   [](char wanted, char c) { return wanted == lowerCase(c); }) &&
        (name.back() == ' ' || name.back() == ':' || name.back() == '\n'))
      return true;
  }
  return false;
}

/// Blocks and types do not count: a variable of the same name (`tp : TP`) takes nothing away.
bool declaresFunction(std::string_view text, std::string_view lowerName) {
  return declares(text, "FUNCTION ", lowerName);
}

/// Enumerators do not count: they are found by the type that is expected.
bool declaresPouOrType(std::string_view text, std::string_view lowerName) {
  return declaresFunction(text, lowerName) || declares(text, "FUNCTION_BLOCK ", lowerName) ||
         declares(text, "TYPE ", lowerName) || declares(text, "INTERFACE ", lowerName);
}

} // namespace

static Diagnostic &reportHidden(Context &c, const VarSymbol *v, const Symbol *hidden,
                                const std::string &what) {
  auto &d = c.report(Code::ShadowedName, v->name.span,
                     "`" + std::string(v->name.text) + "` hides " + what, "declared again here");
  if (hidden != nullptr && hidden->name.span.valid())
    d.label(hidden->name.span, "this one cannot be reached by its plain name");
  return d;
}

void checkShadowing(Context &c, Module &module) {
  if (!c.program.diagnostics.wants(Code::ShadowedName))
    return;
  const auto look = [&](const PouSymbol *pou) {
    for (const VarSymbol *v : pou->variables) {
      if (v->hidden || v->decl == nullptr || v->section == Section::External || !v->storage.empty())
        continue;
      if (pou->isMethod())
        checkHiddenMember(c, pou, v);
      else
        checkHidden(c, module, pou, v);
    }
  };
  for (const PouSymbol *pou : module.library->pous) {
    look(pou);
    for (const PouSymbol *method : pou->methods)
      look(method);
  }
}

/// What a variable of a method hides of its block, the block's bases included.
static void checkHiddenMember(Context &c, const PouSymbol *method, const VarSymbol *v) {
  const PouSymbol *owner = method->owner;
  if (owner->isInterface() || (method->decl->modifiers & kModAbstract) != 0 ||
      c.throughSelf.contains({method, v->name.id})) // `THIS^.speed := speed` knows both
    return;
  const std::string name(v->name.text);
  const std::string help =
      "give one of them another name, or write `THIS^." + name + "` for the one of the block";
  for (const PouSymbol *block = owner; block != nullptr; block = block->base) {
    const auto it = block->scope.find(v->name.id);
    if (it == block->scope.end() || it->second->isResult || it->second->section == Section::Temp ||
        it->second->hidden)
      continue;
    const VarSymbol *member = it->second;
    if (block != owner && member->decl != nullptr && member->decl->access == Access::Private)
      continue;
    reportHidden(c, v, member,
                 block == owner
                     ? "the variable of the block"
                     : "the variable inherited from `" + std::string(block->name.text) + "`")
        .help(help);
    return;
  }
  // `METHOD MoveTo VAR_INPUT position …` beside PROPERTY Position is named for the caller.
  const bool parameter =
      v->section == Section::Input || v->section == Section::Output || v->section == Section::InOut;
  if (const Symbol *member = memberNamed(owner, v->name.id);
      member != nullptr && member->kind == SymbolKind::Property && member != method->property &&
      !parameter)
    reportHidden(c, v, member, "the property of the same name").help(help);
}

/// Inputs and outputs are named for the caller, so only what the body could mean counts.
static void checkHidden(Context &c, Module &module, const PouSymbol *pou, const VarSymbol *v) {
  const std::string name(v->name.text);
  if (const auto it = module.names.find(v->name.id); it != module.names.end()) {
    const Symbol *symbol = it->second;
    if (symbol->kind == SymbolKind::Variable) {
      const auto *global = static_cast<const VarSymbol *>(symbol);
      if (global->decl != nullptr &&
          c.program.sources.file(global->name.span.file).name().front() == '<')
        return; // a drive of the PLC configuration
      reportHidden(c, v, symbol, "the global variable of the same name")
          .help(global->globals == nullptr ? std::string("give one of them another name")
                                           : "give one of them another name, or write `" +
                                                 std::string(global->globals->name.text) + "." +
                                                 name + "` for the global one");
    } else if (symbol->kind == SymbolKind::Pou && symbol != pou &&
               (static_cast<const PouSymbol *>(symbol)->isFunction() ||
                static_cast<const PouSymbol *>(symbol)->decl->kind == DeclKind::Program)) {
      // Blocks, classes and interfaces are types.
      const bool function = static_cast<const PouSymbol *>(symbol)->isFunction();
      reportHidden(c, v, symbol,
                   function ? "the function of the same name" : "the program of the same name")
          .help("give one of them another name");
    }
    return;
  }
  if (const auto e = module.enumerators.find(v->name.id); e != module.enumerators.end()) {
    const EnumeratorSymbol *enumerator = e->second.front();
    reportHidden(c, v, enumerator, "the enumerator of `" + typeName(enumerator->type) + "`")
        .help("give the variable another name, or write `" + typeName(enumerator->type) + "." +
              name + "` for the enumerator");
    return;
  }
  for (const LibraryIndex::Entry &entry : c.names.index().find(v->name.id->lower)) {
    if (entry.qualifiedOnly || entry.isForeign || !declaresFunction(entry.text, v->name.id->lower))
      continue;
    const std::string library(entry.library);
    reportHidden(c, v, nullptr, "the function of the library `" + library + "`")
        .help("give it another name, or write `" + library + "." + name + "(…)` for the function");
    return;
  }
}

static void reportHiddenLibrary(Context &c, const Symbol *symbol, std::string_view what,
                                const std::string &library) {
  c.report(Code::HidesLibrary, symbol->name.span,
           "the " + std::string(what) + " `" + std::string(symbol->name.text) +
               "` hides the one of the library `" + library + "`",
           "the library has this name too")
      .help("give it another name; the library's is `" + library + "." +
            std::string(symbol->name.text) + "`");
}

void checkHiddenLibrary(Context &c, Module &module) {
  if (!module.library->isUser || !c.program.diagnostics.wants(Code::HidesLibrary))
    return;
  const auto look = [&](const Symbol *symbol, std::string_view what) {
    if (const Found own = c.names.inOwnLibraries({&module}, symbol->name.id);
        own && (own.symbol->kind == SymbolKind::Pou || own.symbol->kind == SymbolKind::Type)) {
      reportHiddenLibrary(c, symbol, what, own.symbol->library->name);
      return;
    }
    for (const LibraryIndex::Entry &entry : c.names.index().find(symbol->name.id->lower)) {
      if (entry.qualifiedOnly || entry.isForeign ||
          !declaresPouOrType(entry.text, symbol->name.id->lower))
        continue;
      reportHiddenLibrary(c, symbol, what, std::string(entry.library));
      return;
    }
  };
  for (const PouSymbol *pou : module.library->pous)
    look(pou, pou->isFunction()                      ? "function"
              : pou->decl->kind == DeclKind::Program ? "program"
                                                     : "function block");
  for (const TypeSymbol *type : module.declaredTypes) {
    if (type->decl != nullptr)
      look(type, "type");
  }
}

} // namespace stc::sema
