#include "compiler/cli/shell_files.hpp"

#include "compiler/cli/command_line.hpp"
#include "compiler/cli/version.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <vector>

namespace stc::cli {

namespace {

using Commands = std::vector<const CLI::App *>;

Commands commandsOf(const CLI::App &app) {
  return app.get_subcommands([](const CLI::App *) { return true; });
}

std::vector<const CLI::Option *> optionsOf(const CLI::App &command, bool positional) {
  std::vector<const CLI::Option *> list;
  for (const CLI::Option *option : command.get_options([](const CLI::Option *) { return true; }))
    if (option->get_positional() == positional)
      list.push_back(option);
  return list;
}

/// All names of a command's options, with blanks between them.
std::string optionNames(const CLI::App &command) {
  std::string names;
  for (const CLI::Option *option : optionsOf(command, false)) {
    for (const std::string &name : option->get_lnames())
      names += " --" + name;
    for (const std::string &name : option->get_snames())
      names += " -" + name;
  }
  return names.empty() ? names : names.substr(1);
}

std::string commandNames(const CLI::App &app) {
  std::string names;
  for (const CLI::App *command : commandsOf(app))
    names += (names.empty() ? "" : " ") + command->get_name();
  return names;
}

/// The text with these characters escaped by a backslash.
std::string escaped(std::string_view text, std::string_view characters) {
  std::string out;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos)
      out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

// -------------------------------------------------------------------------------------------------
// zsh

/// In single quotes.
std::string zshText(std::string_view text) {
  std::string out;
  for (const char c : escaped(text, ":[]\\"))
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out;
}

std::string zshCommands(const CLI::App &app) {
  std::string out = "(";
  for (const CLI::App *command : commandsOf(app))
    out += "\n    '" + command->get_name() + ":" + zshText(command->get_description()) + "'";
  return out + "\n  )";
}

std::string zshArguments(const CLI::App &command) {
  std::string out = "_arguments -s";
  for (const CLI::Option *option : optionsOf(command, false)) {
    const bool isFlag = option->get_items_expected_max() == 0;
    const std::string value = isFlag ? "" : ":" + zshText(option->get_type_name()) + ":_files";
    for (const std::string &name : option->get_lnames())
      out += " \\\n      '--" + name + "[" + zshText(option->get_description()) + "]" + value + "'";
    for (const std::string &name : option->get_snames())
      out += " \\\n      '-" + name + "[" + zshText(option->get_description()) + "]" + value + "'";
  }
  return out + " \\\n      '*:file:_files'";
}

// -------------------------------------------------------------------------------------------------
// roff

/// The code point that begins there, of UTF-8 text; `at` moves to its last byte.
unsigned codePoint(std::string_view text, size_t &at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  unsigned point = first & (0x3FU >> more);
  for (size_t i = 0; i < more && at + 1 < text.size(); ++i)
    point = point << 6U | (static_cast<unsigned char>(text[++at]) & 0x3FU);
  return point;
}

std::string roff(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (static_cast<unsigned char>(c) >= 0x80) {
      out += fmt::format("\\[u{:04X}]", codePoint(text, i));
      continue;
    }
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '\n')
      out += "\n.br\n";
    else
      out += (out.empty() && (c == '.' || c == '\'')) ? std::string("\\&") + c : std::string(1, c);
  }
  return out;
}

std::string manOption(const CLI::Option &option) {
  std::string names;
  for (const std::string &name : option.get_snames())
    names += (names.empty() ? "\\fB\\-" : ", \\fB\\-") + roff(name) + "\\fR";
  for (const std::string &name : option.get_lnames())
    names += (names.empty() ? "\\fB\\-\\-" : ", \\fB\\-\\-") + roff(name) + "\\fR";
  if (names.empty())
    names = "\\fI" + roff(option.get_name(true)) + "\\fR";
  if (!option.get_positional() && option.get_items_expected_max() != 0)
    names += " \\fI" + roff(option.get_type_name()) + "\\fR";
  return ".TP\n" + names + "\n" + roff(option.get_description()) + "\n";
}

std::string manCommand(const CLI::App &command, const std::string &prefix) {
  const std::string name = prefix + " " + command.get_name();
  std::string head = name;
  for (const CLI::Option *option : optionsOf(command, true))
    head +=
        option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
  if (const Commands below = commandsOf(command); !below.empty()) {
    std::string out;
    for (const CLI::App *one : below)
      out += manCommand(*one, name);
    return out;
  }
  std::string out = ".SS " + roff(head) + "\n" + roff(command.get_description()) + "\n";
  for (const CLI::Option *option : optionsOf(command, true))
    out += manOption(*option);
  for (const CLI::Option *option : optionsOf(command, false))
    if (option->get_name() != "--help")
      out += manOption(*option);
  return out;
}

struct Item {
  std::string_view name;
  std::string_view text;
};

std::string manItems(std::string_view title, std::span<const Item> items) {
  std::string out = ".SH " + std::string(title) + "\n";
  for (const Item &item : items)
    out += ".TP\n\\fB" + roff(item.name) + "\\fR\n" + roff(item.text) + "\n";
  return out;
}

constexpr Item kFiles[] = {
    {"stride.toml", "What a project or a library consists of: its tasks, drives, libraries."},
    {"~/.cache/stride", "What has been compiled. It may be removed at any time."},
    {"~/.local/share/stride/libraries", "Libraries that \"stride library install\" has put there."},
};
constexpr Item kEnvironment[] = {
    {"STRIDE_CXX", "The C++ compiler instead of g++."},
    {"STRIDE_LIBRARIES", "Folders with libraries, with colons between them."},
    {"XDG_CACHE_HOME, XDG_DATA_HOME", "The folders instead of ~/.cache and ~/.local/share."},
};

} // namespace

std::string bashCompletion(const CLI::App &app) {
  std::string groups;
  std::string options;
  for (const CLI::App *command : commandsOf(app)) {
    const std::string &name = command->get_name();
    if (commandsOf(*command).empty()) {
      options += "    " + name + ") words='" + optionNames(*command) + "' ;;\n";
      continue;
    }
    groups += "    " + name + ") below='" + commandNames(*command) + "' ;;\n";
    for (const CLI::App *one : commandsOf(*command))
      options +=
          "    '" + name + " " + one->get_name() + "') words='" + optionNames(*one) + "' ;;\n";
  }
  return "# bash completion of stride; written by `stride completion bash`\n"
         "_stride() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} below= words=\n"
         "  case $command in\n" +
         groups + "    help) below='" + commandNames(app) +
         "' ;;\n"
         "  esac\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    mapfile -t COMPREPLY < <(compgen -W '" +
         commandNames(app) +
         " --help --version' -- \"$word\")\n"
         "    return\n"
         "  fi\n"
         "  if [ -n \"$below\" ]; then\n"
         "    if ((COMP_CWORD == 2)); then\n"
         "      mapfile -t COMPREPLY < <(compgen -W \"$below\" -- \"$word\")\n"
         "      return\n"
         "    fi\n"
         "    command=\"$command ${COMP_WORDS[2]}\"\n"
         "  fi\n"
         "  [[ $word = -* ]] || return 0 # a file\n"
         "  case $command in\n" +
         options +
         "  esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "}\n"
         "complete -o default -F _stride stride\n";
}

std::string zshCompletion(const CLI::App &app) {
  std::string cases;
  for (const CLI::App *command : commandsOf(app)) {
    const std::string &name = command->get_name();
    if (commandsOf(*command).empty()) {
      cases += "  " + name + ")\n    " + zshArguments(*command) + " ;;\n";
      continue;
    }
    cases +=
        "  " + name + ")\n    local -a below=" + zshCommands(*command) +
        "\n    if ((CURRENT == 3)); then\n      _describe command below\n      return\n    fi\n"
        "    case $words[3] in\n";
    for (const CLI::App *one : commandsOf(*command))
      cases += "    " + one->get_name() + ")\n    " + zshArguments(*one) + " ;;\n";
    cases += "    esac ;;\n";
  }
  return "#compdef stride\n# written by `stride completion zsh`\n"
         "_stride() {\n  local -a commands=" +
         zshCommands(app) +
         "\n  if ((CURRENT == 2)); then\n    _describe command commands\n    return\n  fi\n"
         "  case $words[2] in\n" +
         cases + "  esac\n}\n_stride \"$@\"\n";
}

std::string manPage(const CLI::App &app, const std::string &version) {
  std::string out = ".\\\" written by `stride completion man`\n.TH STRIDE 1 \"\" \"" +
                    roff(version) + "\" \"Stride\"\n.SH NAME\nstride \\- " +
                    roff(app.get_description()) +
                    "\n.SH SYNOPSIS\n\\fBstride\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
                    ".SH DESCRIPTION\n"
                    "Without a path, a command takes the project that the current folder belongs "
                    "to: the nearest folder around it with a stride.toml.\n"
                    ".SH COMMANDS\n";
  for (const CLI::App *command : commandsOf(app))
    out += manCommand(*command, "stride");
  return out + manItems("FILES", kFiles) + manItems("ENVIRONMENT", kEnvironment);
}

void declareCompletion(CLI::App &app, Invocation &call) {
  CLI::App *completion =
      app.add_subcommand("completion", "Write what a shell needs to complete commands");
  completion->add_option("SHELL", call.topic, "bash, zsh; man: the manual page instead")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "man"}).description(""))
      ->type_name("");
  completion->callback([&app, &call] {
    const std::string text = call.topic == "bash"  ? bashCompletion(app)
                             : call.topic == "zsh" ? zshCompletion(app)
                                                   : manPage(app, versionText());
    std::fputs(text.c_str(), stdout);
  });
}

} // namespace stc::cli
