#include "compiler/syntax/global_names.hpp"

namespace stc {

std::unordered_map<std::string, Span> globalNames(const std::vector<ast::File *> &files) {
  std::unordered_map<std::string, Span> names;
  for (const ast::File *file : files)
    for (const ast::Decl *decl : file->declarations) {
      if (decl->name && decl->space.empty() && decl->kind != ast::DeclKind::Globals)
        names.try_emplace(lowerCase(decl->name.text), decl->name.span);
      if (decl->kind == ast::DeclKind::Globals)
        for (const ast::VarDecl *variable : ast::as<ast::GlobalsDecl>(decl)->variables)
          if (variable->name)
            names.try_emplace(lowerCase(variable->name.text), variable->name.span);
    }
  return names;
}

} // namespace stc
