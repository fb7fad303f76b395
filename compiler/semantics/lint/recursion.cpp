// The call graph of functions: recursion, and functions that only compute a value.

#include "compiler/semantics/lint/lint.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

void Linter::reportRecursion() {
  if (!program_.diagnostics.wants(Code::Recursion))
    return;
  enum class State : uint8_t { Fresh, Running, Done };
  std::vector<State> state(bodies_.size(), State::Fresh);
  struct Frame {
    size_t body;
    size_t next = 0;
  };
  // An explicit stack: call chains of generated code may be long.
  for (size_t start = 0; start < bodies_.size(); ++start) {
    if (state[start] != State::Fresh)
      continue;
    std::vector<Frame> path{{start}};
    state[start] = State::Running;
    while (!path.empty()) {
      Frame &top = path.back();
      const Body &body = bodies_[top.body];
      if (top.next == body.calls.size()) {
        state[top.body] = State::Done;
        path.pop_back();
        continue;
      }
      const CallExpr *call = body.calls[top.next++];
      const auto callee = bodyOf_.find(call->pou->decl);
      if (callee == bodyOf_.end())
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
          circle += "`" + std::string(bodies_[it->body].decl->name.text) + "` → ";
        const std::string name = "`" + std::string(bodies_[to].decl->name.text) + "`";
        auto &d = report(Code::Recursion, call->span,
                         to == top.body ? name + " calls itself"
                                        : name + " calls itself through other functions",
                         "this call closes the circle");
        d.label(bodies_[to].decl->name.span, "the circle begins here");
        d.note(circle + name);
        d.help("each call takes room on the stack of the task: make sure that the depth has a "
               "limit");
      }
    }
  }
}

bool Linter::isPure(const PouSymbol *pou) {
  const auto at = bodyOf_.find(pou->decl);
  if (at == bodyOf_.end())
    return false;
  const Body &body = bodies_[at->second];
  if (body.sideEffects || body.decl->external)
    return false;
  const auto [known, fresh] =
      purity_.emplace(pou->decl, true); // in a circle: until shown otherwise
  if (!fresh)
    return known->second;
  constexpr unsigned kMaxCalls = 256; // functions that call functions, levels deep
  const bool pure = purityCalls_ < kMaxCalls && [&] {
    ++purityCalls_;
    const bool all = std::all_of(body.calls.begin(), body.calls.end(),
                                 [this](const CallExpr *call) { return isPure(call->pou); });
    --purityCalls_;
    return all;
  }();
  purity_[pou->decl] = pure;
  return pure;
}

void Linter::reportIgnored() {
  for (const CallExpr *call : ignored_) {
    const bool function = call->resolved == Callee::Function && call->pou != nullptr &&
                          call->pou->decl->returnType != nullptr;
    const bool builtin =
        call->resolved == Callee::Builtin && builtinRow(call->builtin).onlyComputes();
    if (!function && !builtin)
      continue;
    const bool gives = std::any_of(call->arguments.begin(), call->arguments.end(),
                                   [](const Argument &a) { return a.output; });
    if (function && (gives || !isPure(call->pou)))
      continue;
    const std::string name = text(call->callee->span);
    report(Code::IgnoredResult, call->span, "the result of `" + name + "` is not used",
           "this call has no other effect")
        .help("assign it: `… := " + text(call->span) + ";`, or remove the call");
  }
}

} // namespace stc
