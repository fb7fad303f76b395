#ifndef STRIDE_COMPILER_IMPORT_FINISH_HPP
#define STRIDE_COMPILER_IMPORT_FINISH_HPP
// What is done with a model after all files are read.

#include "compiler/import/libraries.hpp"
#include "compiler/import/model.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc::import {

struct FinishSettings {
  bool library = false;      ///< what belongs to an application is left out
  std::string addressing;    ///< the user's answer; empty: as the format has it
  std::string configuration; ///< file that names numbered parameters; empty: none
  OwnLibraries own;          ///< what Stride offers
  std::vector<std::string_view> libraryTexts = {}; ///< its declarations, for bodies that are drawn
};

/// Puts statements in the place of bodies that are drawn, takes objects that are there twice once,
/// renames what has a reserved name, moves addresses that only the other tool understands, looks up
/// libraries. What is wrong with the configuration file, or an empty text.
[[nodiscard]] std::string finish(Model &model, const FinishSettings &settings);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_FINISH_HPP
