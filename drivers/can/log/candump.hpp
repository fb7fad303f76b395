// Recordings of a bus as candump writes them: "(1436509052.249713) can0 182#27000000", a line for
// each frame. canplayer and Wireshark read them.
#ifndef STRIDE_DRIVERS_CAN_LOG_CANDUMP_HPP
#define STRIDE_DRIVERS_CAN_LOG_CANDUMP_HPP

#include "drivers/can/port/frame.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::can::log {

/// Which way a frame went, as the letter at the end of a line says.
enum class Direction : uint8_t {
  Unknown,
  Received, ///< "R": from the bus.
  Sent,     ///< "T": by the one who has recorded.
};

/// One frame.
struct Entry {
  int64_t timeNs = 0; ///< [ns]
  Frame frame;
  Direction direction = Direction::Unknown;
  size_t line = 0; ///< From 1.
};

/// A line that is none of a recording.
struct Problem {
  size_t line = 0;
  std::string text;
};

struct Recording {
  std::string interface; ///< Of the first line that is used.
  std::vector<Entry> entries;
  std::vector<Problem> problems; ///< The first ones, kMostProblems at most.
  size_t badLines = 0;
  size_t skipped = 0; ///< Lines of other interfaces, with 29-bit identifiers, CAN FD, error frames.

  static constexpr size_t kMostProblems = 20;
};

/// Reads all lines that are frames of one interface; empty: of that of the first line. Whatever the
/// text is, it is looked at to its end.
Recording readRecording(std::string_view text, std::string_view interface = {});

/// The most characters of a line that formatLine writes, with the newline.
inline constexpr size_t kLongestLine = 80;

/// Writes a line, and says how many characters it has; 0: there is no room. Allocates nothing.
/// Interfaces have 15 characters at most, as the system's have; others are cut.
size_t formatLine(const Entry &entry, std::string_view interface, char *to, size_t room);

} // namespace stride::can::log

#endif
