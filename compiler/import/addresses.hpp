#ifndef STRIDE_COMPILER_IMPORT_ADDRESSES_HPP
#define STRIDE_COMPILER_IMPORT_ADDRESSES_HPP
// Addresses of inputs and outputs.

#include "compiler/import/model.hpp"

namespace stc::import {

/// Where the hardware's addresses name modules and channels (`%IW0.4.2`, `%IR3.1`) instead of
/// bytes, gives its channels plain addresses in their order, aligned by their size, and rewrites
/// the sources. Model::addresses has the old and the new ones. An address of which the hardware has
/// no channel is a loss.
void moveAddresses(Model &model);

/// Model::addressing: what the user says, or what the format has; nothing when no source has an
/// address.
void settleAddressing(Model &model, const std::string &wanted);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_ADDRESSES_HPP
