#include "compiler/codegen/description.hpp"

#ifndef STRIDE_VERSION
#define STRIDE_VERSION "0.1.0"
#endif

namespace stc::codegen {

namespace {

/// The areas of the process image for the description.
std::string image(const Program &program) {
  std::string out = "{";
  for (size_t area = 0; area < 3; ++area) {
    const uint32_t bytes = program.image.bytes[area];
    out += area == 0 ? "{" : ", {";
    out += bytes == 0 ? std::string("0, 0}")
                      : std::string("offsetof(App__, image__") + "iqm"[area] + "), " +
                            std::to_string(bytes) + "}";
  }
  return out + "}";
}

void field(std::string &out, std::string_view name, std::string_view value) {
  out.append("    .").append(name).append(" = ").append(value).append(",\n");
}
void field(std::string &out, std::string_view name, size_t value) {
  field(out, name, std::to_string(value));
}
/// A table, null where it has no rows.
void table(std::string &out, std::string_view name, size_t rows, std::string_view table) {
  field(out, name, rows == 0 ? "nullptr" : table);
}
void text(std::string &out, std::string_view name, std::string_view text) {
  field(out, name, text.empty() ? "nullptr" : "\"" + escaped(text) + "\"");
}

void describeApplication(std::string &out, const Described &app) {
  field(out, "abiVersion", "::stride::kAbiVersion");
  field(out, "magic", "::stride::kAbiMagic");
  field(out, "size", "sizeof(::stride::StrideAppV1)");
  field(out, "flags", "0");
  field(out, "name", "\"" + escaped(app.config.name) + "\"");
  field(out, "compiler", "\"Stride " STRIDE_VERSION "\"");
  field(out, "buildHash", "0");
  field(out, "stateSize", "sizeof(App__)");
  field(out, "stateAlign", "alignof(App__)");
  field(out, "reserved", "0");
  field(out, "init", "init__");
  field(out, "exit", app.hasExit ? "exit__" : "nullptr");
  field(out, "reinit", app.hasReinit ? "reinit__" : "nullptr");
}

void describeTables(std::string &out, const Described &app) {
  for (const char *name : {"types", "members", "enumerators", "roots"})
    field(out, name, "nullptr");
  table(out, "tasks", app.config.tasks.size(), "kTasks");
  table(out, "axisGroups", app.plc.groups(), "kAxisGroups");
  table(out, "drives", app.plc.drives(), "kDrives");
  field(out, "files", "nullptr");
  for (const char *name : {"typeCount", "memberCount", "enumeratorCount", "rootCount"})
    field(out, name, "0");
  field(out, "taskCount", app.config.tasks.size());
  field(out, "axisGroupCount", app.plc.groups());
  field(out, "driveCount", app.plc.drives());
  field(out, "fileCount", "0");
  field(out, "axisRefLayout", std::to_string(app.plc.axisLayout()) + "ULL");
  field(out, "axisGroupRefLayout", std::to_string(app.plc.groupLayout()) + "ULL");
}

void describeConfiguration(std::string &out, const Described &app) {
  static constexpr std::string_view kAddressing[] = {"Units", "Bytes", "Words"};
  const size_t imageUses = app.program.sharing.imageUses.size();
  field(out, "image", image(app.program));
  field(out, "imageAddressing",
        "::stride::ImageAddressing::" +
            std::string(kAddressing[static_cast<size_t>(app.program.settings.addressing)]));
  field(out, "reserved2", "0");
  text(out, "retainFile", app.config.retainFile);
  field(out, "retainPeriodNs", std::to_string(app.config.retainPeriodNs));
  table(out, "imageUses", imageUses, "kImageUses");
  field(out, "imageUseCount", imageUses);
  table(out, "ioDevices", app.plc.ioDevices(), "kIoDevices");
  field(out, "ioDeviceCount", app.plc.ioDevices());
  table(out, "parameters", app.plc.parameters(), "kParameters");
  table(out, "buses", app.config.buses.size(), "kBuses");
  table(out, "encoders", app.plc.encoders(), "kEncoders");
  field(out, "parameterCount", app.plc.parameters());
  field(out, "busCount", app.config.buses.size());
  field(out, "encoderCount", app.plc.encoders());
  field(out, "bootupErrorLength", app.bootupErrorLength);
  field(out, "bootupErrorOffset", app.bootupErrorOffset);
  field(out, "encoderRefLayout", std::to_string(app.plc.encoderLayout()) + "ULL");
  field(out, "settle", app.hasCopies ? "settle__" : "nullptr");
  text(out, "filesRoot", app.config.filesRoot);
  field(out, "filesAnywhere", app.config.filesAnywhere ? "1" : "0");
  field(out, "filesDelay", std::to_string(app.config.filesDelay));
  table(out, "units", app.config.units.size(), "kUnits");
  field(out, "unitCount", app.config.units.size());
  field(out, "reserved3", "0");
  field(out, "symbols", app.types.empty() ? "nullptr" : "&kSymbols");
}

} // namespace

std::string description(const Described &app) {
  // Its members in their order.
  std::string out = "\nnamespace st::user {\n\n/// Completed by build.cpp.\nextern const "
                    "::stride::StrideAppV1 application__;\n"
                    "const ::stride::StrideAppV1 application__ = {\n";
  describeApplication(out, app);
  describeTables(out, app);
  describeConfiguration(out, app);
  return out + "};\n\n} // namespace st::user\n";
}

} // namespace stc::codegen
