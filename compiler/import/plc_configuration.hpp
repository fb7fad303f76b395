#ifndef STRIDE_COMPILER_IMPORT_PLC_CONFIGURATION_HPP
#define STRIDE_COMPILER_IMPORT_PLC_CONFIGURATION_HPP
// PLC_CONFIGURATION of a CoDeSys V2.3 export: modules with channels and parameters.

#include "compiler/import/model.hpp"

#include <string>
#include <vector>

namespace stc::import {

/// Adds the channels, and the drives with their bus and axis group, which are known by the names of
/// their sections (or of themselves) and by how they are nested. `origin`: of the first line.
/// Parameters have numbers there; what they mean, only the target's configuration file says.
void readPlcConfiguration(const std::vector<std::string> &lines, const Origin &origin,
                          Model &model);

/// Gives numbered parameters their names: from the text of the target's configuration file, in
/// which a line or section names a number and a parameter of stride.toml. All such values, and the
/// addresses of drives by their order, are marked as guessed; what is missing as missing.
/// `configuration`: empty: there is none.
void nameParameters(Model &model, const std::string &configuration);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_PLC_CONFIGURATION_HPP
