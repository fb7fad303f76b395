// NAMESPACE, USING and CONFIGURATION.
#include "compiler/syntax/file_parser.hpp"

#include "compiler/syntax/token_sets.hpp"

namespace stc {

namespace {

/// Deepest nesting of namespaces.
constexpr size_t kMaxSpaces = 32;

} // namespace

// -----------------------------------------------------------------------------------------------
// namespaces

void FileParser::namespaceHead() {
  const uint32_t begin = now_.begin;
  unit_.clear();
  take();
  while (isModifier(now_.type))
    take();
  while (now_.type == Tok::IDENT || now_.type == Tok::DOT) {
    const bool name = now_.type == Tok::IDENT;
    take();
    if (name && now_.type == Tok::IDENT)
      break;
  }
  OpenNamespace open{space_.size(), usings_.size(), {file_.id(), begin, unit_.back().end}};
  auto *unit = parseUnit(&Grammar::namespaceUnit);
  if (unit != nullptr && !unit->children.empty())
    for (const ast::Name &name :
         builder_.namespaceNames(static_cast<Grammar::NamespaceHeadContext *>(unit->children[0])))
      space_.push_back(name);
  if (space_.size() > kMaxSpaces) { // each declaration has the whole path
    diagnostics_.report(Code::TooDeep, open.head, "namespaces are nested too deeply",
                        "deeper than " + std::to_string(kMaxSpaces));
    space_.resize(kMaxSpaces);
  }
  spaceNow_ = arena_.copy(space_);
  namespaces_.push_back(open);
  closers_.push_back(Tok::END_NAMESPACE);
}

void FileParser::namespaceEnd() {
  advance();
  space_.resize(namespaces_.back().names);
  usings_.resize(namespaces_.back().usings);
  spaceNow_ = arena_.copy(space_);
  usingsNow_ = arena_.copy(usings_);
  namespaces_.pop_back();
  closers_.pop_back();
}

void FileParser::usingDirective(std::vector<ast::NamePath> &out) {
  readToSemicolon();
  auto *unit = parseUnit(&Grammar::usingUnit);
  if (unit != nullptr && !unit->children.empty())
    builder_.usings(static_cast<Grammar::UsingDirectiveContext *>(unit->children[0]), out);
}

/// Takes what stands up to the next `;` into the unit.
void FileParser::readToSemicolon() {
  unit_.clear();
  do
    take();
  while (now_.type != Tok::SEMICOLON && !endsUnit() && !startsSection() &&
         !(startsDeclaration() && ahead_.type != Tok::COLON) && !isMember(now_.type));
  if (now_.type == Tok::SEMICOLON)
    take();
}

// -----------------------------------------------------------------------------------------------
// configurations

bool FileParser::resourcePart(std::vector<ast::TaskDecl> &tasks,
                              std::vector<ast::ProgramInstanceDecl> &programs) {
  if (now_.type == Tok::SEMICOLON) {
    advance();
    return true;
  }
  if (now_.type == Tok::VAR_GLOBAL || now_.type == Tok::VAR_CONFIG ||
      now_.type == Tok::VAR_ACCESS) {
    globals();
    return true;
  }
  if (isNow("task") && ahead_.type == Tok::IDENT) {
    now_.type = Tok::TASK;
    readToSemicolon();
    auto *unit = parseUnit(&Grammar::taskUnit);
    if (unit != nullptr && !unit->children.empty())
      builder_.task(static_cast<Grammar::TaskDeclarationContext *>(unit->children[0]), tasks);
    return true;
  }
  if (now_.type != Tok::PROGRAM)
    return false;
  readToSemicolon();
  // Words that have a meaning only here.
  for (size_t i = 1; i < unit_.size(); ++i) {
    if (unit_[i].type != Tok::IDENT || unit_[i - 1].type == Tok::COLON)
      continue;
    const std::string_view word = scanner_.text(unit_[i]);
    const bool nameNext = i + 1 < unit_.size() && unit_[i + 1].type == Tok::IDENT;
    if (i == 1 && nameNext && isWord(word, "retain"))
      unit_[i].type = Tok::RETAIN;
    else if (i == 1 && nameNext && isWord(word, "non_retain"))
      unit_[i].type = Tok::NON_RETAIN;
    else if (unit_[i - 1].type == Tok::IDENT && isWord(word, "with")) {
      if (!nameNext) {
        const Span with{file_.id(), unit_[i].begin, unit_[i].end};
        diagnostics_
            .report(Code::ExpectedToken, with, "the name of a task is missing after `WITH`",
                    "which task calls the program?")
            .help(
                "write `PROGRAM p WITH Task : Type;` with a TASK of this RESOURCE; without a task "
                "leave `WITH` out");
        return true;
      }
      unit_[i].type = Tok::WITH;
    }
  }
  auto *unit = parseUnit(&Grammar::instanceUnit);
  if (unit != nullptr && !unit->children.empty())
    builder_.programInstance(static_cast<Grammar::ProgramInstanceContext *>(unit->children[0]),
                             programs);
  return true;
}

/// Skips what is no part of a configuration; false at its end.
bool FileParser::strayPart(const char *end) {
  if (endsUnit() || startsDeclaration() || isMember(now_.type) || isNow("resource"))
    return false;
  diagnostics_.report(Code::UnexpectedToken, span(now_),
                      "expected RESOURCE, TASK, PROGRAM, VAR_… or `" + std::string(end) +
                          "`, found `" + std::string(scanner_.text(now_).substr(0, 40)) + "`",
                      "not a part of a CONFIGURATION");
  do
    advance();
  while (now_.type != Tok::SEMICOLON && !endsUnit() && !startsDeclaration() && !isNow("resource") &&
         !isNow("task"));
  return true;
}

void FileParser::resource(std::vector<ast::ResourceDecl> &out) {
  const Token start = now_;
  now_.type = Tok::RESOURCE;
  unit_.clear();
  take();
  if (now_.type == Tok::IDENT)
    take();
  if (isNow("on")) {
    now_.type = Tok::ON;
    take();
    if (now_.type == Tok::IDENT)
      take();
  }
  ast::ResourceDecl node;
  node.span = {file_.id(), start.begin, unit_.back().end};
  auto *unit = parseUnit(&Grammar::resourceUnit);
  if (unit != nullptr && !unit->children.empty())
    builder_.resourceHead(static_cast<Grammar::ResourceHeadContext *>(unit->children[0]), node);
  std::vector<ast::TaskDecl> tasks;
  std::vector<ast::ProgramInstanceDecl> programs;
  while (resourcePart(tasks, programs) || strayPart("END_RESOURCE")) {
  }
  node.tasks = arena_.copy(tasks);
  node.programs = arena_.copy(programs);
  if (now_.type == Tok::END_RESOURCE)
    advance();
  else
    missing_.push_back({Tok::END_RESOURCE, node.span, span(now_)});
  out.push_back(node);
}

void FileParser::configuration() {
  const Token start = now_;
  ++units_;
  unit_.clear();
  advance();
  auto *node = arena_.make<ast::ConfigurationDecl>();
  node->attributes = builder_.attributes(start);
  node->doc = builder_.doc(start);
  node->name = builder_.name(now_);
  node->span = span(start).to(node->name.span);
  advance();
  add(node); // before its variables
  std::vector<ast::ResourceDecl> resources;
  ast::ResourceDecl direct; // tasks and programs without a resource
  direct.span = node->span;
  std::vector<ast::TaskDecl> tasks;
  std::vector<ast::ProgramInstanceDecl> programs;
  for (;;) {
    if (isNow("resource") && ahead_.type == Tok::IDENT) {
      resource(resources);
    } else if (!resourcePart(tasks, programs) && !strayPart("END_CONFIGURATION")) {
      break;
    }
  }
  if (!tasks.empty() || !programs.empty()) {
    direct.tasks = arena_.copy(tasks);
    direct.programs = arena_.copy(programs);
    resources.push_back(direct);
  }
  node->resources = arena_.copy(resources);
  if (now_.type == Tok::END_CONFIGURATION)
    advance();
  else
    missing_.push_back({Tok::END_CONFIGURATION, node->span, span(now_)});
  reportMissingEnds();
}

} // namespace stc
