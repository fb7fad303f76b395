#ifndef STRIDE_COMPILER_PLOT_PLOT_HPP
#define STRIDE_COMPILER_PLOT_PLOT_HPP
// Drawing a trace as SVG.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::plot {

/// What a curve shows.
struct Quantity {
  std::string title; ///< "Velocity"; for an unknown quantity the variable's own name
  std::string unit;  ///< "u/s"; may be empty
  bool operator==(const Quantity &) const = default;
};

/// One column of a trace. BOOL values are 0 and 1.
struct Series {
  std::string name;
  std::vector<double> values;
  bool isBool = false;
  std::optional<Quantity> quantity = {}; ///< nothing: guessed from the name
};

/// A place on the horizontal axis that a dashed line and a text mark.
struct Mark {
  double at = 0;
  std::string text;
};

/// A trace: values over time, or over something else that ascends.
struct Trace {
  std::vector<double> time; ///< s
  std::vector<Series> series;
  std::vector<Mark> marks;
  std::string axis = "Time [s]"; ///< what the horizontal axis is
};

/// Why a CSV text is no trace.
struct TraceError {
  size_t line = 0; ///< 1-based; 0: the text as a whole
  std::string message;
};

/// Reads the CSV that `stride sim --out` writes: a header `t,name,…`, then a row of numbers (or
/// TRUE, FALSE) per cycle.
[[nodiscard]] std::optional<Trace> readTrace(std::string_view csv, TraceError &error);

/// What a variable is a value of, guessed from its name: `Drive.fSetVelocity` is a velocity in u/s.
[[nodiscard]] Quantity quantityOf(std::string_view variable);

/// Round numbers that divide a range into about `count` parts.
struct Ticks {
  std::vector<double> values;
  int decimals = 0;
};
[[nodiscard]] Ticks niceTicks(double low, double high, int count);

/// The trace as an SVG picture, in the order of its columns: a panel per quantity with the curves
/// of all its columns; one with a thin lane per BOOL, as timing diagrams have them. Dashed lines
/// lead from the changes of BOOLs through all panels, unless they are many.
[[nodiscard]] std::string drawSvg(const Trace &trace);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_PLOT_HPP
