// Objects of a drive as parameters of an axis.
#include "drivers/can/master/parameter_transfer.hpp"
#include "tests/unit/can_master/script.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::can {
namespace {

using bus::ParameterAnswer;
using bus::ParameterForm;
using bus::ParameterRequest;
using Result = ParameterAnswer::Result;

class Parameter : public ::testing::Test {
protected:
  static ParameterRequest read(int32_t number, ParameterForm form = ParameterForm::Number) {
    ParameterRequest request;
    request.number = number;
    request.form = form;
    return request;
  }
  static ParameterRequest write(int32_t number, double value,
                                ParameterForm form = ParameterForm::Number) {
    ParameterRequest request = read(number, form);
    request.kind = ParameterRequest::Kind::Write;
    request.value = value;
    return request;
  }
  /// Asks; "> …" is what the node must hear, "< …" what it says.
  ParameterAnswer ask(const ParameterRequest &request, const std::string &script) {
    transfer.start(request);
    ParameterAnswer answer;
    for (const std::string &line : test::lines(script)) {
      if (transfer.wants())
        transfer.begin(sdo);
      const Frame frame = test::frame("605#" + line.substr(2));
      if (line[0] == '<') {
        sdo.received(frame);
        if (sdo.state() != SdoClient::State::Busy)
          transfer.finished(sdo);
        continue;
      }
      EXPECT_TRUE(sdo.pending()) << line;
      EXPECT_EQ(test::text(sdo.nextFrame()), test::text(frame));
      sdo.sent();
    }
    if (transfer.wants())
      transfer.begin(sdo);
    EXPECT_TRUE(transfer.poll(answer)) << script;
    EXPECT_FALSE(sdo.pending()) << "nothing more is said";
    return answer;
  }

  std::vector<SdoWrite> listed = {{{0x6098, 0}, 1, 35}, {{0x6099, 2}, 4, 100}};
  ParameterTransfer transfer{listed};
  SdoClient sdo{5, 100};
};

TEST_F(Parameter, NumbersOfObjects) {
  EXPECT_EQ(parameterOf({0x6064, 0}), 0x606400);
  EXPECT_EQ(objectOfParameter(0x606402), (Object{0x6064, 2}));
  EXPECT_EQ(objectOfParameter(0xFFFFFF), (Object{0xFFFF, 255}));
  EXPECT_EQ(objectOfParameter(1), (Object{0, 1}));
  EXPECT_FALSE(objectOfParameter(0x1000000));
  EXPECT_FALSE(objectOfParameter(0));
  EXPECT_FALSE(objectOfParameter(-7));
  EXPECT_FALSE(objectOfParameter(INT32_MIN));
  EXPECT_EQ(ask(read(-7), "").result, Result::Unknown);
}

TEST_F(Parameter, ReadsWithTheSignThatTheObjectHas) {
  ParameterAnswer answer = ask(read(0x606400), R"(> 40 64 60 00 00 00 00 00
                                                   < 43 64 60 00 FE FF FF FF)");
  EXPECT_EQ(answer.result, Result::Done);
  EXPECT_EQ(answer.value, -2);
  answer = ask(read(0x200105), R"(> 40 01 20 05 00 00 00 00
                                   < 43 01 20 05 FE FF FF FF)");
  EXPECT_EQ(answer.value, 4294967294.0) << "an object that nobody knows has none";
  answer = ask(read(0x609800), "> 40 98 60 00 00 00 00 00\n< 4F 98 60 00 F1 00 00 00");
  EXPECT_EQ(answer.value, -15);
  answer = ask(read(0x604100, ParameterForm::Bool),
               "> 40 41 60 00 00 00 00 00\n< 4B 41 60 00 00 02 00 00");
  EXPECT_EQ(answer.value, 1);
  answer = ask(read(0x606400, ParameterForm::Raw),
               "> 40 64 60 00 00 00 00 00\n< 43 64 60 00 FE FF FF FF");
  EXPECT_EQ(answer.raw, 0xFFFFFFFEU);
}

TEST_F(Parameter, TextsAreBytesAndNoNumbers) {
  const ParameterAnswer answer = ask(read(0x100800, ParameterForm::Bytes),
                                     R"(> A4 08 10 00 7F 40 00 00
                                        < 41 08 10 00 05 00 00 00
                                        > 60 00 00 00 00 00 00 00
                                        < 05 41 42 43 44 45 00 00)");
  EXPECT_EQ(answer.result, Result::Done);
  EXPECT_EQ(answer.bytes.text(), "ABCDE");
  transfer.start(read(0x100800));
  transfer.begin(sdo);
  sdo.sent();
  sdo.received(test::frame("585#41 08 10 00 09 00 00 00"));
  transfer.finished(sdo);
  ParameterAnswer none;
  ASSERT_TRUE(transfer.poll(none));
  EXPECT_EQ(none.result, Result::Unknown) << "longer than any number";
}

TEST_F(Parameter, WritesWithTheSizeOfTheObject) {
  // Known: at once.
  EXPECT_EQ(ask(write(0x609800, -3), "> 2F 98 60 00 FD 00 00 00\n< 60 98 60 00 00 00 00 00").result,
            Result::Done);
  // Else the node is asked.
  EXPECT_EQ(ask(write(0x200101, 500), R"(> 40 01 20 01 00 00 00 00
                                          < 4B 01 20 01 07 00 00 00
                                          > 2B 01 20 01 F4 01 00 00
                                          < 60 01 20 01 00 00 00 00)")
                .result,
            Result::Done);
  EXPECT_EQ(ask(write(0x200101, 1, ParameterForm::Bool), R"(> 40 01 20 01 00 00 00 00
                                                             < 4F 01 20 01 00 00 00 00
                                                             > 2F 01 20 01 01 00 00 00
                                                             < 60 01 20 01 00 00 00 00)")
                .result,
            Result::Done);
}

TEST_F(Parameter, NumbersThatDoNotFitAreRefused) {
  struct Row {
    int32_t number; // 6098h: int8, 6040h: uint16
    double value;
    bool fits;
  };
  for (const Row &row :
       {Row{0x609800, 127, true}, Row{0x609800, 128, false}, Row{0x609800, -128, true},
        Row{0x609800, -129, false}, Row{0x604000, 65535, true}, Row{0x604000, 65536, false},
        Row{0x604000, 0, true}, Row{0x604000, -1, false}, Row{0x604000, 1e300, false},
        Row{0x604000, std::nan(""), false}}) {
    transfer.start(write(row.number, row.value));
    transfer.begin(sdo);
    ParameterAnswer answer;
    EXPECT_EQ(transfer.poll(answer), !row.fits) << row.number << ' ' << row.value;
    if (!row.fits) {
      EXPECT_EQ(answer.result, Result::Refused);
    }
    sdo.clear();
  }
  // An object of one byte that nobody knows: -128 to 255.
  for (const auto &[value, fits] : std::vector<std::pair<double, bool>>{
           {-128, true}, {255, true}, {-129, false}, {256, false}}) {
    transfer.start(write(0x200100, value));
    transfer.begin(sdo);
    sdo.sent();
    sdo.received(test::frame("585#4F 01 20 00 00 00 00 00"));
    transfer.finished(sdo);
    ParameterAnswer answer;
    EXPECT_EQ(transfer.poll(answer), !fits) << value;
    sdo.clear();
  }
}

TEST_F(Parameter, RawBitsOfNarrowObjects) {
  struct Row {
    uint32_t raw;
    bool fits;
  };
  for (const Row &row : {Row{0xFFFF, true}, Row{0xFFFF8000, true}, Row{0x10000, false},
                         Row{0xFFFF7FFF, false}, Row{0x8000, true}}) {
    ParameterRequest request = write(0x604000, 0, ParameterForm::Raw);
    request.raw = row.raw;
    transfer.start(request);
    transfer.begin(sdo);
    ParameterAnswer answer;
    EXPECT_EQ(transfer.poll(answer), !row.fits) << row.raw;
    sdo.clear();
  }
}

TEST_F(Parameter, BytesAreWrittenAsTheyAre) {
  ParameterRequest request = write(0x200100, 0, ParameterForm::Bytes);
  request.bytes = bus::ByteString(std::string_view("Axis 1"));
  EXPECT_EQ(ask(request, R"(> 21 01 20 00 06 00 00 00
                            < 60 01 20 00 00 00 00 00
                            > 03 41 78 69 73 20 31 00
                            < 20 00 00 00 00 00 00 00)")
                .result,
            Result::Done);
  request.bytes = bus::ByteString();
  EXPECT_EQ(ask(request, "").result, Result::Refused);
}

TEST_F(Parameter, AbortsHaveAMeaning) {
  for (const auto &[code, result] :
       std::vector<std::pair<std::string, Result>>{{"00000206", Result::Unknown},
                                                   {"11000906", Result::Unknown},
                                                   {"02000106", Result::ReadOnly},
                                                   {"01000106", Result::Refused},
                                                   {"30000906", Result::Refused},
                                                   {"22000008", Result::Refused},
                                                   {"00000008", Result::Failed},
                                                   {"EFBEADDE", Result::Failed}})
    EXPECT_EQ(ask(write(0x609800, 1), "> 2F 98 60 00 01 00 00 00\n< 80 98 60 00" + code).result,
              result)
        << code;
}

TEST_F(Parameter, GivesUpAfterItsTime) {
  transfer.start(read(0x606400));
  transfer.begin(sdo);
  sdo.sent();
  for (int i = 0; i < 100; ++i)
    sdo.cycle();
  transfer.finished(sdo);
  ParameterAnswer answer;
  ASSERT_TRUE(transfer.poll(answer));
  EXPECT_EQ(answer.result, Result::Failed);
}

TEST_F(Parameter, ACancelledQuestionAnswersNobody) {
  transfer.start(read(0x606400));
  transfer.begin(sdo);
  sdo.sent();
  transfer.cancel(sdo);
  EXPECT_EQ(sdo.state(), SdoClient::State::Failed);
  transfer.start(read(0x606300)); // the next one, before the end of the first is noticed
  transfer.finished(sdo);
  ParameterAnswer answer;
  EXPECT_FALSE(transfer.poll(answer));
  EXPECT_TRUE(transfer.wants());
}

TEST_F(Parameter, ListsWhatTheConfigurationWrites) {
  ParameterRequest request;
  request.kind = ParameterRequest::Kind::Describe;
  request.number = 1;
  const ParameterAnswer answer = ask(request, "");
  EXPECT_EQ(answer.result, Result::Done);
  EXPECT_EQ(answer.number, 0x609902);
  EXPECT_EQ(answer.name, "16#6099:2");
  EXPECT_TRUE(answer.writable);
  request.number = -1;
  EXPECT_EQ(ask(request, "").result, Result::Unknown);
  request.number = 0;
  request.forms = formBit(ParameterForm::Bytes);
  EXPECT_EQ(ask(request, "").result, Result::Unknown);
}

/// After the objects of the configuration: those that drives usually have, as far as this one does.
TEST_F(Parameter, ListsWhatTheNodeHasOfUsualObjects) {
  ParameterRequest request;
  request.kind = ParameterRequest::Kind::Describe;
  request.number = 2;
  ParameterAnswer answer = ask(request, R"(> 40 07 60 00 00 00 00 00
                                           < 80 07 60 00 00 00 02 06
                                           > 40 5A 60 00 00 00 00 00
                                           < 4B 5A 60 00 02 00 00 00)");
  EXPECT_EQ(answer.result, Result::Done);
  EXPECT_EQ(answer.number, 0x605A00);
  EXPECT_EQ(ask(request, "").number, 0x605A00) << "it is known now";
  request.number = 3;
  answer = ask(request, "> 40 5B 60 00 00 00 00 00\n< 80 5B 60 00 21 00 00 08");
  EXPECT_NE(answer.result, Result::Done) << "that says nothing of the object";
  answer = ask(request, "> 40 5B 60 00 00 00 00 00\n< 4B 5B 60 00 00 00 00 00");
  EXPECT_EQ(answer.number, 0x605B00);
}

} // namespace
} // namespace stride::can
