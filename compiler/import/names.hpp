#ifndef STRIDE_COMPILER_IMPORT_NAMES_HPP
#define STRIDE_COMPILER_IMPORT_NAMES_HPP
// Names of imported objects and variables.

#include "compiler/import/model.hpp"

namespace stc::import {

/// Whether the object is a PROGRAM.
[[nodiscard]] bool isProgram(const Object &object);

/// Of objects, tasks and libraries of the same name, whatever the case of its letters, only the
/// first stays. Another one that says the same is a remark, one that differs is a loss.
void takeOnce(Model &model);

/// Gives what is declared with a word that is reserved here another name, in all sources and tasks.
void renameReserved(Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_NAMES_HPP
