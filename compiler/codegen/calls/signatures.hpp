#ifndef STRIDE_COMPILER_CODEGEN_CALLS_SIGNATURES_HPP
#define STRIDE_COMPILER_CODEGEN_CALLS_SIGNATURES_HPP
// How functions and methods are declared.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// `R Name(::stride::Ctx &ctx__, T a)`. In a definition (what it uses is known then) unused
/// parameters are marked and an unused context has no name.
[[nodiscard]] std::string functionSignature(Context &context, Includes &includes,
                                            const PouSymbol *function, const Uses *definition);
/// The same of a method, as `name`; with `self` the instance comes after the context, as an
/// interface.
[[nodiscard]] std::string methodSignature(Context &context, Includes &includes,
                                          const PouSymbol *method, std::string_view name, bool self,
                                          const Uses *definition);
/// What an input is called in the signature of its POU's definition.
[[nodiscard]] std::string inputName(Context &context, const VarSymbol *input);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CALLS_SIGNATURES_HPP
