#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_ORDER_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_ORDER_HPP
// In which order the nodes of a drawn body are executed.

#include "compiler/import/networks/network.hpp"
#include "compiler/import/networks/translation.hpp"

#include <vector>

namespace stc::import::networks {

/// Joins connectors with their continuations: afterwards no wire begins at a Link. A continuation
/// without its connector and links in a circle are problems.
void resolveLinks(Body &body, std::vector<Problem> &problems);

/// The nodes of each network that do or compute something, in the order of execution, with comments
/// in front of what they stand next to. What has no explicit order comes directly before the first
/// that reads it. A node that stands after one of its readers gives that reader the value of the
/// last cycle.
[[nodiscard]] std::vector<std::vector<NodeIndex>> scheduleOf(const Body &body);

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_ORDER_HPP
