// CONFIGURATION … END_CONFIGURATION: tasks and program instances, into what stride.toml's [[task]]
// gives. An instance with a name of its own becomes a variable of the program's type; with
// arguments, a hidden program that calls it.

#include "compiler/project/config.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/attributes.hpp"
#include "compiler/syntax/st_text.hpp"
#include "compiler/toml/interval.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>
#include <utility>

namespace stc {

namespace {

using namespace ast;

constexpr int64_t kMinIntervalNs = 1'000;
constexpr int64_t kMaxIntervalNs = 3'600'000'000'000;
constexpr unsigned kLowestPriority = 31;

class ConfigurationReader {
public:
  ConfigurationReader(ProjectConfig &config, Program &program)
      : config_(config), program_(program) {}

  File *read(const std::vector<File *> &files) {
    const ConfigurationDecl *first = nullptr;
    for (File *file : files) {
      for (Decl *decl : file->declarations) {
        if (decl->kind == DeclKind::Program)
          programs_.emplace(decl->name.id, decl);
        else if (decl->name && decl->kind != DeclKind::Globals)
          others_.emplace(decl->name.id, decl);
        if (decl->kind != DeclKind::Configuration)
          continue;
        if (first != nullptr) {
          report(Code::ConfigurationTwice, decl->name.span, "there are two CONFIGURATIONs",
                 "the second one")
              .label(first->name.span, "the first one")
              .help("put all resources into one");
          continue;
        }
        first = as<ConfigurationDecl>(decl);
      }
    }
    readActions();
    if (first == nullptr || !hasTasks(*first)) {
      reportAdditions();
      return declarations();
    }
    const std::vector<TaskConfig> additions = std::exchange(config_.tasks, {});
    for (const TaskConfig &task : additions) {
      if (task.own.text.empty())
        continue;
      Diagnostic &d = report(Code::ConfigurationTwice, first->name.span,
                             "the tasks are configured twice", "a CONFIGURATION …");
      d.label(task.name.span, "… and [[task]] in stride.toml");
      if (task.own.span.valid())
        d.label(task.own.span, "which only the CONFIGURATION can say");
      d.help("remove one of the two; to a task of the CONFIGURATION, [[task]] of the same name can "
             "add `watchdog`, `watchdog_sensitivity` and `core`");
      return nullptr;
    }
    for (const ResourceDecl &resource : first->resources)
      readResource(resource);
    for (const TaskConfig &addition : additions)
      add(addition);
    if (!variables_.empty()) {
      auto *list = program_.arena.make<GlobalsDecl>();
      list->name = first->name;
      list->span = first->span;
      for (VarDecl *variable : variables_) {
        // A program that is called under its own name as well has its own variables.
        if (plain_.contains(as<NamedTypeExpr>(variable->type)->path.back().id))
          variable->attributes = attribute(AttributeId::ProgramInstance, "also");
      }
      list->variables = program_.arena.copy(variables_);
      declarations_.insert(declarations_.begin(), list);
    }
    return declarations();
  }

private:
  File *declarations() {
    if (declarations_.empty())
      return nullptr;
    auto *file = program_.arena.make<File>();
    file->id = declarations_.front()->span.file;
    file->declarations = program_.arena.copy(declarations_);
    return file;
  }

  /// Without a CONFIGURATION there is nothing that a [[task]] could add to.
  void reportAdditions() {
    for (const TaskConfig &task : config_.tasks)
      if (task.own.text.empty())
        report(Code::ConfigMissingKey, task.section, "a task needs `programs`",
               "`programs` is missing")
            .help("add `programs = …`: a list of names, such as [\"PLC_PRG\"]")
            .note("only to a task of a CONFIGURATION, [[task]] can add just a watchdog or a "
                  "processor");
  }

  /// What stride.toml adds to a task: a watchdog, a processor.
  void add(const TaskConfig &addition) {
    for (TaskConfig &task : config_.tasks) {
      if (!equalIgnoringCase(task.name.text, addition.name.text))
        continue;
      task.watchdogNs = addition.watchdogNs;
      task.watchdogSensitivity = addition.watchdogSensitivity;
      task.core = addition.core;
      return;
    }
    Diagnostic &d =
        report(Code::ConfigUnknownTask, addition.name.span,
               fmt::format("the CONFIGURATION has no task `{}`", addition.name.text), "not found");
    std::vector<std::string_view> names;
    for (const TaskConfig &task : config_.tasks)
      names.push_back(task.name.text);
    if (const auto near = nearest(addition.name.text, names); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
  }

  /// `programs = ["Main.Step"]` of stride.toml: an action is called by a hidden program.
  void readActions() {
    for (TaskConfig &task : config_.tasks) {
      for (ConfigName &entry : task.programs) {
        const size_t dot = entry.text.find('.');
        if (dot == std::string::npos)
          continue;
        const auto name = [&](std::string_view text) {
          return Name{program_.interner.intern(text), program_.arena.copy(text), entry.span};
        };
        const Name program = name(std::string_view(entry.text).substr(0, dot));
        if (!programs_.contains(program.id))
          continue; // reported with the other tasks
        const Name action = name(std::string_view(entry.text).substr(dot + 1));
        entry.text = caller(fmt::format("{}__{}__{}", task.name.text, program.text, action.text),
                            entry.span, member(program, action, entry.span), {});
      }
    }
  }

  Diagnostic &report(Code code, Span where, std::string message, std::string label) {
    return program_.diagnostics.report(code, where, std::move(message), std::move(label));
  }

  static bool hasTasks(const ConfigurationDecl &configuration) {
    return std::any_of(
        configuration.resources.begin(), configuration.resources.end(),
        [](const ResourceDecl &r) { return !r.tasks.empty() || !r.programs.empty(); });
  }

  Attributes attribute(AttributeId id, std::string_view value) {
    return program_.arena.copy(std::vector<Attribute>{{id, attributeRow(id).name, value, {}}});
  }

  void readResource(const ResourceDecl &resource) {
    for (const TaskDecl &task : resource.tasks)
      readTask(task);
    for (const ProgramInstanceDecl &instance : resource.programs)
      readProgram(instance, resource);
  }

  void readTask(const TaskDecl &decl) {
    TaskConfig task;
    task.name = {std::string(decl.name.text), decl.name.span};
    task.priority = kLowestPriority;
    for (const TaskConfig &other : config_.tasks) {
      if (equalIgnoringCase(other.name.text, task.name.text)) {
        report(Code::ConfigurationTask, decl.name.span,
               fmt::format("two tasks are named `{}`", task.name.text), "named again")
            .label(other.name.span, "the first one");
        return;
      }
    }
    bool hasInterval = false;
    bool bad = false;
    for (const Argument &a : decl.arguments) {
      const std::string name = a.name ? lowerCase(a.name.text) : std::string();
      const auto *literal =
          a.value != nullptr && a.value->kind == ExprKind::Literal ? as<Literal>(a.value) : nullptr;
      if (name == "interval") {
        hasInterval = true;
        bad = !readInterval(a, literal, task) || bad;
      } else if (name == "priority") {
        if (literal == nullptr || literal->literal != LiteralKind::Integer ||
            literal->integer > kLowestPriority)
          report(Code::ConfigurationTask, a.span, "a PRIORITY is a number from 0 to 31",
                 "0 is the highest");
        else
          task.priority = static_cast<unsigned>(literal->integer);
      } else if (name == "single") {
        if (a.value == nullptr) {
          bad = true;
          report(Code::ConfigurationTask, a.span, "SINGLE is a BOOL", "an expression is expected");
          continue;
        }
        const Span at = a.value->span;
        task.start = TaskStart::Event;
        task.event = {
            std::string(program_.sources.file(at.file).text().substr(at.begin, at.end - at.begin)),
            at};
      } else {
        Diagnostic &d = report(Code::ConfigurationTask, a.span, "a TASK has no such property",
                               "not INTERVAL, PRIORITY or SINGLE");
        if (const auto near = nearest(name, {"INTERVAL", "PRIORITY", "SINGLE"}); !near.empty())
          d.help(fmt::format("did you mean `{}`?", near));
        bad = true;
      }
    }
    if (!hasInterval && !bad && task.start == TaskStart::Cyclic)
      report(Code::ConfigurationTask, decl.name.span,
             fmt::format("the task `{}` has no INTERVAL", task.name.text), "how often does it run?")
          .help(
              fmt::format("write `TASK {} (INTERVAL := T#10ms, PRIORITY := 1);`", task.name.text));
    config_.tasks.push_back(std::move(task));
  }

  bool readInterval(const Argument &a, const Literal *literal, TaskConfig &task) {
    int64_t ns = 0;
    if (literal != nullptr && literal->literal == LiteralKind::Time)
      ns = static_cast<int64_t>(literal->integer) * 1'000'000;
    else if (literal != nullptr && literal->literal == LiteralKind::Ltime)
      ns = static_cast<int64_t>(literal->integer);
    if (ns >= kMinIntervalNs && ns <= kMaxIntervalNs) {
      task.intervalNs = ns;
      return true;
    }
    report(Code::ConfigurationTask, a.span, "an INTERVAL is a duration from 1 µs to one hour",
           literal == nullptr ? "a literal is expected here" : "not such a duration")
        .help("write `INTERVAL := T#10ms`");
    return false;
  }

  TaskConfig *findTask(const ProgramInstanceDecl &instance, const ResourceDecl &resource) {
    if (!instance.task) { // runs when nothing else does
      constexpr std::string_view kName = "Background";
      for (TaskConfig &task : config_.tasks)
        if (task.name.text == kName && task.start == TaskStart::Freewheeling)
          return &task;
      TaskConfig task;
      task.name.text = kName;
      task.priority = kLowestPriority;
      task.start = TaskStart::Freewheeling;
      task.intervalNs = 10'000'000;
      config_.tasks.push_back(std::move(task));
      return &config_.tasks.back();
    }
    std::vector<std::string_view> names;
    for (const TaskDecl &task : resource.tasks)
      names.push_back(task.name.text);
    for (TaskConfig &task : config_.tasks)
      if (equalIgnoringCase(task.name.text, instance.task.text))
        return &task;
    Diagnostic &d = report(Code::ConfigurationTask, instance.task.span,
                           fmt::format("there is no task `{}`", instance.task.text), "not found");
    if (const auto near = nearest(instance.task.text, names); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    return nullptr;
  }

  void readProgram(const ProgramInstanceDecl &decl, const ResourceDecl &resource) {
    const Name type = decl.type.empty() ? decl.name : decl.type.back();
    if (const auto [first, fresh] = instances_.emplace(decl.name.id, decl.name.span); !fresh) {
      report(Code::ConfigurationProgram, decl.name.span,
             fmt::format("two programs are named `{}`", decl.name.text), "named again")
          .label(first->second, "the first one");
      return;
    }
    const bool isAction = decl.type.size() == 2 && !programs_.contains(type.id) &&
                          programs_.contains(decl.type.front().id);
    if (!programs_.contains(type.id) && !isAction) {
      unknownProgram(type);
      return;
    }
    TaskConfig *task = findTask(decl, resource);
    if (task == nullptr)
      return;
    if (isAction) { // of the program, which has no instance of another name for it
      plain_.emplace(decl.type.front().id, true);
      const Span span = decl.type.front().span.to(type.span);
      task->programs.push_back({caller(std::string(decl.name.text), decl.span,
                                       member(decl.type.front(), type, span), decl.arguments),
                                decl.name.span});
      return;
    }
    const bool own = decl.name.id != type.id;
    if (own && (programs_.contains(decl.name.id) || others_.contains(decl.name.id))) {
      const auto other = programs_.find(decl.name.id);
      report(Code::ConfigurationProgram, decl.name.span,
             fmt::format("the instance `{}` has the name of something else", decl.name.text),
             "another name is needed")
          .label(other != programs_.end() ? other->second->name.span
                                          : others_.at(decl.name.id)->name.span,
                 "declared here");
      return;
    }
    if (own) {
      auto *path = program_.arena.make<NamedTypeExpr>();
      path->span = type.span;
      path->path = program_.arena.copy(std::vector<Name>{type});
      auto *variable = program_.arena.make<VarDecl>();
      variable->name = decl.name;
      variable->section = ast::Section::Global;
      variable->qualifiers = decl.qualifiers;
      variable->type = path;
      variable->attributes = attribute(AttributeId::ProgramInstance, {});
      variables_.push_back(variable);
    } else {
      plain_.emplace(type.id, true);
    }
    task->programs.push_back(
        {own || !decl.arguments.empty()
             ? caller(std::string(decl.name.text), decl.span, nameOf(decl.name), decl.arguments)
             : std::string(type.text),
         decl.name.span});
  }

  void unknownProgram(const Name &type) {
    const auto other = others_.find(type.id);
    Diagnostic &d = report(
        other == others_.end() ? Code::ConfigUnknownProgram : Code::ConfigNotAProgram, type.span,
        other == others_.end() ? fmt::format("there is no PROGRAM `{}`", type.text)
                               : fmt::format("`{}` is not a PROGRAM", type.text),
        other == others_.end() ? "not found" : "cannot be called by a task");
    if (other != others_.end()) {
      d.label(other->second->name.span, "declared here");
      return;
    }
    std::vector<std::string_view> names;
    for (const auto &[id, program] : programs_)
      names.push_back(program->name.text);
    std::sort(names.begin(), names.end());
    if (const auto near = nearest(type.text, names); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
  }

  Expr *nameOf(const Name &name) {
    auto *expr = program_.arena.make<NameExpr>();
    expr->span = name.span;
    expr->name = name;
    return expr;
  }

  Expr *member(const Name &program, const Name &action, Span span) {
    auto *expr = program_.arena.make<MemberExpr>();
    expr->span = span;
    expr->base = nameOf(program);
    expr->name = action;
    return expr;
  }

  /// A hidden program with the statement `callee(arguments);`.
  std::string caller(const std::string &what, Span span, Expr *callee,
                     std::span<Argument> arguments) {
    Arena &arena = program_.arena;
    auto *call = arena.make<CallExpr>();
    call->span = span;
    call->callee = callee;
    call->arguments = arguments;
    auto *statement = arena.make<CallStmt>();
    statement->span = span;
    statement->expr = call;
    auto *pou = arena.make<PouDecl>();
    pou->kind = DeclKind::Program;
    pou->span = span;
    std::string name = what + "__call";
    pou->name = {program_.interner.intern(name), arena.copy(std::string_view(name)), callee->span};
    pou->attributes = attribute(AttributeId::Hide, {});
    pou->body = arena.copy(std::vector<Stmt *>{statement});
    declarations_.push_back(pou);
    return name;
  }

  ProjectConfig &config_;
  Program &program_;
  std::unordered_map<Ident, const Decl *> programs_;
  std::unordered_map<Ident, const Decl *> others_;
  std::unordered_map<Ident, Span> instances_;
  std::unordered_map<Ident, bool> plain_; ///< programs called under their own names
  std::vector<VarDecl *> variables_;
  std::vector<Decl *> declarations_;
};

} // namespace

ast::File *readConfigurations(ProjectConfig &config, const std::vector<ast::File *> &files,
                              Program &program) {
  return ConfigurationReader(config, program).read(files);
}

} // namespace stc
