#include "compiler/import/libraries.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/st_words.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace stc::import {

namespace {

std::set<std::string> usedNames(const Model &model) {
  std::set<std::string> used;
  for (const Object &object : model.objects)
    for (const StWord &word : wordsOf(object.text))
      if (word.kind == StWord::Kind::Name)
        used.insert(
            lowerCase(std::string_view(object.text).substr(word.begin, word.end - word.begin)));
  return used;
}

std::string listed(const std::vector<std::string> &names) {
  std::string text;
  for (const std::string &name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// `STANDARD.LIB`: standard
std::string plainName(std::string_view name) {
  std::string lower = lowerCase(name);
  if (lower.ends_with(".lib"))
    lower.resize(lower.size() - 4);
  return lower;
}

/// A library of which it is not known what it holds.
void lookUpByName(const LibraryReference &library, Model &model, const OwnLibraries &own) {
  const std::string what = "library " + library.name;
  if (own.isLibrary(plainName(library.name)))
    model.changed.push_back({library.origin, what, "Stride has a library of this name"});
  else
    model.notes.push_back(fmt::format(
        "{} is not among Stride's libraries ({}:{}); names that are missing because of it are "
        "errors of the check. Import its project with --library and add it by [[library]].",
        library.name, library.origin.file, library.origin.line));
}

} // namespace

LibraryReference libraryNamed(std::string_view text, Origin origin) {
  const size_t comma = std::min(text.find(','), text.size());
  const std::string_view rest = text.substr(std::min(comma + 1, text.size()));
  return {std::string(trimmed(text.substr(0, comma))),
          std::string(trimmed(rest.substr(0, rest.find_first_of(",(")))),
          std::move(origin),
          {}};
}

void lookUpLibraries(Model &model, const OwnLibraries &own) {
  if (model.libraries.empty())
    return;
  const std::set<std::string> used = usedNames(model);
  std::set<std::string> objects;
  for (const Object &object : model.objects)
    objects.insert(lowerCase(object.name));
  std::set<std::string> seen;
  for (const LibraryReference &library : model.libraries) {
    if (!seen.insert(plainName(library.name)).second)
      continue;
    if (library.contents.empty()) {
      lookUpByName(library, model, own);
      continue;
    }
    std::vector<std::string> here;
    std::vector<std::string> missing;
    for (const std::string &name : library.contents)
      if (const std::string lower = lowerCase(name);
          used.contains(lower) && !objects.contains(lower))
        (own.declares(lower) ? here : missing).push_back(name);
    const std::string what = "library " + library.name;
    if (!missing.empty())
      model.leftOut.push_back(
          {library.origin, what,
           fmt::format("used of it, and not in Stride: {}; import the library's project with "
                       "--library, or write them",
                       listed(missing))});
    else if (here.empty())
      model.changed.push_back({library.origin, what, "dropped: nothing of it is used"});
    else
      model.changed.push_back(
          {library.origin, what, fmt::format("replaced by Stride's: {}", listed(here))});
  }
}

} // namespace stc::import
