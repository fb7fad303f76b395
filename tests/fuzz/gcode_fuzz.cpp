// Any bytes as G-code: scanned in pieces, decoded with variables of all types; read as a file into
// little memory, with a list of variables that the bytes make up, too.
#include "runtime/numeric/cnc/gcode_reader.hpp"
#include "tests/unit/cnc/gcode_text.hpp"

#include <algorithm>

#include <cmath>
#include <cstdlib>

using namespace stride::cnc;
using namespace stride::cnc::test;

namespace {

/// Reads a file as SMC_ReadNCFile does, while somebody takes sentences.
void readFile(const uint8_t *data, size_t size) {
  NamedVariable variables[3] = {};
  for (size_t i = 0; i < 3 && i < size; ++i) {
    variables[i].name[0] = static_cast<char>(data[i]);
    variables[i].type = static_cast<int16_t>(data[size - 1 - i] % 32 - 2);
    variables[i].real = data[i];
  }
  const VariableList list{static_cast<uint16_t>(size % 4), variables};
  GCodeWord words[40];
  uint32_t read = 0;
  uint32_t count = 0;
  char title[kMostName + 1];
  const WordMemory memory{words, static_cast<uint32_t>(size % 40) + 1, &read, &count, title};
  Reader reader{};
  Decoded decoded;
  Decoder decoder;
  startDecoder(decoder, {});
  int64_t at = 0;
  const auto end = static_cast<int64_t>(size);
  for (;;) {
    int64_t used = 0;
    const int64_t piece = std::min<int64_t>(end - at, 7);
    const ReadResult result =
        readWords(reader, memory, &list, data + at, piece, at + piece == end, used);
    at += used;
    SentenceWords sentence;
    const int64_t next = sentenceAt(words, count, read, sentence);
    if (next != read && !sentence.ended)
      decodeSentence(decoder, sentence.words, sentence.count, sentence.line, decoded);
    const bool stuck = next == read && result == ReadResult::Full;
    read = static_cast<uint32_t>(next);
    if (stuck || read > count || count > memory.capacity)
      std::abort();
    if (result != ReadResult::More && result != ReadResult::Full)
      return;
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  Scanned scanned = scanText(text);
  size_t state = size;
  const Scanned pieces = scanPieces(text, [&] { return state = state * 7 % 13; });
  if (scanned.variables != pieces.variables || scanned.errors != pieces.errors)
    std::abort();
  double storage[8] = {1, 2, 3, 4, 5, 6, 7, 8};
  for (size_t i = 0; i < scanned.words.size(); ++i)
    if (!scanned.variables[i].empty()) {
      scanned.words[i].address = reinterpret_cast<uint8_t *>(storage);
      scanned.words[i].variables = static_cast<uint8_t>(scanned.variables[i][0] % 32);
    }
  const DecodedText decoded = decodeWords(scanned.words, {}, size % 2 == 0, 2000);
  for (const PathObject &object : decoded.objects)
    if (!(object.length >= 0) || object.switchPosition[0] > 1)
      std::abort();
  readFile(data, size);
  return 0;
}
