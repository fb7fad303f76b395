#include "compiler/semantics/context/context.hpp"

#include "compiler/semantics/builtins.hpp"
#include "compiler/source/stack.hpp"

namespace stc::sema {

namespace {

/// How many are shown is up to the command; this only bounds what is kept.
constexpr std::size_t kMaxErrors = 1000;

} // namespace

Context::Context(Program &checked, const LibraryIndex &libraries)
    : program(checked), arena(checked.arena), index(libraries), types(checked.arena),
      stackEnd(endOfStack()), errorLimit(checked.diagnostics.errorCount() + kMaxErrors) {
  for (const auto &[name, function] : stc::builtins()) {
    const Ident id = program.interner.intern(name);
    auto *symbol = arena.make<BuiltinSymbol>();
    symbol->kind = SymbolKind::builtin;
    symbol->name = {id, id->lower, {}};
    symbol->id = function;
    builtins.emplace(id, symbol);
  }
}

Diagnostic &Context::report(Code code, Span where, std::string message, std::string label) {
  if (!keepsErrors()) {
    notKept = {};
    return notKept;
  }
  return program.diagnostics.report(code, where, std::move(message), std::move(label));
}

bool isTooDeep(Context &c, const ast::Name &name) {
  if (!stackIsShort(c.stackEnd))
    return false;
  c.report(Code::tooDeep, name.span,
           "`" + std::string(name.text) + "` depends on too many other declarations",
           "one leads to the next");
  return true;
}

} // namespace stc::sema
