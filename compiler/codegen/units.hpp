#ifndef STRIDE_COMPILER_CODEGEN_UNITS_HPP
#define STRIDE_COMPILER_CODEGEN_UNITS_HPP
// The generated files of one library: headers with layouts, sources with bodies and initial values.

#include "compiler/codegen/generated_source.hpp"

#include <string>
#include <vector>

namespace stc::codegen {

/// Headers of all types, POUs and variable lists of the context's own library.
void generateHeaders(Context &context, std::vector<GeneratedFile> &files);
/// Sources of all its POUs, and one for the initial values of structures and variable lists.
void generateSources(Context &context, std::vector<GeneratedFile> &files);

/// `struct T { … };` with what belongs to it is needed by the application as well: the variables of
/// a root.
[[nodiscard]] std::vector<const VarSymbol *> rootVariables(const Root &root);
/// Whether the root's memory must be set after it has been zeroed.
[[nodiscard]] bool rootNeedsInit(Context &context, const Root &root);

/// VAR_CONFIG gives initial values: `configure__` sets them.
[[nodiscard]] bool hasConfiguredValues(const Program &program);

/// Something in the root has a method that is called at the end of its life or after an online
/// change (Layouts::hasLifecycle).
[[nodiscard]] bool rootHasLifecycle(Context &context, const Root &root, std::string_view lowerName);
/// The functions that find out at run time which method is meant.
void generateDispatch(Context &context, std::vector<GeneratedFile> &files);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_UNITS_HPP
