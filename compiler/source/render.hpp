#pragma once
// How diagnostics are shown: text in the manner of rustc, or JSON for tools.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/source_manager.hpp"

#include <string>

namespace stc {

struct RenderOptions {
  bool color = false; ///< ANSI colours
};

/// The diagnostic with its source lines, spans underlined, notes and helps; ends with an empty
/// line.
///
///     error[SE0203]: cannot find variable `Foo`
///      --> Main.st:4:3
///       |
///     4 |   Foo := 1;
///       |   ^^^ not found in this scope
///       |
///       = help: a variable with a similar name exists: `Fob`
///
[[nodiscard]] std::string renderText(const Diagnostic &diagnostic, const SourceManager &sources,
                                     const RenderOptions &options = {});

/// One JSON object on one line: code, name, severity, message, labels (file, line, column, endLine,
/// endColumn, text), notes, helps, suggestions (message, edits: like labels, their text replaces
/// what stands there). The first label is the primary one.
[[nodiscard]] std::string renderJson(const Diagnostic &diagnostic, const SourceManager &sources);

} // namespace stc
