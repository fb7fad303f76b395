#ifndef STRIDE_COMPILER_ASSETS_CNC_INTERNAL_HPP
#define STRIDE_COMPILER_ASSETS_CNC_INTERNAL_HPP
// What the sources of this folder have in common.

#include "compiler/assets/cnc/cnc_source.hpp"
#include "runtime/numeric/cnc/gcode_program.hpp"

#include <unordered_map>
#include <unordered_set>

namespace stc::gcode {

/// What is wrong with a sentence, in words.
struct SentenceError {
  Code code;
  std::string message;
  std::string label;
  std::string help;
};
[[nodiscard]] SentenceError describe(stride::cnc::GCodeError error);

/// Reports what is wrong with the sentence, at a word of it.
void report(stride::cnc::GCodeError error, Span span, Diagnostics &diagnostics);

/// The words of a program for a decoder: the settings' velocities come before them, and variables
/// have places here: those of one name the same place.
class Sentences {
public:
  explicit Sentences(const CncProgram &program);
  Sentences(const Sentences &) = delete;
  Sentences &operator=(const Sentences &) = delete;

  [[nodiscard]] int64_t size() const { return static_cast<int64_t>(words_.size()); }
  /// The sentence that begins with a word, as stride::cnc::sentenceAt has it.
  int64_t at(int64_t position, stride::cnc::SentenceWords &sentence) const {
    return stride::cnc::sentenceAt(words_.data(), size(), position, sentence);
  }
  /// Where the first sentence with this number begins; -1: there is none.
  [[nodiscard]] int64_t find(int32_t number) const;
  [[nodiscard]] const std::vector<stride::cnc::GCodeWord> &words() const { return words_; }
  /// The word of the text; null where the sentence is the settings'.
  [[nodiscard]] const CncWord *source(const stride::cnc::SentenceWords &sentence,
                                      int32_t word) const;

private:
  /// Where variables are; a number, or an SMC_M_PARAMETERS.
  struct Place {
    double number = 0;
    double parameters[8]{};
  };

  void settings();
  stride::cnc::GCodeWord placed(const CncWord &word, bool structure);

  const CncProgram &program_;
  std::vector<stride::cnc::GCodeWord> words_;
  size_t added_ = 0; ///< How many of them are the settings'.
  std::unordered_map<std::string, Place> places_;
  std::unordered_map<int32_t, int64_t> numbers_;
};

/// Whether the sentence is this G function: 20 jumps, 36 and 37 set what decides about it.
[[nodiscard]] bool isFunction(const stride::cnc::SentenceWords &sentence, int32_t function);
/// Whether a word of the sentence takes a variable.
[[nodiscard]] bool hasVariable(const stride::cnc::SentenceWords &sentence);

/// What decides where a program goes on after a jump, as long as no variable does: a jump that
/// comes again with the same value of the counter never ends.
class JumpWatch {
public:
  /// A sentence has been gone through.
  void pass(const stride::cnc::SentenceWords &sentence);
  /// It has jumped from `position`. True: it will do so for ever.
  bool jumpsForEver(int64_t position, int16_t counter);
  /// No variable has decided about a jump yet.
  [[nodiscard]] bool isDecided() const { return decided_; }

private:
  bool decided_ = true;
  std::unordered_set<uint64_t> seen_; ///< Position and counter.
};

/// A type that G-code's variables can have, by its name in lower case.
[[nodiscard]] std::optional<stride::cnc::VariableType> typeNamed(std::string_view lower);

/// The global constant of a name in lower case, or null.
using FindConstant = std::function<const ast::VarDecl *(std::string_view)>;

/// The value of an expression of constants, operators and mathematical functions; nothing: it is
/// none that can be computed before the project is checked.
[[nodiscard]] std::optional<double> constantOf(const ast::Expr *expression,
                                               const FindConstant &find);

/// The bytes as text for stride::cnc::unpack, in pieces of the same length but for the last one.
[[nodiscard]] std::vector<std::string> packed(std::string_view bytes);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_INTERNAL_HPP
