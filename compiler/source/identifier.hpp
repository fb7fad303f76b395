#ifndef STRIDE_COMPILER_SOURCE_IDENTIFIER_HPP
#define STRIDE_COMPILER_SOURCE_IDENTIFIER_HPP
// Interned, case-insensitive identifiers.

#include "compiler/source/arena.hpp"
#include "runtime/common/fnv.hpp"
#include "runtime/common/text.hpp"

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// An identifier; two spellings that differ only in case are the same pointer.
struct IdentData {
  std::string_view lower; ///< lower-case spelling
  uint32_t hash;          ///< hashIdent() of the spelling
};
using Ident = const IdentData *;

using stride::common::lowerCase;

/// The hash of an identifier, whatever its case: letter by letter, and as a whole.
class IdentHash {
public:
  constexpr void add(char c) { hash_.add(static_cast<unsigned char>(lowerCase(c))); }
  [[nodiscard]] constexpr uint32_t value() const { return hash_.value(); }

private:
  stride::common::Fnv1a<uint32_t> hash_;
};
constexpr uint32_t hashIdent(std::string_view spelling) {
  IdentHash hash;
  for (const char c : spelling)
    hash.add(c);
  return hash.value();
}

/// Gives each identifier its IdentData. One per compilation; while several threads work, each has
/// one of its own before that.
class Interner {
public:
  Interner() = default;
  /// Gives what `shared` gives, which it asks once for each identifier while it holds `mutex`. Both
  /// must outlive it.
  Interner(Interner &shared, std::mutex &mutex) : shared_(&shared), mutex_(&mutex) {}

  Ident intern(std::string_view spelling) { return intern(spelling, hashIdent(spelling)); }
  /// For callers that know the spelling's hashIdent() already.
  Ident intern(std::string_view spelling, uint32_t hash);
  [[nodiscard]] size_t size() const { return size_; }

private:
  void grow();
  Ident make(std::string_view spelling, uint32_t hash);

  Interner *shared_ = nullptr; ///< null: this is the only one
  std::mutex *mutex_ = nullptr;
  Arena arena_;
  std::vector<const IdentData *> slots_; ///< open addressing, a power of two
  uint32_t size_ = 0;
};

/// Whether two texts are the same but for the case of ASCII letters.
[[nodiscard]] bool equalIgnoringCase(std::string_view a, std::string_view b);

} // namespace stc

#endif // STRIDE_COMPILER_SOURCE_IDENTIFIER_HPP
