#include "compiler/source/diagnostic.hpp"

namespace stc {

// A switch, so that the compiler names the code whose text is missing.
std::string_view explainText(Code code) {
  switch (code) {
#define STC_EXPLAIN(name, text)                                                                    \
  case Code::name:                                                                                 \
    return text;
#include "compiler/source/diagnostic_texts.def"
#undef STC_EXPLAIN
  }
  return {};
}

} // namespace stc
