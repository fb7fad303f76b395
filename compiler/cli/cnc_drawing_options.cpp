// stride cnc import-dxf and export-dxf.

#include "compiler/cli/command_line.hpp"

#include <cmath>
#include <map>

namespace stc::cli {

namespace {

/// A finite number of some range; 0 may be left out.
CLI::Validator finite(double least, bool zero) {
  return {[=](std::string &text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) &&
                              value >= least && (zero || value != 0) && std::abs(value) <= 1e9;
            return good ? std::string() : "`" + text + "` is no number that is possible here";
          },
          std::string()};
}

/// Words for the start or the end of a contour: `M3 K6000`, `H1`.
std::string checkSwitch(std::string &text) {
  const bool good =
      text.size() > 1 && (text[0] == 'M' || text[0] == 'H') &&
      text.find_first_of("\r\n") == std::string::npos &&
      (text[0] == 'M' ||
       text.find_first_not_of("0123456789", text[1] == '-' ? 2 : 1) == std::string::npos);
  return good ? std::string() : "`" + text + "` is no M function and no switch point: M3, H1";
}

class DrawingCommands {
public:
  DrawingCommands(CLI::App &cnc, Invocation &call)
      : cnc_(cnc), call_(call), drawing_(call.cnc.drawing) {}

  void declare() {
    CLI::App *command = add("import-dxf", CncAction::ImportDxf,
                            "Make CNC programs of a drawing (ASCII DXF)", "Drawing (*.dxf)");
    declareFiles(command);
    declareGeometry(command);
    declareProgram(command);
    declareTool(command);
    command = add("export-dxf", CncAction::ExportDxf, "Draw the path of a CNC program as DXF",
                  "CNC file (*.cnc)");
    command->add_option("-o,--out", call_.cnc.out, "Drawing to write (default: standard output)")
        ->type_name("FILE");
    command->add_flag("--rapid", drawing_.out.rapid, "Positioning (G0) as well, in a layer RAPID");
    command
        ->add_option("--tolerance", drawing_.out.tolerance,
                     "Of helices, which become lines, u (default: 0.001)")
        ->check(finite(kLeast, false))
        ->type_name("N");
  }

private:
  static constexpr double kLeast = 1e-6;

  CLI::App *add(const char *name, CncAction action, const char *what, const char *file) {
    CLI::App *command = cnc_.add_subcommand(name, what);
    command->add_option("FILE", call_.cnc.files, file)->required()->expected(1)->type_name("");
    addOutputOptions(*command, call_.cnc.output);
    command->callback([call = &call_, action] {
      call->cnc.action = action;
      call->exitCode = cncCommand(call->cnc);
    });
    return command;
  }

  void declareFiles(CLI::App *command) {
    DxfImport &import = drawing_.import;
    command
        ->add_option("-o,--out", call_.cnc.out,
                     "Folder for the programs (default: that of the drawing)")
        ->type_name("FOLDER");
    command->add_option("--base", drawing_.base, "Name of the programs (default: the drawing's)")
        ->check(CLI::Validator(
            [](std::string &text) {
              const bool good =
                  !text.empty() && text.find_first_of("/\\") == std::string::npos && text[0] != '.';
              return good ? std::string() : "`" + text + "` is no name of a file";
            },
            std::string()))
        ->type_name("NAME");
    command->add_flag("--replace", drawing_.replace, "Overwrite programs that are there");
    static const std::map<std::string, DxfPart> kParts = {
        {"file", DxfPart::File}, {"layer", DxfPart::Layer}, {"contour", DxfPart::Contour}};
    command
        ->add_option("--one-per", import.part,
                     "What becomes a program: file (default), layer, contour")
        ->transform(CLI::CheckedTransformer(kParts).description(""))
        ->type_name("PART");
    command
        ->add_option(
            "--layer", import.layers,
            "Only this layer, several times (default: all that are neither off nor frozen)")
        ->take_all()
        ->expected(1)
        ->type_name("NAME");
  }

  void declareGeometry(CLI::App *command) {
    DxfImport &import = drawing_.import;
    command
        ->add_option("--epsilon", import.epsilon,
                     "Ends that are no further apart are one place, u (default: 0.001)")
        ->check(finite(kLeast, false))
        ->type_name("N");
    command
        ->add_option("--tolerance", import.tolerance,
                     "Arcs may be so far off the splines that they stand for, u (default: 0.001)")
        ->check(finite(kLeast, false))
        ->type_name("N");
    command
        ->add_option("--scale", import.scale,
                     "Factor of all coordinates (default: from the drawing's unit to mm)")
        ->check(finite(kLeast, false))
        ->type_name("N");
    command->add_flag("--inside-first", import.insideFirst,
                      "Contours within others come before these");
    command
        ->add_option_function<std::vector<double>>(
            "--start",
            [&import](const std::vector<double> &place) {
              import.start[0] = place[0];
              import.start[1] = place[1];
            },
            "Where the tool is before, u: 5,-2 (default: 0,0)")
        ->delimiter(',')
        ->expected(2)
        ->check(finite(-1e9, true))
        ->type_name("X,Y");
    command->add_flag("--return", import.back, "G0 back there at the end");
  }

  void declareProgram(CLI::App *command) {
    DxfImport &import = drawing_.import;
    CLI::Option *feed = command->add_option("--feed", import.feed, "F, u/s")
                            ->check(finite(0, false))
                            ->type_name("N");
    command
        ->add_option("--words", import.words,
                     "More words of the first motion: \"E500 E-500 FF100\"")
        ->check(CLI::Validator(
            [](std::string &text) {
              return text.find_first_of("\r\n") == std::string::npos ? std::string()
                                                                     : "words are one line";
            },
            std::string()))
        ->type_name("WORDS");
    CLI::Option *safe =
        command->add_option("--safe-z", import.safeZ, "Z of the ways between contours, u")
            ->check(finite(-1e9, true))
            ->type_name("N");
    CLI::Option *depth = command->add_option("--depth", import.depth, "Z of contours, u")
                             ->check(finite(-1e9, true))
                             ->type_name("N")
                             ->needs(safe);
    safe->needs(depth);
    command->add_option("--plunge-feed", import.plungeFeed, "F down to --depth, u/s")
        ->check(finite(0, false))
        ->type_name("N")
        ->needs(depth)
        ->needs(feed);
    switches(command, "--on", import.on,
             "Start of each contour: an M function, or a switch point (H1), several times");
    switches(command, "--off", import.off, "End of each contour, likewise: M5, H-1");
  }

  static void switches(CLI::App *command, const char *name, std::vector<std::string> &all,
                       const char *what) {
    command->add_option(name, all, what)
        ->take_all()
        ->expected(1)
        ->check(CLI::Validator(checkSwitch, std::string()))
        ->type_name("WORDS");
  }

  void declareTool(CLI::App *command) {
    DxfImport &import = drawing_.import;
    static const std::map<std::string, DxfTool> kTools = {
        {"none", DxfTool::None}, {"left", DxfTool::Left}, {"right", DxfTool::Right}};
    CLI::Option *tool =
        command
            ->add_option("--tool", import.tool,
                         "Side of the tool, outside of closed contours and inside of those within "
                         "them: none (default), left (G41), right (G42)")
            ->transform(CLI::CheckedTransformer(kTools).description(""))
            ->type_name("SIDE");
    command->add_option("--tool-radius", import.toolRadius, "D of G41 and G42, u")
        ->check(finite(0, true))
        ->type_name("N")
        ->needs(tool);
    command
        ->add_option("--lead-in", import.leadIn,
                     "Closed contours begin so far beside them, on the tool's side, u")
        ->check(finite(0, false))
        ->type_name("N")
        ->needs(tool);
    command
        ->add_flag("--loops", import.avoidLoops, "Suppression of loops (G61) around each of them")
        ->needs(tool);
  }

  CLI::App &cnc_;
  Invocation &call_;
  CncDrawingOptions &drawing_;
};

} // namespace

void declareCncDrawings(CLI::App &cnc, Invocation &call) { DrawingCommands(cnc, call).declare(); }

} // namespace stc::cli
