#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_SENTENCE_TEXT_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_SENTENCE_TEXT_HPP
// Sentences and lines of a CNC program that is edited.

#include "compiler/assets/cnc/cnc_source.hpp"

namespace stc::gcode {

/// A line of a text, without its end.
struct TextLine {
  size_t begin = 0;
  size_t end = 0;
  std::string_view ending; ///< What ends it; empty: the text.
};
[[nodiscard]] std::vector<TextLine> linesOf(std::string_view text);

/// A sentence of a program.
struct EditSentence {
  std::span<const CncWord> words; ///< Without `/`.
  bool skip = false;              ///< It begins with `/`.
  int32_t line = 0;               ///< Of the text, from 1 on.
};
/// The sentences in the order of the text. The program must outlive them.
[[nodiscard]] std::vector<EditSentence> sentencesOf(const CncProgram &program);

/// The line of a sentence while its words are changed. Its comments and blanks stay.
class SentenceText {
public:
  SentenceText(std::string_view text, const EditSentence &sentence);

  /// Gives a word another number; its letters stay.
  void setNumber(const CncWord &word, const std::string &number);
  /// Replaces all of a word.
  void replace(const CncWord &word, const std::string &words);
  void remove(const CncWord &word);
  /// Puts words behind all others, in the order of the calls.
  void append(const std::string &words);
  /// Puts an axis or a centre behind those that are there, or behind the function, in the order of
  /// the calls.
  void insertPlace(const std::string &words);
  /// Puts words behind the one with the letter, or where there is none, before all.
  void insertBehind(uint8_t letter, const std::string &words);

  /// The line as it is now, without its end.
  [[nodiscard]] std::string apply() const;
  /// What stands before the first word.
  [[nodiscard]] std::string_view indent() const;

private:
  struct Change {
    size_t begin;
    size_t end;
    std::string text;
  };

  std::string_view text_;
  EditSentence sentence_;
  size_t begin_; ///< Of the line.
  size_t end_;
  std::vector<Change> changes_;
};

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_SENTENCE_TEXT_HPP
