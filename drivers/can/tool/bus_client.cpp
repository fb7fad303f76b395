#include "drivers/can/tool/bus_client.hpp"

#include "drivers/can/master/sdo_client.hpp"

#include <algorithm>
#include <array>

namespace stride::can::tool {
namespace {

constexpr int64_t kStepNs = 1000000; ///< In which time-outs are counted.

} // namespace

template <class Start>
Transfer BusClient::transfer(uint8_t node, int64_t timeoutNs, const Start &start) {
  SdoClient client(node, static_cast<uint32_t>(std::max<int64_t>(timeoutNs / kStepNs, 1)));
  start(client);
  int64_t next = port_.monotonicNs() + kStepNs;
  std::array<Received, 32> frames;
  for (;;) {
    while (client.pending() &&
           port_.send(client.nextFrame(), SendClass::Service) == SendResult::Sent)
      client.sent();
    if (client.state() != SdoClient::State::Busy && !client.pending())
      break;
    port_.wait(next);
    const size_t count = port_.receive(frames);
    for (size_t i = 0; i < count; ++i)
      if (frames[i].frame.id == kSdoAnswerBase + node)
        client.received(frames[i].frame);
    if (port_.monotonicNs() >= next) {
      client.cycle();
      port_.beginCycle();
      next += kStepNs;
    }
    if (port_.state() == ControllerState::Down)
      break;
  }
  Transfer result;
  result.done = client.state() == SdoClient::State::Done;
  result.timedOut = client.timedOut() || client.state() == SdoClient::State::Busy;
  result.abort = client.abortCode();
  result.bytes.resize(client.size());
  return result;
}

Transfer BusClient::read(uint8_t node, Object object, int64_t timeoutNs) {
  std::vector<uint8_t> buffer(kLongest);
  Transfer result =
      transfer(node, timeoutNs, [&](SdoClient &client) { (void)client.upload(object, buffer); });
  buffer.resize(result.done ? std::min(result.bytes.size(), buffer.size()) : 0);
  result.bytes = std::move(buffer);
  return result;
}

Transfer BusClient::write(uint8_t node, Object object, std::span<const uint8_t> bytes,
                          int64_t timeoutNs) {
  Transfer result =
      transfer(node, timeoutNs, [&](SdoClient &client) { (void)client.download(object, bytes); });
  result.bytes.clear();
  return result;
}

} // namespace stride::can::tool
