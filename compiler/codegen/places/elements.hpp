#pragma once
// Elements of arrays, characters of strings, what lies beside the target of a pointer.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// With `slotOnly` a reference among the elements is not followed.
void emitIndex(EmitContext &cx, const ast::IndexExpr *e, bool slotOnly);

} // namespace stc::codegen
