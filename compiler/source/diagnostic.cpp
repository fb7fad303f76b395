#include "compiler/source/diagnostic.hpp"

#include <algorithm>
#include <tuple>

namespace stc {

const std::vector<CodeInfo> &allCodes() {
  static const std::vector<CodeInfo> codes = [] {
    std::vector<CodeInfo> list = {
#define STC_DIAGNOSTIC(number, name, severity, title, explain)                                     \
  {Code::name, Severity::severity, title, explain},
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

Diagnostic &Diagnostics::report(Code code, Span where, std::string message, std::string labelText) {
  Diagnostic &added = list_.emplace_back();
  added.code = code;
  added.severity = info(code).severity;
  added.message = std::move(message);
  if (where.valid())
    added.labels.push_back({where, std::move(labelText)});
  if (added.severity == Severity::error)
    ++errors_;
  else if (added.severity == Severity::warning)
    ++warnings_;
  return added;
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
    errors_ += d.severity == Severity::error;
    warnings_ += d.severity == Severity::warning;
  }
}

} // namespace stc
