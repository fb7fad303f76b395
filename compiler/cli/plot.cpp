#include "compiler/plot/plot.hpp"
#include "compiler/cli/commands.hpp"
#include "compiler/project/file_system.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

int plotCommand(const std::string &trace, const std::string &out) {
  const std::optional<std::string> csv = readFile(trace);
  if (!csv)
    return showError(Code::UnreadableFile,
                     fmt::format("`{}` cannot be read: {}", trace, lastError()));
  plot::TraceError error;
  const std::optional<plot::Trace> data = plot::readTrace(*csv, error);
  if (!data)
    return showError(Code::BadTrace,
                     error.line == 0 ? fmt::format("`{}` is not a trace: {}", trace, error.message)
                                     : fmt::format("`{}` is not a trace: line {}: {}", trace,
                                                   error.line, error.message));
  const std::string path =
      out.empty() ? std::filesystem::path(trace).replace_extension(".svg").string() : out;
  if (!writeFile(path, plot::drawSvg(*data)))
    return showError(Code::CannotWrite,
                     fmt::format("`{}` cannot be written: {}", path, lastError()));
  return 0;
}

} // namespace stc::cli
