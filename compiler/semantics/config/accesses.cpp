// VAR_ACCESS: variables that are named for the outside.

#include "compiler/semantics/config/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <unordered_map>

namespace stc::sema {

using namespace ast;

void checkAccesses(Context &c, Module &module) {
  std::unordered_map<Ident, const VarDecl *> names;
  for (GlobalsDecl *list : c.names.configuration().accesses) {
    for (VarDecl *decl : list->variables) {
      const auto [first, fresh] = names.emplace(decl->name.id, decl);
      if (!fresh) {
        auto &d =
            c.report(Code::duplicateName, decl->name.span,
                     "the access path `" + std::string(decl->name.text) + "` is declared twice",
                     "declared again here");
        d.label(first->second->name.span, "first declared here");
        continue;
      }
      if (decl->path == nullptr || decl->type == nullptr)
        continue;
      const Type *type = resolveType(c, decl->type, "access");
      AccessPath access;
      access.decl = decl;
      if (decl->path->kind == ExprKind::direct) {
        auto *direct = as<DirectExpr>(decl->path);
        access.type = check(c, direct);
        access.location = direct->location;
      } else if (auto target = resolvePath(c, decl->path, module, list->program)) {
        access.path = std::move(target->path);
        access.type = target->type;
        if (target->variable != nullptr)
          access.location = target->variable->location;
        const auto inImage = [](const Symbol *s) {
          return s != nullptr && s->kind == SymbolKind::variable &&
                 static_cast<const VarSymbol *>(s)->location != nullptr;
        };
        bool inside = inImage(access.path.root) && access.path.root != target->variable;
        for (const PathStep &step : access.path.steps)
          inside = inside || (inImage(step.member) && step.member != target->variable) ||
                   (step.member == nullptr && access.location != nullptr);
        if (inside) {
          c.report(Code::configMismatch, decl->path->span,
                   "an access path cannot lead into a variable of the process image",
                   "a part of such a variable")
              .help("give the address of the part: `%MB4`");
          continue;
        }
        if (target->variable != nullptr && target->variable->isBit) {
          c.report(Code::configMismatch, decl->path->span, "an access path cannot lead to a BIT",
                   "a bit has no address")
              .help("declare `" + std::string(target->variable->name.text) + "` as BOOL");
          continue;
        }
        if (access.type->kind == TypeKind::reference || access.type->kind == TypeKind::pointer) {
          c.report(Code::configMismatch, decl->path->span,
                   "an access path cannot lead to an address", "this is " + typeName(access.type));
          continue;
        }
      }
      if (access.type == nullptr || isError(access.type) || isError(type))
        continue;
      if (type != access.type) {
        c.report(Code::configMismatch, decl->type->span,
                 "`" + std::string(c.program.sources.text(decl->path->span)) + "` is " +
                     typeName(access.type) + ", not " + typeName(type),
                 "this type differs from the variable's");
        continue;
      }
      c.program.accessPaths.push_back(std::move(access));
    }
  }
}

} // namespace stc::sema
