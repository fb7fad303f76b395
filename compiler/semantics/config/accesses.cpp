// VAR_ACCESS: variables that are named for the outside.

#include "compiler/semantics/config/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>
#include <unordered_map>

namespace stc::sema {

using namespace ast;

/// A part of a variable that lies in the process image, where only the whole has a place.
static bool isInsideOfImage(const AccessPath &access, const VarSymbol *end) {
  const auto inImage = [&](const Symbol *s) {
    return s != nullptr && s != end && s->kind == SymbolKind::Variable &&
           static_cast<const VarSymbol *>(s)->location != nullptr;
  };
  return inImage(access.path.root) ||
         std::any_of(access.path.steps.begin(), access.path.steps.end(), [&](const PathStep &step) {
           return inImage(step.member) || (step.member == nullptr && access.location != nullptr);
         });
}

/// Whether the outside can get at what the path leads to; reports why not.
static bool isAccessible(Context &c, const VarDecl *decl, const AccessPath &access,
                         const VarSymbol *end) {
  const Span at = decl->path->span;
  if (isInsideOfImage(access, end)) {
    c.report(Code::ConfigMismatch, at,
             "an access path cannot lead into a variable of the process image",
             "a part of such a variable")
        .help("give the address of the part: `%MB4`");
    return false;
  }
  if (end != nullptr && end->isBit) {
    c.report(Code::ConfigMismatch, at, "an access path cannot lead to a BIT",
             "a bit has no address")
        .help("declare `" + std::string(end->name.text) + "` as BOOL");
    return false;
  }
  if (access.type->kind != TypeKind::Reference && access.type->kind != TypeKind::Pointer)
    return true;
  c.report(Code::ConfigMismatch, at, "an access path cannot lead to an address",
           "this is " + typeName(access.type));
  return false;
}

static void checkAccess(Context &c, VarDecl *decl, Module &module, const PouDecl *program) {
  const Type *type = resolveType(c, decl->type, "access");
  AccessPath access;
  access.decl = decl;
  if (decl->path->kind == ExprKind::Direct) {
    auto *direct = as<DirectExpr>(decl->path);
    access.type = check(c, direct);
    access.location = direct->location;
  } else if (auto target = resolvePath(c, decl->path, module, program)) {
    access.path = std::move(target->path);
    access.type = target->type;
    if (target->variable != nullptr)
      access.location = target->variable->location;
    if (!isAccessible(c, decl, access, target->variable))
      return;
    if (decl->readWrite && target->isConstant) {
      c.report(Code::ConfigMismatch, decl->path->span, "an access path cannot write a constant",
               "its value never changes")
          .help("leave out READ_WRITE, or write READ_ONLY");
      return;
    }
  }
  if (access.type == nullptr || isError(access.type) || isError(type))
    return;
  if (type == access.type) {
    c.program.accessPaths.push_back(std::move(access));
    return;
  }
  c.report(Code::ConfigMismatch, decl->type->span,
           "`" + std::string(c.program.sources.text(decl->path->span)) + "` is " +
               typeName(access.type) + ", not " + typeName(type),
           "this type differs from the variable's");
}

void checkAccesses(Context &c, Module &module) {
  std::unordered_map<Ident, const VarDecl *> names;
  for (const GlobalsDecl *list : c.names.configuration().accesses) {
    for (VarDecl *decl : list->variables) {
      const auto [first, fresh] = names.emplace(decl->name.id, decl);
      if (!fresh) {
        auto &d =
            c.report(Code::DuplicateName, decl->name.span,
                     "the access path `" + std::string(decl->name.text) + "` is declared twice",
                     "declared again here");
        d.label(first->second->name.span, "first declared here");
      } else if (decl->path != nullptr && decl->type != nullptr) {
        checkAccess(c, decl, module, list->program);
      }
    }
  }
}

} // namespace stc::sema
