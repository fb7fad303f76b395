// stride-can: tools for CANopen buses. `stride can` starts it.

#include "drivers/can/tool/commands.hpp"
#include "drivers/can/tool/tool_support.hpp"

#include <CLI/CLI.hpp>
#include <exception>

namespace {

using namespace stride::can::tool;

void addInterface(CLI::App &command, std::string &interface) {
  command.add_option("INTERFACE", interface, "CAN interface of the system: can0")->required();
}

void declareScan(CLI::App &app, ScanOptions &options, int &code) {
  CLI::App *command = app.add_subcommand("scan", "List the nodes that answer");
  addInterface(*command, options.interface);
  command->add_option("--from", options.first, "First node id")->check(CLI::Range(1, 127));
  command->add_option("--to", options.last, "Last node id")->check(CLI::Range(1, 127));
  command->add_option("--timeout", options.timeoutMs, "For each answer, in ms")
      ->check(CLI::Range(1, 60000));
  command->callback([&] { code = scan(options); });
}

void addObject(CLI::App &command, SdoOptions &options) {
  addInterface(command, options.interface);
  command.add_option("NODE", options.node, "Node id")->required()->check(CLI::Range(1, 127));
  command.add_option("OBJECT", options.object, "Index and subindex, hexadecimal: 6064h, 1018h:1")
      ->required();
  command.add_option("--type", options.type, "Kind of value")
      ->check(
          CLI::IsMember({"u8", "u16", "u32", "u64", "i8", "i16", "i32", "i64", "string", "hex"}));
  command.add_option("--timeout", options.timeoutMs, "For each answer, in ms")
      ->check(CLI::Range(1, 60000));
}

void declareSdo(CLI::App &app, SdoOptions &options, int &code) {
  CLI::App *sdo = app.add_subcommand("sdo", "Read or write objects of a node");
  sdo->require_subcommand(1);
  CLI::App *read = sdo->add_subcommand("read", "Read an object");
  addObject(*read, options);
  read->callback([&] { code = sdoRead(options); });
  CLI::App *write = sdo->add_subcommand("write", "Write an object");
  addObject(*write, options);
  write->add_option("VALUE", options.value, "Number, or text with --type string")->required();
  write->add_flag("--write", options.allowed, "Yes, change the device");
  write->add_flag("--force", options.inOperation, "Also while it is operational");
  write->callback([&] { code = sdoWrite(options); });
}

void declareLss(CLI::App &app, LssOptions &options, int &code) {
  CLI::App *command = app.add_subcommand("lss", "Find a node without a node id, or set a node id");
  addInterface(*command, options.interface);
  command
      ->add_option("--identity", options.identity,
                   "Vendor, product, revision and serial number of the node (1018h)")
      ->expected(4);
  command->add_option("--set", options.node, "New node id")->check(CLI::Range(1, 127));
  command->add_flag("--store", options.store, "The node keeps it for good");
  command->add_flag("--write", options.allowed, "Yes, change the device");
  command->add_option("--timeout", options.timeoutMs, "For each answer, in ms")
      ->check(CLI::Range(1, 60000));
  command->callback([&] { code = lss(options); });
}

void declareMonitor(CLI::App &app, MonitorOptions &options, int &code) {
  CLI::App *command = app.add_subcommand("monitor", "Show frames and what they mean");
  addInterface(*command, options.interface);
  command->add_option("--app", options.application, "Built application whose PDOs are known")
      ->check(CLI::ExistingFile);
  command->add_option("--for", options.seconds, "How long, in seconds (default: until Ctrl-C)")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--count", options.count, "So many frames");
  command->callback([&] { code = monitor(options); });
}

void declareSimulate(CLI::App &app, SimulateOptions &options, int &code) {
  CLI::App *command =
      app.add_subcommand("simulate", "Be the drives of an application, for its own or another "
                                     "master");
  command->add_option("APP", options.application, "Built application")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--interface", options.interface, "Instead of the application's own");
  command->add_option("--group", options.group, "Axis group, if there are several on CAN");
  command->add_option("--for", options.seconds, "How long, in seconds (default: until Ctrl-C)")
      ->check(CLI::NonNegativeNumber);
  command->callback([&] { code = simulate(options); });
}

} // namespace

int main(int argc, char **argv) {
  CLI::App app("Tools for CANopen buses", "stride can");
  app.require_subcommand(1);
  int code = kGood;
  ScanOptions scanOptions;
  SdoOptions sdoOptions;
  LssOptions lssOptions;
  MonitorOptions monitorOptions;
  SimulateOptions simulateOptions;
  declareScan(app, scanOptions, code);
  declareSdo(app, sdoOptions, code);
  declareLss(app, lssOptions, code);
  declareMonitor(app, monitorOptions, code);
  declareSimulate(app, simulateOptions, code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? kGood : kBad;
  } catch (const std::exception &error) {
    complain(error.what());
    return kBad;
  }
  return code;
}
