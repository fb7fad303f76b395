#include "compiler/import/drawn_bodies.hpp"

#include "compiler/import/exp_lines.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stc::import {

namespace {

using networks::Problem;
using networks::Scope;
using networks::Translation;

/// The line with the offset.
size_t lineBegin(std::string_view text, size_t at) {
  const size_t end = text.rfind('\n', at == 0 ? 0 : at - 1);
  return end == std::string_view::npos || at == 0 ? 0 : end + 1;
}

bool isWordAt(std::string_view text, size_t at, std::string_view word) {
  const auto letter = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  const size_t end = at + word.size();
  return (at == 0 || !letter(text[at - 1])) && (end == text.size() || !letter(text[end]));
}

/// Before the line after the last END_VAR in front of an offset; without one before the offset.
size_t afterVariables(std::string_view text, size_t before) {
  constexpr std::string_view kEnd = "END_VAR";
  for (size_t at = text.rfind(kEnd, before); at != std::string_view::npos && at != 0;
       at = text.rfind(kEnd, at - 1))
    if (isWordAt(text, at, kEnd)) {
      const size_t end = text.find('\n', at);
      return end == std::string_view::npos ? before : std::min(end + 1, before);
    }
  return before;
}

/// The part of a POU that a place is in.
struct Part {
  enum class Kind { Pou, Action, Method };
  Kind kind = Kind::Pou;
  size_t body = 0;  ///< after its first line
  size_t pou = 0;   ///< after the POU's first line
  size_t first = 0; ///< where the POU's first member begins
};

Part partAt(std::string_view text, size_t mark) {
  Part part;
  part.first = mark;
  for (size_t at = 0; at < mark;) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(text.substr(at, end - at));
    const std::string_view word = firstWord(line);
    const size_t next = std::min(end + 1, text.size());
    if (part.pou == 0 && (word == "PROGRAM" || word == "FUNCTION" || word == "FUNCTION_BLOCK"))
      part.pou = part.body = next;
    const bool action = word == "ACTION" || word == "TRANSITION";
    if (action || word == "METHOD" || word == "PROPERTY" || word == "GET" || word == "SET") {
      part.kind = action ? Part::Kind::Action : Part::Kind::Method;
      part.body = next;
      part.first = std::min(part.first, at);
    } else if (word == "END_ACTION" || word == "END_METHOD" || word == "END_PROPERTY" ||
               word == "END_TRANSITION") {
      part.kind = Part::Kind::Pou;
    }
    at = next;
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
  Replacement(Model &model, const Scope &libraries) : model_(model), scope_(libraries) {
    for (const Object &each : model.objects)
      scope_.declare(each.text);
  }

  void replace(const DrawnBody &drawn) {
    for (Object &object : model_.objects)
      if (const size_t at = object.text.find(drawn.mark); at != std::string::npos)
        return replaceIn(object, at, drawn);
  }

private:
  void replaceIn(Object &object, size_t at, const DrawnBody &drawn) {
    Scope scope = scope_;
    scope.enter(object.text);
    const Translation result = drawn.translate(scope);
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
             fmt::format("its body is drawn ({}) and not imported: {}", drawn.kind, problem.text)});
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
};

} // namespace

std::string markDrawnBody(Model &model, Origin origin, std::string object, std::string kind,
                          DrawnTranslator translate, KeptText kept) {
  const std::string mark = fmt::format("{{drawn body {}}}", model.drawn.size() + 1);
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
  Replacement replacement(model, scope);
  for (const DrawnBody &each : model.drawn)
    replacement.replace(each);
  model.drawn.clear();
}

} // namespace stc::import
