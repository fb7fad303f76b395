#include "compiler/export/chart_text.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/source/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace stc::exporting {

namespace {

/// After the `}` of the pragma that begins at `at`; what stands between quotes does not end it.
size_t pragmaEnd(std::string_view text, size_t at) {
  for (size_t i = at + 1; i < text.size();) {
    if (text[i] == '}')
      return i + 1;
    const size_t string = afterString(text, i);
    i = string != i ? string : i + 1;
  }
  return text.size();
}

/// The texts of all comments, line by line, without their signs. `pragmas` gets those between them.
std::string commentsIn(std::string_view text, std::string &pragmas) {
  std::string lines;
  for (size_t at = 0; at < text.size();) {
    if (const size_t end = commentEnd(text, at); end != at) {
      std::string_view comment = text.substr(at, end - at);
      const bool block = !comment.starts_with("//");
      comment.remove_prefix(2);
      if (block && comment.size() >= 2)
        comment.remove_suffix(2);
      while (!block && comment.starts_with('/'))
        comment.remove_prefix(1);
      for (size_t begin = 0; begin <= comment.size();) {
        const size_t line = std::min(comment.find('\n', begin), comment.size());
        if (const std::string_view one = trimmed(comment.substr(begin, line - begin)); !one.empty())
          lines.append(one).append("\n");
        begin = line + 1;
      }
      at = end;
    } else if (const size_t string = afterString(text, at); string != at) {
      at = string;
    } else if (text[at] == '{') {
      const size_t close = pragmaEnd(text, at);
      pragmas.append(text.substr(at, close - at)).append("\n");
      at = close;
    } else {
      ++at;
    }
  }
  return lines;
}

class ChartReader {
public:
  explicit ChartReader(std::string_view text) : text_(text), words_(wordsOf(text)) {}

  std::optional<ChartText> read() {
    while (good_ && at_ < words_.size()) {
      if (is("STEP") || is("INITIAL_STEP"))
        step();
      else if (is("TRANSITION"))
        transition();
      else
        good_ = false;
    }
    std::string pragmas; // no part has them
    out_.comment = comments(text_.size(), pragmas);
    if (!good_ || !pragmas.empty() || out_.steps.empty())
      return std::nullopt;
    return std::move(out_);
  }

private:
  [[nodiscard]] std::string_view word(size_t ahead = 0) const {
    if (at_ + ahead >= words_.size())
      return {};
    const StWord &one = words_[at_ + ahead];
    return text_.substr(one.begin, one.end - one.begin);
  }
  [[nodiscard]] bool is(std::string_view other, size_t ahead = 0) const {
    return equalIgnoringCase(word(ahead), other);
  }
  [[nodiscard]] bool isName(size_t ahead = 0) const {
    return at_ + ahead < words_.size() && words_[at_ + ahead].kind == StWord::Kind::Name;
  }
  /// `(PRIORITY :=`; a step may have this name.
  [[nodiscard]] bool isPriority(size_t ahead) const {
    return word(ahead) == "(" && is("PRIORITY", ahead + 1) && word(ahead + 2) == ":";
  }
  void take(std::string_view wanted) {
    good_ = good_ && is(wanted);
    ++at_;
  }
  std::string takeName() {
    good_ = good_ && isName();
    std::string name(word());
    ++at_;
    return name;
  }
  /// Up to `end` (outside of brackets) in the words, not taken.
  std::string textUpTo(std::string_view end) {
    const size_t begin = at_ < words_.size() ? words_[at_].begin : text_.size();
    // What stands between quotes is no word.
    const size_t from = at_ == 0 ? begin : std::min(begin, words_[at_ - 1].end);
    size_t depth = 0;
    while (at_ < words_.size() && (depth != 0 || !is(end))) {
      depth += word() == "(" || word() == "[" ? 1 : 0;
      depth -= depth != 0 && (word() == ")" || word() == "]") ? 1 : 0;
      ++at_;
    }
    good_ = good_ && at_ < words_.size();
    const size_t to = good_ ? words_[at_].begin : text_.size();
    return std::string(trimmed(text_.substr(from, to - from)));
  }
  std::string comments(size_t end, std::string &pragmas) {
    const size_t begin = std::exchange(done_, end);
    return commentsIn(text_.substr(begin, end - begin), pragmas);
  }

  void step() {
    ChartStepText one;
    one.initial = is("INITIAL_STEP");
    ++at_;
    one.name = takeName();
    if (is("("))
      stepTimes(one);
    take(":");
    good_ = good_ && !is("=");
    while (good_ && !is("END_STEP"))
      one.actions.push_back(action());
    finish(one.comment, one.pragmas);
    out_.steps.push_back(std::move(one));
  }

  /// `(MIN_TIME := T#1s, MAX_TIME := x)`
  void stepTimes(ChartStepText &one) {
    ++at_;
    const std::string all = textUpTo(")");
    take(")");
    for (const std::string_view part : partsOf(all)) {
      const size_t sign = part.find(":=");
      good_ = good_ && sign != std::string_view::npos;
      if (!good_)
        return;
      const bool least = equalIgnoringCase(trimmed(part.substr(0, sign)), "MIN_TIME");
      (least ? one.minTime : one.maxTime) = trimmed(part.substr(sign + 2));
    }
  }

  /// What stands between commas outside of brackets.
  static std::vector<std::string_view> partsOf(std::string_view all) {
    std::vector<std::string_view> parts;
    size_t depth = 0;
    size_t begin = 0;
    for (const StWord &each : wordsOf(all)) {
      const char sign = all[each.begin];
      depth += sign == '(' || sign == '[' ? 1 : 0;
      depth -= sign == ')' || sign == ']' ? 1 : 0;
      if (sign != ',' || depth != 0)
        continue;
      parts.push_back(trimmed(all.substr(begin, each.begin - begin)));
      begin = each.end;
    }
    parts.push_back(trimmed(all.substr(begin)));
    return parts;
  }

  ChartActionText action() {
    ChartActionText one{takeName(), "N", {}, {}};
    if (is("(")) {
      ++at_;
      if (!is(")"))
        one.qualifier = stride::common::upperCase(takeName());
      if (one.qualifier == "S0" || one.qualifier == "R0") // other words for S and R
        one.qualifier.pop_back();
      if (is(",")) {
        ++at_;
        takeTimes(one);
      }
      take(")");
    }
    take(";");
    return one;
  }

  /// `T#5s, done`: a time where the qualifier has one, then indicator variables.
  void takeTimes(ChartActionText &one) {
    constexpr std::array<std::string_view, 5> kTimed = {"L", "D", "SD", "DS", "SL"};
    const std::string all = textUpTo(")");
    if (std::ranges::find(kTimed, one.qualifier) == kTimed.end()) {
      one.indicator = all;
      return;
    }
    const std::string_view time = partsOf(all).front();
    one.time = time;
    if (const auto end = static_cast<size_t>(time.data() + time.size() - all.data());
        end < all.size())
      one.indicator = trimmed(std::string_view(all).substr(all.find(',', end) + 1));
  }

  std::vector<std::string> steps() {
    std::vector<std::string> names;
    if (!is("(")) {
      names.push_back(takeName());
      return names;
    }
    do {
      ++at_;
      names.push_back(takeName());
    } while (good_ && is(","));
    take(")");
    return names;
  }

  void transition() {
    ChartTransitionText one;
    ++at_;
    if (isName() && (!is("FROM") || is("FROM", 1) || isPriority(1)))
      one.name = takeName();
    if (isPriority(0)) {
      at_ += 2;
      take(":");
      take("=");
      one.priority = word();
      good_ = good_ && !one.priority.empty() &&
              std::ranges::all_of(one.priority, [](char c) { return c >= '0' && c <= '9'; });
      ++at_;
      take(")");
    }
    take("FROM");
    one.from = steps();
    take("TO");
    one.to = steps();
    take(":");
    one.instructions = !is("=");
    at_ += one.instructions ? 0 : 1;
    one.comment = comments(at_ <= words_.size() ? words_[at_ - 1].end : text_.size(), one.pragmas);
    one.condition = textUpTo(one.instructions ? "END_TRANSITION" : ";");
    done_ = at_ < words_.size() ? words_[at_].begin : text_.size(); // its comments stay in it
    if (one.instructions)
      one.condition += "\n";
    else
      take(";");
    good_ = good_ && is("END_TRANSITION");
    finish(one.comment, one.pragmas);
    out_.transitions.push_back(std::move(one));
  }

  /// Takes the END_… word.
  void finish(std::string &comment, std::string &pragmas) {
    if (!good_ || at_ >= words_.size()) {
      good_ = false;
      return;
    }
    comment += comments(words_[at_].end, pragmas);
    ++at_;
  }

  std::string_view text_;
  std::vector<StWord> words_;
  size_t at_ = 0;
  size_t done_ = 0; ///< where the comments begin that no part has yet
  bool good_ = true;
  ChartText out_;
};

} // namespace

std::optional<ChartText> chartText(std::string_view body) { return ChartReader(body).read(); }

} // namespace stc::exporting
