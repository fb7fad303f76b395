// What the manual says of cams and masters, told anew in long double and as plainly as can be: the
// oracle of the tests of cam blocks. Knows nothing of runtime/cam.
#ifndef STRIDE_TESTS_PROPERTY_CAM_MODEL_HPP
#define STRIDE_TESTS_PROPERTY_CAM_MODEL_HPP

#include "runtime/axis/axis_ref.hpp"

#include "tests/support/fresh.hpp"
#include "tests/support/kinematics.hpp"
#include "tests/support/random.hpp"

#include "st/SM_DriveBasic/MC_CAM_REF.h"
#include "st/SM_DriveBasic/SMC_CAMXYVA.h"
#include "st/SM_PLCopen/MC_SetPosition.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace stride::test {

using CamNode = ::st::SM_DriveBasic::SMC_CAMXYVA;
using CamRef = ::st::SM_DriveBasic::MC_CAM_REF;

/// A value with its first two derivatives.
struct ModelPoint {
  long double y, v, a;
};

/// A cam with its data.
struct ModelCam {
  std::vector<CamNode> nodes;       ///< Tables: dV and dA do not count.
  int type = 3;                     ///< As MC_CAM_REF.byType; tables are linear.
  std::vector<unsigned char> table; ///< Of tables.

  [[nodiscard]] double start() const { return nodes.front().dX; }
  [[nodiscard]] double end() const { return nodes.back().dX; }
  [[nodiscard]] long double length() const { return static_cast<long double>(end()) - start(); }
  [[nodiscard]] long double rise() const {
    return static_cast<long double>(nodes.back().dY) - nodes.front().dY;
  }

  [[nodiscard]] CamRef ref() const {
    CamRef cam = fresh<CamRef>();
    cam.xStart = start();
    cam.xEnd = end();
    cam.byType = static_cast<uint8_t>(type);
    cam.byVarType = 6;
    cam.nElements = static_cast<int16_t>(nodes.size());
    const void *data = type == 3 ? static_cast<const void *>(nodes.data()) : table.data();
    cam.pce = static_cast<uint8_t *>(const_cast<void *>(data));
    return cam;
  }

  /// Tables: from the nodes.
  void fill() {
    if (type == 3)
      return;
    std::vector<double> numbers;
    for (const CamNode &node : nodes) {
      if (type == 2)
        numbers.push_back(node.dX);
      numbers.push_back(node.dY);
    }
    const float scaling[8] = {0, 1, 0, 1, 0, 1, 0, 1}; // editor = table
    table.resize(numbers.size() * sizeof(double) + sizeof scaling);
    std::memcpy(table.data(), numbers.data(), numbers.size() * sizeof(double));
    std::memcpy(table.data() + numbers.size() * sizeof(double), scaling, sizeof scaling);
  }

  /// Within [start, end].
  [[nodiscard]] ModelPoint at(long double x) const {
    size_t i = 1;
    while (i + 1 < nodes.size() && x >= nodes[i].dX)
      ++i;
    const CamNode &l = nodes[i - 1];
    const CamNode &r = nodes[i];
    const long double h = static_cast<long double>(r.dX) - l.dX;
    const long double u = (x - l.dX) / h;
    if (type != 3) {
      const long double slope = (static_cast<long double>(r.dY) - l.dY) / h;
      return {l.dY + slope * (x - l.dX), slope, 0};
    }
    // Taylor's polynomial at the left node, and what the right one adds to it.
    const long double t = x - l.dX;
    const long double dy = r.dY - (l.dY + h * (l.dV + h / 2 * l.dA));
    const long double dv = r.dV - (l.dV + h * l.dA);
    const long double da = static_cast<long double>(r.dA) - l.dA;
    const long double c3 = 10 * dy - 4 * h * dv + h * h / 2 * da;
    const long double c4 = -15 * dy + 7 * h * dv - h * h * da;
    const long double c5 = 6 * dy - 3 * h * dv + h * h / 2 * da;
    return {l.dY + t * (l.dV + t / 2 * l.dA) + u * u * u * (c3 + u * (c4 + u * c5)),
            l.dV + t * l.dA + u * u / h * (3 * c3 + u * (4 * c4 + u * 5 * c5)),
            l.dA + u / (h * h) * (6 * c3 + u * (12 * c4 + u * 20 * c5))};
  }

  /// How near `x` is to a place where a derivative jumps, or may. Within [start, end].
  [[nodiscard]] long double toJoint(long double x) const {
    long double least = std::fabs(x - start());
    for (const CamNode &node : nodes)
      least = std::min(least, std::fabs(x - node.dX));
    return least;
  }

  /// The largest magnitudes of position, velocity and acceleration.
  [[nodiscard]] ModelPoint scale() const {
    ModelPoint most{1e-300L, 1e-300L, 1e-300L};
    for (int i = 0; i <= 400; ++i) {
      const ModelPoint p = at(start() + length() * i / 400);
      most = {std::max(most.y, std::fabs(p.y)), std::max(most.v, std::fabs(p.v)),
              std::max(most.a, std::fabs(p.a))};
    }
    return most;
  }
};

/// Any cam. `smooth`: its ends fit together, but for the rise.
inline ModelCam randomCam(Random &random, bool smooth) {
  ModelCam cam;
  const double length = random.magnitude(-1, 3);
  const double height = random.magnitude(-1, 3);
  const int count = 2 + random.below(6);
  cam.type = random.chance(0.7) ? 3 : random.chance(0.5) ? 2 : 1;
  double x = random.chance(0.6) ? 0 : length * random.uniform(-2, 0.5);
  for (int i = 0; i < count; ++i) {
    const double slope = height / length;
    cam.nodes.push_back({x, height * random.uniform(-1, 1), slope * random.uniform(-3, 3),
                         slope / length * random.uniform(-9, 9)});
    x += length / (count - 1) * (cam.type == 1 ? 1.0 : random.uniform(0.2, 1));
  }
  if (cam.type == 1) // evenly, to the bit
    for (int i = 1; i < count - 1; ++i)
      cam.nodes[static_cast<size_t>(i)].dX =
          cam.start() + (cam.end() - cam.start()) * i / (count - 1);
  if (random.chance(0.4))
    cam.nodes.front().dY = 0;
  if (random.chance(0.4))
    cam.nodes.back().dY = cam.nodes.front().dY;
  if (smooth) {
    cam.nodes.back().dV = cam.nodes.front().dV;
    cam.nodes.back().dA = cam.nodes.front().dA;
  }
  cam.fill();
  return cam;
}

/// A master that needs no drive: it moves with constant acceleration from cycle to cycle. Its
/// actual values are its set values of the cycle before.
class ModelMaster {
public:
  axis::AxisRef ref = fresh<axis::AxisRef>();

  ModelMaster(double cycle, double period) : cycle_(cycle) {
    ref.bCommunication = 1;
    ref.wCommunicationState = axis::kNormalOperation;
    ref.bRegulatorOn = ref.bDriveStart = ref.bRegulatorRealState = ref.bDriveStartRealState = 1;
    ref.fTaskCycle = cycle;
    ref.iMovementType = period > 0 ? 0 : 1;
    if (period > 0)
      ref.fPositionPeriod = period;
  }

  /// Without moving.
  void place(double position) {
    ref.fSetPosition = ref.fActPosition = shown(position);
    turns_ = 0;
    shift_ = 0;
    actTotal_ = setTotal();
  }

  /// One cycle further; then it has the velocity.
  void step(double velocity) {
    ref.fActPosition = ref.fSetPosition;
    ref.fActVelocity = ref.fSetVelocity;
    ref.fActAcceleration = ref.fSetAcceleration;
    actTotal_ = setTotal();
    const double way = 0.5 * (ref.fSetVelocity + velocity) * cycle_;
    go(way);
    ref.fSetAcceleration = (velocity - ref.fSetVelocity) / cycle_;
    ref.fSetVelocity = velocity;
  }

  /// As step, to where it has been already.
  void jumpTo(double position, int64_t turns, double velocity) {
    actTotal_ = setTotal();
    ref.fActPosition = ref.fSetPosition;
    ref.fActVelocity = ref.fSetVelocity;
    ref.fSetPosition = position;
    turns_ = turns;
    ref.fSetAcceleration = (velocity - ref.fSetVelocity) / cycle_;
    ref.fSetVelocity = velocity;
  }

  void setPosition(double position, bool relative) {
    auto block = fresh<::st::SM_PLCopen::MC_SetPosition>();
    Ctx ctx{};
    block.Axis = &ref;
    block.Execute = 1;
    block.Position = position;
    block.Mode = relative;
    const double before = std::fabs(ref.fSetPosition);
    const long double total = setTotal();
    block.body__(ctx);
    shift_ += total - setTotal();
    haze_ += 1e-15 * (before + std::fabs(ref.fSetPosition) + std::fabs(position) +
                      (isRotary() ? ref.fPositionPeriod : 0.0));
  }

  /// What shifts of the zero point may have rounded off so far.
  [[nodiscard]] long double haze() const { return haze_; }
  [[nodiscard]] bool isRotary() const { return ref.iMovementType == 0; }
  /// The values that count.
  [[nodiscard]] long double total() const { return ref.bRegulatorOn ? setTotal() : actTotal_; }
  [[nodiscard]] int64_t turns() const { return turns_; }
  [[nodiscard]] double position() const {
    return ref.bRegulatorOn ? ref.fSetPosition : ref.fActPosition;
  }
  [[nodiscard]] double velocity() const {
    return ref.bRegulatorOn ? ref.fSetVelocity : ref.fActVelocity;
  }
  [[nodiscard]] double acceleration() const {
    return ref.bRegulatorOn ? ref.fSetAcceleration : ref.fActAcceleration;
  }

private:
  [[nodiscard]] double shown(double position) const {
    return isRotary() ? onCircle(position, ref.fPositionPeriod) : position;
  }
  void go(double way) {
    const double before = ref.fSetPosition;
    ref.fSetPosition = shown(before + way);
    if (!isRotary())
      return;
    const double turns = std::round((way - (ref.fSetPosition - before)) / ref.fPositionPeriod);
    if (std::fabs(turns) < 1e15) // else it is no course
      turns_ += static_cast<int64_t>(turns);
  }
  /// Computed anew: nothing is summed up but shifts of the zero point.
  [[nodiscard]] long double setTotal() const {
    return static_cast<long double>(turns_) * ref.fPositionPeriod + ref.fSetPosition + shift_;
  }

  double cycle_;
  int64_t turns_ = 0;
  long double shift_ = 0;
  long double actTotal_ = 0;
  long double haze_ = 0;
};

/// Inputs of MC_CamIn and MC_CamTableSelect that say where the slave has to be.
struct CamSettings {
  double masterOffset = 0, slaveOffset = 0, masterScaling = 1, slaveScaling = 1;
  bool periodic = true, masterAbsolute = true, relative = false;
};

/// A coupling by a cam, as the manual describes it in 4.6.1.
class ModelCoupling {
public:
  ModelCoupling(const ModelCam &cam, const CamSettings &settings) : cam_(cam), s_(settings) {}

  /// False: the master is outside (SMC_CI_MASTER_OUT_OF_SCALE).
  bool begin(const ModelMaster &master, long double slavePosition) {
    first_ = master.total();
    shownFirst_ = master.position();
    base_ = s_.relative ? slavePosition : 0;
    const long double x = inCam(master.total());
    firstPeriod_ = 0;
    period_ = s_.periodic ? periodOf(x) : 0;
    return x >= cam_.start() && x <= cam_.end();
  }

  struct Out {
    ModelPoint slave;
    bool endOfProfile;
    bool outside;
    bool exact;       ///< The derivatives and endOfProfile are what they are, not at a joint.
    long double x;    ///< Place in the cam.
    long double haze; ///< How well anybody can know it.
  };

  Out at(const ModelMaster &master) {
    return at({master.total(), master.velocity(), master.acceleration()}, master.haze());
  }

  /// With the master's position (over its turns) and its derivatives.
  Out at(const ModelPoint &master, long double masterHaze) {
    long double x = inCam(master.y);
    // What the implementation may lose.
    const long double haze =
        1e-12L * (cam_.length() + std::fabs(static_cast<long double>(cam_.start()))) +
        1e-15L * std::fabs(x) + std::fabs(static_cast<long double>(s_.masterScaling)) * masterHaze;
    Out out{};
    out.haze = haze;
    long double rises = 0;
    if (s_.periodic) {
      const long double period = periodOf(x);
      x -= period * cam_.length();
      rises = (period - firstPeriod_) * cam_.rise();
      out.endOfProfile = period != period_;
      period_ = period;
    } else {
      out.outside = x < cam_.start() || x > cam_.end();
      out.endOfProfile = x < cam_.start() || x >= cam_.end();
      if (std::fabs(x - cam_.start()) < haze || std::fabs(x - cam_.end()) < haze)
        doubt_ = true;
      x = std::clamp<long double>(x, cam_.start(), cam_.end());
    }
    const bool near = cam_.toJoint(x) < haze && !out.outside;
    out.exact = !near && !doubt_;
    doubt_ = near;
    out.x = x;
    ModelPoint p = cam_.at(x);
    if (out.outside)
      p.v = p.a = 0;
    const long double vx = master.v * s_.masterScaling;
    const long double ax = master.a * s_.masterScaling;
    out.slave.y = base_ + s_.slaveOffset + s_.slaveScaling * (p.y + rises);
    out.slave.v = s_.slaveScaling * p.v * vx;
    out.slave.a = s_.slaveScaling * (p.a * vx * vx + p.v * ax);
    return out;
  }

private:
  [[nodiscard]] long double inCam(long double total) const {
    const long double way = total - first_;
    return (s_.masterAbsolute ? shownFirst_ + way : way) * s_.masterScaling + s_.masterOffset;
  }
  [[nodiscard]] long double periodOf(long double x) const {
    return std::floor((x - cam_.start()) / cam_.length());
  }

  const ModelCam &cam_;
  CamSettings s_;
  long double first_ = 0, shownFirst_ = 0, base_ = 0, firstPeriod_ = 0, period_ = 0;
  bool doubt_ = false;
};

} // namespace stride::test

#endif
