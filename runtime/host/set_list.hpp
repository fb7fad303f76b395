// Values written at given times.
#ifndef STRIDE_RUNTIME_HOST_SET_LIST_HPP
#define STRIDE_RUNTIME_HOST_SET_LIST_HPP

#include "runtime/app/symbols.hpp"
#include "runtime/host/options.hpp"

#include <cstddef>
#include <vector>

namespace stride::host {

/// The `--set` options of a run, checked before it starts, in the order of their times.
class SetList {
public:
  /// Throws app::Error: unknown name, constant, not a value of the variable's type.
  SetList(const app::SymbolTable &symbols, const std::vector<SetOption> &options);

  /// Another build has taken over: the entries that are left are resolved in it. Throws as the
  /// constructor does.
  void resolveIn(const app::SymbolTable &symbols);

  /// Writes everything due at or before `timeNs` that is not written yet. Throws app::Error where
  /// a pointer on the way is null.
  void apply(int64_t timeNs, std::byte *state);

  /// When the next one is due; the largest number when none is left.
  int64_t nextNs() const;

  /// The options that were never due.
  std::vector<std::string> left() const;

private:
  struct Entry {
    SetOption option;
    app::Symbol symbol;
    std::vector<std::byte> value;
  };
  static Entry resolve(const app::SymbolTable &symbols, const SetOption &option);

  std::vector<Entry> entries_;
  size_t next_ = 0;
};

} // namespace stride::host

#endif
