#include "drivers/can/simulation/communication_rows.hpp"

namespace stride::can::simulation {
namespace {

using Type = DataType;

constexpr uint64_t kSyncId = 0x80;

void addErrors(std::vector<ObjectRow> &rows) {
  rows.push_back({.index = 0x1001,
                  .type = Type::Unsigned8,
                  .access = Access::ReadOnly,
                  .mapping = kInTransmit});
  rows.push_back({.index = 0x1003, .type = Type::Unsigned8});
  for (uint8_t sub = 1; sub <= kErrorHistory; ++sub)
    rows.push_back({.index = 0x1003, .sub = sub, .access = Access::ReadOnly});
  rows.push_back({.index = 0x1014, .value = 0x80, .plusId = true});
  rows.push_back({.index = 0x1015, .type = Type::Unsigned16});
  rows.push_back({.index = 0x1029, .type = Type::Unsigned8, .access = Access::Const, .value = 1});
  rows.push_back({.index = 0x1029, .sub = 1, .type = Type::Unsigned8, .low = 0, .high = 2});
}

void addErrorControl(std::vector<ObjectRow> &rows) {
  rows.push_back({.index = 0x100C, .type = Type::Unsigned16});
  rows.push_back({.index = 0x100D, .type = Type::Unsigned8});
  rows.push_back(
      {.index = 0x1016, .type = Type::Unsigned8, .access = Access::Const, .value = kWatched});
  for (uint8_t sub = 1; sub <= kWatched; ++sub)
    rows.push_back({.index = 0x1016, .sub = sub});
  rows.push_back({.index = 0x1017, .type = Type::Unsigned16});
}

void addIdentity(std::vector<ObjectRow> &rows, const NodeSetup &setup) {
  rows.push_back({.index = 0x1018, .type = Type::Unsigned8, .access = Access::Const, .value = 4});
  const uint32_t identity[] = {setup.vendor, setup.product, setup.revision, setup.serial};
  for (uint8_t sub = 1; sub <= 4; ++sub)
    rows.push_back(
        {.index = 0x1018, .sub = sub, .access = Access::Const, .value = identity[sub - 1U]});
  const struct {
    uint16_t index;
    std::string_view text;
  } texts[] = {{0x1008, setup.name}, {0x1009, "1"}, {0x100A, "1"}};
  for (const auto &[index, text] : texts)
    rows.push_back(
        {.index = index, .type = Type::VisibleString, .access = Access::Const, .text = text});
}

void addSynchronisation(std::vector<ObjectRow> &rows) {
  rows.push_back({.index = 0x1005, .value = kSyncId});
  rows.push_back({.index = 0x1006});
  rows.push_back({.index = 0x1007});
  rows.push_back({.index = 0x1019, .type = Type::Unsigned8, .low = 0, .high = 240});
}

void addStorage(std::vector<ObjectRow> &rows) {
  for (const uint16_t index : {uint16_t{0x1010}, uint16_t{0x1011}}) {
    rows.push_back({.index = index, .type = Type::Unsigned8, .access = Access::Const, .value = 1});
    rows.push_back({.index = index, .sub = 1, .value = 1});
  }
  rows.push_back({.index = 0x1020, .type = Type::Unsigned8, .access = Access::Const, .value = 2});
  rows.push_back({.index = 0x1020, .sub = 1});
  rows.push_back({.index = 0x1020, .sub = 2});
}

void addServer(std::vector<ObjectRow> &rows) {
  rows.push_back({.index = 0x1200, .type = Type::Unsigned8, .access = Access::Const, .value = 2});
  rows.push_back(
      {.index = 0x1200, .sub = 1, .access = Access::ReadOnly, .value = 0x600, .plusId = true});
  rows.push_back(
      {.index = 0x1200, .sub = 2, .access = Access::ReadOnly, .value = 0x580, .plusId = true});
}

} // namespace

std::vector<ObjectRow> allRows(const NodeSetup &setup, const DeviceRows &device) {
  std::vector<ObjectRow> rows;
  rows.push_back({.index = 0x1000, .access = Access::Const, .value = device.deviceType});
  addErrors(rows);
  addErrorControl(rows);
  addIdentity(rows, setup);
  addSynchronisation(rows);
  addStorage(rows);
  addServer(rows);
  addPdoRows(rows, device.receive, device.transmit);
  rows.insert(rows.end(), device.objects.begin(), device.objects.end());
  return rows;
}

} // namespace stride::can::simulation
