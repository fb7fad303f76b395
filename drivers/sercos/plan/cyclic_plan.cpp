#include "drivers/sercos/plan/cyclic_plan.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

/// What wCyclicData… names, as IDN; 0: Sercos has none for it.
struct DataRow {
  uint16_t number;
  Idn idn;
  uint8_t bytes;
};
constexpr std::array<DataRow, 6> kData = {{{1100, idns::kPositionCommand, 4},
                                           {1110, idns::kVelocityCommand, 4},
                                           {1160, idns::kTorqueCommand, 2},
                                           {1101, idns::kPositionFeedback1, 4},
                                           {1111, idns::kVelocityFeedback, 4},
                                           {1161, idns::kTorqueFeedback, 2}}};

/// What an IDN is for an axis.
struct RoleRow {
  Idn idn;
  uint8_t bytes;
  uint8_t mode;     ///< To the drive: controller mode that it allows.
  uint8_t received; ///< From it.
};
constexpr std::array<RoleRow, 7> kRoles = {{
    {idns::kPositionCommand, 4, kPositionControl, 0},
    {idns::kVelocityCommand, 4, kVelocityControl, 0},
    {idns::kTorqueCommand, 2, kTorqueControl, 0},
    {idns::kPositionFeedback1, 4, 0, cyclic::kPosition},
    {idns::kPositionFeedback2, 4, 0, 0},
    {idns::kVelocityFeedback, 4, 0, cyclic::kVelocity},
    {idns::kTorqueFeedback, 2, 0, cyclic::kTorque},
}};

uint8_t bytesOf(Idn idn) {
  for (const RoleRow &row : kRoles)
    if (row.idn == idn)
      return row.bytes;
  return 4;
}

void addAll(std::span<const CyclicObject> objects, CyclicRecord &record, const char *key,
            std::vector<std::string> &errors) {
  for (const CyclicObject &object : objects) {
    const IdnText text = idnText(object.idn);
    const std::string name(text.begin(), text.end());
    if (record.carries(object.idn))
      errors.push_back("`" + name + "` in `" + key + "` travels already");
    else if (!record.add(object))
      errors.push_back("`" + name + "` in `" + key + "`: a telegram has 8 objects at most");
  }
}

/// wCyclicDataS1 … or wCyclicDataR1 ….
void addConfigurable(std::span<const uint16_t> numbers, CyclicRecord &record,
                     std::vector<std::string> &errors) {
  for (const uint16_t number : numbers) {
    if (number == 0)
      continue;
    const auto *const row = std::find_if(
        kData.begin(), kData.end(), [number](const DataRow &one) { return one.number == number; });
    if (row == kData.end())
      errors.emplace_back("the standard has no IDN for currents and for what is user-defined: name "
                          "that of the drive in `additional` or `additional_sent`");
    else
      (void)record.add({row->idn, row->bytes});
  }
}

void judge(CyclicPlan &plan) {
  for (const CyclicObject &object : plan.mdt.objects())
    for (const RoleRow &row : kRoles)
      if (row.idn == object.idn && row.mode != 0)
        plan.controllerModes = static_cast<uint8_t>(plan.controllerModes | 1U << row.mode);
  for (const CyclicObject &object : plan.at.objects())
    for (const RoleRow &row : kRoles)
      if (row.idn == object.idn)
        plan.received = static_cast<uint8_t>(plan.received | row.received);
}

} // namespace

uint32_t CyclicRecord::bytes() const {
  uint32_t sum = kHeadBytes;
  for (const CyclicObject &object : objects())
    sum += object.bytes;
  return sum;
}

uint32_t CyclicRecord::placeOf(Idn idn) const {
  uint32_t place = kHeadBytes;
  for (const CyclicObject &object : objects()) {
    if (object.idn == idn)
      return place;
    place += object.bytes;
  }
  return 0;
}

bool CyclicRecord::add(const CyclicObject &object) {
  if (count_ == objects_.size())
    return false;
  objects_[count_++] = object;
  return true;
}

CyclicPlan planCyclic(const CyclicWish &wish, std::vector<std::string> &errors) {
  CyclicPlan plan;
  const bool configurable = wish.controlType == 0;
  const bool own = wish.io || configurable || !wish.more.empty() || !wish.moreSent.empty();
  // The numbers of wControlType are those of the standard telegrams.
  plan.telegramType = own ? kApplicationTelegram : wish.controlType;
  if (!wish.io && !configurable) {
    const TelegramContents contents = standardTelegram(wish.controlType);
    for (const Idn idn : contents.mdt)
      (void)plan.mdt.add({idn, bytesOf(idn)});
    for (const Idn idn : contents.at)
      (void)plan.at.add({idn, bytesOf(idn)});
  } else if (!wish.io) {
    addConfigurable(wish.send, plan.mdt, errors);
    addConfigurable(wish.receive, plan.at, errors);
  }
  addAll(wish.moreSent, plan.mdt, "additional_sent", errors);
  addAll(wish.more, plan.at, "additional", errors);
  judge(plan);
  return plan;
}

} // namespace stride::sercos
