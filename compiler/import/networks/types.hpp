#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_TYPES_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_TYPES_HPP
// Types of what flows through wires, as far as they must be known to declare variables for it.

#include "compiler/import/networks/network.hpp"
#include "compiler/import/networks/scope.hpp"

#include <string>

namespace stc::import::networks {

/// Type of an expression of the file; empty: not known.
[[nodiscard]] std::string typeOfText(std::string_view text, const Scope &scope);
/// Type of a node's output; empty: not known. Circles are followed once. Of literals alone there is
/// none unless `guess`: DINT or REAL.
[[nodiscard]] std::string typeOfOutput(const Body &body, Wire from, const Scope &scope, bool guess);

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_TYPES_HPP
