// CONFIGURATION … END_CONFIGURATION: tasks and program instances, into what stride.toml's [[task]]
// gives. An instance with a name of its own becomes a variable of the program's type; with
// arguments, a hidden program that calls it.

#include "compiler/project/config.hpp"
#include "compiler/project/interval.hpp"
#include "compiler/project/names.hpp"
#include "compiler/semantics/suggest.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <unordered_map>

namespace stc {

namespace {

using namespace ast;

constexpr std::int64_t kMinIntervalNs = 1'000;
constexpr std::int64_t kMaxIntervalNs = 3'600'000'000'000;
constexpr unsigned kLowestPriority = 31;

class ConfigurationReader {
public:
  ConfigurationReader(ProjectConfig &config, Program &program)
      : config_(config), program_(program) {}

  File *read(const std::vector<File *> &files) {
    const ConfigurationDecl *first = nullptr;
    for (File *file : files) {
      for (Decl *decl : file->declarations) {
        if (decl->kind == DeclKind::program)
          programs_.emplace(decl->name.id, decl);
        else if (decl->name && decl->kind != DeclKind::globals)
          others_.emplace(decl->name.id, decl);
        if (decl->kind != DeclKind::configuration)
          continue;
        if (first != nullptr) {
          report(Code::configurationTwice, decl->name.span, "there are two CONFIGURATIONs",
                 "the second one")
              .label(first->name.span, "the first one")
              .help("put all resources into one");
          continue;
        }
        first = as<ConfigurationDecl>(decl);
      }
    }
    if (first == nullptr || !hasTasks(*first))
      return nullptr;
    if (!config_.tasks.empty()) {
      Diagnostic &d = report(Code::configurationTwice, first->name.span,
                             "the tasks are configured twice", "a CONFIGURATION …");
      d.label(config_.tasks.front().name.span, "… and [[task]] in stride.toml");
      d.help("remove one of the two");
      return nullptr;
    }
    for (const ResourceDecl &resource : first->resources)
      readResource(resource);
    if (declarations_.empty() && variables_.empty())
      return nullptr;
    if (!variables_.empty()) {
      auto *list = program_.arena.make<GlobalsDecl>();
      list->kind = DeclKind::globals;
      list->name = first->name;
      list->span = first->span;
      for (VarDecl *variable : variables_) {
        // A program that is called under its own name as well has its own variables.
        if (plain_.contains(as<NamedTypeExpr>(variable->type)->path.back().id))
          variable->attributes = attribute(kProgramInstance, "also");
      }
      list->variables = program_.arena.copy(variables_);
      declarations_.insert(declarations_.begin(), list);
    }
    auto *file = program_.arena.make<File>();
    file->id = first->span.file;
    file->declarations = program_.arena.copy(declarations_);
    return file;
  }

private:
  Diagnostic &report(Code code, Span where, std::string message, std::string label) {
    return program_.diagnostics.report(code, where, std::move(message), std::move(label));
  }

  static bool hasTasks(const ConfigurationDecl &configuration) {
    return std::any_of(
        configuration.resources.begin(), configuration.resources.end(),
        [](const ResourceDecl &r) { return !r.tasks.empty() || !r.programs.empty(); });
  }

  Attributes attribute(std::string_view name, std::string_view value) {
    return program_.arena.copy(std::vector<Attribute>{{name, value, {}}});
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
        report(Code::configurationTask, decl.name.span,
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
          a.value != nullptr && a.value->kind == ExprKind::literal ? as<Literal>(a.value) : nullptr;
      if (name == "interval") {
        hasInterval = true;
        bad = !readInterval(a, literal, task) || bad;
      } else if (name == "priority") {
        if (literal == nullptr || literal->literal != LiteralKind::integer ||
            literal->integer > kLowestPriority)
          report(Code::configurationTask, a.span, "a PRIORITY is a number from 0 to 31",
                 "0 is the highest");
        else
          task.priority = static_cast<unsigned>(literal->integer);
      } else if (name == "single") {
        bad = true;
        report(Code::configurationTask, a.span,
               fmt::format("the task `{}` is started by an event, which is not available",
                           task.name.text),
               "SINGLE")
            .help("give it an INTERVAL, and look for the rising edge with R_TRIG in its program");
      } else {
        Diagnostic &d = report(Code::configurationTask, a.span, "a TASK has no such property",
                               "not INTERVAL, PRIORITY or SINGLE");
        if (const auto near = nearest(name, {"INTERVAL", "PRIORITY", "SINGLE"}); !near.empty())
          d.help(fmt::format("did you mean `{}`?", near));
        bad = true;
      }
    }
    if (!hasInterval && !bad)
      report(Code::configurationTask, decl.name.span,
             fmt::format("the task `{}` has no INTERVAL", task.name.text), "how often does it run?")
          .help(
              fmt::format("write `TASK {} (INTERVAL := T#10ms, PRIORITY := 1);`", task.name.text));
    config_.tasks.push_back(std::move(task));
  }

  bool readInterval(const Argument &a, const Literal *literal, TaskConfig &task) {
    std::int64_t ns = 0;
    if (literal != nullptr && literal->literal == LiteralKind::time)
      ns = static_cast<std::int64_t>(literal->integer) * 1'000'000;
    else if (literal != nullptr && literal->literal == LiteralKind::ltime)
      ns = static_cast<std::int64_t>(literal->integer);
    if (ns >= kMinIntervalNs && ns <= kMaxIntervalNs) {
      task.intervalNs = ns;
      return true;
    }
    report(Code::configurationTask, a.span, "an INTERVAL is a duration from 1 µs to one hour",
           literal == nullptr ? "a literal is expected here" : "not such a duration")
        .help("write `INTERVAL := T#10ms`");
    return false;
  }

  TaskConfig *findTask(const ProgramInstanceDecl &instance, const ResourceDecl &resource) {
    if (!instance.task) { // runs when nothing else does
      constexpr std::string_view kName = "Background";
      for (TaskConfig &task : config_.tasks)
        if (task.name.text == kName && task.freewheeling)
          return &task;
      TaskConfig task;
      task.name.text = kName;
      task.priority = kLowestPriority;
      task.freewheeling = true;
      config_.tasks.push_back(std::move(task));
      return &config_.tasks.back();
    }
    std::vector<std::string_view> names;
    for (const TaskDecl &task : resource.tasks)
      names.push_back(task.name.text);
    for (TaskConfig &task : config_.tasks)
      if (equalIgnoringCase(task.name.text, instance.task.text))
        return &task;
    Diagnostic &d = report(Code::configurationTask, instance.task.span,
                           fmt::format("there is no task `{}`", instance.task.text), "not found");
    if (const auto near = nearest(instance.task.text, names); !near.empty())
      d.help(fmt::format("did you mean `{}`?", near));
    return nullptr;
  }

  void readProgram(const ProgramInstanceDecl &decl, const ResourceDecl &resource) {
    const Name type = decl.type.empty() ? decl.name : decl.type.back();
    if (const auto [first, fresh] = instances_.emplace(decl.name.id, decl.name.span); !fresh) {
      report(Code::configurationProgram, decl.name.span,
             fmt::format("two programs are named `{}`", decl.name.text), "named again")
          .label(first->second, "the first one");
      return;
    }
    if (!programs_.contains(type.id)) {
      unknownProgram(type);
      return;
    }
    TaskConfig *task = findTask(decl, resource);
    if (task == nullptr)
      return;
    const bool own = decl.name.id != type.id;
    if (own && (programs_.contains(decl.name.id) || others_.contains(decl.name.id))) {
      const auto other = programs_.find(decl.name.id);
      report(Code::configurationProgram, decl.name.span,
             fmt::format("the instance `{}` has the name of something else", decl.name.text),
             "another name is needed")
          .label(other != programs_.end() ? other->second->name.span
                                          : others_.at(decl.name.id)->name.span,
                 "declared here");
      return;
    }
    if (own) {
      auto *path = program_.arena.make<NamedTypeExpr>();
      path->kind = TypeExprKind::named;
      path->span = type.span;
      path->path = program_.arena.copy(std::vector<Name>{type});
      auto *variable = program_.arena.make<VarDecl>();
      variable->name = decl.name;
      variable->section = Section::global;
      variable->qualifiers = decl.qualifiers;
      variable->type = path;
      variable->attributes = attribute(kProgramInstance, {});
      variables_.push_back(variable);
    } else {
      plain_.emplace(type.id, true);
    }
    task->programs.push_back(
        {own || !decl.arguments.empty() ? caller(decl) : std::string(type.text), decl.name.span});
  }

  void unknownProgram(const Name &type) {
    const auto other = others_.find(type.id);
    Diagnostic &d = report(
        other == others_.end() ? Code::configUnknownProgram : Code::configNotAProgram, type.span,
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

  /// A hidden program with the statement `instance(arguments);`.
  std::string caller(const ProgramInstanceDecl &decl) {
    Arena &arena = program_.arena;
    auto *callee = arena.make<NameExpr>();
    callee->kind = ExprKind::name;
    callee->span = decl.name.span;
    callee->name = decl.name;
    auto *call = arena.make<CallExpr>();
    call->kind = ExprKind::call;
    call->span = decl.span;
    call->callee = callee;
    call->arguments = decl.arguments;
    auto *statement = arena.make<CallStmt>();
    statement->kind = StmtKind::call;
    statement->span = decl.span;
    statement->expr = call;
    auto *pou = arena.make<PouDecl>();
    pou->kind = DeclKind::program;
    pou->span = decl.span;
    const std::string name = std::string(decl.name.text) + "__call";
    pou->name = {program_.interner.intern(name), arena.copy(std::string_view(name)),
                 decl.name.span};
    pou->attributes = attribute("hide", {});
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
