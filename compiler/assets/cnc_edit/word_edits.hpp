#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_WORD_EDITS_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_WORD_EDITS_HPP
// What the commands that change CNC programs have in common.

#include "compiler/assets/cnc/cnc_source.hpp"

#include <span>

namespace stc::gcode {

/// Changes of a text at the places of its words.
class WordEdits {
public:
  explicit WordEdits(std::string_view text) : text_(text) {}

  /// Gives the word another number; its letters stay.
  void setNumber(const CncWord &word, const std::string &number);
  /// Puts words behind a word, in the order of the calls.
  void insertAfter(const CncWord &word, const std::string &words);
  /// The text with the changes.
  [[nodiscard]] std::string apply();

private:
  std::string_view text_;
  std::vector<Edit> changes_;
};

/// A number as G-code has it: without an exponent, 9 digits behind the point at most.
[[nodiscard]] std::string numberText(double value);
/// The same with 12 digits behind the point, as far as a double has them.
[[nodiscard]] std::string exactNumberText(double value);
/// What a reader makes of numberText().
[[nodiscard]] double roundedNumber(double value);
/// Of several words with a letter the left one, which counts; null: there is none.
[[nodiscard]] const CncWord *wordOf(std::span<const CncWord> sentence, uint8_t letter);

/// Where the number of a word begins.
[[nodiscard]] size_t numberPlace(std::string_view text, const CncWord &word);

/// Whether a way is none but for rounding, beside numbers of some size.
[[nodiscard]] bool isNothing(double way, double size);

/// Whether the number can be written.
[[nodiscard]] bool isWritable(double value);

/// Reports that a sentence cannot be changed.
void refuseEdit(Span span, const std::string &message, const std::string &label,
                const std::string &help, Diagnostics &diagnostics);

/// Reads a program that is to be changed. Nothing if it has errors, which are reported.
[[nodiscard]] std::optional<CncProgram> readForEdit(const SourceFile &file,
                                                    Diagnostics &diagnostics);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_WORD_EDITS_HPP
