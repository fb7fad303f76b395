#ifndef STRIDE_COMPILER_PROJECT_CNC_CONFIG_HPP
#define STRIDE_COMPILER_PROJECT_CNC_CONFIG_HPP
// The CNC programs of a project.

#include "compiler/project/config.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/toml/schema.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// Reads a section [[cnc]].
void readCncSection(const CheckedSection &section, ProjectConfig &config, Diagnostics &diagnostics);

/// The folder below that for files where programs come that become files, and how queues end.
inline constexpr std::string_view kCncFolder = "cnc";
inline constexpr std::string_view kQueueSuffix = ".queue";

/// A file that a build makes of a program, for the application.
struct CncFile {
  std::string name; ///< Relative to the folder for files.
  std::string bytes;
  Span span; ///< Where stride.toml asks for it.
};

/// What the CNC programs of a project become.
struct CncParts {
  SyntheticSource declarations; ///< May be empty.
  std::vector<CncFile> files;
};

/// The folder for files of a project in `folder`. CNC files in it belong to the run.
[[nodiscard]] std::filesystem::path filesFolder(const std::filesystem::path &folder,
                                                const ProjectConfig &config);

/// A CNC file of a project or library.
struct CncFound {
  FileId id = 0;
  std::string name; ///< As its section [[cnc]] has it.
};

/// Reads and checks the CNC files, and declares their variables. What is wrong is reported; the
/// caller asks the diagnostics.
[[nodiscard]] CncParts declareCncPrograms(Program &program, const ProjectConfig &config,
                                          const std::vector<CncFound> &cncFiles,
                                          const std::vector<ast::File *> &files,
                                          const LibraryIndex &index);

/// Reports the files of a library, which makes none.
void refuseFiles(const CncParts &parts, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_CNC_CONFIG_HPP
