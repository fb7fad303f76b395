#include "compiler/cli/trace_types.hpp"

#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"
#include "compiler/project/run_socket.hpp"
#include "compiler/semantics/lookup/lookup.hpp"
#include "compiler/source/identifier.hpp"

#include <filesystem>

namespace stc::cli {

namespace fs = std::filesystem;

namespace {

bool isNamed(const Symbol &symbol, std::string_view name) {
  return equalIgnoringCase(symbol.name.text, name);
}

const VarSymbol *findIn(const std::vector<const Symbol *> &symbols, std::string_view name) {
  for (const Symbol *symbol : symbols)
    if (symbol->kind == SymbolKind::Variable && isNamed(*symbol, name))
      return static_cast<const VarSymbol *>(symbol);
  return nullptr;
}

/// The parts of `GVL.a[1,2].b^.c` as names, with `[` for each index.
std::vector<std::string> stepsOf(std::string_view path) {
  std::vector<std::string> steps;
  std::string name;
  const auto finish = [&] {
    if (!name.empty())
      steps.push_back(name);
    name.clear();
  };
  bool inside = false;
  for (const char c : path) {
    if (c == '[' || (inside && c == ',')) {
      finish();
      steps.emplace_back("[");
      inside = true;
    } else if (c == ']') {
      inside = false;
    } else if (c == '.') {
      finish();
    } else if (!inside && c != '^') {
      name += c;
    }
  }
  finish();
  return steps;
}

const Type *followed(const Type *type) {
  while (type->kind == TypeKind::Pointer || type->kind == TypeKind::Reference)
    type = typeAs<PointerType>(type)->pointee;
  return type;
}

/// Where a path begins; `step` is after what stands for it.
const Type *rootOf(const Program &program, const std::vector<std::string> &steps, size_t &step) {
  step = 1;
  for (const PouSymbol *pou : program.user->pous)
    if (pou->type != nullptr && isNamed(*pou, steps[0]))
      return pou->type;
  for (const GlobalsSymbol *list : program.user->globals) {
    for (const VarSymbol *variable : list->variables)
      if (isNamed(*variable, steps[0]))
        return variable->type;
    if (steps.size() < 2 || !isNamed(*list, steps[0]))
      continue;
    for (const VarSymbol *variable : list->variables)
      if (isNamed(*variable, steps[1])) {
        step = 2;
        return variable->type;
      }
  }
  return nullptr;
}

const Type *typeOf(const Program &program, std::string_view path) {
  const std::vector<std::string> steps = stepsOf(path);
  if (steps.empty())
    return nullptr;
  size_t step = 0;
  const Type *type = rootOf(program, steps, step);
  for (; type != nullptr && step < steps.size(); ++step) {
    if (steps[step] == "[") {
      type = indexStep(followed(type));
      continue;
    }
    const VarSymbol *member = findIn(Lookup::members(followed(type)), steps[step]);
    type = member == nullptr ? nullptr : member->type;
  }
  return type == nullptr ? nullptr : followed(type);
}

std::optional<plot::ColumnType> columnType(const Program &program, const std::string &path) {
  const Type *type = typeOf(program, path);
  if (type == nullptr || isError(type))
    return std::nullopt;
  plot::ColumnType result;
  if (type->kind == TypeKind::Boolean)
    result.kind = plot::ColumnType::Kind::Bool;
  if (type->kind == TypeKind::Enumeration) {
    result.kind = plot::ColumnType::Kind::State;
    for (const EnumeratorSymbol *one : typeAs<EnumType>(type)->enumerators)
      result.states.emplace(one->value, one->name.text);
  }
  return result;
}

/// A member of a drive has the drive's unit; anything else that of all drives, where they agree.
std::string unitOf(const std::vector<std::pair<std::string, std::string>> &units,
                   std::string_view path) {
  const std::string_view first = path.substr(0, path.find('.'));
  bool same = !units.empty();
  for (const auto &[drive, unit] : units) {
    if (equalIgnoringCase(drive, first))
      return unit;
    same = same && unit == units.front().second;
  }
  return same ? units.front().second : std::string();
}

/// The project to ask; empty: none.
fs::path projectOf(const std::string &named, const std::string &file) {
  if (!named.empty())
    return named;
  std::error_code error;
  for (const fs::path &folder : {fs::path(file).parent_path(), fs::path()})
    if (fs::path place = projectPlace(folder); fs::exists(place / "stride.toml", error))
      return place;
  return {};
}

} // namespace

void describeTrace(plot::Trace &trace, const std::string &project, const std::string &file) {
  const fs::path place = projectOf(project, file);
  if (place.empty())
    return;
  const EmbeddedLibraryIndex index(standardLibrary());
  const Project known(place, Purpose::Check, {}, index);
  if (known.hasErrors())
    return;
  plot::describeColumns(
      trace, [&](const std::string &name) { return columnType(known.program(), name); },
      [units = known.units()](const std::string &name) { return unitOf(units, name); });
}

} // namespace stc::cli
