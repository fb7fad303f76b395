#include "compiler/syntax/parser.hpp"

#include "compiler/syntax/file_parser.hpp"

#include <vector>

namespace stc {

namespace {

bool mayHaveMembers(const ast::Decl *decl, uint16_t member) {
  switch (decl->kind) {
  case ast::DeclKind::Program:
  case ast::DeclKind::FunctionBlock:
    return true;
  case ast::DeclKind::Class:
  case ast::DeclKind::Interface:
    return member != Tok::ACTION;
  default:
    return false;
  }
}

} // namespace

ast::File *parse(const SourceFile &file, Interner &interner, Arena &arena, Diagnostics &diagnostics,
                 const ParseOptions *options) {
  return FileParser(file, interner, arena, diagnostics, options).run();
}

void attachMembers(std::span<ast::File *const> files, Arena &arena, Diagnostics &diagnostics) {
  const auto append = [&]<class T>(std::span<T *> &list, T *one) {
    std::vector<T *> all(list.begin(), list.end());
    all.push_back(one);
    list = arena.copy(all);
  };
  for (const ast::File *file : files) {
    for (const ast::StrayMember &stray : file->strayMembers) {
      ast::PouDecl *owner = nullptr;
      for (const ast::File *other : files)
        for (ast::Decl *decl : other->declarations)
          if (decl->name.id == stray.owner.id && mayHaveMembers(decl, stray.kind))
            owner = ast::as<ast::PouDecl>(decl);
      if (owner == nullptr) {
        diagnostics
            .report(Code::MemberWithoutOwner, stray.owner.span,
                    "there is no block `" + std::string(stray.owner.text) + "`",
                    "whose " + std::string(tokenSpelling(stray.kind)) + " should this be?")
            .help("put it after its block or inside of it");
      } else if (stray.kind == Tok::PROPERTY) {
        append(owner->properties, static_cast<ast::PropertyDecl *>(stray.member));
      } else {
        append(stray.kind == Tok::ACTION ? owner->actions : owner->methods,
               static_cast<ast::PouDecl *>(stray.member));
      }
    }
  }
}

} // namespace stc
