#include "compiler/cli/terminal.hpp"

#include "compiler/source/render.hpp"

#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <tuple>
#include <unistd.h>

namespace stc::cli {

namespace {

std::string count(size_t number, std::string_view what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

/// Notes that say the same become one, shown at the first place, that names the others.
std::vector<Diagnostic> gathered(const std::vector<Diagnostic> &all, const Sources &sources) {
  constexpr size_t kMost = 10;
  std::vector<Diagnostic> result;
  using Said = std::tuple<Code, std::string, std::string>;
  const auto saidBy = [](const Diagnostic &one) {
    return Said{one.code, one.message, one.labels.front().text};
  };
  std::map<Said, std::vector<size_t>> places;
  for (const Diagnostic &one : all) {
    if (one.severity == Severity::Note && !one.labels.empty() && one.labels.front().span.valid()) {
      std::vector<size_t> &same = places[saidBy(one)];
      same.push_back(static_cast<size_t>(&one - all.data()));
      if (same.size() > 1)
        continue;
    }
    result.push_back(one);
  }
  for (Diagnostic &one : result) {
    if (one.severity != Severity::Note || one.labels.empty())
      continue;
    const auto same = places.find(saidBy(one));
    if (same == places.end() || same->second.size() == 1)
      continue;
    FileId file = one.labels.front().span.file;
    std::string text = "the same at";
    for (size_t i = 1; i < same->second.size() && i <= kMost; ++i) {
      const Span span = all[same->second[i]].labels.front().span;
      const LineColumn at = sources.file(span.file).position(span.begin);
      text += fmt::format("{} {}{}:{}", i == 1 ? "" : ",",
                          span.file == file ? "" : sources.file(span.file).name() + ":", at.line,
                          at.column);
      file = span.file;
    }
    if (same->second.size() > kMost + 1)
      text += fmt::format(" and {}", count(same->second.size() - kMost - 1, "more place"));
    one.note(std::move(text));
  }
  return result;
}

void write(std::FILE *to, const std::string &text) { std::fwrite(text.data(), 1, text.size(), to); }

} // namespace

bool Output::useColor() const {
  if (color != ColorChoice::Automatic)
    return color == ColorChoice::Always;
  const char *none = std::getenv("NO_COLOR");
  const char *terminal = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) != 0 && (none == nullptr || *none == 0) &&
         (terminal == nullptr || std::string_view(terminal) != "dumb");
}

void print(const std::string &text) {
  write(stdout, ::isatty(STDOUT_FILENO) != 0 ? visible(text, "\n\t") : text);
}

int show(const std::vector<Diagnostic> &diagnostics, const Sources &sources, const Output &output) {
  size_t errors = 0;
  size_t warnings = 0;
  size_t notShown = 0;
  const bool color = output.format == Format::Text && output.useColor();
  std::string text;
  for (const Diagnostic &diagnostic :
       output.format == Format::Text ? gathered(diagnostics, sources) : diagnostics) {
    const bool full = output.maxErrors != 0 && errors >= output.maxErrors;
    errors += diagnostic.severity == Severity::Error ? 1 : 0;
    warnings += diagnostic.severity == Severity::Warning ? 1 : 0;
    if (output.format == Format::Json) {
      text += renderJson(diagnostic, sources);
      if (text.back() != '\n')
        text += '\n';
    } else if (full) {
      ++notShown;
    } else {
      text += renderText(diagnostic, sources, {color});
    }
  }
  if (output.format == Format::Json) {
    write(stdout, text);
    std::fflush(stdout);
    return errors == 0 ? 0 : 1;
  }
  if (errors + warnings != 0) {
    const bool failed = errors != 0;
    const std::string_view head = failed ? "error" : "warning";
    const std::string_view on = !color ? "" : failed ? "\x1b[1;31m" : "\x1b[1;33m";
    std::string counts = failed ? count(errors, "error") : std::string();
    if (warnings != 0)
      counts += (failed ? ", " : "") + count(warnings, "warning");
    if (notShown != 0)
      counts += fmt::format("; the last {} are not shown (`--max-errors 0` shows all)", notShown);
    text += fmt::format("{}{}{}: {}\n", on, head, color ? "\x1b[0m" : "", counts);
  }
  write(stderr, text);
  return errors == 0 ? 0 : 1;
}

int showError(Code code, std::string message, const Output &output) {
  Diagnostics diagnostics;
  diagnostics.report(code, {}, std::move(message));
  return show(diagnostics.all(), {}, output);
}

ProgressLine::ProgressLine()
    : terminal_(::isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

void ProgressLine::update(std::string_view what, size_t done, size_t total) {
  if (!terminal_)
    return;
  write(stderr, fmt::format("\r\x1b[K[{}/{}] {}", done, total, visible(what)));
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::clear() {
  if (shown_)
    write(stderr, "\r\x1b[K");
  shown_ = false;
}

double ProgressLine::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

} // namespace stc::cli
