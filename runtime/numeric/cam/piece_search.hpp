// Which piece of a curve a master position belongs to.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_PIECE_SEARCH_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_PIECE_SEARCH_HPP

#include <stdint.h>

namespace stride::cam {

/// The greatest of `pieces` >= 1 pieces that begins at or before `x`, else the first; `begin(i)`
/// ascends. Found from `hint` on, at once if it is near; from far away it is looked for where it
/// would be if all pieces were of one length (`length`, any number), and in doubling steps from
/// there.
template <class Begin>
uint32_t pieceAt(double x, uint32_t pieces, uint32_t hint, double length,
                 const Begin &begin) noexcept {
  if (hint >= pieces)
    hint = pieces - 1;
  const auto isAt = [&](uint32_t i) { return i == 0 || begin(i) <= x; };
  const double atHint = begin(hint);
  if (atHint <= x) {
    if (hint + 1 == pieces || x < begin(hint + 1))
      return hint;
    if (hint + 2 == pieces || x < begin(hint + 2))
      return hint + 1;
  } else if (hint == 0) {
    return 0;
  } else if (isAt(hint - 1)) {
    return hint - 1;
  }
  const double guess = hint + (x - atHint) / length;
  uint32_t low = guess > 0.0 ? (guess < pieces ? static_cast<uint32_t>(guess) : pieces - 1) : 0;
  uint32_t high; // begins after x, or is the end
  if (isAt(low)) {
    uint32_t step = 1;
    while (pieces - low > step && isAt(low + step)) {
      low += step;
      step *= 2;
    }
    high = pieces - low > step ? low + step : pieces;
  } else {
    high = low;
    uint32_t step = 1;
    while (high > step && !isAt(high - step)) {
      high -= step;
      step *= 2;
    }
    low = high > step ? high - step : 0;
  }
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    (isAt(middle) ? low : high) = middle;
  }
  return low;
}

} // namespace stride::cam

#endif
