// What is wrong with a command line, in words that help: needs CLI11.
#ifndef STRIDE_RUNTIME_COMMON_USAGE_HPP
#define STRIDE_RUNTIME_COMMON_USAGE_HPP

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace stride::common {

/// A word of the command line that is neither a command nor an option nor has a place.
struct UnknownWord {
  enum class Kind { None, Command, Option, Argument };
  Kind kind = Kind::None;
  std::string word;
  std::vector<std::string> known; ///< The commands or options that might be meant.
};

/// The innermost command that was given.
inline const CLI::App &givenCommand(const CLI::App &app) {
  const CLI::App *command = &app;
  while (!command->get_subcommands().empty())
    command = command->get_subcommands().front();
  return *command;
}

/// `stride cam plot`, with the program's name.
inline std::string commandPath(const CLI::App &app, const std::string &program) {
  std::string path = program;
  for (const CLI::App *command = &app; !command->get_subcommands().empty();) {
    command = command->get_subcommands().front();
    path += ' ' + command->get_name();
  }
  return path;
}

/// What is to be said where a command is missing: "name a command: read, write …"; else empty.
inline std::string missingCommand(const CLI::App &app, const CLI::ParseError &error) {
  const CLI::App &command = givenCommand(app);
  if (dynamic_cast<const CLI::RequiredError *>(&error) == nullptr ||
      command.get_require_subcommand_min() == 0)
    return {};
  std::string text;
  for (const CLI::App *one : command.get_subcommands({}))
    text += (text.empty() ? "name a command: " : ", ") + one->get_name();
  return text;
}

/// After parsing has failed: the first word that is not known, if there is one. A word that is
/// missing counts less than one that is wrong.
inline UnknownWord unknownWord(const CLI::App &app, const CLI::ParseError &error) {
  UnknownWord result;
  const bool isMissing = dynamic_cast<const CLI::RequiredError *>(&error) != nullptr;
  if (!isMissing && dynamic_cast<const CLI::ExtrasError *>(&error) == nullptr)
    return result;
  const CLI::App &command = givenCommand(app);
  const std::vector<std::string> words = command.remaining();
  for (const std::string &word : words) {
    if (word == "--" || word.empty())
      continue;
    const bool isOption = word.size() > 1 && word.front() == '-';
    const std::vector<const CLI::App *> commands = command.get_subcommands({});
    result.kind = isOption           ? UnknownWord::Kind::Option
                  : commands.empty() ? UnknownWord::Kind::Argument
                                     : UnknownWord::Kind::Command;
    result.word = isOption ? word.substr(0, word.find('=')) : word;
    if (isOption)
      for (const CLI::Option *option : command.get_options())
        for (const std::string &name : option->get_lnames())
          result.known.push_back("--" + name);
    else
      for (const CLI::App *one : commands)
        result.known.push_back(one->get_name());
    return result;
  }
  return result;
}

} // namespace stride::common

#endif
