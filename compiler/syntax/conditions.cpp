#include "compiler/syntax/conditions.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <cstdlib>

namespace stc {

namespace {

/// Names that every build defines.
constexpr std::string_view kAlways[] = {"stride", "islittleendian", "isfpusupported"};

} // namespace

std::optional<Define> readDefine(std::string_view text) {
  const size_t equal = std::min(text.find('='), text.size());
  const std::string_view name = text.substr(0, equal);
  if (name.empty() || !isLetter(name[0]) || !std::all_of(name.begin(), name.end(), isWordChar))
    return std::nullopt;
  return Define{std::string(name), std::string(text.substr(std::min(equal + 1, text.size())))};
}

Conditions::Conditions(const ParseOptions *options)
    : names_(options == nullptr ? nullptr : options->names),
      generated_(options != nullptr && options->generated) {
  for (const std::string_view name : kAlways)
    defines_.emplace(name, "");
  if (options != nullptr)
    for (const Define &one : options->defines)
      define(one.name, one.value);
}

void Conditions::define(std::string_view name, std::string_view value) {
  defines_[lowerCase(name)] = value;
}

void Conditions::undefine(std::string_view name) { defines_.erase(lowerCase(name)); }

/// Recursive descent over the text of one condition.
class ConditionParser {
public:
  ConditionParser(Conditions &conditions, std::string_view text, Span place,
                  Diagnostics &diagnostics)
      : conditions_(conditions), text_(text), place_(place), diagnostics_(diagnostics) {}

  std::optional<bool> run() {
    const bool value = alternatives();
    skip();
    if (at_ < text_.size())
      fail(at_, text_.size(), "expected AND, OR or `}`");
    return failed_ ? std::nullopt : std::optional(value);
  }

private:
  using Kind = DeclaredNames::Kind;

  void skip() {
    while (at_ < text_.size() && classOf(text_[at_]) == kBlank)
      ++at_;
  }
  bool fail(size_t from, size_t to, std::string expected) {
    if (failed_)
      return false;
    failed_ = true;
    const auto begin = static_cast<uint32_t>(place_.begin + from);
    const auto end = static_cast<uint32_t>(place_.begin + std::max(to, from));
    Diagnostic &d = diagnostics_.report(Code::MalformedPragma, {place_.file, begin, end},
                                        "this condition cannot be understood", std::move(expected));
    const std::string_view found = text_.substr(from, to - from);
    if (!found.empty() && isLetter(found[0]) && d.labels[0].text.starts_with("expected a question"))
      d.help("write `defined (" + std::string(found) + ")`");
    else
      d.note("conditions are made of defined (…), hasattribute (…), hastype (…), hasvalue (…), "
             "hasconstantvalue (…), NOT, AND, OR and parentheses");
    return false;
  }
  std::string_view word() {
    skip();
    const size_t begin = at_;
    if (at_ < text_.size() && isLetter(text_[at_]))
      while (at_ < text_.size() && isWordChar(text_[at_]))
        ++at_;
    return text_.substr(begin, at_ - begin);
  }
  bool takeWord(std::string_view wanted) {
    const size_t before = at_;
    if (lowerCase(word()) == wanted)
      return true;
    at_ = before;
    return false;
  }
  bool take(char wanted) {
    skip();
    if (at_ >= text_.size() || text_[at_] != wanted)
      return false;
    ++at_;
    return true;
  }
  void demand(char wanted) {
    if (!take(wanted))
      fail(at_, std::min(at_ + 1, text_.size()), std::string("expected `") + wanted + "` here");
  }

  bool alternatives() {
    bool value = conjunction();
    while (!failed_ && takeWord("or")) {
      const bool next = conjunction();
      value = value || next;
    }
    return value;
  }
  bool conjunction() {
    bool value = negation();
    while (!failed_ && takeWord("and")) {
      const bool next = negation();
      value = value && next;
    }
    return value;
  }
  bool negation() {
    bool negative = false;
    while (takeWord("not"))
      negative = !negative;
    return question() != negative;
  }

  /// What can be asked of names: `defined (…)`
  struct Question {
    std::string_view name;
    bool (ConditionParser::*ask)();
  };
  bool question() {
    if (take('(')) {
      if (++depth_ > kMaxNesting)
        return fail(at_ - 1, at_, "nested too deeply");
      const bool value = alternatives();
      --depth_;
      demand(')');
      return value;
    }
    skip();
    const size_t begin = at_;
    const std::string name = lowerCase(word());
    if (name == "true" || name == "false")
      return name == "true";
    static constexpr Question kQuestions[] = {
        {"defined", &ConditionParser::isDefined},
        {"hasattribute", &ConditionParser::hasAttribute},
        {"hastype", &ConditionParser::hasType},
        {"hasvalue", &ConditionParser::hasValue},
        {"hasconstantvalue", &ConditionParser::hasConstantValue},
    };
    const auto *found = std::find_if(std::begin(kQuestions), std::end(kQuestions),
                                     [&](const Question &one) { return one.name == name; });
    if (found == std::end(kQuestions))
      return fail(begin, std::max(at_, std::min(begin + 1, text_.size())),
                  "expected a question such as `defined (NAME)`");
    demand('(');
    const bool value = (this->*found->ask)();
    demand(')');
    return value;
  }

  std::string path() {
    std::string out = lowerCase(word());
    if (out.empty())
      fail(at_, std::min(at_ + 1, text_.size()), "expected a name here");
    while (!failed_ && take('.')) {
      out += '.';
      out += lowerCase(word());
    }
    return out;
  }
  /// What stands up to the next comma or closing parenthesis, without blanks, in lower case; a
  /// quoted text without its quotes.
  std::string value() {
    skip();
    if (at_ < text_.size() && (text_[at_] == '\'' || text_[at_] == '"')) {
      const size_t close = text_.find(text_[at_], at_ + 1);
      if (close == std::string_view::npos) {
        fail(at_, text_.size(), "this text has no end");
        return {};
      }
      std::string out(text_.substr(at_ + 1, close - at_ - 1));
      at_ = close + 1;
      return out;
    }
    std::string out;
    unsigned depth = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (depth == 0 && (c == ',' || c == ')'))
        break;
      depth += c == '(' || c == '[';
      depth -= depth > 0 && (c == ')' || c == ']');
      if (classOf(c) != kBlank)
        out += lowerCase(c);
    }
    if (out.empty())
      fail(at_, std::min(at_ + 1, text_.size()), "expected a value here");
    return out;
  }
  const DeclaredNames::Entry *find(Kind kind, const std::string &name) {
    return conditions_.names_ == nullptr ? nullptr
                                         : conditions_.names_->find(kind, name, place_.file);
  }
  /// `variable: name`, `pou: name`, `type: name`.
  const DeclaredNames::Entry *object(bool &known) {
    skip();
    const size_t begin = at_;
    const std::string kind = lowerCase(word());
    known = true;
    demand(':');
    if (failed_)
      return nullptr;
    const std::string name = path();
    if (kind == "variable")
      return find(Kind::Variable, name);
    if (kind == "type")
      return find(Kind::Type, name);
    if (kind == "pou")
      return find(Kind::Pou, name);
    known = kind == "task" || kind == "resource" || kind == "project_defined";
    if (!known)
      fail(begin, begin + kind.size(), "expected variable, type or pou");
    return nullptr;
  }

  bool isDefined() {
    const size_t before = at_;
    const std::string name = lowerCase(word());
    if (take(':')) {
      at_ = before;
      bool known = false;
      return object(known) != nullptr;
    }
    at_ = before;
    return conditions_.defines_.contains(path());
  }
  bool hasAttribute() {
    bool known = false;
    const DeclaredNames::Entry *entry = object(known);
    demand(',');
    const std::string name = lowerCase(value());
    return entry != nullptr && std::find(entry->attributes.begin(), entry->attributes.end(),
                                         name) != entry->attributes.end();
  }
  bool hasType() {
    bool known = false;
    const DeclaredNames::Entry *entry = object(known);
    demand(',');
    const std::string name = value();
    return entry != nullptr && entry->type == name;
  }
  bool hasValue() {
    const std::string name = path();
    demand(',');
    const std::string wanted = value();
    const auto it = conditions_.defines_.find(name);
    return it != conditions_.defines_.end() && it->second == wanted;
  }
  /// hasconstantvalue (variable: c, 5, >)
  bool hasConstantValue() {
    bool known = false;
    const size_t before = at_;
    (void)word();
    const bool named = take(':');
    at_ = before;
    const DeclaredNames::Entry *entry = named ? object(known) : find(Kind::Variable, path());
    demand(',');
    const std::string wanted = value();
    const std::string op = take(',') ? value() : "=";
    if (entry == nullptr || entry->init.empty() || wanted.empty())
      return false;
    char *end = nullptr;
    const double left = std::strtod(entry->init.c_str(), &end);
    const bool leftIsNumber = *end == 0;
    const double right = std::strtod(wanted.c_str(), &end);
    if (!leftIsNumber || *end != 0)
      return (entry->init == wanted || entry->init == "'" + wanted + "'") != (op == "<>");
    return op == "="    ? left == right
           : op == "<>" ? left != right
           : op == "<"  ? left < right
           : op == "<=" ? left <= right
           : op == ">"  ? left > right
           : op == ">=" ? left >= right
                        : fail(at_ - op.size(), at_, "expected =, <>, <, <=, > or >=");
  }

  Conditions &conditions_;
  std::string_view text_;
  Span place_;
  Diagnostics &diagnostics_;
  size_t at_ = 0;
  unsigned depth_ = 0;
  bool failed_ = false;
};

std::optional<bool> Conditions::evaluate(std::string_view text, Span place,
                                         Diagnostics &diagnostics) {
  return ConditionParser(*this, text, place, diagnostics).run();
}

} // namespace stc
