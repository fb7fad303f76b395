// Any bytes as a recording: what is read is written and read again as the same frames, and can be
// replayed.
#include "drivers/can/log/candump.hpp"
#include "drivers/can/log/replay_port.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stride::can;
  const log::Recording recording =
      log::readRecording(std::string_view(reinterpret_cast<const char *>(data), size));
  std::string text;
  for (const log::Entry &entry : recording.entries) {
    std::array<char, log::kLongestLine> line{};
    text.append(line.data(), log::formatLine(entry, recording.interface, line.data(), line.size()));
  }
  const log::Recording again = log::readRecording(text);
  if (again.entries.size() != recording.entries.size())
    std::abort();
  for (size_t i = 0; i < again.entries.size(); ++i)
    if (again.entries[i].frame != recording.entries[i].frame)
      std::abort();
  log::ReplayPort port(recording, {});
  std::array<Received, 8> frames;
  for (int cycle = 0; cycle < 20; ++cycle) {
    port.beginCycle();
    (void)port.receive(frames);
    if (!recording.entries.empty())
      (void)port.send(recording.entries.back().frame, SendClass::Process);
  }
  return 0;
}
