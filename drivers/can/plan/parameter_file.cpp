#include "drivers/can/plan/parameter_file.hpp"

#include "drivers/can/plan/drive_settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace stride::can {
namespace {

constexpr int64_t kMostParameter = 0xFFFFFF;

std::string_view withoutBlanks(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// "2500", "-5", "2500.0", "TRUE".
std::optional<int64_t> wholeValue(std::string_view text) {
  if (text == "TRUE" || text == "FALSE")
    return text == "TRUE" ? 1 : 0;
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr double kMost = 4294967295.0;
  constexpr double kLeast = -2147483648.0;
  if (text.empty() || problem != std::errc() || end != text.data() + text.size() ||
      !(value >= kLeast && value <= kMost) || value != std::floor(value))
    return std::nullopt;
  return static_cast<int64_t>(value);
}

bool fitsForm(int64_t value, const ObjectForm &form) {
  if (form.bytes == 0)
    return true;
  const unsigned bits = 8U * form.bytes;
  const int64_t most = (int64_t{1} << (form.isSigned ? bits - 1 : bits)) - 1;
  return value <= most && value >= (form.isSigned ? -most - 1 : 0);
}

class FileReader {
public:
  FileReader(std::string_view text, uint8_t axis) : text_(text), axis_(axis) {}

  ParameterFile read() {
    if (text_.find("<DriveParameters") != std::string_view::npos)
      readXml();
    else
      readText();
    return std::move(file_);
  }

private:
  void fail(size_t line, std::string_view what) {
    if (file_.error.empty())
      file_.error = "line " + std::to_string(line) + ": " + std::string(what);
  }

  void add(size_t line, std::string_view number, std::string_view value) {
    int64_t parameter = 0;
    const auto [end, problem] =
        std::from_chars(number.data(), number.data() + number.size(), parameter);
    if (number.empty() || problem != std::errc() || end != number.data() + number.size() ||
        parameter <= 0 || parameter > kMostParameter) {
      fail(line, "the number of a parameter is index * 256 + subindex of an object");
      return;
    }
    SdoWrite write;
    write.object = {static_cast<uint16_t>(parameter >> 8), static_cast<uint8_t>(parameter & 0xFF)};
    const ObjectForm form = formOf(inProfile(write.object, axis_));
    const std::optional<int64_t> given = wholeValue(value);
    const std::string foreign = foreignAxis(write.object, axis_);
    if (const std::string_view owner = ownerOf(write.object, axis_); !owner.empty())
      fail(line, "what is written there is the matter of " + std::string(owner));
    else if (!foreign.empty())
      fail(line, foreign);
    else if (!given)
      fail(line, "the value is no whole number of 32 bits");
    else if (!fitsForm(*given, form))
      fail(line, "the value does not fit into the object");
    if (!file_.error.empty())
      return;
    write.size = form.bytes;
    write.value = static_cast<uint32_t>(*given);
    file_.writes.push_back(write);
  }

  void readText() {
    size_t line = 0;
    for (size_t at = 0; at < text_.size() && file_.error.empty();) {
      const size_t end = std::min(text_.find('\n', at), text_.size());
      const std::string_view row = withoutBlanks(text_.substr(at, end - at));
      at = end + 1;
      ++line;
      const size_t first = row.find(';');
      if (line == 1 && (first == std::string_view::npos || row.substr(0, first) != "drive")) {
        fail(line, "a file with parameters begins with `drive;` and a number, or is XML");
        return;
      }
      if (line == 1 || row.empty())
        continue;
      if (first == std::string_view::npos) {
        fail(line, "a parameter is `NUMBER;VALUE;NAME;UNIT`");
        return;
      }
      const size_t second = std::min(row.find(';', first + 1), row.size());
      add(line, withoutBlanks(row.substr(0, first)),
          withoutBlanks(row.substr(first + 1, second - first - 1)));
    }
    if (line == 0)
      fail(1, "the file is empty");
  }

  void readXml() {
    constexpr std::string_view kBegin = "<Parameter ";
    constexpr std::string_view kNumber = "Number=\"";
    for (size_t at = text_.find(kBegin); at != std::string_view::npos && file_.error.empty();
         at = text_.find(kBegin, at + 1)) {
      const auto line = static_cast<size_t>(std::count(
                            text_.begin(), text_.begin() + static_cast<long>(at), '\n')) +
                        1;
      const size_t tagEnd = std::min(text_.find('>', at), text_.size());
      const size_t end = text_.find("</Parameter>", tagEnd);
      const std::string_view tag = text_.substr(at, tagEnd - at);
      const size_t number = tag.find(kNumber);
      const size_t quote =
          number == std::string_view::npos ? number : tag.find('"', number + kNumber.size());
      if (end == std::string_view::npos || quote == std::string_view::npos) {
        fail(line, "a parameter is `<Parameter Number=\"…\" …>VALUE</Parameter>`");
        return;
      }
      add(line, tag.substr(number + kNumber.size(), quote - number - kNumber.size()),
          withoutBlanks(text_.substr(tagEnd + 1, end - tagEnd - 1)));
    }
    if (text_.find("</DriveParameters>") == std::string_view::npos)
      fail(1 + static_cast<size_t>(std::count(text_.begin(), text_.end(), '\n')),
           "the end of the file is missing");
  }

  std::string_view text_;
  uint8_t axis_;
  ParameterFile file_;
};

} // namespace

ParameterFile readParameterFile(std::string_view text, uint8_t axis) {
  return FileReader(text, axis).read();
}

} // namespace stride::can
