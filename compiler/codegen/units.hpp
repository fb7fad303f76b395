#ifndef STRIDE_COMPILER_CODEGEN_UNITS_HPP
#define STRIDE_COMPILER_CODEGEN_UNITS_HPP
// The generated files of one library: headers with layouts, sources with bodies and initial values.

#include "compiler/codegen/generated_source.hpp"

#include <functional>
#include <string>
#include <vector>

namespace stc::codegen {

/// Something that is generated apart from everything else.
using Generator = std::function<void(Context &context, std::vector<GeneratedFile> &files)>;

/// Headers of all types, variable lists and POUs of the context's own library, then its sources:
/// one for the initial values of structures and variable lists, and those of the POUs; then
/// `others`. By several threads, each of which has a context of its own.
void generateUnits(Context &context, const std::vector<Generator> &others,
                   std::vector<GeneratedFile> &files);

/// What has a header in the own library: types, variable lists, POUs.
[[nodiscard]] std::vector<const Symbol *> headersOf(const Context &context);
[[nodiscard]] GeneratedFile generateHeader(Context &context, const Symbol *symbol);

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
