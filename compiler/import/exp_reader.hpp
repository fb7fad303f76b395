#ifndef STRIDE_COMPILER_IMPORT_EXP_READER_HPP
#define STRIDE_COMPILER_IMPORT_EXP_READER_HPP
// Exports of CoDeSys V2.3, `.EXP`: text, one object or a whole project.

#include "compiler/import/model.hpp"

#include <string>
#include <string_view>

namespace stc::import {

/// Adds the objects of an export to `model`. `text` is UTF-8; LF and CR LF end lines alike. What is
/// not imported becomes a remark; a section without its end is left out as a whole.
void readExp(const std::string &file, std::string_view text, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_EXP_READER_HPP
