#include "compiler/codegen/plc_tables.hpp"

#include "compiler/source/identifier.hpp"

#include <charconv>

namespace stc::codegen {

namespace {

/// Shortest decimal that reads back as the same number.
std::string numberText(double value) {
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
  return {std::begin(text), end};
}

} // namespace

PlcTables::PlcTables(Context &context, const AppConfig &config, FindGlobal find)
    : c_(context), config_(config), find_(std::move(find)) {}

void PlcTables::write() {
  addBuses();
  addAxisGroups();
  addIoDevices();
  std::string units;
  for (const AppConfig::TechnicalUnit &one : config_.units)
    units += "    {\"" + escaped(one.variable) + "\", \"" + escaped(one.unit) + "\"},\n";
  addTable("{variable, unit}", "UnitDesc", "kUnits", units);
  addTable("{name, text, number}", "ParameterDesc", "kParameters", parameters_);
  addTable("{name, interfaceType, driverName, firstParameter, parameterCount}", "BusDesc", "kBuses",
           buses_);
  addTable("{name, axisOffset, driveId, 0, dataOffset, dataLayout, firstParameter, parameterCount}",
           "DriveDesc", "kDrives", drives_);
  addTable("{name, encoderOffset, encoderId, firstParameter, parameterCount, 0}", "EncoderDesc",
           "kEncoders", encoders_);
  addTable("{name, busName, driverName, groupOffset, task, cycleUs, firstDrive, driveCount, bus, "
           "firstEncoder, encoderCount, firstParameter, parameterCount}",
           "AxisGroupDesc", "kAxisGroups", groupRows_);
  if (!ioRows_.empty())
    text_ += "\n" + ioBytes_ +
             "// {name, driverName, stateOffset, inputFirst, inputCount, outputFirst, outputCount, "
             "safeOutputs,\n// safeInputs, firstParameter, parameterCount, holdsInStop}\n"
             "constexpr ::stride::IoDeviceDesc kIoDevices[] = {\n" +
             ioRows_ + "};\n";
}

void PlcTables::addTable(const char *columns, const char *type, const char *name,
                         const std::string &rows) {
  if (!rows.empty())
    text_ += std::string("\n// ") + columns + "\nconstexpr ::stride::" + type + " " + name +
             "[] = {\n" + rows + "};\n";
}

/// Appends parameters to their table; returns "first, count".
std::string PlcTables::addParameters(const std::vector<ConfigParameter> &list) {
  const size_t first = parameterCount_;
  for (const ConfigParameter &parameter : list) {
    parameters_ += "    {\"" + escaped(parameter.name) + "\", " +
                   (parameter.text.empty() ? "nullptr" : "\"" + escaped(parameter.text) + "\"") +
                   ", " + numberText(parameter.number) + "},\n";
    ++parameterCount_;
  }
  return std::to_string(first) + ", " + std::to_string(list.size());
}

void PlcTables::addDrive(const AppConfig::Drive &drive) {
  const auto [v, axis] = find_(drive.name);
  if (v == nullptr)
    return;
  axisLayout_ = c_.layouts.hash(v->type);
  std::string data = "0, 0";
  const auto [own, ownPlace] = drive.data.empty() ? PlacedVariable{} : find_(drive.data);
  if (own != nullptr)
    data =
        "offsetof(App__, " + ownPlace + "), " + std::to_string(c_.layouts.hash(own->type)) + "ULL";
  drives_ += "    {\"" + escaped(drive.name) + "\", offsetof(App__, " + axis + "), " +
             std::to_string(drive.id) + ", 0, " + data + ", " + addParameters(drive.parameters) +
             "},\n";
  ++driveCount_;
}

void PlcTables::addEncoder(const AppConfig::Encoder &encoder) {
  const auto [v, place] = find_(encoder.name);
  if (v == nullptr)
    return;
  encoderLayout_ = c_.layouts.hash(v->type);
  encoders_ += "    {\"" + escaped(encoder.name) + "\", offsetof(App__, " + place + "), " +
               std::to_string(encoder.id) + ", " + addParameters(encoder.parameters) + ", 0},\n";
  ++encoderCount_;
}

void PlcTables::addBuses() {
  for (const AppConfig::Bus &bus : config_.buses)
    buses_ += "    {\"" + escaped(bus.name) + "\", \"" + escaped(bus.interfaceType) + "\", \"" +
              escaped(bus.driver) + "\", " + addParameters(bus.parameters) + "},\n";
}

void PlcTables::addAxisGroups() {
  for (const AppConfig::AxisGroup &group : config_.axisGroups) {
    const auto [variable, place] = find_(group.name);
    if (variable == nullptr)
      continue;
    groupLayout_ = c_.layouts.hash(variable->type);
    const size_t firstDrive = driveCount_;
    for (const AppConfig::Drive &one : group.drives)
      addDrive(one);
    const size_t firstEncoder = encoderCount_;
    for (const AppConfig::Encoder &one : group.encoders)
      addEncoder(one);
    std::string task = "::stride::kNoIndex";
    for (size_t i = 0; i < config_.tasks.size(); ++i) {
      if (equalIgnoringCase(config_.tasks[i].name, group.task))
        task = std::to_string(i);
    }
    const auto [own, ownPlace] = group.data.empty() ? PlacedVariable{} : find_(group.data);
    const std::string data = own == nullptr
                                 ? "0, 0"
                                 : "offsetof(App__, " + ownPlace + "), " +
                                       std::to_string(c_.layouts.hash(own->type)) + "ULL";
    const AppConfig::Bus &bus = config_.buses[group.bus];
    groupRows_ += "    {\"" + escaped(group.name) + "\", \"" + escaped(bus.name) + "\", \"" +
                  escaped(bus.driver) + "\", offsetof(App__, " + place + "), " + task + ", " +
                  std::to_string(group.cycleUs) + ", " + std::to_string(firstDrive) + ", " +
                  std::to_string(driveCount_ - firstDrive) + ", " + std::to_string(group.bus) +
                  ", " + std::to_string(firstEncoder) + ", " +
                  std::to_string(encoderCount_ - firstEncoder) + ", " +
                  addParameters(group.parameters) + ", " + data + "},\n";
    ++groupCount_;
  }
}

void PlcTables::addIoDevices() {
  for (const AppConfig::IoDevice &device : config_.ioDevices) {
    const auto [variable, place] = find_(device.name);
    if (variable == nullptr)
      continue;
    const std::string number = std::to_string(ioCount_++);
    const auto table = [&](const char *name, const std::vector<uint8_t> &values) {
      if (values.empty())
        return std::string("nullptr");
      std::string constant = name + number;
      ioBytes_ += "constexpr uint8_t " + constant + "[] = {";
      for (size_t i = 0; i < values.size(); ++i)
        ioBytes_ += (i == 0 ? "" : ", ") + std::to_string(values[i]);
      ioBytes_ += "};\n";
      return constant;
    };
    const std::string outputs = table("kSafeOutputs", device.safeOutputs);
    const std::string inputs = table("kSafeInputs", device.safeInputs);
    ioRows_ += "    {\"" + escaped(device.name) + "\", \"" + escaped(device.driver) +
               "\", offsetof(App__, " + place + "), " + std::to_string(device.inputFirst) + ", " +
               std::to_string(device.inputCount) + ", " + std::to_string(device.outputFirst) +
               ", " + std::to_string(device.outputCount) + ", " + outputs + ", " + inputs + ", " +
               addParameters(device.parameters) + (device.holdsInStop ? ", 1" : "") + "},\n";
  }
}

} // namespace stc::codegen
