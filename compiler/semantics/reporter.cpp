#include "compiler/semantics/reporter.hpp"

#include <utility>

namespace stc {

namespace {

/// How many are shown is up to the command; this only bounds what is kept.
constexpr size_t kMaxErrors = 1000;

} // namespace

Reporter::Reporter(Diagnostics &diagnostics)
    : diagnostics_(diagnostics), limit_(diagnostics.errorCount() + kMaxErrors) {}

Diagnostic &Reporter::report(Code code, Span where, std::string message, std::string label) {
  if (!keepsErrors()) {
    notKept_ = {};
    return notKept_;
  }
  return diagnostics_.report(code, where, std::move(message), std::move(label));
}

} // namespace stc
