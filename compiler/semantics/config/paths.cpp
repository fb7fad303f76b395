// The paths of VAR_CONFIG and VAR_ACCESS, `Main.fbs[3].in`.

#include "compiler/semantics/config/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/source/suggest.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

/// The object of a path's first name; null (and reported) when there is none.
static Symbol *pathRoot(Context &c, const Name &name, Module &module) {
  Symbol *symbol = module.find(name.id);
  if (symbol == nullptr) {
    for (const auto &[id, list] : module.lists) {
      const auto it = list->scope.find(name.id);
      if (it != list->scope.end())
        symbol = it->second;
    }
  }
  const bool good =
      symbol != nullptr && (symbol->kind == SymbolKind::Variable ||
                            (symbol->kind == SymbolKind::Pou &&
                             static_cast<PouSymbol *>(symbol)->decl->kind == DeclKind::Program));
  if (good)
    return symbol;
  auto &d = c.report(Code::ConfigPath, name.span,
                     "there is no program or global variable `" + std::string(name.text) + "`",
                     symbol == nullptr ? "not found" : "this is " + describe(symbol));
  std::vector<std::string_view> names;
  for (const auto &[id, other] : module.names) {
    if (other->kind == SymbolKind::Variable ||
        (other->kind == SymbolKind::Pou &&
         static_cast<PouSymbol *>(other)->decl->kind == DeclKind::Program))
      names.push_back(other->name.text);
  }
  std::sort(names.begin(), names.end());
  if (const auto similar = nearest(name.text, names); !similar.empty())
    d.help("a similar name exists: `" + std::string(similar) + "`");
  return nullptr;
}

/// The path of a program's own variable; nothing if it has none of that name.
static std::optional<PathTarget> ownVariable(Context &c, const PouDecl &program, const Name &name,
                                             Module &module) {
  const auto found = module.names.find(program.name.id);
  if (found == module.names.end() || found->second->kind != SymbolKind::Pou)
    return std::nullopt;
  auto *pou = static_cast<PouSymbol *>(found->second);
  declare(c, pou);
  VarSymbol *variable = pou->isTemplate ? nullptr : findMember(c, pou->type, name.id);
  if (variable == nullptr || variable->section == Section::Temp ||
      variable->section == Section::Stat || variable->section == Section::External)
    return std::nullopt;
  PathTarget target;
  target.path = {pou, {{variable, 0}}};
  target.variable = variable;
  target.type = typeOf(c, variable);
  target.isConstant = variable->isConstant;
  return target;
}

/// The path of a program or a global variable, or of a variable of `inside`. `symbol` becomes what
/// the name stands for.
static std::optional<PathTarget> startOfPath(Context &c, const Name &name, Module &module,
                                             const PouDecl *inside, Symbol *&symbol) {
  if (auto own = inside == nullptr ? std::nullopt : ownVariable(c, *inside, name, module)) {
    symbol = own->variable;
    return own;
  }
  Symbol *root = pathRoot(c, name, module);
  symbol = root;
  if (root == nullptr)
    return std::nullopt;
  PathTarget target;
  target.path.root = root;
  if (root->kind == SymbolKind::Variable) {
    target.variable = static_cast<VarSymbol *>(root);
    target.type = typeOf(c, target.variable);
    target.isConstant = target.variable->isConstant;
  } else {
    declare(c, static_cast<PouSymbol *>(root));
    target.type = static_cast<PouSymbol *>(root)->type;
  }
  return target;
}

/// In front may stand the configuration's, a resource's or a variable list's name, or the
/// configuration's and a resource's.
static bool isPrefix(Context &c, Expr *base, const Module &module) {
  const std::unordered_set<Ident> &resources = c.names.configuration().resourceNames;
  if (base->kind == ExprKind::Name) {
    auto *first = as<NameExpr>(base);
    if (module.find(first->name.id) != nullptr)
      return false;
    const auto list = module.lists.find(first->name.id);
    if (list != module.lists.end())
      first->symbol = list->second;
    return list != module.lists.end() || resources.contains(first->name.id);
  }
  if (base->kind != ExprKind::Member)
    return false;
  const auto *second = as<MemberExpr>(base);
  return second->base->kind == ExprKind::Name && second->name &&
         resources.contains(as<NameExpr>(second->base)->name.id) &&
         resources.contains(second->name.id);
}

static std::optional<PathTarget> memberOfPath(Context &c, MemberExpr *member, Module &module,
                                              const PouDecl *inside) {
  auto base = resolvePath(c, member->base, module, inside);
  if (!base || isError(base->type))
    return std::nullopt;
  VarSymbol *found = findMember(c, base->type, member->name.id);
  if (found == nullptr || found->section == Section::InOut || found->section == Section::Temp ||
      found->section == Section::Stat || found->section == Section::External || found->isResult) {
    auto &d =
        c.report(Code::ConfigPath, member->name.span,
                 "`" + typeName(base->type) + "` has no variable `" +
                     std::string(member->name.text) + "`" + (found != nullptr ? " of its own" : ""),
                 "not found");
    if (found == nullptr)
      helpMembers(d, member->name, memberNames(base->type));
    return std::nullopt;
  }
  member->symbol = found;
  base->type = typeOf(c, found);
  base->variable = found;
  base->isConstant = base->isConstant || found->isConstant;
  base->path.steps.push_back({found, 0});
  return base;
}

static std::optional<PathTarget> elementOfPath(Context &c, const IndexExpr *index, Module &module,
                                               const PouDecl *inside) {
  auto base = resolvePath(c, index->base, module, inside);
  for (Expr *i : index->indices) {
    const auto value = constantInteger(c, i, "an index in a path");
    if (!value || !base || isError(base->type))
      return std::nullopt;
    if (base->type->kind != TypeKind::Array) {
      c.report(Code::ConfigPath, index->base->span, typeName(base->type) + " is not an array",
               "cannot be indexed");
      return std::nullopt;
    }
    const auto *array = typeAs<ArrayType>(base->type);
    if (*value < array->low || *value > array->high) {
      c.report(Code::ConfigPath, i->span,
               "index " + std::to_string(*value) + " is outside of the array",
               "the bounds are " + std::to_string(array->low) + ".." + std::to_string(array->high));
      return std::nullopt;
    }
    base->path.steps.push_back({nullptr, static_cast<uint64_t>(*value - array->low)});
    base->type = array->element;
  }
  return base;
}

std::optional<PathTarget> resolvePath(Context &c, Expr *expr, Module &module,
                                      const PouDecl *inside) {
  switch (expr->kind) {
  case ExprKind::Name: {
    auto *name = as<NameExpr>(expr);
    return startOfPath(c, name->name, module, inside, name->symbol);
  }
  case ExprKind::Member: {
    auto *member = as<MemberExpr>(expr);
    if (!member->name)
      break;
    return isPrefix(c, member->base, module)
               ? startOfPath(c, member->name, module, inside, member->symbol)
               : memberOfPath(c, member, module, inside);
  }
  case ExprKind::Index:
    return elementOfPath(c, as<IndexExpr>(expr), module, inside);
  case ExprKind::Error:
    return std::nullopt;
  default:
    break;
  }
  c.report(Code::ConfigPath, expr->span, "this is not the path of a variable",
           "write `Program.instance.variable`");
  return std::nullopt;
}

} // namespace stc::sema
