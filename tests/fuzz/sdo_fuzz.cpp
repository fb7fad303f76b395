// Answers to SDO transfers, whatever they are: the transfer ends, and nothing is written beside its
// buffer.
#include "drivers/can/master/sdo_client.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  using namespace stride::can;
  if (size < 2)
    return 0;
  SdoClient client(5, 50);
  std::vector<uint8_t> buffer(data[1] % 200U);
  const std::vector<uint8_t> bytes(1 + data[1], 0x5A);
  const bool begun = (data[0] & 1U) != 0 ? client.upload({0x2000, 3}, buffer)
                                         : client.download({0x2000, 3}, bytes);
  if (!begun)
    return 0;
  size_t at = 2;
  for (int cycle = 0; client.state() == SdoClient::State::Busy; ++cycle) {
    for (int i = 0; i < 3 && client.pending(); ++i) {
      static_cast<void>(client.nextFrame());
      client.sent();
    }
    if (at < size) {
      Frame frame;
      frame.id = 0x585;
      const size_t count = std::min<size_t>(Frame::kMostBytes, size - at);
      frame.length = static_cast<uint8_t>(count);
      std::copy_n(data + at, count, frame.data.begin());
      at += count;
      client.received(frame);
    }
    client.cycle();
    if (static_cast<size_t>(cycle) > 1000 + size)
      std::abort(); // it does not end
  }
  return 0;
}
