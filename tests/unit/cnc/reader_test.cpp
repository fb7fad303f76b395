// Programs that come in pieces through memory that cannot hold them.
#include "runtime/numeric/cnc/gcode_reader.hpp"
#include "tests/unit/cnc/gcode_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>

using namespace stride::cnc;
using namespace stride::cnc::test;

namespace {

struct Read {
  ReadResult result = ReadResult::More;
  std::vector<GCodeWord> words; ///< That the decoder has got.
  std::string title;
};

/// Reads a text in pieces, and takes a sentence whenever there is no more room.
Read readAll(const std::string &text, uint32_t capacity, size_t piece, VariableList list = {}) {
  Read out;
  std::vector<GCodeWord> words(capacity);
  uint32_t read = 0;
  uint32_t count = 0;
  char title[kMostName + 1] = "";
  const WordMemory memory{words.data(), capacity, &read, &count, title};
  Reader reader{};
  size_t at = 0;
  const auto take = [&] {
    SentenceWords sentence;
    const int64_t next = sentenceAt(words.data(), count, read, sentence);
    out.words.insert(out.words.end(), words.begin() + read, words.begin() + next);
    const bool any = next != read;
    read = static_cast<uint32_t>(next);
    return any;
  };
  for (;;) {
    int64_t used = 0;
    const size_t size = std::min(piece, text.size() - at);
    out.result = readWords(reader, memory, &list, reinterpret_cast<const uint8_t *>(&text[at]),
                           static_cast<int64_t>(size), at + size == text.size(), used);
    at += static_cast<size_t>(used);
    if (out.result == ReadResult::Full) {
      EXPECT_TRUE(take());
    } else if (out.result != ReadResult::More) {
      while (take()) {
      }
      out.title = title;
      return out;
    }
  }
}

} // namespace

TEST(Reader, GivesTheSameWhateverTheMemoryIs) {
  std::string text = "% Name of it\nG1 F5\n";
  for (int i = 0; i < 40; ++i)
    text += (i % 7 == 0 ? "/" : "") + ("N" + std::to_string(i)) + " X" +
            std::to_string(i * 3 % 11) + (i % 3 == 0 ? " Y2 Z3\n" : " // \n\n");
  const Scanned whole = scanText(text);
  for (uint32_t capacity = 7; capacity < 40; ++capacity)
    for (const size_t piece : {size_t{1}, size_t{13}, text.size()}) {
      const Read read = readAll(text, capacity, piece);
      ASSERT_EQ(read.result, ReadResult::Ended) << capacity;
      EXPECT_EQ(read.title, "Name of it");
      ASSERT_EQ(read.words.size(), whole.words.size() + 1) << capacity << " " << piece;
      EXPECT_EQ(read.words.back().letter, kEndOfProgram);
      for (size_t i = 0; i < whole.words.size(); ++i) {
        ASSERT_EQ(read.words[i].letter, whole.words[i].letter);
        ASSERT_EQ(read.words[i].value, whole.words[i].value);
        ASSERT_EQ(read.words[i].integer, whole.words[i].integer);
      }
    }
  // N0 X0 Y2 Z3, with the stroke before and the end after them.
  EXPECT_EQ(readAll(text, 6, 5).result, ReadResult::Ended);
  EXPECT_EQ(readAll(text, 5, 5).result, ReadResult::TooSmall);
}

TEST(Reader, FindsVariablesByName) {
  double lreal = 4.5;
  NamedVariable variables[] = {{"G_rOne", 22, reinterpret_cast<uint8_t *>(&lreal), 0, 0.0F},
                               {"OWN", 1, nullptr, -7, 0.0F},
                               {"OWNREAL", 22, nullptr, 0, 2.5F},
                               {"OFBOOL", 7, reinterpret_cast<uint8_t *>(&lreal), 0, 0.0F},
                               {"PARAMETERS", 11, nullptr, 0, 0.0F}};
  const VariableList list{5, variables};
  const Read read = readAll("X$g_rone$ Y$own$ Z$OwnReal$", 10, 3, list);
  ASSERT_EQ(read.result, ReadResult::Ended);
  EXPECT_EQ(valueOf(read.words[0]), 4.5);
  EXPECT_EQ(valueOf(read.words[1]), -7);
  EXPECT_EQ(valueOf(read.words[2]), 2.5);
  for (const char *name : {"g_rOn", "g_rOneX", "ofbool", "parameters"})
    EXPECT_EQ(readAll("X$" + std::string(name) + "$", 10, 3, list).result, ReadResult::Variable)
        << name;
  EXPECT_EQ(readAll("X1 Y", 10, 3).result, ReadResult::Wrong);
}
