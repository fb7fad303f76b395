#include "runtime/iec/math.h"
#include "tests/bench/st/twin.h"

namespace {

struct Plc {
  static constexpr int32_t kN = 512;
  double re[kN];
  double im[kN];
  double wr[kN / 2];
  double wi[kN / 2];
  bool ready;
  int32_t round;
  double checksum;

  void init() {}

  void cycle(int64_t) {
    if (!ready) {
      for (int32_t i = 0; i < kN / 2; ++i) {
        wr[i] = stride::cos(6.283185307179586 * i / kN);
        wi[i] = -stride::sin(6.283185307179586 * i / kN);
      }
      ready = true;
    }
    ++round;
    for (int32_t i = 0; i < kN; ++i) {
      re[i] = (i * 37 + round) % 101 - 50.0;
      im[i] = 0.0;
    }
    int32_t j = 0;
    for (int32_t i = 0; i < kN - 1; ++i) {
      if (i < j) {
        const double tr = re[i];
        re[i] = re[j];
        re[j] = tr;
        const double ti = im[i];
        im[i] = im[j];
        im[j] = ti;
      }
      int32_t m = kN / 2;
      while (m >= 1 && j >= m) {
        j -= m;
        m /= 2;
      }
      j += m;
    }
    int32_t step = kN / 2;
    for (int32_t half = 1; half < kN; half *= 2) {
      for (int32_t base = 0; base < kN; base += 2 * half) {
        int32_t t = 0;
        for (int32_t k = base; k < base + half; ++k) {
          const double ur = re[k + half] * wr[t] - im[k + half] * wi[t];
          const double ui = re[k + half] * wi[t] + im[k + half] * wr[t];
          re[k + half] = re[k] - ur;
          im[k + half] = im[k] - ui;
          re[k] += ur;
          im[k] += ui;
          t += step;
        }
      }
      step /= 2;
    }
    checksum = checksum / 2.0 + re[1] + im[3] + re[kN - 1];
  }
};

} // namespace

STRIDE_TWIN(Plc)
