#include "tests/bench/st/twin.h"

namespace {

using Data = uint8_t[4096];
using Table = uint32_t[256];

uint32_t crc32(const Data &data, const Table &table, int32_t size) {
  uint32_t crc = 0xFFFFFFFFU;
  for (int32_t i = 0; i < size; ++i)
    crc = (crc >> 8U) ^ table[(crc ^ data[i]) & 0xFFU];
  return ~crc;
}

struct Plc {
  Data data;
  Table table;
  bool ready;
  uint64_t checksum;

  void init() {}

  void cycle(int64_t) {
    if (!ready) {
      for (uint32_t i = 0; i < 256; ++i) {
        uint32_t c = i;
        for (int k = 0; k < 8; ++k)
          c = (c & 1U) != 0 ? (c >> 1U) ^ 0xEDB88320U : c >> 1U;
        table[i] = c;
      }
      for (int32_t i = 0; i < 4096; ++i)
        data[i] = static_cast<uint8_t>(i * 31);
      ready = true;
    }
    const uint32_t c = crc32(data, table, 4096);
    data[c & 0xFFFU] = static_cast<uint8_t>(c);
    checksum += c;
  }
};

} // namespace

STRIDE_TWIN(Plc)
