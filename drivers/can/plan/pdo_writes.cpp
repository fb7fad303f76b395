#include "drivers/can/plan/pdo_plan.hpp"

#include <algorithm>

namespace stride::can {
namespace {

/// The objects of PDO n, and how it is set.
struct PdoObjects {
  uint16_t communication;
  uint16_t mapping;
  uint16_t cobIdBase;
  bool transmits;
};
constexpr PdoObjects kReceive = {object::kRpdoCommunication, object::kRpdoMapping, kRpdoBase,
                                 false};
constexpr PdoObjects kTransmit = {object::kTpdoCommunication, object::kTpdoMapping, kTpdoBase,
                                  true};

uint16_t indexOf(uint16_t first, size_t place) { return static_cast<uint16_t>(first + place); }

uint32_t mappingValue(const PdoEntry &entry, uint8_t axis) {
  return uint32_t{ofAxis(entry.object, axis).index} << 16U | uint32_t{entry.object.sub} << 8U |
         entry.bits;
}

void configure(std::vector<SdoWrite> &writes, const PdoObjects &objects, const Pdo &pdo,
               uint8_t axis) {
  const uint16_t communication = indexOf(objects.communication, pdo.number - 1U);
  const uint16_t mapping = indexOf(objects.mapping, pdo.number - 1U);
  writes.push_back({{communication, 1}, 4, pdo.cobId | kPdoInvalid, false, objects.transmits});
  writes.push_back({{mapping, 0}, 1, 0});
  for (uint8_t i = 0; i < pdo.count; ++i)
    writes.push_back(
        {{mapping, static_cast<uint8_t>(i + 1)}, 4, mappingValue(pdo.entries[i], axis)});
  writes.push_back({{mapping, 0}, 1, pdo.count});
  writes.push_back({{communication, 2}, 1, pdo.transmission});
  if (objects.transmits && pdo.inhibit != 0)
    writes.push_back({{communication, 3}, 2, pdo.inhibit, true});
  if (objects.transmits && !pdo.synchronous())
    writes.push_back({{communication, 5}, 2, pdo.eventTimer, true});
  writes.push_back({{communication, 1}, 4, pdo.cobId, false, objects.transmits});
}

void configureAll(std::vector<SdoWrite> &writes, const PdoObjects &objects,
                  std::span<const Pdo> pdos, const DrivePlan &plan) {
  const size_t first = size_t{kAxisPdos} * plan.axis;
  for (size_t place = 0; place < DrivePlan::kMostPdos; ++place) {
    const auto pdo = std::find_if(pdos.begin(), pdos.end(),
                                  [&](const Pdo &one) { return one.number == first + place + 1; });
    if (pdo != pdos.end()) {
      configure(writes, objects, *pdo, plan.axis);
      continue;
    }
    const uint32_t cobId = predefinedId(objects.cobIdBase, place, plan.node, plan.axis);
    writes.push_back({{indexOf(objects.communication, first + place), 1},
                      4,
                      cobId | kPdoInvalid,
                      true,
                      objects.transmits});
  }
}

void append(std::vector<uint8_t> &bytes, uint32_t value, unsigned size) {
  for (unsigned i = 0; i < size; ++i)
    bytes.push_back(static_cast<uint8_t>(value >> 8U * i));
}

} // namespace

std::vector<SdoWrite> pdoWrites(const DrivePlan &plan) {
  std::vector<SdoWrite> writes;
  configureAll(writes, kReceive, plan.receivedByDrive(), plan);
  configureAll(writes, kTransmit, plan.sentByDrive(), plan);
  return writes;
}

std::vector<uint8_t> conciseDcf(std::span<const SdoWrite> writes) {
  std::vector<uint8_t> bytes;
  uint32_t count = 0;
  append(bytes, 0, 4);
  for (const SdoWrite &write : writes) {
    if (write.optional)
      continue;
    ++count;
    append(bytes, write.object.index, 2);
    append(bytes, write.object.sub, 1);
    append(bytes, static_cast<uint32_t>(write.length()), 4);
    bytes.insert(bytes.end(), write.bytes.begin(), write.bytes.end());
    if (!write.bytes.empty())
      continue;
    append(bytes, write.keepNoRemote ? write.value | kPdoNoRemote : write.value, write.size);
  }
  for (unsigned i = 0; i < 4; ++i)
    bytes[i] = static_cast<uint8_t>(count >> 8U * i);
  return bytes;
}

ConfigurationStamp stampOf(std::span<const SdoWrite> writes) {
  // FNV-1a over all of them, also the optional ones.
  uint64_t hash = 0xCBF29CE484222325;
  const auto mix = [&hash](uint32_t value) {
    for (unsigned i = 0; i < 4; ++i)
      hash = (hash ^ (value >> 8U * i & 0xFFU)) * 0x100000001B3;
  };
  for (const SdoWrite &write : writes) {
    mix(uint32_t{write.object.index} << 8U | write.object.sub);
    mix(write.size);
    mix(write.value);
    for (const uint8_t byte : write.bytes)
      mix(byte);
  }
  constexpr uint32_t kDayMs = 86400000;
  return {static_cast<uint32_t>(hash >> 48U) | 1U, static_cast<uint32_t>(hash % kDayMs)};
}

} // namespace stride::can
