#ifndef STRIDE_COMPILER_SEMANTICS_REPORTER_HPP
#define STRIDE_COMPILER_SEMANTICS_REPORTER_HPP
// Diagnostics of one check, up to a limit.

#include "compiler/source/diagnostic.hpp"

#include <string>

namespace stc {

/// Reports to a program's diagnostics. Of very many errors the last ones are dropped: nobody reads
/// them, and a file that is no ST has one per word.
class Reporter {
public:
  explicit Reporter(Diagnostics &diagnostics);

  /// The diagnostic may be given labels and help; it lives until the next one.
  Diagnostic &report(Code code, Span where, std::string message, std::string label = {});
  /// What is reported is kept. Who has to work for a message asks first.
  [[nodiscard]] bool keepsErrors() const { return diagnostics_.errorCount() < limit_; }

private:
  Diagnostics &diagnostics_;
  size_t limit_;
  Diagnostic notKept_; ///< takes the others
};

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_REPORTER_HPP
