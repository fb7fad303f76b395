#include "runtime/numeric/profile/profile.hpp"

namespace stride::motion {

State Profile::at(double t) const noexcept {
  if (count == 0 || !(t < duration)) {
    State state = end;
    if (end.velocity != 0.0 && t > duration)
      state.position += end.velocity * (t - duration);
    return state;
  }
  if (t < 0.0)
    t = 0.0;
  int32_t index = count - 1;
  while (index > 0 && t < segments[index].start)
    --index;
  return segments[index].at(t);
}

} // namespace stride::motion
