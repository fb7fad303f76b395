#ifndef STRIDE_COMPILER_PROJECT_LIBRARY_VALUES_HPP
#define STRIDE_COMPILER_PROJECT_LIBRARY_VALUES_HPP
// `parameters` of [[library]] as expressions of ST.

#include "compiler/project/library_config.hpp"
#include "compiler/semantics/program.hpp"

#include <string>

namespace stc {

/// Adds the values to Program::parameters; `library`: Library::name.
void takeLibraryValues(Program &program, const LibraryUse &use, const std::string &library);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_LIBRARY_VALUES_HPP
