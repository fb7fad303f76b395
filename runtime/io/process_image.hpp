// The process image and the devices: what is copied around the cycles of a task.
#ifndef STRIDE_RUNTIME_IO_PROCESS_IMAGE_HPP
#define STRIDE_RUNTIME_IO_PROCESS_IMAGE_HPP

#include "runtime/app/abi.h"
#include "runtime/io/io_driver.hpp"
#include "runtime/task/cycle_hook.hpp"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace stride::io {

/// The variable of a device in ST (IO_DEVICE).
struct IoDeviceState {
  BOOL bFault; ///< Set by the program or --set: the device counts as lost.
  BOOL bLost;
  UDINT udiLosses;
};

/// A device while the application runs; all tasks that use it share it.
struct IoDevice {
  std::string name;
  std::unique_ptr<IoDriver> driver;
  bool external = true; ///< IoSchema::external.
  uint32_t index = 0;   ///< Into StrideAppV1::ioDevices.
  uint32_t inputBytes = 0;
  uint32_t outputBytes = 0;
  std::vector<BYTE> held; ///< Outputs as they were when STOP began.
  std::string lostText;   ///< To be shown.
  std::atomic<bool> lost{false};
  std::atomic<uint32_t> losses{0}; ///< While it runs.
  uint32_t told = 0;               ///< Losses that were shown.
};

/// What comes from outside passes here on its way into the program: a recording notes it, a replay
/// puts the noted values in its place. Neither allocates, locks nor throws.
class InputPass {
public:
  InputPass() = default;
  InputPass(const InputPass &) = delete;
  InputPass &operator=(const InputPass &) = delete;
  virtual ~InputPass() = default;
  virtual void pass(void *value, size_t size) noexcept = 0;
};

/// Copies bytes so that whoever reads values of up to 8 bytes at aligned places meanwhile sees none
/// in halves.
void copyWhole(BYTE *to, const BYTE *from, size_t count) noexcept;

/// In the cycles of one task: copies the input bytes it uses from the devices before its POUs, and
/// the output bytes it writes to them after. In this order lies the place for forces: they apply
/// to the image after the copy of the inputs and before that of the outputs, in a hook that is
/// added after this one.
///
/// In STOP inputs go on, and outputs do not follow the image: they have their safe values or, where
/// IoDeviceDesc::holdsInStop says so, those that they had when STOP began. The image stays.
class ImageHook final : public task::CycleHook {
public:
  /// `devices` in the order of app.ioDevices; they live as long as the hook. The first task that
  /// runs by itself also watches over the devices and has the outputs that no task writes.
  ImageHook(const StrideAppV1 &app, std::byte *state, uint32_t task,
            const std::vector<std::unique_ptr<IoDevice>> &devices, InputPass &inputs);

  void beforePous(Ctx &ctx) override;
  void afterPous(Ctx &ctx) override;
  void applicationStopped() override;
  void modeChanged(task::OperatingMode mode) override;
  void prepareRebind(const StrideAppV1 &app) override;
  void rebind(const StrideAppV1 &app, std::byte *state) noexcept override;
  std::vector<std::string> takeNews() override;
  std::string problem() const override;

private:
  /// Bytes of one device that this task reads or writes.
  struct Part {
    IoDevice *device;
    bool output;
    uint32_t imageByte;
    uint32_t deviceByte;
    uint32_t count;
    bool safe = false; ///< The image has the safe values of inputs.
  };
  std::vector<Part> partsIn(const StrideAppV1 &app) const;
  BYTE *image(const Part &part) const;
  IoDeviceState &stateOf(const IoDevice &device) const;
  void watch(Ctx &ctx, IoDevice &device);
  void writeSafe(const Part &part) noexcept;
  void writePart(const Part &part) noexcept;

  bool read(const Part &part) noexcept;

  const StrideAppV1 *app_;
  std::byte *state_;
  InputPass *inputs_;
  uint32_t task_;
  bool leads_;
  std::vector<IoDevice *> devices_;
  std::vector<Part> parts_;
  std::vector<Part> nextParts_; ///< Of the build that prepareRebind() was told of.
  std::vector<BYTE> buffer_;
  bool stopped_ = false;
  bool inStop_ = false;
};

} // namespace stride::io

#endif
