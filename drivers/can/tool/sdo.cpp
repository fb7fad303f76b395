// stride-can sdo read|write

#include "drivers/can/master/sdo_abort.hpp"
#include "drivers/can/socket/socket_can_port.hpp"
#include "drivers/can/tool/bus_client.hpp"
#include "drivers/can/tool/commands.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>

namespace stride::can::tool {
namespace {

/// Types of numbers, by bytes and sign.
struct NumberType {
  std::string_view name;
  size_t bytes;
  bool isSigned;
};
constexpr std::array<NumberType, 8> kTypes = {{{"u8", 1, false},
                                               {"u16", 2, false},
                                               {"u32", 4, false},
                                               {"u64", 8, false},
                                               {"i8", 1, true},
                                               {"i16", 2, true},
                                               {"i32", 4, true},
                                               {"i64", 8, true}}};

const NumberType *typeNamed(std::string_view name) {
  for (const NumberType &type : kTypes)
    if (type.name == name)
      return &type;
  return nullptr;
}

int64_t withSign(uint64_t bits, size_t bytes) {
  const unsigned unused = 64 - 8 * static_cast<unsigned>(bytes);
  return static_cast<int64_t>(bits << unused) >> unused;
}

std::string hexOf(const std::vector<uint8_t> &bytes) {
  std::string text;
  for (const uint8_t byte : bytes)
    text += fmt::format("{}{:02X}", text.empty() ? "" : " ", byte);
  return text;
}

/// What has been read, as asked for; without a type as a number, with its sign if it has another
/// value with one.
std::string shown(const std::vector<uint8_t> &bytes, const std::string &typeName) {
  if (typeName == "string")
    return {bytes.begin(), bytes.end()};
  if (const NumberType *type = typeNamed(typeName))
    return type->isSigned ? fmt::format("{}", withSign(numberOf(bytes), type->bytes))
                          : fmt::format("{}", numberOf(bytes));
  const bool isNumber = bytes.size() == 1 || bytes.size() == 2 || bytes.size() == 4;
  if (typeName == "hex" || !isNumber)
    return hexOf(bytes);
  const uint64_t bits = numberOf(bytes);
  const int64_t number = withSign(bits, bytes.size());
  return number < 0 ? fmt::format("{} ({}, {:0{}X}h)", bits, number, bits, bytes.size() * 2)
                    : fmt::format("{} ({:0{}X}h)", bits, bits, bytes.size() * 2);
}

/// The bytes of a value; nothing: it is said why.
std::optional<std::vector<uint8_t>> bytesOf(const SdoOptions &options, size_t size) {
  if (options.type == "string")
    return std::vector<uint8_t>(options.value.begin(), options.value.end());
  const NumberType *type = typeNamed(options.type);
  const size_t bytes = type != nullptr ? type->bytes : size;
  errno = 0;
  char *end = nullptr;
  const bool negative = options.value.starts_with('-');
  const uint64_t bits = negative
                            ? static_cast<uint64_t>(std::strtoll(options.value.c_str(), &end, 0))
                            : std::strtoull(options.value.c_str(), &end, 0);
  const bool isSigned = negative || (type != nullptr && type->isSigned);
  const bool fits = bytes >= 8 || (isSigned ? withSign(bits, bytes) == static_cast<int64_t>(bits)
                                            : bits >> 8 * bytes == 0);
  if (options.value.empty() || *end != 0 || errno != 0 || !fits) {
    complain(fmt::format("'{}' is no number of {} bytes", options.value, bytes));
    return std::nullopt;
  }
  std::vector<uint8_t> result(bytes);
  for (size_t i = 0; i < bytes; ++i)
    result[i] = static_cast<uint8_t>(bits >> 8 * i);
  return result;
}

int failed(const SdoOptions &options, Object object, const Transfer &transfer) {
  if (transfer.timedOut)
    complain(fmt::format("node {} does not answer", options.node));
  else
    complain(fmt::format("node {}, object {}: {} ({:08X}h)", options.node, textOf(object),
                         abortRow(transfer.abort).text, transfer.abort));
  return kBad;
}

std::optional<Object> objectOf(const SdoOptions &options) {
  const std::optional<Object> object = objectOfText(options.object);
  if (!object)
    complain(fmt::format("'{}' is no object: 6064h, 1018h:1 …, in hexadecimal", options.object));
  return object;
}

/// Whether the node's heartbeat says within a second that it is operational.
bool isOperational(SocketCanPort &port, int node) {
  const int64_t end = port.monotonicNs() + 1000000000;
  std::array<Received, 32> frames;
  while (port.monotonicNs() < end && !interrupted()) {
    port.wait(end);
    const size_t count = port.receive(frames);
    for (size_t i = 0; i < count; ++i)
      if (const Frame &frame = frames[i].frame;
          frame.id == kHeartbeatBase + node && frame.length == 1)
        return (frame.data[0] & 0x7F) == 5;
  }
  return false;
}

} // namespace

int sdoRead(const SdoOptions &options) {
  const std::optional<Object> object = objectOf(options);
  SocketCanPort port(options.interface, 0);
  if (!object || !isUp(port, options.interface))
    return kBad;
  BusClient client(port);
  const Transfer transfer = client.read(static_cast<uint8_t>(options.node), *object,
                                        int64_t{options.timeoutMs} * 1000000);
  if (!transfer.done)
    return failed(options, *object, transfer);
  fmt::print("{}\n", shown(transfer.bytes, options.type));
  return kGood;
}

int sdoWrite(const SdoOptions &options) {
  if (!options.allowed) {
    complain("this changes a device, which may move then: add --write if that is wanted");
    return kBad;
  }
  const std::optional<Object> object = objectOf(options);
  SocketCanPort port(options.interface, 0);
  if (!object || !isUp(port, options.interface))
    return kBad;
  const int64_t timeout = int64_t{options.timeoutMs} * 1000000;
  const auto node = static_cast<uint8_t>(options.node);
  if (!options.inOperation && isOperational(port, options.node)) {
    complain(fmt::format("node {} is operational: somebody controls it; --force writes all the "
                         "same",
                         options.node));
    return kBad;
  }
  BusClient client(port);
  size_t size = 4;
  if (options.type.empty()) {
    // As many bytes as the object has.
    const Transfer old = client.read(node, *object, timeout);
    if (!old.done && old.timedOut)
      return failed(options, *object, old);
    if (old.done)
      size = old.bytes.size();
    if (size == 0 || size > 8) {
      complain("what kind of value? add --type string, u8, i32 …");
      return kBad;
    }
  }
  const auto bytes = bytesOf(options, size);
  if (!bytes)
    return kBad;
  const Transfer transfer = client.write(node, *object, *bytes, timeout);
  return transfer.done ? kGood : failed(options, *object, transfer);
}

} // namespace stride::can::tool
