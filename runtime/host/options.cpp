#include "runtime/host/options.hpp"

#include "runtime/app/error.hpp"
#include "runtime/iec/text.h"

#include <fmt/format.h>

namespace stride::host {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
    text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
    text.remove_suffix(1);
  return text;
}

} // namespace

int64_t parseDuration(std::string_view text, bool zeroAllowed) {
  const text::Scanned scanned = text::scanDuration(text.data(), static_cast<uint32_t>(text.size()));
  if (scanned.used == 0 || scanned.used != text.size())
    throw app::Error(
        fmt::format("'{}' is not a duration; write for example T#1s500ms, 5s or 500ms", text));
  if (scanned.overflow)
    throw app::Error(fmt::format("'{}' is too long; the limit is 292 years", text));
  if (scanned.ns < 0 || (scanned.ns == 0 && !zeroAllowed))
    throw app::Error(fmt::format("'{}' must be longer than nothing", text));
  return scanned.ns;
}

std::vector<std::string> splitPaths(std::string_view text) {
  std::vector<std::string> paths;
  size_t start = 0;
  int depth = 0;
  for (size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '[')
      ++depth;
    else if (i < text.size() && text[i] == ']')
      --depth;
    else if (i == text.size() || (text[i] == ',' && depth <= 0)) {
      const std::string_view part = trimmed(text.substr(start, i - start));
      if (part.empty())
        throw app::Error(fmt::format("'{}': a name is missing between the commas", text));
      paths.emplace_back(part);
      start = i + 1;
    }
  }
  return paths;
}

SetOption parseSet(const std::string &text) {
  // Without a time (`x=5`, `a[1,2]=5`) it is set before the first cycle.
  size_t comma = text.find(',');
  const bool timed = comma != std::string::npos && (text.rfind('#', comma) != std::string::npos ||
                                                    (text.front() >= '0' && text.front() <= '9'));
  if (!timed)
    comma = std::string::npos;
  const size_t equals = text.find('=', timed ? comma : 0);
  if (equals == 0 || equals == std::string::npos)
    throw app::Error(fmt::format(
        "--set '{}' has not the form NAME=VALUE or TIME,NAME=VALUE; write for example --set "
        "T#3s,PLC_PRG.x=50",
        text));
  size_t pathEnd = equals;
  if (text[pathEnd - 1] == ':') // NAME:=VALUE as in ST
    --pathEnd;
  SetOption option;
  option.text = text;
  option.path = std::string(trimmed(std::string_view(text).substr(comma + 1, pathEnd - comma - 1)));
  option.value = std::string(trimmed(std::string_view(text).substr(equals + 1)));
  try {
    if (timed)
      option.timeNs = parseDuration(trimmed(std::string_view(text).substr(0, comma)), true);
  } catch (const app::Error &error) {
    throw app::Error(fmt::format("--set '{}': {}", text, error.what()));
  }
  if (option.path.empty())
    throw app::Error(fmt::format("--set '{}' names no variable", text));
  return option;
}

ChangeOption parseChange(const std::string &text) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos || comma + 1 == text.size())
    throw app::Error(fmt::format("--change '{}' has not the form TIME,FILE; write for example "
                                 "--change T#3s,build/app.so",
                                 text));
  try {
    return {parseDuration(trimmed(std::string_view(text).substr(0, comma)), true),
            std::string(trimmed(std::string_view(text).substr(comma + 1)))};
  } catch (const app::Error &error) {
    throw app::Error(fmt::format("--change '{}': {}", text, error.what()));
  }
}

} // namespace stride::host
