// Tables: the forms EvenTable and PairTable of a curve. Part of curve.hpp, which is for everybody.
#ifndef STRIDE_RUNTIME_NUMERIC_CAM_TABLE_HPP
#define STRIDE_RUNTIME_NUMERIC_CAM_TABLE_HPP

#include "runtime/numeric/cam/curve.hpp"

namespace stride::cam {

/// A piece of a table: y0 + (m + (c2 + c3 * way) * way) * way, with the way from `left`.
struct TablePiece {
  double left;
  double length;
  double y0;
  double m;
  double c2;
  double c3;
};

/// Piece `index` of a table. `periodic` as for evaluateCurve.
TablePiece tablePiece(const Curve &table, bool periodic, uint32_t index) noexcept;

/// evaluateCurve of a table.
Point evaluateTable(const Curve &table, double x, bool periodic, uint32_t &index) noexcept;

/// The slave position at the end of a piece. [slave u]
double endOfTablePiece(const Curve &table, uint32_t index) noexcept;

/// The slave position at the end minus the one at the start. [slave u]
double riseOfTable(const Curve &table) noexcept;

/// checkForm and areGoodPieces of a table.
CurveError checkTableForm(const Curve &table) noexcept;
bool areGoodTablePieces(const Curve &table, uint32_t first, uint32_t end) noexcept;

} // namespace stride::cam

#endif
