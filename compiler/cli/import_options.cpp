// `stride import` and its options.

#include "compiler/cli/command_line.hpp"
#include "compiler/import/encoding.hpp"

namespace stc::cli {

void declareImports(CLI::App &app, Invocation &call) {
  ImportOptions &options = call.import;
  CLI::App *import =
      app.add_subcommand("import", "Make a project of files of CoDeSys and other tools");
  import->add_option("FILE", options.paths, "Exported files, or folders of them")
      ->required()
      ->type_name("");
  import
      ->add_option("-o", options.out, "Folder of the project (default: named after the first file)")
      ->type_name("FOLDER");
  import->add_flag("--force", options.force,
                   "Write into a folder that is there: files of the same names are replaced");
  import->add_flag("--strict", options.strict, "Write nothing when something would be left out");
  import->add_flag("--library", options.library, "Make a library instead of an application");
  import->add_flag("--fmt", options.format, "Format the sources");
  import
      ->add_option("--encoding", options.encoding,
                   "Of files that do not say it: cp1251, latin1, cp850, … (default: UTF-8 if they "
                   "are valid, else cp1252)")
      ->check(CLI::Validator(
          [](std::string &name) {
            return import::isEncoding(name) ? std::string()
                                            : "`" + name + "` is no encoding; known are cp1252, "
                                                           "cp1251, latin1, cp850, utf-8 and others";
},
          std::string()))
      ->type_name("NAME");
import
    ->add_option("--addressing", options.addressing,
                 "What numbers in addresses count: words or bytes (default: words for CoDeSys "
                 "V2.3)")
    ->check(CLI::IsMember({"words", "bytes"}).description(""))
    ->type_name("UNIT");
import
    ->add_option("--cfg", options.configuration,
                 "The target's configuration file, which names parameters of drives")
    ->type_name("FILE");
addOutputOptions(*import, options.output);
  import->callback([&call] { call.exitCode = importCommand(call.import);
  } // namespace stc::cli
);
}

} // namespace stc::cli
