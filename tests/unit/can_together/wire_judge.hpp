// Looks at all that a master says on the wire, by the rules of CiA 301 and 402 and nothing of its
// code.
#ifndef STRIDE_TESTS_UNIT_CAN_TOGETHER_WIRE_JUDGE_HPP
#define STRIDE_TESTS_UNIT_CAN_TOGETHER_WIRE_JUDGE_HPP

#include "drivers/can/plan/pdo_plan.hpp"
#include "drivers/can/simulation/drive402.hpp"
#include "drivers/can/simulation/simulated_bus.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace stride::can {

class WireJudge final : public simulation::Tap {
public:
  static constexpr uint8_t kMaster = 126; ///< Its own number.

  /// `step`: the largest change of a set position in a cycle. [inc]
  explicit WireJudge(int32_t step) : step_(step) {}

  void watch(const DrivePlan &plan, const simulation::SimulatedDrive402 &drive) {
    nodes_.emplace_back(plan, drive);
  }

  /// The first thing that was wrong; empty: nothing.
  [[nodiscard]] const std::string &complaint() const { return complaint_; }
  [[nodiscard]] uint64_t frames() const { return frames_; }
  /// The largest change of a set position that a drive carried out. [inc]
  [[nodiscard]] int32_t largestStep() const { return largest_; }

  void seen(const Frame &frame, int64_t endNs, simulation::Station sender) noexcept override {
    if (sender != 0) {
      hear(frame);
      return;
    }
    ++frames_;
    if (frame.id == 0x000)
      networkManagement(frame);
    else if (frame.id == 0x080)
      synchronize(frame);
    else if (frame.id == 0x700 + kMaster)
      demand(frame.length == 1 && frame.data[0] == 5, "heartbeat", frame);
    else if (frame.id > 0x600 && frame.id < 0x680)
      request(frame, endNs);
    else
      processData(frame);
  }

private:
  struct Watched {
    Watched(const DrivePlan &drivePlan, const simulation::SimulatedDrive402 &itsDrive)
        : plan(drivePlan), drive(&itsDrive) {}
    DrivePlan plan;
    const simulation::SimulatedDrive402 *drive;
    std::array<uint16_t, 12> statuswords{}; ///< The last ones that it has said …
    size_t heard = 0;                       ///< … and how many there have been.
    uint16_t controlword = 0;
    std::optional<int32_t> target; ///< As last told …
    std::optional<int32_t> valid;  ///< … and at the last SYNC.
    bool asked = false;            ///< By SDO, and has not answered yet.
    int64_t askedNs = 0;
    bool toggle = false;
  };

  void demand(bool holds, const char *what, const Frame &frame) {
    if (holds || !complaint_.empty())
      return;
    complaint_ = std::string(what) + ": " + text(frame);
  }

  static std::string text(const Frame &frame) {
    std::string result;
    const auto put = [&result](unsigned value, int digits) {
      for (int i = digits - 1; i >= 0; --i)
        result += "0123456789ABCDEF"[value >> 4 * i & 15U];
    };
    put(frame.id, 3);
    result += frame.remote ? "#R" : "#";
    for (const uint8_t byte : frame.bytes())
      put(byte, 2);
    return result;
  }

  Watched *find(unsigned node) {
    const auto found = std::find_if(nodes_.begin(), nodes_.end(),
                                    [node](const Watched &one) { return one.plan.node == node; });
    return found == nodes_.end() ? nullptr : &*found;
  }

  /// Of `bits` at that bit of the frame.
  static uint32_t numberAt(const Frame &frame, unsigned at, unsigned bits) {
    uint64_t all = 0;
    for (unsigned i = 0; i < 8; ++i)
      all |= uint64_t{frame.data[i]} << 8 * i;
    return static_cast<uint32_t>(all >> at & ((uint64_t{1} << bits) - 1));
  }

  static std::optional<uint32_t> objectIn(const Pdo &pdo, const Frame &frame, uint16_t index) {
    unsigned at = 0;
    for (const PdoEntry &entry : pdo.mapped()) {
      if (entry.object.index == index)
        return numberAt(frame, at, entry.bits);
      at += entry.bits;
    }
    return std::nullopt;
  }

  /// What nodes say.
  void hear(const Frame &frame) {
    if (frame.id > 0x580 && frame.id < 0x600) {
      if (Watched *const node = find(frame.id - 0x580U))
        node->asked = false;
      return;
    }
    for (Watched &node : nodes_)
      for (const Pdo &pdo : node.plan.sentByDrive())
        if ((pdo.cobId & 0x7FFU) == frame.id && frame.length == pdo.length())
          if (const auto word = objectIn(pdo, frame, 0x6041)) {
            node.statuswords[node.heard++ % node.statuswords.size()] = static_cast<uint16_t>(*word);
          }
  }

  void networkManagement(const Frame &frame) {
    constexpr std::array<uint8_t, 5> kCommands = {0x01, 0x02, 0x80, 0x81, 0x82};
    demand(frame.length == 2 && !frame.remote &&
               std::find(kCommands.begin(), kCommands.end(), frame.data[0]) != kCommands.end() &&
               find(frame.data[1]) != nullptr,
           "NMT", frame);
    if (Watched *const node = find(frame.data[1]))
      node->asked = false;
  }

  void request(const Frame &frame, int64_t endNs) {
    Watched *const node = find(frame.id - 0x600U);
    demand(node != nullptr && frame.length == 8 && !frame.remote, "SDO", frame);
    if (node == nullptr)
      return;
    const unsigned first = frame.data[0];
    const auto zeros = [&frame](size_t from) {
      return std::all_of(frame.data.begin() + static_cast<ptrdiff_t>(from), frame.data.end(),
                         [](uint8_t byte) { return byte == 0; });
    };
    constexpr int64_t kTimeoutNs = 490'000'000;
    const bool free = !node->asked || endNs - node->askedNs > kTimeoutNs;
    switch (first >> 5U) {
    case 0: // a segment down
      demand(free && ((first >> 4U & 1U) != 0) == node->toggle, "segment down", frame);
      demand(zeros(8 - (first >> 1U & 7U)), "unused bytes of a segment", frame);
      node->toggle = !node->toggle;
      break;
    case 1: // begins a download
      demand(free && (first & 0x10U) == 0 && (first & 1U) != 0, "download", frame);
      demand((first & 2U) != 0 ? zeros(8 - (first >> 2U & 3U)) : (first & 0x0CU) == 0,
             "size of a download", frame);
      node->toggle = false;
      break;
    case 2: // begins an upload
      demand(free && first == 0x40 && zeros(4), "upload", frame);
      node->toggle = false;
      break;
    case 3: // a segment up
      demand(free && (first & 0x0FU) == 0 && ((first >> 4U & 1U) != 0) == node->toggle && zeros(1),
             "segment up", frame);
      node->toggle = !node->toggle;
      break;
    case 4:
      demand(first == 0x80 && numberAt(frame, 32, 32) != 0, "abort", frame);
      node->asked = false;
      return;
    default: // blocks
      break;
    }
    node->asked = true;
    node->askedNs = endNs;
  }

  void processData(const Frame &frame) {
    for (Watched &node : nodes_)
      for (const Pdo &pdo : node.plan.receivedByDrive())
        if ((pdo.cobId & 0x7FFU) == frame.id) {
          demand(frame.length == pdo.length() && !frame.remote, "length of a PDO", frame);
          if (const auto word = objectIn(pdo, frame, 0x6040))
            control(node, static_cast<uint16_t>(*word), frame);
          if (const auto target = objectIn(pdo, frame, 0x607A))
            node.target = static_cast<int32_t>(*target);
          return;
        }
    demand(false, "nobody's frame", frame);
  }

  /// A word that leads on is only said to a drive that has shown the state before it.
  void control(Watched &node, uint16_t word, const Frame &frame) {
    constexpr std::array<uint16_t, 7> kWords = {0x00, 0x02, 0x06, 0x07, 0x0F, 0x1F, 0x80};
    demand(std::find(kWords.begin(), kWords.end(), word) != kWords.end(), "controlword", frame);
    const auto shown = [&node](unsigned mask, std::initializer_list<unsigned> values) {
      return std::any_of(node.statuswords.begin(), node.statuswords.end(), [&](uint16_t status) {
        return std::find(values.begin(), values.end(), status & mask) != values.end();
      });
    };
    if ((word & 0x0FU) == 0x0F)
      demand(shown(0x6F, {0x23, 0x27}), "enabled out of turn", frame);
    if (word == 0x07)
      demand(shown(0x6F, {0x21, 0x23, 0x27}), "switched on out of turn", frame);
    if (word == 0x80 && node.controlword != 0x80)
      demand(shown(0x4F, {0x08}), "a reset of no fault", frame);
    node.controlword = word;
  }

  /// What all drives that follow are to do next.
  void synchronize(const Frame &frame) {
    demand(frame.length == 0 && !frame.remote, "SYNC", frame);
    for (Watched &node : nodes_) {
      const simulation::DriveAxis &axis = node.drive->axis(0);
      const bool follows = axis.power() == simulation::PowerState::OperationEnabled &&
                           axis.mode() == 8 && (node.controlword & 0x0FU) == 0x0F;
      if (follows && node.target && node.valid) {
        const auto step = std::abs(static_cast<int32_t>(static_cast<uint32_t>(*node.target) -
                                                        static_cast<uint32_t>(*node.valid)));
        largest_ = std::max(largest_, step);
        if (step > step_ && complaint_.empty())
          complaint_ =
              "node " + std::to_string(node.plan.node) + " shall jump by " + std::to_string(step);
      }
      node.valid = node.target;
    }
  }

  int32_t step_;
  std::vector<Watched> nodes_;
  std::string complaint_;
  uint64_t frames_ = 0;
  int32_t largest_ = 0;
};

} // namespace stride::can

#endif
