// The commands below `stride can`.

#include "compiler/cli/can_command.hpp"
#include "compiler/cli/command_line.hpp"

#include <algorithm>

namespace stc::cli {

namespace {

/// A command that stride-can knows: what comes after it is handed on.
void handOn(CLI::App &can, Invocation &call, const char *name, const char *help) {
  CLI::App *command = can.add_subcommand(name, help);
  command->prefix_command();
  command->set_help_flag();
  command->callback([command, name, &call] {
    std::vector<std::string> arguments = command->remaining();
    arguments.insert(arguments.begin(), name);
    call.exitCode = becomeCanTool(std::move(arguments));
  });
}

void declareSimulate(CLI::App &can, Invocation &call) {
  CLI::App *command = can.add_subcommand(
      "simulate", "Be the drives of a project on a CAN interface, for any master");
  command->prefix_command();
  command->set_help_flag();
  command->callback([command, &call] {
    std::vector<std::string> rest = command->remaining();
    if (std::any_of(rest.begin(), rest.end(),
                    [](const std::string &word) { return word == "--help" || word == "-h"; })) {
      call.exitCode = becomeCanTool({"simulate", "--help"});
      return;
    }
    if (!rest.empty() && !rest.front().starts_with("-")) {
      call.project.path = rest.front();
      rest.erase(rest.begin());
    }
    call.exitCode = canProjectCommand("simulate", call.project, {}, std::move(rest));
  });
}

void declareMonitor(CLI::App &can, Invocation &call) {
  CLI::App *command = can.add_subcommand("monitor", "Show frames and what they mean");
  command->prefix_command();
  command->set_help_flag();
  command->callback([command, &call] {
    std::vector<std::string> rest = command->remaining();
    rest.insert(rest.begin(), "monitor");
    const auto place = std::find(rest.begin(), rest.end(), "--project");
    if (rest.end() - place < 2) {
      call.exitCode = becomeCanTool(std::move(rest));
      return;
    }
    call.project.path = *(place + 1);
    rest.erase(place, place + 2);
    rest.erase(rest.begin());
    rest.push_back("--app");
    call.exitCode = canProjectCommand("monitor", call.project, std::move(rest), {});
  });
}

void declarePlan(CLI::App &can, Invocation &call) {
  CLI::App *plan =
      can.add_subcommand("plan", "Show the PDOs of a project and the load of its buses");
  addProjectOptions(*plan, call.project, false);
  plan->add_option("--dcf", call.can.dcf, "Folder for a concise DCF (1F22h) of each drive")
      ->type_name("FOLDER");
  plan->callback([&call] { call.exitCode = canPlanCommand(call.project, call.can); });
}

void declareImport(CLI::App &can, Invocation &call) {
  CLI::App *import =
      can.add_subcommand("import", "Make a section of stride.toml of an EDS, DCF or XDD file");
  import->add_option("FILE", call.can.file, "Electronic data sheet")->required()->type_name("");
  import->add_option("-o,--out", call.can.out, "File for the section (default: standard output)")
      ->type_name("FILE");
  import->add_option("--name", call.can.name, "Name of the drive")->type_name("NAME");
  import->add_option("--node", call.can.node, "Its node id")
      ->check(CLI::Range(1, 127).description(""))
      ->type_name("N");
  import->callback([&call] { call.exitCode = canImportCommand(call.can);
});
} // namespace

} // namespace stc::cli

void declareCan(CLI::App &app, Invocation &call) {
  CLI::App *can = app.add_subcommand("can", "Drives on CAN: plan, scan, read, write, watch");
  can->require_subcommand(1);
  declarePlan(*can, call);
  declareImport(*can, call);
  handOn(*can, call, "scan", "List the nodes that answer on an interface");
  handOn(*can, call, "sdo", "Read or write objects of a node");
  handOn(*can, call, "lss", "Find a node without a node id, or set a node id");
  declareMonitor(*can, call);
  declareSimulate(*can, call);
}

} // namespace stc::cli
