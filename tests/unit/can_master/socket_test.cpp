// The interface of the system where there is none, and what netlink says. With a real one: in the
// guest.
#include "drivers/can/can_driver.hpp"
#include "drivers/can/schema.hpp"
#include "drivers/can/socket/can_link.hpp"
#include "drivers/can/socket/interface_lock.hpp"
#include "drivers/can/socket/socket_can_port.hpp"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <linux/can/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace stride::can {
namespace {

using ::testing::HasSubstr;

TEST(SocketCan, AnInterfaceThatIsNotThere) {
  SocketCanPort port("nocan77", 1000);
  EXPECT_EQ(port.state(), ControllerState::Down);
  EXPECT_THAT(std::string(port.problem()), HasSubstr("there is no interface 'nocan77'"));
  port.beginCycle();
  EXPECT_EQ(port.send({}, SendClass::Process), SendResult::Down);
  EXPECT_EQ(port.send({}, SendClass::Service), SendResult::Down);
  std::vector<Received> frames(4);
  EXPECT_EQ(port.receive(frames), 0U);
  EXPECT_FALSE(port.wait(INT64_MAX)) << "nothing will ever come";
  EXPECT_EQ(port.unconfirmed(), 0U);
  EXPECT_EQ(port.counters().errorFrames, 0U);
}

TEST(SocketCan, AnInterfaceThatIsNoCan) {
  SocketCanPort port("lo", 1000);
  EXPECT_EQ(port.state(), ControllerState::Down);
  EXPECT_FALSE(port.problem().empty());
}

/// Another process has it until it ends, by whatever. (`lo` is an interface, if none of CAN.)
TEST(SocketCan, OneMasterAtAnInterface) {
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t other = ::fork();
  if (other == 0) {
    const InterfaceLock lock("lo");
    const InterfaceLock absent("nocan77");
    (void)::write(ready[1], "1", 1);
    ::pause();
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  const auto begin = [](const std::string &interface) -> std::string {
    bus::GroupSetup setup(kSchema, 0.001);
    setup.kind = bus::BusKind::Real;
    setup.busParameters.add({"interface", interface, 0});
    setup.addDrive("X", 3);
    try {
      (void)makeDriver(setup);
      return "begins";
    } catch (const std::runtime_error &error) {
      return error.what();
    }
  };
  const std::string refusal = "' has a master: process " + std::to_string(other);
  for (int i = 0; i < 30; ++i) // more askers than can wait in a row
    EXPECT_THAT(begin("lo"), HasSubstr("'lo" + refusal));
  EXPECT_EQ(begin("nocan77"), "begins"); // it is not there: nobody can lead drives with it
  const InterfaceLock elsewhere("lox");
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  const InterfaceLock own("lo");
  EXPECT_EQ(begin("lo"), "begins") << "groups of one process may share it";
}

TEST(SocketCan, TheDriverSaysWhatIsWrong) {
  bus::GroupSetup setup(kSchema, 0.001);
  setup.kind = bus::BusKind::Real;
  setup.busParameters.add({"interface", "nocan77", 0});
  setup.addDrive("X", 3);
  const std::unique_ptr<bus::AxisDriver> driver = makeDriver(setup);
  driver->executeStart();
  uint16_t progress = 0;
  bus::Message message;
  EXPECT_EQ(driver->init(0, progress, message), bus::StartUp::Failed);
  EXPECT_THAT(std::string(message.text()), HasSubstr("there is no interface 'nocan77'"));
  bus::Message problem;
  driver->problem(problem);
  EXPECT_EQ(problem.text(), message.text());
  driver->executeEnd();
  EXPECT_FALSE(driver->status(0).communication);
}

/// An answer of netlink.
class LinkAnswer {
public:
  explicit LinkAnswer(bool up) {
    nlmsghdr head{};
    head.nlmsg_type = RTM_NEWLINK;
    ifinfomsg info{};
    info.ifi_flags = up ? IFF_UP : 0;
    append(&head, sizeof head);
    append(&info, sizeof info);
    finish();
  }
  /// With an attribute within the attributes of that kind of link.
  void addData(const std::vector<std::pair<uint16_t, std::vector<uint8_t>>> &attributes) {
    std::vector<uint8_t> data;
    for (const auto &[type, payload] : attributes)
      put(data, type, payload);
    std::vector<uint8_t> info;
    put(info, IFLA_INFO_KIND, {'c', 'a', 'n', 0});
    put(info, IFLA_INFO_DATA, data);
    put(bytes, IFLA_IFNAME, {'c', 'a', 'n', '0', 0});
    put(bytes, IFLA_LINKINFO | NLA_F_NESTED, info);
    finish();
  }
  CanLink link() const { return parseLink(bytes.data(), bytes.size()); }

  std::vector<uint8_t> bytes;

private:
  static void put(std::vector<uint8_t> &to, uint16_t type, const std::vector<uint8_t> &payload) {
    rtattr head{};
    head.rta_len = static_cast<uint16_t>(sizeof head + payload.size());
    head.rta_type = type;
    const auto *raw = reinterpret_cast<const uint8_t *>(&head);
    to.insert(to.end(), raw, raw + sizeof head);
    to.insert(to.end(), payload.begin(), payload.end());
    to.resize((to.size() + 3) / 4 * 4);
  }
  void append(const void *data, size_t size) {
    const auto *raw = static_cast<const uint8_t *>(data);
    bytes.insert(bytes.end(), raw, raw + size);
  }
  void finish() {
    const auto size = static_cast<uint32_t>(bytes.size());
    std::memcpy(bytes.data(), &size, sizeof size); // nlmsg_len
  }
};

template <class T> std::vector<uint8_t> raw(const T &value) {
  std::vector<uint8_t> result(sizeof value);
  std::memcpy(result.data(), &value, sizeof value);
  return result;
}

TEST(CanLinks, StateAndBitRate) {
  EXPECT_FALSE(LinkAnswer(false).link().isUp);
  EXPECT_TRUE(LinkAnswer(true).link().isUp);
  EXPECT_EQ(LinkAnswer(true).link().bitRate, 0U) << "virtual";
  EXPECT_FALSE(LinkAnswer(true).link().hasState);
  can_bittiming timing{};
  timing.bitrate = 500000;
  const std::array<ControllerState, 6> states = {ControllerState::Active,  ControllerState::Warning,
                                                 ControllerState::Passive, ControllerState::BusOff,
                                                 ControllerState::Down,    ControllerState::Down};
  for (uint32_t state = 0; state < states.size(); ++state) {
    LinkAnswer answer(true);
    answer.addData({{IFLA_CAN_BITTIMING, raw(timing)}, {IFLA_CAN_STATE, raw(state)}});
    const CanLink link = answer.link();
    EXPECT_TRUE(link.known);
    EXPECT_EQ(link.bitRate, 500000U);
    EXPECT_TRUE(link.hasState);
    EXPECT_EQ(link.state, states[state]);
  }
}

TEST(CanLinks, WhateverTheAnswerIsNothingIsReadBeyondIt) {
  can_bittiming timing{};
  timing.bitrate = 500000;
  LinkAnswer answer(true);
  answer.addData({{IFLA_CAN_BITTIMING, raw(timing)}, {IFLA_CAN_STATE, raw(uint32_t{1})}});
  for (size_t size = 0; size < answer.bytes.size(); ++size) {
    const std::vector<uint8_t> part(answer.bytes.begin(),
                                    answer.bytes.begin() + static_cast<ptrdiff_t>(size));
    EXPECT_FALSE(parseLink(part.data(), part.size()).known) << "it says that it is longer";
  }
  std::mt19937 random(1);
  for (int i = 0; i < 50000; ++i) {
    std::vector<uint8_t> bytes = answer.bytes;
    for (int k = 0; k < 3; ++k)
      bytes[16 + random() % (bytes.size() - 16)] = static_cast<uint8_t>(random());
    bytes.shrink_to_fit();
    (void)parseLink(bytes.data(), bytes.size());
  }
}

TEST(CanLinks, OfTheLoopbackInterface) {
  const CanLink link = readLink(::if_nametoindex("lo"));
  ASSERT_TRUE(link.known) << "no netlink here";
  EXPECT_EQ(link.bitRate, 0U);
  EXPECT_FALSE(link.hasState);
  EXPECT_FALSE(readLink(99999).known);
}

} // namespace
} // namespace stride::can
