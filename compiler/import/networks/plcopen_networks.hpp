#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_PLCOPEN_NETWORKS_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_PLCOPEN_NETWORKS_HPP
// Drawn bodies in PLCopen XML (TC6) and in CODESYS's dialect of it.

#include "compiler/import/networks/network.hpp"
#include "compiler/import/networks/translation.hpp"

#include <functional>
#include <pugixml.hpp>
#include <vector>

namespace stc::import::networks {

/// Line of a node in the file.
using LineOf = std::function<size_t(const pugi::xml_node &)>;

/// The drawing in a `body` (or `<action>`'s, `<transition>`'s body): `FBD`, `LD`, or `CFC`, also in
/// addData beside an empty `ST`. Empty: none.
[[nodiscard]] pugi::xml_node drawingIn(const pugi::xml_node &body);

/// Reads it; translated() makes Structured Text of it. Order: `executionOrderId` where there is
/// one, networks and outputs as in the file where CODESYS marks networks, else outputs from the top
/// to the bottom and from the left to the right. Elements that are not known are problems.
[[nodiscard]] Body readPlcOpenBody(const pugi::xml_node &body, const LineOf &lineOf,
                                   std::vector<Problem> &problems);

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_PLCOPEN_NETWORKS_HPP
