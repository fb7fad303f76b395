// Looks at all that a master says on the ring, and at where its drives go, by the rules of the
// telegrams and nothing of its code.
#ifndef STRIDE_TESTS_UNIT_SERCOS_TOGETHER_RING_JUDGE_HPP
#define STRIDE_TESTS_UNIT_SERCOS_TOGETHER_RING_JUDGE_HPP

#include "drivers/sercos/ring/ring.hpp"
#include "drivers/sercos/simulation/simulated_drive.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace stride::sercos {

/// Numbers of bits and places are written out: it is a second reading of S-0-0134 and S-0-0135.
class RingJudge {
public:
  /// `step`: the largest way of a cycle that a drive is told. `change`: that of two such ways,
  /// which a drive makes up for that has gone on by itself for a cycle. [inc]
  RingJudge(int64_t step, int64_t change) : step_(step), change_(change) {}

  void watch(simulation::SimulatedDrive &drive) { drives_.push_back(Watched{&drive}); }

  /// The first thing that was wrong; empty: nothing.
  [[nodiscard]] const std::string &complaint() const { return complaint_; }
  /// The largest way of a drive in a cycle. [inc]
  [[nodiscard]] int64_t largestWay() const { return largest_; }

  /// After each cycle of the ring, with what it has really carried.
  void cycle(const MasterTelegrams &sent, const RingAnswers &answers) {
    judgePhase(sent, answers);
    judgeMdt(sent);
    for (Watched &one : drives_)
      judgeWay(one);
    for (Watched &one : drives_)
      one.voices = 0;
    for (const DriveTelegram &telegram : answers.ats())
      if (sent.phase >= Phase::Three || telegram.address == sent.mdtAddress)
        hear(telegram);
    phase_ = static_cast<unsigned>(sent.phase);
    ++cycles_;
  }

private:
  struct Watched {
    simulation::SimulatedDrive *drive;
    bool begun = false;
    int64_t before = 0;    ///< Where it was. [inc]
    unsigned said = 0;     ///< Its last status word.
    unsigned control = 0;  ///< The last control word to it …
    unsigned info = 0;     ///< … and word of the service channel.
    bool told = false;     ///< There has been one since the phase began that clears the channel.
    int voices = 0;        ///< That have its address in this cycle.
    bool answered = true;  ///< It has said something after that.
    bool followed = false; ///< The last MDT had a position that it follows.
    uint32_t target = 0;   ///< That one. [inc]
  };

  void complain(const std::string &what) {
    if (complaint_.empty())
      complaint_ = what + " in cycle " + std::to_string(cycles_);
  }

  /// Upwards one by one, after ten MSTs that have come back; or down to 0.
  void judgePhase(const MasterTelegrams &sent, const RingAnswers &answers) {
    const auto now = static_cast<unsigned>(sent.phase);
    if (now > 4 || (now != 0 && now != phase_ && now != phase_ + 1))
      complain("phase " + std::to_string(now) + " after " + std::to_string(phase_));
    if (now == 1 && phase_ == 0 && returned_ < 10)
      complain("phase 1 after " + std::to_string(returned_) + " MSTs");
    returned_ = answers.mstReturned ? returned_ + 1 : 0;
    if (now == 2 && phase_ == 1)
      for (Watched &one : drives_)
        one.told = false;
  }

  static unsigned wordAt(const MasterTelegrams &sent, size_t place) {
    return sent.mdtData[place] | static_cast<unsigned>(sent.mdtData[place + 1]) << 8U;
  }

  void judgeMdt(const MasterTelegrams &sent) {
    // With the MST that begins a phase goes an MDT that nobody understands yet.
    const auto phase = static_cast<unsigned>(sent.phase);
    if (phase_ < 4 || !sent.mdt)
      for (Watched &one : drives_)
        one.followed = false;
    if (!sent.mdt)
      return;
    if (phase == 0)
      complain("an MDT in phase 0");
    if (phase < 3) {
      if (sent.mdtAddress == 0 || sent.mdtAddress == 255 || sent.mdtLength != 4)
        complain("MDT of phase " + std::to_string(phase));
      for (Watched &one : drives_)
        if (phase == 2 && one.drive->address() == sent.mdtAddress)
          judgeChannel(one, wordAt(sent, 0), wordAt(sent, 2));
      return;
    }
    if (sent.mdtAddress != 255)
      complain("MDT to one drive in phase " + std::to_string(phase));
    for (Watched &one : drives_) {
      const auto place = static_cast<size_t>(one.drive->list().value(9)) - 1; // S-0-0009
      if (place + 8 > sent.mdtLength) // a drive that is not in the ring has none
        continue;
      judgeChannel(one, wordAt(sent, place), wordAt(sent, place + 2));
      judgeControl(one, sent, place);
    }
  }

  /// A step begins when the one before it is over; until then word and bits stay.
  void judgeChannel(Watched &one, unsigned control, unsigned info) {
    const bool turned = ((control ^ one.control) & 1U) != 0;
    if (one.told) {
      const bool over =
          one.answered && ((one.said ^ one.control) & 1U) == 0 && (one.said & 2U) == 0;
      if (turned && !over)
        complain("a step of the service channel before the last one was over");
      if (!turned && (((control ^ one.control) & 0x3FU) != 0 || info != one.info))
        complain("a step of the service channel changes");
    }
    one.told = true;
    one.control = control;
    one.info = info;
    one.answered = one.answered && !turned;
  }

  void judgeControl(Watched &one, const MasterTelegrams &sent, size_t place) {
    const unsigned power = one.control >> 13U & 7U;
    if (phase_ == 3 && power != 0)
      complain("power in phase 3");
    if ((power & 4U) != 0 && (power & 2U) == 0)
      complain("on without enable");
    const bool follows = phase_ == 4 && power == 7 && one.drive->hasTorque() && isHomed(one);
    const uint32_t target = wordAt(sent, place + 4) | wordAt(sent, place + 6) << 16U;
    const int64_t way = static_cast<int32_t>(target - one.target);
    if (follows && one.followed && std::abs(way) > step_)
      complain("address " + std::to_string(one.drive->address()) + " shall jump by " +
               std::to_string(way));
    one.followed = follows;
    one.target = target;
  }

  /// It does not look for its reference: S-0-0148 is not set.
  static bool isHomed(const Watched &one) {
    const simulation::IdnEntry *const command = one.drive->list().find(148);
    return command == nullptr || (command->state & 3U) == 0;
  }

  void judgeWay(Watched &one) {
    const int64_t now = one.drive->mechanics().position();
    const int64_t way = std::abs(now - one.before);
    if (one.begun && way > step_ + change_)
      complain("address " + std::to_string(one.drive->address()) + " jumps by " +
               std::to_string(now - one.before));
    if (one.begun)
      largest_ = std::max(largest_, way);
    one.before = now;
    one.begun = true;
  }

  void hear(const DriveTelegram &telegram) {
    if (telegram.distorted || telegram.length < 4)
      return;
    for (Watched &one : drives_)
      if (one.drive->address() == telegram.address) {
        one.said = telegram.data[0] | static_cast<unsigned>(telegram.data[1]) << 8U;
        one.answered = true;
        if (++one.voices > 1) // nobody can tell who has said what
          one.told = false;
      }
  }

  int64_t step_;
  int64_t change_;
  std::vector<Watched> drives_;
  std::string complaint_;
  int64_t largest_ = 0;
  unsigned phase_ = 0;    ///< Of the MST of the cycle before: the form of the MDT.
  unsigned returned_ = 0; ///< MSTs, one after the other.
  uint64_t cycles_ = 0;
};

} // namespace stride::sercos

#endif
