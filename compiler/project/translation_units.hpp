#ifndef STRIDE_COMPILER_PROJECT_TRANSLATION_UNITS_HPP
#define STRIDE_COMPILER_PROJECT_TRANSLATION_UNITS_HPP
// Which generated sources are compiled together.

#include "compiler/codegen/codegen.hpp"

#include <string>
#include <vector>

namespace stc {

/// What one call of the C++ compiler compiles.
struct TranslationUnit {
  std::string path;       ///< of its source
  std::string title;      ///< for progress
  bool runsOnce = false;  ///< as all of its sources do
  bool isNumeric = false; ///< as one of its sources is
};

/// Divides the sources among `files` into translation units, since a call of the compiler costs as
/// much as several small POUs do. A source for each unit of more than one of them is added to the
/// files.
///
/// A small project is one unit. In others a source goes where the hash of its path says, to the
/// half of the sources with its next bit, until what goes there is little enough: so a source that
/// is added, removed or grows moves others only within its unit, and units do not depend on the
/// order of the files. Sources that run once in a cycle are apart from others. What is large is a
/// unit of its own, and so are app.cpp and build.cpp, which change when others do not.
[[nodiscard]] std::vector<TranslationUnit> divideIntoUnits(std::vector<GeneratedFile> &files);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_TRANSLATION_UNITS_HPP
