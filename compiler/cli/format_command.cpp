// fmt
#include "compiler/cli/commands.hpp"
#include "compiler/cli/line_diff.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/format_project.hpp"
#include "compiler/source/read_source.hpp"

#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <iterator>
#include <optional>

namespace stc::cli {

namespace {

/// Nothing when it is longer than a source file may be.
std::optional<std::string> readStdin() {
  std::string text;
  char block[1 << 16];
  for (size_t count = 0; (count = std::fread(block, 1, sizeof block, stdin)) != 0;) {
    text.append(block, count);
    if (text.size() > kMaxSourceBytes)
      return std::nullopt;
  }
  return text;
}

int showAll(const Diagnostics &diagnostics, const Sources &sources, const Output &output) {
  Diagnostics sorted = diagnostics;
  sorted.sort();
  return show(sorted.all(), sources, output);
}

int formatStdin(const FormatOptions &options) {
  Sources sources;
  Diagnostics diagnostics;
  const FormatSettings settings = readFormatSettings({}, sources, diagnostics);
  const std::optional<std::string> text = readStdin();
  if (!text) {
    errno = EFBIG;
    return showError(Code::UnreadableFile,
                     fmt::format("`<stdin>` cannot be read: {}", readSourceError()),
                     options.output);
  }
  std::vector<FormattedFile> files{{{}, "<stdin>", false, *text, {}}};
  if (!diagnostics.hasErrors())
    formatFiles(files, settings, sources, diagnostics);
  const int exitCode = showAll(diagnostics, sources, options.output);
  if (exitCode != 0)
    return exitCode;
  const bool changed = files[0].before != files[0].after;
  if (options.diff)
    print(lineDiff(files[0].before, files[0].after, files[0].name));
  else if (!options.check)
    print(files[0].after);
  return options.check && changed ? 1 : 0;
}

} // namespace

int formatCommand(const FormatOptions &options) {
  if (options.fromStdin)
    return formatStdin(options);
  std::vector<std::string> paths = options.paths;
  if (paths.empty())
    paths.emplace_back(".");
  int exitCode = 0;
  size_t changed = 0;
  for (const std::string &path : paths) {
    Sources sources;
    Diagnostics diagnostics;
    const std::vector<FormattedFile> files = formatPath(path, sources, diagnostics);
    for (const FormattedFile &file : files) {
      if (file.before == file.after)
        continue;
      ++changed;
      if (options.diff)
        print(lineDiff(file.before, file.after, file.name));
      else if (options.check)
        print(file.name + "\n");
      else if (file.outside)
        diagnostics
            .report(Code::LinkInTheWay, {},
                    fmt::format("`{}` is not written: a symbolic link leads there", file.name))
            .help("format it where it is, or name it on the command line");
      else if (!replaceFile(file.path, file.after))
        diagnostics.report(Code::CannotWrite, {},
                           fmt::format("`{}` cannot be written: {}", file.name, lastError()));
    }
    if (showAll(diagnostics, sources, options.output) != 0)
      exitCode = 1;
  }
  return options.check && changed != 0 ? 1 : exitCode;
}

} // namespace stc::cli
