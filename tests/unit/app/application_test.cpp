#include "tests/unit/app/fixture.hpp"

#include <cstdint>

namespace {

using stride::StrideAppV1;
using stride::app::Application;
using stride::app::RuntimeLayouts;
using ::testing::HasSubstr;

class ApplicationTest : public stride::test::HandmadeApp {
protected:
  static std::string loadError(const std::string &path) {
    return errorOf([&] { (void)Application::load(path); });
  }
  template <class F> static std::string errorAfter(F change, const RuntimeLayouts &layouts = {}) {
    StrideAppV1 description = *stride_app_v1();
    change(description);
    return errorOf([&] { (void)Application::fromDescription(description, layouts); });
  }
};

TEST_F(ApplicationTest, LoadsASharedObject) {
  Application loaded = Application::load(STRIDE_HANDMADE_APP);
  loaded.initialise(stride::test::kThrowingHost);
  EXPECT_STREQ(loaded.description().name, "handmade");
  const stride::app::SymbolTable table(loaded.description());
  const stride::app::Symbol step = table.resolve("PLC_PRG.fb.step");
  EXPECT_EQ(*static_cast<int16_t *>(step.address(loaded.state())), 1);
  EXPECT_NE(loaded.state(), application.state()) << "two applications do not meet";
}

TEST_F(ApplicationTest, ExceptionsCrossTheSharedObject) {
  Application loaded = Application::load(STRIDE_HANDMADE_APP);
  loaded.initialise(stride::test::kThrowingHost);
  const stride::app::SymbolTable table(loaded.description());
  *static_cast<int16_t *>(table.resolve("PLC_PRG.divisor").address(loaded.state())) = 0;
  stride::Ctx ctx{};
  ctx.state = loaded.state();
  ctx.host = &stride::test::kThrowingHost;
  try {
    loaded.description().tasks[0].run(&ctx);
    FAIL() << "no exception";
  } catch (const stride::StException &exception) {
    EXPECT_EQ(exception.code(), stride::ExceptionCode::DivisionByZero);
    EXPECT_STREQ(exception.file(), "src/plc_prg.st");
    EXPECT_EQ(exception.line(), 38U);
    EXPECT_EQ(exception.column(), 21U);
  }
}

TEST_F(ApplicationTest, StateIsZeroedBelowFourGiB) {
  EXPECT_TRUE(application.stateBlock().belowFourGiB());
  write("PLC_PRG.count", "5");
  write("PLC_PRG.name", "'other'");
  application.initialise(stride::test::kThrowingHost);
  EXPECT_EQ(read("PLC_PRG.count"), "0");
  EXPECT_EQ(read("PLC_PRG.name"), "'it$'s'");
}

TEST_F(ApplicationTest, AddressesRepeat) {
  const stride::app::StateBlock first(1 << 20);
  const std::byte *place = first.data();
  stride::app::StateBlock again;
  {
    stride::app::StateBlock second(1 << 20);
    EXPECT_NE(second.data(), place);
    again = std::move(second);
  }
  const std::byte *secondPlace = again.data();
  again = stride::app::StateBlock();
  EXPECT_EQ(stride::app::StateBlock(1 << 20).data(), secondPlace);
}

TEST_F(ApplicationTest, FilesThatAreNoApplications) {
  EXPECT_THAT(loadError("/nonexistent/app.so"), HasSubstr("cannot open application"));
  EXPECT_THAT(loadError("/"), HasSubstr("is not a file"));
  EXPECT_THAT(loadError(STRIDE_SOURCE_DIR "/LICENSE"), HasSubstr("is not a loadable application"));
  EXPECT_THAT(loadError(STRIDE_NOT_AN_APP), HasSubstr("does not define stride_app_v1"));
}

TEST_F(ApplicationTest, DescriptionsThatDoNotFit) {
  EXPECT_THAT(
      errorAfter([](StrideAppV1 &d) { d.abiVersion = 99; }),
      HasSubstr("interface version 99, this runtime needs " + std::to_string(stride::kAbiVersion)));
  EXPECT_THAT(errorAfter([](StrideAppV1 &d) { d.magic = 0; }),
              HasSubstr("not a Stride application"));
  EXPECT_THAT(errorAfter([](StrideAppV1 &d) { d.axisRefLayout = 1; }, RuntimeLayouts{2, 0}),
              HasSubstr("another layout of AXIS_REF"));
  EXPECT_THAT(errorAfter([](StrideAppV1 &d) { d.axisGroupRefLayout = 1; }, RuntimeLayouts{0, 2}),
              HasSubstr("another layout of SMC_AXISGROUP_REF"));
  EXPECT_THAT(errorAfter([](StrideAppV1 &d) { d.stateSize = 8; }), HasSubstr("damaged"));
  EXPECT_THAT(errorAfter([](StrideAppV1 &d) { d.memberCount = 3; }), HasSubstr("damaged"));
  EXPECT_THAT(errorAfter([](StrideAppV1 &d) { d.typeCount = 2; }), HasSubstr("damaged"));
  EXPECT_EQ(errorAfter([](StrideAppV1 &) {}, RuntimeLayouts{7, 7}), "no error");
}

} // namespace
