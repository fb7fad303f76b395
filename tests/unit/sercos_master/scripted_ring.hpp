// A ring of devices written from the standard's words, for what a master says to them. It knows
// nothing of the code that it judges but the interface of a ring: bits and numbers are literals.
#ifndef STRIDE_TESTS_UNIT_SERCOS_MASTER_SCRIPTED_RING_HPP
#define STRIDE_TESTS_UNIT_SERCOS_MASTER_SCRIPTED_RING_HPP

#include "drivers/sercos/ring/ring.hpp"

#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace stride::test {
size_t allocations();
} // namespace stride::test

namespace stride::sercos::test {

using Bytes = std::vector<uint8_t>;

inline Bytes word(uint16_t value) {
  return {static_cast<uint8_t>(value), static_cast<uint8_t>(value >> 8)};
}
inline Bytes words(std::initializer_list<uint16_t> values) {
  Bytes bytes;
  for (const uint16_t value : values)
    for (const uint8_t byte : word(value))
      bytes.push_back(byte);
  return bytes;
}
inline Bytes dword(uint32_t value) {
  return words({static_cast<uint16_t>(value), static_cast<uint16_t>(value >> 16)});
}

/// A data block.
struct Block {
  uint32_t attribute = 0x00110001; ///< Unsigned, 2 bytes.
  Bytes data = {0, 0};
  std::string name;
  uint16_t refusal = 0; ///< Of writing its data.
  uint16_t state = 0;   ///< Element 1; of a command what it becomes when it is started.
  bool isList() const { return (attribute & 0x00040000) != 0; }
};
inline Block block2(uint16_t value) { return {0x00110001, word(value), "", 0, 0}; }
inline Block block4(uint32_t value) { return {0x00220001, dword(value), "", 0, 0}; } // signed
inline Block list2(Bytes data) { return {0x00550001, std::move(data), "", 0, 0}; }
inline Block command(uint16_t state) { return {0x00090001, {0, 0}, "", 0, state}; }

class ScriptedDrive {
public:
  explicit ScriptedDrive(uint8_t address) : address_(address) {
    for (const uint16_t idn : std::initializer_list<uint16_t>{3, 4, 5, 87, 88, 90})
      blocks[idn] = block2(idn == 5 ? 100 : 10);
    for (const uint16_t idn : std::initializer_list<uint16_t>{1, 2, 6, 7, 8, 9, 10, 15, 32, 33, 34,
                                                              44, 45, 76, 77, 86, 89, 93, 305})
      blocks[idn] = block2(0);
    for (const uint16_t idn : std::initializer_list<uint16_t>{46, 78, 94})
      blocks[idn] = {0x00210001, {0, 0}, "", 0, 0}; // signed
    for (const uint16_t idn : std::initializer_list<uint16_t>{36, 40, 47, 51, 79, 103})
      blocks[idn] = block4(0);
    for (const uint16_t idn : std::initializer_list<uint16_t>{80, 84})
      blocks[idn] = {0x00210001, {0, 0}, "", 0, 0};
    for (const uint16_t idn : std::initializer_list<uint16_t>{16, 24, 21, 22})
      blocks[idn] = list2({});
    for (const uint16_t idn : std::initializer_list<uint16_t>{99, 127, 128, 148, 170})
      blocks[idn] = command(3);
    blocks[95] = {0x00440001, {'o', 'k'}, "", 0, 0};
  }

  std::map<uint16_t, Block> blocks;
  std::vector<std::string> written; ///< "S127=3".
  uint32_t busy = 0;                ///< Telegrams that a step takes longer.
  bool mute = false;                ///< The handshake stays where it is.
  bool silent = false;              ///< It sends nothing.
  bool distorts = false;
  Bytes feedback;           ///< Cyclic data in phases 3 and 4.
  uint16_t status = 0x8000; ///< Without the service channel's bits.
  uint16_t control = 0;     ///< The last control word.
  Bytes commands;           ///< The last cyclic data.
  uint16_t place = 1;       ///< Of its record in the MDT …
  uint16_t length = 4;      ///< … with so many bytes.
  uint8_t phase = 0;

  uint8_t address() const { return address_; }
  uint16_t value(uint16_t idn) const {
    const Bytes &data = blocks.at(idn).data;
    return static_cast<uint16_t>(data[0] | data[1] << 8);
  }

  DriveTelegram telegram() {
    DriveTelegram result;
    result.address = address_;
    result.distorted = distorts;
    const Bytes all = words({static_cast<uint16_t>(status | service_), info_});
    for (const uint8_t byte : all)
      result.data[result.length++] = byte;
    if (phase >= 3)
      for (const uint8_t byte : feedback)
        result.data[result.length++] = byte;
    return result;
  }

  void receive(const Bytes &record) {
    control = static_cast<uint16_t>(record[0] | record[1] << 8);
    const auto info = static_cast<uint16_t>(record[2] | record[3] << 8);
    commands.assign(record.begin() + 4, record.end());
    if (mute || (control & 1) == (service_ & 1)) {
      if (waiting_ > 0 && --waiting_ == 0)
        step(lastControl_, lastInfo_);
      return;
    }
    lastControl_ = control;
    lastInfo_ = info;
    if (busy == 0) {
      step(control, info);
      return;
    }
    service_ = static_cast<uint16_t>((control & 1) | 2); // busy
    waiting_ = busy;
  }

private:
  void answer(uint16_t info, bool error = false) {
    service_ = static_cast<uint16_t>((lastControl_ & 1) | (error ? 4 : 0));
    info_ = info;
    if (error)
      place_ = 0;
  }

  void step(uint16_t control, uint16_t info) {
    const unsigned element = control >> 3 & 7;
    const bool writes = (control & 2) != 0;
    const bool last = (control & 4) != 0;
    if (element == 1 && writes) {
      open_ = info;
      element_ = 0;
      answer(0, blocks.count(info) == 0);
      info_ = blocks.count(info) == 0 ? 0x1001 : 0;
      return;
    }
    if (element == 0 || blocks.count(open_) == 0) {
      answer(1, true); // it is not open
      return;
    }
    if (element != element_) {
      element_ = element;
      place_ = 0;
      buffer_ = content(element);
    }
    Block &block = blocks.at(open_);
    if (element == 1) {
      answer(block.state);
    } else if (writes) {
      const Bytes two = word(info);
      if (place_ == 0)
        buffer_.clear();
      buffer_.insert(buffer_.end(), two.begin(), two.end());
      place_ += 2;
      answer(0);
      if (last)
        end(block);
    } else if (place_ + 2 > buffer_.size()) {
      answer(0x7003, true);
    } else {
      answer(static_cast<uint16_t>(buffer_[place_] | buffer_[place_ + 1] << 8));
      place_ += 2;
      if (last != (place_ >= buffer_.size()))
        answer(last ? 0x7002 : 0x7003, true);
      if (last)
        element_ = 0;
    }
  }

  /// As it travels.
  Bytes content(unsigned element) {
    const Block &block = blocks.at(open_);
    if (element == 3)
      return dword(block.attribute);
    Bytes data = element == 2 ? Bytes(block.name.begin(), block.name.end()) : block.data;
    if (element != 2 && !block.isList())
      return data;
    const auto size = static_cast<uint16_t>(data.size());
    Bytes all = words({size, 100});
    all.insert(all.end(), data.begin(), data.end());
    if (all.size() % 2 != 0)
      all.push_back(0);
    return all;
  }

  void end(Block &block) {
    element_ = 0;
    Bytes data = buffer_;
    if (block.isList() ? data.size() < 4 : data.size() != block.data.size()) {
      answer(0x7002, true);
      return;
    }
    if (block.isList()) {
      data.erase(data.begin(), data.begin() + 4);
      data.resize(static_cast<size_t>(buffer_[0] | buffer_[1] << 8));
    }
    std::string line = "S" + std::to_string(open_) + "=";
    for (size_t i = 0; i < data.size(); i += 2)
      line += (i == 0 ? "" : ",") +
              std::to_string(data[i] | (i + 1 < data.size() ? data[i + 1] << 8 : 0));
    written.push_back(line);
    if (block.refusal != 0)
      answer(block.refusal, true);
    else
      block.data = data;
  }

  uint8_t address_;
  uint16_t service_ = 0;
  uint16_t info_ = 0;
  uint16_t open_ = 0;
  unsigned element_ = 0;
  Bytes buffer_;
  size_t place_ = 0;
  uint32_t waiting_ = 0;
  uint16_t lastControl_ = 0;
  uint16_t lastInfo_ = 0;
};

class ScriptedRing final : public Ring {
public:
  std::vector<ScriptedDrive *> drives;
  bool open = false;
  bool distorted = false; ///< The MST.
  uint32_t loseMsts = 0;  ///< The next ones.
  uint8_t phase = 0;      ///< That the MST has carried last.
  uint8_t light = 0;
  uint8_t megabits = 0;
  std::vector<uint8_t> asked; ///< Addresses in phase 1.

  void cycle(const MasterTelegrams &sent, RingAnswers &answers) noexcept override {
    const size_t before = stride::test::allocations();
    carry(sent, answers);
    allocations += stride::test::allocations() - before;
  }
  size_t allocations = 0; ///< Of this ring itself.

  void carry(const MasterTelegrams &sent, RingAnswers &answers) {
    const uint8_t last = sent.mdt && phase > 0 && phase < 3 ? sent.mdtAddress : uint8_t{0};
    deliver(sent); // of the cycle that ends
    answers.count = 0;
    phase = static_cast<uint8_t>(sent.phase);
    answers.light = !open;
    answers.mstDistorted = distorted && !open;
    answers.mstReturned = !open && !distorted && loseMsts == 0;
    loseMsts -= loseMsts > 0 ? 1 : 0;
    for (ScriptedDrive *drive : drives) {
      drive->phase = phase;
      const bool speaks = phase >= 3 || (phase > 0 && drive->address() == last);
      if (speaks && !drive->silent && !open)
        answers.telegrams[answers.count++] = drive->telegram();
    }
  }

  /// In the form of the phase that there was.
  void deliver(const MasterTelegrams &sent) {
    if (sent.mdt && phase == 1)
      asked.push_back(sent.mdtAddress);
    const bool cyclic = phase >= 3;
    if (!sent.mdt || phase == 0 || cyclic != (sent.mdtAddress == 255))
      return;
    for (ScriptedDrive *drive : drives) {
      if (!cyclic && drive->address() != sent.mdtAddress)
        continue;
      const size_t from = cyclic ? drive->value(9) - size_t{1} : 0;
      const size_t length = cyclic ? drive->length : 4;
      if (from + length > sent.mdtData.size())
        continue;
      drive->receive(Bytes(sent.mdtData.begin() + static_cast<ptrdiff_t>(from),
                           sent.mdtData.begin() + static_cast<ptrdiff_t>(from + length)));
    }
  }
  void setLight(uint8_t percent) noexcept override { light = percent; }
  void setBaudRate(uint8_t rate) noexcept override { megabits = rate; }
};

} // namespace stride::sercos::test

#endif
