#include "runtime/io/process_image.hpp"

#include <algorithm>

namespace stride::io {

namespace {

template <class T> void copyOne(BYTE *to, const BYTE *from) noexcept {
  T value;
  __builtin_memcpy(&value, from, sizeof(T));
  __atomic_store_n(reinterpret_cast<T *>(to), value, __ATOMIC_RELAXED);
}

/// The task that the devices' states belong to: the first one that needs no event.
uint32_t leader(const StrideAppV1 &app) {
  for (uint32_t i = 0; i < app.taskCount; ++i) {
    if (app.tasks[i].kind == TaskKind::Cyclic || app.tasks[i].kind == TaskKind::Freewheeling)
      return i;
  }
  return 0;
}

/// What the compiler has found.
bool uses(const StrideAppV1 &app, uint32_t task, bool output, uint32_t byte) {
  return std::any_of(
      app.imageUses, app.imageUses + app.imageUseCount, [&](const ImageUseDesc &use) {
        return use.task == task && byte - use.first < use.count &&
               use.area == (output ? kImageOutput : kImageInput) && (use.writes != 0) == output;
      });
}

bool isOwn(const StrideAppV1 &app, uint32_t task, bool leads, bool output, uint32_t byte) {
  if (uses(app, task, output, byte))
    return true;
  if (!leads)
    return false;
  for (uint32_t other = 0; other < app.taskCount; ++other) {
    if (uses(app, other, output, byte))
      return false;
  }
  return true;
}

} // namespace

void copyWhole(BYTE *to, const BYTE *from, size_t count) noexcept {
  while (count > 0) {
    const auto place = reinterpret_cast<uintptr_t>(to);
    size_t step = 1;
    if (place % 8 == 0 && count >= 8) {
      copyOne<uint64_t>(to, from);
      step = 8;
    } else if (place % 4 == 0 && count >= 4) {
      copyOne<uint32_t>(to, from);
      step = 4;
    } else if (place % 2 == 0 && count >= 2) {
      copyOne<uint16_t>(to, from);
      step = 2;
    } else {
      copyOne<uint8_t>(to, from);
    }
    to += step;
    from += step;
    count -= step;
  }
}

ImageHook::ImageHook(const StrideAppV1 &app, std::byte *state, uint32_t task,
                     const std::vector<std::unique_ptr<IoDevice>> &devices, InputPass &inputs)
    : app_(&app), state_(state), inputs_(&inputs), task_(task), leads_(task == leader(app)) {
  size_t largest = 0;
  for (const std::unique_ptr<IoDevice> &device : devices) {
    devices_.push_back(device.get());
    device->held.resize(device->outputBytes);
    largest = std::max<size_t>({largest, device->inputBytes, device->outputBytes});
  }
  buffer_.resize(largest);
  parts_ = partsIn(app);
}

/// Runs of bytes that this task copies: those that it uses, and for the leading task those that
/// none uses.
std::vector<ImageHook::Part> ImageHook::partsIn(const StrideAppV1 &app) const {
  std::vector<Part> parts;
  if (app.ioDeviceCount < devices_.size())
    return parts; // refused before: the devices of a running application stay
  for (IoDevice *device : devices_) {
    const IoDeviceDesc &desc = app.ioDevices[device->index];
    for (const bool output : {false, true}) {
      const uint32_t first = output ? desc.outputFirst : desc.inputFirst;
      const uint32_t count = output ? std::min(desc.outputCount, device->outputBytes)
                                    : std::min(desc.inputCount, device->inputBytes);
      const uint64_t area = app.image[output ? kImageOutput : kImageInput].size;
      const auto end = static_cast<uint32_t>(std::min<uint64_t>(uint64_t{first} + count, area));
      for (uint32_t byte = first; byte < end; ++byte) {
        const uint32_t begin = byte;
        while (byte < end && isOwn(app, task_, leads_, output, byte))
          ++byte;
        if (byte != begin)
          parts.push_back({device, output, begin, begin - first, byte - begin});
      }
    }
  }
  return parts;
}

BYTE *ImageHook::image(const Part &part) const {
  const ImageAreaDesc &area = app_->image[part.output ? kImageOutput : kImageInput];
  return reinterpret_cast<BYTE *>(state_ + area.offset) + part.imageByte;
}

IoDeviceState &ImageHook::stateOf(const IoDevice &device) const {
  return *reinterpret_cast<IoDeviceState *>(state_ + app_->ioDevices[device.index].stateOffset);
}

void ImageHook::watch(Ctx &ctx, IoDevice &device) {
  IoDeviceState &state = stateOf(device);
  const bool fault = __atomic_load_n(&state.bFault, __ATOMIC_RELAXED) != 0;
  const bool simulates = device.driver->simulateFault(fault);
  enum Condition : uint8_t { kLost, kWorks, kStarts };
  Condition condition = device.driver->works(ctx.cycleStartNs) ? kWorks
                        : device.driver->starts()              ? kStarts
                                                               : kLost;
  if (device.external)
    inputs_->pass(&condition, sizeof condition);
  const bool lost = (fault && !simulates) || condition != kWorks;
  const bool before = device.lost.exchange(lost, std::memory_order_relaxed);
  if (lost == before)
    return;
  __atomic_store_n(&state.bLost, static_cast<BOOL>(lost), __ATOMIC_RELAXED);
  if (!lost || condition == kStarts)
    return;
  __atomic_fetch_add(&state.udiLosses, 1U, __ATOMIC_RELAXED);
  device.losses.fetch_add(1, std::memory_order_relaxed);
}

/// Takes the bytes into the buffer; false: there are none.
bool ImageHook::read(const Part &part) noexcept {
  bool got = part.device->driver->read(part.deviceByte, {buffer_.data(), part.count});
  if (!part.device->external)
    return got;
  inputs_->pass(&got, sizeof got);
  if (got)
    inputs_->pass(buffer_.data(), part.count);
  return got;
}

void ImageHook::beforePous(Ctx &ctx) {
  for (IoDevice *device : devices_) {
    if (leads_)
      watch(ctx, *device);
  }
  for (Part &part : parts_) {
    if (part.output)
      continue;
    const IoDeviceDesc &desc = app_->ioDevices[part.device->index];
    BYTE *to = image(part);
    const bool lost = part.device->lost.load(std::memory_order_relaxed);
    // Safe values of a loss are nobody's. Where several tasks have a byte, the leading one, which
    // notices the loss, is the first to put them there.
    const bool becomesSafe = lost && desc.safeInputs != nullptr;
    if (!part.safe && (leads_ || !becomesSafe))
      part.device->driver->sense(part.deviceByte, {to, part.count});
    part.safe = becomesSafe;
    if (!lost) {
      if (read(part))
        copyWhole(to, buffer_.data(), part.count);
    } else if (part.safe) {
      copyWhole(to, desc.safeInputs + part.deviceByte, part.count);
    }
  }
}

void ImageHook::afterPous(Ctx &) {
  for (const Part &part : parts_) {
    if (part.output)
      writePart(part);
  }
}

void ImageHook::writePart(const Part &part) noexcept {
  const bool holds = app_->ioDevices[part.device->index].holdsInStop != 0;
  if (stopped_ || part.device->lost.load(std::memory_order_relaxed) || (inStop_ && !holds))
    writeSafe(part);
  else
    part.device->driver->write(
        part.deviceByte,
        {inStop_ ? part.device->held.data() + part.deviceByte : image(part), part.count});
}

/// A byte belongs to one task, also of what is held.
void ImageHook::modeChanged(task::OperatingMode mode) {
  inStop_ = mode == task::OperatingMode::Stop;
  for (const Part &part : parts_)
    if (part.output && inStop_)
      std::copy_n(image(part), part.count, part.device->held.begin() + part.deviceByte);
}

void ImageHook::writeSafe(const Part &part) noexcept {
  const BYTE *safe = app_->ioDevices[part.device->index].safeOutputs;
  if (safe == nullptr) {
    std::fill_n(buffer_.begin(), part.count, BYTE{0});
    safe = buffer_.data();
  } else {
    safe += part.deviceByte;
  }
  part.device->driver->write(part.deviceByte, {safe, part.count});
  if (stopped_) // nothing else writes it any more: it shows what the device has
    copyWhole(image(part), safe, part.count);
}

void ImageHook::applicationStopped() {
  stopped_ = true;
  for (const Part &part : parts_) {
    if (!part.output)
      continue;
    writeSafe(part);
    part.device->driver->stopped();
  }
}

void ImageHook::prepareRebind(const StrideAppV1 &app) { nextParts_ = partsIn(app); }

void ImageHook::rebind(const StrideAppV1 &app, std::byte *state) noexcept {
  app_ = &app;
  state_ = state;
  parts_.swap(nextParts_);
  for (Part &part : parts_) // what the image took over of a lost device is nobody's, either
    part.safe = !part.output && part.device->lost.load(std::memory_order_relaxed) &&
                app.ioDevices[part.device->index].safeInputs != nullptr;
}

std::vector<std::string> ImageHook::takeNews() {
  std::vector<std::string> news;
  for (IoDevice *device : devices_) {
    const uint32_t losses = device->losses.load(std::memory_order_relaxed);
    if (!leads_ || losses == device->told)
      continue;
    device->told = losses;
    news.push_back(device->lostText);
  }
  return news;
}

std::string ImageHook::problem() const {
  for (const IoDevice *device : devices_) {
    if (leads_ && device->lost.load(std::memory_order_relaxed) &&
        device->losses.load(std::memory_order_relaxed) != device->told)
      return device->lostText;
  }
  return {};
}

} // namespace stride::io
