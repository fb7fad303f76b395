// The table of registers against the rows of the manual; the types of stdlib/CSY against the table.
// STRIDE_BLESS=1 writes those types, and the list in docs/csy.md, anew.
#include "runtime/numeric/csy/register_map.hpp"

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace {

using namespace stride::csy;

constexpr std::array<uint8_t, 8> kKinds{kCmd, kRing, kTrf, kInd, kCoord, kFollow, kCam, kModule};

const char *typeName(RegisterType type) {
  switch (type) {
  case RegisterType::Bool:
    return "BOOL";
  case RegisterType::Int:
    return "INT";
  case RegisterType::Dint:
    return "DINT";
  case RegisterType::Real:
    return "REAL";
  }
  return "";
}

std::string addressOf(const Register &found) {
  const RegisterRow &row = *found.row;
  const char *area = row.area == RegisterArea::Input    ? "%I"
                     : row.area == RegisterArea::Output ? "%Q"
                                                        : "%M";
  if (found.word == kNoWord)
    return std::string(area) + (row.bit == kErrorBit ? "ERR" : std::to_string(row.bit));
  const char *size = row.type == RegisterType::Dint   ? "D"
                     : row.type == RegisterType::Real ? "F"
                                                      : "W";
  std::string text = std::string(area) + size + std::to_string(found.word);
  if (row.type == RegisterType::Bool)
    text += "." + std::to_string(row.bit);
  return text;
}

std::map<std::string, std::string> tableRows() {
  std::map<std::string, std::string> rows;
  for (const uint8_t kind : kKinds) {
    Register found{};
    for (size_t i = 0; registerAt(kind, i, found); ++i) {
      if (found.word != kNoWord && found.word >= kOwnWord)
        continue;
      const std::string key = std::string(nameOfKind(kind)) + " " + found.symbol;
      EXPECT_FALSE(rows.contains(key)) << key;
      rows[key] = std::string(typeName(found.row->type)) + " " + addressOf(found);
    }
  }
  return rows;
}

TEST(CsyRegisters, AreThoseOfTheManual) {
  std::map<std::string, std::string> rows = tableRows();
  std::ifstream file(STRIDE_SOURCE_DIR "/tests/unit/csy/register_rows.txt");
  std::string line;
  size_t read = 0;
  while (std::getline(file, line)) {
    if (line.starts_with("#"))
      continue;
    std::istringstream parts(line);
    std::string kind, symbol, type, address;
    parts >> kind >> symbol >> type >> address;
    const std::string key = kind + " " + symbol;
    EXPECT_EQ(rows[key], type + " " + address) << key;
    rows.erase(key);
    ++read;
  }
  EXPECT_EQ(read, 535U);
  // The headings name whole words; the rows only their bits.
  for (const auto &[key, value] : rows)
    EXPECT_TRUE(key.ends_with(" EXCH_STS") || key.ends_with(" EXCH_RPT") ||
                key.ends_with(" CH_FLT"))
        << key << " " << value;
}

TEST(CsyRegisters, LieBesideEachOther) {
  for (const uint8_t kind : kKinds) {
    std::set<std::string> bits;
    Register found{};
    for (size_t i = 0; registerAt(kind, i, found); ++i) {
      const ImagePlace place = placeOf(found);
      const RegisterRow &row = *found.row;
      const uint32_t size = row.type == RegisterType::Bool  ? 1
                            : row.type == RegisterType::Int ? 2
                                                            : 4;
      const uint32_t room = row.area == RegisterArea::Input    ? kInputBytes
                            : row.area == RegisterArea::Output ? kOutputBytes
                                                               : kMemoryBytes;
      EXPECT_LE(place.byte + size, room) << found.symbol;
      EXPECT_EQ(place.bit >= 0, row.type == RegisterType::Bool) << found.symbol;
      EXPECT_EQ(place.byte % size, 0U) << found.symbol;
      // No two of one size share a place: bits lie in words.
      const std::string key = std::to_string(static_cast<int>(row.area)) + ":" +
                              std::to_string(place.byte) + ":" + std::to_string(place.bit);
      EXPECT_TRUE(bits.insert(key).second) << found.symbol;
    }
  }
  EXPECT_EQ(placeOfWord(RegisterArea::Memory, kMemoryWords - 1).byte + 4, kMemoryBytes);
}

TEST(CsyRegisters, ChannelsHaveTheirKind) {
  const std::map<uint32_t, uint8_t> kinds{{0, kRing},   {1, kInd},     {16, kInd},    {17, kCoord},
                                          {20, kCoord}, {21, kFollow}, {24, kFollow}, {25, kCam},
                                          {31, kCam},   {32, kModule}, {33, 0}};
  for (const auto &[channel, kind] : kinds)
    EXPECT_EQ(kindOfChannel(channel), kind) << channel;
}

std::string structure(uint8_t kind) {
  const std::string name = nameOfKind(kind);
  std::string text = "/// Registers of a TSX CSY 85, by their names in the manual. Written from "
                     "the table of registers: do not edit.\n"
                     "/// Place a variable at its channel: `x AT %CH1.4.3 : " +
                     name +
                     ";`.\n"
                     "/// Source: TSX CSY 85 configuration manual 35010452, chapter 5.\n"
                     "TYPE " +
                     name + " EXTENDS T_CSY_EXCHANGE :\nSTRUCT\n";
  Register found{};
  bool first = true;
  for (size_t i = 0; registerAt(kind, i, found); ++i) {
    const RegisterRow &row = *found.row;
    if (std::string_view(row.symbol).starts_with("EXCH_")) // of T_CSY_EXCHANGE
      continue;
    const char *area = row.area == RegisterArea::Input    ? "I"
                       : row.area == RegisterArea::Output ? "Q"
                                                          : "M";
    text +=
        std::string(first ? "" : "\n") + "  /// " + addressOf(found) + ": " + row.meaning + ".\n";
    text += std::string("  ") + found.symbol + " AT %" + area + "* : " + typeName(row.type) + ";\n";
    first = false;
  }
  return text + "END_STRUCT\nEND_TYPE\n";
}

TEST(CsyRegisters, MakeTheTypesOfTheLibrary) {
  for (const uint8_t kind : kKinds) {
    const std::string path =
        std::string(STRIDE_SOURCE_DIR "/stdlib/CSY/") + nameOfKind(kind) + ".st";
    const std::string text = structure(kind);
    if (std::getenv("STRIDE_BLESS") != nullptr) // NOLINT(concurrency-mt-unsafe)
      std::ofstream(path) << text;
    std::ostringstream file;
    file << std::ifstream(path).rdbuf();
    EXPECT_EQ(file.str(), text) << path;
  }
}

/// `NAME_1` to `NAME_6` at their addresses, as one row.
std::string documentation() {
  std::string text = "| register | address | type | | of | meaning |\n|---|---|---|---|---|---|\n";
  for (size_t i = 0; i < kRegisterRows; ++i) {
    const RegisterRow &row = kRegisters[i];
    Register first{&row, "", row.word};
    std::string name = row.symbol;
    std::string address = addressOf(first);
    if (row.repeats > 1) {
      Register last = first;
      last.word = static_cast<uint8_t>(row.word + (row.repeats - 1) * row.step);
      name +=
          "_" + std::to_string(row.first) + " … _" + std::to_string(row.first + row.repeats - 1);
      address += " … " + addressOf(last);
    }
    std::string kinds;
    for (const uint8_t kind : kKinds)
      if ((row.kinds & kind) != 0)
        kinds += (kinds.empty() ? "" : ", ") + std::string(nameOfKind(kind));
    text += "| `" + name + "` | " + address + " | " + typeName(row.type) + " | " +
            (row.writable ? "rw" : "r") + " | " + kinds + " | " + row.meaning + " |\n";
  }
  return text;
}

TEST(CsyRegisters, AreListedInTheDocumentation) {
  const std::string path = STRIDE_SOURCE_DIR "/docs/csy.md";
  std::ostringstream file;
  file << std::ifstream(path).rdbuf();
  const std::string text = file.str();
  const std::string begin = "<!-- registers: begin -->\n";
  const size_t from = text.find(begin) + begin.size();
  const size_t to = text.find("<!-- registers: end -->");
  ASSERT_LT(from, to + 1);
  const std::string wanted = documentation();
  if (std::getenv("STRIDE_BLESS") != nullptr) { // NOLINT(concurrency-mt-unsafe)
    std::ofstream(path) << text.substr(0, from) << wanted << text.substr(to);
    return;
  }
  EXPECT_EQ(text.substr(from, to - from), wanted);
}

} // namespace
