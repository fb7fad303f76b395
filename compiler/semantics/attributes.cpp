#include "compiler/semantics/attributes.hpp"

namespace stc {

using namespace ast;

unsigned packMode(Reporter &reporter, const Attributes &attributes, unsigned otherwise) {
  for (const Attribute &a : attributes) {
    if (a.id != AttributeId::PackMode)
      continue;
    if (a.value == "0" || a.value == "1")
      return 1;
    if (a.value == "2" || a.value == "4" || a.value == "8")
      return static_cast<unsigned>(a.value[0] - '0');
    reporter
        .report(Code::PackMode, a.span,
                "`" + std::string(a.value) + "` is no way to align the members of a structure",
                "0, 1, 2, 4 or 8 is possible")
        .note("0 and 1 leave no gaps; 2, 4 and 8 align each member to that many bytes at most");
  }
  return otherwise;
}

} // namespace stc
