// Joints: what is known of their derivatives, and the normal equations for the rest.
#include "runtime/numeric/cam/builder.hpp"

#include "runtime/numeric/cam/builder_shapes.hpp"

#include <cstddef>

namespace stride::cam {
namespace {

constexpr int kDerivatives = 3; // v, a, j

/// What a kind of piece makes of a derivative of its boundaries.
enum class Role : uint8_t {
  Uses,  ///< Has the value of the boundary.
  Fixes, ///< Has a value of its own.
  Leaves ///< Follows from the others.
};

Role roleOf(const Piece &piece, int derivative) noexcept {
  const Role follows = derivative == 2 ? Role::Leaves : Role::Fixes;
  switch (piece.kind) {
  case PieceKind::Poly5:
    return derivative < 2 ? Role::Uses : Role::Leaves;
  case PieceKind::Poly7:
    return Role::Uses;
  case PieceKind::InclinedSine:
    return follows;
  case PieceKind::ModifiedSine:
  case PieceKind::ModifiedSineLimited:
    return derivative == 0 ? Role::Uses : follows;
  case PieceKind::Law:
    return derivative == 0 || (derivative == 1 && piece.law != Law::Harmonic) ? Role::Uses
                                                                              : Role::Leaves;
  default:
    return Role::Fixes;
  }
}

bool gives(const Boundary &boundary, int derivative) noexcept {
  return boundary.given > derivative + 2;
}

double givenValue(const Boundary &boundary, int derivative) noexcept {
  return derivative == 0 ? boundary.v : derivative == 1 ? boundary.a : boundary.j;
}

/// The integral of the squared third derivative on 0 to 1 is z' of[..] z, with z as the columns
/// above.
struct Energy {
  double of[kUnknowns + 1][kUnknowns + 1];
};

constexpr Energy energyOf(const Shape &shape) noexcept {
  Energy energy = {};
  for (int r = 0; r < 5; ++r)
    for (int s = 0; s < 5; ++s) {
      const double i = r + 3;
      const double k = s + 3;
      const double weight = i * (i - 1.0) * (i - 2.0) * k * (k - 1.0) * (k - 2.0) / (i + k - 5.0);
      for (int p = 0; p <= kUnknowns; ++p)
        for (int q = 0; q <= kUnknowns; ++q)
          energy.of[p][q] += weight * shape.row[r][p] * shape.row[s][q];
    }
  return energy;
}

constexpr Energy kQuinticEnergy = energyOf(kQuintic);
constexpr Energy kSepticEnergy = energyOf(kSeptic);

/// The given polynomial `way` after its left end.
Point given(const Piece &piece, double way) noexcept {
  const double *c = piece.coefficients;
  Point at = {c[7], 0.0, 0.0, 0.0};
  for (int i = 6; i >= 0; --i) {
    at.j = at.j * way + at.a;
    at.a = at.a * way + at.v;
    at.v = at.v * way + at.y;
    at.y = at.y * way + c[i];
  }
  at.a *= 2.0;
  at.j *= 6.0;
  return at;
}

double part(const Point &point, int derivative) noexcept {
  return derivative == 0 ? point.v : derivative == 1 ? point.a : point.j;
}

double &entry(double (&block)[9], int row, int column) noexcept { return block[3 * row + column]; }
double &lower(double (&block)[6], int row, int column) noexcept {
  return block[row * (row + 1) / 2 + column];
}
double lower(const double (&block)[6], int row, int column) noexcept {
  return block[row * (row + 1) / 2 + column];
}

/// L D L' in place; a pivot that is nothing but rounding becomes 0, and what belongs to it stays
/// out.
void factoriseBlock(JointWork &joint) noexcept {
  for (int k = 0; k < kDerivatives; ++k) {
    double pivot = lower(joint.diagonal, k, k);
    for (int m = 0; m < k; ++m)
      pivot -=
          lower(joint.diagonal, k, m) * lower(joint.diagonal, k, m) * lower(joint.diagonal, m, m);
    if (!(pivot > 1e-12 * joint.pivot[k]))
      pivot = 0.0;
    lower(joint.diagonal, k, k) = pivot;
    for (int i = k + 1; i < kDerivatives; ++i) {
      double sum = lower(joint.diagonal, i, k);
      for (int m = 0; m < k; ++m)
        sum -=
            lower(joint.diagonal, i, m) * lower(joint.diagonal, k, m) * lower(joint.diagonal, m, m);
      lower(joint.diagonal, i, k) = pivot > 0.0 ? sum / pivot : 0.0;
    }
  }
}

/// In place.
void solveBlock(const JointWork &joint, double (&right)[3]) noexcept {
  for (int i = 1; i < kDerivatives; ++i)
    for (int m = 0; m < i; ++m)
      right[i] -= lower(joint.diagonal, i, m) * right[m];
  for (int i = 0; i < kDerivatives; ++i) {
    const double pivot = lower(joint.diagonal, i, i);
    right[i] = pivot > 0.0 ? right[i] / pivot : 0.0;
  }
  for (int i = kDerivatives - 2; i >= 0; --i)
    for (int m = i + 1; m < kDerivatives; ++m)
      right[i] -= lower(joint.diagonal, m, i) * right[m];
}

/// Row `row` of `block` times the inverse of the joint's diagonal block.
void rowOverDiagonal(const JointWork &joint, const double (&block)[9], int row,
                     double (&result)[3]) noexcept {
  for (int i = 0; i < kDerivatives; ++i)
    result[i] = block[3 * row + i];
  solveBlock(joint, result);
}

double dot(const double (&a)[3], const double *b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

} // namespace

Builder::Builder(const Piece *pieces, int32_t count, bool closed, JointWork *work) noexcept
    : pieces_(pieces), count_(count), closed_(closed && count > 0 && pieces[0].left.given == 0),
      work_(work) {}

/// Where nothing is in front.
bool Builder::isFirst(int32_t piece, bool right) const noexcept {
  return piece == 0 && !right && !closed_;
}

int32_t Builder::jointOf(int32_t piece, bool right) const noexcept {
  return right ? piece + 1 : piece > 0 || !closed_ ? piece : count_;
}

Builder::Ends Builder::ends(int32_t piece) const noexcept {
  const Boundary &left = pieces_[piece].left;
  const Boundary &right = pieces_[piece].right;
  Ends result = {{0.0, 0.0}, {0.0, 0.0}};
  if (left.given != 0) {
    result.x[0] = left.x;
    result.y[0] = left.y;
  } else if (piece > 0) {
    result.x[0] = pieces_[piece - 1].right.x;
    result.y[0] = pieces_[piece - 1].right.y;
  } else if (closed_) {
    result.y[0] = pieces_[count_ - 1].right.y;
  }
  const Boundary &end = right.given != 0 || piece + 1 == count_ ? right : pieces_[piece + 1].left;
  result.x[1] = end.x;
  result.y[1] = end.y;
  return result;
}

/// What the piece itself says, its neighbours left aside.
Builder::Value Builder::ownValue(int32_t index, bool right, int which) const noexcept {
  const Piece &piece = pieces_[index];
  const Boundary &boundary = right ? piece.right : piece.left;
  const Ends at = ends(index);
  switch (roleOf(piece, which)) {
  case Role::Uses:
    return gives(boundary, which) ? Value{givenValue(boundary, which), false} : Value{0.0, true};
  case Role::Fixes:
    if (piece.kind == PieceKind::Line)
      return {which == 0 ? (at.y[1] - at.y[0]) / (at.x[1] - at.x[0]) : 0.0, false};
    if (piece.kind == PieceKind::Coefficients)
      return {part(given(piece, right ? at.x[1] - at.x[0] : 0.0), which), false};
    return {0.0, false};
  case Role::Leaves:
    break;
  }
  // It follows from lower derivatives, if those are known.
  double z[7] = {};
  for (int d = 0; d < which; ++d)
    for (int side = 0; side < 2; ++side) {
      if (roleOf(piece, d) != Role::Uses)
        continue;
      const Value known = derivative(index, side == 1, d);
      if (known.open)
        return {0.0, true};
      z[kDerivatives * side + d] = known.value;
    }
  Segment segments[2];
  int32_t count = 0;
  if (build(index, z, segments, count) != BuildError::None)
    return {0.0, true};
  return {part(evaluateSegment(segments[right ? count - 1 : 0], at.x[right ? 1 : 0]), which),
          false};
}

/// Calls itself with lower derivatives only.
Builder::Value Builder::derivative(int32_t index, bool right, int which) const noexcept {
  const Value own = ownValue(index, right, which);
  if (!own.open || roleOf(pieces_[index], which) != Role::Uses)
    return own;
  if (isFirst(index, right))
    return {0.0, pieces_[0].left.given != 0};
  if (right && index + 1 == count_ && !closed_)
    return own;
  const int32_t other = right ? (index + 1) % count_ : (index + count_ - 1) % count_;
  return ownValue(other, !right, which);
}

/// The pieces's part of the normal equations.
void Builder::addEnergy(int32_t index) noexcept {
  const PieceKind kind = pieces_[index].kind;
  if (kind != PieceKind::Poly5 && kind != PieceKind::Poly7)
    return;
  const Energy &energy = kind == PieceKind::Poly5 ? kQuinticEnergy : kSepticEnergy;
  const Ends at = ends(index);
  const double h = at.x[1] - at.x[0];
  double scale[kUnknowns + 1];
  bool open[kUnknowns];
  double z[kUnknowns + 1];
  bool any = false;
  for (int side = 0; side < 2; ++side) {
    double power = h;
    for (int d = 0; d < kDerivatives; ++d, power *= h) {
      const int i = kDerivatives * side + d;
      const bool used = roleOf(pieces_[index], d) == Role::Uses;
      const Value value = used ? derivative(index, side == 1, d) : Value{0.0, false};
      scale[i] = power;
      open[i] = value.open;
      z[i] = value.open ? 0.0 : value.value * power;
      any = any || value.open;
    }
  }
  if (!any)
    return;
  z[kUnknowns] = at.y[1] - at.y[0];
  const double weight = 1.0 / (h * h * h * h * h);
  const int32_t joints[2] = {jointOf(index, false), jointOf(index, true)};
  for (int p = 0; p < kUnknowns; ++p) {
    if (!open[p])
      continue;
    const int row = p % kDerivatives;
    JointWork &joint = work_[joints[p / kDerivatives]];
    double gradient = 0.0;
    for (int q = 0; q <= kUnknowns; ++q)
      gradient += energy.of[p][q] * z[q];
    joint.value[row] -= weight * scale[p] * gradient;
    for (int q = 0; q < kUnknowns; ++q) {
      if (!open[q])
        continue;
      const int column = q % kDerivatives;
      const double value = weight * scale[p] * scale[q] * energy.of[p][q];
      const int32_t mine = joints[p / kDerivatives];
      const int32_t others = joints[q / kDerivatives];
      if (mine == others) {
        if (column <= row)
          lower(joint.diagonal, row, column) += value;
      } else if (closed_ && mine == count_) {
        entry(work_[others].around, row, column) += value;
      } else if (mine == others + 1 && !(closed_ && others == count_)) {
        entry(joint.before, row, column) += value;
      }
    }
  }
}

/// Solves the normal equations: `value` holds the right side before, the solution afterwards.
void Builder::factorise() noexcept {
  const int32_t first = closed_ ? 1 : 0;
  JointWork &last = work_[count_];
  double x[3];
  for (int32_t k = first; k <= count_; ++k) {
    JointWork &joint = work_[k];
    factoriseBlock(joint);
    if (k == count_)
      break;
    const bool direct = !(closed_ && k + 1 == count_);
    JointWork &next = work_[k + 1];
    for (int row = 0; row < kDerivatives && direct; ++row) {
      rowOverDiagonal(joint, next.before, row, x);
      for (int column = 0; column <= row; ++column)
        lower(next.diagonal, row, column) -=
            dot(x, &next.before[size_t{3} * static_cast<size_t>(column)]);
      next.value[row] -= dot(x, joint.value);
    }
    for (int row = 0; row < kDerivatives && closed_; ++row) {
      rowOverDiagonal(joint, joint.around, row, x);
      for (int column = 0; column <= row; ++column)
        lower(last.diagonal, row, column) -=
            dot(x, &joint.around[size_t{3} * static_cast<size_t>(column)]);
      last.value[row] -= dot(x, joint.value);
      for (int column = 0; column < kDerivatives && direct; ++column)
        entry(next.around, row, column) -=
            dot(x, &next.before[size_t{3} * static_cast<size_t>(column)]);
    }
  }
  for (int32_t k = count_; k >= first; --k) {
    JointWork &joint = work_[k];
    for (int i = 0; i < kDerivatives && k < count_; ++i) {
      for (int m = 0; m < kDerivatives; ++m) {
        if (!(closed_ && k + 1 == count_))
          joint.value[i] -= entry(work_[k + 1].before, m, i) * work_[k + 1].value[m];
        if (closed_)
          joint.value[i] -= entry(joint.around, m, i) * last.value[m];
      }
    }
    solveBlock(joint, joint.value);
  }
}

BuildError Builder::solve() noexcept {
  if (count_ < 1)
    return BuildError::NoPieces;
  for (int32_t i = 1; i <= count_; ++i) {
    const BuildError problem = checkLast(pieces_, i);
    if (problem != BuildError::None)
      return problem;
  }
  if (pieces_[count_ - 1].right.given == 0)
    return BuildError::BoundaryUnknown;
  for (int32_t k = 0; k <= count_; ++k)
    work_[k] = {};
  for (int32_t i = 0; i < count_; ++i)
    addEnergy(i);
  for (int32_t k = 0; k <= count_; ++k)
    for (int i = 0; i < kDerivatives; ++i)
      work_[k].pivot[i] = lower(work_[k].diagonal, i, i);
  factorise();
  return BuildError::None;
}

BuildError Builder::segments(int32_t index, Segment (&result)[2], int32_t &count) const noexcept {
  double z[7] = {};
  for (int side = 0; side < 2; ++side)
    for (int d = 0; d < kDerivatives; ++d) {
      if (roleOf(pieces_[index], d) != Role::Uses)
        continue;
      const Value known = derivative(index, side == 1, d);
      z[kDerivatives * side + d] =
          known.open ? work_[jointOf(index, side == 1)].value[d] : known.value;
    }
  return build(index, z, result, count);
}

} // namespace stride::cam
