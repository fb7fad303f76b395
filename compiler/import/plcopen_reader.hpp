#ifndef STRIDE_COMPILER_IMPORT_PLCOPEN_READER_HPP
#define STRIDE_COMPILER_IMPORT_PLCOPEN_READER_HPP
// PLCopen XML (TC6 1.0 and 2.01) with what CODESYS and TwinCAT add to it.

#include "compiler/import/model.hpp"

#include <string>
#include <string_view>

namespace stc::import {

/// Whether the text begins like a PLCopen XML file: an element of one of its namespaces.
[[nodiscard]] bool isPlcOpen(std::string_view text);

/// Adds the POUs, types, global variables and tasks of a file to `model`. `text` is UTF-8. The file
/// is not validated: what is not known is reported with its line. A file that is no PLCopen XML is
/// left out as a whole.
void readPlcOpen(const std::string &file, std::string_view text, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_PLCOPEN_READER_HPP
