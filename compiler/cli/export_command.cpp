// stride export

#include "compiler/cli/commands.hpp"
#include "compiler/export/plcopen_writer.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"

#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>

namespace stc::cli {

namespace {

/// Now, or the time that SOURCE_DATE_EPOCH gives for files that are always the same.
std::string dateOfToday() {
  std::time_t seconds = std::time(nullptr);
  if (const char *epoch = std::getenv("SOURCE_DATE_EPOCH"))
    seconds = static_cast<std::time_t>(std::strtoll(epoch, nullptr, 10));
  std::tm parts{};
  if (gmtime_r(&seconds, &parts) == nullptr)
    return "1970-01-01T00:00:00Z";
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

} // namespace

int exportPlcOpenCommand(const ProjectOptions &options, const ExportOptions &what) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const Project project(options.path, Purpose::Check, settingsOf(options), index);
  const int exitCode = show(project.diagnostics(), project.sources(), options.output);
  if (exitCode != 0)
    return exitCode;
  exporting::PlcOpenOptions how;
  how.date = dateOfToday();
  if (what.schema == "2.0")
    how.version = exporting::PlcOpenVersion::V200;
  const exporting::PlcOpenFile file = exporting::plcOpenFile(project, how);
  const std::string out = what.out.empty() ? project.name() + ".xml" : what.out;
  if (!writeFile(out, file.xml))
    return showError(Code::CannotWrite, fmt::format("`{}` cannot be written: {}", out, lastError()),
                     options.output);
  for (const std::string &note : file.notes)
    print(note + "\n");
  return 0;
}

} // namespace stc::cli
