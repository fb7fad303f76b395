// Tasks, the programs they call and the axis groups they serve; the PLC configuration as
// declarations.

#include "compiler/project/config.hpp"
#include "compiler/project/config_reader.hpp"
#include "compiler/project/driver_sections.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/global_names.hpp"
#include "compiler/syntax/st_text.hpp"
#include "compiler/toml/interval.hpp"
#include "drivers/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace stc {

namespace {

constexpr int64_t kDefaultIntervalNs = 10'000'000;
constexpr unsigned kLowestPriority = 31;
/// No name that a user can choose.
constexpr const char *kServiceTask = "(service)";

using Declarations = std::unordered_map<std::string, const ast::Decl *>;

std::vector<const ast::Decl *> programsOf(const std::vector<ast::File *> &files) {
  std::vector<const ast::Decl *> programs;
  for (const ast::File *file : files)
    for (const ast::Decl *decl : file->declarations)
      if (decl->kind == ast::DeclKind::Program && decl->name)
        programs.push_back(decl);
  return programs;
}

std::string_view describe(ast::DeclKind kind) {
  switch (kind) {
  case ast::DeclKind::Program:
    return "a PROGRAM";
  case ast::DeclKind::Function:
    return "a FUNCTION";
  case ast::DeclKind::FunctionBlock:
    return "a FUNCTION_BLOCK";
  case ast::DeclKind::Structure:
  case ast::DeclKind::Enumeration:
  case ast::DeclKind::Alias:
    return "a type";
  case ast::DeclKind::Class:
    return "a CLASS";
  case ast::DeclKind::Interface:
    return "an INTERFACE";
  case ast::DeclKind::Method:
    return "a METHOD";
  case ast::DeclKind::Action:
    return "an ACTION";
  case ast::DeclKind::Property:
    return "a PROPERTY";
  case ast::DeclKind::Configuration:
    return "a CONFIGURATION";
  case ast::DeclKind::Globals:
  case ast::DeclKind::Config:
  case ast::DeclKind::Access:
    break;
  }
  return "a global variable list";
}

class TaskResolver {
public:
  TaskResolver(ProjectConfig &config, const std::vector<ast::File *> &files,
               Diagnostics &diagnostics)
      : config_(config), diagnostics_(diagnostics), programs_(programsOf(files)) {
    for (const ast::File *file : files)
      for (const ast::Decl *decl : file->declarations)
        if (decl->name && (decl->space.empty() || decl->kind == ast::DeclKind::Program))
          declarations_.try_emplace(lowerCase(decl->name.text), decl);
  }

  void resolve(ProgramCheck check) {
    hadTasks_ = !config_.tasks.empty();
    if (!hadTasks_)
      addDefaultTask(check == ProgramCheck::Runnable);
    else if (check != ProgramCheck::Skip)
      checkPrograms();
    inOrder_ = !diagnostics_.hasErrors();
    for (AxisGroupConfig &group : config_.axisGroups)
      resolveGroup(group);
    for (AxisConfig &axis : config_.axes)
      resolveAxis(axis);
    addServiceTask();
  }

private:
  /// Where only events start tasks, somebody has to look at the inputs on which the events depend,
  /// and to serve scripts, traces and whoever watches.
  void addServiceTask() {
    const bool comesAround =
        std::any_of(config_.tasks.begin(), config_.tasks.end(), [this](const TaskConfig &task) {
          return task.start == TaskStart::Cyclic || task.start == TaskStart::Freewheeling ||
                 onBus_.contains(&task);
        });
    if (comesAround)
      return;
    TaskConfig task;
    task.name.text = kServiceTask;
    task.intervalNs = kDefaultIntervalNs;
    task.priority = kLowestPriority;
    config_.tasks.push_back(std::move(task));
  }

  void addDefaultTask(bool needsProgram) {
    TaskConfig task;
    task.name.text = "Task";
    task.intervalNs = kDefaultIntervalNs;
    for (const AxisGroupConfig &group : config_.axisGroups)
      if (group.cycleUs != 0) {
        task.intervalNs = int64_t{group.cycleUs} * 1000;
        break;
      }
    if (const ast::Decl *program = defaultProgram(needsProgram))
      task.programs.push_back({std::string(program->name.text), {}});
    config_.tasks.push_back(std::move(task));
  }

  const ast::Decl *defaultProgram(bool needed) {
    for (const ast::Decl *program : programs_)
      if (program->name.id->lower == "plc_prg")
        return program;
    if (programs_.size() == 1)
      return programs_.front();
    if (!needed)
      return nullptr;
    if (programs_.empty()) {
      diagnostics_.report(Code::NoProgram, {}, "there is no PROGRAM to run")
          .help("write `PROGRAM PLC_PRG … END_PROGRAM`: it is called in every cycle");
      return nullptr;
    }
    Diagnostic &d = diagnostics_.report(
        Code::SeveralPrograms, programs_[0]->name.span,
        fmt::format("there are {} PROGRAMs and no task that calls them", programs_.size()),
        "this one?");
    for (size_t i = 1; i < programs_.size() && i < 4; ++i)
      d.label(programs_[i]->name.span, "or this one?");
    d.help(fmt::format(
        "add a task to stride.toml: [[task]] with name = \"Task\", interval = \"T#10ms\", "
        "programs = [\"{}\"]; or name one of them PLC_PRG",
        programs_[0]->name.text));
    return nullptr;
  }

  void checkPrograms() {
    std::unordered_map<std::string, const ConfigName *> callers;
    std::unordered_map<std::string, const TaskConfig *> tasks;
    for (TaskConfig &task : config_.tasks)
      for (ConfigName &program : task.programs) {
        if (!checkProgram(program))
          continue;
        const std::string key = lowerCase(program.text);
        const auto [first, isNew] = callers.try_emplace(key, &program);
        if (isNew)
          tasks[key] = &task;
        else if (tasks[key] == &task)
          diagnostics_
              .report(Code::ConfigCalledTwice, program.span,
                      fmt::format("task `{}` calls `{}` twice in a cycle", task.name.text,
                                  program.text),
                      "called again")
              .label(first->second->span, "called first");
        else
          diagnostics_
              .report(Code::ConfigCalledTwice, program.span,
                      fmt::format("`{}` is called by two tasks, `{}` and `{}`", program.text,
                                  tasks[key]->name.text, task.name.text),
                      "called again")
              .label(first->second->span, "called first")
              .note("a PROGRAM has one set of variables, which the tasks would share");
      }
  }

  bool checkProgram(ConfigName &program) {
    const auto found = declarations_.find(lowerCase(program.text));
    if (found == declarations_.end()) {
      Diagnostic &d =
          diagnostics_.report(Code::ConfigUnknownProgram, program.span,
                              fmt::format("there is no PROGRAM `{}`", program.text), "not found");
      std::vector<std::string_view> names;
      for (const ast::Decl *candidate : programs_)
        names.push_back(candidate->name.text);
      if (const std::string_view near = nearest(program.text, names); !near.empty())
        d.help(fmt::format("did you mean `{}`?", near));
      return false;
    }
    if (found->second->kind != ast::DeclKind::Program) {
      diagnostics_
          .report(Code::ConfigNotAProgram, program.span,
                  fmt::format("`{}` is {}, a task calls PROGRAMs", program.text,
                              describe(found->second->kind)),
                  "cannot be called by a task")
          .label(found->second->name.span, "declared here");
      return false;
    }
    return true;
  }

  /// The task of that name; without a name the only one. Null: it has been reported. `what` needs
  /// it for its `work`.
  TaskConfig *taskOf(const ConfigName &name, Span section, const std::string &what,
                     std::string_view work) {
    if (!name.text.empty()) {
      for (TaskConfig &candidate : config_.tasks)
        if (equalIgnoringCase(candidate.name.text, name.text))
          return &candidate;
      reportUnknownTask(name);
      return nullptr;
    }
    if (config_.tasks.size() == 1)
      return &config_.tasks.front();
    diagnostics_
        .report(Code::ConfigUnknownTask, section,
                fmt::format("{} needs `sTask`: there are several tasks", what),
                fmt::format("which task {}?", work))
        .note("tasks: " + taskList());
    return nullptr;
  }

  /// What `dwCycle` of a task that an event starts must say, and what it must not contradict. The
  /// task's cycle in seconds; nothing: it has been reported.
  std::optional<double> cycleOf(const TaskConfig &task, uint32_t cycleUs, Span cycleSpan,
                                Span section, const std::string &what) {
    if (task.start == TaskStart::Event || task.start == TaskStart::Status) {
      if (cycleUs == 0)
        diagnostics_
            .report(
                Code::ConfigMissingKey, section,
                fmt::format("{} needs `dwCycle`: an event starts task `{}`", what, task.name.text),
                "how long is a cycle?")
            .help("add the time between two events in µs, for example `dwCycle = 2000`");
      return cycleUs * 1e-6;
    }
    if (task.intervalNs == 0 || cycleUs == 0 || int64_t{cycleUs} * 1000 == task.intervalNs)
      return static_cast<double>(task.intervalNs) * 1e-9;
    diagnostics_
        .report(Code::ConfigCycleMismatch, cycleSpan,
                fmt::format("dwCycle is {} µs, but task `{}` runs every {}", cycleUs,
                            task.name.text, formatInterval(task.intervalNs)),
                "does not fit the task")
        .help(task.intervalNs % 1000 == 0
                  ? fmt::format("write `dwCycle = {}`, or leave it out", task.intervalNs / 1000)
                  : "leave it out");
    return std::nullopt;
  }

  void resolveAxis(AxisConfig &axis) {
    const std::string what = fmt::format("axis `{}`", axis.name.text);
    const TaskConfig *task = taskOf(axis.task, axis.section, what, "calls its blocks");
    if (task == nullptr)
      return;
    axis.task.text = task->name.text;
    if (const auto seconds = cycleOf(*task, axis.cycleUs, axis.cycleSpan, axis.section, what))
      axis.fields.emplace_back("fTaskCycle", fmt::format("{:.9f}", *seconds));
  }

  void resolveGroup(AxisGroupConfig &group) {
    const std::string what = fmt::format("axis group `{}`", group.name.text);
    TaskConfig *task = taskOf(group.task, group.groupSpan, what, "serves the drives");
    if (task == nullptr)
      return;
    group.task.text = task->name.text;
    checkSync(group, *task);
    const auto seconds = cycleOf(*task, group.cycleUs, group.cycleSpan, group.groupSpan, what);
    if (!seconds)
      return;
    if (isSyncOf(*task, group)) { // from SYNC to SYNC
      task->intervalNs = int64_t{group.cycleUs} * 1000;
      onBus_.insert(task);
    }
    if (task->start != TaskStart::Event && task->start != TaskStart::Status)
      group.cycleUs = static_cast<uint32_t>(task->intervalNs / 1000);
    setTaskCycle(group, *seconds);
    if (inOrder_)
      checkByDriver(config_, group, *seconds, diagnostics_);
  }

  /// Whoever sends SYNC sets the pace: the task does, or waits for it.
  void checkSync(const AxisGroupConfig &group, const TaskConfig &task) {
    const std::string &producer = group.syncProducer.text;
    if (producer.empty())
      return;
    const std::string event = group.name.text + ".bSync";
    const bool waits = task.start == TaskStart::Event && equalIgnoringCase(task.event.text, event);
    const bool sends = equalIgnoringCase(producer, "PLC");
    if (waits != sends && (waits || task.start == TaskStart::Cyclic))
      return;
    Diagnostic &d = diagnostics_.report(
        Code::ConfigSyncTask, group.syncProducer.span,
        sends
            ? fmt::format("task `{}` is to send SYNC, but does not run at regular times",
                          task.name.text)
            : fmt::format("task `{}` does not wait for SYNC, which the bus sends", task.name.text),
        sends ? "the task sends SYNC at its start" : "a device sends SYNC");
    if (task.name.span.valid())
      d.label(task.name.span, waits ? "waits for SYNC itself" : "starts otherwise");
    d.help(sends ? fmt::format("make `{}` a task with an `interval`, or let a device send SYNC: "
                               "`SyncProducer = \"1.Drive\"`",
                               task.name.text)
                 : fmt::format("start `{}` by SYNC: `kind = \"event\"`, `event = \"{}\"`, or let "
                               "the task send it: `SyncProducer = \"PLC\"`",
                               task.name.text, event));
  }

  static void setTaskCycle(AxisGroupConfig &group, double seconds) {
    for (DriveConfig &drive : group.drives)
      drive.fields.emplace_back("fTaskCycle", fmt::format("{:.9f}", seconds));
  }

  void reportUnknownTask(const ConfigName &name) {
    Diagnostic &d =
        diagnostics_.report(Code::ConfigUnknownTask, name.span,
                            fmt::format("there is no task `{}`", name.text), "not found");
    if (!hadTasks_) {
      d.help(fmt::format(
          "add it: [[task]] with name = \"{}\", interval = \"T#3ms\", programs = [\"…\"]; "
          "or leave `sTask` out",
          name.text));
      return;
    }
    std::vector<std::string_view> names;
    for (const TaskConfig &task : config_.tasks)
      names.push_back(task.name.text);
    if (const std::string_view near = nearest(name.text, names); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    d.note("tasks: " + taskList());
  }

  std::string taskList() const {
    std::string list;
    for (const TaskConfig &task : config_.tasks)
      list += fmt::format("{}`{}`", list.empty() ? "" : ", ", task.name.text);
    return list;
  }

  ProjectConfig &config_;
  Diagnostics &diagnostics_;
  std::vector<const ast::Decl *> programs_;
  Declarations declarations_;
  bool hadTasks_ = false;
  bool inOrder_ = false;                         ///< No errors before the axis groups.
  std::unordered_set<const TaskConfig *> onBus_; ///< Started by the SYNC of their bus.
};

class DeclarationWriter {
public:
  DeclarationWriter(const std::vector<ast::File *> &files, Diagnostics &diagnostics)
      : names_(globalNames(files)), diagnostics_(diagnostics) {}

  SyntheticSource write(const ProjectConfig &config) {
    axisGroups(config);
    for (const AxisConfig &axis : config.axes)
      variable("axis", axis.name, "SM_DriveBasic.AXIS_REF", axis.fields, axis.unit);
    for (const IoConfig &io : config.ioDevices)
      variable("I/O device", io.name, "IO_DEVICE", {});
    if (!out_.empty()) {
      out_.add("END_VAR\n");
      if (!config.axisGroups.empty() && !clash_ && !names_.contains("g_drivestruct") &&
          !names_.contains("drivestruct"))
        out_.add(driveStruct(config));
    }
    if (!config.ioDevices.empty())
      out_.add(kIoDevice);
    return std::move(out_);
  }

private:
  void axisGroups(const ProjectConfig &config) {
    size_t index = 0;
    for (const AxisGroupConfig &group : config.axisGroups) {
      ConfigFields fields = {{"sTask", fmt::format("'{}'", group.task.text)},
                             {"dwCycle", std::to_string(group.cycleUs)}};
      fields.insert(fields.end(), group.fields.begin(), group.fields.end());
      fields.emplace_back("wAxisGroupId", std::to_string(index));
      fields.emplace_back("wDriveCount", std::to_string(group.drives.size()));
      fields.emplace_back("wEncoderCount", std::to_string(group.encoders.size()));
      variable("axis group", group.name, "SM_DriveBasic.SMC_AXISGROUP_REF", fields);
      if (group.shared != nullptr)
        variable(group.shared->what, {sharedVariable(group), group.name.span}, group.shared->type,
                 {});
      for (const DriveConfig &drive : group.drives) {
        fields = drive.fields;
        fields.emplace_back("wAxisGroupId", std::to_string(index));
        variable("drive", drive.name, "SM_DriveBasic.AXIS_REF", fields, drive.unit);
        if (drive.shared != nullptr)
          variable(drive.shared->what, {sharedVariable(drive), drive.name.span}, drive.shared->type,
                   {});
      }
      for (const EncoderConfig &encoder : group.encoders)
        variable("encoder", encoder.name, "SM_DriveBasic.SMC_ENCODER_REF", encoder.fields);
      ++index;
    }
  }

  /// `unit`: what one technical unit is, for the reference; or empty.
  void variable(std::string_view what, const ConfigName &name, std::string_view type,
                const ConfigFields &fields, std::string_view unit = {}) {
    if (const auto clash = names_.find(lowerCase(name.text)); clash != names_.end()) {
      diagnostics_
          .report(
              Code::ConfigNameClash, name.span,
              fmt::format("the {} `{}` has the name of something in the program", what, name.text),
              "becomes a global variable of this name")
          .label(clash->second, "already declared here")
          .help("rename one of them");
      clash_ = true;
      return;
    }
    if (out_.empty())
      out_.add("VAR_GLOBAL\n");
    if (!unit.empty())
      out_.add(fmt::format("  /// One technical unit is one {0}. [{0}]\n", unit));
    std::string text = fmt::format("  {} : {}", name.text, type);
    std::string_view separator = " := (";
    for (const auto &[field, value] : fields) {
      text += fmt::format("{}{} := {}", separator, field, value);
      separator = ", ";
    }
    out_.add(text + (fields.empty() ? ";\n" : ");\n"), name.span);
  }

  /// runtime/io/process_image.hpp: IoDeviceState.
  static constexpr std::string_view kIoDevice =
      "TYPE IO_DEVICE : STRUCT\n"
      "  /// Set it to simulate the loss of the device.\n  bFault : BOOL;\n"
      "  /// The device does not answer: outputs have their safe values.\n  bLost : BOOL;\n"
      "  /// How often it was lost.\n  udiLosses : UDINT;\nEND_STRUCT END_TYPE\n";
  // The list of the drives' variables has this file's name, as in CoDeSys.
  SyntheticSource out_{"<plc>/Drive_Configuration_Data.st"};
  std::unordered_map<std::string, Span> names_;
  bool clash_ = false; ///< something has been left out
  Diagnostics &diagnostics_;
};

} // namespace

void resolveTasks(ProjectConfig &config, const std::vector<ast::File *> &files,
                  ProgramCheck programCheck, Diagnostics &diagnostics) {
  TaskResolver(config, files, diagnostics).resolve(programCheck);
}

bool isSyncOf(const TaskConfig &task, const AxisGroupConfig &group) {
  const stride::bus::DriverSchema *driver = stride::drivers::findSchema(group.driver);
  return driver != nullptr && driver->givesSync && task.start == TaskStart::Event &&
         equalIgnoringCase(task.event.text, group.name.text + ".bSync");
}

std::string eventFunction(const TaskConfig &task) {
  constexpr size_t kMostOfName = 200; // so that the function's name is no longer than names may be
  const std::string &name = task.name.text;
  if (name.size() <= kMostOfName)
    return name + "__event";
  return fmt::format("{}__{}_{}__event", name.substr(0, kMostOfName), task.name.span.file,
                     task.name.span.begin);
}

SyntheticSource eventDeclaration(const TaskConfig &task, const std::string &file, LineColumn at) {
  SyntheticSource out(file);
  const std::string name = eventFunction(task);
  const std::string begin =
      fmt::format("{{attribute 'hide'}} FUNCTION {} : BOOL {} :=", name, name);
  // So much before the expression that an exception in it has its place.
  out.add((at.line > 1
               ? std::string(at.line - 2, '\n') + begin + '\n' + std::string(at.column - 1, ' ')
               : begin + ' ') +
              task.event.text + "; END_FUNCTION\n",
          task.event.span);
  return out;
}

SyntheticSource plcDeclarations(const ProjectConfig &config, const std::vector<ast::File *> &files,
                                Diagnostics &diagnostics) {
  return DeclarationWriter(files, diagnostics).write(config);
}

} // namespace stc
