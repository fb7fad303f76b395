#ifndef STRIDE_COMPILER_IMPORT_TWINCAT_READER_HPP
#define STRIDE_COMPILER_IMPORT_TWINCAT_READER_HPP
// Files of TwinCAT 3: objects of a PLC project (.TcPOU .TcDUT .TcGVL .TcIO .TcTTO), the project
// itself (.plcproj), and the parts of a system project that hold axes (.tsproj .xti).

#include "compiler/import/model.hpp"

#include <string>
#include <string_view>

namespace stc::import {

/// Whether the text is one of these files.
[[nodiscard]] bool isTwinCat(std::string_view text);

/// Adds what the file holds. A .plcproj and a .tsproj name further files in Model::references. What
/// is not imported becomes a remark: bodies in graphical languages keep their declaration.
void readTwinCat(const std::string &file, std::string_view text, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_TWINCAT_READER_HPP
