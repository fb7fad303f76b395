#include "drivers/can/simulation/dictionary.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace stride::can::simulation {
namespace {

struct TypeRow {
  DataType type;
  size_t bytes;
  bool isSigned;
};

constexpr std::array<TypeRow, 18> kTypes = {{{DataType::Boolean, 1, false},
                                             {DataType::Integer8, 1, true},
                                             {DataType::Integer16, 2, true},
                                             {DataType::Integer32, 4, true},
                                             {DataType::Unsigned8, 1, false},
                                             {DataType::Unsigned16, 2, false},
                                             {DataType::Unsigned32, 4, false},
                                             {DataType::Real32, 4, false},
                                             {DataType::VisibleString, 0, false},
                                             {DataType::OctetString, 0, false},
                                             {DataType::Domain, 0, false},
                                             {DataType::Real64, 8, false},
                                             {DataType::Integer64, 8, true},
                                             {DataType::Unsigned24, 3, false},
                                             {DataType::Unsigned40, 5, false},
                                             {DataType::Unsigned48, 6, false},
                                             {DataType::Unsigned56, 7, false},
                                             {DataType::Unsigned64, 8, false}}};

constexpr unsigned kByte = 8;

const TypeRow &rowOf(DataType type) {
  const auto *found = std::find_if(kTypes.begin(), kTypes.end(),
                                   [type](const TypeRow &row) { return row.type == type; });
  return found == kTypes.end() ? kTypes[0] : *found;
}

uint32_t key(uint16_t index, uint8_t sub) { return static_cast<uint32_t>(index) << kByte | sub; }
uint32_t key(const ObjectRow &row) { return key(row.index, row.sub); }

} // namespace

size_t bytesOf(DataType type) { return rowOf(type).bytes; }
bool isSigned(DataType type) { return rowOf(type).isSigned; }

uint64_t decode(std::span<const uint8_t> bytes) {
  uint64_t value = 0;
  for (size_t i = std::min<size_t>(bytes.size(), sizeof value); i-- > 0;)
    value = value << kByte | bytes[i];
  return value;
}

void encode(uint64_t value, std::span<uint8_t> bytes) {
  for (uint8_t &byte : bytes) {
    byte = static_cast<uint8_t>(value & 0xFFU);
    value >>= kByte;
  }
}

Dictionary::Dictionary(std::vector<ObjectRow> rows) {
  std::stable_sort(rows.begin(), rows.end(),
                   [](const ObjectRow &a, const ObjectRow &b) { return key(a) < key(b); });
  for (ObjectRow &row : rows) {
    row.room = std::max(row.room, row.text.size());
    row.value = fitted(row.type, row.value);
    Entry entry{row, row.value, {}};
    entry.text.reserve(row.room);
    entry.text.assign(row.text.begin(), row.text.end());
    if (!entries_.empty() && key(entries_.back().row) == key(row))
      entries_.back() = std::move(entry);
    else
      entries_.push_back(std::move(entry));
  }
  forgetStored();
}

const Entry *Dictionary::find(uint16_t index, uint8_t sub) const {
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), key(index, sub),
                       [](const Entry &entry, uint32_t wanted) { return key(entry.row) < wanted; });
  return found != entries_.end() && found->is(index, sub) ? &*found : nullptr;
}

Entry *Dictionary::find(uint16_t index, uint8_t sub) {
  return const_cast<Entry *>(std::as_const(*this).find(index, sub));
}

Entry &Dictionary::at(uint16_t index, uint8_t sub) {
  if (Entry *entry = find(index, sub))
    return *entry;
  throw std::out_of_range("no such object");
}

uint64_t Dictionary::value(uint16_t index, uint8_t sub) const {
  const Entry *entry = find(index, sub);
  return entry == nullptr ? 0 : entry->value;
}

Abort Dictionary::missing(uint16_t index) const {
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), key(index, 0),
                       [](const Entry &entry, uint32_t wanted) { return key(entry.row) < wanted; });
  return found != entries_.end() && found->row.index == index ? Abort::NoSub : Abort::NoObject;
}

uint64_t Dictionary::fitted(DataType type, uint64_t bits) {
  const size_t bytes = bytesOf(type);
  if (bytes == 0 || bytes >= sizeof bits)
    return bits;
  const unsigned unused = kByte * static_cast<unsigned>(sizeof bits - bytes);
  if (isSigned(type))
    return static_cast<uint64_t>(static_cast<int64_t>(bits << unused) >> unused);
  return bits << unused >> unused;
}

Abort Dictionary::checkRange(const Entry &entry, uint64_t value) {
  if (entry.row.type == DataType::Boolean && value > 1)
    return Abort::ValueHigh;
  if (entry.row.low == entry.row.high)
    return Abort::None;
  const auto number = static_cast<int64_t>(value);
  if (number > entry.row.high)
    return Abort::ValueHigh;
  return number < entry.row.low ? Abort::ValueLow : Abort::None;
}

void Dictionary::restore(uint16_t first, uint16_t last, uint8_t nodeId) {
  for (size_t i = 0; i < entries_.size(); ++i) {
    Entry &entry = entries_[i];
    if (entry.row.index < first || entry.row.index > last)
      continue;
    entry.value = stored_[i].value + (stored_[i].plusId ? nodeId : 0U);
    if (entry.row.access != Access::ReadWrite) // texts that were written stay
      entry.text.assign(entry.row.text.begin(), entry.row.text.end());
  }
}

void Dictionary::store(uint16_t first, uint16_t last) {
  for (size_t i = 0; i < entries_.size(); ++i) {
    const ObjectRow &row = entries_[i].row;
    if (row.index >= first && row.index <= last && row.access == Access::ReadWrite)
      stored_[i] = {entries_[i].value, false};
  }
}

void Dictionary::forgetStored() {
  stored_.resize(entries_.size());
  for (size_t i = 0; i < entries_.size(); ++i)
    stored_[i] = {entries_[i].row.value, entries_[i].row.plusId};
}

size_t Dictionary::mostBytes() const {
  size_t most = 0;
  for (const Entry &entry : entries_)
    most = std::max(most, entry.room());
  return most;
}

} // namespace stride::can::simulation
