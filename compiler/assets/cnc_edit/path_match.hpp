#ifndef STRIDE_COMPILER_ASSETS_CNC_EDIT_PATH_MATCH_HPP
#define STRIDE_COMPILER_ASSETS_CNC_EDIT_PATH_MATCH_HPP
// Whether an edited CNC program makes the path that it should.

#include "compiler/assets/cnc/cnc_source.hpp"

namespace stc::gcode {

using Path = std::vector<stride::cnc::PathObject>;

/// Of each object what goes on there, instead of what begins and ends: tool correction, smoothing,
/// rounding, loops as bits of its marks; axes that go smoothly. D is 0 where nothing needs it.
void noteWhatGoesOn(Path &path);

/// Where two paths, of which the function above knows, first differ: index of the object. The
/// numbers of sentences do not matter, and places may be off by 1e-8, as a part of what they are if
/// that is more. Nothing: nowhere.
[[nodiscard]] std::optional<size_t> firstDifference(const Path &path, const Path &other);

/// The path of a text with the start and the generation of some settings: of a program that jumps
/// for ever the first part. Nothing if it is none.
[[nodiscard]] std::optional<Path> pathOfText(const std::string &text,
                                             const CncSettings &settings = {});

} // namespace stc::gcode

#endif // STRIDE_COMPILER_ASSETS_CNC_EDIT_PATH_MATCH_HPP
