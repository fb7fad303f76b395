// The libraries are what users read first: nothing in them is worth a warning.
#include "compiler/project/library_index.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/source/render.hpp"

#include <gtest/gtest.h>

namespace stc {
namespace {

TEST(LibraryLint, LibrariesHaveNoWarnings) {
  const EmbeddedLibraryIndex index(standardLibrary());
  for (const std::string_view library : index.libraries()) {
    Program program;
    Levels levels;
    levels.set(Levels::Group::Lints, Severity::Warning);
    levels.set(Code::UnusedPou, Severity::Off); // a library's blocks are there for others
    levels.set(Code::BoolCompared, Severity::Off);
    program.diagnostics.setLevels(levels);
    checkLibrary(program, library, index);
    for (const Diagnostic &diagnostic : program.diagnostics.all())
      ADD_FAILURE() << renderText(diagnostic, program.sources);
  }
}

} // namespace
} // namespace stc
