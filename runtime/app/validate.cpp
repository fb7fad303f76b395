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

/// Of integers, with a base type that is none itself.
bool isSoundRange(const StrideAppV1 &app, const TypeDesc &type) {
  return type.kind >= Kind::SINT && type.kind <= Kind::LWORD && type.element < app.typeCount &&
         app.types[type.element].kind == type.kind &&
         (app.types[type.element].flags & kTypeRange) == 0 &&
         type.lowerBound <= static_cast<int64_t>(type.elementCount);
}

void checkType(const StrideAppV1 &app, uint32_t index) {
  const TypeDesc &type = app.types[index];
  const auto bad = [&](const char *what) {
    damaged(fmt::format("type {} '{}': {}", index, type.name != nullptr ? type.name : "", what));
  };
  if (type.name == nullptr)
    bad("no name");
  if ((type.flags & kTypeRange) != 0 && !isSoundRange(app, type))
    bad("range");
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

bool isSound(const StrideAppV1 &app, const RootDesc &root) {
  if (root.name == nullptr || root.type >= app.typeCount)
    return false;
  const uint64_t size = (root.flags & kSymSlot) != 0 ? sizeof(uint32_t) : app.types[root.type].size;
  return fits(root.offset, size, app.stateSize) &&
         (root.task == kNoIndex || root.task < app.taskCount);
}

bool isSound(const StrideAppV1 &app, const ImageUseDesc &use) {
  return use.task < app.taskCount && use.area <= kImageMemory &&
         fits(use.first, use.count, app.image[use.area].size);
}

bool isSound(const StrideAppV1 &app, const IoDeviceDesc &device) {
  return device.name != nullptr && device.driverName != nullptr &&
         fits(device.stateOffset, 8, app.stateSize) &&
         fits(device.firstParameter, device.parameterCount, app.parameterCount);
}

bool isSound(const StrideAppV1 &app, const TaskDesc &task) {
  return task.name != nullptr && task.run != nullptr && task.kind <= TaskKind::Status &&
         (task.sync == kNoIndex || task.sync < app.axisGroupCount);
}

bool isSound(const StrideAppV1 &app, const AxisGroupDesc &group) {
  return group.name != nullptr && group.driverName != nullptr && group.task < app.taskCount &&
         group.groupOffset < app.stateSize && group.dataOffset < app.stateSize &&
         fits(group.firstDrive, group.driveCount, app.driveCount) &&
         fits(group.firstEncoder, group.encoderCount, app.encoderCount) &&
         fits(group.firstParameter, group.parameterCount, app.parameterCount) &&
         (group.bus == kNoIndex || group.bus < app.busCount);
}

bool isSound(const StrideAppV1 &app, const DriveDesc &drive) {
  return drive.name != nullptr && drive.axisOffset < app.stateSize &&
         drive.dataOffset < app.stateSize &&
         fits(drive.firstParameter, drive.parameterCount, app.parameterCount);
}

bool isSound(const StrideAppV1 &app, const BusDesc &bus) {
  return bus.name != nullptr && bus.interfaceType != nullptr && bus.driverName != nullptr &&
         fits(bus.firstParameter, bus.parameterCount, app.parameterCount);
}

bool isSound(const StrideAppV1 &app, const EncoderDesc &encoder) {
  return encoder.name != nullptr && encoder.encoderOffset < app.stateSize &&
         fits(encoder.firstParameter, encoder.parameterCount, app.parameterCount);
}

bool isSound(const StrideAppV1 & /*app*/, const ParameterDesc &parameter) {
  return parameter.name != nullptr;
}

bool isSound(const StrideAppV1 & /*app*/, const UnitDesc &unit) {
  return unit.variable != nullptr && unit.unit != nullptr;
}

template <class Desc>
void checkAll(const StrideAppV1 &app, const Desc *list, uint32_t count, const char *what) {
  for (uint32_t i = 0; i < count; ++i)
    if (!isSound(app, list[i]))
      damaged(fmt::format("{} {}", what, i));
}

} // namespace

void checkHead(const StrideAppV1 &app, const RuntimeLayouts &layouts) {
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
}

void validate(const StrideAppV1 &app, const RuntimeLayouts &layouts) {
  checkHead(app, layouts);
  for (uint32_t i = 0; i < app.typeCount; ++i)
    checkType(app, i);
  checkAll(app, app.roots, app.rootCount, "variable");
  for (const ImageAreaDesc &area : app.image) {
    if (!fits(area.offset, area.size, app.stateSize))
      damaged("process image");
  }
  for (uint32_t i = 0; i < app.imageUseCount; ++i) {
    if (!isSound(app, app.imageUses[i]))
      damaged(fmt::format("use {} of the process image", i));
  }
  checkAll(app, app.ioDevices, app.ioDeviceCount, "I/O device");
  checkAll(app, app.tasks, app.taskCount, "task");
  checkAll(app, app.axisGroups, app.axisGroupCount, "axis group");
  checkAll(app, app.drives, app.driveCount, "drive");
  checkAll(app, app.buses, app.busCount, "bus");
  checkAll(app, app.encoders, app.encoderCount, "encoder");
  checkAll(app, app.parameters, app.parameterCount, "parameter");
  checkAll(app, app.units, app.unitCount, "unit");
  if (!fits(app.bootupErrorOffset, uint64_t{app.bootupErrorLength} + 1, app.stateSize) &&
      app.bootupErrorLength != 0)
    damaged("g_strBootupError");
}

} // namespace stride::app
