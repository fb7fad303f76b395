#ifndef STRIDE_COMPILER_IMPORT_TWINCAT_PROJECT_HPP
#define STRIDE_COMPILER_IMPORT_TWINCAT_PROJECT_HPP
// Projects of TwinCAT 3. Internal to compiler/import.

#include "compiler/import/model.hpp"
#include "compiler/import/xml_document.hpp"

#include <string>

namespace stc::import {

/// `<Project>` of a .plcproj: files that belong to it and libraries that it uses.
void readPlcProject(const std::string &file, const XmlDocument &document, Model &model);
/// `<TcSmProject>` and `<TcSmItem>`: axes of the NC, and which variables of the PLC they are.
void readSystemProject(const std::string &file, const XmlDocument &document, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_TWINCAT_PROJECT_HPP
