#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_PRINT_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_PRINT_HPP
// Drawn bodies as Structured Text.

#include "compiler/import/networks/network.hpp"
#include "compiler/import/networks/scope.hpp"
#include "compiler/import/networks/translation.hpp"

namespace stc::import::networks {

/// The statements of a body in its order of execution. An operator or function stands inside the
/// expression that uses it; a variable is declared for it where it is used by several statements,
/// where something in between would change it, and where a wire leads back: then the variable holds
/// the value of the last cycle. Edges become instances of R_TRIG and F_TRIG. With EN, statements
/// stand in an IF. `scope` has entered the POU; it keeps the
/// names of what is declared.
[[nodiscard]] Translation translated(Body body, Scope &scope);

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_PRINT_HPP
