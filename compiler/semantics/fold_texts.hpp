#ifndef STRIDE_COMPILER_SEMANTICS_FOLD_TEXTS_HPP
#define STRIDE_COMPILER_SEMANTICS_FOLD_TEXTS_HPP
// Texts as constants: UTF-8 in the compiler (with halves of surrogate pairs), Latin-1 or UTF-16 at
// run time. Internal to the sources that fold.

#include "compiler/semantics/fold_builtins.hpp"

#include <string>

namespace stc {

/// What a text consists of at run time.
using Units = std::u16string;

/// Up to its first NUL; a STRING has `?` for what is not Latin-1.
[[nodiscard]] Units decode(std::string_view text, bool wide);
/// Half of a surrogate pair becomes three bytes, as if it was a character; decode() knows it.
[[nodiscard]] ConstValue encode(const Units &units, Arena &arena);

/// A call with constant arguments.
struct FoldCall {
  std::span<const ConstArgument> arguments; ///< one at least
  const Type *result;
  Arena &arena;
};

// LEN … FIND
std::optional<ConstValue> foldLen(const FoldCall &call);
std::optional<ConstValue> foldLeft(const FoldCall &call);
std::optional<ConstValue> foldRight(const FoldCall &call);
std::optional<ConstValue> foldMid(const FoldCall &call);
std::optional<ConstValue> foldConcat(const FoldCall &call);
std::optional<ConstValue> foldInsert(const FoldCall &call);
std::optional<ConstValue> foldDelete(const FoldCall &call);
std::optional<ConstValue> foldReplace(const FoldCall &call);
std::optional<ConstValue> foldFind(const FoldCall &call);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_FOLD_TEXTS_HPP
