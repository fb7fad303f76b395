#include "compiler/import/plcopen_conditions.hpp"

#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/networks/plcopen_networks.hpp"
#include "compiler/import/networks/print.hpp"
#include "compiler/source/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <utility>

#include <fmt/format.h>

namespace stc::import::plcopen {

using stride::common::lowerCase;

namespace {

/// What other elements an element's lines come from.
void collectSources(const Node &node, std::vector<std::string> &ids) {
  for (const Node &each : children(node))
    if (localName(each) == "connection")
      ids.push_back(attribute(each, "refLocalId"));
    else
      collectSources(each, ids);
}

void addPrefix(Node node, const std::string &prefix) {
  for (const char *name : {"localId", "refLocalId"})
    if (pugi::xml_attribute id = node.attribute(name))
      id = (prefix + id.value()).c_str();
  for (Node each : node.children())
    addPrefix(each, prefix);
}

/// The element in which an output names its variable; null: it is no output.
Node targetOf(const Node &element) {
  const std::string_view kind = localName(element);
  return kind == "outVariable" ? child(element, "expression")
         : kind == "coil"      ? child(element, "variable")
                               : Node();
}

/// `name := x;` alone: x; empty: it is more.
std::string onlyValue(const networks::Translation &translation, const std::string &name) {
  std::string_view text = translation.statements;
  const std::string begin = name + " := ";
  if (!translation.ok() || !translation.declarations.empty() || !text.starts_with(begin) ||
      !text.ends_with(";\n") || text.find('\n') + 1 != text.size())
    return {};
  text.remove_prefix(begin.size());
  text.remove_suffix(2);
  return std::string(text);
}

} // namespace

void DrawnConditions::readNames(const Node &node) {
  for (const pugi::xml_attribute &each : node.attributes())
    names_.insert(lowerCase(each.value()));
  for (const Node &each : node.children()) {
    const std::string_view text = each.value();
    for (const StWord &word : wordsOf(text))
      names_.insert(lowerCase(text.substr(word.begin, word.end - word.begin)));
    readNames(each);
  }
}

std::string DrawnConditions::freshName(const std::string &wish) {
  if (names_.empty())
    readNames(pou_);
  std::string name = wish;
  for (size_t number = 1; !names_.insert(lowerCase(name)).second; ++number)
    name = fmt::format("{}_{}", wish, number);
  return name;
}

void DrawnConditions::copy(const Drawing &drawing, const std::string &target, Node into,
                           std::set<std::string> &known) const {
  for (const Node &each : drawing.elements) {
    if (!known.insert(drawing.prefix + attribute(each, "localId")).second)
      continue;
    Node copied = into.append_copy(each);
    addPrefix(copied, drawing.prefix);
    if (each == drawing.output)
      targetOf(copied).text() = target.c_str();
  }
  if (drawing.output)
    return;
  Node output = into.append_child("outVariable");
  output.append_attribute("localId") = ("condition " + target).c_str();
  output.append_copy(child(drawing.transition, "position"));
  for (const Node &each : children(drawing.condition, "connectionPointIn"))
    output.append_copy(each);
  for (Node each : output.children())
    addPrefix(each, drawing.prefix);
  if (isTrue(drawing.condition, "negated"))
    output.append_attribute("negated") = "true";
  output.append_child("expression").text() = target.c_str();
}

std::string DrawnConditions::valueOf(const Drawing &drawing) {
  const size_t line = context_.originOf(drawing.transition).line;
  const std::string name = freshName(fmt::format("Condition{}", results_.size() + 1));
  pugi::xml_document trial;
  Node body = trial.append_child("body");
  std::set<std::string> known;
  copy(drawing, name, body.append_child("FBD"), known);
  std::vector<networks::Problem> problems;
  networks::Body content = networks::readPlcOpenBody(
      body, [&](const Node &) { return line; }, problems);
  networks::Scope none;
  if (problems.empty())
    if (std::string value = onlyValue(networks::translated(std::move(content), none), name);
        !value.empty()) {
      names_.erase(lowerCase(name));
      return value;
    }
  if (!all_.first_child())
    all_.append_child("body").append_child("FBD");
  for (const Node &each : drawing.elements)
    lines_.emplace(drawing.prefix + attribute(each, "localId"), context_.originOf(each).line);
  lines_.emplace("condition " + name, line);
  copy(drawing, name, all_.first_child().first_child(), known_);
  results_.push_back(name);
  return name;
}

std::string DrawnConditions::ofLines(const Node &transition, const Node &condition,
                                     const ChartElements &elements) {
  Drawing drawing;
  drawing.condition = condition;
  drawing.transition = transition;
  std::vector<std::string> open;
  collectSources(condition, open);
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string id = open.back();
    open.pop_back();
    const auto found = elements.find(id);
    if (!seen.insert(id).second || found == elements.end())
      continue;
    drawing.elements.push_back(found->second);
    collectSources(found->second, open);
  }
  return valueOf(drawing);
}

std::string DrawnConditions::ofBody(const Node &body, const Node &transition,
                                    std::string_view name) {
  Drawing drawing;
  drawing.transition = transition;
  drawing.prefix = fmt::format("{}.", ++drawings_);
  drawing.elements = children(networks::drawingIn(body));
  for (const Node &each : drawing.elements)
    if (const Node target = targetOf(each); target && sameName(trimmed(textOf(target)), name))
      drawing.output = each;
  return drawing.output ? valueOf(drawing) : std::string();
}

std::string DrawnConditions::finish(std::string &members) {
  if (results_.empty())
    return {};
  const std::string name = freshName("Conditions");
  std::vector<networks::Problem> problems;
  const auto lineOf = [this](Node node) {
    for (; node; node = node.parent())
      if (const auto found = lines_.find(attribute(node, "localId")); found != lines_.end())
        return found->second;
    return context_.originOf(pou_).line;
  };
  networks::Body content = networks::readPlcOpenBody(all_.first_child(), lineOf, problems);
  std::string variables = "VAR\n";
  for (const std::string &each : results_)
    variables += fmt::format("  {} : BOOL;\n", each);
  DrawnTranslator translate = [content = std::move(content), problems = std::move(problems),
                               variables](networks::Scope &scope) {
    networks::Translation result;
    result.problems = problems;
    if (problems.empty())
      result = networks::translated(content, scope);
    result.declarations =
        variables + (result.declarations.empty() ? "END_VAR\n" : result.declarations.substr(4));
    return result;
  };
  context_.changed(pou_, object_,
                   fmt::format("its action {} computes in each cycle the conditions that are drawn "
                               "with blocks; the transitions read the results in the next one",
                               name));
  members += fmt::format("\nACTION {}:\n{}END_ACTION\n", name,
                         markDrawnBody(context_.model(), context_.originOf(pou_),
                                       object_ + "." + name, "FBD", std::move(translate)));
  return name;
}

} // namespace stc::import::plcopen
