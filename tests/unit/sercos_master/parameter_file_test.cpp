#include "drivers/sercos/parameter_file.hpp"

#include <gtest/gtest.h>

namespace stride::sercos::test {
namespace {

TEST(ParameterFile, ReadsText) {
  std::vector<IdnValue> values;
  std::string error;
  ASSERT_TRUE(readParameterFile("drive;7\r\n41;-100;Homing velocity;rpm\r\n\r\n32769;TRUE;;\n",
                                values, error));
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0].idn, 41);
  EXPECT_EQ(values[0].numbers, (std::vector<int64_t>{-100}));
  EXPECT_EQ(values[1].idn, 32769);
  EXPECT_EQ(values[1].numbers, (std::vector<int64_t>{1}));
}

TEST(ParameterFile, ReadsXml) {
  std::vector<IdnValue> values;
  std::string error;
  ASSERT_TRUE(readParameterFile(
      "<?xml version=\"1.0\"?>\n<DriveParameters DriveId=\"1\">\n"
      "  <Parameter Number=\"50\" Name=\"a &lt; b\" Type=\"DINT\" Unit=\"\">-7</Parameter>\n"
      "</DriveParameters>\n",
      values, error));
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].idn, 50);
  EXPECT_EQ(values[0].numbers, (std::vector<int64_t>{-7}));
}

TEST(ParameterFile, SaysWhereItIsWrong) {
  for (const char *line :
       {"41", "41;1.5", "65536;1", "-1;1", "x;1", "41;", "<Parameter Number=\"5\">",
        "<Parameter Name=\"a\">1</Parameter>", "<Parameter Number=\"5>1</Parameter>"}) {
    std::vector<IdnValue> values;
    std::string error;
    EXPECT_FALSE(readParameterFile(std::string("drive;7\n") + line, values, error)) << line;
    EXPECT_EQ(error.rfind("line 2 ", 0), 0U) << error;
  }
}

} // namespace
} // namespace stride::sercos::test
