#include "drivers/sercos/simulation/idn_list.hpp"

#include <algorithm>
#include <stdexcept>

namespace stride::sercos::simulation {
namespace {

constexpr bool before(const IdnEntry &entry, Idn idn) { return entry.row.idn < idn; }

IdnEntry makeEntry(const IdnRow &row) {
  IdnEntry entry;
  entry.row = row;
  entry.value = row.value;
  entry.room = std::max({row.room, 2 * row.ids.size(), row.text.size()});
  entry.room += entry.room % 2;
  entry.list.reserve(entry.room);
  for (const Idn idn : row.ids)
    entry.add(idn);
  if (row.attribute.display == Display::Text)
    entry.setText(row.text);
  return entry;
}

} // namespace

bool IdnEntry::add(Idn idn) {
  if (list.size() + 2 > room)
    return false;
  list.push_back(static_cast<uint8_t>(idn));
  list.push_back(static_cast<uint8_t>(idn >> 8U));
  return true;
}

void IdnEntry::setText(std::string_view text) {
  const size_t length = std::min(text.size(), room);
  list.assign(text.begin(), text.begin() + static_cast<ptrdiff_t>(length));
}

int64_t fitted(const Attribute &attribute, uint64_t bits) {
  const unsigned width = 8U * attribute.bytes;
  if (width >= 64)
    return static_cast<int64_t>(bits);
  const uint64_t mask = (uint64_t{1} << width) - 1;
  bits &= mask;
  const bool negative = attribute.display == Display::Signed && (bits >> (width - 1)) != 0;
  return static_cast<int64_t>(negative ? bits | ~mask : bits);
}

IdnList::IdnList(std::vector<IdnRow> rows) {
  entries_.reserve(rows.size());
  std::stable_sort(rows.begin(), rows.end(),
                   [](const IdnRow &a, const IdnRow &b) { return a.idn < b.idn; });
  for (const IdnRow &row : rows) {
    if (!entries_.empty() && entries_.back().row.idn == row.idn)
      entries_.pop_back();
    entries_.push_back(makeEntry(row));
  }
  fillLists();
}

IdnEntry *IdnList::find(Idn idn) {
  const auto entry = std::lower_bound(entries_.begin(), entries_.end(), idn, before);
  return entry != entries_.end() && entry->row.idn == idn ? &*entry : nullptr;
}

const IdnEntry *IdnList::find(Idn idn) const {
  const auto entry = std::lower_bound(entries_.begin(), entries_.end(), idn, before);
  return entry != entries_.end() && entry->row.idn == idn ? &*entry : nullptr;
}

IdnEntry &IdnList::at(Idn idn) {
  IdnEntry *entry = find(idn);
  if (entry == nullptr)
    throw std::out_of_range("no such IDN");
  return *entry;
}

int64_t IdnList::value(Idn idn) const {
  const IdnEntry *entry = find(idn);
  return entry != nullptr ? entry->value : 0;
}

void IdnList::fill(Idn list, bool (*belongs)(const IdnEntry &)) {
  IdnEntry *entry = find(list);
  if (entry == nullptr)
    return;
  entry->room = 2 * static_cast<size_t>(std::count_if(entries_.begin(), entries_.end(), belongs));
  entry->list.reserve(entry->room);
  entry->clear();
  for (const IdnEntry &one : entries_)
    if (belongs(one))
      entry->add(one.row.idn);
}

void IdnList::fillLists() {
  fill(idns::kAllIdns, [](const IdnEntry &) { return true; });
  fill(idns::kPhase2Idns, [](const IdnEntry &one) { return one.row.given == Given::Phase2; });
  fill(idns::kPhase3Idns, [](const IdnEntry &one) { return one.row.given == Given::Phase3; });
  fill(idns::kCommands, [](const IdnEntry &one) { return one.isCommand(); });
  fill(idns::kAtCandidates, [](const IdnEntry &one) { return (one.row.cyclic & kInAt) != 0; });
  fill(idns::kMdtCandidates, [](const IdnEntry &one) { return (one.row.cyclic & kInMdt) != 0; });
}

} // namespace stride::sercos::simulation
