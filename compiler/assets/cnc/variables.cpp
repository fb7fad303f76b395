// Variables of the project that CNC programs name: their types and their initial values.

#include "compiler/assets/cnc/internal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace stc {

namespace {

using stride::cnc::VariableType;

/// How far types may lead to others.
constexpr int kDeepest = 32;

template <class Variables>
const ast::VarDecl *find(const Variables &variables, std::string_view lower) {
  for (const ast::VarDecl *variable : variables)
    if (lowerCase(variable->name.text) == lower)
      return variable;
  return nullptr;
}

/// `list`: of the list of globals, or the program, of this name; empty: any list.
const ast::VarDecl *findIn(const ast::Decl &decl, std::string_view list, std::string_view lower) {
  if (!decl.space.empty())
    return nullptr;
  if (decl.kind == ast::DeclKind::Globals && (list.empty() || lowerCase(decl.name.text) == list))
    return find(ast::as<ast::GlobalsDecl>(&decl)->variables, lower);
  if (decl.kind == ast::DeclKind::Program && !list.empty() && lowerCase(decl.name.text) == list)
    return find(ast::as<ast::PouDecl>(&decl)->variables, lower);
  return nullptr;
}

const ast::VarDecl *findIn(const std::vector<ast::File *> &files, std::string_view list,
                           std::string_view lower) {
  for (const ast::File *file : files)
    for (const ast::Decl *decl : file->declarations)
      if (const ast::VarDecl *variable = findIn(*decl, list, lower))
        return variable;
  return nullptr;
}

/// `stData.aPos[3, -1].rX` as its parts.
struct PathPart {
  std::string name;             ///< Lower case; empty: an element.
  std::vector<int64_t> indices; ///< Of an element.
};

class PathReader {
public:
  explicit PathReader(std::string_view text) : text_(text) {}

  /// Empty: it is no path.
  std::vector<PathPart> read() {
    std::vector<PathPart> parts;
    do {
      PathPart part{std::string(name()), {}};
      if (part.name.empty())
        return {};
      parts.push_back(std::move(part));
      while (take('[')) {
        PathPart element;
        do {
          const std::optional<int64_t> index = number();
          if (!index)
            return {};
          element.indices.push_back(*index);
        } while (take(','));
        if (!take(']'))
          return {};
        parts.push_back(std::move(element));
      }
    } while (take('.'));
    return text_.empty() ? parts : std::vector<PathPart>();
  }

private:
  void blanks() {
    while (!text_.empty() && text_.front() == ' ')
      text_.remove_prefix(1);
  }

  bool take(char c) {
    blanks();
    if (text_.empty() || text_.front() != c)
      return false;
    text_.remove_prefix(1);
    blanks();
    return true;
  }

  std::string name() {
    size_t end = 0;
    while (end < text_.size() && text_.find_first_of(".[], ", end) != end)
      ++end;
    std::string name = lowerCase(text_.substr(0, end));
    text_.remove_prefix(end);
    return name;
  }

  std::optional<int64_t> number() {
    int64_t value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc())
      return std::nullopt;
    text_.remove_prefix(static_cast<size_t>(end - text_.data()));
    return value;
  }

  std::string_view text_;
};

/// A place in the application, and what stands there at the beginning.
struct Place {
  const ast::TypeExpr *type = nullptr;
  const ast::Expr *init = nullptr; ///< null: the type's default
};

class Resolver {
public:
  Resolver(const std::vector<ast::File *> &files, const CncTypes &types)
      : files_(files), types_(types) {}

  std::optional<CncVariable> resolve(std::string_view name) {
    const std::vector<PathPart> parts = PathReader(name).read();
    if (parts.empty())
      return std::nullopt;
    size_t next = 1;
    const ast::VarDecl *variable = findIn(files_, {}, parts[0].name);
    if (variable == nullptr && parts.size() > 1 && !parts[1].name.empty())
      variable = findIn(files_, parts[0].name, parts[next++].name);
    if (variable == nullptr && parts.size() == 1 && parts[0].name == "gsmc_mparameters")
      return CncVariable{VariableType::Structure, CncInitial{}};
    if (variable == nullptr)
      return std::nullopt;
    Place place{variable->type, variable->init};
    for (; next < parts.size(); ++next)
      if (!(parts[next].name.empty() ? element(place, parts[next].indices)
                                     : member(place, parts[next].name)))
        return std::nullopt;
    return variableAt(place);
  }

private:
  /// Where the name of a type leads: through aliases to a structure, block or elementary type.
  const ast::Decl *follow(Place &place) {
    for (int depth = 0; depth < kDeepest; ++depth) {
      if (place.type == nullptr || place.type->kind != ast::TypeExprKind::Named)
        return nullptr;
      const auto *named = ast::as<ast::NamedTypeExpr>(place.type);
      const std::string lower =
          named->path.empty() ? std::string() : lowerCase(named->path.back().text);
      const ast::Decl *decl = declarationOf(lower);
      if (decl == nullptr || decl->kind != ast::DeclKind::Alias)
        return decl;
      const auto *alias = ast::as<ast::AliasDecl>(decl);
      place = {alias->type, place.init != nullptr ? place.init : alias->init};
    }
    return nullptr;
  }

  const ast::Decl *declarationOf(const std::string &lower) {
    for (const ast::File *file : files_)
      for (const ast::Decl *decl : file->declarations)
        if (lowerCase(decl->name.text) == lower && decl->kind != ast::DeclKind::Globals)
          return decl;
    return gcode::typeNamed(lower) ? nullptr : types_(lower);
  }

  /// The member of a structure or block, or of what it extends.
  const ast::VarDecl *memberOf(const ast::Decl *decl, const std::string &lower) {
    for (int depth = 0; decl != nullptr && depth < kDeepest; ++depth) {
      ast::NamePath base;
      if (decl->kind == ast::DeclKind::Structure) {
        const auto *structure = ast::as<ast::StructDecl>(decl);
        if (const ast::VarDecl *found = find(structure->fields, lower))
          return found;
        base = structure->base;
      } else if (decl->kind == ast::DeclKind::FunctionBlock || decl->kind == ast::DeclKind::Class) {
        const auto *block = ast::as<ast::PouDecl>(decl);
        if (const ast::VarDecl *found = find(block->variables, lower))
          return found;
        base = block->base;
      }
      decl = base.empty() ? nullptr : declarationOf(lowerCase(base.back().text));
    }
    return nullptr;
  }

  bool member(Place &place, const std::string &lower) {
    const ast::VarDecl *found = memberOf(follow(place), lower);
    if (found == nullptr || found->section == ast::Section::InOut)
      return false;
    const ast::Expr *init = found->init;
    if (place.init != nullptr && place.init->kind == ast::ExprKind::Aggregate)
      for (const ast::AggregateItem &item : ast::as<ast::AggregateExpr>(place.init)->items)
        if (item.value != nullptr && lowerCase(item.field.text) == lower)
          init = item.value;
    place = {found->type, init};
    return true;
  }

  bool element(Place &place, const std::vector<int64_t> &indices) {
    (void)follow(place);
    if (place.type == nullptr || place.type->kind != ast::TypeExprKind::Array)
      return false;
    const auto *array = ast::as<ast::ArrayTypeExpr>(place.type);
    if (array->ranges.size() != indices.size())
      return false;
    uint64_t at = 0;
    for (size_t i = 0; i < indices.size(); ++i) {
      const std::optional<double> low = value(array->ranges[i].low);
      const std::optional<double> high = value(array->ranges[i].high);
      const auto index = static_cast<double>(indices[i]);
      if (!low || !high || index < *low || index > *high)
        return false;
      at = at * static_cast<uint64_t>(*high - *low + 1) + static_cast<uint64_t>(index - *low);
    }
    const ast::Expr *init = nullptr;
    if (place.init != nullptr && place.init->kind == ast::ExprKind::Aggregate)
      init = itemAt(ast::as<ast::AggregateExpr>(place.init)->items, at);
    place = {array->element, init};
    return true;
  }

  /// The value of the element `at`, which is then counted down; null: there is none.
  const ast::Expr *itemAt(std::span<const ast::AggregateItem> items, uint64_t &at) {
    for (const ast::AggregateItem &item : items) {
      const auto times = static_cast<uint64_t>(
          item.repeat == nullptr ? 1 : std::max(value(item.repeat).value_or(0), 0.0));
      if (item.values.empty()) {
        if (at < times)
          return item.value;
        at -= times;
        continue;
      }
      for (uint64_t i = 0; i < times; ++i)
        if (const ast::Expr *found = itemAt(item.values, at))
          return found;
    }
    return nullptr;
  }

  /// A constant expression; nothing: it is none that can be computed before the program is checked.
  std::optional<double> value(const ast::Expr *expression) {
    return gcode::constantOf(expression, [this](std::string_view lower) {
      const ast::VarDecl *found = findIn(files_, {}, lower);
      return found != nullptr && (found->qualifiers & ast::kQualConstant) != 0 ? found : nullptr;
    });
  }

  std::optional<CncVariable> variableAt(Place place) {
    const ast::Decl *decl = follow(place);
    double otherwise = 0; // the value without an initial one
    if (place.type != nullptr && place.type->kind == ast::TypeExprKind::Subrange) {
      const auto *subrange = ast::as<ast::SubrangeTypeExpr>(place.type);
      otherwise = std::min(std::max(value(subrange->low).value_or(0), 0.0),
                           value(subrange->high).value_or(INFINITY));
      place.type = subrange->base;
      decl = follow(place);
    }
    const auto *named = place.type != nullptr && place.type->kind == ast::TypeExprKind::Named
                            ? ast::as<ast::NamedTypeExpr>(place.type)
                            : nullptr;
    if (named == nullptr || named->path.empty())
      return std::nullopt;
    const std::optional<VariableType> type = gcode::typeNamed(lowerCase(named->path.back().text));
    if (!type)
      return std::nullopt;
    if (*type == VariableType::Structure)
      return CncVariable{*type, parametersAt(place)};
    if (decl != nullptr)
      return std::nullopt; // somebody's own type with the name of an elementary one
    CncVariable result{*type, CncInitial{otherwise, {}}};
    if (place.init == nullptr)
      return result;
    if (const std::optional<double> number = value(place.init))
      result.initial->number =
          *type == VariableType::Real ? static_cast<double>(static_cast<float>(*number)) : *number;
    else
      result.initial.reset();
    return result;
  }

  std::optional<CncInitial> parametersAt(const Place &place) {
    CncInitial initial;
    if (place.init == nullptr)
      return initial;
    if (place.init->kind != ast::ExprKind::Aggregate)
      return std::nullopt;
    for (const ast::AggregateItem &item : ast::as<ast::AggregateExpr>(place.init)->items) {
      const std::string field = lowerCase(item.field.text);
      const std::optional<double> number = value(item.value);
      if (!number || field.size() != 3 || !field.starts_with("dp") || field[2] < '1' ||
          field[2] > '8')
        return std::nullopt;
      initial.parameters[static_cast<size_t>(field[2] - '1')] = *number;
    }
    return initial;
  }

  const std::vector<ast::File *> &files_;
  const CncTypes &types_;
};

} // namespace

std::optional<CncVariable> cncVariable(const std::vector<ast::File *> &files, const CncTypes &types,
                                       std::string_view name) {
  return Resolver(files, types).resolve(name);
}

void freezeCnc(CncProgram &program, const std::vector<ast::File *> &files, const CncTypes &types,
               Diagnostics &diagnostics) {
  for (CncWord &word : program.words) {
    if (word.variable.empty())
      continue;
    const std::optional<CncVariable> variable = cncVariable(files, types, word.variable);
    if (!variable)
      continue; // reported with the declarations
    word.initial = variable->initial;
    if (!word.initial)
      diagnostics
          .report(Code::CncVariable, word.span,
                  fmt::format("the initial value of `{}` is not known here", word.variable),
                  "a queue is made before the application runs")
          .help(
              "give the variable a number, or constants with operators and functions like SQRT; or "
              "decode the program while the application runs: `compile = \"program\"`");
  }
}

} // namespace stc
