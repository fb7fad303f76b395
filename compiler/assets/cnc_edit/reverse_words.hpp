#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_WORDS_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_WORDS_HPP
// Modes and modal words of a CNC program that is reversed: each motion gets what held for it.

#include "compiler/assets/cnc_edit/reverse_plan.hpp"

namespace stc::gcode {

/// What the new program has said so far.
class ReverseWords {
public:
  ReverseWords(const CncTrace &trace, const ReversePlan &plan, bool softMotion3,
               Diagnostics &diagnostics)
      : trace_(trace), plan_(plan), softMotion3_(softMotion3), diagnostics_(diagnostics) {}

  /// The sentence stays as it is.
  void keep(size_t sentence);
  /// Its modal words stay as they are.
  void keepWords(size_t sentence) { modal_ = plan_.modal[planned(sentence).modalAfter]; }
  /// Lets the modal words of a sentence say what held before it, or without `says` takes them away.
  void writeWords(SentenceText &line, size_t sentence, bool says);
  /// The same for a sentence that chooses a mode: it chooses what held before it.
  void writeMode(SentenceText &line, size_t sentence);
  /// Lets a motion have the modal words that hold for it.
  void writeMotion(SentenceText &line, size_t sentence);
  /// Words for what holds for a motion and has not been said; they count as said then.
  std::vector<std::string> missingWords(size_t sentence);
  /// Sentences for modes that a motion needs and that have not been chosen; likewise.
  std::vector<std::string> missingModes(size_t sentence);

  /// The function that holds now.
  [[nodiscard]] int32_t mode(int32_t topic) const { return modeOf(modes_, topic); }

private:
  [[nodiscard]] const PlannedSentence &planned(size_t i) const { return plan_.sentences[i]; }
  void refuse(size_t sentence, const std::string &message, const std::string &label,
              const std::string &help);
  void setMode(int32_t topic, int32_t function);
  void write(SentenceText &line, size_t sentence, const ModalState &wanted, bool noDistance);
  /// D, where the mode is one that needs it and it has not been said.
  std::string missingDistance(int32_t topic, int32_t function, const ModalState &wanted);

  const CncTrace &trace_;
  const ReversePlan &plan_;
  bool softMotion3_;
  Diagnostics &diagnostics_;
  ModalState modal_;
  ModeState modes_;
};

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_WORDS_HPP
