#include "drivers/sercos/parameter_file.hpp"

#include "runtime/common/setup_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace stride::sercos {
namespace {

using common::trimmed;

constexpr int64_t kLastIdn = UINT16_MAX;
constexpr std::string_view kElement = "<Parameter ";

struct Line {
  std::string_view number;
  std::string_view value;
};

/// `Number="41"` … `>100</Parameter>`.
bool xmlLine(std::string_view text, Line &line) {
  constexpr std::string_view kNumber = " Number=\"";
  const size_t from = text.find(kNumber);
  const size_t end = text.rfind("</Parameter>");
  if (from == std::string_view::npos || end == std::string_view::npos)
    return false;
  const size_t number = from + kNumber.size();
  const size_t quote = text.find('"', number);
  const size_t begin = text.rfind('>', end == 0 ? 0 : end - 1);
  if (quote == std::string_view::npos || begin == std::string_view::npos || begin < quote)
    return false;
  line = {text.substr(number, quote - number), text.substr(begin + 1, end - begin - 1)};
  return true;
}

bool textLine(std::string_view text, Line &line) {
  const size_t first = text.find(';');
  if (first == std::string_view::npos)
    return false;
  const size_t second = std::min(text.find(';', first + 1), text.size());
  line = {text.substr(0, first), text.substr(first + 1, second - first - 1)};
  return true;
}

bool isIgnored(std::string_view text) {
  constexpr std::array<std::string_view, 5> kBegins = {"drive;", "<?xml", "<DriveParameters",
                                                       "</DriveParameters", "<!--"};
  return text.empty() ||
         std::any_of(kBegins.begin(), kBegins.end(),
                     [text](std::string_view begin) { return text.starts_with(begin); });
}

bool readLine(std::string_view text, std::vector<IdnValue> &values) {
  Line line;
  if (!(text.starts_with(kElement) ? xmlLine(text, line) : textLine(text, line)))
    return false;
  std::vector<int64_t> number;
  IdnValue value;
  if (!parseNumbers(trimmed(line.number), number) || number.size() != 1 || number[0] < 0 ||
      number[0] > kLastIdn)
    return false;
  const std::string_view given = trimmed(line.value);
  if (given == "TRUE" || given == "FALSE")
    value.numbers.push_back(given == "TRUE" ? 1 : 0);
  else if (!parseNumbers(given, value.numbers))
    return false;
  value.idn = static_cast<Idn>(number[0]);
  values.push_back(std::move(value));
  return true;
}

} // namespace

bool readParameterFile(std::string_view text, std::vector<IdnValue> &values, std::string &error) {
  size_t number = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(text.substr(at, end - at));
    at = end + 1;
    ++number;
    if (isIgnored(line) || readLine(line, values))
      continue;
    error = "line " + std::to_string(number) +
            " is no parameter: it is an IDN and a whole number, as 41;100;name;unit or in XML";
    return false;
  }
  return true;
}

} // namespace stride::sercos
