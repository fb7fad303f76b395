// The parameters of PDOs: rows, and what they may be.
#include "drivers/can/simulation/process_data.hpp"

#include <algorithm>

namespace stride::can::simulation {
namespace {

constexpr uint16_t kReceiveParameters = 0x1400;
constexpr uint16_t kReceiveMapping = 0x1600;
constexpr uint16_t kTransmitParameters = 0x1800;
constexpr uint16_t kTransmitMapping = 0x1A00;
constexpr uint16_t kBlock = 0x0200;

constexpr uint64_t kAbsent = 0x80000000;   ///< Of a COB-ID: the PDO does not exist …
constexpr uint64_t kNoRemote = 0x40000000; ///< … nobody may ask for it …
constexpr uint64_t kIdBits = 0x3FFFFFFF;   ///< … and what else identifies it.
constexpr unsigned kBits = 8;
constexpr uint64_t kMostPdoBits = 64;

using Type = DataType;

void addMapping(std::vector<ObjectRow> &rows, uint16_t index, const PdoRow &pdo) {
  const Access access = pdo.fixed ? Access::Const : Access::ReadWrite;
  const auto used = std::find(pdo.map.begin(), pdo.map.end(), 0U) - pdo.map.begin();
  rows.push_back({.index = index,
                  .type = Type::Unsigned8,
                  .access = access,
                  .value = static_cast<uint64_t>(used)});
  for (uint8_t sub = 1; sub <= kMapped; ++sub)
    rows.push_back({.index = index,
                    .sub = sub,
                    .type = Type::Unsigned32,
                    .access = access,
                    .value = pdo.map[sub - 1U]});
}

void addParameters(std::vector<ObjectRow> &rows, uint16_t index, const PdoRow &pdo, bool transmit) {
  const uint64_t last = transmit ? 6 : 5;
  rows.push_back({.index = index, .type = Type::Unsigned8, .access = Access::Const, .value = last});
  rows.push_back({.index = index,
                  .sub = 1,
                  .type = Type::Unsigned32,
                  .value = pdo.cobId,
                  .plusId = (pdo.cobId & Frame::kLastId) != 0});
  rows.push_back({.index = index, .sub = 2, .type = Type::Unsigned8, .value = pdo.type});
  rows.push_back({.index = index, .sub = 3, .type = Type::Unsigned16});
  rows.push_back({.index = index, .sub = 5, .type = Type::Unsigned16});
  if (transmit)
    rows.push_back({.index = index, .sub = 6, .type = Type::Unsigned8});
}

uint16_t placeOf(const PdoRow &row, size_t place) {
  return row.number != 0 ? static_cast<uint16_t>(row.number - 1) : static_cast<uint16_t>(place);
}

/// Identifiers that belong to other services. [CiA 301, restricted CAN-IDs]
bool restricted(uint64_t id) {
  struct Range {
    uint64_t first;
    uint64_t last;
  };
  constexpr Range kRanges[] = {{0x000, 0x07F}, {0x101, 0x180}, {0x581, 0x5FF},
                               {0x601, 0x67F}, {0x6E0, 0x6FF}, {0x701, 0x7FF}};
  return std::any_of(std::begin(kRanges), std::end(kRanges),
                     [id](const Range &range) { return id >= range.first && id <= range.last; });
}

} // namespace

void addPdoRows(std::vector<ObjectRow> &rows, std::span<const PdoRow> receive,
                std::span<const PdoRow> transmit) {
  for (size_t i = 0; i < std::min<size_t>(receive.size(), kBlock); ++i) {
    const uint16_t place = placeOf(receive[i], i);
    addParameters(rows, static_cast<uint16_t>(kReceiveParameters + place), receive[i], false);
    addMapping(rows, static_cast<uint16_t>(kReceiveMapping + place), receive[i]);
  }
  for (size_t i = 0; i < std::min<size_t>(transmit.size(), kBlock); ++i) {
    const uint16_t place = placeOf(transmit[i], i);
    addParameters(rows, static_cast<uint16_t>(kTransmitParameters + place), transmit[i], true);
    addMapping(rows, static_cast<uint16_t>(kTransmitMapping + place), transmit[i]);
  }
}

ProcessData::ProcessData(Dictionary &dictionary, ObjectRules &rules, Emergency &emergency,
                         std::span<const PdoRow> receive, std::span<const PdoRow> transmit,
                         bool remotely)
    : dictionary_(dictionary), rules_(rules), emergency_(emergency), receivers_(receive.size()),
      remotely_(remotely) {
  pdos_.resize(receive.size() + transmit.size());
  for (size_t i = 0; i < pdos_.size(); ++i) {
    Pdo &pdo = pdos_[i];
    const bool sends = i >= receivers_;
    pdo.place = sends ? placeOf(transmit[i - receivers_], i - receivers_) : placeOf(receive[i], i);
    const auto parameters =
        static_cast<uint16_t>((sends ? kTransmitParameters : kReceiveParameters) + pdo.place);
    const auto mapping =
        static_cast<uint16_t>((sends ? kTransmitMapping : kReceiveMapping) + pdo.place);
    pdo.cobId = &dictionary.at(parameters, 1);
    pdo.type = &dictionary.at(parameters, 2);
    pdo.inhibit = &dictionary.at(parameters, 3);
    pdo.event = &dictionary.at(parameters, 5);
    pdo.start = sends ? &dictionary.at(parameters, 6) : nullptr;
    for (uint8_t sub = 0; sub <= kMapped; ++sub)
      pdo.map[sub] = &dictionary.at(mapping, sub);
    pdo.fixed = pdo.map[0]->row.access == Access::Const;
  }
}

/// The PDO that a parameter belongs to: its row is in the dictionary, so it is there.
const ProcessData::Pdo &ProcessData::pdoOf(uint16_t index) const {
  const bool sends = index >= kTransmitParameters;
  const std::span<const Pdo> all = pdos_;
  const std::span<const Pdo> some = sends ? all.subspan(receivers_) : all.first(receivers_);
  return *std::find_if(some.begin(), some.end(),
                       [index](const Pdo &pdo) { return pdo.place == index % kBlock; });
}

Abort ProcessData::checkMapping(const Pdo &pdo, uint32_t mapping, Place &place) const {
  const auto index = static_cast<uint16_t>(mapping >> 16U);
  const auto sub = static_cast<uint8_t>(mapping >> kBits & 0xFFU);
  const uint32_t bits = mapping & 0xFFU;
  // A gap is written as a data type. [CiA 301, dummy mapping]
  if (index <= static_cast<uint16_t>(Type::Unsigned32) && index != 0 && sub == 0) {
    place = {nullptr, static_cast<uint8_t>(bytesOf(static_cast<Type>(index)))};
    const bool allowed = !transmits(pdo) && bits == place.bytes * kBits;
    return allowed ? Abort::None : Abort::NotMappable;
  }
  Entry *entry = dictionary_.find(index, sub);
  if (entry == nullptr)
    return dictionary_.missing(index);
  const uint8_t needed = transmits(pdo) ? kInTransmit : kInReceive;
  if ((entry->row.mapping & needed) == 0 || bits != bytesOf(entry->row.type) * kBits)
    return Abort::NotMappable;
  place = {entry, static_cast<uint8_t>(bits / kBits)};
  return Abort::None;
}

Abort ProcessData::checkCobId(const Pdo &pdo, uint64_t value) const {
  const bool exists = (pdo.cobId->value & kAbsent) == 0;
  const bool shall = (value & kAbsent) == 0;
  if (exists && shall && ((pdo.cobId->value ^ value) & kIdBits) != 0)
    return Abort::Value; // it has to be switched off in between
  if ((value & (kIdBits & ~uint64_t{Frame::kLastId})) != 0)
    return Abort::Value; // 29 bits are not for us
  if (transmits(pdo) && !remotely_ && (value & kNoRemote) == 0)
    return Abort::Value;
  return shall && restricted(value & Frame::kLastId) ? Abort::Value : Abort::None;
}

Abort ProcessData::checkCount(const Pdo &pdo, uint64_t count) const {
  if (count > kMapped)
    return Abort::PdoLength;
  uint64_t bits = 0;
  for (uint64_t i = 1; i <= count; ++i) {
    Place place;
    const Abort code = checkMapping(pdo, static_cast<uint32_t>(pdo.map[i]->value), place);
    if (code != Abort::None)
      return code;
    bits += place.bytes * uint64_t{kBits};
  }
  return bits > kMostPdoBits ? Abort::PdoLength : Abort::None;
}

Abort ProcessData::beforeWrite(const Entry &entry, uint64_t value, bool preOperational) const {
  const Pdo &pdo = pdoOf(entry.row.index);
  const bool exists = (pdo.cobId->value & kAbsent) == 0;
  if (entry.row.index % (2 * kBlock) >= kBlock) { // a mapping
    if (exists || !preOperational)
      return Abort::State;
    if (entry.row.sub == 0)
      return checkCount(pdo, value);
    Place place;
    if (pdo.map[0]->value != 0)
      return Abort::State;
    return value == 0 ? Abort::None : checkMapping(pdo, static_cast<uint32_t>(value), place);
  }
  constexpr uint64_t kLastSynchronous = 240;
  constexpr uint64_t kFirstEvent = 254;
  switch (entry.row.sub) {
  case 1:
    return checkCobId(pdo, value);
  case 2:
    return value > kLastSynchronous && value < kFirstEvent ? Abort::Value : Abort::None;
  case 3:
  case 6:
    return exists ? Abort::State : Abort::None;
  default:
    return Abort::None;
  }
}

void ProcessData::resolve(Pdo &pdo) noexcept {
  pdo.exists = (pdo.cobId->value & kAbsent) == 0;
  pdo.id = static_cast<uint16_t>(pdo.cobId->value & Frame::kLastId);
  pdo.places = 0;
  pdo.bytes = 0;
  if (checkCount(pdo, pdo.map[0]->value) != Abort::None)
    return;
  for (uint64_t i = 1; i <= pdo.map[0]->value; ++i) {
    Place &place = pdo.content[pdo.places++];
    (void)checkMapping(pdo, static_cast<uint32_t>(pdo.map[i]->value), place);
    pdo.bytes = static_cast<uint8_t>(pdo.bytes + place.bytes);
  }
}

void ProcessData::configure() noexcept {
  listens_ = {};
  for (Pdo &pdo : pdos_) {
    const bool existed = pdo.exists;
    const uint16_t id = pdo.id;
    resolve(pdo);
    if (pdo.exists != existed || pdo.id != id)
      pdo.pending = pdo.seen = false;
    if (pdo.exists)
      listens_[pdo.id / 64U] |= uint64_t{1} << pdo.id % 64U;
  }
}

} // namespace stride::can::simulation
