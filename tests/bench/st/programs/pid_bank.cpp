#include "tests/bench/st/twin.h"

namespace {

struct Pid {
  float setpoint;
  float actual;
  float kp;
  float ki;
  float kd;
  float dt;
  float out;
  bool limited;
  float integral;
  float lastError;

  void update() {
    const float error = setpoint - actual;
    const float derivative = (error - lastError) / dt;
    lastError = error;
    const float raw = kp * error + integral + kd * derivative;
    limited = raw > 10.0F || raw < -10.0F;
    if (raw > 10.0F) {
      out = 10.0F;
    } else if (raw < -10.0F) {
      out = -10.0F;
    } else {
      out = raw;
      integral = integral + ki * error * dt;
    }
  }
};

struct Plc {
  static constexpr int kN = 200;
  Pid loops[kN];
  float plant[kN];
  int32_t limited;
  double checksum;

  void init() {
    for (Pid &loop : loops) {
      loop.kp = 1.5F;
      loop.ki = 0.4F;
      loop.kd = 0.05F;
      loop.dt = 0.01F;
    }
  }

  void cycle(int64_t) {
    for (int i = 0; i < kN; ++i) {
      Pid &loop = loops[i];
      loop.setpoint = 0.1F * static_cast<float>(i + 1);
      loop.actual = plant[i];
      loop.update();
      plant[i] = plant[i] + 0.01F * (loop.out * 2.0F - plant[i]);
      if (loop.limited)
        ++limited;
    }
    checksum = checksum + static_cast<double>(plant[0]) + static_cast<double>(plant[kN / 2 - 1]) +
               static_cast<double>(plant[kN - 1]) + limited;
  }
};

} // namespace

STRIDE_TWIN(Plc)
