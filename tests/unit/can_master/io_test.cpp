// I/O devices of a drive group: nodes of CiA 401.
#include "drivers/can/io_schema.hpp"
#include "tests/unit/can_master/can_bus.hpp"

#include <gmock/gmock-more-matchers.h>

namespace stride::can {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

bus::IoSetup ioSetup(uint32_t inputs, uint32_t outputs) {
  bus::IoSetup io;
  io.name = "Valves";
  io.inputBytes = inputs;
  io.outputBytes = outputs;
  io.parameters = bus::SetupParameters({{}, io::can::kSchema.parameters, io::can::kSchema.tables});
  io.exchange = std::make_shared<common::IoExchange>(inputs, outputs);
  return io;
}

class IoOf : public test::CanBusTest {
protected:
  /// A node with two digital bytes and an analog value each way.
  void addIo() {
    bus::IoSetup &io = setup.ios.emplace_back(ioSetup(4, 4));
    io.parameters.add({"node", "", 20});
    io.parameters.add({"analog_inputs", "", 1});
    io.parameters.add({"analog_outputs", "", 1});
    io.safeOutputs = {0x81, 0x02, 0, 0};
    exchange = io.exchange.get();
    test::ScriptedNode &node = nodes.emplace_back(inbox, uint8_t{20});
    node.values[0x100000] = {4, 0x000F0191};
    node.pdosInOperation = {"194#A55A", "294#FE7F"};
  }
  void startIo() {
    make();
    commands.resize(setup.drives.size());
    started.assign(setup.drives.size(), false);
    for (int i = 0; i < 3000 && !exchange->works; ++i)
      cycle();
    ASSERT_TRUE(exchange->works);
    port->takeSent();
  }
  std::vector<uint8_t> inputs() const {
    std::vector<uint8_t> bytes(exchange->inputs.size());
    exchange->inputs.read(0, bytes);
    return bytes;
  }
  test::ScriptedNode &io() { return nodes.back(); }

  common::IoExchange *exchange = nullptr;
};

TEST_F(IoOf, WithoutADriveInputsComeAndOutputsGo) {
  addIo();
  startIo();
  EXPECT_THAT(inputs(), ElementsAre(0xA5, 0x5A, 0xFE, 0x7F));
  exchange->outputs.write(0, std::vector<uint8_t>{1, 2, 0x34, 0x12});
  cycle();
  const std::vector<std::string> sent = port->takeSent();
  EXPECT_THAT(sent, Contains("214#0102"));
  EXPECT_THAT(sent, Contains("314#3412"));
  io().atSync = {"194#0000", "294#0080"};
  cycles(2);
  EXPECT_THAT(inputs(), ElementsAre(0, 0, 0, 0x80));
}

TEST_F(IoOf, StartUpGivesPdosAndErrorValues) {
  addIo();
  setup.ios[0].parameters.add({"startup", "6423h := BOOL#1", 0});
  startIo();
  for (const char *write :
       {"1400:1/4=214", "1600:1/4=62000108", "1600:2/4=62000208", "1600:0/1=2", "1401:1/4=314",
        "1601:1/4=64110110", "1800:1/4=194", "1A00:1/4=60000108", "1801:1/4=294",
        "1A01:1/4=64010110", "1801:2/1=1", "6206:1/1=FF", "6207:1/1=81", "6206:2/1=FF",
        "6207:2/1=2", "6443:1/1=1", "6444:1/4=0", "6423:0/1=1"})
    EXPECT_THAT(io().written, Contains(write));
  EXPECT_THAT(io().written, Not(Contains(HasSubstr("6060"))));
}

TEST_F(IoOf, EventsCarryTimersAndAnalogEvents) {
  addIo();
  setup.ios[0].parameters.add({"when", "event", 1});
  setup.ios[0].parameters.add({"inhibit", "", 0.0023});
  startIo();
  for (const char *write :
       {"1800:2/1=FF", "1800:3/2=17", "1800:5/2=64", "1400:2/1=FF", "6423:0/1=1"})
    EXPECT_THAT(io().written, Contains(write));
  exchange->outputs.write(0, std::vector<uint8_t>{9});
  cycles(2);
  port->takeSent();
  cycles(50);
  EXPECT_THAT(port->takeSent(), Not(Contains("214#0900"))) << "nothing has changed";
  exchange->outputs.write(0, std::vector<uint8_t>{8});
  cycle();
  EXPECT_THAT(port->takeSent(), Contains("214#0800"));
  cycles(120);
  EXPECT_THAT(port->takeSent(), Contains("214#0800")) << "a lost one is not lost for good";
}

TEST_F(IoOf, ASilentNodeIsLostUntilItAnswers) {
  addIo();
  startIo();
  io().atSync.clear();
  cycles(2);
  EXPECT_TRUE(exchange->works);
  cycle();
  EXPECT_FALSE(exchange->works);
  EXPECT_TRUE(host.heard("node 20 is silent"));
  io().atSync = {"194#0102", "294#0304"};
  cycles(3);
  EXPECT_TRUE(exchange->works);
  EXPECT_THAT(inputs(), ElementsAre(1, 2, 3, 4));
}

TEST_F(IoOf, ARestartedNodeNeedsAResetOfTheGroup) {
  addIo();
  startIo();
  io().say(0x700, "00");
  cycles(3);
  EXPECT_FALSE(exchange->works);
  EXPECT_TRUE(host.heard("node 20 has restarted in operation"));
  cycles(500);
  EXPECT_FALSE(exchange->works);
  driver->resetOthers();
  cycles(600);
  EXPECT_TRUE(exchange->works);
}

TEST_F(IoOf, AnotherDeviceIsNone) {
  addIo();
  io().values[0x100000] = {4, 0x00020192};
  make();
  cycles(3000);
  EXPECT_FALSE(exchange->works);
  EXPECT_FALSE(exchange->begun);
  EXPECT_TRUE(host.heard("I/O device: node 20 is no I/O device of CiA 401: its device type "
                         "(16#1000:0) is 16#00020192 and not 16#....0191"));
}

TEST_F(IoOf, ANodeWithoutErrorValuesStartsAndItIsSaid) {
  addIo();
  for (const uint32_t key : {0x620601U, 0x620602U, 0x620701U, 0x620702U, 0x644301U, 0x644401U})
    io().aborts[key] = 0x06020000;
  startIo();
  EXPECT_TRUE(host.heard("node 20 has no error values for its outputs"));
}

TEST_F(IoOf, APdoOfAnotherLengthIsNotUsed) {
  addIo();
  startIo();
  io().atSync = {"194#010203", "294#0304"};
  cycles(2);
  EXPECT_THAT(inputs(), ElementsAre(0xA5, 0x5A, 3, 4));
  cycles(2);
  EXPECT_FALSE(exchange->works);
}

TEST_F(IoOf, AfterTheApplicationHasStoppedOutputsStillGoOut) {
  addIo();
  startIo();
  driver->applicationStopped();
  EXPECT_FALSE(driver->atRest());
  exchange->outputs.write(0, std::vector<uint8_t>{0x81, 2, 0, 0});
  cycle();
  EXPECT_FALSE(driver->atRest());
  EXPECT_THAT(port->takeSent(), Contains("214#8102"));
  cycles(2);
  EXPECT_TRUE(driver->atRest());
}

TEST_F(IoOf, BesideADriveBothWork) {
  addDrive(5);
  addIo();
  startIo();
  ASSERT_NO_FATAL_FAILURE(start());
  io().atSync.clear();
  cycles(10);
  EXPECT_FALSE(exchange->works);
  EXPECT_TRUE(communicates(0)) << "the drive goes on";
}

/// Digital bytes, analog values, bytes: what PDOs there are, and how long.
struct SideCase {
  uint32_t bytes;
  int digital; ///< -1: not given.
  uint32_t analog;
  std::vector<uint32_t> lengths;
  std::vector<uint32_t> at;
  bool works;
};
class IoPlans : public ::testing::TestWithParam<SideCase> {};

TEST_P(IoPlans, InputsAreInPdos) {
  const SideCase &given = GetParam();
  bus::IoSetup io = ioSetup(given.bytes, 0);
  io.parameters.add({"node", "", 3});
  io.parameters.add({"analog_inputs", "", static_cast<double>(given.analog)});
  if (given.digital >= 0)
    io.parameters.add({"digital_inputs", "", static_cast<double>(given.digital)});
  const IoPlan plan = planIo(io);
  EXPECT_EQ(plan.fault.empty(), given.works) << plan.fault;
  std::vector<uint32_t> lengths;
  std::vector<uint32_t> at;
  for (size_t i = 0; i < plan.plan.tpdoCount; ++i) {
    lengths.push_back(plan.plan.tpdos[i].length());
    at.push_back(plan.tpdoAt[i]);
  }
  EXPECT_EQ(lengths, given.lengths);
  EXPECT_EQ(at, given.at);
  EXPECT_EQ(plan.plan.rpdoCount, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Sides, IoPlans,
    ::testing::Values(SideCase{1, -1, 0, {1}, {0}, true}, SideCase{8, -1, 0, {8}, {0}, true},
                      SideCase{9, -1, 0, {}, {}, false}, SideCase{0, -1, 0, {}, {}, true},
                      SideCase{10, -1, 1, {8, 2}, {0, 8}, true},
                      SideCase{4, 1, 1, {1, 2}, {0, 2}, true},
                      SideCase{24, -1, 12, {8, 8, 8}, {0, 8, 16}, true},
                      SideCase{32, -1, 12, {8, 8, 8, 8}, {0, 8, 16, 24}, true},
                      SideCase{12, 1, 5, {1, 8, 2}, {0, 2, 10}, true},
                      SideCase{1, -1, 1, {}, {}, false}, SideCase{3, 2, 1, {}, {}, false}));

TEST(IoPlans, ASafeValueThatNobodyTellsIsSaid) {
  bus::IoSetup io = ioSetup(0, 4);
  io.parameters.add({"node", "", 3});
  io.parameters.add({"analog_outputs", "", 2});
  io.safeOutputs = {0, 0, 0, 1};
  EXPECT_THAT(planIo(io).untold, ElementsAre(2U));
  io.parameters.add({"startup", "6444h:2 := DINT#256", 0});
  EXPECT_THAT(planIo(io).untold, ::testing::IsEmpty());
}

TEST(IoExchangeTest, BytesOfAnyPlaceAndLengthAreThoseThatWereWritten) {
  for (size_t size : {1U, 3U, 8U, 13U, 32U}) {
    common::ExchangedBytes bytes(size);
    std::vector<uint8_t> model(size);
    uint8_t value = 1;
    for (size_t first = 0; first < size + 2; ++first)
      for (size_t count = 0; count < size + 3; ++count) {
        std::vector<uint8_t> written(count);
        for (uint8_t &one : written)
          one = value++;
        bytes.write(first, written);
        for (size_t i = 0; i < count && first + i < size; ++i)
          model[first + i] = written[i];
        std::vector<uint8_t> read(size + 4, 0xEE);
        bytes.read(0, read);
        for (size_t i = 0; i < read.size(); ++i)
          ASSERT_EQ(read[i], i < size ? model[i] : 0) << size << ' ' << first << ' ' << count;
      }
  }
}

} // namespace
} // namespace stride::can
