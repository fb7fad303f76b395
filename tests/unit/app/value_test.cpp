#include "tests/unit/app/fixture.hpp"

namespace {

using ::testing::HasSubstr;

class Values : public stride::test::HandmadeApp {
protected:
  std::string errorFor(const std::string &path, const std::string &text) {
    return errorOf([&] { write(path, text); });
  }
  std::string csv(const std::string &path) const {
    const stride::app::Symbol symbol = symbols.resolve(path);
    std::string out;
    stride::app::appendCsv(symbols.app(), symbols.type(symbol), symbol.address(application.state()),
                           out);
    return out;
  }
};

TEST_F(Values, Initial) {
  EXPECT_EQ(read("PLC_PRG.name"), "'it$'s'");
  EXPECT_EQ(read("PLC_PRG.color"), "green");
  EXPECT_EQ(read("PLC_PRG.t"), "T#1s500ms");
  EXPECT_EQ(read("PLC_PRG.flag"), "FALSE");
  EXPECT_EQ(read("PLC_PRG.value"), "0.0");
}

TEST_F(Values, IntegersAreRead) {
  for (const auto &[text, wanted] : {std::pair{"50", "50"},
                                     {"-3", "-3"},
                                     {"+3", "3"},
                                     {"16#FF", "255"},
                                     {"INT#16#ff", "255"},
                                     {"2#1010_1010", "170"},
                                     {" 1_000 ", "1000"},
                                     {"-32768", "-32768"}}) {
    write("PLC_PRG.count", text);
    EXPECT_EQ(read("PLC_PRG.count"), wanted) << text;
  }
  EXPECT_EQ(errorFor("PLC_PRG.count", "32768"), "32768 is out of range for INT (-32768..32767)");
  EXPECT_THAT(errorFor("PLC_PRG.count", "1.5"), HasSubstr("is not a value of type INT"));
  EXPECT_THAT(errorFor("PLC_PRG.count", ""), HasSubstr("is missing"));
  EXPECT_THAT(errorFor("Slow.runs", "-1"), HasSubstr("out of range for UDINT (0..4294967295)"));
  EXPECT_THAT(errorFor("Slow.runs", "99999999999999999999"), HasSubstr("out of range"));
}

TEST_F(Values, OthersAreRead) {
  write("PLC_PRG.flag", "true");
  EXPECT_EQ(read("PLC_PRG.flag"), "TRUE");
  EXPECT_THAT(errorFor("PLC_PRG.flag", "2"), HasSubstr("write for example TRUE or FALSE"));
  write("PLC_PRG.value", "50");
  EXPECT_EQ(read("PLC_PRG.value"), "50.0");
  write("PLC_PRG.value", "LREAL#-1.5e3");
  EXPECT_EQ(read("PLC_PRG.value"), "-1500.0");
  write("PLC_PRG.value", "16#10");
  EXPECT_EQ(read("PLC_PRG.value"), "16.0");
  EXPECT_THAT(errorFor("PLC_PRG.value", "1e999"), HasSubstr("out of range"));
  EXPECT_THAT(errorFor("PLC_PRG.value", "x"), HasSubstr("not a value of type LREAL"));
  write("PLC_PRG.t", "T#3s");
  EXPECT_EQ(read("PLC_PRG.t"), "T#3s");
  EXPECT_THAT(errorFor("PLC_PRG.t", "T#50d"), HasSubstr("out of range"));
  EXPECT_THAT(errorFor("PLC_PRG.t", "3"), HasSubstr("write for example T#1s500ms"));
  write("PLC_PRG.color", "BLUE");
  EXPECT_EQ(read("PLC_PRG.color"), "blue");
  write("PLC_PRG.color", "Color.red");
  EXPECT_EQ(read("PLC_PRG.color"), "red");
  write("PLC_PRG.color", "Color#green");
  EXPECT_EQ(read("PLC_PRG.color"), "green");
  write("PLC_PRG.color", "17");
  EXPECT_EQ(read("PLC_PRG.color"), "17");
  EXPECT_THAT(errorFor("PLC_PRG.color", "grean"), HasSubstr("did you mean 'green'?"));
  EXPECT_THAT(errorFor("PLC_PRG.pt", "1"), HasSubstr("name one of its elements"));
}

TEST_F(Values, Texts) {
  write("PLC_PRG.name", "'a$'b$$c$0Ad'");
  EXPECT_EQ(read("PLC_PRG.name"), "'a$'b$$c$Ld'");
  write("PLC_PRG.name", "'\xC3\xA4'"); // UTF-8 in, one Latin-1 character stored, UTF-8 out
  EXPECT_EQ(read("PLC_PRG.name"), "'\xC3\xA4'");
  EXPECT_EQ(errorFor("PLC_PRG.name", "'12345678901'"),
            "'12345678901' has 11 characters, STRING(10) holds 10");
  EXPECT_THAT(errorFor("PLC_PRG.name", "abc"), HasSubstr("write for example 'abc'"));
  EXPECT_THAT(errorFor("PLC_PRG.name", "'a'b'"), HasSubstr("is not a value"));
  EXPECT_THAT(errorFor("PLC_PRG.name", "'$z'"), HasSubstr("unknown escape"));
  EXPECT_THAT(errorFor("PLC_PRG.name", "'\xE2\x82\xAC'"), HasSubstr("Latin-1"));
}

TEST_F(Values, CsvFields) {
  write("PLC_PRG.value", "100");
  EXPECT_EQ(csv("PLC_PRG.value"), "100");
  EXPECT_EQ(csv("PLC_PRG.flag"), "0");
  EXPECT_EQ(csv("PLC_PRG.color"), "5");
  EXPECT_EQ(csv("PLC_PRG.t"), "1500");
  write("PLC_PRG.name", "'a,\"b'");
  EXPECT_EQ(csv("PLC_PRG.name"), "\"a,\"\"b\"");
}

} // namespace
