#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_MODAL_WORDS_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_MODAL_WORDS_HPP
// Words that hold until another one says something else: F, E, D, S, FF, EF, limits, periods.

#include "compiler/assets/cnc_edit/sentence_text.hpp"

#include <map>

namespace stc::gcode {

/// What a modal word is about: its code, and where several of a code hold beside each other
/// (accelerations and decelerations; axes of S; D of SoftMotion 3) which one.
using ModalKey = uint16_t;

/// What holds, as the words of the text; what is at its default is not in it.
using ModalState = std::map<ModalKey, std::string>;

inline constexpr ModalKey kTool = 1;   ///< Of keyOfDistance.
inline constexpr ModalKey kCorner = 2; ///< Likewise.
/// D; in SoftMotion 3 of tools and of corners apart.
[[nodiscard]] ModalKey keyOfDistance(bool softMotion3, ModalKey which);

/// What a word sets. `function`: G of its sentence, or -1. Several keys of a word that resets them;
/// none of a word that is not modal.
struct ModalSetting {
  std::vector<ModalKey> keys;
  std::string text;     ///< Empty: the default.
  bool unknown = false; ///< A variable decides which key it is.
};
[[nodiscard]] ModalSetting settingOf(const CncWord &word, int32_t function, bool softMotion3);

/// Takes over what the words of a sentence say. `function` as above. The word that cannot be
/// followed, or null.
const CncWord *readModal(const EditSentence &sentence, int32_t function, bool softMotion3,
                         ModalState &state);

/// The word that brings a key to its default; empty: there is none.
[[nodiscard]] std::string defaultWord(ModalKey key);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_MODAL_WORDS_HPP
