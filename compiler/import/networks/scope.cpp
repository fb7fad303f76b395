#include "compiler/import/networks/scope.hpp"

#include "compiler/import/networks/text.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stc::import::networks {

using stride::common::upperCase;

using stride::common::lowerCase;

namespace {

constexpr std::array<std::string_view, 9> kQualifiers = {"CONSTANT",   "RETAIN",   "PERSISTENT",
                                                         "NON_RETAIN", "PUBLIC",   "PRIVATE",
                                                         "PROTECTED",  "INTERNAL", "ABSTRACT"};

constexpr std::array<std::string_view, 10> kSections = {
    "VAR",      "VAR_INPUT", "VAR_OUTPUT",   "VAR_IN_OUT", "VAR_TEMP",
    "VAR_STAT", "VAR_INST",  "VAR_EXTERNAL", "VAR_GLOBAL", "VAR_CONFIG"};

/// Types that are other names of each other would have no end.
constexpr int kAliasesFollowed = 32;

/// Words that a variable cannot have as its name although no declaration shows them.
constexpr std::array<std::string_view, 12> kReserved = {"and", "or",  "not", "xor", "mod",  "if",
                                                        "for", "var", "add", "sub", "move", "sel"};

} // namespace

/// Goes through declarations word by word; what it does not know it passes over.
class DeclarationReader {
public:
  DeclarationReader(std::string_view text, Scope &scope, bool entered)
      : words_(wordsOf(text)), scope_(scope), entered_(entered) {}

  void read() {
    while (!atEnd()) {
      const std::string word = upper();
      ++at_;
      if (word == "PROGRAM" || word == "FUNCTION" || word == "FUNCTION_BLOCK")
        beginPou(word);
      else if (word == "END_PROGRAM" || word == "END_FUNCTION" || word == "END_FUNCTION_BLOCK")
        pou_ = nullptr;
      else if (word == "METHOD" || word == "ACTION" || word == "PROPERTY")
        inMember_ = true;
      else if (std::ranges::find(kSections, std::string_view(word)) != kSections.end())
        readVariables(word);
      else if (word == "TYPE")
        readTypes();
    }
  }

private:
  [[nodiscard]] bool atEnd() const { return at_ >= words_.size(); }
  [[nodiscard]] std::string upper() const {
    return atEnd() || words_[at_].kind == Word::Kind::Literal ? std::string()
                                                              : upperCase(words_[at_].text);
  }
  [[nodiscard]] bool is(std::string_view text) const { return upper() == text; }

  void skipQualifiers() {
    while (std::ranges::find(kQualifiers, std::string_view(upper())) != kQualifiers.end())
      ++at_;
  }

  void beginPou(const std::string &word) {
    skipQualifiers();
    if (atEnd() || words_[at_].kind != Word::Kind::Name)
      return;
    Interface made;
    made.name = words_[at_++].text;
    made.kind = word == "PROGRAM"    ? Interface::Kind::Program
                : word == "FUNCTION" ? Interface::Kind::Function
                                     : Interface::Kind::FunctionBlock;
    if (made.kind == Interface::Kind::Function && is(":")) {
      ++at_;
      made.returnType = typeText({"VAR", "VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT"});
      if (entered_)
        scope_.locals_[lowerCase(made.name)] = made.returnType;
    }
    if (entered_)
      scope_.inFunction_ = made.kind == Interface::Kind::Function;
    const std::string key = lowerCase(made.name);
    scope_.taken_.insert(key);
    inMember_ = false;
    pou_ = &(scope_.interfaces_[key] = std::move(made));
  }

  /// A type until `;`, `:=` or one of `ends`.
  std::string typeText(const std::vector<std::string_view> &ends = {}) {
    std::string text;
    while (!atEnd() && !is(";") && !is(":=") && !is("END_VAR") && !is("END_STRUCT") &&
           std::ranges::find(ends, std::string_view(upper())) == ends.end()) {
      if (!text.empty() && words_[at_].kind == Word::Kind::Name &&
          (words_[at_ - 1].kind == Word::Kind::Name || words_[at_ - 1].text == "]"))
        text += ' ';
      text += words_[at_++].text;
    }
    return text;
  }

  void skipInitialValue() {
    int depth = 0;
    while (!atEnd() && !(depth == 0 && is(";")) && !is("END_VAR") && !is("END_STRUCT") &&
           !is("END_TYPE")) {
      depth += is("(") || is("[") ? 1 : 0;
      depth -= is(")") || is("]") ? 1 : 0;
      ++at_;
    }
    if (is(";"))
      ++at_;
  }

  /// `a, b AT %IX0.0 : INT := 5;`
  template <typename Take> void readDeclaration(Take take) {
    std::vector<std::string> names;
    while (!atEnd() && !is(":") && !is(";") && !is("END_VAR") && !is("END_STRUCT")) {
      if (words_[at_].kind == Word::Kind::Name && !is("AT") && words_[at_].text.front() != '%')
        names.push_back(words_[at_].text);
      ++at_;
    }
    if (is(":")) {
      ++at_;
      const std::string type = typeText();
      for (const std::string &name : names)
        take(Declared{name, type});
    }
    skipInitialValue();
  }

  void readVariables(const std::string &section) {
    skipQualifiers();
    while (!atEnd() && !is("END_VAR"))
      readDeclaration([&](const Declared &each) { addVariable(section, each); });
    ++at_;
  }

  void addVariable(const std::string &section, const Declared &each) {
    const std::string key = lowerCase(each.name);
    if (entered_)
      scope_.locals_[key] = each.type;
    if (section == "VAR_GLOBAL")
      scope_.globals_[key] = each.type;
    if (section == "VAR_GLOBAL")
      scope_.taken_.insert(key);
    if (entered_)
      scope_.localTaken_.insert(key);
    if (pou_ == nullptr || inMember_)
      return;
    if (section == "VAR_INPUT")
      pou_->inputs.push_back(each);
    else if (section == "VAR_OUTPUT")
      pou_->outputs.push_back(each);
    else if (section == "VAR_IN_OUT")
      pou_->inOuts.push_back(each);
    scope_.structures_[lowerCase(pou_->name)][key] = each.type;
  }

  void readTypes() {
    while (!atEnd() && !is("END_TYPE")) {
      const std::string name = words_[at_++].text;
      if (!is(":"))
        continue;
      ++at_;
      const std::string key = lowerCase(name);
      scope_.taken_.insert(key);
      if (is("STRUCT") || is("UNION")) {
        ++at_;
        while (!atEnd() && !is("END_STRUCT") && !is("END_UNION") && !is("END_TYPE"))
          readDeclaration([&](const Declared &each) {
            scope_.structures_[key][lowerCase(each.name)] = each.type;
          });
        if (!is("END_TYPE"))
          ++at_;
        continue;
      }
      const bool enumeration = is("(");
      const std::string type = typeText();
      if (!enumeration)
        scope_.aliases_[key] = type;
      while (!atEnd() && !is(";") && !is("END_TYPE"))
        ++at_;
      if (is(";"))
        ++at_;
    }
  }

  std::vector<Word> words_;
  Scope &scope_;
  bool entered_;
  size_t at_ = 0;
  Interface *pou_ = nullptr;
  bool inMember_ = false; ///< of a method, whose variables are not the block's
};

void Scope::declare(std::string_view text) { DeclarationReader(text, *this, false).read(); }

void Scope::enter(std::string_view text) {
  locals_.clear();
  localTaken_.clear();
  number_.clear();
  inFunction_ = false;
  DeclarationReader(text, *this, true).read();
}

const Interface *Scope::interfaceOf(std::string_view type) const {
  std::string key = lowerCase(trim(type));
  const auto found = interfaces_.find(key);
  if (found != interfaces_.end())
    return &found->second;
  const size_t dot = key.rfind('.'); // a library's namespace
  return dot == std::string::npos ? nullptr : interfaceOf(std::string_view(key).substr(dot + 1));
}

std::string Scope::memberType(const std::string &type, const std::string &member) const {
  std::string key = lowerCase(type);
  for (int followed = 0; followed < kAliasesFollowed; ++followed) {
    const auto structure = structures_.find(key);
    if (structure != structures_.end()) {
      const auto found = structure->second.find(lowerCase(member));
      return found == structure->second.end() ? std::string() : found->second;
    }
    const auto alias = aliases_.find(key);
    if (alias == aliases_.end())
      break;
    key = lowerCase(alias->second);
  }
  const bool bit = !member.empty() && member.front() >= '0' && member.front() <= '9';
  return bit ? "BOOL" : std::string();
}

std::string Scope::elementType(const std::string &type) const {
  std::string_view name = type;
  for (int followed = 0; followed < kAliasesFollowed; ++followed) {
    const std::string upper = upperCase(name);
    const size_t of = upper.find("OF ");
    if (upper.starts_with("ARRAY") && of != std::string::npos)
      return std::string(trim(name.substr(of + 3)));
    const auto alias = aliases_.find(lowerCase(name));
    if (alias == aliases_.end())
      break;
    name = alias->second;
  }
  return {};
}

std::string Scope::typeOf(std::string_view path) const {
  const std::vector<Word> words = wordsOf(path);
  if (words.empty() || words.front().kind != Word::Kind::Name)
    return {};
  const std::string first = lowerCase(words.front().text);
  if (first.starts_with("%")) {
    const char size = first.size() > 2 ? first[2] : 'x';
    return size == 'b' ? "BYTE" : size == 'w' ? "WORD" : size == 'd' ? "DWORD" : "BOOL";
  }
  std::string type;
  if (const auto local = locals_.find(first); local != locals_.end())
    type = local->second;
  else if (const auto global = globals_.find(first); global != globals_.end())
    type = global->second;
  else if (interfaces_.contains(first))
    type = interfaces_.at(first).name; // a program
  for (size_t i = 1; i < words.size() && !type.empty(); ++i) {
    if (words[i].text == "." && i + 1 < words.size()) {
      type = memberType(type, words[++i].text);
    } else if (words[i].text == "[") {
      int depth = 1;
      while (++i < words.size() && depth > 0) {
        depth += words[i].text == "[" ? 1 : 0;
        depth -= words[i].text == "]" ? 1 : 0;
        if (depth == 0)
          break;
      }
      type = elementType(type);
    } else {
      return {};
    }
  }
  return type;
}

std::string Scope::freshName(std::string_view wish) {
  std::string base;
  for (const char c : wish)
    base += (c >= '0' && c <= '9') || (lowerCase(c) >= 'a' && lowerCase(c) <= 'z') || c == '_'
                ? c
                : '_';
  if (base.empty() || (base.front() >= '0' && base.front() <= '9'))
    base.insert(0, "v_");
  std::string name = base;
  const auto taken = [&](const std::string &each) {
    const std::string key = lowerCase(each);
    return taken_.contains(key) || localTaken_.contains(key) ||
           std::ranges::find(kReserved, std::string_view(key)) != kReserved.end();
  };
  for (int &number = number_[lowerCase(base)]; taken(name); ++number)
    name = fmt::format("{}_{}", base, number + 2);
  localTaken_.insert(lowerCase(name));
  return name;
}

} // namespace stc::import::networks
