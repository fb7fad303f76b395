// Sources: one per POU, one for the initial values of structures and variable lists.

#include "compiler/codegen/analysis/numeric_loops.hpp"
#include "compiler/codegen/cpp/inlining.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/source/workers.hpp"

#include <algorithm>
#include <deque>
#include <iterator>

namespace stc::codegen {

using namespace ast;

namespace {

constexpr std::string_view kLifecycle[] = {"fb_exit", "fb_reinit"};

void statics(Context &context, GeneratedSource &source, const PouSymbol *pou) {
  if (!hasStatics(pou))
    return;
  const Root root{pou, true};
  const std::string name = rootLocalType(context.names, root);
  for (const std::string_view what : kLifecycle) {
    if (rootHasLifecycle(context, root, what))
      source.lifecycle(name, rootVariables(root), what, nullptr, nullptr);
  }
  if (rootNeedsInit(context, root))
    source.init(name, rootVariables(root));
}

// -------------------------------------------------------------------------------------------------
// types and variable lists

/// A structure of this library that has functions of its own; null for other types.
const StructType *ownStructure(const TypeSymbol *t) {
  return t->type->kind == TypeKind::Structure && t->decl != nullptr &&
                 t->decl->kind == DeclKind::Structure
             ? typeAs<StructType>(t->type)
             : nullptr;
}

void structures(Context &context, GeneratedSource &file) {
  for (const TypeSymbol *t : context.own->types) {
    const StructType *type = ownStructure(t);
    if (type == nullptr || t->onDemand)
      continue;
    file.include(t);
    if (context.layouts.hasBindings(type))
      file.assignment(context.names.local(t), {type->fields.begin(), type->fields.end()},
                      type->base);
    if (context.layouts.needsInit(type))
      file.init(context.names.local(t), initialisedFields(type), type->base);
  }
}

/// What happens at the end of the life of structures and variable lists, or after an online change.
void lifecycles(Context &context, GeneratedSource &file, std::string_view what) {
  for (const TypeSymbol *t : context.own->types) {
    const StructType *type = ownStructure(t);
    if (type == nullptr || !context.layouts.hasLifecycle(type, what))
      continue;
    file.include(t);
    file.lifecycle(context.names.local(t), {type->fields.begin(), type->fields.end()}, what,
                   type->base, nullptr);
  }
  for (const GlobalsSymbol *g : context.own->globals) {
    if (!rootHasLifecycle(context, {g, false}, what))
      continue;
    file.include(g);
    file.lifecycle(context.names.local(g), rootVariables({g, false}), what, nullptr, nullptr);
  }
}

void typesAndLists(Context &context, const std::string &folder, std::vector<GeneratedFile> &files) {
  GeneratedSource file(context, nullptr, folder + "init__.cpp");
  structures(context, file);
  for (const std::string_view what : kLifecycle)
    lifecycles(context, file, what);
  for (const GlobalsSymbol *g : context.own->globals) {
    if (!rootNeedsInit(context, {g, false}))
      continue;
    file.include(g);
    file.init(context.names.local(g), rootVariables({g, false}));
  }
  if (context.own->isUser && hasConfiguredValues(context.program))
    file.configured();
  if (!file.empty())
    files.push_back(file.finish(nullptr, "Initial values"));
}

// -------------------------------------------------------------------------------------------------
// POUs

/// Its initial values, its assignment, and what is done to its instances at the end of their lives.
void instanceFunctions(Context &context, GeneratedSource &source, const PouSymbol *p) {
  const std::string_view name = context.names.local(p);
  const Type *base = p->base == nullptr ? nullptr : p->base->type;
  const std::vector<const VarSymbol *> variables = rootVariables({p, false});
  if (context.layouts.needsInit(p->type))
    source.init(name, variables, base, p);
  if (p->type->kind == TypeKind::FunctionBlock && context.layouts.hasBindings(p->type))
    source.assignment(name, variables, base);
  for (const std::string_view what : kLifecycle) {
    if (context.layouts.hasLifecycle(p->type, what))
      source.lifecycle(name, variables, what, nullptr, p);
  }
}

bool hasBody(const PouSymbol *method) { return !method->isAbstract() && !method->decl->external; }

/// Something of the POU is made in C++ here.
bool isWritten(const PouSymbol *p, const GeneratedSource &source) {
  return !source.empty() || !p->decl->external || hasStatics(p) ||
         std::any_of(p->methods.begin(), p->methods.end(),
                     [](const PouSymbol *m) { return hasStatics(m) || hasBody(m); });
}

bool runsOnce(Context &context, const PouSymbol *p) {
  return context.repetition.runsOnce(p) &&
         std::all_of(p->methods.begin(), p->methods.end(),
                     [&](const PouSymbol *m) { return context.repetition.runsOnce(m); });
}

bool isNumeric(const PouSymbol *p) {
  const auto has = [](const PouSymbol *one) {
    return !one->decl->external && one->checked && hasNumericLoop(one->decl->body);
  };
  return has(p) || std::any_of(p->methods.begin(), p->methods.end(), has);
}

void pou(Context &context, const PouSymbol *p, std::vector<GeneratedFile> &files) {
  GeneratedSource source(context, p, context.names.source(p));
  if (!p->isFunction())
    instanceFunctions(context, source, p);
  statics(context, source, p);
  for (const PouSymbol *m : p->methods)
    statics(context, source, m);
  if (!isWritten(p, source))
    return;
  if (!p->decl->external) {
    if (p->isFunction())
      source.functionBody(p);
    else if (p->decl->kind != DeclKind::Class)
      source.blockBody(p, context.names.local(p));
  }
  if (isInlinable(p))
    files.push_back(source.inlined(p));
  for (const PouSymbol *m : p->methods) {
    if (hasBody(m))
      source.functionBody(m);
  }
  files.push_back(source.finish(p, p->name.text));
  files.back().runsOnce = runsOnce(context, p);
  files.back().isNumeric = isNumeric(p);
}

} // namespace

bool hasConfiguredValues(const Program &program) {
  return std::any_of(
      program.slotPlaces.begin(), program.slotPlaces.end(),
      [](const SlotPlace &entry) { return entry.decl != nullptr && entry.decl->init != nullptr; });
}

/// Gives all names in one order, and does once what keeps its result for all threads.
static void prepare(Context &context, const std::vector<const Symbol *> &headers) {
  for (const Symbol *symbol : headers)
    static_cast<void>(context.names.header(symbol));
  for (const auto &library : context.program.libraries) {
    for (const TypeSymbol *t : library->types) {
      static_cast<void>(context.names.header(t));
      static_cast<void>(alignmentOf(t->type));
    }
    for (const GlobalsSymbol *g : library->globals)
      static_cast<void>(context.names.header(g));
    for (const PouSymbol *p : library->pous)
      static_cast<void>(context.names.header(p));
  }
}

namespace {

/// A context for each of several threads.
class Contexts {
public:
  /// The first thread has `whole` itself, if it may.
  Contexts(Context &whole, unsigned threads, bool mayUseWhole)
      : first_(mayUseWhole ? &whole : nullptr) {
    for (unsigned i = mayUseWhole ? 1 : 0; i < threads; ++i)
      copies_.emplace_back(whole);
  }
  Context &of(unsigned thread) {
    if (first_ == nullptr)
      return copies_[thread];
    return thread == 0 ? *first_ : copies_[thread - 1];
  }

private:
  Context *first_;
  std::deque<Context> copies_;
};

using Files = std::vector<GeneratedFile>;

void moveTo(Files &files, std::vector<Files> &parts) {
  for (Files &part : parts)
    std::move(part.begin(), part.end(), std::back_inserter(files));
}

} // namespace

/// Sources of POUs, and the one before them.
static void generateSources(Context &context, const std::vector<const PouSymbol *> &pous,
                            unsigned threads, Files &files) {
  Contexts contexts(context, threads, true);
  std::vector<Files> parts(pous.size() + 1);
  Workers::each(parts.size(), threads, [&](size_t i, unsigned thread) {
    Context &own = contexts.of(thread);
    if (i == 0)
      typesAndLists(own, std::string(own.names.space(own.own)) + "/", parts[i]);
    else
      pou(own, pous[i - 1], parts[i]);
  });
  moveTo(files, parts);
}

void generateUnits(Context &context, const std::vector<Generator> &others, Files &files) {
  const std::vector<const Symbol *> headers = headersOf(context);
  prepare(context, headers);
  std::vector<const PouSymbol *> pous;
  std::copy_if(context.own->pous.begin(), context.own->pous.end(), std::back_inserter(pous),
               [](const PouSymbol *p) { return !p->isInterface(); });
  const unsigned threads =
      Workers(context.program.settings.jobs).threadsFor(pous.size(), textBytes(context.program));
  // What takes long comes first. All but headers is one part; what the sources need to know of the
  // whole program goes to `context` itself, which nobody else uses meanwhile.
  std::vector<Generator> parts = others;
  parts.emplace_back([&context](Context &, Files &) { context.addressed.prepare(); });
  parts.emplace_back([&context](Context &, Files &) { context.repetition.prepare(); });
  parts.emplace_back([&context](Context &, Files &) { context.pointers.prepare(); });
  std::vector<Files> made(parts.size());
  std::vector<GeneratedFile> heads(headers.size());
  {
    Contexts contexts(context, threads, threads == 1);
    Workers::each(parts.size() + headers.size(), threads, [&](size_t i, unsigned thread) {
      if (i < parts.size())
        parts[i](contexts.of(thread), made[i]);
      else
        heads[i - parts.size()] = generateHeader(contexts.of(thread), headers[i - parts.size()]);
    });
  }
  std::move(heads.begin(), heads.end(), std::back_inserter(files));
  generateSources(context, pous, threads, files);
  moveTo(files, made);
}

} // namespace stc::codegen
