#ifndef STRIDE_COMPILER_IMPORT_LIBRARIES_HPP
#define STRIDE_COMPILER_IMPORT_LIBRARIES_HPP
// Libraries that imported projects refer to.

#include "compiler/import/model.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace stc::import {

/// What the standard library offers.
struct OwnLibraries {
  std::function<bool(std::string_view lowerName)> declares;  ///< a POU, type, variable
  std::function<bool(std::string_view lowerName)> isLibrary; ///< by its name
};

/// `Standard, 3.5.18.0 (System)` or `Tc2_MC2,*,Beckhoff`: name, version and vendor.
[[nodiscard]] LibraryReference libraryNamed(std::string_view text, Origin origin);

/// Says of each library what becomes of it: what the project uses of it and Stride has not is a
/// loss.
void lookUpLibraries(Model &model, const OwnLibraries &own);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_LIBRARIES_HPP
