#include "compiler/project/made_files.hpp"

#include "compiler/project/file_system.hpp"
#include "compiler/project/output_folder.hpp"

#include <cerrno>
#include <fmt/format.h>

namespace stc {

namespace fs = std::filesystem;

bool writeMadeFiles(const Project &project, const fs::path &folder, const fs::path &root,
                    Diagnostics &diagnostics) {
  if (project.madeFiles().empty())
    return true;
  std::error_code error;
  const fs::path base = fs::weakly_canonical(folder, error);
  const fs::path inside = fs::weakly_canonical(root, error).lexically_relative(base);
  if (inside.empty() || *inside.begin() == "..") {
    const CncFile &first = project.madeFiles().front();
    diagnostics
        .report(Code::CannotWrite, first.span,
                fmt::format("`{}` is not written to `{}`, which is not in the project", first.name,
                            root.string()),
                "becomes a file")
        .help("a build writes into the project only: choose another `root` in [files]");
    return false;
  }
  const std::optional<OutputFolder> output = OutputFolder::open(base);
  for (const CncFile &file : project.madeFiles()) {
    const fs::path name = inside == "." ? fs::path(file.name) : inside / file.name;
    if (output && output->read(name, file.bytes.size()) == file.bytes)
      continue;
    if (!output || !output->write(name, file.bytes)) {
      reportCannotWrite(base / name, diagnostics);
      return false;
    }
  }
  return true;
}

void reportCannotWrite(const fs::path &path, Diagnostics &diagnostics) {
  if (errno == ELOOP)
    diagnostics
        .report(Code::LinkInTheWay, {},
                fmt::format("`{}` is not written: a symbolic link leads there", path.string()))
        .help("Stride writes through no link that a project holds; remove it");
  else
    diagnostics.report(Code::CannotWrite, {},
                       fmt::format("`{}` cannot be written: {}", path.string(), lastError()));
}

} // namespace stc
