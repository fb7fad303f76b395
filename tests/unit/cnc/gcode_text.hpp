// G-code as a text for tests: its words, and the objects that it gives.
#ifndef STRIDE_TESTS_UNIT_CNC_GCODE_TEXT_HPP
#define STRIDE_TESTS_UNIT_CNC_GCODE_TEXT_HPP

#include "runtime/numeric/cnc/decoder.hpp"
#include "runtime/numeric/cnc/gcode_program.hpp"
#include "runtime/numeric/cnc/gcode_scanner.hpp"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stride::cnc::test {

/// What a scanner makes of a text.
struct Scanned {
  std::string name;
  std::vector<GCodeWord> words;
  std::vector<std::string> variables;                 ///< Of each word; empty: it has a number.
  std::vector<std::pair<GCodeError, int64_t>> errors; ///< With the offset.
};

/// A variable of a test.
struct Variable {
  void *address = nullptr;
  VariableType type = VariableType::None;
};
using Variables = std::map<std::string, Variable, std::less<>>;

/// Takes what an event of the scanner has given.
inline void takeEvent(const Scanner &scanner, ScanEvent event, Scanned &out) {
  switch (event) {
  case ScanEvent::Word:
    out.words.push_back(scanner.word);
    out.variables.emplace_back(scanner.variable ? scanner.name : "");
    break;
  case ScanEvent::EndOfSentence: {
    GCodeWord end{};
    end.letter = kEndOfSentence;
    end.integer = scanner.line + 1;
    out.words.push_back(end);
    out.variables.emplace_back();
    break;
  }
  case ScanEvent::ProgramName:
    out.name = scanner.name;
    break;
  case ScanEvent::Error:
    out.errors.emplace_back(scanner.error, scanner.wordOffset);
    break;
  case ScanEvent::None:
  case ScanEvent::EndOfProgram:
    break;
  }
}

/// Scans a text that comes in pieces; `piece` is asked for the length of the next one.
inline Scanned scanPieces(std::string_view text, const std::function<size_t()> &piece) {
  Scanned out;
  Scanner scanner{};
  size_t at = 0;
  while (at < text.size()) {
    const size_t end = std::min(text.size(), at + std::max<size_t>(piece(), 1));
    while (at < end) {
      int64_t used = 0;
      const ScanEvent event = scan(scanner, reinterpret_cast<const uint8_t *>(text.data()) + at,
                                   static_cast<int64_t>(end - at), used);
      at += static_cast<size_t>(used);
      takeEvent(scanner, event, out);
    }
  }
  for (ScanEvent event = scanEnd(scanner); event != ScanEvent::None; event = scanEnd(scanner))
    takeEvent(scanner, event, out);
  return out;
}

inline Scanned scanText(std::string_view text) {
  return scanPieces(text, [&] { return text.size(); });
}

/// What a decoder makes of a text.
struct DecodedText {
  std::vector<PathObject> objects;
  std::vector<uint16_t> notes; ///< Of each sentence that has some.
  GCodeError error = GCodeError::None;
  int32_t line = 0; ///< Of the error, or of the last sentence.
  int synchronised = 0;
  Decoder decoder{};
};

/// Gives the words that have variables their addresses.
inline void resolve(Scanned &scanned, const Variables &variables) {
  for (size_t i = 0; i < scanned.words.size(); ++i)
    if (const auto found = variables.find(scanned.variables[i]); found != variables.end()) {
      scanned.words[i].address = static_cast<uint8_t *>(found->second.address);
      scanned.words[i].variables = static_cast<uint8_t>(found->second.type);
    }
}

inline DecodedText decodeWords(const std::vector<GCodeWord> &words, const Position &start = {},
                               bool stepSuppress = false, int most = 100000,
                               bool softMotion3 = false,
                               Orientation orientation = Orientation::Axes) {
  DecodedText out;
  startDecoder(out.decoder, start);
  out.decoder.softMotion3 = softMotion3;
  out.decoder.orientation = orientation;
  static Decoded decoded;
  const auto count = static_cast<int64_t>(words.size());
  const auto take = [&] {
    out.objects.insert(out.objects.end(), decoded.objects, decoded.objects + decoded.count);
    if (decoded.notes != 0)
      out.notes.push_back(decoded.notes);
    out.synchronised += decoded.next == Next::Synchronise ? 1 : 0;
  };
  SentenceWords sentence;
  int64_t at = 0;
  while (at < count && most-- > 0) {
    at = sentenceAt(words.data(), count, at, sentence);
    if (stepSuppress && sentence.skip)
      continue;
    out.line = sentence.line;
    decodeSentence(out.decoder, sentence.words, sentence.count, sentence.line, decoded);
    out.error = decoded.error;
    if (out.error != GCodeError::None)
      return out;
    take();
    if (decoded.next == Next::Jump)
      at = findSentence(words.data(), count, decoded.target);
    if (at < 0) {
      out.error = GCodeError::UnknownJump;
      return out;
    }
  }
  decodeEnd(out.decoder, decoded);
  take();
  return out;
}

inline DecodedText decodeText(std::string_view text, const Variables &variables = {}) {
  Scanned scanned = scanText(text);
  resolve(scanned, variables);
  return decodeWords(scanned.words);
}

} // namespace stride::cnc::test

#endif // STRIDE_TESTS_UNIT_CNC_GCODE_TEXT_HPP
