// `stride can`

#include "compiler/cli/can_command.hpp"

#include "compiler/assets/eds/device.hpp"
#include "compiler/cli/run_project.hpp"
#include "compiler/project/driver_sections.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/installation.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/source/render.hpp"
#include "compiler/source/sources.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

namespace {

constexpr uintmax_t kMostBytes = uintmax_t{16} << 20;

/// Writes what a plan brings for other tools. False: it is said why not.
bool writeFiles(const stride::bus::GroupPlanText &plan, const std::string &folder) {
  for (const stride::bus::GroupPlanText::File &file : plan.files)
    if (const std::filesystem::path path = std::filesystem::path(folder) / file.name;
        !writeFile(path, file.bytes)) {
      showError(Code::CannotWrite,
                fmt::format("`{}` cannot be written: {}", path.string(), std::strerror(errno)));
      return false;
    }
  return true;
}

// ---- import

bool has(const eds::Device &device, uint16_t index) { return device.find(index, 0) != nullptr; }

bool isMappable(const eds::Device &device, uint16_t index) {
  const eds::Object *object = device.find(index, 0);
  return object != nullptr && object->mappable;
}

/// A name for ST, made of that of the product.
std::string identifierOf(const std::string &text) {
  std::string name;
  for (const char c : text)
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  while (!name.empty() && name.back() == '_')
    name.pop_back();
  return name.empty() || (name.front() >= '0' && name.front() <= '9') ? "Drive" : name;
}

// A device may be several drives, whose objects lie 800h apart. [CiA 301, logical devices]
constexpr uint16_t kProfile = 0x6000;
constexpr uint16_t kAxisObjects = 0x0800;
constexpr int kMostAxes = 8;

/// Objects of an axis.
uint16_t ofAxis(uint16_t index, int axis) {
  return static_cast<uint16_t>(index + kAxisObjects * axis);
}

/// -1: of none.
int axisOf(uint16_t index) { return index < kProfile ? -1 : (index - kProfile) / kAxisObjects; }

/// The axes that have a controlword; a device without any is taken for one drive.
std::vector<int> axesOf(const eds::Device &device) {
  std::vector<int> axes;
  for (int axis = 0; axis < kMostAxes; ++axis)
    if (has(device, ofAxis(0x6040, axis)))
      axes.push_back(axis);
  return axes.empty() ? std::vector<int>{0} : axes;
}

/// What the driver must know of an axis of the device, as rows of its section.
std::string settingsOfDrive(const eds::Device &device, int axis, bool first) {
  std::string text;
  const std::vector<eds::Pdo> pdos = eds::pdosOf(device);
  if (isMappable(device, ofAxis(0x60FD, axis)))
    text += "inputs = true                      # limit and home switches by 60FDh\n";
  if (first && !device.find(0x1017, 0))
    text += "guard = \"T#100ms\"                  # it has no heartbeat (1017h)\n";
  if (!has(device, ofAxis(0x6098, axis)))
    text += "homing = \"controller\"              # it has no homing mode (6098h)\n";
  if (has(device, ofAxis(0x60B8, axis))) {
    int inputs = 0;
    for (const int i : {0, 1, 2, 3})
      if (has(device, ofAxis(static_cast<uint16_t>(0x60BA + i), axis)))
        inputs += 1 << i;
    text += fmt::format("probe_inputs = {}                   # touch probes by 60B8h\n", inputs);
  }
  const bool events = std::any_of(pdos.begin(), pdos.end(), [](const eds::Pdo &pdo) {
    return pdo.transmit && pdo.hasEventTimer;
  });
  if (!events)
    text += "event_pdos = false                 # its PDOs have no event timer\n";
  return text;
}

/// Objects of the communication profile and those that the driver serves: their values are its
/// matter.
bool isDrivers(uint16_t index) {
  constexpr uint16_t kCommunicationEnd = 0x2000;
  if (const int axis = axisOf(index); axis > 0 && axis < kMostAxes)
    index = static_cast<uint16_t>(index - kAxisObjects * axis);
  return index < kCommunicationEnd || index == 0x6040 || index == 0x6041 || index == 0x6060 ||
         index == 0x6061 || index == 0x60C2;
}

/// "2031h:2 := UINT#500" for a value that a DCF has configured; empty: it cannot be in `startup`.
std::string startUpOf(const eds::Object &object, uint8_t node) {
  constexpr std::string_view kSigned[] = {"SINT", "INT", "DINT"};
  constexpr std::string_view kUnsigned[] = {"USINT", "UINT", "UDINT"};
  const unsigned bits = eds::bitsOf(object.type);
  if (!object.configured || !object.isWritable() || isDrivers(object.index) ||
      object.configured->isText || !eds::isWhole(object.type) ||
      (bits != 8 && bits != 16 && bits != 32))
    return {};
  const size_t place = bits == 8 ? 0 : bits == 16 ? 1 : 2;
  const std::string_view type = eds::isSigned(object.type) ? kSigned[place] : kUnsigned[place];
  const std::string sub = object.sub != 0 ? fmt::format(":{}", object.sub) : std::string();
  return fmt::format("{:04X}h{} := {}#{}", object.index, sub, type, object.configured->in(node));
}

/// The values of a DCF as `startup`, a line each; empty: it has none. Those of no axis, or of one
/// that is no drive, are the first drive's.
std::string startUpList(const eds::Device &device, uint8_t node, size_t place, size_t &others) {
  std::string text;
  const std::vector<int> axes = axesOf(device);
  for (const eds::Object &object : device.objects) {
    const auto owner = std::find(axes.begin(), axes.end(), axisOf(object.index));
    if ((owner == axes.end() ? 0 : static_cast<size_t>(owner - axes.begin())) != place)
      continue;
    const std::string one = startUpOf(object, node);
    others += one.empty() && object.configured ? 1 : 0;
    if (!one.empty())
      text += fmt::format("  \"{}\",{}\n", one,
                          object.name.empty() ? "" : "  # " + visible(object.name));
  }
  return text.empty() ? text : "startup = [\n" + text + "]\n";
}

/// What may keep the device from being used, as comments.
std::string remarksOf(const eds::Device &device) {
  std::string text;
  const eds::Object *type = device.find(0x1000, 0);
  if (type == nullptr || type->value() == nullptr || (type->value()->number & 0xFFFF) != 402)
    text += "# 1000h does not say that this is a drive (402).\n";
  if (!isMappable(device, 0x607A))
    text += "# 607Ah (target position) cannot be mapped: CSP and IP are out of reach.\n";
  if (!has(device, 0x60C2))
    text += "# Without 60C2h the drive does not know the cycle: set it with the maker's tool.\n";
  if (!device.find(0x1016, 1))
    text += "# Without 1016h the drive does not notice when the master is gone.\n";
  for (const eds::Pdo &pdo : eds::pdosOf(device))
    if (pdo.fixedMapping)
      text += fmt::format("# The mapping of {}PDO {} is fixed.\n", pdo.transmit ? "T" : "R",
                          pdo.number);
  if (!has(device, 0x606C))
    text += "# There is no 606Ch: velocity_scale has no effect.\n";
  else
    text += "# velocity_scale: increments per second that one unit of 606Ch is; see the maker's "
            "manual.\n";
  return text;
}

/// The section of an axis of the device, by its place among them.
std::string driveSection(const eds::Device &device, const std::string &name, int node,
                         size_t place) {
  const int axis = axesOf(device)[place];
  std::string text =
      fmt::format("[[bus.axis_group.drive]]\nname = \"{}\"\nwDriveId = {}\n", name, node);
  if (axis > 0)
    text += fmt::format("axis = {}\n", axis);
  text += settingsOfDrive(device, axis, place == 0);
  size_t others = 0;
  text += startUpList(device, static_cast<uint8_t>(node), place, others);
  if (others != 0)
    text +=
        fmt::format("# Not in this section: {} configured value{} of the file: the driver's own "
                    "matter (PDOs, heartbeats), or no whole numbers of up to 32 bits.\n",
                    others, others == 1 ? "" : "s");
  const eds::Identity &identity = device.identity;
  if (place == 0 && identity.vendor != 0) {
    text += "\n[bus.axis_group.drive.identity]\n";
    text += fmt::format("vendor = {}\n", identity.vendor);
    if (identity.product != 0)
      text += fmt::format("product = {}\n", identity.product);
  }
  return text;
}

/// Drives that are the same node.
std::string furtherAxes(const eds::Device &device, const std::string &name, int node) {
  std::string text;
  const std::vector<int> axes = axesOf(device);
  for (size_t place = 1; place < axes.size(); ++place)
    text += "\n" + driveSection(device, fmt::format("{}_{}", name, axes[place]), node, place);
  return text;
}

std::string sectionOf(const eds::Device &device, const CanOptions &can) {
  const std::string name = can.name.empty() ? identifierOf(device.identity.productName) : can.name;
  const int node = can.node != 0 ? can.node : device.nodeId ? *device.nodeId : 1;
  std::string text =
      fmt::format("# {}{}{}\n", device.identity.vendorName,
                  device.identity.vendorName.empty() ? "" : ", ", device.identity.productName);
  text += remarksOf(device);
  text += driveSection(device, name, node, 0);
  return text + furtherAxes(device, name, node);
}

} // namespace

int canPlanCommand(const ProjectOptions &options, const CanOptions &can) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const Project project(options.path, Purpose::Check, settingsOf(options), index);
  const int code = show(project.diagnostics(), project.sources(), options.output);
  size_t shown = 0;
  for (const stride::bus::GroupPlanText &plan : busPlans(project.config())) {
    print((shown++ == 0 ? "" : "\n") + plan.text);
    if (!can.dcf.empty() && !writeFiles(plan, can.dcf))
      return 1;
  }
  if (shown == 0 && code == 0)
    print("This project has no axis group on CAN.\n");
  return code;
}

int canImportCommand(const CanOptions &can) {
  const std::optional<std::string> text = readRegularFile(can.file, kMostBytes);
  if (!text)
    return showError(Code::UnreadableFile,
                     fmt::format("`{}` cannot be read: {}", can.file, readSourceError(kMostBytes)));
  std::string ending = std::filesystem::path(can.file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(c | 0x20); });
  const bool isXml = ending == ".xdd" || ending == ".xdc";
  const eds::Device device = isXml ? eds::readXdd(*text) : eds::readEds(*text);
  for (const eds::Note &note : device.notes)
    std::fprintf(
        stderr, "note: %s: %s\n",
        visible(note.line == 0 ? can.file : fmt::format("{}:{}", can.file, note.line)).c_str(),
        visible(note.text).c_str());
  if (device.moreNotes != 0)
    std::fprintf(stderr, "note: and %zu more\n", device.moreNotes);
  if (device.objects.empty())
    return showError(Code::UnreadableFile,
                     fmt::format("`{}` is no electronic data sheet: it has no objects", can.file));
  const std::string section = sectionOf(device, can);
  if (can.out.empty()) {
    print(section);
    return 0;
  }
  if (writeFile(can.out, section))
    return 0;
  return showError(Code::CannotWrite,
                   fmt::format("`{}` cannot be written: {}", can.out, std::strerror(errno)));
}

int becomeCanTool(std::vector<std::string> arguments) {
  std::string missing;
  const std::optional<Installation> installation = findInstallation(missing);
  const std::string program = installation ? installation->canTool.string() : missing;
  arguments.insert(arguments.begin(), "stride can"); // whose part it is, for its messages
  return become(program, std::move(arguments), {});
}

int canProjectCommand(const std::string &command, const ProjectOptions &options,
                      std::vector<std::string> before, std::vector<std::string> after) {
  int exitCode = 0;
  const std::optional<BuildResult> result = buildToRun(options, BuildUse::RunOnce, exitCode, {});
  if (!result)
    return exitCode;
  std::vector<std::string> arguments = {command};
  arguments.insert(arguments.end(), before.begin(), before.end());
  arguments.push_back(result->runnable.string());
  arguments.insert(arguments.end(), after.begin(), after.end());
  return becomeCanTool(std::move(arguments));
}

} // namespace stc::cli
