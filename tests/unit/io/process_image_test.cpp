#include "drivers/io/simulated_io.hpp"
#include "runtime/io/process_image.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace stride::io {
namespace {

struct State {
  alignas(8) std::array<BYTE, 8> inputs{};
  alignas(8) std::array<BYTE, 8> outputs{};
  IoDeviceState device{};
};

/// Two tasks: the first one reads inputs 0 to 3 and writes output 0, the second one reads input 2
/// and writes outputs 2 and 3. Nobody writes output 1.
class Image : public ::testing::Test {
protected:
  Image() {
    tasks_[0].kind = TaskKind::Event;
    tasks_[1].kind = TaskKind::Cyclic;
    device_.name = "D";
    device_.driverName = "Simulated";
    device_.stateOffset = offsetof(State, device);
    device_.inputCount = 4;
    device_.outputCount = 4;
    device_.safeOutputs = safe_.data();
    app_.image[kImageInput] = {offsetof(State, inputs), 8};
    app_.image[kImageOutput] = {offsetof(State, outputs), 8};
    app_.tasks = tasks_.data();
    app_.taskCount = 2;
    app_.imageUses = uses_.data();
    app_.imageUseCount = static_cast<uint32_t>(uses_.size());
    app_.ioDevices = &device_;
    app_.ioDeviceCount = 1;
    devices_.push_back(std::make_unique<IoDevice>());
    IoSettings settings;
    settings.inputBytes = settings.outputBytes = 4;
    settings.parameters.add({"loop_back", "", 1});
    devices_[0]->driver = simulated::makeDriver(settings);
    devices_[0]->external = false;
    devices_[0]->inputBytes = devices_[0]->outputBytes = 4;
    devices_[0]->lostText = "lost";
    for (uint32_t task = 0; task < 2; ++task)
      hooks_.push_back(std::make_unique<ImageHook>(app_, reinterpret_cast<std::byte *>(&state_),
                                                   task, devices_, live_));
  }

  struct Live final : InputPass {
    void pass(void *, size_t) noexcept override {}
  };

  std::array<uint8_t, 4> safe_{0x80, 0x81, 0x82, 0x83};
  std::array<TaskDesc, 2> tasks_{};
  std::array<ImageUseDesc, 4> uses_{{{0, kImageInput, 0, 0, 4},
                                     {0, kImageOutput, 1, 0, 1},
                                     {1, kImageInput, 0, 2, 1},
                                     {1, kImageOutput, 1, 2, 2}}};
  IoDeviceDesc device_{};
  StrideAppV1 app_{};
  State state_;
  Live live_;
  std::vector<std::unique_ptr<IoDevice>> devices_;
  std::vector<std::unique_ptr<ImageHook>> hooks_;
  Ctx ctx_{};
};

TEST_F(Image, EachTaskCopiesItsBytes) {
  state_.outputs = {1, 2, 3, 4, 5, 6, 7, 8};
  hooks_[0]->afterPous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 0, 0, 0, 0, 0, 0, 0}));
  hooks_[1]->afterPous(ctx_); // also the byte that nobody writes: it is the first cyclic task
  hooks_[1]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 0, 3, 0, 0, 0, 0, 0}));
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 2, 3, 4, 0, 0, 0, 0}));
}

TEST_F(Image, StopGivesSafeValuesByTask) {
  state_.outputs = {1, 2, 3, 4, 5, 6, 7, 8};
  hooks_[0]->afterPous(ctx_);
  hooks_[1]->afterPous(ctx_);
  hooks_[1]->applicationStopped();
  hooks_[1]->afterPous(ctx_); // the POUs run no more; the safe values stay
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 0x81, 0x82, 0x83, 0, 0, 0, 0}));
  hooks_[0]->applicationStopped();
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs[0], 0x80);
  EXPECT_EQ(state_.outputs, (std::array<BYTE, 8>{0x80, 0x81, 0x82, 0x83, 5, 6, 7, 8}))
      << "the image shows what the device has";
}

/// Inputs go on; the image keeps what the programs have written, and they find it there again.
TEST_F(Image, FallbackInStop) {
  state_.outputs = {1, 2, 3, 4, 5, 6, 7, 8};
  hooks_[0]->afterPous(ctx_);
  hooks_[1]->afterPous(ctx_);
  for (const auto &hook : hooks_) {
    hook->modeChanged(task::OperatingMode::Stop);
    hook->afterPous(ctx_);
  }
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{0x80, 0x81, 0x82, 0x83, 0, 0, 0, 0}));
  EXPECT_EQ(state_.outputs, (std::array<BYTE, 8>{1, 2, 3, 4, 5, 6, 7, 8}));
  hooks_[1]->modeChanged(task::OperatingMode::Run);
  hooks_[1]->afterPous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{0x80, 2, 3, 4, 0, 0, 0, 0})) << "by task";
  hooks_[0]->modeChanged(task::OperatingMode::Run);
  hooks_[0]->afterPous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 2, 3, 4, 0, 0, 0, 0}));
}

TEST_F(Image, HoldInStop) {
  device_.holdsInStop = 1;
  state_.outputs = {1, 2, 3, 4, 5, 6, 7, 8};
  hooks_[0]->afterPous(ctx_);
  hooks_[1]->afterPous(ctx_);
  hooks_[0]->modeChanged(task::OperatingMode::Stop);
  hooks_[1]->modeChanged(task::OperatingMode::Stop);
  state_.outputs = {9, 9, 9, 9, 9, 9, 9, 9}; // by a force
  hooks_[0]->afterPous(ctx_);
  hooks_[1]->afterPous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 2, 3, 4, 0, 0, 0, 0}));
  state_.device.bFault = 1; // a lost device gets its safe values, also when it comes back
  hooks_[1]->beforePous(ctx_);
  hooks_[1]->afterPous(ctx_);
  state_.device.bFault = 0;
  hooks_[1]->beforePous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 0x81, 0x82, 0x83, 0, 0, 0, 0}));
  hooks_[1]->afterPous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 2, 3, 4, 0, 0, 0, 0})) << "held again";
  hooks_[1]->applicationStopped();
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 0x81, 0x82, 0x83, 0, 0, 0, 0}))
      << "the end lets go";
}

TEST_F(Image, LostDevice) {
  state_.outputs = {1, 2, 3, 4, 5, 6, 7, 8};
  hooks_[0]->afterPous(ctx_);
  hooks_[1]->afterPous(ctx_);
  hooks_[0]->beforePous(ctx_);
  state_.device.bFault = 1;
  hooks_[1]->beforePous(ctx_); // watches
  EXPECT_EQ(state_.device.bLost, 1);
  EXPECT_EQ(state_.device.udiLosses, 1U);
  EXPECT_EQ(hooks_[1]->problem(), "lost");
  EXPECT_EQ(hooks_[1]->takeNews(), std::vector<std::string>{"lost"});
  EXPECT_TRUE(hooks_[1]->takeNews().empty());
  EXPECT_EQ(hooks_[1]->problem(), ""); // it has been said
  state_.outputs = {9, 9, 9, 9, 9, 9, 9, 9};
  hooks_[0]->afterPous(ctx_);
  hooks_[1]->afterPous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{1, 2, 3, 4, 0, 0, 0, 0})) << "inputs stay";
  state_.device.bFault = 0;
  hooks_[1]->beforePous(ctx_);
  EXPECT_EQ(state_.device.bLost, 0);
  EXPECT_EQ(hooks_[1]->problem(), "");
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{0x80, 0x81, 0x82, 0x83, 0, 0, 0, 0}));
}

TEST_F(Image, AnotherBuildUsesOtherBytes) {
  std::array<ImageUseDesc, 1> uses{{{0, kImageInput, 0, 3, 1}}};
  StrideAppV1 other = app_;
  other.imageUses = uses.data();
  other.imageUseCount = 1;
  State moved;
  moved.outputs = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const std::unique_ptr<ImageHook> &hook : hooks_)
    hook->prepareRebind(other);
  for (const std::unique_ptr<ImageHook> &hook : hooks_)
    hook->rebind(other, reinterpret_cast<std::byte *>(&moved));
  hooks_[1]->afterPous(ctx_); // nobody writes outputs now
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(moved.inputs, (std::array<BYTE, 8>{0, 0, 0, 4, 0, 0, 0, 0}));
  hooks_[1]->beforePous(ctx_); // nobody reads the others
  EXPECT_EQ(moved.inputs, (std::array<BYTE, 8>{1, 2, 3, 4, 0, 0, 0, 0}));
}

/// A device that is lost, and what of the image it takes for values of an operator.
class LostKeys final : public IoDriver {
public:
  explicit LostKeys(std::vector<BYTE> &sensed) : sensed_(&sensed) {}
  bool works(int64_t) noexcept override { return false; }
  void sense(uint32_t, std::span<const BYTE> image) noexcept override {
    sensed_->assign(image.begin(), image.end());
  }
  bool read(uint32_t, std::span<BYTE>) noexcept override { return false; }
  void write(uint32_t, std::span<const BYTE>) noexcept override {}

private:
  std::vector<BYTE> *sensed_;
};

TEST_F(Image, SafeValuesAreNobodys) {
  std::vector<BYTE> sensed;
  device_.safeInputs = safe_.data();
  devices_[0]->driver = std::make_unique<LostKeys>(sensed);
  state_.inputs = {1, 2, 3, 4, 5, 6, 7, 8};
  hooks_[1]->beforePous(ctx_); // watches
  hooks_[0]->beforePous(ctx_);
  EXPECT_EQ(sensed, (std::vector<BYTE>{3})) << "not what the other task has put there";
  EXPECT_EQ(state_.inputs, (std::array<BYTE, 8>{0x80, 0x81, 0x82, 0x83, 5, 6, 7, 8}));
  sensed.clear();
  StrideAppV1 other = app_;
  State moved = state_;
  for (const std::unique_ptr<ImageHook> &hook : hooks_)
    hook->prepareRebind(other);
  for (const std::unique_ptr<ImageHook> &hook : hooks_)
    hook->rebind(other, reinterpret_cast<std::byte *>(&moved));
  hooks_[1]->beforePous(ctx_);
  hooks_[0]->beforePous(ctx_);
  EXPECT_TRUE(sensed.empty()) << "nor what an online change took over";
}

TEST(CopyWhole, AnyPlaceAndLength) {
  alignas(8) std::array<BYTE, 32> from{};
  for (size_t i = 0; i < from.size(); ++i)
    from[i] = static_cast<BYTE>(i + 1);
  for (size_t place = 0; place < 9; ++place) {
    for (size_t count = 0; count < 20; ++count) {
      alignas(8) std::array<BYTE, 32> to{};
      copyWhole(to.data() + place, from.data() + 3, count);
      for (size_t i = 0; i < to.size(); ++i)
        EXPECT_EQ(to[i], i >= place && i < place + count ? from[3 + i - place] : 0);
    }
  }
}

TEST(SimulatedIo, Delay) {
  IoSettings settings;
  settings.inputBytes = settings.outputBytes = 1;
  settings.parameters.add({"loop_back", "", 1});
  settings.parameters.add({"delay", "", 2});
  const std::unique_ptr<IoDriver> io = simulated::makeDriver(settings);
  BYTE in = 99;
  for (BYTE n = 1; n < 10; ++n) {
    io->write(0, {&n, 1});
    ASSERT_TRUE(io->read(0, {&in, 1}));
    EXPECT_EQ(in, n < 3 ? 0 : n - 2);
  }
}

} // namespace
} // namespace stride::io
