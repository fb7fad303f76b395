#ifndef STRIDE_COMPILER_CODEGEN_LAYOUT_NUMBERS_HPP
#define STRIDE_COMPILER_CODEGEN_LAYOUT_NUMBERS_HPP
// Numbers of types that only g++ knows (SymbolNumbers of runtime/app/abi.h): kind, size, alignment
// and the offsets of members. Those of blocks with many variables stand in the sources of the
// blocks, which an edit of their variables compiles anyway; others in app.cpp.

#include "compiler/codegen/codegen.hpp"
#include "compiler/codegen/context/context.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace stc::codegen {

/// `offsetof(type, member)`
[[nodiscard]] std::string offsetOf(std::string_view type, std::string_view member);
/// `uint64_t(Kind::kind), sizeof(type), alignof(type)`: what each type's numbers begin with.
[[nodiscard]] std::string measuresOf(std::string_view kind, std::string_view type);
/// The kind of its instances in C++: `Program`.
[[nodiscard]] std::string_view instanceKind(const PouSymbol *pou);

/// The numbers of the type of its instances are in the source of the POU, where the application
/// has such a type.
[[nodiscard]] bool hasOwnNumbers(const PouSymbol *pou);
/// What they are called there, without its namespace.
[[nodiscard]] std::string numbersName(Context &context, const PouSymbol *pou);
/// Puts them at the ends of the POUs' sources, which are among `files`. The members are as the type
/// table lists them: the base, the type id, the variables.
void addOwnNumbers(Context &context, const std::vector<const PouSymbol *> &pous,
                   std::vector<GeneratedFile> &files);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_LAYOUT_NUMBERS_HPP
