#include "drivers/can/tool/tool_support.hpp"

#include "drivers/can/schema.hpp"
#include "drivers/can/socket/socket_can_port.hpp"
#include "runtime/app/application.hpp"
#include "runtime/host/axis_hooks.hpp"
#include "runtime/host/group_setups.hpp"

#include <charconv>
#include <csignal>
#include <fmt/format.h>

namespace stride::can::tool {
namespace {

volatile std::sig_atomic_t ended = 0; // of the process, as signals are

void onSignal(int /*signal*/) { ended = 1; }

/// A hexadecimal number up to `most`, with "0x" before it or "h" after it, or neither.
std::optional<uint32_t> hexadecimal(std::string_view text, uint32_t most) {
  if (text.starts_with("0x") || text.starts_with("0X"))
    text.remove_prefix(2);
  else if (text.ends_with('h') || text.ends_with('H'))
    text.remove_suffix(1);
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || value > most)
    return std::nullopt;
  return value;
}

} // namespace

void complain(const std::string &text) { fmt::print(stderr, "error: {}\n", text); }

bool interrupted() {
  static const bool installed = [] {
    struct sigaction action {};
    action.sa_handler = onSignal;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return true;
  }();
  return installed && ended != 0;
}

bool isUp(SocketCanPort &port, const std::string &interface) {
  if (port.state() != ControllerState::Down)
    return true;
  const std::string_view problem = port.problem();
  complain(problem.empty() ? fmt::format("the interface '{}' cannot be used", interface)
                           : std::string(problem));
  return false;
}

std::optional<Object> objectOfText(std::string_view text) {
  const size_t colon = text.find(':');
  const auto index = hexadecimal(text.substr(0, colon), 0xFFFF);
  const auto sub = colon == std::string_view::npos ? std::optional<uint32_t>(0)
                                                   : hexadecimal(text.substr(colon + 1), 0xFF);
  if (!index || !sub)
    return std::nullopt;
  return Object{static_cast<uint16_t>(*index), static_cast<uint8_t>(*sub)};
}

std::string textOf(Object object) {
  return object.sub == 0 ? fmt::format("{:04X}h", object.index)
                         : fmt::format("{:04X}h:{:X}", object.index, object.sub);
}

uint64_t numberOf(std::span<const uint8_t> bytes) {
  uint64_t value = 0;
  for (size_t i = 0; i < bytes.size() && i < sizeof value; ++i)
    value |= uint64_t{bytes[i]} << 8 * i;
  return value;
}

std::vector<bus::GroupSetup> canGroups(const std::string &application) {
  const app::Application loaded = app::Application::load(application, host::runtimeLayouts());
  const StrideAppV1 &app = loaded.description();
  std::vector<bus::GroupSetup> groups;
  for (uint32_t i = 0; i < app.axisGroupCount; ++i)
    if (app.axisGroups[i].driverName == kSchema.name)
      groups.push_back(host::groupSetup(app, app.axisGroups[i], kSchema));
  return groups;
}

} // namespace stride::can::tool
