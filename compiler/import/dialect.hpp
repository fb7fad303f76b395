#ifndef STRIDE_COMPILER_IMPORT_DIALECT_HPP
#define STRIDE_COMPILER_IMPORT_DIALECT_HPP
// What other compilers read and Stride does not.

#include "compiler/import/model.hpp"

namespace stc::import {

/// Rewrites it in all sources: numbers that end with their point (`10.`).
void settleDialect(Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_DIALECT_HPP
