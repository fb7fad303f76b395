#include "compiler/syntax/parser.hpp"

#include "compiler/syntax/file_parser.hpp"

namespace stc {

ast::File *parse(const SourceFile &file, Interner &interner, Arena &arena,
                 Diagnostics &diagnostics) {
  return FileParser(file, interner, arena, diagnostics).run();
}

} // namespace stc
