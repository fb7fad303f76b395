#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <string>

namespace stc {

namespace {

bool sameIdent(std::string_view lower, std::string_view spelling) {
  return lower.size() == spelling.size() &&
         std::equal(lower.begin(), lower.end(), spelling.begin(),
                    [](char a, char b) { return a == lowerCase(b); });
}

} // namespace

Ident Interner::intern(std::string_view spelling, uint32_t hash) {
  if (slots_.size() < 2 * (size_t{size_} + 1))
    grow();
  const size_t mask = slots_.size() - 1;
  size_t slot = (hash ^ (hash >> 15)) & mask;
  for (; slots_[slot] != nullptr; slot = (slot + 1) & mask)
    if (slots_[slot]->hash == hash && sameIdent(slots_[slot]->lower, spelling))
      return slots_[slot];
  slots_[slot] = make(spelling, hash);
  ++size_;
  return slots_[slot];
}

Ident Interner::make(std::string_view spelling, uint32_t hash) {
  if (shared_ == nullptr)
    return arena_.make<IdentData>(arena_.copy(std::string_view(lowerCase(spelling))), hash);
  const std::lock_guard lock(*mutex_);
  return shared_->intern(spelling, hash);
}

void Interner::grow() {
  std::vector<const IdentData *> old(std::max<size_t>(1024, slots_.size() * 2), nullptr);
  old.swap(slots_);
  const size_t mask = slots_.size() - 1;
  for (const IdentData *entry : old) {
    if (entry == nullptr)
      continue;
    size_t slot = (entry->hash ^ (entry->hash >> 15)) & mask;
    while (slots_[slot] != nullptr)
      slot = (slot + 1) & mask;
    slots_[slot] = entry;
  }
}

bool equalIgnoringCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lowerCase(x) == lowerCase(y); });
}

} // namespace stc
