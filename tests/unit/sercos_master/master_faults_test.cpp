// A ring in operation: losses that are borne, and those that are not; resets; questions of
// programs.
#include "tests/unit/sercos_master/master_scene.hpp"

#include <gmock/gmock-matchers.h>

namespace stride::sercos::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MasterFaults : public MasterScene {
protected:
  void SetUp() override {
    add(11);
    add(5);
    make();
    ASSERT_TRUE(start()) << text;
  }
  void cycles(int count) {
    for (int i = 0; i < count; ++i)
      cycle();
  }
  bool communicates(size_t drive) const { return master->drive(drive).status().communication; }
  bus::ParameterAnswer ask(const bus::ParameterRequest &request, int most = 300) {
    master->drive(0).ask(request);
    bus::ParameterAnswer answer;
    for (int i = 0; i < most; ++i) {
      if (master->drive(0).poll(answer))
        return answer;
      cycle();
    }
    ADD_FAILURE() << "no answer";
    return answer;
  }
};

TEST_F(MasterFaults, OneMstIsBorne) {
  ring->loseMsts = 1;
  cycles(3);
  EXPECT_TRUE(communicates(0));
  ring->loseMsts = 2;
  cycles(2);
  EXPECT_FALSE(communicates(0));
  EXPECT_FALSE(communicates(1));
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  EXPECT_THAT(host.said, ElementsAre("the ring falls to phase 0: the MST does not come back"));
  EXPECT_EQ(master->counters().mstLost, 3U);
  EXPECT_EQ(master->counters().ringFalls, 1U);
}

TEST_F(MasterFaults, OneTelegramOfADriveIsBorne) {
  drives[1].silent = true;
  cycle();
  drives[1].silent = false;
  drives[1].distorts = true;
  master->executeStart();
  // The loss before it was one in a row, and this is the second.
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  drives[1].distorts = false;
  resetAll();
  ASSERT_TRUE(start()) << text;
  for (int i = 0; i < 4; ++i) {
    drives[1].distorts = i % 2 == 0;
    cycle();
  }
  EXPECT_TRUE(communicates(1));
  EXPECT_EQ(master->counters().atLost, 4U);
}

TEST_F(MasterFaults, AfterAFallNothingMovesUntilTheReset) {
  ring->open = true;
  cycles(2);
  ring->open = false;
  cycles(100);
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  EXPECT_EQ(ring->phase, 0);
  bus::Message problem;
  master->problem(problem);
  EXPECT_THAT(std::string(problem.text()), HasSubstr("no light"));
  resetAll();
  EXPECT_TRUE(start()) << text;
  EXPECT_TRUE(communicates(0));
  bus::Message none;
  master->problem(none);
  EXPECT_TRUE(none.text().empty());
}

TEST_F(MasterFaults, AResetOfOneDriveLeavesTheRing) {
  bus::DriveCommand command;
  command.regulatorOn = command.driveStart = true;
  drives[0].status = 0xC008;
  master->drive(0).axis().command(command);
  cycles(2);
  EXPECT_EQ(drives[0].control & 0xE000, 0xE000);
  master->reset(0);
  cycle();
  cycle();
  EXPECT_EQ(drives[0].control & 0xE000, 0); // off
  EXPECT_EQ(master->actualPhase(), Phase::Four);
  bus::Message message;
  uint16_t progress = 0;
  EXPECT_EQ(master->init(0, progress, message), bus::StartUp::Started);
}

TEST_F(MasterFaults, AResetOfAllBeginsAnew) {
  resetAll();
  EXPECT_EQ(master->actualPhase(), Phase::Zero);
  EXPECT_TRUE(start()) << text;
}

TEST_F(MasterFaults, WhoHasNotTakenPartFromTheBeginningCannotLater) {
  for (size_t i = 0; i < 2; ++i)
    master->reset(i);
  bus::Message message;
  uint16_t progress = 0;
  for (int i = 0; i < 600; ++i) { // the second one is disabled
    master->executeStart();
    (void)master->init(0, progress, message);
    master->executeEnd();
  }
  EXPECT_EQ(master->actualPhase(), Phase::Four);
  EXPECT_EQ(master->init(1, progress, message), bus::StartUp::Failed);
  EXPECT_THAT(std::string(message.text()), HasSubstr("SMC_ResetAxisGroup"));
}

TEST_F(MasterFaults, ServiceChannelAnswersPrograms) {
  bus::ParameterRequest request;
  request.number = 4;
  EXPECT_EQ(ask(request).value, 10);
  request.number = 999;
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::Unknown);
  request.number = 4 | 3 << 16; // its attribute
  request.form = bus::ParameterForm::Raw;
  EXPECT_EQ(ask(request).raw, 0x00110001U);
  request = {};
  request.number = 51; // comes in each cycle
  EXPECT_EQ(ask(request, 1).value, 11000);
  request.kind = bus::ParameterRequest::Kind::Write;
  request.number = 77;
  request.value = 300;
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::Done);
  EXPECT_EQ(drives[0].value(77), 300);
  request.value = -1;
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::Refused);
  drives[0].blocks[77].refusal = 0x7004;
  request.value = 5;
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::ReadOnly);
}

TEST_F(MasterFaults, ListsComeInPieces) {
  drives[0].blocks[16].data = words({1, 2, 0x4321});
  bus::ParameterRequest request;
  request.form = bus::ParameterForm::Raw;
  request.number = 16;
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::Unknown); // no number
  request.number = 16 | 1 << 19;
  EXPECT_EQ(ask(request).raw, 6U);
  request.number = 16 | 2 << 19;
  EXPECT_EQ(ask(request, 1).raw, 0x00020001U);
  request.number = 16 | 3 << 19;
  EXPECT_EQ(ask(request, 1).raw, 0x4321U);
  request.kind = bus::ParameterRequest::Kind::Write;
  request.number = 16 | 2 << 19;
  request.raw = 0x00060005;
  EXPECT_EQ(ask(request, 1).result, bus::ParameterAnswer::Result::Done);
  request.number = 16 | 1 << 19;
  request.raw = 4;
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::Done);
  EXPECT_EQ(drives[0].blocks[16].data, words({5, 6}));
  request.raw = 2; // nothing has been given
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::Refused);
}

TEST_F(MasterFaults, DescribesWhatCanBeSet) {
  drives[0].blocks[192] = list2(words({16, 4, 99, 44, 89, 77}));
  drives[0].blocks[4].attribute = 0x70110001; // never written
  drives[0].blocks[77].name = "Linear factor";
  bus::ParameterRequest request;
  request.kind = bus::ParameterRequest::Kind::Describe;
  request.number = 0;
  EXPECT_EQ(ask(request).number, 44);
  request.number = 1;
  const bus::ParameterAnswer answer = ask(request);
  EXPECT_EQ(answer.number, 77);
  EXPECT_EQ(answer.name, "Linear factor");
  EXPECT_TRUE(answer.writable);
  request.number = 2;
  EXPECT_EQ(ask(request).result, bus::ParameterAnswer::Result::Unknown);
}

TEST_F(MasterFaults, TellsAnErrorAndResetsIt) {
  drives[0].blocks[11] = block2(0x8000);
  drives[0].blocks[129] = block2(4711);
  drives[0].blocks[95].data = {'h', 'o', 't'};
  drives[0].status = 0x2000;
  cycles(60);
  EXPECT_TRUE(master->drive(0).status().error);
  EXPECT_EQ(master->drive(0).status().errorId, 4711);
  EXPECT_THAT(host.said, ElementsAre("address 11 has an error, S-0-0011 = 16#1267: hot"));
  drives[0].written.clear();
  bus::DriveCommand command;
  command.errorAckn = true;
  master->drive(0).axis().command(command);
  cycles(3);
  drives[0].status = 0x8000;
  cycles(20);
  EXPECT_FALSE(master->drive(0).status().error);
  EXPECT_EQ(drives[0].written, (std::vector<std::string>{"S99=3", "S99=0"}));
}

} // namespace
} // namespace stride::sercos::test
