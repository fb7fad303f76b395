// Variables by name.
#ifndef STRIDE_RUNTIME_APP_SYMBOLS_HPP
#define STRIDE_RUNTIME_APP_SYMBOLS_HPP

#include "runtime/app/abi.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stride::app {

/// A resolved path. It stays valid while the application lives; where it goes through pointers it
/// is followed anew at each access.
class Symbol {
public:
  /// The variable's place, or null where a pointer on the way is null. Never allocates. Of a single
  /// bit: the byte it is in.
  void *address(std::byte *state) const;
  /// Where the value can be read: address(), or `bit` filled with the value of a single bit.
  const void *read(std::byte *state, std::byte &bit) const;
  /// Stores a value of the type; false where a pointer on the way is null.
  bool write(std::byte *state, const void *value, size_t size) const;

  /// Its offset from the start of the state; nothing where that can change (behind a pointer) and
  /// for a single bit.
  std::optional<uint64_t> fixedOffset() const;

  /// Index into the type table.
  uint32_t type() const { return type_; }
  /// SymbolFlags of the last name on the path, and kSymConstant if any name has it.
  uint32_t flags() const { return flags_; }
  /// The only task that calls the program that the path begins with; kNoIndex: there is none.
  uint32_t task() const { return task_; }
  /// The path as it was asked for.
  const std::string &path() const { return path_; }

private:
  friend class SymbolTable;
  /// After the first step what has been reached so far is followed.
  struct Step {
    uint64_t offset = 0;      ///< Added to the state's start, or to what is followed.
    uint64_t area = 0;        ///< Of a slot: where its area begins in the state.
    bool followsSlot = false; ///< A slot's number is followed, not a pointer.
    bool countsBits = false;  ///< The number is that of a bit.
  };
  /// Goes on to a member (or element, or root) there.
  void enter(const StrideAppV1 &app, uint64_t offset, uint32_t type, uint32_t flags);
  /// The place and the number of the bit (-1: none).
  std::byte *find(std::byte *state, int &bit) const;

  std::string path_;
  uint32_t type_ = kNoIndex;
  uint32_t flags_ = 0;
  uint32_t task_ = kNoIndex;
  int bit_ = -1; ///< of the byte; -1: none, or in a slot
  std::vector<Step> steps_{Step{}};
};

/// Resolves paths of an application: `Ipo.MoveAbsolute.Position`, `a[1,2].b`, `PLC_PRG.fb.x`,
/// `GVL.x`, `p^.x`, and direct addresses `%MW3`, `%IX0.0`. Names are case-insensitive. Pointers,
/// references and in-outs are followed where a member or an index comes after them; references and
/// in-outs also at the end.
class SymbolTable {
public:
  explicit SymbolTable(const StrideAppV1 &app);

  /// Throws Error, with the nearest names where a name is unknown.
  Symbol resolve(std::string_view path) const;

  /// The elementary values below a symbol in declaration order, without hidden members (unless the
  /// symbol itself was named) and without following pointers, references and in-outs.
  std::vector<Symbol> leaves(const Symbol &symbol) const;

  const StrideAppV1 &app() const { return *app_; }
  const TypeDesc &type(const Symbol &symbol) const { return app_->types[symbol.type()]; }

private:
  class Resolver;
  void appendLeaves(const Symbol &symbol, bool indexOpen, std::vector<Symbol> &out) const;

  const StrideAppV1 *app_;
  /// Lower-case name (and list.name) to indices of roots.
  std::unordered_map<std::string, std::vector<uint32_t>> roots_;
};

/// True for kinds that hold a value that can be read and written as text.
bool isElementary(Kind kind);

} // namespace stride::app

#endif
