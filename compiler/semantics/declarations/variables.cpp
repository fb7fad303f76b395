// Variables: VAR sections become symbols with types.

#include "compiler/semantics/declarations/declarations.hpp"

#include "compiler/semantics/attributes.hpp"
#include "compiler/semantics/config/config.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/internal.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/names/names.hpp"
#include "compiler/semantics/types/resolve.hpp"

namespace stc::sema {

using namespace ast;

/// The type of `VAR_INPUT x : ANY_NUM`, which is noted; null: it is declared otherwise.
static const Type *anyInput(Context &c, VarSymbol *variable) {
  const TypeExpr *expr = variable->decl->type;
  if (variable->section != Section::Input || expr->kind != TypeExprKind::Named ||
      as<NamedTypeExpr>(expr)->path.size() != 1)
    return nullptr;
  const Name &name = as<NamedTypeExpr>(expr)->path.front();
  const AnyGroup group = findAnyGroup(name.id->lower);
  if (group == AnyGroup::None || lookupDeclared(c, name) != nullptr)
    return nullptr;
  Symbol *symbol = c.names.inLibrary(c.program.interner.intern("__SYSTEM"),
                                     c.program.interner.intern("AnyType"));
  if (symbol == nullptr || symbol->kind != SymbolKind::Type)
    return nullptr;
  resolve(c, static_cast<TypeSymbol *>(symbol));
  variable->any = group;
  return static_cast<TypeSymbol *>(symbol)->type;
}

const Type *typeOf(Context &c, VarSymbol *variable) {
  if (variable->type != nullptr)
    return variable->type;
  if (variable->typeRunning) {
    c.report(Code::CircularConstant, variable->name.span,
             "the type of `" + std::string(variable->name.text) + "` depends on its own value",
             "declared here");
    variable->type = elementaryType(TypeKind::Error);
    return variable->type;
  }
  variable->typeRunning = true;
  const ModeGuard programs(c.programTypes, isProgramInstance(variable));
  const ScopeGuard guard(c, {&c.names.moduleOf(variable), variable->owner, variable->home});
  const TypeExpr *inOutType = variable->section == Section::InOut ? variable->decl->type : nullptr;
  const ModeGuard openArrays(c.openArrayAllowed, inOutType);
  const Symbol *home =
      variable->owner != nullptr ? static_cast<const Symbol *>(variable->owner) : variable->globals;
  const std::string hint = std::string(home->name.text) + "__" + std::string(variable->name.text);
  const bool ofBlock =
      variable->owner != nullptr && variable->owner->isBlock() &&
      (variable->section == Section::Local || variable->section == Section::Input ||
       variable->section == Section::Output);
  const Type *const any = anyInput(c, variable);
  const Type *type = any != nullptr ? any
                     : ofBlock      ? resolveMember(c, variable, hint)
                                    : resolveType(c, variable->decl->type, hint);
  if (variable->type == nullptr)
    variable->type = type;
  variable->typeRunning = false;
  if (variable->decl->edge != Edge::None && !isError(type) && type->kind != TypeKind::Boolean)
    c.report(Code::TypeMismatch, variable->decl->type->span,
             "only a BOOL has edges, not " + typeName(type), "expected BOOL");
  if (variable->decl->address != nullptr)
    placeVariable(c, variable);
  checkRetain(c, variable);
  return variable->type;
}

void bindExternal(Context &c, PouSymbol *pou, VarDecl *decl) {
  Symbol *global = c.scope.module->find(decl->name.id);
  if (global == nullptr)
    global = lookupInLibraries(c, decl->name);
  if (global == nullptr || global->kind != SymbolKind::Variable) {
    c.report(Code::ExternalMismatch, decl->name.span,
             "there is no global variable `" + std::string(decl->name.text) + "`",
             "declared as external here")
        .help("declare it in a VAR_GLOBAL list");
    return;
  }
  auto *variable = static_cast<VarSymbol *>(global);
  typeOf(c, variable);
  const Type *type = resolveType(c, decl->type, {});
  if (type != variable->type && !isError(type) && !isError(variable->type)) {
    auto &d = c.report(Code::ExternalMismatch, decl->type->span,
                       "`" + std::string(decl->name.text) + "` is " + typeName(variable->type) +
                           ", not " + typeName(type),
                       "this type differs from the global variable's");
    noteDeclaration(d, variable);
  }
  pou->scope.emplace(decl->name.id, variable);
}

VarSymbol *findMember(Context &c, const Type *type, Ident id) {
  if (type->kind == TypeKind::Structure) {
    const auto &fields = typeAs<StructType>(type)->symbol->fields;
    const auto it = fields.find(id);
    return it == fields.end() ? nullptr : it->second;
  }
  if (isInstance(type)) {
    PouSymbol *pou = typeAs<PouType>(type)->symbol;
    declare(c, pou);
    return findVariable(pou, id);
  }
  return nullptr;
}

} // namespace stc::sema
