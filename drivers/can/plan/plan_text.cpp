// What `stride can plan` shows.

#include "drivers/can/plan/group_plan.hpp"

#include <algorithm>
#include <array>

namespace stride::can {
namespace {

std::string hexadecimal(uint32_t value, size_t digits) {
  std::string text;
  for (size_t i = digits; i-- > 0;)
    text += "0123456789ABCDEF"[value >> 4 * i & 0xF];
  return text + "h";
}

/// With blanks to its right.
std::string wide(std::string text, size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text + "  ";
}

std::string contentOf(const Pdo &pdo, uint8_t axis) {
  std::string text;
  for (const PdoEntry &entry : pdo.mapped()) {
    text += (text.empty() ? "" : ", ") + hexadecimal(ofAxis(entry.object, axis).index, 4);
    if (entry.object.sub != 0)
      text += ":" + std::to_string(entry.object.sub);
    if (const std::string_view name = nameOf(signalOf(entry.object)); !name.empty())
      text += " " + std::string(name);
  }
  return text;
}

struct Widths {
  size_t drive = 5;
  size_t pdo = 5; ///< "RPDO1", of a further axis "RPDO65".
};

std::string row(const Widths &widths, const std::string &drive, const std::string &node,
                const std::string &pdo, const std::string &id, const std::string &when,
                const std::string &bytes, const std::string &bits, const std::string &content) {
  return "  " + wide(drive, widths.drive) + wide(node, 4) + wide(pdo, widths.pdo) + wide(id, 6) +
         wide(when, 5) + wide(bytes, 5) + wide(bits, 4) + content + "\n";
}

void addRows(const Widths &widths, const std::string &drive, const DrivePlan &plan,
             std::string &text) {
  const auto add = [&](const Pdo &pdo, const char *kind) {
    text += row(widths, drive, std::to_string(plan.node), kind + std::to_string(pdo.number),
                hexadecimal(pdo.cobId, 3), pdo.synchronous() ? "SYNC" : "event",
                std::to_string(pdo.length()),
                pdo.synchronous() ? std::to_string(worstBits(pdo.length())) : "-",
                contentOf(pdo, plan.axis));
  };
  for (const Pdo &pdo : plan.receivedByDrive())
    add(pdo, "RPDO");
  for (const Pdo &pdo : plan.sentByDrive())
    add(pdo, "TPDO");
}

/// A longer one byte by byte, as it travels.
std::string valueText(const SdoWrite &write) {
  if (write.bytes.empty())
    return hexadecimal(write.value, size_t{2} * write.size);
  std::string text;
  for (const uint8_t byte : write.bytes)
    text += (text.empty() ? "" : " ") + hexadecimal(byte, 2);
  return text;
}

void addStartUp(const Widths &widths, const std::string &drive, uint8_t node,
                std::span<const SdoWrite> writes, std::string &text) {
  for (const SdoWrite &write : writes) {
    std::string content = hexadecimal(write.object.index, 4);
    if (write.object.sub != 0)
      content += ":" + std::to_string(write.object.sub);
    content += " := " + valueText(write);
    text += row(widths, drive, std::to_string(node), "SDO", "-", "start",
                std::to_string(write.length()), "-", content);
  }
}

/// Its start-up values included, and its concise DCF.
void addEncoder(const Widths &widths, const std::string &name, const EncoderPlan &encoder,
                bus::GroupPlanText &result) {
  addRows(widths, name, encoder.plan, result.text);
  addStartUp(widths, name, encoder.plan.node, encoder.startup, result.text);
  std::vector<SdoWrite> writes = pdoWrites(encoder.plan);
  writes.insert(writes.end(), encoder.startup.begin(), encoder.startup.end());
  const std::vector<uint8_t> dcf = conciseDcf(writes);
  result.files.push_back({name + ".cdcf", std::string(dcf.begin(), dcf.end())});
}

/// Their start-up values included, and a concise DCF for each.
void addIos(const bus::GroupSetup &setup, const GroupPlan &plan, const Widths &widths,
            bus::GroupPlanText &result) {
  for (size_t i = 0; i < plan.ios.size(); ++i) {
    const IoPlan &io = plan.ios[i];
    const std::string &name = setup.ios[i].name;
    if (!io.fault.empty()) {
      result.text += "  " + wide(name, widths.drive) + io.fault + "\n";
      continue;
    }
    addRows(widths, name, io.plan, result.text);
    addStartUp(widths, name, io.plan.node, io.startup, result.text);
    std::vector<SdoWrite> writes = pdoWrites(io.plan);
    writes.insert(writes.end(), io.startup.begin(), io.startup.end());
    const std::vector<uint8_t> dcf = conciseDcf(writes);
    result.files.push_back({name + ".cdcf", std::string(dcf.begin(), dcf.end())});
  }
}

std::string_view producerText(SyncProducer producer) {
  switch (producer) {
  case SyncProducer::FirstDrive:
    return "SYNC by the first drive";
  case SyncProducer::Device:
    return "SYNC by node 127";
  case SyncProducer::Master:
    break;
  }
  return "SYNC by the PLC";
}

} // namespace

bus::GroupPlanText describeGroup(const bus::GroupSetup &setup) {
  const GroupPlan plan = planGroup(setup);
  bus::GroupPlanText result;
  std::string &text = result.text;
  text = setup.name + ": " + std::to_string(plan.bitRate) + " kBit/s, cycle " +
         milliseconds(plan.cycle) + ", " + std::string(producerText(plan.sync)) + "\n";
  Widths widths;
  for (const bus::DriveSetup &drive : setup.drives)
    widths.drive = std::max(widths.drive, drive.name.size());
  for (const bus::EncoderSetup &encoder : setup.encoders)
    widths.drive = std::max(widths.drive, encoder.name.size());
  for (const bus::IoSetup &io : setup.ios)
    widths.drive = std::max(widths.drive, io.name.size());
  for (const PlanResult &drive : plan.drives)
    if (drive.plan.axis > 0)
      widths.pdo = 7;
  text += row(widths, plan.ios.empty() ? "drive" : "name", "node", "PDO", "COB-ID", "when", "bytes",
              "bits", "content");
  for (size_t i = 0; i < plan.drives.size(); ++i) {
    const std::string &name = setup.drives[i].name;
    if (!plan.faults[i].empty()) {
      text += "  " + wide(name, widths.drive) + plan.faults[i] + "\n";
      continue;
    }
    addRows(widths, name, plan.drives[i].plan, text);
    const std::vector<SdoWrite> &startup = plan.settings[i].startup;
    addStartUp(widths, name, plan.drives[i].plan.node, startup, text);
    std::vector<SdoWrite> writes = pdoWrites(plan.drives[i].plan);
    writes.insert(writes.end(), startup.begin(), startup.end());
    const std::vector<uint8_t> dcf = conciseDcf(writes);
    result.files.push_back({name + ".cdcf", std::string(dcf.begin(), dcf.end())});
  }
  addIos(setup, plan, widths, result);
  for (size_t i = 0; i < plan.encoders.size(); ++i) {
    const EncoderPlan &encoder = plan.encoders[i];
    const std::string &name = setup.encoders[i].name;
    if (!encoder.fault.empty())
      text += "  " + wide(name, widths.drive) + encoder.fault + "\n";
    else if (encoder.drive == EncoderPlan::kNode)
      addEncoder(widths, name, encoder, result);
  }
  const uint64_t room = uint64_t{plan.bitRate} * plan.cycle / 1000;
  text += "  " + std::to_string(plan.load.bits) + " of " + std::to_string(room) +
          " bits with SYNC in the worst case: " + percent(plan.load.share) + "; shortest cycle " +
          milliseconds(plan.load.shortestCycle) + "; room for " +
          std::to_string(plan.load.sdoPerCycle) + (plan.load.sdoPerCycle == 1 ? " SDO" : " SDOs") +
          " in each cycle\n";
  return result;
}

} // namespace stride::can
