#include "compiler/import/drawn_bodies.hpp"

#include "compiler/import/st_words.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>
#include <vector>

#include <fmt/format.h>

namespace stc::import {

namespace {

using networks::Problem;
using networks::Scope;
using networks::Translation;

constexpr std::string_view kMark = "{drawn body ";

/// The line with the offset.
size_t lineBegin(std::string_view text, size_t at) {
  const size_t end = text.rfind('\n', at == 0 ? 0 : at - 1);
  return end == std::string_view::npos || at == 0 ? 0 : end + 1;
}

bool isWord(std::string_view text, const StWord &word, std::string_view other) {
  return equalIgnoringCase(text.substr(word.begin, word.end - word.begin), other);
}

/// Before the line after the last END_VAR in front of an offset; without one before the offset.
size_t afterVariables(std::string_view text, size_t before) {
  size_t place = before;
  for (const StWord &word : wordsOf(text.substr(0, before)))
    if (isWord(text, word, "END_VAR"))
      place = std::min(text.find('\n', word.end), before - 1) + 1;
  return place;
}

/// The part of a POU that a place is in.
struct Part {
  enum class Kind { Pou, Action, Method };
  Kind kind = Kind::Pou;
  size_t body = 0;  ///< after its first line
  size_t pou = 0;   ///< after the POU's first line
  size_t first = 0; ///< where the POU's first member begins
};

/// The words that begin lines and are followed by no sign: `set := x` is a statement.
std::vector<StWord> lineBeginnings(std::string_view text) {
  std::vector<StWord> found;
  const std::vector<StWord> words = wordsOf(text);
  for (size_t i = 0; i < words.size(); ++i) {
    const size_t before = i == 0 ? 0 : words[i - 1].end;
    const bool begins =
        i == 0 || text.substr(before, words[i].begin - before).find('\n') != std::string_view::npos;
    const bool sign = i + 1 < words.size() && words[i + 1].kind == StWord::Kind::Sign;
    if (begins && !sign && words[i].kind == StWord::Kind::Name)
      found.push_back(words[i]);
  }
  return found;
}

Part partAt(std::string_view text, size_t mark) {
  Part part;
  part.first = mark;
  for (const StWord &word : lineBeginnings(text.substr(0, mark))) {
    const auto isAny = [&](std::initializer_list<std::string_view> others) {
      return std::any_of(others.begin(), others.end(),
                         [&](std::string_view other) { return isWord(text, word, other); });
    };
    const size_t next = std::min(text.find('\n', word.end), text.size() - 1) + 1;
    if (part.pou == 0 && isAny({"PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "CLASS"}))
      part.pou = part.body = next;
    const bool action = isAny({"ACTION", "TRANSITION"});
    if (action || isAny({"METHOD", "PROPERTY", "GET", "SET"})) {
      part.kind = action ? Part::Kind::Action : Part::Kind::Method;
      part.body = next;
      part.first = std::min(part.first, lineBegin(text, word.begin));
    } else if (isAny({"END_ACTION", "END_METHOD", "END_PROPERTY", "END_TRANSITION"})) {
      part.kind = Part::Kind::Pou;
    }
  }
  return part;
}

/// A method's variables do not keep their values unless they say so; an action has none.
void declare(std::string &text, size_t mark, std::string declarations) {
  if (declarations.empty())
    return;
  const Part part = partAt(text, mark);
  if (part.kind == Part::Kind::Action) {
    const size_t place = afterVariables(text, part.first);
    text.insert(place == part.first || place < part.pou ? part.pou : place, declarations);
    return;
  }
  if (part.kind == Part::Kind::Method)
    declarations.insert(3, "_INST"); // after VAR
  const size_t place = afterVariables(text, mark);
  text.insert(place < part.body ? mark : place, declarations);
}

/// Indents statements as the mark is.
std::string indented(const std::string &statements, std::string_view indent) {
  std::string result;
  for (size_t at = 0; at < statements.size();) {
    const size_t end = std::min(statements.find('\n', at), statements.size() - 1) + 1;
    if (end - at > 1)
      result += indent;
    result += statements.substr(at, end - at);
    at = end;
  }
  return result;
}

class Replacement {
public:
  Replacement(Model &model, Scope libraries) : model_(model), scope_(std::move(libraries)) {
    for (size_t i = 0; i < model.objects.size(); ++i) {
      const std::string &text = model.objects[i].text;
      scope_.declare(text);
      for (size_t at = text.find(kMark); at != std::string::npos; at = text.find(kMark, at + 1))
        places_.emplace(text.substr(at, text.find('}', at) - at + 1), i);
    }
  }

  void replace(const DrawnBody &drawn) {
    const auto place = places_.find(drawn.mark);
    if (place == places_.end())
      return;
    Object &object = model_.objects[place->second];
    if (const size_t at = object.text.find(drawn.mark); at != std::string::npos)
      replaceIn(object, at, drawn);
  }

private:
  void replaceIn(Object &object, size_t at, const DrawnBody &drawn) {
    scope_.enter(object.text);
    const Translation result = drawn.translate(scope_);
    std::string &text = object.text;
    const size_t begin = lineBegin(text, at);
    const std::string indent = text.substr(begin, at - begin);
    const size_t length = drawn.mark.size() + at - begin;
    for (const Problem &note : result.notes)
      model_.changed.push_back({{drawn.origin.file, note.line}, drawn.object, note.text});
    if (!result.ok()) {
      for (const Problem &problem : result.problems)
        model_.leftOut.push_back(
            {{drawn.origin.file, problem.line},
             drawn.object,
             fmt::format("its body is drawn ({}) and not imported: {}{}", drawn.kind, problem.text,
                         drawn.kept.path.empty() ? "" : "; its text is kept")});
      if (!drawn.kept.path.empty())
        model_.kept.push_back(drawn.kept);
      text.replace(begin, length,
                   fmt::format("{}{{error 'body not imported: {}'}}", indent, drawn.kind));
      return;
    }
    model_.changed.push_back(
        {drawn.origin, drawn.object,
         fmt::format("its body was drawn ({}): translated into ST", drawn.kind)});
    std::string statements = indented(result.statements, indent);
    if (!statements.empty()) // the mark's own line ends with \n
      statements.pop_back();
    text.replace(begin, length, statements);
    declare(text, begin, result.declarations);
  }

  Model &model_;
  Scope scope_;
  std::map<std::string, size_t> places_; ///< of marks in the model's objects
};

} // namespace

std::string markDrawnBody(Model &model, Origin origin, std::string object, std::string kind,
                          DrawnTranslator translate, KeptText kept) {
  const std::string mark = fmt::format("{}{}}}", kMark, model.drawn.size() + 1);
  model.drawn.push_back({std::move(origin), std::move(object), std::move(kind), mark,
                         std::move(translate), std::move(kept)});
  return mark + "\n";
}

void translateDrawnBodies(Model &model, std::span<const std::string_view> libraries) {
  if (model.drawn.empty())
    return;
  Scope scope;
  for (const std::string_view text : libraries)
    scope.declare(text);
  Replacement replacement(model, std::move(scope));
  for (const DrawnBody &each : model.drawn)
    replacement.replace(each);
  model.drawn.clear();
}

} // namespace stc::import
