// __POUNAME and __POSITION: where the call stands.

#include "compiler/semantics/builtins/internal.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/source/sources.hpp"

#include <fmt/format.h>

namespace stc::sema {

using namespace ast;

/// Makes the call a constant text.
static const Type *constantText(Context &c, CallExpr *expr, std::string_view text) {
  ConstValue value;
  value.kind = ConstKind::String;
  value.text = c.arena.copy(text);
  expr->constant = c.makeConstant(value);
  return c.types.string(false, static_cast<uint32_t>(text.size()));
}

const Type *checkPouName(Context &c, CallExpr *expr) {
  const PouSymbol *pou = c.scope.pou;
  if (pou == nullptr) {
    c.report(Code::NotAVariable, expr->span, "there is no POU here",
             "the initial value of a global variable");
    return elementaryType(TypeKind::Error);
  }
  const std::string own(pou->name.text);
  return constantText(c, expr,
                      pou->owner == nullptr ? own : std::string(pou->owner->name.text) + "." + own);
}

const Type *checkPosition(Context &c, CallExpr *expr) {
  const SourceFile &file = c.program.sources.file(expr->span.file);
  const uint32_t line = file.lineNumber(expr->span.begin);
  const uint32_t column = expr->span.begin - file.lineStart(line) + 1;
  return constantText(c, expr, fmt::format("Line {}, Column {}", line, column));
}

} // namespace stc::sema
