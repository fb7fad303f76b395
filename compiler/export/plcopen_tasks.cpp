// Tasks and global variables as PLCopen XML.
#include "compiler/export/plcopen_parts.hpp"

#include <array>

#include <fmt/format.h>

namespace stc::exporting {

using namespace ast;

namespace {

/// `PT0.0025S`
std::string xmlDuration(int64_t nanoseconds) {
  std::string digits = fmt::format("{:09}", nanoseconds % 1'000'000'000);
  while (!digits.empty() && digits.back() == '0')
    digits.pop_back();
  return fmt::format("PT{}{}{}S", nanoseconds / 1'000'000'000, digits.empty() ? "" : ".", digits);
}

const char *kindOf(TaskStart start) {
  switch (start) {
  case TaskStart::Freewheeling:
    return "Freewheeling";
  case TaskStart::Event:
    return "Event";
  case TaskStart::Status:
    return "Status";
  case TaskStart::Cyclic:
    break;
  }
  return "Cyclic";
}

/// Programs that Stride makes for `programs = ["Main.Step"]`: the task's name, the program's and
/// the action's, with `__` between them.
std::string calledBy(const TaskConfig &task, const std::string &program) {
  constexpr std::string_view kEnd = "__call";
  const std::string begin = task.name.text + "__";
  if (!program.starts_with(begin) || !program.ends_with(kEnd))
    return program;
  std::string name = program.substr(begin.size(), program.size() - begin.size() - kEnd.size());
  if (const size_t middle = name.find("__"); middle != std::string::npos)
    name.replace(middle, 2, ".");
  return name;
}

} // namespace

void Writer::tasks(Node resource) const {
  for (const TaskConfig &task : project_.config().tasks) {
    Node node = resource.append_child("task");
    node.append_attribute("name") = task.name.text.c_str();
    if (!task.event.text.empty())
      node.append_attribute("single") = task.event.text.c_str();
    else if (task.start == TaskStart::Cyclic && task.intervalNs != 0)
      node.append_attribute("interval") = xmlDuration(task.intervalNs).c_str();
    node.append_attribute("priority") = task.priority;
    for (const ConfigName &program : task.programs) {
      Node instance = node.append_child("pouInstance");
      const std::string name = calledBy(task, program.text);
      instance.append_attribute("name") = name.c_str();
      instance.append_attribute("typeName") = name.c_str();
    }
    Node settings = addData(node, kCodesys, "tasksettings").append_child("TaskSettings");
    settings.append_attribute("KindOfTask") = kindOf(task.start);
    if (!task.event.text.empty())
      settings.append_attribute("Event") = task.event.text.c_str();
    if (task.intervalNs != 0 && task.event.text.empty()) {
      settings.append_attribute("Interval") = task.intervalNs / 1000;
      settings.append_attribute("IntervalUnit") = "us";
    }
    if (task.watchdogNs != 0) {
      Node watchdog = settings.append_child("Watchdog");
      watchdog.append_attribute("Enabled") = "true";
      watchdog.append_attribute("Time") = task.watchdogNs / 1000;
      watchdog.append_attribute("TimeUnit") = "us";
      watchdog.append_attribute("Sensitivity") = task.watchdogSensitivity;
    }
  }
}

void Writer::globals(Node resource, const std::string &name,
                     const std::vector<const GlobalsDecl *> &blocks, const DeclarationTexts &texts,
                     bool whole) const {
  Node list = resource.append_child("globalVars");
  const auto fill = [&](Node node, const GlobalsDecl &block) {
    node.append_attribute("name") = name.c_str();
    if (!block.variables.empty())
      setQualifiers(node, block.variables.front()->qualifiers);
    for (const VarDecl *each : block.variables)
      variable(node, *each);
  };
  fill(list, *blocks.front());
  if (blocks.size() > 1) {
    Node mixed = addData(list, kCodesys, "mixedattrsvarlist").append_child("MixedAttrsVarList");
    for (const GlobalsDecl *each : blocks)
      fill(mixed.append_child("globalVars"), *each);
  }
  addAttributes(list, blocks.front()->attributes);
  if (whole) {
    addData(list, kStride, "insource").append_child("InSource");
    return;
  }
  std::string plain;
  for (const GlobalsDecl *each : blocks) {
    const DeclarationText &text = texts.at(each);
    plain += (plain.empty() ? "" : "\n") + trimmedLines(text.leading) +
             trimmedLines(text.declaration) + trimmedLines(text.tail);
  }
  addPlainDeclaration(list, plain);
}

} // namespace stc::exporting
