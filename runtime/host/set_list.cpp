#include "runtime/host/set_list.hpp"

#include "runtime/app/condition.hpp"
#include "runtime/app/error.hpp"
#include "runtime/app/value_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace stride::host {

SetList::Entry SetList::resolve(const app::SymbolTable &symbols, const SetOption &option) {
  try {
    Entry entry{option, symbols.resolve(option.path), {}};
    if ((entry.symbol.flags() & kSymConstant) != 0)
      throw app::Error(fmt::format("'{}' is {}", option.path, app::whyNotWritten(entry.symbol)));
    const TypeDesc &type = symbols.type(entry.symbol);
    entry.value.resize(type.size);
    app::parseLiteral(symbols.app(), type, option.value, entry.value.data());
    return entry;
  } catch (const app::Error &error) {
    throw app::Error(fmt::format("--set '{}': {}", option.text, error.what()));
  }
}

SetList::SetList(const app::SymbolTable &symbols, const std::vector<SetOption> &options) {
  for (const SetOption &option : options)
    entries_.push_back(resolve(symbols, option));
  std::stable_sort(entries_.begin(), entries_.end(), [](const Entry &a, const Entry &b) {
    return a.option.timeNs < b.option.timeNs;
  });
}

void SetList::resolveIn(const app::SymbolTable &symbols) {
  for (size_t i = next_; i < entries_.size(); ++i)
    entries_[i] = resolve(symbols, entries_[i].option);
}

void SetList::apply(int64_t timeNs, std::byte *state) {
  for (; next_ < entries_.size() && entries_[next_].option.timeNs <= timeNs; ++next_) {
    const Entry &entry = entries_[next_];
    if (!entry.symbol.write(state, entry.value.data(), entry.value.size()))
      throw app::Error(fmt::format("--set '{}': a pointer on the way to '{}' is null at that time",
                                   entry.option.text, entry.symbol.path()));
  }
}

int64_t SetList::nextNs() const {
  return next_ < entries_.size() ? entries_[next_].option.timeNs
                                 : std::numeric_limits<int64_t>::max();
}

std::vector<std::string> SetList::left() const {
  std::vector<std::string> texts;
  for (size_t i = next_; i < entries_.size(); ++i)
    texts.push_back(entries_[i].option.text);
  return texts;
}

} // namespace stride::host
