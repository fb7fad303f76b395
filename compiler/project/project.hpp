#ifndef STRIDE_COMPILER_PROJECT_PROJECT_HPP
#define STRIDE_COMPILER_PROJECT_PROJECT_HPP
// A project, from its path to a checked program.

#include "compiler/codegen/codegen.hpp"
#include "compiler/project/cnc_config.hpp"
#include "compiler/project/config.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/project/tests.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/syntax/parser.hpp"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace stc {

/// What a project is opened for.
enum class Purpose {
  Check, ///< a project without a PROGRAM is fine
  Build, ///< there must be something to run; unit tests are left out
  Test,  ///< the unit tests run instead of the tasks
};

/// The sources and the configuration of a project folder, or a single source file. Everything wrong
/// is in diagnostics(); the program is fit for code generation when there is no error among them.
class Project {
public:
  /// `path`: a folder, a stride.toml or a source file; empty: the project that the current folder
  /// belongs to. `overlay`: what
  /// an editor has not saved, or null; it must outlive the project.
  Project(const std::filesystem::path &path, Purpose purpose, const Settings &settings,
          const LibraryIndex &index, const Overlay *overlay = nullptr);

  /// All diagnostics so far, sorted; places in the synthetic declarations of the PLC configuration
  /// are given as the places of stride.toml they come from.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;
  [[nodiscard]] bool hasErrors() const { return program_.diagnostics.hasErrors(); }

  [[nodiscard]] Program &program() { return program_; }
  [[nodiscard]] const Program &program() const { return program_; }
  [[nodiscard]] const Sources &sources() const { return program_.sources; }
  /// A project that is one source file, with nothing of its own on disk.
  [[nodiscard]] bool isSingleFile() const { return single_; }
  /// The project's folder, or the single source file.
  [[nodiscard]] const std::filesystem::path &path() const { return path_; }
  /// Name of the application.
  [[nodiscard]] const std::string &name() const { return config_.name; }
  /// [retain] file of stride.toml; empty: not given.
  [[nodiscard]] const std::string &retainFile() const { return config_.retainFile; }
  /// The unit tests, for Purpose::Test; the task `Test` calls the one that which__ of kTestProgram
  /// names.
  [[nodiscard]] const std::vector<TestBlock> &tests() const { return tests_; }
  /// Its source, cam and CNC files, relative to its folder.
  [[nodiscard]] std::vector<std::string> files() const;
  /// [library] of stride.toml: the project is one.
  [[nodiscard]] const std::optional<LibraryInfo> &library() const { return config_.library; }
  /// [files] root of stride.toml; empty: not given.
  [[nodiscard]] const std::string &filesRoot() const { return config_.filesRoot; }
  /// What a build puts into that folder.
  [[nodiscard]] const std::vector<CncFile> &madeFiles() const { return madeFiles_; }
  /// The drives and axes with a `unit` in stride.toml: their names, and what one technical unit is.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> units() const;
  /// The groups of [[axes_group]].
  [[nodiscard]] const std::vector<AxesGroupConfig> &axesGroups() const {
    return config_.axesGroups;
  }
  /// The configuration of stride.toml.
  [[nodiscard]] const ProjectConfig &config() const { return config_; }
  /// Tasks and axis groups for code generation; only without errors.
  [[nodiscard]] AppConfig appConfig() const;

private:
  [[nodiscard]] std::vector<PouSymbol *> programsOf(const std::vector<ConfigName> &names) const;
  void load(const std::filesystem::path &given);
  void loadFolder();
  void loadFiles(const std::vector<std::filesystem::path> &files);
  void analyse(Purpose purpose, const LibraryIndex &index);
  void readOwnConfig();
  bool addDeclarations(Purpose purpose, ProgramCheck programCheck, std::vector<ast::File *> &files,
                       const ParseOptions &options, const LibraryIndex &index);
  void shareVariables();
  ast::File *parseSynthetic(const SyntheticSource &source, ParseOptions options);
  void loadAssets(const FoundFiles &found, std::vector<FileId> &ids);
  bool declareAxesGroups(std::vector<ast::File *> &files, const ParseOptions &options,
                         const LibraryIndex &index);
  bool declareCsy(std::vector<ast::File *> &files, const ParseOptions &options);
  bool declareCams(std::vector<ast::File *> &files, const ParseOptions &options);
  bool declareCnc(std::vector<ast::File *> &files, const ParseOptions &options,
                  const LibraryIndex &index);
  ast::File *eventFile(const TaskConfig &task, const ParseOptions &options);
  bool declaresNothing(const std::vector<ast::File *> &files) const;

  Program program_;
  ProjectConfig config_;
  std::filesystem::path path_;
  bool single_ = false;
  bool ownName_ = false; ///< its name does not come from its folder's
  bool loaded_ = false;
  std::vector<FileId> sourceFiles_;
  FileId tomlFile_ = 0;
  FileId plcFile_ = 0; ///< plcDeclarations()
  std::vector<FileId> camFiles_;
  std::vector<FileId> cncFiles_;
  std::vector<CncFile> madeFiles_;
  std::vector<TestBlock> tests_;
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_PROJECT_HPP
