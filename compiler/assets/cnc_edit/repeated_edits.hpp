#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_REPEATED_EDITS_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_REPEATED_EDITS_HPP
// Changes of sentences that jumps let a program carry out several times: one text must do for all
// of them.

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <optional>
#include <unordered_map>
#include <vector>

namespace stc::gcode {

/// New numbers of words and new words, sentence by sentence in the order in which they are carried
/// out. What a sentence became the first time holds for the next ones.
class RepeatedEdits {
public:
  explicit RepeatedEdits(std::string_view text) : edits_(text) {}

  /// The sentence that begins at this word of the program is carried out.
  void begin(int64_t sentence);
  /// Whether it was before.
  [[nodiscard]] bool isRepeated() const { return now_->visits > 1; }
  /// Whether the number of the word was changed before.
  [[nodiscard]] bool changed(const CncWord &word) const;
  /// Whether it has got a new word with this letter before.
  [[nodiscard]] bool inserted(char letter) const;

  /// Gives a word a number, which must be writable. The number as it is read from the text, or
  /// nothing: another time it has to be another one.
  std::optional<double> setNumber(const CncWord &word, double value);
  /// Puts a new word behind one of the sentence. Likewise.
  std::optional<double> insertAfter(const CncWord &anchor, char letter, double value);
  /// A motion whose function (G) stays from a sentence before; `write`: it has to be written.
  /// FALSE: it has to, and is not always the same.
  bool keepFunction(const CncWord &anchor, int32_t function, bool write);

  /// The sentence has been carried out. FALSE: something that was changed before is not to be now.
  [[nodiscard]] bool end() const;

  /// The text with the changes.
  [[nodiscard]] std::string apply() { return edits_.apply(); }

private:
  struct Change {
    const CncWord *word; ///< Null: a new one.
    char letter;
    double value;  ///< As it is read.
    int32_t visit; ///< The last one that wanted it.
  };
  struct Sentence {
    std::vector<Change> changes;
    int32_t visits = 0;
    int32_t function = -1; ///< Of keepFunction; -1: none yet.
    bool severalFunctions = false;
    bool functionWritten = false;
  };

  Change *find(const CncWord *word, char letter);
  std::optional<double> repeat(Change &change, double value) const;
  double note(const CncWord *word, char letter, double value);

  WordEdits edits_;
  std::unordered_map<int64_t, Sentence> sentences_;
  Sentence *now_ = nullptr;
};

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_REPEATED_EDITS_HPP
