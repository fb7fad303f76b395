#include "runtime/host/print_values.hpp"

#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <iterator>

#include <unistd.h>

namespace stride::host {

namespace {

constexpr size_t kPrintPiece = size_t{64} << 10;

} // namespace

std::string printedValues(const app::SymbolTable &symbols, const std::vector<std::string> &names,
                          std::byte *state) {
  std::string text;
  for (const std::string &name : names) {
    for (const app::Symbol &leaf : symbols.leaves(symbols.resolve(name))) {
      std::byte bit{};
      const void *value = leaf.read(state, bit);
      fmt::format_to(std::back_inserter(text), "{} = {}\n", leaf.path(),
                     value != nullptr ? app::formatLiteral(symbols.app(), symbols.type(leaf), value)
                                      : std::string("NULL"));
    }
  }
  return text;
}

int print(std::string_view text, Output::Wait wait) {
  Output output(STDOUT_FILENO, kPrintPiece, wait);
  while (!text.empty()) {
    const std::string_view piece = text.substr(0, kPrintPiece);
    text.remove_prefix(piece.size());
    output.append(piece);
    if (!output.settle())
      return output.error() != 0 ? output.error() : ETIMEDOUT;
  }
  return 0;
}

} // namespace stride::host
