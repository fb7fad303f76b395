// The call graph of functions: recursion, and functions that only compute a value.

#include "compiler/semantics/lint/internal.hpp"

#include <algorithm>

namespace stc::lint {

using namespace ast;

void reportRecursion(Context &c) {
  if (!c.program.diagnostics.wants(Code::Recursion))
    return;
  enum class State : uint8_t { Fresh, Running, Done };
  std::vector<State> state(c.bodies.size(), State::Fresh);
  struct Frame {
    size_t body;
    size_t next = 0;
  };
  // An explicit stack: call chains of generated code may be long.
  for (size_t start = 0; start < c.bodies.size(); ++start) {
    if (state[start] != State::Fresh)
      continue;
    std::vector<Frame> path{{start}};
    state[start] = State::Running;
    while (!path.empty()) {
      Frame &top = path.back();
      const Body &body = c.bodies[top.body];
      if (top.next == body.calls.size()) {
        state[top.body] = State::Done;
        path.pop_back();
        continue;
      }
      const CallExpr *call = body.calls[top.next++];
      const auto callee = c.bodyOf.find(call->pou->decl);
      if (callee == c.bodyOf.end())
        continue;
      const size_t to = callee->second;
      if (state[to] == State::Fresh) {
        state[to] = State::Running;
        path.push_back({to});
      } else if (state[to] == State::Running && !(to == top.body && body.recursesAlways)) {
        std::string circle;
        const auto first = std::find_if(path.begin(), path.end(),
                                        [&](const Frame &frame) { return frame.body == to; });
        for (auto it = first; it != path.end(); ++it)
          circle += "`" + std::string(c.bodies[it->body].decl->name.text) + "` → ";
        const std::string name = "`" + std::string(c.bodies[to].decl->name.text) + "`";
        auto &d = report(c, Code::Recursion, call->span,
                         to == top.body ? name + " calls itself"
                                        : name + " calls itself through other functions",
                         "this call closes the circle");
        d.label(c.bodies[to].decl->name.span, "the circle begins here");
        d.note(circle + name);
        d.help("each call takes room on the stack of the task: make sure that the depth has a "
               "limit");
      }
    }
  }
}

static bool isPure(Context &c, const PouSymbol *pou) {
  const auto at = c.bodyOf.find(pou->decl);
  if (at == c.bodyOf.end())
    return false;
  const Body &body = c.bodies[at->second];
  if (body.sideEffects || body.decl->external)
    return false;
  const auto [known, fresh] =
      c.purity.emplace(pou->decl, true); // in a circle: until shown otherwise
  if (!fresh)
    return known->second;
  constexpr unsigned kMaxCalls = 256; // functions that call functions, levels deep
  const bool pure = c.purityCalls < kMaxCalls && [&] {
    ++c.purityCalls;
    const bool all = std::all_of(body.calls.begin(), body.calls.end(),
                                 [&c](const CallExpr *call) { return isPure(c, call->pou); });
    --c.purityCalls;
    return all;
  }();
  c.purity[pou->decl] = pure;
  return pure;
}

void reportIgnored(Context &c, const std::vector<const CallExpr *> &ignored) {
  for (const CallExpr *call : ignored) {
    const bool function = call->resolved == Callee::Function && call->pou != nullptr &&
                          call->pou->decl->returnType != nullptr;
    const bool builtin =
        call->resolved == Callee::Builtin && builtinRow(call->builtin).onlyComputes();
    if (!function && !builtin)
      continue;
    const bool gives = std::any_of(call->arguments.begin(), call->arguments.end(),
                                   [](const Argument &a) { return a.output; });
    if (function && (gives || !isPure(c, call->pou)))
      continue;
    const std::string name = text(c, call->callee->span);
    report(c, Code::IgnoredResult, call->span, "the result of `" + name + "` is not used",
           "this call has no other effect")
        .help("assign it: `… := " + text(c, call->span) + ";`, or remove the call");
  }
}

} // namespace stc::lint
