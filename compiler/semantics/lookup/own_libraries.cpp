// Libraries of the user's own.

#include "compiler/semantics/lookup/lookup.hpp"
#include "compiler/syntax/st_text.hpp"

namespace stc {

void Lookup::declareOwnLibraries() {
  const auto use = [this](Library &user, const std::vector<LibrarySource::Use> &uses) {
    for (const LibrarySource::Use &one : uses)
      user.uses.push_back({one.name, module(one.library).library});
  };
  for (const LibrarySource &source : program_.librarySources) {
    Module &target = module(source.name);
    own_.emplace(lowerCase(source.name), &target);
    target.library->isOwn = true;
    target.library->isBuilt = true;
    target.library->qualifiedOnly = source.qualifiedOnly;
    target.library->pack = source.pack;
    target.library->truncIsInt = source.truncIsInt;
    use(*target.library, source.uses);
    for (ast::File *file : source.files)
      declare(target, file);
  }
  use(*module("").library, program_.uses);
  if (!program_.ownNamespace.empty())
    own_.emplace(lowerCase(program_.ownNamespace), &module(""));
}

const Module *Lookup::ownModule(std::string_view lowerName) const {
  const auto found = own_.find(std::string(lowerName));
  return found == own_.end() ? nullptr : found->second;
}

std::string Lookup::ownLibrary(const Scope &scope, std::string_view lowerName) const {
  const Library *here = scope.module->library;
  const std::string &own = here->isUser ? program_.ownNamespace : here->name;
  if ((here->isUser || here->isOwn) && equalIgnoringCase(own, lowerName))
    return own;
  for (const UsedLibrary &used : here->uses)
    if (equalIgnoringCase(used.name, lowerName))
      return used.library->name;
  return {};
}

Found Lookup::inOwnLibraries(const Scope &scope, Ident id) const {
  Found found;
  for (const UsedLibrary &used : scope.module->library->uses) {
    const Library *library = used.library;
    if (!library->isOwn) // one of Stride's, whose names are loaded on demand
      continue;
    Symbol *here = library->qualifiedOnly ? nullptr : modules_.at(library->name)->find(id);
    if (here == nullptr || isForeign(scope, here))
      continue;
    (found.symbol == nullptr ? found.symbol : found.other) = here;
  }
  return found;
}

} // namespace stc
