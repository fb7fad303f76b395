#ifndef STRIDE_TESTS_PROPERTY_NETWORKS_INTERPRETER_HPP
#define STRIDE_TESTS_PROPERTY_NETWORKS_INTERPRETER_HPP
// A small interpreter of the Structured Text that drawings become, on truth values.

#include <algorithm>
#include <map>
#include <rapidcheck.h>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace stc::import::networks {

using Store = std::map<std::string, bool>; ///< variables and members of instances

/// What the blocks of the standard library do.
inline void callBlock(Store &store, const std::string &name, const std::string &type, bool first,
                      bool second) {
  bool &memory = store[name + ".M"];
  if (type == "R_TRIG") {
    store[name + ".Q"] = first && !memory;
    memory = first;
  } else if (type == "F_TRIG") {
    store[name + ".Q"] = !first && memory;
    memory = first;
  } else { // SR
    memory = first || (memory && !second);
    store[name + ".Q1"] = memory;
  }
}

/// Executes statements on truth values.
class Interpreter {
public:
  Interpreter(const std::string &statements, std::map<std::string, std::string> instances)
      : instances_(std::move(instances)) {
    std::istringstream stream(statements);
    for (std::string line; std::getline(stream, line);) {
      const size_t begin = line.find_first_not_of(' ');
      if (begin != std::string::npos && line.compare(begin, 2, "//") != 0)
        lines_.push_back(line.substr(begin));
    }
  }

  void run(Store &store) {
    store_ = &store;
    size_t steps = 0;
    for (size_t at = 0; at < lines_.size();) {
      RC_ASSERT(++steps < 10000);
      const std::string &line = lines_[at++];
      if (line == "RETURN;")
        return;
      if (line.starts_with("JMP "))
        at = labelled(line.substr(4, line.size() - 5));
      else if (line.starts_with("IF "))
        at = truth(line.substr(3, line.size() - 8)) ? at : afterIf(at);
      else if (line != "END_IF" && line.back() != ':')
        statement(line.substr(0, line.size() - 1));
    }
  }

private:
  size_t labelled(const std::string &name) const {
    const auto found = std::find(lines_.begin(), lines_.end(), name + ":");
    RC_ASSERT(found != lines_.end());
    return static_cast<size_t>(found - lines_.begin());
  }

  size_t afterIf(size_t at) const {
    for (int depth = 1; depth != 0; ++at)
      depth += lines_.at(at).starts_with("IF ") ? 1 : lines_.at(at) == "END_IF" ? -1 : 0;
    return at;
  }

  void statement(const std::string &text) {
    for (const std::string symbol : {" := ", " S= ", " R= "})
      if (const size_t at = text.find(symbol); at != std::string::npos && at < text.find('(')) {
        const std::string target = text.substr(0, at);
        const bool value = truth(text.substr(at + symbol.size()));
        if (symbol == " := ")
          (*store_)[target] = value;
        else if (value)
          (*store_)[target] = symbol == " S= ";
        return;
      }
    call(text);
  }

  /// `name(A := …, B := …)`
  void call(const std::string &text) {
    const size_t open = text.find('(');
    const std::string name = text.substr(0, open);
    std::vector<bool> values;
    std::string rest = text.substr(open + 1, text.size() - open - 2);
    while (!rest.empty()) {
      const size_t comma = std::min(rest.find(", "), rest.size());
      const std::string argument = rest.substr(0, comma);
      values.push_back(truth(argument.substr(argument.find(":=") + 3)));
      rest = rest.substr(std::min(comma + 2, rest.size()));
    }
    RC_ASSERT(instances_.contains(name));
    callBlock(*store_, name, instances_.at(name), values.at(0), values.size() > 1 && values[1]);
  }

  bool truth(const std::string &text) {
    text_ = text;
    at_ = 0;
    const bool value = alternatives();
    RC_ASSERT(at_ == text_.size());
    return value;
  }

  bool accept(const std::string &word) {
    if (text_.compare(at_, word.size(), word) != 0)
      return false;
    at_ += word.size();
    return true;
  }
  bool alternatives() {
    bool value = exclusive();
    while (accept(" OR "))
      value = static_cast<int>(exclusive()) + static_cast<int>(value) > 0;
    return value;
  }
  bool exclusive() {
    bool value = series();
    while (accept(" XOR "))
      value = series() != value;
    return value;
  }
  bool series() {
    bool value = single();
    while (accept(" AND "))
      value = static_cast<int>(single()) + static_cast<int>(value) == 2;
    return value;
  }
  bool single() {
    if (accept("NOT "))
      return !single();
    if (accept("(")) {
      const bool value = alternatives();
      RC_ASSERT(accept(")"));
      return value;
    }
    const size_t end = std::min(text_.find_first_of(" ()", at_), text_.size());
    const std::string name = text_.substr(at_, end - at_);
    at_ = end;
    RC_ASSERT(!name.empty());
    return name == "TRUE" || (name != "FALSE" && (*store_)[name]);
  }

  std::map<std::string, std::string> instances_;
  std::vector<std::string> lines_;
  Store *store_ = nullptr;
  std::string text_;
  size_t at_ = 0;
};

/// Instances that the translation declares: `name : R_TRIG;`
inline std::map<std::string, std::string> declaredInstances(const std::string &declarations) {
  std::map<std::string, std::string> result;
  std::istringstream stream(declarations);
  for (std::string name, colon, type; stream >> name;)
    if (name != "VAR" && name != "END_VAR") {
      stream >> colon >> type;
      result[name] = type.substr(0, type.size() - 1);
    }
  return result;
}

} // namespace stc::import::networks

#endif // STRIDE_TESTS_PROPERTY_NETWORKS_INTERPRETER_HPP
