#include "compiler/project/config.hpp"
#include "compiler/project/cnc_config.hpp"

#include "compiler/project/config_reader.hpp"
#include "compiler/project/driver_sections.hpp"
#include "compiler/project/io_config.hpp"
#include "compiler/syntax/st_text.hpp"
#include "compiler/toml/interval.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc {

namespace {

/// Longest name of a project, in bytes: file systems know names of 255, and some are longer.
constexpr size_t kMaxProjectName = 200;

class Reader {
public:
  Reader(const SourceFile &file, Diagnostics &diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  ProjectConfig read() {
    const std::unique_ptr<TomlNode> document = parseToml(file_, diagnostics_);
    if (document == nullptr) {
      config_.incomplete = true;
      return std::move(config_);
    }
    const TomlNode *library = document->find("library");
    const bool isLibrary = library != nullptr && library->kind == TomlKind::Table;
    const SectionSchema &schema = isLibrary ? librarySchema() : projectSchema();
    const CheckedSection top(*document, schema, diagnostics_);
    readLibraries(top, isLibrary);
    for (const CheckedSection &levels : top.sections("diagnostics", diagnostics_))
      readLevels(levels);
    for (const CheckedSection &project : top.sections("project", diagnostics_))
      readProject(project);
    for (const CheckedSection &image : top.sections("image", diagnostics_)) {
      config_.addressing = static_cast<Addressing>(image.choice("addressing", 0));
      size_t area = 0;
      for (const std::string_view name : {"inputs", "outputs", "memory"})
        config_.imageBytes[area++] = static_cast<uint32_t>(image.integer(name, 0));
    }
    for (const CheckedSection &retain : top.sections("retain", diagnostics_)) {
      config_.retainFile = retain.text("file");
      config_.retainPeriodNs = parseInterval(retain.text("period")).value_or(0);
    }
    (void)top.sections("fmt", diagnostics_); // format_project.cpp reads it
    for (const CheckedSection &files : top.sections("files", diagnostics_)) {
      config_.filesRoot = files.text("root");
      config_.filesAnywhere = files.boolean("anywhere", false);
      config_.filesDelay = static_cast<uint32_t>(files.integer("delay", 1));
    }
    for (const CheckedSection &build : top.sections("build", diagnostics_)) {
      config_.launcher = static_cast<Launcher>(build.choice("launcher", 0));
      config_.buildJobs = static_cast<unsigned>(build.integer("jobs", 0));
    }
    groups_ = top.table().find("axes_group");
    for (const CheckedSection &task : top.sections("task", diagnostics_))
      readTask(task);
    for (const TomlNode &bus : top.tables("bus"))
      plc_.readBus({bus, busSection(bus), diagnostics_, &projectSchema()});
    for (const CheckedSection &axis : top.sections("axis", diagnostics_))
      plc_.readAxis(axis);
    for (const CheckedSection &group : top.sections("axes_group", diagnostics_))
      plc_.readAxesGroup(group);
    for (const CheckedSection &cnc : top.sections("cnc", diagnostics_))
      readCncSection(cnc, config_, diagnostics_);
    for (const CheckedSection &csy : top.sections("csy", diagnostics_))
      config_.csy.push_back(readCsy(csy, diagnostics_));
    for (const CheckedSection &test : top.sections("test", diagnostics_))
      readTraceTest(test);
    for (const TomlNode &io : top.tables("io"))
      readIoDevice({io, ioSection(io), diagnostics_, &projectSchema()}, config_, diagnostics_);
    return std::move(config_);
  }

private:
  void readProject(const CheckedSection &project) {
    config_.name = project.text("name");
    checkProjectName(project.get("name"));
    config_.poolSize = (static_cast<uint64_t>(project.integer("new_pool", 65536)) + 15) / 16 * 16;
    config_.generation = static_cast<unsigned>(project.choice("softmotion", 2));
    config_.truncIsInt = project.get("softmotion") != nullptr && config_.generation == 2;
    config_.pack = static_cast<unsigned>(project.choice("layout", 0));
    if (const TomlNode *defines = project.get("defines"))
      for (const TomlNode &one : defines->children)
        readDefine(one);
    if (const TomlNode *sources = project.get("sources"))
      for (const TomlNode &one : sources->children)
        config_.sources.push_back({one.text, one.span});
  }

  void readLibraries(const CheckedSection &top, bool isLibrary) {
    for (const CheckedSection &library : top.sections("library", diagnostics_)) {
      if (!isLibrary) {
        config_.libraries.push_back(readLibraryUse(library, diagnostics_));
        continue;
      }
      config_.library = readLibraryInfo(library, diagnostics_);
      for (const CheckedSection &use : library.sections("uses", diagnostics_))
        config_.libraries.push_back(readLibraryUse(use, diagnostics_));
    }
  }

  // What the command line says about a code stays.
  void readLevels(const CheckedSection &section) {
    Levels levels;
    for (const TomlNode &member : section.table().children) {
      if (section.get(member.key) == nullptr)
        continue;
      const auto severity = static_cast<Severity>(section.choice(member.key, 0));
      if (const std::optional<Levels::Group> group = findGroup(member.key))
        levels.set(*group, severity);
      else if (const CodeInfo *code = findCode(member.key))
        levels.set(code->code, severity);
    }
    levels.add(diagnostics_.levels());
    diagnostics_.setLevels(std::move(levels));
  }

  void readDefine(const TomlNode &node) {
    if (const std::optional<Define> define = stc::readDefine(node.text))
      config_.defines.push_back(*define);
    else
      diagnostics_
          .report(Code::ConfigBadName, node.span, fmt::format("`{}` cannot be defined", node.text),
                  "not a name")
          .help("write \"NAME\" or \"NAME=VALUE\"");
  }

  /// Files are named after the project.
  /// What is wrong with it as a part of the names of files; empty: nothing.
  static std::string projectNameProblem(std::string_view name) {
    if (name.size() > kMaxProjectName)
      return fmt::format("longer than {} bytes", kMaxProjectName);
    if (name.find('/') != std::string_view::npos)
      return "with a `/`";
    if (name.starts_with('.'))
      return "begins with a dot";
    const bool control = std::any_of(name.begin(), name.end(),
                                     [](char c) { return static_cast<unsigned char>(c) < ' '; });
    return control ? "with a control character" : "";
  }

  void checkProjectName(const TomlNode *name) {
    if (name == nullptr)
      return;
    const std::string problem = projectNameProblem(name->text);
    if (problem.empty())
      return;
    config_.name.clear();
    diagnostics_
        .report(Code::ConfigBadName, name->span, "the project cannot have this name", problem)
        .note("its files have the project's name, that of the retained data for one");
  }

  void readTask(const CheckedSection &section) {
    TaskConfig task;
    task.name = nameOf(section);
    if (task.name.span.valid() &&
        !taskNames_.add(lowerCase(task.name.text), task.name.span,
                        fmt::format("two tasks are named `{}`", task.name.text)))
      return;
    task.section = section.table().span;
    const bool adds = section.has("watchdog") || section.has("core");
    for (const TomlNode &member : section.table().children)
      if (task.own.text.empty() && member.key != "name" && member.key != "watchdog" &&
          member.key != "watchdog_sensitivity" && member.key != "core")
        task.own = {member.key, member.span};
    task.start =
        static_cast<TaskStart>(section.choice("kind", static_cast<int64_t>(TaskStart::Cyclic)));
    if (!adds || !task.own.text.empty()) {
      if (!section.has("programs"))
        reportIdle(task);
      if (task.own.text.empty())
        task.own.text = "programs"; // which is missing
      readStart(section, task);
    }
    task.watchdogNs = parseInterval(section.text("watchdog")).value_or(0);
    task.watchdogSensitivity = static_cast<unsigned>(section.integer("watchdog_sensitivity", 1));
    if (section.has("watchdog_sensitivity") && !section.has("watchdog"))
      withoutEffect(diagnostics_, section, "watchdog_sensitivity", "only together with `watchdog`");
    if (section.has("core"))
      task.core = static_cast<unsigned>(section.integer("core", 0));
    task.priority = static_cast<unsigned>(section.integer("priority", 1));
    if (const TomlNode *programs = section.get("programs"))
      for (const TomlNode &program : programs->children)
        task.programs.push_back({program.text, program.span});
    config_.tasks.push_back(std::move(task));
  }

  void readTraceTest(const CheckedSection &section) {
    TraceTest test;
    test.name = nameOf(section);
    const TomlNode *trace = section.get("trace");
    test.durationNs = parseInterval(section.text("for")).value_or(0);
    if (!test.name.span.valid() || trace == nullptr || test.durationNs == 0 ||
        !testNames_.add(lowerCase(test.name.text), test.name.span,
                        fmt::format("two tests are named `{}`", test.name.text)))
      return; // which has been reported
    if (trace->children.empty())
      diagnostics_
          .report(Code::ConfigMissingKey, trace->span, "a test needs a variable to trace", "empty")
          .help("name some: trace = [\"Main.n\"]");
    for (const TomlNode &variable : trace->children)
      test.trace.push_back(variable.text);
    test.script = section.text("script");
    if (const TomlNode *sets = section.get("set"))
      for (const TomlNode &one : sets->children)
        test.sets.push_back(one.text);
    test.tolerance = section.real("tolerance", 0);
    test.everyNs = parseInterval(section.text("every")).value_or(0);
    config_.traceTests.push_back(std::move(test));
  }

  /// What starts it: an interval, an event, or nothing.
  void readStart(const CheckedSection &section, TaskConfig &task) {
    if (section.has("kind") && section.get("kind") == nullptr)
      return;                                // unknown, which has been reported
    constexpr int64_t kOwnPace = 10'000'000; // of freewheeling and status tasks
    task.intervalNs = parseInterval(section.text("interval")).value_or(0);
    const bool onEvent = task.start == TaskStart::Event || task.start == TaskStart::Status;
    if (onEvent) {
      if (const TomlNode *event = section.get("event"))
        task.event = {event->text, event->span};
      else if (!section.has("event"))
        missing(section.table().span, "event",
                "the BOOL that starts it, for example \"GVL.bStart\"");
    } else if (section.has("event")) {
      withoutEffect(diagnostics_, section, "event", "only with kind = \"event\" or \"status\"");
    }
    if (task.start == TaskStart::Cyclic && !section.has("interval"))
      missing(section.table().span, "interval", "a duration such as \"T#10ms\"");
    if (task.intervalNs == 0 &&
        (task.start == TaskStart::Freewheeling || task.start == TaskStart::Status))
      task.intervalNs = kOwnPace;
  }

  /// A task without programs has to plan for a group at least.
  void reportIdle(const TaskConfig &task) {
    if (groups_ != nullptr)
      for (const TomlNode &group : groups_->children)
        if (const TomlNode *planner = group.find("planning_task");
            planner != nullptr && equalIgnoringCase(planner->text, task.name.text))
          return;
    missing(task.section, "programs", "a list of names, such as [\"PLC_PRG\"]");
  }

  void missing(Span section, std::string_view name, std::string_view what) {
    diagnostics_
        .report(Code::ConfigMissingKey, section, fmt::format("a task needs `{}`", name),
                fmt::format("`{}` is missing", name))
        .help(fmt::format("add `{} = …`: {}", name, what));
  }

  const SourceFile &file_;
  Diagnostics &diagnostics_;
  ProjectConfig config_;
  PlcReader plc_{config_, diagnostics_};
  const TomlNode *groups_ = nullptr; ///< [[axes_group]]; null: there are none.
  Unique taskNames_{Code::ConfigDuplicateName, diagnostics_};
  Unique testNames_{Code::ConfigDuplicateName, diagnostics_};
};

} // namespace

ProjectConfig readConfig(const SourceFile &toml, Diagnostics &diagnostics) {
  return Reader(toml, diagnostics).read();
}

} // namespace stc
