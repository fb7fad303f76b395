// The commands below `stride cam`.

#include "compiler/cli/command_line.hpp"
#include "compiler/syntax/st_text.hpp"

#include <cmath>

namespace stc::cli {

namespace {

constexpr const char *kAny = "Cam file (*.cam.toml), binary file (*.CAM) or table of positions";

CLI::Validator atLeast(bool zero) {
  return {[zero](std::string &text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                              (value > 0 || (zero && value == 0));
            return good ? std::string()
                        : "`" + text + "` is no number " + (zero ? "from 0 on" : "greater than 0");
          },
          std::string()};
}

/// Declares commands on cams.
class CamCommands {
public:
  CamCommands(CLI::App &app, Invocation &call)
      : cam_(app.add_subcommand("cam", "Check, draw and convert cams")), call_(&call),
        options_(&call.cams) {
    cam_->require_subcommand(1);
  }

  void declare() const {
    add("check", CamAction::Check, "Show what cams are, and fail if one of them jumps", kAny);
    declareBounds();
    out(add("plot", CamAction::Plot,
            "Draw position, velocity, acceleration and jerk over the master", kAny),
        "SVG file to write (default: FILE with .svg)");
    declareTables();
    declareReduce();
    out(add("write", CamAction::Write, "Write the binary file that SMC_ReadCAM reads",
            "Cam file (*.cam.toml)"),
        "Binary file to write (default: FILE with .CAM)");
    CLI::App *read = add("read", CamAction::Read, "Make a cam file of a binary file",
                         "Binary file (*.CAM), as SMC_WriteCAM writes it");
    out(read, "Cam file to write (default: FILE with .cam.toml)");
    name(read);
  }

private:
  CLI::App *add(const char *name, CamAction action, const char *what, const char *file) const {
    CLI::App *command = cam_->add_subcommand(name, what);
    CLI::Option *files = command->add_option("FILE", options_->files, file)->required();
    if (action != CamAction::Check)
      files->expected(1);
    files->type_name("");
    addOutputOptions(*command, options_->output);
    command->callback([call = call_, action] {
      call->cams.action = action;
      call->exitCode = camCommand(call->cams);
    });
    return command;
  }

  void out(CLI::App *command, const char *what) const {
    command->add_option("-o,--out", options_->out, what)->type_name("FILE");
  }

  void name(CLI::App *command) const {
    command->add_option("--name", options_->name, "The cam's name (default: the one it has)")
        ->check(CLI::Validator(
            [](std::string &text) {
              return isIdentifier(text) ? std::string()
                                        : "`" + text + "` is no name in Structured Text";
            },
            std::string()))
        ->type_name("NAME");
  }

  void declareBounds() const {
    CLI::App *bounds = add("bounds", CamAction::Bounds,
                           "Compute how far, how fast and how hard the slave moves", kAny);
    bounds
        ->add_option("--master-vel", options_->masterVelocity,
                     "Greatest velocity of the master, u/s")
        ->required()
        ->check(atLeast(true))
        ->type_name("V");
    bounds
        ->add_option("--master-acc", options_->masterAcceleration,
                     "Greatest acceleration of the master, u/s\xC2\xB2 (default: 0)")
        ->check(atLeast(true))
        ->type_name("A");
  }

  void declareTables() const {
    CLI::App *write = add("export", CamAction::ExportTable,
                          "Write a table of positions, `master;slave` a line", kAny);
    out(write, "Text file to write (default: FILE with .txt)");
    write->add_option("--points", options_->points, "Number of places (default: 361)")
        ->check(CLI::Range(size_t{2}, size_t{1000000}).description(""))
        ->type_name("N");
    CLI::App *import =
        add("import", CamAction::ImportTable, "Make a cam file of a table of positions",
            "Text file, `master;slave` or `master:slave` a line");
    out(import, "Cam file to write (default: FILE with .cam.toml)");
    name(import);
    import->add_flag("--periodic", options_->periodic, "The cam is periodic");
    import->add_option("--interval", options_->interval, "The slave's period, of a periodic cam")
        ->check(atLeast(true))
        ->type_name("U");
    import
        ->add_option("--tolerance", options_->tolerance,
                     "Fewer points: the slave may be off by so much (default: all points)")
        ->check(atLeast(false))
        ->type_name("U");
  }

  void declareReduce() const {
    CLI::App *reduce = add("reduce", CamAction::Reduce,
                           "Make a cam file of fewer points within a tolerance", kAny);
    reduce->add_option("--tolerance", options_->tolerance, "So much the slave may be off")
        ->required()
        ->check(atLeast(false))
        ->type_name("U");
    out(reduce, "Cam file to write");
    name(reduce);
  }

  CLI::App *cam_;
  Invocation *call_;
  CamOptions *options_;
};

} // namespace

void declareCams(CLI::App &app, Invocation &call) { CamCommands(app, call).declare(); }

} // namespace stc::cli
