#include "compiler/project/build.hpp"

#include "compiler/project/file_system.hpp"
#include "compiler/project/include_graph.hpp"
#include "compiler/project/job_pool.hpp"
#include "compiler/project/made_files.hpp"
#include "compiler/project/output_folder.hpp"
#include "compiler/project/precompiled_headers.hpp"
#include "compiler/project/toolchain.hpp"
#include "compiler/project/translation_units.hpp"
#include "compiler/project/user_cache.hpp"
#include "compiler/source/content_hash.hpp"
#include "compiler/source/workers.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unordered_set>
#include <utility>

namespace stc {

namespace fs = std::filesystem;

namespace {

// In the folder of emitted sources: the names of those that Stride has written there.
constexpr std::string_view kEmittedList = ".stride-sources";
constexpr uintmax_t kMaxListBytes = 16U << 20U; // of whatever a project ships under that name

// What is read in the time that a call of the C++ compiler takes, in bytes at least.
constexpr size_t kCompilerCall = 1U << 20U;

// A name of a generated file, as opposed to whatever else a list may hold.
bool isGeneratedName(const fs::path &name) {
  for (const fs::path &part : name)
    if (part == ".." || part == "/")
      return false;
  return name.extension() == ".cpp" || name.extension() == ".h";
}

class Builder {
public:
  Builder(Project &project, const BuildOptions &options)
      : project_(project), options_(options), diagnostics_(project.program().diagnostics) {}

  std::optional<BuildResult> run() {
    progress("generating C++", 0, 1);
    files_ = generateApplication(project_.program(), project_.appConfig());
    if (options_.emitOnly)
      return emit();
    if (!findToolchain() || !openCache())
      return std::nullopt;
    units_ = divideIntoUnits(files_);
    includes_.emplace(files_, workers());
    base_ = identityOf(toolchain_, *cache_, work_->path());
    return compileAndLink();
  }

private:
  struct Unit {
    const TranslationUnit *source;
    std::string key;
    size_t bytes;    ///< of all that it is compiled from
    fs::path object; ///< in the work folder
  };

  // ---- sources for a reader

  std::optional<BuildResult> emit() {
    fs::path root = options_.output;
    fs::path below;
    if (root.empty() && project_.isSingleFile()) {
      root = project_.path().stem().string() + "-cpp";
    } else if (root.empty()) {
      root = project_.path();
      below = "build/cpp";
    }
    if (!writeSources(root, below))
      return std::nullopt;
    return BuildResult{root / below, {}, {}, {}, {}, 0, files_.size(), {}, {}, {}, {}};
  }

  // Writes the generated files; what an earlier build has written there and this one has not is
  // removed.
  bool writeSources(const fs::path &root, const fs::path &below) {
    const std::optional<OutputFolder> folder = OutputFolder::open(root);
    if (!folder)
      return cannotWrite(root);
    std::unordered_set<std::string> written;
    std::string list;
    for (const GeneratedFile &file : files_) {
      if (!folder->write(below / file.path, file.text))
        return cannotWrite(root / below / file.path);
      written.insert(file.path);
      list += file.path + '\n';
    }
    if (const std::optional<std::string> old = folder->read(below / kEmittedList, kMaxListBytes))
      for (std::string_view rest = *old; !rest.empty();) {
        const std::string name(rest.substr(0, rest.find('\n')));
        rest.remove_prefix(std::min(rest.size(), name.size() + 1));
        if (!written.contains(name) && isGeneratedName(name))
          static_cast<void>(folder->remove(below / name));
      }
    if (!folder->write(below / kEmittedList, list))
      return cannotWrite(root / below / kEmittedList);
    return true;
  }

  // ---- what is needed

  bool findToolchain() {
    std::string missing;
    std::optional<Installation> found = findInstallation(missing, options_.target);
    std::error_code error;
    for (size_t i = 0; found && options_.isStatic && i < found->hostLibraries.size(); ++i) {
      if (fs::exists(found->hostLibraries[i], error))
        continue;
      missing = found->hostLibraries[i].string();
      found.reset();
    }
    if (!found) {
      Diagnostic &d = diagnostics_.report(
          Code::ToolchainMissing, {}, fmt::format("Stride's own file `{}` is missing", missing));
      if (!options_.target.empty())
        d.help(fmt::format("this installation has no runtime for {}: install the cross compiler "
                           "g++-{}, then build and install Stride from its sources with cmake "
                           "-DSTRIDE_TARGETS={}",
                           options_.target, options_.target, options_.target));
      return false;
    }
    toolchain_.installation = *found;
    setFlags(toolchain_, *found, options_.debug);
    return findCompiler();
  }

  bool findCompiler() {
    const char *configured = std::getenv("STRIDE_CXX");
    std::string name = configured != nullptr && *configured != 0 ? configured : "g++";
    if (!options_.target.empty())
      name = options_.target + "-g++";
    toolchain_.compiler = findProgram(name);
    if (!toolchain_.compiler.empty())
      return findLauncher(project_.config().launcher, toolchain_, diagnostics_);
    Diagnostic &d = diagnostics_.report(Code::ToolchainMissing, {},
                                        fmt::format("the C++ compiler `{}` was not found", name));
    if (options_.target.empty())
      d.help("install it (Debian: apt-get install g++), or name one in the environment variable "
             "STRIDE_CXX");
    else
      d.help(fmt::format("install it (Debian: apt-get install g++-{})", options_.target));
    return false;
  }

  bool openCache() {
    cache_ = UserCache::open();
    if (!cache_) {
      diagnostics_.report(Code::CannotWrite, {},
                          fmt::format("no folder can be made to compile in: {}", lastError()));
      return false;
    }
    if (!cache_->problem().empty())
      diagnostics_.report(Code::CacheNotPrivate, {}, "the cache folder " + cache_->problem())
          .help("nothing is kept for the next build; give the folder to the user who builds, with "
                "write permission for nobody else, or name another one in XDG_CACHE_HOME");
    if (std::optional<WorkFolder> work = cache_->makeWorkFolder())
      work_.emplace(std::move(*work));
    else
      return cannotWrite(cache_->folder() / "work");
    sources_ = work_->path() / "src";
    return true;
  }

  bool cannotWrite(const fs::path &path) {
    reportCannotWrite(path, diagnostics_);
    return false;
  }

  // ---- compiling

  /// With a key of everything that it depends on.
  Unit unitOf(const TranslationUnit &unit, size_t number) {
    ContentHash hash = base_;
    hash.add(uint64_t{unit.runsOnce}).add(uint64_t{unit.isNumeric});
    hash.add(uint64_t{precompilesHeaders(toolchain_, units_.size())});
    size_t bytes = 0;
    for (const GeneratedFile *file : includes_->closureOf(unit.path)) {
      hash.add(includes_->hashOf(*file));
      bytes += file->text.size();
    }
    return {&unit, hash.hex(), bytes, work_->path() / fmt::format("{}.o", number)};
  }

  std::vector<Unit> units() {
    std::vector<Unit> units;
    for (const TranslationUnit &unit : units_)
      units.push_back(unitOf(unit, units.size()));
    return units;
  }

  std::string linkKey(const std::vector<Unit> &units) const {
    ContentHash hash = base_;
    hash.add(uint64_t{options_.isStatic});
    for (const Unit &unit : units)
      hash.add(unit.key);
    for (const std::string &flag : toolchain_.installation.linkFlags)
      hash.add(flag);
    for (const fs::path &library : toolchain_.installation.libraries)
      hash.add(fileStamp(library));
    if (options_.isStatic)
      for (const fs::path &library : toolchain_.installation.hostLibraries)
        hash.add(fileStamp(library));
    return hash.hex();
  }

  std::string_view kind() const { return options_.isStatic ? ".exe" : ".so"; }

  std::optional<BuildResult> compileAndLink() {
    BuildResult result;
    const std::vector<Unit> all = units();
    const std::string key = linkKey(all);
    result.units = all.size();
    linked_ = cache_->content(key, kind());
    if (!linked_) {
      // Whoever has it builds the same, perhaps; then nothing is left to do.
      const std::optional<CacheLock> lock = cache_->lock(key);
      linked_ = cache_->content(key, kind());
      if (!linked_ && !make(key, all, result.compiled)) {
        work_->keep();
        return std::nullopt;
      }
    }
    return deliver(key, std::move(result));
  }

  bool make(const std::string &key, const std::vector<Unit> &all, size_t &compiled) {
    std::vector<Unit> outdated;
    std::vector<Unit> kept;
    for (const Unit &unit : all)
      (cache_->mayHave(unit.key, ".o") ? kept : outdated).push_back(unit);
    // What takes long comes first, so that no processor waits for it at the end.
    std::stable_sort(outdated.begin(), outdated.end(),
                     [](const Unit &a, const Unit &b) { return a.bytes > b.bytes; });
    std::vector<Unit> broken;
    // What is kept is looked at while the others are compiled.
    bool good = true;
    Workers::each(2, workers().threadsFor(2, kCompilerCall), [&](size_t what, unsigned) {
      if (what == 0)
        good = compile(outdated);
      else
        broken = fetch(kept);
    });
    outdated.insert(outdated.end(), broken.begin(), broken.end());
    compiled = outdated.size();
    const fs::path linked = work_->path() / ("linked" + std::string(kind()));
    if (!good || !compile(broken) || !linkTo(linked, all))
      return false;
    if (identityOf(toolchain_, *cache_, work_->path()).hex() != base_.hex()) {
      diagnostics_
          .report(Code::ToolchainMissing, {},
                  "the compiler or Stride itself was changed while this was built")
          .help("build again when that has ended");
      return false;
    }
    for (const Unit &unit : outdated) // without them the next build takes longer, no more
      static_cast<void>(cache_->publish(unit.key, ".o", unit.object));
    linked_ = cache_->publish(key, kind(), linked);
    if (!linked_)
      return cannotWrite(cache_->place(key, kind()));
    if (!outdated.empty())
      cache_->prune(outdated.front().key, ".o");
    cache_->prune(key, kind());
    return true;
  }

  /// Takes from the cache what it has of them, and returns the others.
  std::vector<Unit> fetch(const std::vector<Unit> &units) const {
    std::vector<Unit> broken;
    for (const Unit &unit : units)
      if (!cache_->fetch(unit.key, ".o", unit.object))
        broken.push_back(unit);
    return broken;
  }

  /// What they are compiled from, into the folder of this build.
  bool writeSourcesOf(const std::vector<Unit> &units) {
    for (const Unit &unit : units)
      for (const GeneratedFile *file : includes_->closureOf(unit.source->path))
        if (written_.insert(file).second && !writeNewFile(sources_ / file->path, file->text))
          return cannotWrite(sources_ / file->path);
    return true;
  }

  /// The compiler and all that is the same for all sources that have these flags.
  std::vector<std::string> compilerWith(const std::vector<std::string> &flags) const {
    std::vector<std::string> command;
    if (!toolchain_.launcher.empty())
      command.push_back(toolchain_.launcher.string());
    command.push_back(toolchain_.compiler.string());
    command.insert(command.end(), flags.begin(), flags.end());
    const std::string include = toolchain_.installation.include.string();
    // The assembler works meanwhile; the same bytes wherever sources, cache and Stride lie.
    command.insert(command.end(),
                   {"-pipe", fmt::format("-ffile-prefix-map={}=.", sources_.string()),
                    fmt::format("-ffile-prefix-map={}={}", include, kHeadersInLineTables), "-I",
                    sources_.string(), "-I", include});
    return command;
  }

  std::vector<std::string> compileCommand(const Unit &unit) const {
    std::vector<std::string> command =
        compilerWith(toolchain_.flagsOf(unit.source->runsOnce, unit.source->isNumeric));
    if (precompilesHeaders(toolchain_, units_.size()))
      command.insert(command.end(), {"-include", (sources_ / kPrecompiledHeaders).string()});
    command.insert(command.end(),
                   {"-c", (sources_ / unit.source->path).string(), "-o", unit.object.string()});
    return command;
  }

  bool precompile(const std::vector<Unit> &outdated) {
    if (outdated.empty() || precompiled_ || !precompilesHeaders(toolchain_, units_.size()))
      return true;
    const std::optional<PrecompilingFailed> failed = precompileHeaders(
        *cache_, base_, compilerWith(toolchain_.compileFlags), sources_, work_->path());
    if (failed && failed->result.status == 0)
      return cannotWrite(sources_);
    if (failed)
      reportFailure("compiling", failed->job, failed->result);
    precompiled_ = !failed;
    return precompiled_;
  }

  bool compile(const std::vector<Unit> &units) {
    if (!writeSourcesOf(units) || !precompile(units))
      return false;
    std::vector<Job> jobs;
    for (const Unit &unit : units)
      jobs.push_back(
          {compileCommand(unit), unit.source->title, sources_.string(), work_->path().string()});
    const std::vector<JobResult> results = runJobs(
        jobs, [&](size_t job) { progress("compiling " + jobs[job].title, job, jobs.size() + 1); },
        project_.config().buildJobs);
    bool good = true;
    for (size_t i = 0; i < jobs.size(); ++i)
      if (results[i].status > 0) {
        reportFailure("compiling", jobs[i], results[i]);
        good = false;
      }
    return good;
  }

  bool linkTo(const fs::path &linked, const std::vector<Unit> &units) {
    progress("linking", units.size(), units.size() + 1);
    std::vector<fs::path> objects;
    for (const Unit &unit : units)
      objects.push_back(unit.object);
    Job job;
    job.command =
        linkCommand(toolchain_, options_.isStatic, !options_.target.empty(), linked, objects);
    job.folder = work_->path().string();
    job.temporary = job.folder;
    const std::vector<JobResult> results = runJobs({job});
    if (results[0].status != 0)
      reportFailure("linking", job, results[0]);
    return results[0].status == 0;
  }

  /// What is no defect of Stride's: the folder went away, or there is no room.
  bool reportSurroundings(const JobResult &result) {
    std::error_code error;
    if (!fs::exists(work_->path(), error)) {
      diagnostics_
          .report(Code::CannotWrite, {},
                  fmt::format("`{}` was removed while it was compiled in", work_->path().string()))
          .help("build again");
      return true;
    }
    for (const int reason : {ENOSPC, EDQUOT, EFBIG, EROFS, EACCES, EPERM})
      if (const char *text = ::strerrordesc_np(reason);
          result.output.find(text) != std::string::npos) {
        diagnostics_
            .report(Code::CannotWrite, {},
                    fmt::format("the C++ compiler cannot write its results: {}", text))
            .help(fmt::format("it writes to `{}`", work_->path().parent_path().string()));
        return true;
      }
    return false;
  }

  void reportFailure(std::string_view step, const Job &job, const JobResult &result) {
    if (reportSurroundings(result))
      return;
    Diagnostic &d = diagnostics_.report(
        Code::CompilerFailed, {},
        fmt::format("{} the generated C++ failed: this is a defect of Stride", step));
    d.note("to reproduce: cd " + shellQuoted({job.folder}) + " && " + shellQuoted(job.command));
    std::string_view output = result.output;
    for (int lines = 0; lines < 12 && !output.empty(); ++lines) {
      const size_t end = output.find('\n');
      d.note(std::string(output.substr(0, end)));
      output = end == std::string_view::npos ? std::string_view() : output.substr(end + 1);
    }
  }

  // ---- results

  /// Copies what the store has to where it is wanted.
  std::optional<BuildResult> deliver(const std::string &key, BuildResult result) {
    result.runnable = cache_->place(key, kind());
    result.name = project_.name();
    result.headers = toolchain_.installation.include;
    result.folder = folderOf(project_);
    result.retainFile = retainFileOf(project_);
    result.filesRoot = filesRootOf(project_);
    for (const AxesGroupConfig &group : project_.axesGroups())
      result.groups.push_back(groupTrace(group));
    if ((options_.use == BuildUse::Keep && !keep(result)) ||
        !writeMadeFiles(project_, folderOf(project_), result.filesRoot, diagnostics_) ||
        (!options_.filesFolder.empty() &&
         !writeMadeFiles(project_, options_.filesFolder, options_.filesFolder, diagnostics_)))
      return std::nullopt;
    if ((project_.isSingleFile() && options_.use != BuildUse::Run) || options_.isStatic ||
        !options_.target.empty())
      return result;
    std::error_code error;
    const std::string project = fs::canonical(project_.path(), error).string();
    const std::string projectKey = ContentHash().add(project).hex();
    result.latest = cache_->latest(projectKey);
    const bool isLatest = options_.use == BuildUse::Run ||
                          (options_.use == BuildUse::Keep && options_.output.empty());
    if (isLatest && !cache_->setLatest(projectKey, result.runnable)) {
      cannotWrite(result.latest);
      return std::nullopt;
    }
    return result;
  }

  bool keep(BuildResult &result) {
    result.application = options_.output;
    if (!result.application.empty())
      return writeFile(result.application, *linked_, 0777) || cannotWrite(result.application);
    const fs::path name = fs::path("build") / (options_.isStatic ? "app" : "app.so");
    result.application = project_.path() / name;
    const std::optional<OutputFolder> folder = OutputFolder::open(project_.path());
    if (!folder || !folder->write(name, *linked_, 0777))
      return cannotWrite(result.application);
    return hideBuilds(*folder) || cannotWrite(project_.path() / "build");
  }

  [[nodiscard]] Workers workers() const { return Workers(project_.program().settings.jobs); }

  void progress(std::string_view what, size_t done, size_t total) const {
    if (options_.progress)
      options_.progress(what, done, total);
  }

  Project &project_;
  const BuildOptions &options_;
  Diagnostics &diagnostics_;
  Toolchain toolchain_;
  std::optional<UserCache> cache_;
  std::optional<WorkFolder> work_;
  fs::path sources_;
  ContentHash base_; ///< the tool chain's
  std::vector<GeneratedFile> files_;
  std::vector<TranslationUnit> units_;
  std::optional<IncludeGraph> includes_;
  std::unordered_set<const GeneratedFile *> written_; ///< to `sources_`
  bool precompiled_ = false;
  std::optional<std::string> linked_; ///< what is built
};

} // namespace

fs::path folderOf(const Project &project) {
  return project.isSingleFile() ? project.path().parent_path() : project.path();
}

fs::path retainFileOf(const Project &project) {
  const fs::path folder = folderOf(project);
  if (!project.retainFile().empty())
    return folder / project.retainFile();
  return project.isSingleFile() ? folder / (project.path().stem().string() + ".retain")
                                : folder / "retain" / project.name();
}

fs::path filesRootOf(const Project &project) {
  const fs::path folder = folderOf(project);
  return folder / (project.filesRoot().empty() ? "files" : project.filesRoot());
}

std::optional<BuildResult> build(Project &project, const BuildOptions &options) {
  return Builder(project, options).run();
}

} // namespace stc
