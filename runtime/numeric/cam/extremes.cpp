#include "runtime/numeric/cam/extremes.hpp"

#include "runtime/iec/math.h"
#include "runtime/numeric/exact_math.hpp"

namespace stride::cam {
namespace {

constexpr double kHalfTurn = 0x1.921fb54442d18p+1;

bool isPlain(const Smooth &f) noexcept { return f.sine == 0.0 && f.cosine == 0.0; }

/// Whether the polynomial is no more than a constant.
bool isConstant(const Smooth &f) noexcept {
  return f.degree == 0 || (f.degree == 1 && f.c[1] == 0.0);
}

/// Forgets highest coefficients that are 0.
void trim(Smooth &f) noexcept {
  while (f.degree > 0 && f.c[f.degree] == 0.0)
    --f.degree;
}

/// The root between two arguments with values of different sign.
double rootBetween(const Smooth &f, const Smooth &slope, double low, double high,
                   bool fallsThrough) noexcept {
  const double enough = (f.high - f.low) * 0x1p-34;
  double u = 0.5 * (low + high);
  for (int i = 0; i < 64 && high - low > enough; ++i) {
    const double value = valueOf(f, u);
    ((value < 0.0) == fallsThrough ? high : low) = u;
    double next = u - value / valueOf(slope, u); // Newton's step, while it helps
    if (!(next > low && next < high))
      next = 0.5 * (low + high);
    if (exact::fabs(next - u) < 0.25 * enough)
      return next;
    u = next;
  }
  return u;
}

/// Of a sine without a polynomial.
int rootsOfSine(const Smooth &f, double (&roots)[kMostRoots]) noexcept {
  if (isPlain(f) || f.omega == 0.0)
    return 0;
  // sine * sin(x) + cosine * cos(x) = r * sin(x + angle)
  const double angle = ::stride::atan2(f.cosine, f.sine);
  const double atLow = (f.omega * f.low + angle) / kHalfTurn;
  const double atHigh = (f.omega * f.high + angle) / kHalfTurn;
  const double first = exact::ceil(exact::smaller(atLow, atHigh));
  const double last = exact::floor(exact::larger(atLow, atHigh));
  int count = 0;
  for (double k = first; k <= last && count < 4; k += 1.0)
    roots[count++] = (k * kHalfTurn - angle) / f.omega;
  if (f.omega < 0.0)
    for (int i = 0; i < count / 2; ++i) {
      const double swapped = roots[i];
      roots[i] = roots[count - 1 - i];
      roots[count - 1 - i] = swapped;
    }
  return count;
}

/// A piece of a law over s: c[0] + c[1] t + c[2] t^2 + amplitude * sin(omega t + phase), t = s -
/// begin.
struct LawPiece {
  double begin;
  double end;
  double c[3];
  double amplitude;
  double omega;
  double phase;
};

/// The first half of a symmetric law, from 0 to 0.5; returns how many pieces.
int unitPieces(const LawShape &shape, LawPiece (&pieces)[3]) noexcept {
  switch (shape.law) {
  case Law::Harmonic:
    pieces[0] = {0.0, 0.5, {0.5, 0.0, 0.0}, -0.5, kHalfTurn, 0.5 * kHalfTurn};
    return 1;
  case Law::Cycloidal:
    pieces[0] = {0.0, 0.5, {0.0, 1.0, 0.0}, -0.5 / kHalfTurn, 2.0 * kHalfTurn, 0.0};
    return 1;
  case Law::ModifiedSine: {
    const double b = 0.5 * shape.parameter;
    const double rise = 2.0 * b / kHalfTurn;
    const double fall = (1.0 - 2.0 * b) / kHalfTurn;
    const double top =
        1.0 / (2.0 * b / kHalfTurn + 4.0 / (kHalfTurn * kHalfTurn) * (0.5 - 2.0 * b));
    int count = 0;
    if (b > 0.0)
      pieces[count++] = {0.0, b, {0.0, top * rise, 0.0}, -top * rise * rise, 1.0 / rise, 0.0};
    pieces[count++] = {b,
                       0.5,
                       {top * (rise * (b - rise) + fall * fall), top * rise, 0.0},
                       -top * fall * fall,
                       1.0 / fall,
                       0.5 * kHalfTurn};
    return count;
  }
  case Law::ModifiedTrapezoid: {
    const double top = 8.0 * kHalfTurn / (2.0 + kHalfTurn);
    const double rise = 0.25 / kHalfTurn;
    const double y1 = top * rise * (0.125 - rise);
    const double v1 = top * rise;
    const double y2 = y1 + v1 * 0.25 + 0.03125 * top;
    const double v2 = v1 + 0.25 * top;
    pieces[0] = {0.0, 0.125, {0.0, v1, 0.0}, -top * rise * rise, 1.0 / rise, 0.0};
    pieces[1] = {0.125, 0.375, {y1, v1, 0.5 * top}, 0.0, 0.0, 0.0};
    pieces[2] = {
        0.375,          0.5, {y2 + top * rise * rise, v2, 0.0}, -top * rise * rise, 1.0 / rise,
        0.5 * kHalfTurn};
    return 3;
  }
  case Law::Polynomial:
    break;
  }
  return 0;
}

LawPiece stretchedPiece(const LawPiece &piece, double factor) noexcept {
  return {piece.begin * factor,
          piece.end * factor,
          {piece.c[0] * factor, piece.c[1], piece.c[2] / factor},
          piece.amplitude * factor,
          piece.omega / factor,
          piece.phase};
}

/// Turned round: 1 - piece(1 - s).
LawPiece turnedPiece(const LawPiece &piece) noexcept {
  const double length = piece.end - piece.begin;
  const double *c = piece.c;
  return {1.0 - piece.end,
          1.0 - piece.begin,
          {1.0 - (c[0] + (c[1] + c[2] * length) * length), c[1] + 2.0 * c[2] * length, -c[2]},
          -piece.amplitude,
          -piece.omega,
          piece.omega * length + piece.phase};
}

/// All of a law, in ascending order; returns how many pieces.
int lawPieces(const LawShape &shape, LawPiece (&pieces)[6]) noexcept {
  LawPiece half[3];
  const int count = unitPieces(shape, half);
  for (int i = 0; i < count; ++i) {
    pieces[i] = stretchedPiece(half[i], 2.0 * shape.inflexion);
    pieces[2 * count - 1 - i] = turnedPiece(stretchedPiece(half[i], 2.0 * (1.0 - shape.inflexion)));
  }
  return 2 * count;
}

} // namespace

double valueOf(const Smooth &f, double u) noexcept {
  double y = f.c[f.degree];
  for (int i = f.degree - 1; i >= 0; --i)
    y = y * u + f.c[i];
  if (isPlain(f))
    return y;
  return y + f.sine * ::stride::sin(f.omega * u) + f.cosine * ::stride::cos(f.omega * u);
}

Smooth derivativeOf(const Smooth &f) noexcept {
  Smooth out = f;
  for (int i = 0; i < f.degree; ++i)
    out.c[i] = (i + 1) * f.c[i + 1];
  out.c[f.degree] = 0.0;
  if (out.degree > 0)
    --out.degree;
  out.sine = -f.omega * f.cosine;
  out.cosine = f.omega * f.sine;
  return out;
}

Smooth combined(const Smooth &f, double factor, const Smooth &g, double factorG) noexcept {
  Smooth out = f;
  if (g.degree > f.degree)
    out.degree = g.degree;
  for (int i = 0; i < 8; ++i)
    out.c[i] = factor * f.c[i] + factorG * g.c[i];
  out.sine = factor * f.sine + factorG * g.sine;
  out.cosine = factor * f.cosine + factorG * g.cosine;
  return out;
}

int rootsOf(const Smooth &f, double (&roots)[kMostRoots]) noexcept {
  Smooth chain[9];
  chain[0] = f;
  trim(chain[0]);
  int last = 0;
  // Down to a constant, or to a sine alone.
  while (last < 8 && !(isPlain(chain[last]) ? isConstant(chain[last])
                                            : isConstant(chain[last]) && chain[last].c[0] == 0.0)) {
    chain[last + 1] = derivativeOf(chain[last]);
    ++last;
  }
  // From the last derivative upwards: between two roots of its derivative a function has at most
  // one.
  int count = rootsOfSine(chain[last], roots);
  for (int level = last - 1; level >= 0; --level) {
    const Smooth &here = chain[level];
    double found[kMostRoots];
    int foundCount = 0;
    double low = f.low;
    bool lowBelow = valueOf(here, low) < 0.0;
    for (int i = 0; i <= count; ++i) {
      const double high = i < count ? roots[i] : f.high;
      const bool highBelow = valueOf(here, high) < 0.0;
      if (lowBelow != highBelow && foundCount < kMostRoots)
        found[foundCount++] = rootBetween(here, chain[level + 1], low, high, highBelow);
      low = high;
      lowBelow = highBelow;
    }
    count = foundCount;
    for (int i = 0; i < count; ++i)
      roots[i] = found[i];
  }
  return count;
}

int partsOf(const Segment &segment, Smooth (&parts)[kMostParts]) noexcept {
  Smooth whole;
  for (int i = 0; i < 8; ++i)
    whole.c[i] = segment.coefficients[i];
  LawPiece pieces[6];
  const double extent = segment.lawEnd - segment.lawBegin;
  const int pieceCount = lawPieces({segment.law, segment.parameter, segment.inflexion}, pieces);
  int count = 0;
  for (int i = 0; i < pieceCount && extent != 0.0; ++i) {
    const LawPiece &piece = pieces[extent > 0.0 ? i : pieceCount - 1 - i];
    const double atBegin = (piece.begin - segment.lawBegin) / extent;
    const double atEnd = (piece.end - segment.lawBegin) / extent;
    Smooth part = whole;
    part.low = count > 0 ? parts[count - 1].high : 0.0;
    part.high = exact::smaller(exact::larger(atBegin, atEnd), 1.0);
    if (!(part.high > part.low))
      continue;
    const double p = segment.lawBegin - piece.begin; // t = p + extent * u
    const double stroke = segment.stroke;
    part.c[0] += stroke * (piece.c[0] + (piece.c[1] + piece.c[2] * p) * p);
    part.c[1] += stroke * extent * (piece.c[1] + 2.0 * piece.c[2] * p);
    part.c[2] += stroke * extent * extent * piece.c[2];
    const double phase = piece.omega * p + piece.phase;
    part.omega = piece.omega * extent;
    part.sine = stroke * piece.amplitude * ::stride::cos(phase);
    part.cosine = stroke * piece.amplitude * ::stride::sin(phase);
    trim(part);
    parts[count++] = part;
  }
  if (count > 0) {
    parts[count - 1].high = 1.0;
    return count;
  }
  if (segment.law != Law::Polynomial)
    whole.c[0] +=
        segment.stroke *
        evaluateLaw({segment.law, segment.parameter, segment.inflexion}, segment.lawBegin).y;
  trim(whole);
  parts[0] = whole;
  return 1;
}

} // namespace stride::cam
