// Walks all bodies once, by several threads, and reports what they have found.

#include "compiler/semantics/lint/internal.hpp"
#include "compiler/source/workers.hpp"

#include <deque>
#include <utility>

namespace stc::lint {

using namespace ast;

namespace {

/// The bodies of one POU, which one thread walks one after the other.
struct Item {
  size_t first = 0;
  size_t count = 0;
  Findings found;
};

/// Lists all bodies in the order of the text.
class Items {
public:
  Items(Context &context, const Library &library) : c_(context) {
    for (PouSymbol *pou : library.pous) {
      const size_t first = c_.bodies.size();
      add(pou);
      if (c_.bodies.size() > first)
        items_.push_back({first, c_.bodies.size() - first, {}});
    }
  }
  [[nodiscard]] std::vector<Item> take() { return std::move(items_); }

private:
  void add(PouSymbol *pou) {
    PouDecl *decl = pou->decl;
    add(decl, pou);
    for (PouDecl *method : decl->methods)
      add(method, pou);
    for (PouDecl *action : decl->actions)
      add(action, pou);
    for (PropertyDecl *property : decl->properties) {
      if (property->get != nullptr)
        add(property->get, pou);
      if (property->set != nullptr)
        add(property->set, pou);
    }
  }
  void add(PouDecl *decl, PouSymbol *pou) {
    if (!c_.bodyOf.emplace(decl, c_.bodies.size()).second)
      return;
    Body &body = c_.bodies.emplace_back();
    body.decl = decl;
    body.owner = pou->decl;
    body.pou = pou;
  }

  Context &c_;
  std::vector<Item> items_;
};

/// What another thread has found to be used.
void merge(Context &c, Context &other) {
  c.resultsWritten.merge(other.resultsWritten);
  c.usedPous.merge(other.usedPous);
  c.resultsTaken.merge(other.resultsTaken);
  c.usedTypes.merge(other.usedTypes);
  for (const auto &[decl, count] : other.functionCalls) {
    CallCount &sum = c.functionCalls[decl];
    sum.all += count.all;
    sum.asStatement += count.asStatement;
  }
}

void walkAll(Context &c, std::vector<Item> &items) {
  const unsigned threads =
      Workers(c.program.settings.jobs).threadsFor(items.size(), textBytes(c.program));
  std::deque<Context> others;
  for (unsigned i = 1; i < threads; ++i)
    others.emplace_back(c.program, c.bodies);
  Workers::each(items.size(), threads, [&](size_t i, unsigned thread) {
    Context &own = thread == 0 ? c : others[thread - 1];
    own.found = &items[i].found;
    for (size_t at = 0; at < items[i].count; ++at)
      walk(own, items[i].first + at);
    own.found = nullptr;
  });
  for (Context &other : others)
    merge(c, other);
}

/// VAR_CONFIG and VAR_ACCESS reach what nothing else may name.
void usePath(Context &c, const StatePath &path, const VarSymbol *end) {
  const auto mark = [&c](const VarSymbol *v) { c.usedOutside.insert(v); };
  if (path.root != nullptr && path.root->kind == SymbolKind::Variable)
    mark(static_cast<const VarSymbol *>(path.root));
  for (const PathStep &step : path.steps) {
    if (step.member != nullptr)
      mark(step.member);
  }
  if (end != nullptr)
    mark(end);
}

/// Nothing in the variables' own POU changes them meanwhile; others might, by their addresses.
void reportConditions(Context &c, const std::vector<StillCondition> &conditions) {
  for (const StillCondition &one : conditions) {
    const bool reachable =
        std::any_of(one.variables.begin(), one.variables.end(),
                    [](const VarSymbol *v) { return (v->usesElsewhere & kUseAddress) != 0; });
    if (!reachable)
      report(c, Code::EndlessLoop, one.condition->span, "once begun, this loop never ends",
             "nothing in the loop changes " + one.names)
          .label(one.loop, "this loop")
          .help("change " + one.names + " in the loop, or leave it with EXIT");
  }
}

void reportInOuts(Context &c, const std::vector<EarlyInOut> &inOuts) {
  for (const EarlyInOut &one : inOuts) {
    if ((one.instance->usesElsewhere & (kUseCalled | kUseAddress)) != 0)
      continue;
    const std::string instance(one.instance->name.text);
    report(c, Code::InOutBeforeCall, one.member->span,
           "`" + std::string(one.member->name.text) + "` of `" + instance +
               "` is used before the first call of the block",
           "refers to nothing yet")
        .label(one.variable->name.span, "a VAR_IN_OUT gets its variable at the call")
        .help("call `" + instance + "(…)` first, or use the variable that is passed to it");
  }
}

/// What is said of initial values of global variables, which are in no body.
Findings lookAtGlobals(Context &c, const Library &library) {
  Findings found;
  c.found = &found;
  c.current = c.bodies.size();
  c.bodies.emplace_back();
  for (const GlobalsSymbol *globals : library.globals) {
    for (VarSymbol *v : globals->variables) {
      if (v->decl != nullptr) {
        typeExpr(c, v->decl->type);
        initial(c, v->decl->init);
      }
      markUsed(c, v->type);
    }
  }
  c.bodies.pop_back();
  c.found = nullptr;
  return found;
}

void lookAtConfiguration(Context &c) {
  for (const SlotPlace &slot : c.program.slotPlaces)
    usePath(c, slot.path, slot.variable);
  for (const AccessPath &access : c.program.accessPaths)
    usePath(c, access.path, nullptr);
}

} // namespace

void run(Program &program, Library &library) {
  std::vector<Body> bodies;
  Context c(program, bodies);
  std::vector<Item> items = Items(c, library).take();
  walkAll(c, items);
  items.push_back({0, 0, lookAtGlobals(c, library)});
  lookAtConfiguration(c);
  for (Item &item : items) {
    if (item.found.reports)
      program.diagnostics.add(std::move(*item.found.reports));
    reportConditions(c, item.found.conditions);
    reportInOuts(c, item.found.inOuts);
  }
  for (const Body &body : c.bodies) {
    reportVariables(c, body);
    reportResults(c, body);
  }
  reportRecursion(c);
  for (const Item &item : items)
    reportIgnored(c, item.found.ignored);
  if (library.isUser && program.diagnostics.wants(Code::UnservedAxis))
    reportAxes(c, library);
  if (program.diagnostics.wants(Code::UnusedPou))
    reportUnusedPous(c, library);
}

} // namespace stc::lint
