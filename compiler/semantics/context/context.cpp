#include "compiler/semantics/context/context.hpp"

#include "compiler/source/stack.hpp"

namespace stc::sema {

Context::Context(Program &checked, Lookup &lookup)
    : program(checked), arena(checked.arena), names(lookup), reporter(lookup.reporter()),
      types(checked.arena), stackEnd(endOfStack()) {}

bool isTooDeep(Context &c, const ast::Name &name) {
  if (!stackIsShort(c.stackEnd))
    return false;
  c.report(Code::TooDeep, name.span,
           "`" + std::string(name.text) + "` depends on too many other declarations",
           "one leads to the next");
  return true;
}

} // namespace stc::sema
