#ifndef STRIDE_COMPILER_SYNTAX_AST_NODE_HPP
#define STRIDE_COMPILER_SYNTAX_AST_NODE_HPP
// What all nodes of the syntax tree have in common.

#include "compiler/source/identifier.hpp"
#include "compiler/source/span.hpp"

#include <cassert>
#include <cstdint>
#include <span>
#include <string_view>

namespace stc {

struct Type;       // semantics/types.hpp
struct ConstValue; // semantics/constant.hpp
struct Symbol;     // semantics/symbols.hpp
struct VarSymbol;
struct PouSymbol;
struct TypeSymbol;
struct Location;

namespace ast {

/// An identifier as written.
struct Name {
  Ident id = nullptr;
  std::string_view text; ///< spelling in the source
  Span span;
  explicit operator bool() const { return id != nullptr; }
};
/// `Lib.Block`, the names from left to right.
using NamePath = std::span<Name>;

/// `%IX0.0`, `%QW2`, `%MD4`, `%I*`: where a located variable lies.
struct DirectAddress {
  static constexpr uint32_t kModule = 0xFFFF'FFFF; ///< for `MOD` in place of a channel
  static constexpr uint32_t kError = 0xFFFF'FFFE;  ///< for `ERR` in place of a bit

  char area = 'M';             ///< I, Q or M; C: a channel of a module, `%CH1.4.3`
  char size = 'X';             ///< X (bit), B, W, D, L or F (REAL); a missing letter means X
  bool incomplete = false;     ///< `%I*`: VAR_CONFIG gives the place
  std::span<uint32_t> numbers; ///< `%IX3.7` gives 3, 7
  std::string_view text;       ///< as written
  Span span;
};

// ----------------------------------------------------------------------------------------------------
// attributes

/// Which attribute it is.
enum class AttributeId : uint8_t {
  Unknown, ///< one that means nothing
#define STC_ATTRIBUTE(enumerator, ...) enumerator,
#include "compiler/syntax/attributes.def"
};

/// `{attribute 'name' := 'value'}`
struct Attribute {
  AttributeId id = AttributeId::Unknown;
  std::string_view name;
  std::string_view value;
  Span span;
};
using Attributes = std::span<const Attribute>;

/// A node of one kind (the first), or of one of several that it is given after it has been made.
template <class Base, auto First, auto... Others> struct Node : Base {
  constexpr Node() : Base{} { this->kind = First; }
  [[nodiscard]] static constexpr bool holds(decltype(First) kind) {
    return kind == First || (... || (kind == Others));
  }
};

/// Downcast of a node whose kind is known: `as<CallExpr>(expr)`.
template <class T, class Base> T *as(Base *node) {
  assert(T::holds(node->kind));
  return static_cast<T *>(node);
}
template <class T, class Base> const T *as(const Base *node) {
  assert(T::holds(node->kind));
  return static_cast<const T *>(node);
}

} // namespace ast
} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_AST_NODE_HPP
