// Reads scripts: line by line, every mistake with its place.
#include "runtime/app/error.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/common/text.hpp"
#include "runtime/iec/text.h"
#include "runtime/script/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <type_traits>
#include <utility>

namespace stride::script {

namespace {

constexpr size_t kMostMistakes = 20;
constexpr const char *kForms =
    "a line is 'at TIME: …', 'when CONDITION: …', 'whenever CONDITION: …', 'wait TIME', 'wait "
    "until CONDITION', 'NAME := VALUE', 'force NAME := VALUE', 'release NAME', 'stop', 'start', "
    "'sequence NAME' or 'end_sequence'";

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool isWordCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// A mistake at a byte of the line.
struct Mistake {
  size_t at;
  std::string text;
};

/// One line, read from left to right.
class Line {
public:
  explicit Line(std::string_view text) : text_(text) { skipBlanks(); }

  size_t at() const { return at_; }
  bool atEnd() const { return at_ >= text_.size() || text_.substr(at_, 2) == "//"; }
  /// What stands from here to the end, for messages.
  std::string_view rest() const { return text_.substr(at_); }

  bool take(std::string_view symbol) {
    if (text_.substr(at_, symbol.size()) != symbol)
      return false;
    at_ += symbol.size();
    skipBlanks();
    return true;
  }
  void expect(std::string_view symbol, const char *where) {
    if (!take(symbol))
      throw Mistake{at_, fmt::format("'{}' is missing {}", symbol, where)};
  }
  /// A keyword, in any case, that is not the beginning of a path or of an assignment.
  bool takeKeyword(std::string_view keyword) {
    size_t end = at_;
    while (end < text_.size() && isWordCharacter(text_[end]))
      ++end;
    if (common::lowerCase(text_.substr(at_, end - at_)) != keyword)
      return false;
    size_t next = end;
    while (next < text_.size() && isBlank(text_[next]))
      ++next;
    const std::string_view behind = text_.substr(next, 2);
    if (behind == ":=" || (end < text_.size() && (text_[end] == '.' || text_[end] == '[')))
      return false;
    at_ = next;
    return true;
  }
  std::string_view path() {
    const size_t start = at_;
    int depth = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      depth += c == '[' ? 1 : c == ']' ? -1 : 0;
      if ((depth <= 0 && isBlank(c)) || std::string_view(":=<>;()").find(c) < 7)
        break;
      if (text_.substr(at_, 2) == "//")
        break;
      ++at_;
    }
    if (at_ == start)
      throw Mistake{at_, "the name of a variable is missing"};
    return taken(start);
  }
  /// A literal or a time. A colon ends it except between digits (TOD#12:30).
  std::string_view literal(const char *what) {
    const size_t start = at_;
    char quote = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (quote != 0) {
        if (c == '$' && at_ + 1 < text_.size())
          ++at_;
        else if (c == quote)
          quote = 0;
      } else if (c == '\'' || c == '"') {
        quote = c;
      } else if (isBlank(c) || c == ';' || c == ')' || text_.substr(at_, 2) == "//" ||
                 (c == ':' && !(digitAt(at_ - 1) && digitAt(at_ + 1)))) {
        break;
      }
      ++at_;
    }
    if (at_ == start)
      throw Mistake{at_, fmt::format("{} is missing", what)};
    return taken(start);
  }

private:
  bool digitAt(size_t i) const { return i < text_.size() && text_[i] >= '0' && text_[i] <= '9'; }
  std::string_view taken(size_t start) {
    const std::string_view token = text_.substr(start, at_ - start);
    skipBlanks();
    return token;
  }
  void skipBlanks() {
    while (at_ < text_.size() && isBlank(text_[at_]))
      ++at_;
  }

  std::string_view text_;
  size_t at_ = 0;
};

} // namespace

/// Fills a Script.
class ScriptReader {
public:
  ScriptReader(Script &script, const app::SymbolTable &symbols)
      : script_(&script), symbols_(&symbols) {}

  void read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF"))
      text.remove_prefix(3);
    while (!text.empty()) {
      const size_t end = std::min(text.find('\n'), text.size());
      ++number_;
      line_ = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      try {
        Line line(line_);
        readLine(line);
      } catch (const Mistake &mistake) {
        report(positionOf(mistake.at), mistake.text);
      }
      if (mistakes_.size() >= kMostMistakes)
        break;
    }
    if (inSequence_)
      report(sequenceAt_, "this sequence has no 'end_sequence'");
    if (!mistakes_.empty())
      throw app::Error(fmt::format("{}", fmt::join(mistakes_, "\nerror: ")));
  }

private:
  using Does = Script::Does;
  using Step = Script::Step;
  using Thread = Script::Thread;

  Script::Position positionOf(size_t byte) const {
    uint32_t column = 1;
    for (const char c : line_.substr(0, byte))
      column += (static_cast<unsigned char>(c) & 0xC0U) == 0x80U ? 0 : 1;
    return {number_, column};
  }
  void report(const Script::Position &at, const std::string &text) {
    mistakes_.push_back(fmt::format("{}:{}:{}: {}", script_->file_, at.line, at.column, text));
  }

  void readLine(Line &line) {
    if (line.atEnd())
      return;
    const size_t start = line.at();
    if (line.takeKeyword("sequence"))
      beginSequence(line, start);
    else if (line.takeKeyword("end_sequence"))
      endSequence(line, start);
    else if (line.takeKeyword("at"))
      rule(line, start, Does::WaitAt, false);
    else if (line.takeKeyword("whenever"))
      rule(line, start, Does::WaitUntil, true);
    else if (line.takeKeyword("when"))
      rule(line, start, Does::WaitUntil, false);
    else
      steps(line, stepsHere());
    if (!line.atEnd())
      throw Mistake{line.at(), fmt::format("'{}' was not expected there", line.rest())};
  }

  void beginSequence(Line &line, size_t start) {
    if (inSequence_)
      throw Mistake{start, fmt::format("the sequence of line {} has not ended; 'end_sequence' is "
                                       "missing before this line",
                                       sequenceAt_.line)};
    inSequence_ = true;
    sequenceAt_ = positionOf(start);
    if (!line.atEnd())
      (void)line.path(); // its name is for the reader
    script_->threads_.emplace_back();
    here_ = script_->threads_.size() - 1;
  }
  void endSequence(Line &, size_t start) {
    if (!inSequence_)
      throw Mistake{start, "no sequence begins before this line"};
    inSequence_ = false;
    here_ = outside_;
  }

  /// The steps that lines outside of rules belong to.
  Thread &stepsHere() {
    if (here_ == kNone) {
      script_->threads_.emplace_back();
      here_ = outside_ = script_->threads_.size() - 1;
    }
    return script_->threads_[here_];
  }

  void rule(Line &line, size_t start, Does does, bool repeats) {
    if (inSequence_)
      throw Mistake{start,
                    fmt::format("a rule stands outside of sequences; in the sequence of "
                                "line {} write '{}'",
                                sequenceAt_.line,
                                does == Does::WaitAt ? "wait TIME" : "wait until CONDITION")};
    Thread thread;
    thread.repeats = repeats;
    Step wait;
    wait.does = does;
    wait.at = positionOf(start);
    if (does == Does::WaitAt)
      wait.timeNs = time(line);
    else
      wait.condition = condition(line);
    line.expect(":", does == Does::WaitAt ? "after the time" : "after the condition");
    Step again = wait;
    thread.steps.push_back(std::move(wait));
    if (line.atEnd())
      throw Mistake{line.at(), "what is to be done is missing after ':'; write for example "
                               "'NAME := VALUE' in the same line"};
    do {
      action(line, thread);
    } while (line.take(";") && !line.atEnd());
    if (repeats) { // then for the next time that the condition becomes true
      again.does = Does::WaitUntilNot;
      thread.steps.push_back(std::move(again));
    }
    script_->threads_.push_back(std::move(thread));
  }

  void steps(Line &line, Thread &thread) {
    do {
      const size_t start = line.at();
      if (!line.takeKeyword("wait")) {
        action(line, thread);
        continue;
      }
      Step wait;
      wait.at = positionOf(start);
      if (line.takeKeyword("until")) {
        wait.does = Does::WaitUntil;
        wait.condition = condition(line);
      } else {
        wait.does = Does::WaitFor;
        wait.timeNs = time(line);
      }
      thread.steps.push_back(std::move(wait));
    } while (line.take(";") && !line.atEnd());
  }

  void action(Line &line, Thread &thread) {
    Step step;
    const size_t start = line.at();
    step.at = positionOf(start);
    if (line.takeKeyword("force"))
      step.does = Does::Force;
    else if (line.takeKeyword("release"))
      step.does = Does::Release;
    else if (line.takeKeyword("stop"))
      step.does = Does::Stop;
    else if (line.takeKeyword("start"))
      step.does = Does::Start;
    if (step.does == Does::Stop || step.does == Does::Start) {
      thread.steps.push_back(std::move(step));
      return;
    }
    const size_t nameAt = line.at();
    const std::string_view path = line.path();
    if (step.does == Does::Write && !line.take(":=")) {
      const size_t signAt = line.at();
      throw line.take("=")
          ? Mistake{signAt, "a value is assigned with ':='"}
          : Mistake{start, fmt::format("'{}' is not understood; {}", path, kForms)};
    }
    if (step.does == Does::Force)
      line.expect(":=", "after the name");
    step.symbol = checked(nameAt, [&] { return app::resolveWritable(*symbols_, path); });
    if (step.does != Does::Release)
      step.value = value(line, step.symbol);
    if (step.does != Does::Write)
      step.forced = script_->forces_->add(step.symbol);
    thread.steps.push_back(std::move(step));
  }

  std::vector<std::byte> value(Line &line, const app::Symbol &symbol) {
    const size_t at = line.at();
    const std::string_view literal = line.literal("a value");
    return checked(at, [&] { return app::literalBytes(*symbols_, symbol, literal); });
  }

  std::vector<std::byte> compared(Line &line, const app::Symbol &symbol) {
    const size_t at = line.at();
    const std::string_view literal = line.literal("a value");
    return checked(at, [&] { return app::comparedBytes(*symbols_, symbol, literal); });
  }

  int64_t time(Line &line) {
    const size_t at = line.at();
    const std::string_view text = line.literal("a time");
    const text::Scanned scanned =
        text::scanDuration(text.data(), static_cast<uint32_t>(text.size()));
    if (scanned.used == 0 || scanned.used != text.size() || scanned.overflow || scanned.ns < 0)
      throw Mistake{
          at, fmt::format("'{}' is not a time; write for example T#1s500ms, 5s or 500ms", text)};
    return scanned.ns;
  }

  app::Condition condition(Line &line) {
    app::Condition result;
    depth_ = 0;
    alternatives(line, result);
    return result;
  }
  void alternatives(Line &line, app::Condition &result) {
    conjunction(line, result);
    while (line.takeKeyword("or")) {
      conjunction(line, result);
      result.addOr();
    }
  }
  void conjunction(Line &line, app::Condition &result) {
    operand(line, result);
    while (line.takeKeyword("and")) {
      operand(line, result);
      result.addAnd();
    }
  }
  void operand(Line &line, app::Condition &result) {
    const size_t start = line.at();
    if (++depth_ > app::Condition::kMaxDepth)
      throw Mistake{start, "the condition is nested too deeply"};
    if (line.takeKeyword("not")) {
      operand(line, result);
      result.addNot();
    } else if (line.take("(")) {
      alternatives(line, result);
      line.expect(")", "at the end of the bracket");
    } else if (!result.add(comparison(line))) {
      throw Mistake{start, "the condition is nested too deeply"};
    }
    --depth_;
  }
  app::Comparison comparison(Line &line) {
    const size_t nameAt = line.at();
    const std::string_view path = line.path();
    app::Symbol symbol = checked(nameAt, [&] { return app::resolveElementary(*symbols_, path); });
    const std::optional<app::Relation> relation = takeRelation(line);
    if (!relation && symbols_->type(symbol).kind != Kind::BOOL)
      throw Mistake{nameAt, fmt::format("'{}' is {}, not BOOL; compare it with a value: =, <>, <, "
                                        "<=, > or >=",
                                        path, symbols_->type(symbol).name)};
    std::vector<std::byte> bytes =
        relation ? compared(line, symbol) : std::vector<std::byte>{std::byte{1}};
    return {*symbols_, std::move(symbol), relation.value_or(app::Relation::Equal),
            std::move(bytes)};
  }
  static std::optional<app::Relation> takeRelation(Line &line) {
    static constexpr std::pair<std::string_view, app::Relation> kRelations[] = {
        {"<=", app::Relation::LessEqual}, {">=", app::Relation::GreaterEqual},
        {"<>", app::Relation::NotEqual},  {"=", app::Relation::Equal},
        {"<", app::Relation::Less},       {">", app::Relation::Greater}};
    for (const auto &[sign, relation] : kRelations)
      if (line.take(sign))
        return relation;
    return std::nullopt;
  }

  template <class F> static std::invoke_result_t<F> checked(size_t at, F f) {
    try {
      return f();
    } catch (const app::Error &error) {
      throw Mistake{at, error.what()};
    }
  }

  static constexpr size_t kNone = ~size_t{0};
  Script *script_;
  const app::SymbolTable *symbols_;
  std::string_view line_;
  uint32_t number_ = 0;
  size_t here_ = kNone;    // the thread that steps go to
  size_t outside_ = kNone; // that of the steps outside of sequences
  bool inSequence_ = false;
  size_t depth_ = 0;
  Script::Position sequenceAt_;
  std::vector<std::string> mistakes_;
};

Script::Script(const app::SymbolTable &symbols, std::string_view text, std::string file)
    : file_(std::move(file)), text_(text), forces_(std::make_unique<FixedForces>()) {
  ScriptReader(*this, symbols).read(text);
}

Script Script::fromFile(const app::SymbolTable &symbols, const std::string &file) {
  constexpr size_t kMostBytes = size_t{16} << 20U;
  std::ifstream in(file, std::ios::binary);
  std::string text;
  char block[1 << 14];
  while (in && text.size() <= kMostBytes) {
    in.read(block, sizeof block);
    text.append(block, static_cast<size_t>(in.gcount()));
  }
  if (text.size() > kMostBytes) // a device has no end
    throw app::Error(fmt::format("cannot read '{}': it is longer than 16 MiB", file));
  if (!in.eof() || in.bad())
    throw app::Error(fmt::format("cannot read '{}': {}", file, std::strerror(errno)));
  return Script(symbols, text, file);
}

} // namespace stride::script
