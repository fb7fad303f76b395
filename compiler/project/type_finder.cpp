#include "compiler/project/type_finder.hpp"

#include "compiler/syntax/parser.hpp"

namespace stc {

const ast::Decl *typeIn(const std::vector<ast::File *> &files, std::string_view lower) {
  for (const ast::File *file : files)
    for (const ast::Decl *decl : file->declarations)
      if (decl->kind != ast::DeclKind::Globals && lowerCase(decl->name.text) == lower)
        return decl;
  return nullptr;
}

const ast::Decl *TypeFinder::find(std::string_view lower) {
  for (const LibrarySource &library : program_.librarySources)
    if (const ast::Decl *found = typeIn(library.files, lower))
      return found;
  const std::vector<LibraryIndex::Entry> entries = index_.find(lower);
  if (entries.empty())
    return nullptr;
  auto [at, isNew] = parsed_.try_emplace(std::string(entries.front().fileName));
  if (isNew) {
    ParseOptions options;
    options.generated = true;
    at->second =
        parse(program_.sources.file(program_.sources.add(std::string(entries.front().fileName),
                                                         std::string(entries.front().text))),
              program_.interner, program_.arena, program_.diagnostics, &options);
  }
  return typeIn({at->second}, lower);
}

} // namespace stc
