#pragma once
// The generated files of one library: headers with layouts, sources with bodies and initial values.

#include "compiler/codegen/codegen.hpp"
#include "compiler/codegen/emitter.hpp"

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

/// `R Name(::stride::Ctx &ctx__, T a)`. In a definition unused parameters are marked and an unused
/// context has no name.
[[nodiscard]] std::string functionSignature(Context &context, const PouSymbol *symbol,
                                            const Emitter *definition);

/// `R name(::stride::Ctx &ctx__, T a)` of a method; with `self` the instance comes behind the
/// context, as an interface.
[[nodiscard]] std::string methodSignature(Context &context, Includes &includes,
                                          const PouSymbol *method, std::string_view name, bool self,
                                          const Emitter *definition);
/// Something in the root has a method that is called at the end of its life or after an online
/// change (Layouts::hasLifecycle).
[[nodiscard]] bool rootHasLifecycle(Context &context, const Root &root, std::string_view lowerName);
/// The functions that find out at run time which method is meant.
void generateDispatch(Context &context, std::vector<GeneratedFile> &files);

/// The blocks that extend `base` at any depth and can have instances.
[[nodiscard]] std::vector<const PouSymbol *> derivedBlocks(const Program &program,
                                                           const PouSymbol *base);
/// It is, or holds, a block with a VAR_IN_OUT.
[[nodiscard]] bool holdsInOut(const Type *type);

/// First line of each generated file.
[[nodiscard]] std::string banner(std::string_view what);
/// What every generated source includes and switches off.
[[nodiscard]] std::string_view sourcePrelude();

} // namespace stc::codegen
