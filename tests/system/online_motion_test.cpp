// Online change while an axis moves: set points must be those of an uninterrupted run, bit for bit.
#include "live_application.hpp"

#include "drivers/dummy/dummy_drive.hpp"
#include "runtime/bus/drive_group.hpp"

#include <gmock/gmock-matchers.h>

#include <bit>
#include <fstream>

namespace stride::test {
namespace {

namespace fs = std::filesystem;

/// The first axis group of an application, as the host runs it.
class Group final : public Around {
public:
  explicit Group(app::Application &application)
      : group_(dummy::makeDriver(
                   dummy::plainSetup(application.description().axisGroups[0].driveCount)),
               ref(application), axes(application),
               static_cast<double>(application.description().tasks[0].intervalNs) * 1e-9),
        application_(&application) {}

  void moved(app::Application &application) {
    group_.rebind(ref(application));
    const std::vector<axis::AxisRef *> moved = axes(application);
    for (size_t i = 0; i < moved.size(); ++i)
      group_.rebind(i, *moved[i]);
    application_ = &application;
  }
  void before() override { group_.executeStart(); }
  void after() override {
    group_.executeEnd();
    const axis::AxisRef &axis = *axes(*application_)[0];
    trace.push_back({std::bit_cast<uint64_t>(axis.fSetPosition),
                     std::bit_cast<uint64_t>(axis.fSetVelocity),
                     std::bit_cast<uint64_t>(axis.fSetAcceleration),
                     std::bit_cast<uint64_t>(axis.fActPosition)});
    fastest = std::max(fastest, axis.fSetVelocity);
  }

  std::vector<std::array<uint64_t, 4>> trace;
  double fastest = 0;

private:
  static bus::AxisGroupRef &ref(app::Application &application) {
    return *reinterpret_cast<bus::AxisGroupRef *>(
        application.state() + application.description().axisGroups[0].groupOffset);
  }
  static std::vector<axis::AxisRef *> axes(app::Application &application) {
    std::vector<axis::AxisRef *> out;
    for (uint32_t i = 0; i < application.description().driveCount; ++i)
      out.push_back(reinterpret_cast<axis::AxisRef *>(
          application.state() + application.description().drives[i].axisOffset));
    return out;
  }
  bus::DriveGroup group_;
  app::Application *application_;
};

/// The example with an unrelated change before everything.
std::string changedExample(const ScratchDirectory &scratch) {
  const fs::path folder = scratch.path() / "changed";
  fs::copy(STRIDE_SOURCE_DIR "/examples/PLCopenSingle", folder);
  std::string text = readFile(folder / "Ipo.st");
  const auto at = text.find("VAR\n") + 4;
  text.insert(at, "  unrelated : ARRAY[1..13] OF LREAL;\n  timer : TON;\n");
  const auto body = text.find("IF NOT Init");
  text.insert(body, "timer(IN := TRUE, PT := T#1s);\nunrelated[3] := unrelated[3] + 1.5;\n");
  writeFile(folder / "Ipo.st", text);
  writeFile(folder / "A.st", "VAR_GLOBAL first : ARRAY[0..99] OF DINT; END_VAR\n");
  return folder.string();
}

TEST(OnlineMotion, AMoveGoesOnBitForBit) {
  const std::string example = STRIDE_SOURCE_DIR "/examples/PLCopenSingle";
  ScratchDirectory scratch;
  const std::string changed = changedExample(scratch);
  Live without(example);
  Group reference(without.application());
  without.around = &reference;
  without.run(900);
  EXPECT_GT(reference.fastest, 50.0);

  // while powering up, accelerating, at constant speed, braking, and at rest
  for (const int cycle : {4, 100, 350, 500, 800}) {
    Live live(example);
    Group group(live.application());
    live.around = &group;
    live.run(cycle);
    live.change(changed);
    EXPECT_EQ(live.verdict, app::Verdict::Silent) << live.report;
    EXPECT_TRUE(live.events.empty());
    group.moved(live.application());
    live.run(900 - cycle);
    ASSERT_EQ(group.trace.size(), reference.trace.size());
    for (size_t i = 0; i < group.trace.size(); ++i)
      ASSERT_EQ(group.trace[i], reference.trace[i])
          << "change in cycle " << cycle << ", cycle " << i;
    EXPECT_EQ(live["Ipo.MoveAbsolute.Done"], without["Ipo.MoveAbsolute.Done"]);
  }
}

TEST(OnlineMotion, AnotherConfigurationIsRefused) {
  ScratchDirectory scratch;
  const fs::path folder = scratch.path() / "other";
  fs::copy(STRIDE_SOURCE_DIR "/examples/PLCopenSingle", folder);
  std::string text = readFile(folder / "stride.toml");
  text += "\n    [[bus.axis_group.drive]]\n    name = \"Second\"\n    wDriveId = 2\n"
          "    iMovementType = \"linear\"\n    dwRatioTechUnitsDenom = 10000\n";
  writeFile(folder / "stride.toml", text);
  Live live(STRIDE_SOURCE_DIR "/examples/PLCopenSingle");
  EXPECT_THROW(live.change(folder.string()), std::runtime_error);
  EXPECT_EQ(live.verdict, app::Verdict::Refused);
  EXPECT_THAT(live.report,
              ::testing::HasSubstr("axis group AxisGroup has other drives in the new build"));
}

} // namespace
} // namespace stride::test
