#include "runtime/app/validate.hpp"

#include "runtime/app/error.hpp"

#include <fmt/format.h>

namespace stride::app {

namespace {

[[noreturn]] void damaged(const std::string &what) {
  throw Error(fmt::format("its description is damaged ({}); build it again", what));
}

bool fits(uint64_t first, uint64_t count, uint64_t size) {
  return first <= size && count <= size - first;
}

void checkType(const StrideAppV1 &app, uint32_t index) {
  const TypeDesc &type = app.types[index];
  const auto bad = [&](const char *what) {
    damaged(fmt::format("type {} '{}': {}", index, type.name != nullptr ? type.name : "", what));
  };
  if (type.name == nullptr)
    bad("no name");
  switch (type.kind) {
  case Kind::Struct:
  case Kind::Union:
  case Kind::FunctionBlock:
  case Kind::Program:
    if (!fits(type.firstMember, type.memberCount, app.memberCount))
      bad("members");
    for (uint32_t i = 0; i < type.memberCount; ++i) {
      const MemberDesc &member = app.members[type.firstMember + i];
      if (member.name == nullptr || member.type >= app.typeCount)
        bad("a member");
      const bool located = (member.flags & kSymLocated) != 0;
      const uint64_t size =
          (member.flags & kSymSlot) != 0 ? sizeof(uint32_t) : app.types[member.type].size;
      if (!fits(member.offset, size, located ? app.stateSize : type.size))
        bad("a member");
    }
    break;
  case Kind::Enum:
    if (!fits(type.firstMember, type.memberCount, app.enumeratorCount))
      bad("enumerators");
    if (type.element >= app.typeCount || app.types[type.element].size != type.size)
      bad("base type");
    break;
  case Kind::Array:
    if (type.element >= app.typeCount || type.elementCount == 0 ||
        type.size / type.elementCount != app.types[type.element].size)
      bad("element type");
    break;
  case Kind::Pointer:
  case Kind::Reference:
  case Kind::InOut:
    if (type.element != kNoIndex && type.element >= app.typeCount)
      bad("target type");
    break;
  case Kind::STRING:
    if (type.size != uint64_t{type.stringLength} + 1)
      bad("length");
    break;
  case Kind::WSTRING:
    if (type.size != (uint64_t{type.stringLength} + 1) * 2)
      bad("length");
    break;
  default:
    break;
  }
}

void checkLayout(const char *type, uint64_t ours, uint64_t theirs) {
  if (ours != 0 && theirs != 0 && ours != theirs)
    throw Error(fmt::format("it was built with another layout of {} than this runtime has; build "
                            "it again with this version of Stride",
                            type));
}

} // namespace

void validate(const StrideAppV1 &app, const RuntimeLayouts &layouts) {
  // The first two members stay where they are in every version.
  if (app.magic != kAbiMagic)
    throw Error("it is not a Stride application (its description starts with other data)");
  if (app.abiVersion != kAbiVersion)
    throw Error(fmt::format("it has application interface version {}, this runtime needs {}; build "
                            "it again with this version of Stride",
                            app.abiVersion, kAbiVersion));
  if (app.size < sizeof(StrideAppV1))
    damaged("size");
  checkLayout("AXIS_REF", layouts.axisRef, app.axisRefLayout);
  checkLayout("SMC_AXISGROUP_REF", layouts.axisGroupRef, app.axisGroupRefLayout);
  checkLayout("SMC_ENCODER_REF", layouts.encoderRef, app.encoderRefLayout);
  if (app.init == nullptr)
    damaged("no initialisation");
  if (app.stateAlign > 4096)
    damaged("alignment");
  for (uint32_t i = 0; i < app.typeCount; ++i)
    checkType(app, i);
  for (uint32_t i = 0; i < app.rootCount; ++i) {
    const RootDesc &root = app.roots[i];
    if (root.name == nullptr || root.type >= app.typeCount ||
        !fits(root.offset,
              (root.flags & kSymSlot) != 0 ? sizeof(uint32_t) : app.types[root.type].size,
              app.stateSize) ||
        (root.task != kNoIndex && root.task >= app.taskCount))
      damaged(fmt::format("variable {}", i));
  }
  for (const ImageAreaDesc &area : app.image) {
    if (!fits(area.offset, area.size, app.stateSize))
      damaged("process image");
  }
  for (uint32_t i = 0; i < app.imageUseCount; ++i) {
    const ImageUseDesc &use = app.imageUses[i];
    if (use.task >= app.taskCount || use.area > kImageMemory ||
        !fits(use.first, use.count, app.image[use.area].size))
      damaged(fmt::format("use {} of the process image", i));
  }
  for (uint32_t i = 0; i < app.ioDeviceCount; ++i) {
    const IoDeviceDesc &device = app.ioDevices[i];
    if (device.name == nullptr || device.driverName == nullptr ||
        !fits(device.stateOffset, 8, app.stateSize) ||
        !fits(device.firstParameter, device.parameterCount, app.parameterCount))
      damaged(fmt::format("I/O device {}", i));
  }
  for (uint32_t i = 0; i < app.taskCount; ++i) {
    const TaskDesc &task = app.tasks[i];
    if (task.name == nullptr || task.run == nullptr || task.kind > TaskKind::Status ||
        (task.sync != kNoIndex && task.sync >= app.axisGroupCount))
      damaged(fmt::format("task {}", i));
  }
  for (uint32_t i = 0; i < app.axisGroupCount; ++i) {
    const AxisGroupDesc &group = app.axisGroups[i];
    if (group.name == nullptr || group.driverName == nullptr || group.task >= app.taskCount ||
        group.groupOffset >= app.stateSize ||
        !fits(group.firstDrive, group.driveCount, app.driveCount) ||
        !fits(group.firstEncoder, group.encoderCount, app.encoderCount) ||
        !fits(group.firstParameter, group.parameterCount, app.parameterCount) ||
        (group.bus != kNoIndex && group.bus >= app.busCount))
      damaged(fmt::format("axis group {}", i));
  }
  for (uint32_t i = 0; i < app.driveCount; ++i) {
    const DriveDesc &drive = app.drives[i];
    if (drive.name == nullptr || drive.axisOffset >= app.stateSize ||
        drive.dataOffset >= app.stateSize ||
        !fits(drive.firstParameter, drive.parameterCount, app.parameterCount))
      damaged(fmt::format("drive {}", i));
  }
  for (uint32_t i = 0; i < app.busCount; ++i) {
    const BusDesc &bus = app.buses[i];
    if (bus.name == nullptr || bus.interfaceType == nullptr || bus.driverName == nullptr ||
        !fits(bus.firstParameter, bus.parameterCount, app.parameterCount))
      damaged(fmt::format("bus {}", i));
  }
  for (uint32_t i = 0; i < app.encoderCount; ++i) {
    const EncoderDesc &encoder = app.encoders[i];
    if (encoder.name == nullptr || encoder.encoderOffset >= app.stateSize ||
        !fits(encoder.firstParameter, encoder.parameterCount, app.parameterCount))
      damaged(fmt::format("encoder {}", i));
  }
  for (uint32_t i = 0; i < app.parameterCount; ++i) {
    if (app.parameters[i].name == nullptr)
      damaged(fmt::format("parameter {}", i));
  }
  if (!fits(app.bootupErrorOffset, uint64_t{app.bootupErrorLength} + 1, app.stateSize) &&
      app.bootupErrorLength != 0)
    damaged("g_strBootupError");
}

} // namespace stride::app
