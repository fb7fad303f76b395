#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_EXP_PINS_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_EXP_PINS_HPP
// Names for pins that a file numbers only.

#include "compiler/import/networks/network.hpp"
#include "compiler/import/networks/scope.hpp"

#include <charconv>
#include <optional>
#include <string_view>

namespace stc::import::networks {

/// A number and nothing else.
[[nodiscard]] inline std::optional<long> numberIn(std::string_view text) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

/// Whether an operand is the editor's mark for nothing.
[[nodiscard]] inline bool isBlankOperand(std::string_view text) {
  return text.empty() || text == "???";
}

/// Gives a call's pins the names of the declaration: boxes show VAR_INPUT, then VAR_IN_OUT on the
/// left, VAR_OUTPUT on the right. False: there are more pins than declared.
[[nodiscard]] inline bool namePins(Node &node, const Interface *declared) {
  if (declared == nullptr)
    return true;
  size_t at = 0;
  for (InPin &pin : node.inputs) {
    if (pin.enable)
      continue;
    const size_t inputs = declared->inputs.size();
    if (at >= inputs + declared->inOuts.size())
      return false;
    pin.inOut = at >= inputs;
    pin.name = pin.inOut ? declared->inOuts[at - inputs].name : declared->inputs[at].name;
    ++at;
  }
  at = 0;
  for (OutPin &pin : node.outputs) {
    if (pin.enable)
      continue;
    if (at >= declared->outputs.size())
      return false;
    pin.name = declared->outputs[at++].name;
  }
  return true;
}

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_EXP_PINS_HPP
