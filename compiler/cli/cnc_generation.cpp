#include "compiler/cli/cnc_generation.hpp"

#include "compiler/project/config.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/source/sources.hpp"

#include <filesystem>

namespace stc::cli {

bool isSoftMotion3(const std::string &path, const std::string &said) {
  if (!said.empty())
    return said == "3";
  std::error_code error;
  const std::filesystem::path folder =
      findProjectFolder(std::filesystem::absolute(path, error).parent_path());
  Sources sources;
  Diagnostics unseen; // of the project, which is not what is checked here
  const std::filesystem::path toml = folder / "stride.toml";
  const std::optional<FileId> id =
      folder.empty() ? std::nullopt : sources.load(toml, toml.string());
  return id && readConfig(sources.file(*id), unseen).generation == 3;
}

} // namespace stc::cli
