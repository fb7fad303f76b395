// Paths that are turned, shifted and stretched: SMC_RotateQueue2D, SMC_TranslateQueue3D,
// SMC_ScaleQueue3D, in place or from one queue into the next. Free of the C++ standard library:
// linked into every application.
// Source: SoftMotion V2.3 manual, section 6.4; with a queue of its own SoftMotion 3.
#ifndef STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRANSFORM_HPP
#define STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRANSFORM_HPP

#include "runtime/numeric/cnc/processors/stream.hpp"

namespace stride::cnc {

/// Turns an object around the Z axis, from X to Y. Multiples of 90 degrees are exact.
void rotateObject(PathObject &object, double degrees) noexcept;

/// Shifts it. [u] in
void translateObject(PathObject &object, const Vector3 &way) noexcept;

/// Stretches its X, Y and Z and its length from the origin, by a factor that is not 0; a negative
/// one also turns it through the origin. Velocities, other axes and distances that tools need stay.
void scaleObject(PathObject &object, double factor) noexcept;

enum class TransformKind : uint8_t {
  Rotate,    ///< By value.x degrees.
  Translate, ///< By value.
  Scale,     ///< By value.x.
};

struct Transform {
  TransformKind kind;
  Vector3 value;
};

/// Whether its numbers are finite, and no factor 0.
bool isUsable(const Transform &transform) noexcept;

void apply(const Transform &transform, PathObject &object) noexcept;

/// Changes the objects where they are that are in the queue since its writePosition was `seen`,
/// which is then set anew.
void transformInPlace(Queue *queue, const Transform &transform, uint32_t &seen) noexcept;

/// The user sets `wanted`; it is taken at the start of a path.
struct TransformPath {
  Transform wanted;
  Transform used;
};

struct RotatePath : TransformPath {
  static constexpr Generator kGenerator = kByRotateQueue;
  static constexpr bool kLooksAhead = false;
};
struct TranslatePath : TransformPath {
  static constexpr Generator kGenerator = kByTranslateQueue;
  static constexpr bool kLooksAhead = false;
};
struct ScalePath : TransformPath {
  static constexpr Generator kGenerator = kByScaleQueue;
  static constexpr bool kLooksAhead = false;
};

inline void start(TransformPath &path) noexcept { path.used = path.wanted; }
Step next(TransformPath &path, const Source &source, Output &output) noexcept;
/// A synchronisation stands where the path does.
inline void placePause(const TransformPath &path, PathObject &pause) noexcept {
  if (isUsable(path.used))
    apply(path.used, pause);
}
inline Step finish(TransformPath & /*path*/, Ending /*ending*/, Output & /*output*/) noexcept {
  return Step::Took;
}

} // namespace stride::cnc

#endif // STRIDE_RUNTIME_NUMERIC_CNC_PROCESSORS_TRANSFORM_HPP
