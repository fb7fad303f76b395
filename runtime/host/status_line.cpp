#include "runtime/host/status_line.hpp"

#include "runtime/task/task_set.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

namespace stride::host {

namespace {

constexpr int64_t kPeriodNs = 500'000'000;
constexpr size_t kUsualWidth = 80;

bool isTerminal() {
  const char *kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) != 0 && (kind == nullptr || std::string_view(kind) != "dumb");
}

/// Columns of the terminal.
size_t widthOfTerminal() {
  struct ::winsize size {};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col != 0 ? size.ws_col
                                                                            : kUsualWidth;
}

} // namespace

std::string statusText(int64_t elapsedNs, const std::vector<NamedTasks> &applications,
                       size_t width) {
  std::string text = fmt::format("running {:.1f} s", static_cast<double>(elapsedNs) * 1e-9);
  for (const NamedTasks &one : applications) {
    if (one.tasks->mode() == task::OperatingMode::Stop)
      text += applications.size() > 1 ? fmt::format(" | {}: STOP", one.application) : " | STOP";
    for (uint32_t i = 0; i < one.tasks->count(); ++i) {
      const task::TaskFigures figures = one.tasks->statistics(i).figures();
      text += fmt::format(" | {}{}: {} cycles, {:.1f} us (at most {:.1f}), {} overrun{}",
                          applications.size() > 1 ? one.application + ':' : std::string(),
                          one.tasks->desc(i).name, figures.cycles,
                          static_cast<double>(figures.lastRunNs) * 1e-3,
                          static_cast<double>(figures.maxRunNs) * 1e-3, figures.overruns,
                          figures.overruns == 1 ? "" : "s");
    }
  }
  if (text.size() <= width)
    return text;
  while (width > 0 && (static_cast<unsigned char>(text[width]) & 0xC0U) == 0x80U)
    --width; // not within a character
  text.resize(width);
  return text;
}

StatusLine::StatusLine(Messages &messages, bool wanted)
    : messages_(&messages), enabled_(wanted && isTerminal()), startNs_(task::monotonicNs()),
      nextNs_(startNs_ + kPeriodNs) {}

void StatusLine::show(int64_t nowNs, const std::vector<NamedTasks> &applications) {
  nextNs_ = nowNs + kPeriodNs;
  messages_->showStatus(statusText(nowNs - startNs_, applications, widthOfTerminal() - 1));
}

void StatusLine::clear() noexcept { messages_->showStatus({}); }

} // namespace stride::host
