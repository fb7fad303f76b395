#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_PLAN_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_PLAN_HPP
// What the sentences of a CNC program are for, before it is reversed.

#include "compiler/assets/cnc_edit/modal_words.hpp"
#include "compiler/assets/cnc_edit/trace.hpp"

namespace stc::gcode {

/// What modes there are, each with the G functions that choose one of it.
enum ModeTopic : int32_t {
  kNoMode = -1,
  kPlaneMode,                      ///< G15 to G19
  kRelativeMode,                   ///< G90, G91
  kCentreMode,                     ///< G98, G99
  kToolMode,                       ///< G40 to G42
  kCornerMode,                     ///< G50 to G52
  kLoopMode,                       ///< G60, G61
  kFeatureMode,                    ///< G38, G39; and O, from 0 on
  kSmoothMode = kFeatureMode + 32, ///< G70, G71; and L, from 0 on
};

/// The function that holds for each topic; those at their default are not in it.
using ModeState = std::map<int32_t, int32_t>;
[[nodiscard]] int32_t modeOf(const ModeState &state, int32_t topic);

/// What a sentence does.
enum class SentenceKind : uint8_t { Words, Mode, Motion, Function };

struct PlannedSentence {
  SentenceKind kind = SentenceKind::Words;
  int32_t function = -1;   ///< G, of a motion also that of a sentence before; of M -1.
  int32_t topic = kNoMode; ///< Of a mode.
  size_t modalBefore = 0;  ///< Index of ReversePlan::modal.
  size_t modalAfter = 0;
  size_t modesBefore = 0; ///< Index of ReversePlan::modes.
  size_t modesAfter = 0;
};

struct ReversePlan {
  std::vector<PlannedSentence> sentences;
  std::vector<ModalState> modal;
  std::vector<ModeState> modes;
  size_t prologue = 0;         ///< So many sentences at the beginning stay there.
  std::vector<size_t> motions; ///< Indices of sentences.
  bool positions = false;      ///< The first motion is a G0 or a G92 on the way to the path.
};

/// Plans what becomes of a program. What cannot be reversed is reported, and nothing returned.
[[nodiscard]] std::optional<ReversePlan> planReverse(const CncTrace &trace, bool softMotion3,
                                                     Diagnostics &diagnostics);

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_REVERSE_PLAN_HPP
