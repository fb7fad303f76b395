// What `stride can scan` shows of the errors of a node.
#include "drivers/can/tool/node_errors.hpp"

#include <gmock/gmock-more-matchers.h>
#include <gtest/gtest.h>

#include <map>

namespace stride::can::tool {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A node that has these objects, by index * 256 + subindex, least byte first.
class Errors : public ::testing::Test {
protected:
  std::vector<std::string> lines() {
    return errorLines([this](Object object) {
      Transfer result;
      const auto found = objects.find(uint32_t{object.index} << 8U | object.sub);
      result.done = found != objects.end();
      result.abort = result.done ? 0 : 0x06020000;
      if (result.done)
        result.bytes = found->second;
      asked.push_back(object.index);
      return result;
    });
  }
  std::map<uint32_t, std::vector<uint8_t>> objects;
  std::vector<uint16_t> asked;
};

TEST_F(Errors, ANodeWithoutErrorsIsAskedOnce) {
  objects = {{0x100100, {0}}, {0x100300, {1}}, {0x100301, {0x30, 0x81, 0, 0}}};
  EXPECT_THAT(lines(), IsEmpty()) << "what is in the list only is over";
  EXPECT_THAT(asked, ElementsAre(0x1001));
}

TEST_F(Errors, ANodeWithoutARegister) { EXPECT_THAT(lines(), IsEmpty()); }

TEST_F(Errors, ANodeWithoutAList) {
  objects = {{0x100100, {0x85}}};
  EXPECT_THAT(lines(), ElementsAre("error register (1001h) 85h"));
}

TEST_F(Errors, TheNewestFirst) {
  objects = {{0x100100, {0x11}},
             {0x100300, {3}},
             {0x100301, {0x30, 0x81, 0x34, 0x12}},
             {0x100302, {0x10, 0x32, 0, 0}},
             {0x100303, {0x12, 0xFF, 0x05, 0}}};
  EXPECT_THAT(lines(),
              ElementsAre("error register (1001h) 11h",
                          "1003h:1  8130h  the node misses heartbeat or guarding (of its maker: "
                          "1234h)",
                          "1003h:2  3210h  overvoltage of the DC link",
                          "1003h:3  FF12h  an error that its maker describes (of its maker: "
                          "0005h)"));
}

/// Eight are shown, and how many there are besides.
TEST_F(Errors, OfALongListTheFirstEight) {
  for (const uint8_t count : {uint8_t{8}, uint8_t{9}, uint8_t{254}}) {
    objects = {{0x100100, {1}}, {0x100300, {count}}};
    for (uint8_t i = 1; i <= 9; ++i)
      objects[0x100300 + i] = {0x00, 0x10, i, 0};
    const std::vector<std::string> shown = lines();
    ASSERT_EQ(shown.size(), count == 8 ? 9U : 10U);
    EXPECT_EQ(shown[8], "1003h:8  1000h  a general error (of its maker: 0008h)");
    if (count > 8) {
      EXPECT_EQ(shown[9], "and " + std::to_string(count - 8) + " older ones");
    }
  }
}

TEST_F(Errors, AListThatHasFewerThanItSays) {
  objects = {{0x100100, {1}}, {0x100300, {4}}, {0x100301, {0x00, 0x10, 0, 0}}};
  EXPECT_THAT(lines(),
              ElementsAre("error register (1001h) 01h", "1003h:1  1000h  a general error"));
}

} // namespace
} // namespace stride::can::tool
