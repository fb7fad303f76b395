// A port that writes down what is sent and gives what a test puts there, and nodes that answer by
// lists: no simulation of anything.
#ifndef STRIDE_TESTS_UNIT_CAN_MASTER_FAKE_BUS_HPP
#define STRIDE_TESTS_UNIT_CAN_MASTER_FAKE_BUS_HPP

#include "drivers/can/port/port.hpp"
#include "runtime/bus/axis_driver.hpp"
#include "tests/unit/can_master/script.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace stride::can::test {

class FakePort final : public Port {
public:
  void beginCycle() noexcept override { ++cycles; }
  SendResult send(const Frame &frame, SendClass sendClass) noexcept override {
    if (result != SendResult::Sent && (!onlyProcess || sendClass == SendClass::Process))
      return result;
    sent.push_back(frame);
    allSent.push_back(frame);
    if (heard)
      heard(frame);
    return SendResult::Sent;
  }
  size_t receive(std::span<Received> frames) noexcept override {
    size_t count = 0;
    taken.emplace_back();
    for (; count < frames.size() && !toReceive.empty(); ++count) {
      frames[count].frame = toReceive.front();
      taken.back().push_back(toReceive.front());
      toReceive.pop_front();
    }
    return count;
  }
  bool wait(int64_t monotonicNs) noexcept override {
    waited.push_back(monotonicNs);
    if (echoes > 0) {
      --echoes;
      return true;
    }
    if (arriving.empty())
      return false;
    toReceive.push_back(arriving.front());
    arriving.pop_front();
    return true;
  }
  int64_t monotonicNs() const noexcept override { return clock; }
  int64_t utcNs() const noexcept override { return utc; }
  ControllerState state() const noexcept override { return controller; }
  std::string_view problem() const noexcept override { return whyDown; }
  size_t unconfirmed() const noexcept override { return late; }
  PortCounters counters() const noexcept override { return portCounters; }

  void give(const std::string &text) { toReceive.push_back(test::frame(text)); }
  /// What has been sent since the last call, as texts.
  std::vector<std::string> takeSent() {
    std::vector<std::string> result;
    for (const Frame &frame : sent)
      result.push_back(test::text(frame));
    sent.clear();
    return result;
  }

  std::vector<Frame> sent;
  std::vector<Frame> allSent;            ///< From the beginning.
  std::vector<std::vector<Frame>> taken; ///< By each receive().
  std::deque<Frame> toReceive;
  std::deque<Frame> arriving; ///< While somebody waits.
  std::vector<int64_t> waited;
  std::function<void(const Frame &)> heard;
  SendResult result = SendResult::Sent;
  bool onlyProcess = false; ///< The result is that of process data only.
  ControllerState controller = ControllerState::Active;
  std::string whyDown;
  PortCounters portCounters;
  size_t late = 0;
  int64_t clock = -1; ///< Of wait().
  int64_t utc = -1;
  int echoes = 0; ///< Frames of its own, which end a wait and are not received.
  int cycles = 0;
};

/// A node that answers SDOs up to four bytes from a list, and NMT by what is written here.
class ScriptedNode {
public:
  ScriptedNode(FakePort &port, uint8_t number) : port_(&port), number_(number) {
    values[0x100000] = {4, 0x00020192};
    values[0x606100] = {1, 0};
  }

  struct Value {
    uint8_t size = 4;
    uint32_t value = 0;
  };

  /// What the node does about a frame of the master.
  void hear(const Frame &frame) {
    if (frame.id == 0x600 + number_)
      answerSdo(frame);
    else if (frame.id == 0 && (frame.data[1] == number_ || frame.data[1] == 0))
      hearNmt(frame.data[0]);
    else if (frame.id == 0x080)
      for (const std::string &pdo : atSync)
        port_->give(pdo);
  }

  void say(uint32_t base, const std::string &bytes) {
    char id[8];
    std::snprintf(id, sizeof id, "%03X#", base + number_);
    port_->give(id + bytes);
  }

  /// "6060:0=8" for each write, in order.
  std::vector<std::string> written;
  std::map<uint32_t, Value>
      values; ///< By index * 256 + subindex; what is not there does not exist.
  std::map<uint32_t, uint32_t> aborts;      ///< The same, with codes; for reads and writes.
  std::map<uint32_t, uint32_t> writeAborts; ///< For writes only.
  std::vector<std::string> atSync;          ///< Frames that follow a SYNC in operation.
  std::vector<std::string> pdosInOperation;
  bool answers = true;
  bool boots = true;         ///< After a reset.
  bool starts = true;        ///< By NMT.
  bool acceptsWrites = true; ///< Of objects that are not listed.
  bool modeFollows = true;   ///< 6061h is what 6060h was.
  std::string state = "7F";

private:
  void hearNmt(uint8_t command) {
    if ((command == 0x81 || command == 0x82) && boots) {
      atSync.clear();
      state = "7F";
      say(0x700, "00");
    } else if (command == 0x01 && starts) {
      state = "05";
      say(0x700, state);
      atSync = pdosInOperation;
    } else if (command == 0x80) {
      state = "7F";
      atSync.clear();
    }
  }

  void answerSdo(const Frame &frame) {
    if (!answers || frame.data[0] == 0x80)
      return;
    const uint32_t key =
        uint32_t{frame.data[2]} << 16U | uint32_t{frame.data[1]} << 8U | frame.data[3];
    char text[40];
    const auto abort = [&](uint32_t code) {
      std::snprintf(text, sizeof text, "80%02X%02X%02X%02X%02X%02X%02X", frame.data[1],
                    frame.data[2], frame.data[3], code & 0xFFU, code >> 8U & 0xFFU,
                    code >> 16U & 0xFFU, code >> 24U);
      say(0x580, text);
    };
    if (const auto found = aborts.find(key); found != aborts.end()) {
      abort(found->second);
    } else if (frame.data[0] == 0x40) {
      const auto value = values.find(key);
      if (value == values.end()) {
        abort(0x06020000);
        return;
      }
      const uint32_t number = value->second.value;
      std::snprintf(text, sizeof text, "%02X%02X%02X%02X%02X%02X%02X%02X",
                    0x43U | (4U - value->second.size) << 2U, frame.data[1], frame.data[2],
                    frame.data[3], number & 0xFFU, number >> 8U & 0xFFU, number >> 16U & 0xFFU,
                    number >> 24U);
      say(0x580, text);
    } else if (const auto refused = writeAborts.find(key); refused != writeAborts.end()) {
      abort(refused->second);
    } else if (!acceptsWrites && !values.contains(key)) {
      abort(0x06020000);
    } else {
      write(frame, key);
    }
  }

  void write(const Frame &frame, uint32_t key) {
    char text[40];
    const unsigned size = 4 - (frame.data[0] >> 2U & 3U);
    uint32_t number = 0;
    for (unsigned i = 0; i < size; ++i)
      number |= uint32_t{frame.data[4 + i]} << 8 * i;
    std::snprintf(text, sizeof text, "%04X:%u/%u=%X", key >> 8U, key & 0xFFU, size, number);
    written.emplace_back(text);
    values[key] = {static_cast<uint8_t>(size), number};
    if (key == 0x606000 && modeFollows)
      values[0x606100] = {1, number};
    std::snprintf(text, sizeof text, "60%02X%02X%02X00000000", frame.data[1], frame.data[2],
                  frame.data[3]);
    say(0x580, text);
  }

  FakePort *port_;
  uint8_t number_;
};

/// Who runs a driver, and what it has told him.
class FakeHost final : public bus::DriverHost {
public:
  void raise(bus::BusEvent) noexcept override { ++syncs; }
  void say(const bus::Message &message) noexcept override { news.emplace_back(message.text()); }
  /// Whether something with that text has been said since the last call; the others stay.
  bool heard(const std::string &part) {
    const auto one = std::find_if(news.begin(), news.end(), [&](const std::string &text) {
      return text.find(part) != std::string::npos;
    });
    if (one == news.end())
      return false;
    news.erase(one);
    return true;
  }
  std::vector<std::string> news;
  int syncs = 0;
};

} // namespace stride::can::test

#endif
