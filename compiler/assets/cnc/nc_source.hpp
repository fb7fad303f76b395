#ifndef STRIDE_COMPILER_ASSETS_CNC_NC_SOURCE_HPP
#define STRIDE_COMPILER_ASSETS_CNC_NC_SOURCE_HPP
// CNC programs in SoftMotion 3's language: what they are without their expressions, loops and
// subprograms.

#include "compiler/assets/cnc/values.hpp"

#include <functional>

namespace stc {

/// Whether a text needs SoftMotion 3's language: it has expressions in braces, local variables,
/// texts or labels.
[[nodiscard]] bool needsNcLanguage(std::string_view text);

/// The file of a subprogram, by its name in lower case; null: there is none.
using NcLookup = std::function<const SourceFile *(const std::string &name)>;

/// Carries the program out, with the values of its variables, else 0, and returns its sentences as
/// they have been carried out, with numbers. What is wrong is reported; with errors nothing is
/// returned. A file that is a subprogram is only read: it has no sentences then.
[[nodiscard]] std::optional<CncProgram> expandNc(const SourceFile &file, const NcLookup &lookup,
                                                 CncValues &values, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_ASSETS_CNC_NC_SOURCE_HPP
