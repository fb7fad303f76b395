// PUBLIC, PROTECTED, INTERNAL, PRIVATE where members are used.

#include "compiler/semantics/expressions/expressions.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/expressions/internal.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::sema {

using namespace ast;

bool insideOf(Context &c, const PouSymbol *owner) {
  return c.scope.pou != nullptr && owner != nullptr &&
         derivesFrom(blockOf(c.scope.pou), blockOf(owner));
}

bool requireAccess(Context &c, Span span, const Symbol *member, const PouSymbol *owner,
                   Access access) {
  std::string_view word;
  std::string who;
  switch (access) {
  case Access::Private:
    if (c.scope.pou != nullptr && blockOf(c.scope.pou) == owner)
      return true;
    word = "PRIVATE";
    who = "only `" + std::string(owner->name.text) + "` itself can use it";
    break;
  case Access::Protected:
    if (insideOf(c, owner))
      return true;
    word = "PROTECTED";
    who = "only `" + std::string(owner->name.text) + "` and blocks that extend it can use it";
    break;
  case Access::Internal:
    if (c.names.seesInternals(c.scope, member->library, owner->space))
      return true;
    word = "INTERNAL";
    who = owner->space != nullptr ? "only the namespace `" + owner->space->path + "` can use it"
                                  : "only the library `" + member->library->name + "` can use it";
    break;
  default:
    return true;
  }
  auto &d = c.report(Code::MemberNotVisible, span,
                     "`" + std::string(owner->name.text) + "." + std::string(member->name.text) +
                         "` is " + std::string(word),
                     who);
  noteDeclaration(d, member);
  return false;
}

} // namespace stc::sema
