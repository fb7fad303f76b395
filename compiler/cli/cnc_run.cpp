// stride cnc run, stride cnc plot

#include "compiler/cli/cnc_run.hpp"
#include "compiler/cli/cnc_path.hpp"
#include "compiler/plot/path_views.hpp"
#include "compiler/plot/plot.hpp"
#include "compiler/project/file_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

namespace {

using namespace stride::cnc;

/// Cycles of a picture at most; of longer motions it has every other one, and so on.
constexpr size_t kMostPlaces = 20000;

std::string outOf(const CncOptions &options, const std::string &path, std::string_view ending) {
  if (!options.out.empty())
    return options.out;
  return std::filesystem::path(path).replace_extension("").string().append(ending);
}

/// The greatest of something, and of each axis.
struct Peaks {
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
  std::array<double, kAxes> axisVelocity{};
  std::array<double, kAxes> axisAcceleration{};
};

void raise(double &peak, double value) { peak = std::max(peak, std::fabs(value)); }

/// Measures a motion as its set positions show it: by their differences from cycle to cycle.
class Meter {
public:
  explicit Meter(double cycle) : cycle_(cycle) {}

  void take(const Progress &progress) {
    way_ += progress.length;
    raise(peaks_.velocity, progress.motion.velocity);
    raise(peaks_.acceleration, progress.motion.acceleration);
    raise(peaks_.jerk, progress.motion.jerk);
    for (size_t axis = 0; axis < kAxes; ++axis) {
      const double here = progress.position.coordinate[axis];
      const double step = here - places_[0][axis];
      if (count_ > 0)
        raise(peaks_.axisVelocity[axis], step / cycle_);
      if (count_ > 1)
        raise(peaks_.axisAcceleration[axis],
              (step - (places_[0][axis] - places_[1][axis])) / (cycle_ * cycle_));
      places_[1][axis] = places_[0][axis];
      places_[0][axis] = here;
    }
    ++count_;
  }

  [[nodiscard]] double way() const { return way_; }
  [[nodiscard]] const Peaks &peaks() const { return peaks_; }

private:
  double cycle_;
  double way_ = 0;
  size_t count_ = 0;
  std::array<std::array<double, kAxes>, 2> places_{};
  Peaks peaks_;
};

std::string measured(double value) {
  const std::string text = fmt::format("{:.7g}", value);
  return text == "-0" ? "0" : text;
}

/// ` (limit 250)`, or nothing.
std::string limitText(double limit) {
  return limit > 0 ? fmt::format(" (limit {})", measured(limit)) : std::string();
}

std::string summaryOf(const std::string &file, const CncPath &path, double duration,
                      const Peaks &peaks, const CncMotionOptions &options) {
  std::string text = fmt::format("{}\n  duration      {} s\n  length        {}\n", file,
                                 measured(duration), measured(path.length));
  text += fmt::format("  objects       {} of the program, {} driven, {} of them blends\n",
                      path.programmed, path.objects.size(), path.blends);
  text += fmt::format("  stops         {}\n", path.stops);
  text += fmt::format("  velocity      {}\n  acceleration  {}\n", measured(peaks.velocity),
                      measured(peaks.acceleration));
  if (options.velocityMode == "quadratic")
    text += fmt::format("  jerk          {}{}\n", measured(peaks.jerk), limitText(options.jerk));
  for (size_t axis = 0; axis < kAxisLetters.size(); ++axis)
    if ((path.axes >> axis & 1) != 0)
      text += fmt::format("  {}             velocity {}{}, acceleration {}{}\n", kAxisLetters[axis],
                          measured(peaks.axisVelocity[axis]), limitText(options.maxVelocity[axis]),
                          measured(peaks.axisAcceleration[axis]),
                          limitText(options.maxAcceleration[axis]));
  return text;
}

/// The names of errors that the path can end with.
std::string errorText(int error) {
  switch (error) {
  case kCncTooLong:
    return "more than 30000000 cycles have passed: are the limits of axes too low?";
  case 1001:
    return "SMC_INT_VEL_ZERO: a motion without a velocity";
  case 1008:
    return "SMC_INT_VEL_ACC_DEC_ZERO: an acceleration or deceleration of 0";
  default:
    return fmt::format("error {} of SMC_Interpolator", error);
  }
}

/// The path of the program, driven.
bool drive(const CncProgram &program, const CncPath &path, const CncMotionOptions &options,
           Diagnostics &diagnostics, const CncCycle &cycle) {
  const int error = driveCnc(path, options, cycle);
  if (error != 0)
    diagnostics.report(Code::CncSentence, program.span,
                       fmt::format("the path cannot be driven: {}", errorText(error)));
  return error == 0;
}

/// Whether the table or picture would take the place of the program; says so.
bool isProgram(const std::string &file, const std::string &out, Diagnostics &diagnostics) {
  std::error_code unknown;
  if (!std::filesystem::equivalent(file, out, unknown))
    return false;
  diagnostics
      .report(Code::CannotWrite, {}, fmt::format("`{}` is the program: it is not overwritten", out))
      .help("name another file with -o");
  return true;
}

void report(Diagnostics &diagnostics, const std::string &out) {
  diagnostics.report(Code::CannotWrite, {},
                     fmt::format("`{}` cannot be written: {}", out, lastError()));
}

class Table {
public:
  explicit Table(uint16_t axes) : axes_(axes) {
    text_ = "t";
    for (size_t axis = 0; axis < kAxisLetters.size(); ++axis)
      if ((axes >> axis & 1) != 0)
        text_ += fmt::format(",{}", kAxisLetters[axis]);
    text_ += ",velocity,acceleration,way,line\n";
  }

  void take(double time, const Progress &progress, double way) {
    fmt::format_to(std::back_inserter(text_), "{:.9g}", time);
    for (size_t axis = 0; axis < kAxisLetters.size(); ++axis)
      if ((axes_ >> axis & 1) != 0)
        fmt::format_to(std::back_inserter(text_), ",{}", progress.position.coordinate[axis]);
    fmt::format_to(std::back_inserter(text_), ",{},{},{},{}\n", progress.motion.velocity,
                   progress.motion.acceleration, way, progress.source);
  }

  [[nodiscard]] const std::string &text() const { return text_; }

private:
  uint16_t axes_;
  std::string text_;
};

/// Every n-th cycle of a motion; n grows with it.
class Places {
public:
  void take(double time, const Progress &progress) {
    if (count_++ % step_ != 0)
      return;
    times_.push_back(time);
    const double *at = progress.position.coordinate;
    places_.push_back({{at[kAxisX], at[kAxisY], at[kAxisZ]}, progress.motion.velocity});
    accelerations_.push_back(progress.motion.acceleration);
    jerks_.push_back(progress.motion.jerk);
    if (times_.size() > kMostPlaces)
      thin();
  }

  [[nodiscard]] bool empty() const { return times_.empty(); }

  [[nodiscard]] std::string draw(const std::string &title) const {
    plot::Trace trace;
    trace.time = times_;
    const auto add = [&trace](const char *name, const char *unit, std::vector<double> values) {
      plot::Series &series = trace.series.emplace_back();
      series.name = name;
      series.quantity = plot::Quantity{name, unit};
      series.values = std::move(values);
    };
    std::vector<double> velocities;
    for (const plot::PathPlace &place : places_)
      velocities.push_back(place.velocity);
    add("Velocity", "u/s", velocities);
    add("Acceleration", "u/s\xC2\xB2", accelerations_);
    add("Jerk", "u/s\xC2\xB3", jerks_);
    return plot::drawPath(places_, trace, title);
  }

private:
  void thin() {
    const auto halve = [](auto &values) {
      size_t to = 0;
      for (size_t from = 0; from < values.size(); from += 2)
        values[to++] = values[from];
      values.resize(to);
    };
    halve(times_);
    halve(places_);
    halve(accelerations_);
    halve(jerks_);
    step_ *= 2;
  }

  size_t count_ = 0;
  size_t step_ = 1;
  std::vector<double> times_, accelerations_, jerks_;
  std::vector<plot::PathPlace> places_;
};

} // namespace

void runCnc(const std::string &file, CncProgram &program, const CncOptions &options,
            Diagnostics &diagnostics, std::string &says) {
  const CncMotionOptions &motion = options.motion;
  const std::string out = outOf(options, file, ".csv");
  if (isProgram(file, out, diagnostics))
    return;
  const std::optional<CncPath> path = cncPathOf(program, motion, diagnostics);
  if (!path)
    return;
  Meter meter(motion.cycle);
  Table table(path->axes);
  double duration = 0;
  const bool driven =
      drive(program, *path, motion, diagnostics, [&](double time, const Progress &progress) {
        meter.take(progress);
        table.take(time, progress, meter.way());
        duration = time;
      });
  if (!driven)
    return;
  if (!writeFile(out, table.text()))
    report(diagnostics, out);
  else
    says = summaryOf(file, *path, duration, meter.peaks(), motion);
}

void plotCnc(const std::string &file, CncProgram &program, const CncOptions &options,
             Diagnostics &diagnostics, std::string &says) {
  const std::string out = outOf(options, file, ".svg");
  if (isProgram(file, out, diagnostics))
    return;
  const std::optional<CncPath> path = cncPathOf(program, options.motion, diagnostics);
  if (!path)
    return;
  Places places;
  if (!drive(program, *path, options.motion, diagnostics,
             [&places](double time, const Progress &progress) { places.take(time, progress); }))
    return;
  if (places.empty()) {
    diagnostics.report(Code::CncSentence, program.span, "nothing moves in this program");
    return;
  }
  if (!writeFile(out, places.draw(program.title.empty() ? program.name : program.title)))
    report(diagnostics, out);
  else
    says = out + "\n";
}

} // namespace stc::cli
