// Configurations, resources and tasks of PLCopen XML. Where programs have instances with names of
// their own they become a CONFIGURATION, otherwise tasks of stride.toml.
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/plcopen_context.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

constexpr int kLowestPriority = 31;

struct Instance {
  std::string name;
  std::string type; ///< empty: the program called `name`
  std::string documentation;
};

struct ResourceTask {
  Node node;
  Task task;
  std::string single; ///< attribute of the standard: a variable that starts it
  std::vector<Instance> instances;
};

struct Resource {
  std::string name;
  std::vector<ResourceTask> tasks;
  std::vector<Instance> withoutTask;
};

Instance instanceOf(const Node &node) {
  return {attribute(node, "name"), attribute(node, "typeName"), documentationLines(node, "    ")};
}

std::string unitOf(const std::string &unit) { return unit.empty() ? "ms" : unit; }

/// `0.05S`, `1M30S`, in ns; nothing: it is none.
std::optional<double> xmlDuration(const char *at) {
  double nanoseconds = 0;
  while (*at != '\0') {
    char *end = nullptr;
    const double value = std::strtod(at, &end);
    const double scale = *end == 'H' ? 3.6e12 : *end == 'M' ? 6e10 : *end == 'S' ? 1e9 : 0;
    if (end == at || scale == 0 || !(value >= 0))
      return std::nullopt;
    nanoseconds += value * scale;
    at = end + 1;
  }
  return nanoseconds;
}

/// In ns; nothing: the text is no number.
std::optional<double> numberWithUnit(const std::string &text, const std::string &unit) {
  const bool number = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || c == '.';
  });
  if (!number)
    return std::nullopt;
  constexpr std::array<std::pair<std::string_view, double>, 7> kScales = {{{"s", 1e9},
                                                                           {"ms", 1e6},
                                                                           {"us", 1e3},
                                                                           {"\xc2\xb5s", 1e3},
                                                                           {"\xce\xbcs", 1e3},
                                                                           {"\xc2\xb5", 1e3},
                                                                           {"ns", 1}}};
  for (const auto &[name, scale] : kScales)
    if (unit == name)
      return std::strtod(text.c_str(), nullptr) * scale;
  return std::nullopt;
}

/// 0 and nothing are 1.
unsigned sensitivityOf(Context &context, const Node &watchdog, const std::string &object) {
  constexpr unsigned long kMost = 1000;
  const std::string text = attribute(watchdog, "Sensitivity");
  const bool number =
      std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!number) {
    context.leftOut(watchdog, object,
                    fmt::format("the sensitivity `{}` of its watchdog is no number", text));
    return 1;
  }
  const unsigned long value = std::strtoul(text.c_str(), nullptr, 10);
  if (value > kMost)
    context.changed(
        watchdog, object,
        fmt::format("the sensitivity {} of its watchdog became {}, the highest", text, kMost));
  return static_cast<unsigned>(std::clamp(value, 1UL, kMost));
}

/// The kinds of tasks that CODESYS has beside those of the standard.
void readSettings(Context &context, const Node &node, ResourceTask &task) {
  const Node settings = extra(node, "TaskSettings");
  const std::string object = "task " + task.task.name;
  const std::string kind = attribute(settings, "KindOfTask");
  const std::string interval = attribute(settings, "Interval");
  if (task.task.interval.empty() && kind == "Cyclic" && !interval.empty())
    task.task.interval = durationText(interval, unitOf(attribute(settings, "IntervalUnit")));
  if (kind == "Freewheeling")
    task.task.interval.clear();
  if (kind == "Event" || kind == "Status") {
    // Some tools say it with the attribute of the standard only.
    if (const std::string event = attribute(settings, "Event"); !event.empty())
      task.task.event = event;
    task.task.status = kind == "Status";
    task.task.interval.clear();
  }
  const bool known = kind.empty() || kind == "Cyclic" || kind == "Freewheeling";
  if (!known && task.task.event.empty())
    context.leftOut(settings, object,
                    fmt::format("it is of the kind {}; give it an `interval` or an `event` in "
                                "stride.toml",
                                kind));
  const Node watchdog = child(settings, "Watchdog");
  if (!isTrue(watchdog, "Enabled"))
    return;
  task.task.watchdog =
      durationText(attribute(watchdog, "Time"), unitOf(attribute(watchdog, "TimeUnit")));
  task.task.watchdogSensitivity = sensitivityOf(context, watchdog, object);
}

std::string priorityOf(Context &context, const Node &node, const std::string &object) {
  std::string priority = attribute(node, "priority");
  if (std::strtol(priority.c_str(), nullptr, 10) <= kLowestPriority)
    return priority;
  context.changed(node, object,
                  fmt::format("its priority {} became {}, the lowest", priority, kLowestPriority));
  return fmt::format("{}", kLowestPriority);
}

ResourceTask taskOf(Context &context, const Node &node) {
  ResourceTask task;
  task.node = node;
  task.task.name = attribute(node, "name");
  const std::string object = "task " + task.task.name;
  task.task.priority = priorityOf(context, node, object);
  task.task.interval = durationText(attribute(node, "interval"));
  task.single = attribute(node, "single");
  task.task.event = task.single;
  task.task.origin = context.originOf(node);
  context.leaveOutUnknown(node, {"pouInstance", "documentation"});
  context.leaveOutUnknownExtras(node, {"TaskSettings"});
  readSettings(context, node, task);
  for (const Node &each : children(node, "pouInstance"))
    task.instances.push_back(instanceOf(each));
  return task;
}

bool hasOwnName(const Instance &instance) {
  return !instance.type.empty() && !sameName(instance.type, instance.name);
}

/// stride.toml calls programs by their names; more takes a CONFIGURATION.
bool needsConfiguration(const std::vector<Resource> &resources) {
  return std::any_of(resources.begin(), resources.end(), [](const Resource &resource) {
    return !resource.withoutTask.empty() ||
           std::any_of(resource.tasks.begin(), resource.tasks.end(), [](const ResourceTask &task) {
             return std::any_of(task.instances.begin(), task.instances.end(), hasOwnName);
           });
  });
}

std::string instanceText(const Instance &instance, const std::string &task) {
  return fmt::format("{}    PROGRAM {}{}{};\n", instance.documentation, instance.name,
                     task.empty() ? "" : " WITH " + task,
                     instance.type.empty() ? "" : " : " + instance.type);
}

std::string resourceText(const Resource &resource) {
  std::string text = fmt::format("  RESOURCE {} ON PLC\n", resource.name);
  for (const ResourceTask &each : resource.tasks) {
    std::string arguments;
    const auto add = [&](std::string_view name, const std::string &value) {
      if (!value.empty())
        arguments += fmt::format("{}{} := {}", arguments.empty() ? "" : ", ", name, value);
    };
    add("SINGLE", each.task.event);
    add("INTERVAL", each.task.interval);
    add("PRIORITY", each.task.priority);
    text += fmt::format("    TASK {}({});\n", each.task.name, arguments);
  }
  for (const ResourceTask &task : resource.tasks)
    for (const Instance &each : task.instances)
      text += instanceText(each, task.task.name);
  for (const Instance &each : resource.withoutTask)
    text += instanceText(each, {});
  return text + "  END_RESOURCE\n";
}

/// VAR_ACCESS and VAR_CONFIG of a configuration.
std::string pathLists(Context &context, const Node &configuration) {
  std::string text;
  for (const Node &each : children(child(configuration, "accessVars"), "accessVariable"))
    text += fmt::format("    {} : {} : {}{};\n", attribute(each, "alias"),
                        attribute(each, "instancePathAndName"),
                        typeText(context, child(each, "type"), "VAR_ACCESS"),
                        attribute(each, "direction") == "readOnly"    ? " READ_ONLY"
                        : attribute(each, "direction") == "readWrite" ? " READ_WRITE"
                                                                      : "");
  if (!text.empty())
    text = "  VAR_ACCESS\n" + text + "  END_VAR\n";
  std::string config;
  for (const Node &each : children(child(configuration, "configVars"), "configVariable")) {
    const std::string address = attribute(each, "address");
    const std::string type = typeText(context, child(each, "type"), "VAR_CONFIG");
    config += fmt::format("    {}{} : {}{};\n", attribute(each, "instancePathAndName"),
                          address.empty() ? "" : " AT " + address, type,
                          initialText(context, each, type));
  }
  return config.empty() ? text : text + "  VAR_CONFIG\n" + config + "  END_VAR\n";
}

class Configurations {
public:
  explicit Configurations(Context &context) : context_(context) {}

  void read(const Node &configurations) {
    for (const Node &each : children(configurations, "configuration"))
      configuration(each);
  }

  /// Makes a CONFIGURATION or tasks of what has been read.
  void finish() {
    if (inSource_)
      return;
    addDrives(context_, std::move(drives_), motionTask());
    const bool whole = needsConfiguration(resources_) || !lists_.empty();
    if (!whole) {
      for (Resource &resource : resources_)
        for (ResourceTask &each : resource.tasks) {
          for (const Instance &instance : each.instances)
            each.task.programs.push_back(instance.type.empty() ? instance.name : instance.type);
          context_.model().tasks.push_back(std::move(each.task));
        }
      return;
    }
    std::string text = fmt::format("CONFIGURATION {}\n", name_);
    for (const Resource &each : resources_)
      text += resourceText(each);
    reportTasks();
    context_.add(ObjectKind::Pou, first_, name_,
                 fmt::format("{}{}END_CONFIGURATION\n", text, lists_));
  }

private:
  void configuration(const Node &node) {
    const std::string name = attribute(node, "name");
    context_.leaveOutUnknown(
        node, {"resource", "globalVars", "accessVars", "configVars", "documentation"});
    context_.leaveOutUnknownExtras(node,
                                   {"Device", "configurations", "ExplicitConnector", "InSource"});
    inSource_ = inSource_ || isInSource(node);
    readDevice(context_, node, drives_);
    if (!first_ || (children(node, "resource").size() > 0 && name_.empty())) {
      first_ = node;
      name_ = isName(name) ? name : "Config";
    } else if (!children(node, "resource").empty()) {
      context_.changed(node, "configuration " + name,
                       "its resources stand beside those of " + name_);
    }
    for (const Node &each : children(node, "globalVars"))
      readGlobals(context_, each, "Global_Variables");
    for (const Node &each : children(node, "resource"))
      resource(each);
    lists_ += pathLists(context_, node);
    for (const Extra &each : extrasOf(node))
      if (localName(each.element) == "configurations")
        read(each.element);
  }

  void resource(const Node &node) {
    Resource resource;
    resource.name = attribute(node, "name");
    if (!isName(resource.name))
      resource.name = fmt::format("Resource{}", resources_.size() + 1);
    context_.leaveOutUnknown(node, {"task", "globalVars", "pouInstance", "documentation"});
    if (!inSource_)
      for (const Node &each : children(node, "task"))
        resource.tasks.push_back(taskOf(context_, each));
    for (const Node &each : children(node, "globalVars"))
      readGlobals(context_, each, "Global_Variables");
    for (const Node &each : children(node, "pouInstance"))
      resource.withoutTask.push_back(instanceOf(each));
    readExtras(context_, node, "Global_Variables");
    resources_.push_back(std::move(resource));
  }

  /// Where drives are to be moved; empty: there is only one task, or none.
  [[nodiscard]] std::string motionTask() const {
    size_t count = 0;
    std::string first;
    for (const Resource &resource : resources_)
      for (const ResourceTask &each : resource.tasks) {
        ++count;
        if (first.empty() && !each.task.interval.empty())
          first = each.task.name;
      }
    return count > 1 ? first : std::string();
  }

  /// A CONFIGURATION cannot say them.
  void reportTasks() {
    for (const Resource &resource : resources_)
      for (const ResourceTask &each : resource.tasks) {
        const std::string object = "task " + each.task.name;
        const unsigned sensitivity = each.task.watchdogSensitivity;
        if (!each.task.watchdog.empty())
          context_.leftOut(
              each.node, object,
              fmt::format("its watchdog of {}: add [[task]] with `name` and `watchdog`{} to "
                          "stride.toml",
                          each.task.watchdog,
                          sensitivity == 1
                              ? std::string()
                              : fmt::format(" and `watchdog_sensitivity = {}`", sensitivity)));
        if (each.task.status)
          context_.leftOut(each.node, object,
                           fmt::format("it runs while `{}` is TRUE (Status); SINGLE of a "
                                       "CONFIGURATION starts it at a rising edge",
                                       each.task.event));
      }
  }

  Context &context_;
  std::vector<Resource> resources_;
  std::vector<DriveSetup> drives_;
  std::string lists_;
  bool inSource_ = false; ///< the file has the CONFIGURATION as text
  std::string name_;
  Node first_;
};

} // namespace

std::string durationText(const std::string &text, const std::string &unit) {
  const std::optional<double> nanoseconds =
      text.starts_with("PT") ? xmlDuration(text.c_str() + 2) : numberWithUnit(text, unitOf(unit));
  if (!nanoseconds || !(*nanoseconds < 9e18))
    return text;
  const auto whole = static_cast<long long>(std::llround(*nanoseconds));
  constexpr std::array<std::pair<long long, const char *>, 4> kUnits = {
      {{1'000'000'000, "s"}, {1'000'000, "ms"}, {1'000, "us"}, {1, "ns"}}};
  for (const auto &[size, name] : kUnits)
    if (whole % size == 0)
      return fmt::format("{}#{}{}", size < 1'000'000 ? "LT" : "T", whole / size, name);
  return text;
}

void readInstances(Context &context, const Node &instances) {
  context.leaveOutUnknown(instances, {"configurations"});
  Configurations configurations(context);
  for (const Node &each : children(instances, "configurations"))
    configurations.read(each);
  configurations.finish();
}

} // namespace stc::import::plcopen
