#include "runtime/iec/math.h"
#include "tests/bench/st/twin.h"

namespace {

struct Body {
  double x, y, z, vx, vy, vz, mass;
};

constexpr int kN = 5;
constexpr double kStep = 0.01;
constexpr Body kBodies[kN] = {
    {0, 0, 0, 0, 0, 0, 39.478417604357432},
    {4.841431442464721, -1.160320044027428, -0.103622044471123, 0.606326392995832,
     2.811986844916260, -0.025218361659887, 0.037693674870389},
    {8.343366718244580, 4.124798564124305, -0.403523417114321, -1.010774346178793,
     1.825662371230411, 0.008415761376584, 0.011286326131968},
    {12.894369562139131, -15.111151401698631, -0.223307578892656, 1.082791006441535,
     0.868713018169608, -0.010832637401363, 0.001723724057059},
    {15.379697114850917, -25.919314609987964, 0.179258772950371, 0.979090732243898,
     0.594698998647676, -0.034755955550407, 0.002033686869924}};

struct Plc {
  Body bodies[kN];
  double checksum;

  void init() {
    for (int i = 0; i < kN; ++i)
      bodies[i] = kBodies[i];
  }

  void cycle(int64_t) {
    for (int step = 0; step < 50; ++step) {
      for (int i = 0; i < kN - 1; ++i) {
        for (int j = i + 1; j < kN; ++j) {
          Body &a = bodies[i];
          Body &b = bodies[j];
          const double dx = a.x - b.x;
          const double dy = a.y - b.y;
          const double dz = a.z - b.z;
          const double d2 = dx * dx + dy * dy + dz * dz;
          const double magnitude = kStep / (d2 * stride::sqrt(d2));
          a.vx -= dx * b.mass * magnitude;
          a.vy -= dy * b.mass * magnitude;
          a.vz -= dz * b.mass * magnitude;
          b.vx += dx * a.mass * magnitude;
          b.vy += dy * a.mass * magnitude;
          b.vz += dz * a.mass * magnitude;
        }
      }
      for (Body &b : bodies) {
        b.x += kStep * b.vx;
        b.y += kStep * b.vy;
        b.z += kStep * b.vz;
      }
    }
    checksum = bodies[0].x + bodies[1].y + bodies[2].z + bodies[3].vx + bodies[4].vy;
  }
};

} // namespace

STRIDE_TWIN(Plc)
