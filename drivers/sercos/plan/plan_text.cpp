// What a ring exchanges, for people.

#include "drivers/sercos/plan/group_plan.hpp"

#include <algorithm>

namespace stride::sercos {
namespace {

std::string wide(std::string text, size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text + "  ";
}

std::string contentOf(const CyclicRecord &record) {
  std::string text;
  for (const CyclicObject &object : record.objects()) {
    const IdnText name = idnText(object.idn);
    text += (text.empty() ? "" : ", ") + std::string(name.begin(), name.end());
  }
  return text.empty() ? "-" : text;
}

} // namespace

bus::GroupPlanText describeGroup(const bus::GroupSetup &setup) {
  const GroupPlan plan = planGroup(setup);
  bus::GroupPlanText result;
  std::string &text = result.text;
  text = setup.name + ": Sercos, " + std::to_string(plan.megabits) + " MBit/s, cycle " +
         std::to_string(plan.cycle) + " us\n";
  size_t width = 5;
  for (const bus::DriveSetup &drive : setup.drives)
    width = std::max(width, drive.name.size());
  text += "  " + wide("drive", width) + "address  type  MDT  AT  commands -> feedback\n";
  for (size_t i = 0; i < plan.drives.size(); ++i) {
    const CyclicPlan &cyclic = plan.drives[i].cyclic;
    text += "  " + wide(setup.drives[i].name, width);
    if (!plan.faults[i].empty()) {
      text += plan.faults[i] + "\n";
      continue;
    }
    text +=
        wide(std::to_string(setup.drives[i].id), 7) + wide(std::to_string(cyclic.telegramType), 4) +
        wide(std::to_string(cyclic.mdt.bytes()), 3) + wide(std::to_string(cyclic.at.bytes()), 2) +
        contentOf(cyclic.mdt) + " -> " + contentOf(cyclic.at) + "\n";
  }
  if (!plan.fault.empty())
    text += "  " + plan.fault + "\n";
  else
    text += "  MDT of " + std::to_string(plan.timing.mdtLength) + " bytes at " +
            std::to_string(plan.timing.mdtStart) + " us; the telegrams need " +
            std::to_string(plan.timing.neededUs) + " us\n";
  return result;
}

} // namespace stride::sercos
