// Any bytes as a drawn body: as one of CoDeSys V2.3, and as one of PLCopen XML.
#include "compiler/import/networks/exp_networks.hpp"
#include "compiler/import/networks/plcopen_networks.hpp"
#include "compiler/import/networks/print.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace stc::import::networks;

Scope scene() {
  Scope scope;
  scope.declare("FUNCTION_BLOCK TON VAR_INPUT IN : BOOL; PT : TIME; END_VAR\n"
                "VAR_OUTPUT Q : BOOL; ET : TIME; END_VAR END_FUNCTION_BLOCK\n"
                "FUNCTION Scale : REAL VAR_INPUT v : INT; END_VAR END_FUNCTION\n");
  scope.enter("PROGRAM P VAR a, b, x : BOOL; n : INT; t : TON; END_VAR");
  return scope;
}

/// Either statements, or a reason why there are none.
void judge(const Translation &result) {
  if (!result.ok() && !(result.statements.empty() && result.declarations.empty()))
    std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  Scope scope = scene();
  if (!text.starts_with('<')) {
    std::vector<NumberedLine> lines;
    for (size_t at = 0; at < text.size();) {
      const size_t end = std::min(text.find('\n', at), text.size());
      lines.push_back({std::string(text.substr(at, end - at)), lines.size() + 1});
      at = end + 1;
    }
    judge(translatedExpBody(lines, scope));
    return 0;
  }
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size()))
    return 0;
  std::vector<Problem> problems;
  Body body = readPlcOpenBody(
      document.first_child(), [](const pugi::xml_node &) { return size_t{1}; }, problems);
  if (problems.empty())
    judge(translated(std::move(body), scope));
  return 0;
}
