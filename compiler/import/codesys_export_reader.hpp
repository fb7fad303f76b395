#ifndef STRIDE_COMPILER_IMPORT_CODESYS_EXPORT_READER_HPP
#define STRIDE_COMPILER_IMPORT_CODESYS_EXPORT_READER_HPP
// Exports of CODESYS V3, `.export`: XML, a dump of the project's objects.

#include "compiler/import/model.hpp"

#include <string>
#include <string_view>

namespace stc::import {

/// Whether the text is such an export.
[[nodiscard]] bool isCodesysExport(std::string_view text);

/// Adds the objects of the export. Methods, properties, actions and accessors find their POU by its
/// GUID; folders become folders. What is not written in text becomes a remark.
void readCodesysExport(const std::string &file, std::string_view text, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_CODESYS_EXPORT_READER_HPP
