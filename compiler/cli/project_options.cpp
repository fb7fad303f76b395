// Options that several commands have.

#include "compiler/cli/command_line.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/conditions.hpp"

#include <map>

namespace stc::cli {

namespace {

/// `error=SE0390`, `off=unused-variable`, `error=all-warnings`
void addLevel(Levels &levels, const std::string &text) {
  const size_t equal = text.find('=');
  const std::string level = text.substr(0, equal);
  const std::string what = equal == std::string::npos ? "all-warnings" : text.substr(equal + 1);
  static const std::map<std::string, Severity> known = {{"error", Severity::Error},
                                                        {"warning", Severity::Warning},
                                                        {"note", Severity::Note},
                                                        {"off", Severity::Off}};
  const auto severity = known.find(level);
  if (severity == known.end())
    throw CLI::ValidationError("-W", "`" + level + "` is none of error, warning, note, off");
  if (const std::optional<Levels::Group> group = findGroup(what)) {
    levels.set(*group, severity->second);
    return;
  }
  const CodeInfo *code = findCode(what);
  if (code == nullptr) {
    const std::vector<std::string> names = settingNames();
    const std::string_view near = nearest(what, {names.begin(), names.end()});
    throw CLI::ValidationError(
        "-W", "there is no diagnostic `" + what + "`" +
                  (near.empty() ? std::string() : "; did you mean `" + std::string(near) + "`?"));
  }
  if (code->severity == Severity::Error && severity->second != Severity::Error)
    throw CLI::ValidationError("-W", "`" + what + "` is an error, and errors cannot be lowered");
  levels.set(code->code, severity->second);
}

} // namespace

void addOutputOptions(CLI::App &command, Output &output) {
  static const std::map<std::string, ColorChoice> colors = {{"auto", ColorChoice::Automatic},
                                                            {"always", ColorChoice::Always},
                                                            {"never", ColorChoice::Never}};
  static const std::map<std::string, Format> formats = {{"text", Format::Text},
                                                        {"json", Format::Json}};
  command.add_option("--color", output.color, "Colours: auto (default), always, never")
      ->transform(CLI::CheckedTransformer(colors).description(""))
      ->type_name("WHEN");
  command.add_option("--format", output.format, "Diagnostics as text (default) or json")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->type_name("FORMAT");
  command
      .add_option("--max-errors", output.maxErrors, "Show so many errors (default: 100; 0: all)")
      ->type_name("N");
}

void addProjectOptions(CLI::App &command, ProjectOptions &options, bool build) {
  command
      .add_option("PATH", options.path, "Project folder or .st file (default: the current folder)")
      ->type_name("");
  addOutputOptions(command, options.output);
  command
      .add_option_function<std::vector<std::string>>(
          "-W",
          [&options](const std::vector<std::string> &values) {
            for (const std::string &value : values)
              addLevel(options.levels, value);
          },
          "Severity of diagnostics: error=SE0390, off=unused-variable, error=all-warnings (may be "
          "repeated)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("LEVEL=NAME");
  command.add_option("-D,--define", options.defines, "Define a name for {IF defined (NAME)}")
      ->check(CLI::Validator(
          [](std::string &text) {
            return readDefine(text) ? std::string() : "`" + text + "` is not NAME or NAME=VALUE";
          },
          std::string()))
      ->allow_extra_args(false)
      ->type_name("NAME[=VALUE]");
  if (!build)
    return;
  command.add_flag("--unchecked", options.unchecked,
                   "Leave out index, range, division and pointer checks");
  command.add_flag("--debug", options.debug, "Compile quickly and with debug information");
}

} // namespace stc::cli
