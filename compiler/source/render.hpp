#ifndef STRIDE_COMPILER_SOURCE_RENDER_HPP
#define STRIDE_COMPILER_SOURCE_RENDER_HPP
// How diagnostics are shown: text in the manner of rustc, or JSON for tools.

#include "compiler/source/diagnostic.hpp"
#include "compiler/source/sources.hpp"

#include <string>
#include <string_view>

namespace stc {

/// The text with a `?` for each control character (U+0000 to U+001F, U+007F to U+009F) but those in
/// `kept`: names of files and texts of a project must not command the user's terminal.
[[nodiscard]] std::string visible(std::string_view text, std::string_view kept = {});

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
[[nodiscard]] std::string renderText(const Diagnostic &diagnostic, const Sources &sources,
                                     const RenderOptions &options = {});

/// One JSON object on one line: code, name, severity, message, labels (file, line, column, endLine,
/// endColumn, text), notes, helps, suggestions (message, edits: like labels, their text replaces
/// what stands there). The first label is the primary one.
[[nodiscard]] std::string renderJson(const Diagnostic &diagnostic, const Sources &sources);

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_RENDER_HPP
