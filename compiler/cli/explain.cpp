#include "compiler/cli/commands.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/syntax/st_text.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fmt/format.h>
#include <optional>

namespace stc::cli {

namespace {

std::string_view trim(std::string_view text) {
  while (!text.empty() && std::string_view(" \t\r\n").find(text.front()) != std::string_view::npos)
    text.remove_prefix(1);
  while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != std::string_view::npos)
    text.remove_suffix(1);
  return text;
}

std::optional<int> parseNumber(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return number;
}

struct MotionError {
  std::string name;
  int number = 0;
  std::string text;
};

// Lines of one paragraph are joined; an empty one begins another.
void addDocLine(std::string &doc, std::string_view line) {
  if (line.empty())
    doc += "\n\n";
  else if (doc.empty() || doc.ends_with('\n'))
    doc += line;
  else
    doc.append(" ").append(line);
}

// Looks for an enumerator in the declaration of SMC_ERROR, by number or by name.
std::optional<MotionError> findMotionError(std::string_view what) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const std::vector<LibraryIndex::Entry> entries = index.find("smc_error");
  if (entries.empty())
    return std::nullopt;
  const std::optional<int> wanted = parseNumber(what);
  std::string_view rest = entries.front().text;
  std::string doc;
  while (!rest.empty()) {
    const size_t end = rest.find('\n');
    const std::string_view line = trim(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (line.starts_with("///")) {
      addDocLine(doc, trim(line.substr(3)));
      continue;
    }
    const size_t assign = line.find(":=");
    if (assign != std::string_view::npos) {
      std::string_view value = trim(line.substr(assign + 2));
      if (value.ends_with(','))
        value = trim(value.substr(0, value.size() - 1));
      const std::string_view name = trim(line.substr(0, assign));
      const std::optional<int> number = parseNumber(value);
      if (number && (wanted ? *number == *wanted : equalIgnoringCase(name, what)))
        return MotionError{std::string(name), *number, doc};
    }
    doc.clear();
  }
  return std::nullopt;
}

/// What stops a running program: SR0001 …
struct ExceptionText {
  int number;
  std::string_view title;
  std::string_view text;
};
constexpr ExceptionText kExceptions[] = {
#define STRIDE_EXCEPTION(number, name, what, text) {number, what, text},
#include "runtime/common/exception_codes.def"
#undef STRIDE_EXCEPTION
};

std::string exceptionCode(const ExceptionText &exception) {
  return fmt::format("SR{:04}", exception.number);
}

const ExceptionText *findException(std::string_view what) {
  for (const ExceptionText &exception : kExceptions)
    if (equalIgnoringCase(exceptionCode(exception), what))
      return &exception;
  return nullptr;
}

std::string_view severityText(Severity severity) {
  switch (severity) {
  case Severity::Off:
    return "off unless it is switched on";
  case Severity::Note:
    return "note";
  case Severity::Warning:
    return "warning";
  case Severity::Error:
    return "error";
  }
  return {};
}

} // namespace

int explainCommand(const std::string &what) {
  // A bare number is a SoftMotion error unless it has four digits, as codes are written.
  const bool number = parseNumber(what).has_value();
  if (const CodeInfo *code = number && what.size() != 4 ? nullptr : findCode(what)) {
    print(fmt::format("{}: {}\nname: {}\nseverity: {}\n\n{}\n", codeName(code->code), code->title,
                      kebabName(code->code), severityText(code->severity),
                      trim(explainText(code->code))));
    return 0;
  }
  if (const std::optional<MotionError> error = findMotionError(what)) {
    print(fmt::format("SMC_ERROR {}: {}\n\n{}\n", error->number, error->name, error->text));
    return 0;
  }
  if (const ExceptionText *exception = findException(what)) {
    print(fmt::format("{}: {}\nwhen: the program runs\n\n{}\n", exceptionCode(*exception),
                      exception->title, trim(exception->text)));
    return 0;
  }
  if (trim(what).empty())
    return showError(Code::UnknownCode,
                     "the code is empty: `stride explain --list` says which there are");
  return showError(
      Code::UnknownCode,
      fmt::format("there is no diagnostic, no exception and no SoftMotion error `{}`", what));
}

int explainList() {
  std::string text;
  for (const CodeInfo &info : allCodes())
    text += fmt::format("{} {:<24} {}\n", codeName(info.code), kebabName(info.code), info.title);
  for (const ExceptionText &exception : kExceptions)
    text += fmt::format("{} {:<24} {}\n", exceptionCode(exception), "(run time)", exception.title);
  print(text);
  return 0;
}

} // namespace stc::cli
