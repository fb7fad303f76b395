// Sentences as text again. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_GCODE_TEXT_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_GCODE_TEXT_HPP

#include "runtime/numeric/cnc/gcode_program.hpp"

namespace stride::cnc {

/// Writes a sentence with the values of its variables; `room` characters at most, with the 0 at the
/// end. Words that do not fit are left out.
void sentenceText(const SentenceWords &sentence, char *text, int32_t room) noexcept;

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_GCODE_TEXT_HPP
