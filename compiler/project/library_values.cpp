#include "compiler/project/library_values.hpp"

#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/st_text.hpp"

namespace stc {

namespace {

/// The expression that a text is, its place being that of the value; null: it is none.
ast::Expr *expressionOf(Program &program, const std::string &text, Span place) {
  SyntheticSource source("<parameters>");
  source.add("VAR_GLOBAL CONSTANT\n  value : INT := ");
  source.add(text, place);
  source.add(";\nEND_VAR\n");
  Diagnostics unread; // who asks for the value says what is wrong with it
  ParseOptions options;
  options.generated = true;
  const ast::File *file = parse(program.sources.file(program.sources.add(source)), program.interner,
                                program.arena, unread, &options);
  if (unread.hasErrors() || file->declarations.size() != 1 ||
      file->declarations[0]->kind != ast::DeclKind::Globals)
    return nullptr;
  const auto *list = ast::as<ast::GlobalsDecl>(file->declarations[0]);
  return list->variables.size() == 1 ? list->variables[0]->init : nullptr;
}

std::string inQuotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '$' || c == '\'')
      out += '$';
    if (c == '\n')
      out += "$N";
    else
      out += c;
  }
  return out + "'";
}

} // namespace

void takeLibraryValues(Program &program, const LibraryUse &use, const std::string &library) {
  for (const LibraryValue &value : use.parameters) {
    ParameterValue taken;
    taken.library = library;
    taken.list = lowerCase(value.list);
    taken.name = value.name.text;
    taken.place = value.name.span;
    taken.value = expressionOf(program, value.text, value.span);
    if (value.isText)
      taken.quoted = expressionOf(program, inQuotes(value.text), value.span);
    program.parameters.push_back(taken);
  }
}

} // namespace stc
