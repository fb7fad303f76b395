#include "compiler/syntax/parser.hpp"

#include "compiler/syntax/file_parser.hpp"

#include <deque>
#include <mutex>
#include <utility>
#include <vector>

namespace stc {

namespace {

/// What each thread has for itself.
struct ParserState {
  ParserState(Interner &shared, std::mutex &mutex) : interner(shared, mutex) {}
  Interner interner;
  Arena arena;
};

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

std::vector<ast::File *> parseFiles(std::span<const SourceFile *const> files, Interner &interner,
                                    Arena &arena, Diagnostics &diagnostics,
                                    const ParseOptions *options, const Workers &workers) {
  std::vector<ast::File *> trees(files.size());
  size_t bytes = 0;
  for (const SourceFile *file : files)
    bytes += file->text().size();
  const unsigned threads = workers.threadsFor(files.size(), bytes);
  if (threads == 1) {
    for (size_t i = 0; i < files.size(); ++i)
      trees[i] = parse(*files[i], interner, arena, diagnostics, options);
    return trees;
  }
  std::mutex mutex; // of `interner`
  std::deque<ParserState> states;
  for (unsigned i = 0; i < threads; ++i)
    states.emplace_back(interner, mutex);
  std::vector<Diagnostics> found(files.size(), diagnostics.part());
  Workers::each(files.size(), threads, [&](size_t i, unsigned thread) {
    ParserState &state = states[thread];
    trees[i] = parse(*files[i], state.interner, state.arena, found[i], options);
  });
  for (Diagnostics &one : found)
    diagnostics.add(std::move(one));
  for (ParserState &state : states)
    arena.adopt(std::move(state.arena));
  return trees;
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
