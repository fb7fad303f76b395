// A master for tests, written from the description of the ring: it knows bits by their places.
#ifndef STRIDE_TESTS_UNIT_SERCOS_SIMULATION_RING_MASTER_HPP
#define STRIDE_TESTS_UNIT_SERCOS_SIMULATION_RING_MASTER_HPP

#include "drivers/sercos/simulation/simulated_drive.hpp"
#include "drivers/sercos/simulation/simulated_io.hpp"
#include "drivers/sercos/simulation/simulated_ring.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stride::sercos::simulation {

inline DriveSetup plainDrive(uint8_t address = 3) {
  DriveSetup setup;
  setup.device.address = address;
  setup.drive.mechanics.cycle = 0.002;
  setup.drive.switchCycles = 1;
  setup.drive.probeInputs = 15;
  setup.drive.homing = {false, 20000, 3000, 1'000'000};
  setup.drive.startPosition = 777;
  setup.incrementsPerTurn = 4096;
  return setup;
}

struct Answer {
  uint16_t error = 0;
  std::vector<uint8_t> bytes;
  unsigned cycles = 0;

  [[nodiscard]] int64_t number() const {
    uint64_t value = 0;
    for (size_t i = 0; i < bytes.size(); ++i)
      value |= uint64_t{bytes[i]} << (8 * i);
    return bytes.size() == 4 ? static_cast<int32_t>(value) : static_cast<int64_t>(value);
  }
  [[nodiscard]] std::string text() const {
    const size_t length = bytes[0] | static_cast<size_t>(bytes[1] << 8U);
    return {bytes.begin() + 4, bytes.begin() + 4 + static_cast<ptrdiff_t>(length)};
  }
  [[nodiscard]] std::vector<Idn> ids() const {
    std::vector<Idn> all;
    for (size_t i = 4; i + 1 < bytes.size(); i += 2)
      all.push_back(static_cast<Idn>(bytes[i] | (bytes[i + 1] << 8U)));
    return all;
  }
};

class RingMaster {
public:
  struct Record {
    size_t place = 0; ///< In the data field of the MDT.
    uint16_t control = 0;
    uint16_t word = 0;
    std::vector<uint8_t> data;
    // What its last AT said.
    uint16_t status = 0;
    uint16_t answer = 0;
    std::vector<uint8_t> feedback;
    unsigned seen = 0; ///< ATs of the last cycle.
  };

  SimulatedRing ring;
  std::map<uint8_t, Record> records;
  uint8_t phase = 0;
  uint8_t asked = 0;
  int64_t periodNs = 2'000'000;
  uint16_t mdtLength = 0;
  bool sendMst = true;
  bool sendMdt = true;
  RingAnswers answers;

  void cycle(unsigned times = 1) {
    for (; times > 0; --times)
      one();
  }

  /// Steps of the service channel until it answers; error 0xFFFF: it does not.
  Answer step(uint8_t address, unsigned element, bool write, bool end, uint16_t word) {
    Record &record = records[address];
    asked = address;
    record.control = static_cast<uint16_t>((record.control & 0xFFC1U) ^ 1U);
    record.control |= static_cast<uint16_t>(element << 3U | (end ? 4U : 0U) | (write ? 2U : 0U));
    record.word = word;
    Answer result;
    for (result.cycles = 1; result.cycles < 60; ++result.cycles) {
      one();
      const bool settled = record.seen != 0 && (record.status & 1U) == (record.control & 1U) &&
                           (record.status & 2U) == 0;
      if (!settled)
        continue;
      if ((record.status & 4U) != 0)
        result.error = record.answer;
      result.bytes = {static_cast<uint8_t>(record.answer),
                      static_cast<uint8_t>(record.answer >> 8U)};
      return result;
    }
    result.error = 0xFFFF;
    return result;
  }

  Answer open(uint8_t address, Idn idn) { return step(address, 1, true, true, idn); }

  /// `bytes` 0: a list or a text.
  Answer read(uint8_t address, Idn idn, unsigned element = 7, size_t bytes = 2) {
    Answer all = open(address, idn);
    if (all.error != 0)
      return all;
    all.bytes.clear();
    size_t length = bytes == 0 ? 4 : bytes;
    for (size_t place = 0; place < length; place += 2) {
      const bool knows = bytes != 0 || place >= 2;
      const Answer answer = step(address, element, false, knows && place + 2 >= length, 0);
      all.cycles += answer.cycles;
      if (answer.error != 0) {
        all.error = answer.error;
        return all;
      }
      all.bytes.insert(all.bytes.end(), answer.bytes.begin(), answer.bytes.end());
      if (bytes == 0 && place == 0)
        length = 4 + static_cast<size_t>((answer.number() + 1) / 2 * 2);
    }
    return all;
  }

  uint16_t writeBytes(uint8_t address, Idn idn, const std::vector<uint8_t> &bytes) {
    const Answer opened = open(address, idn);
    if (opened.error != 0)
      return opened.error;
    for (size_t place = 0; place < bytes.size(); place += 2) {
      const auto word = static_cast<uint16_t>(bytes[place] | (bytes[place + 1] << 8U));
      const Answer answer = step(address, 7, true, place + 2 >= bytes.size(), word);
      if (answer.error != 0)
        return answer.error;
    }
    return 0;
  }
  uint16_t write(uint8_t address, Idn idn, int64_t value, size_t bytes = 2) {
    std::vector<uint8_t> all;
    for (size_t i = 0; i < bytes; ++i)
      all.push_back(static_cast<uint8_t>(static_cast<uint64_t>(value) >> (8 * i)));
    return writeBytes(address, idn, all);
  }
  uint16_t writeIds(uint8_t address, Idn idn, const std::vector<Idn> &ids) {
    const auto length = static_cast<uint8_t>(2 * ids.size());
    std::vector<uint8_t> bytes = {length, 0, length, 0};
    for (const Idn one : ids) {
      bytes.push_back(static_cast<uint8_t>(one));
      bytes.push_back(static_cast<uint8_t>(one >> 8U));
    }
    return writeBytes(address, idn, bytes);
  }
  std::vector<Idn> ids(uint8_t address, Idn idn) { return read(address, idn, 7, 0).ids(); }

  /// Starts a procedure command and waits; its state at the end. It is cancelled then.
  uint16_t command(uint8_t address, Idn idn, unsigned mostCycles = 200) {
    if (const uint16_t error = write(address, idn, 3); error != 0)
      return error;
    uint16_t state = 7;
    for (unsigned i = 0; i < mostCycles && state == 7; ++i)
      state = static_cast<uint16_t>(read(address, idn, 1).number() & 15);
    if (state == 7)
      return state;
    write(address, idn, 0);
    return state;
  }

  // ---- the way up
  void toPhase1() {
    phase = 0;
    for (auto &[address, record] : records)
      record.control = record.word = 0; // the drives begin with AHS 0
    cycle(10);
    phase = 1;
    for (const auto &[address, record] : records) {
      asked = address;
      cycle(2);
    }
  }
  void toPhase2() {
    toPhase1();
    phase = 2;
    cycle();
  }
  /// Times for all drives, with telegrams of `atBytes` and `mdtBytes` of cyclic data.
  void writeTimes(size_t atBytes = 4, size_t mdtBytes = 4, int64_t telegramType = 4) {
    mdtLength = 0;
    int64_t start = 20;
    const auto cycleUs = periodNs / 1000;
    std::map<uint8_t, int64_t> starts;
    for (auto &[address, record] : records) {
      record.place = mdtLength;
      mdtLength = static_cast<uint16_t>(mdtLength + 4 + mdtBytes);
      starts[address] = start;
      start += telegramLength(4 + atBytes) + 10;
    }
    for (auto &[address, record] : records) {
      record.data.assign(mdtBytes, 0);
      EXPECT_EQ(write(address, 15, telegramType), 0);
      EXPECT_EQ(write(address, 1, cycleUs), 0);
      EXPECT_EQ(write(address, 2, cycleUs), 0);
      EXPECT_EQ(write(address, 6, starts[address]), 0);
      EXPECT_EQ(write(address, 89, start + 20), 0);
      EXPECT_EQ(write(address, 7, cycleUs - 300), 0);
      EXPECT_EQ(write(address, 8, cycleUs), 0);
      EXPECT_EQ(write(address, 9, static_cast<int64_t>(record.place) + 1), 0);
      EXPECT_EQ(write(address, 10, mdtLength), 0);
    }
  }
  void toPhase3() {
    toPhase2();
    writeTimes();
    check(127);
    phase = 3;
    cycle(3);
  }
  void check(Idn idn) {
    for (const auto &[address, record] : records)
      EXPECT_EQ(command(address, idn), 3) << "drive " << int{address};
  }
  void toPhase4() {
    toPhase3();
    for (const auto &[address, record] : records)
      EXPECT_EQ(write(address, 32, 3), 0);
    check(128);
    phase = 4;
    cycle(3);
  }

  void setControl(uint8_t address, uint16_t high) {
    Record &record = records[address];
    record.control = static_cast<uint16_t>((record.control & 0x003FU) | (high & 0xFFC0U));
  }
  void setTarget(uint8_t address, int64_t value, size_t place = 0, size_t bytes = 4) {
    for (size_t i = 0; i < bytes; ++i)
      records[address].data[place + i] =
          static_cast<uint8_t>(static_cast<uint64_t>(value) >> (8 * i));
  }
  [[nodiscard]] int32_t actual(uint8_t address, size_t place = 0) {
    const std::vector<uint8_t> &data = records[address].feedback;
    uint32_t value = 0;
    for (size_t i = 0; i < 4 && place + i < data.size(); ++i)
      value |= uint32_t{data[place + i]} << (8 * i);
    return static_cast<int32_t>(value);
  }
  /// Follows what the drive says until it has power.
  void powerOn(uint8_t address) {
    setTarget(address, actual(address));
    setControl(address, 0xE000);
    cycle(4);
    EXPECT_EQ(records[address].status >> 14U, 3U);
  }

private:
  static int64_t telegramLength(size_t bytes) { // at 2 MBit/s
    return static_cast<int64_t>((16 + (24 + 8 * bytes) * 6 / 5 + 1) / 2 + 1);
  }

  void one() {
    MasterTelegrams &sent = sent_;
    sent.periodNs = periodNs;
    sent.mst = sendMst;
    sent.phase = static_cast<Phase>(phase);
    sent.mdt = sendMdt && phase != 0;
    sent.mdtAddress = phase >= 3 ? 255 : asked;
    if (phase >= 3) {
      sent.mdtLength = mdtLength;
      for (const auto &[address, record] : records)
        put(sent, record.place, record);
    } else {
      sent.mdtLength = 4;
      const auto one = records.find(asked);
      put(sent, 0, one != records.end() ? one->second : Record{});
    }
    ring.cycle(sent, answers);
    for (auto &[address, record] : records)
      record.seen = 0;
    for (const DriveTelegram &at : answers.ats()) {
      const auto found = records.find(at.address);
      if (found == records.end() || at.distorted)
        continue;
      Record &record = found->second;
      ++record.seen;
      record.status = static_cast<uint16_t>(at.data[0] | (at.data[1] << 8U));
      record.answer = static_cast<uint16_t>(at.data[2] | (at.data[3] << 8U));
      record.feedback.assign(at.data.begin() + 4, at.data.begin() + at.length);
    }
  }
  static void put(MasterTelegrams &sent, size_t place, const Record &record) {
    sent.mdtData[place] = static_cast<uint8_t>(record.control);
    sent.mdtData[place + 1] = static_cast<uint8_t>(record.control >> 8U);
    sent.mdtData[place + 2] = static_cast<uint8_t>(record.word);
    sent.mdtData[place + 3] = static_cast<uint8_t>(record.word >> 8U);
    for (size_t i = 0; sent.phase >= Phase::Three && i < record.data.size(); ++i)
      sent.mdtData[place + 4 + i] = record.data[i];
  }

  MasterTelegrams sent_;
};

/// A ring with one drive.
struct DriveScene {
  explicit DriveScene(const DriveSetup &setup = plainDrive()) : drive(setup) {
    id = setup.device.address;
    master.ring.attach(drive);
    master.records[id];
  }

  SimulatedDrive drive;
  RingMaster master;
  uint8_t id;
};

} // namespace stride::sercos::simulation

#endif
