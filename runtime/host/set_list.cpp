#include "runtime/host/set_list.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace stride::host {

SetList::SetList(const app::SymbolTable &symbols, const std::vector<SetOption> &options) {
  for (const SetOption &option : options) {
    try {
      app::Symbol symbol = symbols.resolve(option.path);
      if ((symbol.flags() & kSymConstant) != 0)
        throw app::Error(fmt::format("'{}' is a constant", option.path));
      const TypeDesc &type = symbols.type(symbol);
      std::vector<std::byte> value(type.size);
      app::parseLiteral(symbols.app(), type, option.value, value.data());
      entries_.push_back({option.timeNs, std::move(symbol), std::move(value), option.text});
    } catch (const app::Error &error) {
      throw app::Error(fmt::format("--set '{}': {}", option.text, error.what()));
    }
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry &a, const Entry &b) { return a.timeNs < b.timeNs; });
}

void SetList::apply(int64_t timeNs, std::byte *state) {
  for (; next_ < entries_.size() && entries_[next_].timeNs <= timeNs; ++next_) {
    const Entry &entry = entries_[next_];
    if (!entry.symbol.write(state, entry.value.data(), entry.value.size()))
      throw app::Error(fmt::format("--set '{}': a pointer on the way to '{}' is null at that time",
                                   entry.text, entry.symbol.path()));
  }
}

int64_t SetList::nextNs() const {
  return next_ < entries_.size() ? entries_[next_].timeNs : std::numeric_limits<int64_t>::max();
}

std::vector<std::string> SetList::left() const {
  std::vector<std::string> texts;
  for (std::size_t i = next_; i < entries_.size(); ++i)
    texts.push_back(entries_[i].text);
  return texts;
}

} // namespace stride::host
