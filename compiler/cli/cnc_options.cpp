// The commands below `stride cnc`.

#include "compiler/assets/cnc/values.hpp"
#include "compiler/cli/cnc_path.hpp"
#include "compiler/cli/command_line.hpp"
#include "compiler/toml/interval.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace stc::cli {

namespace {

/// A number in some range.
CLI::Validator numberFrom(double least, bool included, double most = INFINITY) {
  return {[=](std::string &text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                              (included ? value >= least : value > least) && value <= most;
            return good ? std::string() : "`" + text + "` is no number that is possible here";
          },
          std::string()};
}

/// Reads `X=250,Y=100`: what each axis gets, and which ones are named. What is wrong, or nothing.
std::string readAxes(const std::string &text, bool positive, double (&values)[12],
                     uint16_t &named) {
  for (size_t at = 0; at <= text.size();) {
    const size_t end = std::min(text.find(',', at), text.size());
    const std::string one = text.substr(at, end - at);
    const size_t axis = one.empty() ? std::string_view::npos : kAxisLetters.find(one[0]);
    double value = 0;
    if (axis == std::string_view::npos || one.size() < 3 || one[1] != '=' ||
        !CLI::detail::lexical_cast(one.substr(2), value) || (positive && !(value > 0)) ||
        !std::isfinite(value))
      return "`" + one + "` is no " + (positive ? "limit" : "coordinate") + " of an axis: X=250";
    values[axis] = value;
    named = static_cast<uint16_t>(named | 1U << axis);
    at = end + 1;
  }
  return {};
}

/// Reads `tool,loops`, or `none`. What is wrong, or nothing.
std::string readProcessors(const std::string &text, std::vector<CncProcessor> &processors) {
  processors.clear();
  for (size_t at = 0; at <= text.size() && text != "none";) {
    const size_t end = std::min(text.find(',', at), text.size());
    const std::optional<CncProcessor> processor = cncProcessor(text.substr(at, end - at));
    if (!processor)
      return "`" + text.substr(at, end - at) + "` is none of tool, loops, smooth, round";
    processors.push_back(*processor);
    at = end + 1;
  }
  const std::optional<CncOrderFault> fault = findOrderFault(processors);
  return fault ? fault->message : std::string();
}

/// Declares commands on CNC programs.
class CncCommands {
public:
  CncCommands(CLI::App &app, Invocation &call)
      : cnc_(app.add_subcommand(
            "cnc", "Check, describe, format, drive and draw CNC programs, make queue files")),
        call_(&call) {
    cnc_->require_subcommand(1);
  }

  void declare() const {
    add("check", CncAction::Check, "Show what is wrong with CNC programs");
    angleTolerance(
        add("info", CncAction::Info, "Show lines, objects, lengths, bounds and velocities"),
        call_->cnc.motion);
    add("format", CncAction::Format, "Write CNC programs in one layout")
        ->add_flag("--check", call_->cnc.check,
                   "Write nothing; fail if something is not formatted");
    declareMotion(add("run", CncAction::Run,
                      "Drive a CNC program without an application, write set positions"),
                  "CSV file to write (default: FILE with .csv)");
    declareMotion(add("plot", CncAction::Plot,
                      "Draw the path of a CNC program, and velocity, acceleration and jerk"),
                  "SVG file to write (default: FILE with .svg)");
    declareQueue(add("queue", CncAction::Queue,
                     "Write the path of a CNC program as a file for SMC_ReadNCQueue"));
    declareNumber(add("number", CncAction::Number,
                      "Number the sentences of a CNC program anew; jumps follow"));
    declareMoves();
    declareCuts();
    declareCncDrawings(*cnc_, *call_);
    declareValues(cnc_->get_subcommand("export-dxf"));
  }

private:
  CLI::App *add(const char *name, CncAction action, const char *what) const {
    CLI::App *command = cnc_->add_subcommand(name, what);
    CLI::Option *files = command->add_option("FILE", call_->cnc.files, "CNC file (*.cnc)")
                             ->required()
                             ->type_name("");
    if (action == CncAction::Run || action == CncAction::Plot || action >= CncAction::Queue)
      files->expected(1);
    if ((action != CncAction::Format && action < CncAction::Number) || action == CncAction::Reverse)
      command
          ->add_option("--softmotion", call_->cnc.softMotion,
                       "What words mean: 2.3 or 3 (default: as stride.toml of the file's project "
                       "says, else 2.3)")
          ->check(CLI::IsMember({"2.3", "3"}).description(""))
          ->type_name("VERSION");
    if (action != CncAction::Format && action < CncAction::Number)
      declareValues(command);
    if (action != CncAction::Check && action != CncAction::Format && action < CncAction::Number)
      declareProcessors(command);
    addOutputOptions(*command, call_->cnc.output);
    command->callback([call = call_, action] {
      call->cnc.action = action;
      call->exitCode = cncCommand(call->cnc);
    });
    return command;
  }

  void declareValues(CLI::App *command) const {
    auto seen = std::make_shared<CncValues>();
    command
        ->add_option("--set", call_->cnc.sets,
                     "Value of a variable: NAME=VALUE, several times (default: 0)")
        ->take_all()
        ->expected(1)
        ->check(
            CLI::Validator([seen](std::string &text) { return seen->add(text); }, std::string()))
        ->type_name("NAME=VALUE");
  }

  void declareProcessors(CLI::App *command) const {
    CncProcessorOptions &options = call_->cnc.preprocess;
    CLI::Option *processors =
        command
            ->add_option_function<std::string>(
                "--preprocess",
                [&options](const std::string &text) {
                  (void)readProcessors(text, options.processors.emplace());
                },
                "Path processors before all else: tool, loops, then smooth or round; tool,loops; "
                "none (default: as [[cnc]] of the file's project)")
            ->check(CLI::Validator(
                [](std::string &text) {
                  std::vector<CncProcessor> ignored;
                  return readProcessors(text, ignored);
                },
                std::string()))
            ->type_name("NAMES");
    command
        ->add_option("--tool-radius", options.toolRadius,
                     "Of tool, u: is added to D (default: as [[cnc]], else 0)")
        ->check(numberFrom(0, true))
        ->type_name("N")
        ->needs(processors);
  }

  void declareMotion(CLI::App *command, const char *out) const {
    CncMotionOptions &motion = call_->cnc.motion;
    command->add_option("-o,--out", call_->cnc.out, out)->type_name("FILE");
    number(command, "--blend", motion.blend, true,
           "Corners become curves that stay within this distance of them, u (default: none do)");
    number(command, "--merge", motion.merge, true,
           "Fewer lines: the path may be off by so much, u (default: all lines stay)");
    angleTolerance(command, motion);
    command
        ->add_option("--velocity-mode", motion.velocityMode,
                     "trapezoid (default), sigmoid, or quadratic: with a limited jerk")
        ->check(CLI::IsMember({"trapezoid", "sigmoid", "quadratic"}).description(""))
        ->type_name("MODE");
    number(command, "--jerk", motion.jerk, false, "Jerk along the path, u/s\xC2\xB3 (quadratic)");
    velocity(command, motion);
    number(command, "--acceleration", motion.acceleration, false,
           "Acceleration and deceleration of a program that begins without E, u/s\xC2\xB2 "
           "(default: 100)");
    limits(command, "--max-velocity", motion.maxVelocity, "Of axes, u/s: X=250,Y=250");
    limits(command, "--max-acceleration", motion.maxAcceleration,
           "Of axes, u/s\xC2\xB2: X=1750,Y=1750");
    command
        ->add_option_function<std::string>(
            "--cycle",
            [&motion](const std::string &text) {
              motion.cycle = static_cast<double>(parseInterval(text).value_or(0)) / 1e9;
            },
            "Cycle of the interpolator (default: 1ms)")
        ->check(CLI::Validator(
            [](std::string &text) {
              const std::optional<int64_t> time = parseInterval(text);
              constexpr int64_t kMost = 1'000'000'000;
              return time && *time > 0 && *time <= kMost
                         ? std::string()
                         : "`" + text + "` is no time of up to 1s: 1ms, 500us";
            },
            std::string()))
        ->type_name("TIME");
    number(command, "--feed", motion.feed, false,
           "Factor of the program's velocities (default: 1)");
  }

  static void angleTolerance(CLI::App *command, CncMotionOptions &motion) {
    command
        ->add_option("--angle-tolerance", motion.angleTolerance,
                     "Corners that turn less are none, degrees (default: as [[cnc]], else 0.001)")
        ->check(numberFrom(0, true, 180))
        ->type_name("DEG");
  }

  void declareNumber(CLI::App *command) const {
    constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
    CncNumbering &numbering = call_->cnc.numbering;
    command->add_option("--first", numbering.first, "Number of the first sentence (default: 10)")
        ->check(CLI::Range(0, kMost).description(""))
        ->type_name("N");
    command->add_option("--step", numbering.step, "From each sentence to the next (default: 10)")
        ->check(CLI::Range(1, kMost).description(""))
        ->type_name("N");
    declareTarget(command);
  }

  void declareMoves() const {
    CncMoveOptions &move = call_->cnc.move;
    CLI::App *rotate = addMove("rotate", CncAction::Rotate, "Turn the path of a CNC program");
    rotate->add_option("--angle", move.angle, "About Z, counterclockwise, degrees")
        ->required()
        ->check(numberFrom(-kMostAngle, true, kMostAngle))
        ->type_name("DEG");
    places(rotate, "--about", "Place that stays, u: X=5,Y=-2 (default: 0)", "XY")->required(false);
    places(addMove("shift", CncAction::Shift, "Shift the path of a CNC program"), "--by",
           "By so much, u: X=5,Y=-2", kAxisLetters);
    CLI::App *scale =
        addMove("scale", CncAction::Scale, "Make the path of a CNC program larger or smaller");
    scale->add_option("--factor", move.factor, "Factor of X, Y and Z, greater than 0")
        ->required()
        ->check(numberFrom(0, false))
        ->type_name("N");
    places(scale, "--about", "Place that stays, u: X=5,Y=-2 (default: 0)", "XYZ")->required(false);
    places(addMove("mirror", CncAction::Mirror, "Mirror the path of a CNC program"), "--at",
           "Where the mirror stands, u: X=0 turns X round", "XYZ", 1);
  }

  void declareCuts() const {
    places(addMove("reverse", CncAction::Reverse, "Go along the path of a CNC program backwards"),
           "--start", "Where the path begins, u: X=5,Y=-2 (default: 0)", kAxisLetters)
        ->required(false);
    CncSplit &split = call_->cnc.split;
    CLI::App *command =
        addMove("split", CncAction::Split, "Cut motions of a CNC program in pieces");
    CLI::Option *sentence =
        command
            ->add_option("--sentence", split.sentence,
                         "Number (N) of the sentence that is cut, or its line")
            ->check(CLI::Range(0, std::numeric_limits<int32_t>::max()).description(""))
            ->type_name("N");
    command
        ->add_option("--at", split.at, "Where it is cut: more than 0, less than 1 (default: 0.5)")
        ->check(numberFrom(0, false, std::nextafter(1.0, 0.0)))
        ->type_name("PART")
        ->needs(sentence);
    CLI::Option *length =
        command
            ->add_option("--length", split.length,
                         "Cut all motions but G0 that are longer in equal pieces, u")
            ->check(numberFrom(0, false))
            ->type_name("N")
            ->excludes(sentence);
    oneOf(command, CncAction::Split, sentence, length, "--sentence or --length");
    CncExpansion &expansion = call_->cnc.expansion;
    command = addMove("expand", CncAction::Expand,
                      "Make lines of the splines, parabolas and ellipses of a CNC program");
    length = command->add_option("--length", expansion.length, "Of the curve for each line, u")
                 ->check(numberFrom(0, false))
                 ->type_name("N");
    CLI::Option *angle = command
                             ->add_option("--angle", expansion.angle,
                                          "Lines that follow each other turn by less, degrees")
                             ->check(numberFrom(0, false, 180))
                             ->type_name("DEG")
                             ->excludes(length);
    oneOf(command, CncAction::Expand, length, angle, "--length or --angle");
  }

  /// One of two options has to be there.
  void oneOf(CLI::App *command, CncAction action, const CLI::Option *first,
             const CLI::Option *second, const char *names) const {
    command->callback([call = call_, action, first, second, names] {
      if (first->empty() && second->empty())
        throw CLI::RequiredError(names);
      call->cnc.action = action;
      call->exitCode = cncCommand(call->cnc);
    });
  }

  CLI::App *addMove(const char *name, CncAction action, const char *what) const {
    CLI::App *command = add(name, action, what);
    declareTarget(command);
    return command;
  }

  /// Places of axes with some letters, `most` of them at most.
  CLI::Option *places(CLI::App *command, const char *name, const char *what,
                      std::string_view letters, int most = 12) const {
    const auto check = [letters, most](std::string &text) {
      double ignored[12];
      uint16_t named = 0;
      std::string wrong = readAxes(text, false, ignored, named);
      for (size_t axis = 0; axis < kAxisLetters.size() && wrong.empty(); ++axis)
        if ((named >> axis & 1) != 0 && letters.find(kAxisLetters[axis]) == letters.npos)
          wrong = std::string(1, kAxisLetters[axis]) + " is not possible here";
      if (wrong.empty() && std::popcount(named) > most)
        wrong = "one axis is possible here";
      return wrong;
    };
    CncMoveOptions &move = call_->cnc.move;
    return command
        ->add_option_function<std::string>(
            name,
            [&move](const std::string &text) {
              (void)readAxes(text, false, move.places, move.axes);
            },
            what)
        ->required()
        ->check(CLI::Validator(check, std::string()))
        ->type_name("AXES");
  }

  static constexpr double kMostAngle = 36000;

  void declareTarget(CLI::App *command) const {
    CLI::Option *out =
        command->add_option("-o,--out", call_->cnc.out, "File to write (default: standard output)")
            ->type_name("FILE");
    command->add_flag("--in-place", call_->cnc.inPlace, "Write into the program's own file")
        ->excludes(out);
  }

  void declareQueue(CLI::App *command) const {
    CncMotionOptions &motion = call_->cnc.motion;
    CncQueueOptions &queue = call_->cnc.queue;
    command->add_option("-o,--out", call_->cnc.out, "Queue file to write")
        ->required()
        ->type_name("FILE");
    axes(command, "--start", "Where the path begins, u: X=5,Y=-2", false,
         [&queue](const std::string &text) {
           (void)readAxes(text, false, queue.start, queue.axes);
         });
    velocity(command, motion);
    number(command, "--acceleration", motion.acceleration, false,
           "Acceleration of a program that begins without E, u/s\xC2\xB2 (default: 100)");
    number(
        command, "--deceleration", queue.deceleration, false,
        "Deceleration of a program that begins without a negative E, u/s\xC2\xB2 (default: 100)");
    angleTolerance(command, motion);
    command->add_flag("--step-suppress", queue.stepSuppress,
                      "Leave out sentences that begin with /");
  }

  static void velocity(CLI::App *command, CncMotionOptions &motion) {
    number(command, "--velocity", motion.velocity, false,
           "Velocity of a program that begins without F, u/s");
  }

  static void number(CLI::App *command, const char *name, double &value, bool zero,
                     const char *what) {
    command->add_option(name, value, what)->check(numberFrom(0, zero))->type_name("N");
  }

  static void limits(CLI::App *command, const char *name, double (&values)[12], const char *what) {
    axes(command, name, what, true, [&values](const std::string &text) {
      uint16_t ignored = 0;
      (void)readAxes(text, true, values, ignored);
    });
  }

  static void axes(CLI::App *command, const char *name, const char *what, bool positive,
                   const std::function<void(const std::string &)> &take) {
    command->add_option_function<std::string>(name, take, what)
        ->check(CLI::Validator(
            [positive](std::string &text) {
              double ignored[12];
              uint16_t named = 0;
              return readAxes(text, positive, ignored, named);
            },
            std::string()))
        ->type_name("AXES");
  }

  CLI::App *cnc_;
  Invocation *call_;
};

} // namespace

void declareCnc(CLI::App &app, Invocation &call) { CncCommands(app, call).declare(); }

} // namespace stc::cli
