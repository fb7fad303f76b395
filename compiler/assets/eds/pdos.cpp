#include "compiler/assets/eds/device.hpp"

#include <algorithm>

namespace stc::eds {
namespace {

constexpr uint16_t kReceive = 0x1400;
constexpr uint16_t kTransmit = 0x1800;
constexpr uint16_t kMapping = 0x0200;
constexpr uint16_t kMostPdos = 512;
constexpr uint8_t kMostPlaces = 64;

Pdo pdoOf(const Device &device, uint16_t parameters, bool transmit) {
  Pdo pdo;
  pdo.transmit = transmit;
  pdo.number = static_cast<uint16_t>(parameters % kMapping + 1);
  if (const Object *cobId = device.find(parameters, 1);
      cobId != nullptr && cobId->value() != nullptr)
    pdo.cobId = *cobId->value();
  if (const Object *type = device.find(parameters, 2); type != nullptr && type->value() != nullptr)
    pdo.type = static_cast<uint8_t>(type->value()->number);
  pdo.hasInhibitTime = device.find(parameters, 3) != nullptr;
  pdo.hasEventTimer = device.find(parameters, 5) != nullptr;
  const auto mapping = static_cast<uint16_t>(parameters + kMapping);
  const Object *count = device.find(mapping, 0);
  pdo.fixedMapping = count != nullptr && !count->isWritable();
  // The count is 0 in many files though the places have values.
  const bool counted = count != nullptr && count->value() != nullptr && count->value()->number > 0;
  for (uint8_t sub = 1; sub <= kMostPlaces; ++sub) {
    const Object *place = device.find(mapping, sub);
    if (place == nullptr)
      break;
    ++pdo.places;
    pdo.fixedMapping = pdo.fixedMapping || (sub == 1 && !place->isWritable());
    const int64_t value = place->value() == nullptr ? 0 : place->value()->number;
    if (value != 0 && pdo.map.size() + 1 == pdo.places &&
        (!counted || static_cast<int64_t>(sub) <= count->value()->number))
      pdo.map.push_back(static_cast<uint32_t>(value));
  }
  return pdo;
}

} // namespace

std::vector<Pdo> pdosOf(const Device &device) {
  std::vector<Pdo> pdos;
  for (const uint16_t first : {kReceive, kTransmit})
    for (uint16_t i = 0; i < kMostPdos; ++i) {
      const auto index = static_cast<uint16_t>(first + i);
      if (device.find(index, 1) != nullptr)
        pdos.push_back(pdoOf(device, index, first == kTransmit));
    }
  return pdos;
}

} // namespace stc::eds
