#include "compiler/cli/cnc_project.hpp"

#include "compiler/project/config.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/source/sources.hpp"

#include <filesystem>

namespace stc::cli {

CncSettings projectSettings(const std::string &path, const std::string &softMotion) {
  CncSettings settings;
  std::error_code error;
  const std::filesystem::path folder =
      findProjectFolder(std::filesystem::absolute(path, error).parent_path());
  Sources sources;
  Diagnostics unseen;
  const std::filesystem::path toml = folder / "stride.toml";
  const std::optional<FileId> id =
      folder.empty() ? std::nullopt : sources.load(toml, toml.string());
  if (id) {
    const ProjectConfig config = readConfig(sources.file(*id), unseen);
    for (const CncSettings &section : config.cnc)
      if (std::filesystem::equivalent(folder / section.file, path, error))
        settings = section;
    settings.span = settings.queueBytesSpan = {}; // of a file that is not shown
    settings.softMotion3 = config.generation == 3;
  }
  if (!softMotion.empty())
    settings.softMotion3 = softMotion == "3";
  return settings;
}

} // namespace stc::cli
