#ifndef STRIDE_COMPILER_PLOT_PLOT_HPP
#define STRIDE_COMPILER_PLOT_PLOT_HPP
// Drawing a trace as SVG.

#include <cstdint>
#include <functional>
#include <map>
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
  /// A state: the names of its values. It is drawn as a lane, like a BOOL.
  std::map<int64_t, std::string> states = {};

  [[nodiscard]] bool isLane() const { return isBool || !states.empty(); }
};

/// What is known of a variable whose values are a column.
struct ColumnType {
  enum class Kind { Bool, Number, State };
  Kind kind = Kind::Number;
  std::map<int64_t, std::string> states; ///< of a State
};

/// What draws together, where the user says so.
struct PanelChoice {
  std::string title;                ///< empty: of the quantity
  std::vector<std::string> columns; ///< names, with `*` and `?`
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
  std::string title;             ///< above the picture; may be empty
  /// The panels and what is in them, from top to bottom; none: a panel per quantity.
  std::vector<PanelChoice> panels;
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

/// `Velocity [u/s]`
[[nodiscard]] std::string labelOf(const Quantity &quantity);
/// The name of a state's value; the number where it has none.
[[nodiscard]] std::string stateName(const Series &series, double value);

/// Takes over what is known of the columns: whether they are BOOLs or states, and what one
/// technical unit is. Each function may know nothing of a name.
void describeColumns(Trace &trace,
                     const std::function<std::optional<ColumnType>(const std::string &)> &typeOf,
                     const std::function<std::string(const std::string &)> &technicalUnitOf);

/// Leaves only the rows from `from` to `to`. False: there are none.
[[nodiscard]] bool cut(Trace &trace, double from, double to);

/// A panel of the picture.
struct Panel {
  Quantity quantity;
  std::vector<const Series *> series;
  bool lanes = false; ///< BOOLs and states
};
/// The panels in the order in which the trace names the first column of each, or as it chooses
/// them. The trace must outlive them.
[[nodiscard]] std::vector<Panel> arrange(const Trace &trace);

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

/// The trace as an HTML page that needs nothing else: the same panels, with a cursor that shows the
/// values, and a zoom.
[[nodiscard]] std::string drawPage(const Trace &trace);

} // namespace stc::plot

#endif // STRIDE_COMPILER_PLOT_PLOT_HPP
