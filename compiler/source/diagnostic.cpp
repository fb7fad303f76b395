#include "compiler/source/diagnostic.hpp"

#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace stc {

const std::vector<CodeInfo> &allCodes() {
  static const std::vector<CodeInfo> codes = [] {
    std::vector<CodeInfo> list = {
#define STC_DIAGNOSTIC(number, name, severity, title)                                              \
  {Code::name, Severity::severity, #name, title},
#include "compiler/source/diagnostic_codes.def"
#undef STC_DIAGNOSTIC
    };
    std::sort(list.begin(), list.end(),
              [](const CodeInfo &a, const CodeInfo &b) { return a.code < b.code; });
    return list;
  }();
  return codes;
}

const CodeInfo &info(Code code) {
  const auto &codes = allCodes();
  return *std::lower_bound(codes.begin(), codes.end(), code,
                           [](const CodeInfo &entry, Code wanted) { return entry.code < wanted; });
}

std::string codeName(Code code) {
  std::string digits = std::to_string(static_cast<unsigned>(code));
  return "SE" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

std::string kebabName(Code code) {
  std::string name;
  for (const char c : info(code).name) {
    if (c >= 'A' && c <= 'Z' && !name.empty())
      name += '-';
    name += lowerCase(c);
  }
  return name;
}

namespace {

bool sameWord(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lowerCase(x) == lowerCase(y); });
}

bool between(unsigned number, unsigned low, unsigned high) {
  return number >= low && number <= high;
}

} // namespace

const CodeInfo *findCode(std::string_view what) {
  std::string_view digits = what;
  if (digits.size() > 2 && sameWord(digits.substr(0, 2), "se"))
    digits.remove_prefix(2);
  const bool number = !digits.empty() && digits.size() <= 4 &&
                      digits.find_first_not_of("0123456789") == std::string_view::npos;
  unsigned value = 0;
  for (const char c : number ? digits : std::string_view())
    value = value * 10 + static_cast<unsigned>(c - '0');
  for (const CodeInfo &entry : allCodes()) {
    if (number ? static_cast<unsigned>(entry.code) == value : sameWord(kebabName(entry.code), what))
      return &entry;
  }
  return nullptr;
}

bool isLint(Code code) {
  const auto number = static_cast<unsigned>(code);
  return between(number, 390, 398) || between(number, 490, 499) || between(number, 570, 579) ||
         between(number, 610, 629) || between(number, 720, 729);
}

Severity Levels::of(Code code) const {
  const Severity byDefault = info(code).severity;
  if (byDefault == Severity::Error)
    return byDefault;
  if (const auto it = single_.find(code); it != single_.end())
    return it->second;
  const auto group = [this](Group wanted) -> std::optional<Severity> {
    const auto it = groups_.find(wanted);
    return it == groups_.end() ? std::nullopt : std::optional(it->second);
  };
  if (isLint(code))
    if (const auto severity = group(Group::Lints))
      return *severity;
  if (byDefault == Severity::Warning)
    if (const auto severity = group(Group::AllWarnings))
      return *severity;
  return byDefault;
}

void Levels::add(const Levels &other) {
  for (const auto &[code, severity] : other.single_)
    single_[code] = severity;
  for (const auto &[group, severity] : other.groups_)
    groups_[group] = severity;
}

std::optional<Levels::Group> findGroup(std::string_view name) {
  if (sameWord(name, "all-warnings"))
    return Levels::Group::AllWarnings;
  if (sameWord(name, "lints"))
    return Levels::Group::Lints;
  return std::nullopt;
}

std::vector<std::string> settingNames() {
  std::vector<std::string> names{"all-warnings", "lints"};
  for (const CodeInfo &entry : allCodes()) {
    if (entry.severity == Severity::Error)
      continue;
    names.push_back(kebabName(entry.code));
    names.push_back(codeName(entry.code));
  }
  return names;
}

void Diagnostics::setSilent(FileId file, uint32_t offset, Code code, bool silent) {
  silences_.push_back({file, offset, code, silent});
}

bool Diagnostics::isSilent(Code code, Span where) const {
  if (foreign_.contains(where.file))
    return true;
  bool silent = false;
  for (const Silence &s : silences_) {
    if (s.code == code && s.file == where.file && s.offset <= where.begin)
      silent = s.silent;
  }
  return silent;
}

Diagnostic &Diagnostics::report(Code code, Span where, std::string message, std::string labelText) {
  const Severity severity = levels_.of(code);
  if (severity == Severity::Off ||
      (info(code).severity != Severity::Error && isSilent(code, where))) {
    dropped_ = {};
    return dropped_;
  }
  Diagnostic &added = list_.emplace_back();
  added.code = code;
  added.severity = severity;
  added.message = std::move(message);
  if (where.valid())
    added.labels.push_back({where, std::move(labelText)});
  if (added.severity == Severity::Error)
    ++errors_;
  else if (added.severity == Severity::Warning)
    ++warnings_;
  return added;
}

Diagnostics Diagnostics::part() const {
  Diagnostics part;
  part.levels_ = levels_;
  part.silences_ = silences_;
  part.inherited_ = silences_.size();
  part.foreign_ = foreign_;
  return part;
}

void Diagnostics::add(Diagnostics &&part) {
  std::move(part.list_.begin(), part.list_.end(), std::back_inserter(list_));
  silences_.insert(silences_.end(),
                   part.silences_.begin() + static_cast<ptrdiff_t>(part.inherited_),
                   part.silences_.end());
  foreign_.insert(part.foreign_.begin(), part.foreign_.end());
  errors_ += part.errors_;
  warnings_ += part.warnings_;
  part = {};
}

void Diagnostics::sort() {
  const auto place = [](const Diagnostic &d) {
    const Span span = d.labels.empty() ? Span{} : d.labels.front().span;
    return std::make_tuple(span.file, span.begin);
  };
  std::stable_sort(list_.begin(), list_.end(),
                   [&](const Diagnostic &a, const Diagnostic &b) { return place(a) < place(b); });
  const auto same = [&](const Diagnostic &a, const Diagnostic &b) {
    return a.code == b.code && place(a) == place(b) && a.message == b.message;
  };
  list_.erase(std::unique(list_.begin(), list_.end(), same), list_.end());
  errors_ = warnings_ = 0;
  for (const Diagnostic &d : list_) {
    errors_ += d.severity == Severity::Error;
    warnings_ += d.severity == Severity::Warning;
  }
}

} // namespace stc
