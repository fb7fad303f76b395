#include "compiler/project/build.hpp"

#include "compiler/project/content_hash.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/installation.hpp"
#include "compiler/project/job_pool.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <unordered_map>
#include <unordered_set>

namespace stc {

namespace fs = std::filesystem;

namespace {

// Files in a cache folder, before the oldest are removed.
constexpr std::size_t kCacheFiles = 1000;

// Takes the folder in which we are out of the debug information.
constexpr std::string_view kHere = "-fdebug-prefix-map=";

// Folders in the user's cache where the sources of single files are compiled.
constexpr std::string_view kWorkPrefix = "work-";

// The dialect's semantics depend on these: DESIGN, section 4.
constexpr const char *kFixedFlags[] = {"-std=c++20",        "-fPIC",
                                       "-fwrapv",           "-fno-strict-aliasing",
                                       "-fno-finite-loops", "-fno-delete-null-pointer-checks",
                                       "-ffp-contract=off", "-fvisibility=hidden",
                                       "-fno-rtti"};

// Path of a program as execvp finds it, or empty.
fs::path findProgram(const std::string &name) {
  if (name.find('/') != std::string::npos)
    return ::access(name.c_str(), X_OK) == 0 ? fs::path(name) : fs::path();
  const char *path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/bin:/bin";
  while (true) {
    const std::size_t end = rest.find(':');
    const fs::path candidate = fs::path(rest.substr(0, end)) / name;
    if (::access(candidate.c_str(), X_OK) == 0)
      return candidate;
    if (end == std::string_view::npos)
      return {};
    rest.remove_prefix(end + 1);
  }
}

// Names, sizes and times of the headers that generated code includes.
std::string headerStamp(const fs::path &include) {
  std::vector<std::string> stamps;
  std::error_code error;
  for (const char *folder : {"runtime/iec", "runtime/app", "st"})
    for (fs::recursive_directory_iterator at(include / folder, error), end; !error && at != end;
         at.increment(error))
      if (at->path().extension() == ".h")
        stamps.push_back(fileStamp(at->path()));
  std::sort(stamps.begin(), stamps.end());
  ContentHash hash;
  for (const std::string &stamp : stamps)
    hash.add(stamp);
  return hash.hex();
}

// Names in `#include "…"` of a generated text.
std::vector<std::string> includesOf(std::string_view text) {
  constexpr std::string_view kInclude = "#include \"";
  std::vector<std::string> names;
  for (std::size_t at = text.find(kInclude); at != std::string_view::npos;
       at = text.find(kInclude, at)) {
    at += kInclude.size();
    const std::size_t end = text.find('"', at);
    if (end == std::string_view::npos)
      break;
    names.emplace_back(text.substr(at, end - at));
  }
  return names;
}

// Removes the files that were used longest ago when there are too many.
void pruneCache(const fs::path &cache) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (const fs::directory_entry &entry : fs::directory_iterator(cache, error))
    files.emplace_back(entry.last_write_time(error), entry.path());
  if (files.size() <= kCacheFiles)
    return;
  std::sort(files.begin(), files.end());
  for (std::size_t i = 0; i < files.size() - kCacheFiles / 2; ++i)
    fs::remove(files[i].second, error);
}

// Removes what failed builds of single files have left there for their message, after a day.
void removeAbandoned(const fs::path &folder) {
  std::error_code error;
  const auto limit = fs::file_time_type::clock::now() - std::chrono::hours(24);
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (at->path().filename().string().starts_with(kWorkPrefix) &&
        at->last_write_time(ignored) < limit)
      fs::remove_all(at->path(), ignored);
  }
}

// Marks a file of the cache as used; false when it is not there.
bool touch(const fs::path &path) { return ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0) == 0; }

class Builder {
public:
  Builder(Project &project, const BuildOptions &options)
      : project_(project), options_(options), diagnostics_(project.program().diagnostics) {}

  std::optional<BuildResult> run() {
    progress("generating C++", 0, 1);
    files_ = generateApplication(project_.program(), project_.appConfig());
    if (options_.emitOnly)
      return emit();
    if (!findToolchain() || !chooseFolders())
      return std::nullopt;
    for (const GeneratedFile &file : files_)
      byPath_.emplace(file.path, &file);
    return compileAndLink();
  }

private:
  struct Unit {
    const GeneratedFile *file;
    fs::path object;
  };

  std::optional<BuildResult> emit() {
    fs::path folder = options_.output;
    if (folder.empty())
      folder = project_.isSingleFile() ? fs::path(project_.path().stem().string() + "-cpp")
                                       : project_.path() / "build" / "cpp";
    if (!writeSources(folder))
      return std::nullopt;
    return BuildResult{folder, 0, files_.size(), {}, {}};
  }

  bool findToolchain() {
    std::string missing;
    std::optional<Installation> found = findInstallation(missing, options_.target);
    std::error_code error;
    for (std::size_t i = 0; found && options_.isStatic && i < found->hostLibraries.size(); ++i) {
      if (fs::exists(found->hostLibraries[i], error))
        continue;
      missing = found->hostLibraries[i].string();
      found.reset();
    }
    if (!found) {
      Diagnostic &d = diagnostics_.report(
          Code::toolchainMissing, {}, fmt::format("Stride's own file `{}` is missing", missing));
      if (!options_.target.empty())
        d.help(fmt::format("this installation has no runtime for {}: install the cross compiler "
                           "g++-{}, then build and install Stride from its sources with cmake "
                           "-DSTRIDE_TARGETS={}",
                           options_.target, options_.target, options_.target));
      return false;
    }
    installation_ = *found;
    const char *configured = std::getenv("STRIDE_CXX");
    std::string name = configured != nullptr && *configured != 0 ? configured : "g++";
    if (!options_.target.empty())
      name = options_.target + "-g++";
    compiler_ = findProgram(name);
    if (compiler_.empty()) {
      Diagnostic &d = diagnostics_.report(Code::toolchainMissing, {},
                                          fmt::format("the C++ compiler `{}` was not found", name));
      if (options_.target.empty())
        d.help("install it (Debian: apt-get install g++), or name one in the environment variable "
               "STRIDE_CXX");
      else
        d.help(fmt::format("install it (Debian: apt-get install g++-{})", options_.target));
      return false;
    }
    const fs::path real = fs::canonical(compiler_, error);
    base_.add(fileStamp(real)).add(headerStamp(installation_.include));
    for (const char *flag : kFixedFlags)
      base_.add(flag);
    for (const std::string &flag : variableFlags())
      base_.add(flag);
    base_.add(kHere);
    return true;
  }

  std::vector<std::string> variableFlags() const {
    std::vector<std::string> flags = installation_.compileFlags;
    if (options_.debug)
      flags.insert(flags.end(), {"-O0", "-g"});
    else
      // Aligned, so that the speed of a loop does not depend on what lies in front of it; with line
      // tables and all frames, so that an exception can say where it came from.
      flags.insert(flags.end(), {"-O2", "-g1", "-fno-optimize-sibling-calls",
                                 "-falign-functions=64", "-falign-loops=32"});
    return flags;
  }

  bool chooseFolders() {
    std::error_code error;
    if (project_.isSingleFile()) {
      cache_ = userCacheFolder() / "objects";
      removeAbandoned(userCacheFolder());
      sources_ = userCacheFolder() / fmt::format("{}{}", kWorkPrefix, ::getpid());
    } else {
      const fs::path folder = project_.path() / "build";
      cache_ = folder / "cache";
      sources_ = folder / "cpp";
      fs::create_directories(folder, error);
      if (!fs::exists(folder / ".gitignore", error) && !writeFile(folder / ".gitignore", "*\n"))
        return cannotWrite(folder);
    }
    fs::create_directories(cache_, error);
    return error ? cannotWrite(cache_, error.message()) : true;
  }

  bool cannotWrite(const fs::path &path, const std::string &reason = lastError()) {
    diagnostics_.report(Code::cannotWrite, {},
                        fmt::format("`{}` cannot be written: {}", path.string(), reason));
    return false;
  }

  // Writes the generated files; what an earlier build left there and this one has not is removed.
  bool writeSources(const fs::path &folder) {
    std::unordered_set<std::string> written;
    for (const GeneratedFile &file : files_) {
      const fs::path path = folder / file.path;
      if (!writeIfDifferent(path, file.text))
        return cannotWrite(path);
      written.insert(path.lexically_normal().string());
    }
    std::error_code error;
    std::vector<fs::path> stale;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error))
      if (const std::string suffix = at->path().extension().string();
          (suffix == ".cpp" || suffix == ".h") &&
          !written.contains(at->path().lexically_normal().string()))
        stale.push_back(at->path());
    if (!options_.emitOnly)
      for (const fs::path &path : stale)
        fs::remove(path, error);
    return true;
  }

  // Everything a translation unit depends on: flags, compiler, headers, its text and the generated
  // headers it includes.
  std::string keyOf(const GeneratedFile &unit) const {
    ContentHash hash = base_;
    std::vector<const GeneratedFile *> pending = {&unit};
    std::unordered_set<const GeneratedFile *> seen = {&unit};
    while (!pending.empty()) {
      const GeneratedFile *file = pending.back();
      pending.pop_back();
      hash.add(file->path).add(file->text);
      for (const std::string &name : includesOf(file->text))
        if (const auto found = byPath_.find(name);
            found != byPath_.end() && seen.insert(found->second).second)
          pending.push_back(found->second);
    }
    return hash.hex();
  }

  std::optional<BuildResult> compileAndLink() {
    BuildResult result;
    std::vector<Unit> units;
    std::vector<Unit> outdated;
    ContentHash link = base_;
    for (const GeneratedFile &file : files_) {
      if (!file.path.ends_with(".cpp"))
        continue;
      const std::string key = keyOf(file);
      units.push_back({&file, cache_ / (key + ".o")});
      link.add(key);
      if (!touch(units.back().object))
        outdated.push_back(units.back());
    }
    for (const fs::path &library : installation_.libraries)
      link.add(fileStamp(library));
    if (options_.isStatic)
      for (const fs::path &library : installation_.hostLibraries)
        link.add(fileStamp(library));
    result.units = units.size();
    result.compiled = outdated.size();

    const fs::path linked = cache_ / (link.hex() + (options_.isStatic ? ".exe" : ".so"));
    // A project keeps its generated sources for the reader; a single file only while they are
    // compiled.
    if ((!project_.isSingleFile() || !outdated.empty()) && !writeSources(sources_))
      return std::nullopt;
    if (!compile(outdated) || (!touch(linked) && !linkTo(linked, units)))
      return std::nullopt;
    std::error_code error;
    if (project_.isSingleFile())
      fs::remove_all(sources_, error);
    if (!outdated.empty())
      pruneCache(cache_);
    result.application = options_.output;
    result.retainFile = retainFileOf(project_);
    result.filesRoot = filesRootOf(project_);
    if (result.application.empty())
      result.application = project_.isSingleFile() ? linked
                           : options_.isStatic     ? project_.path() / "build" / "app"
                                                   : project_.path() / "build" / "app.so";
    if (result.application != linked && !place(linked, result.application))
      return std::nullopt;
    return result;
  }

  std::vector<std::string> compileCommand(const Unit &unit, const fs::path &object) const {
    std::vector<std::string> command = {compiler_.string()};
    command.insert(command.end(), std::begin(kFixedFlags), std::end(kFixedFlags));
    for (std::string &flag : variableFlags())
      command.push_back(std::move(flag));
    // Objects serve whoever has the same sources, wherever they lie: their files are relative.
    std::error_code error;
    command.push_back(std::string(kHere) + fs::current_path(error).string() + "=.");
    command.insert(command.end(),
                   {"-I", sources_.string(), "-I", installation_.include.string(), "-c",
                    (sources_ / unit.file->path).string(), "-o", object.string()});
    return command;
  }

  // Cached files appear complete or not at all: they are written beside and then renamed.
  fs::path beside(const fs::path &path) const {
    return path.string() + fmt::format(".{}.tmp", ::getpid());
  }

  bool compile(const std::vector<Unit> &units) {
    std::vector<Job> jobs;
    for (const Unit &unit : units)
      jobs.push_back(
          {compileCommand(unit, beside(unit.object)), fs::path(unit.file->path).stem().string()});
    const std::vector<JobResult> results = runJobs(jobs, [&](std::size_t job) {
      progress("compiling " + jobs[job].title, job, jobs.size() + 1);
    });
    bool good = true;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      if (results[i].status < 0)
        continue;
      if (results[i].status != 0) {
        reportFailure("compiling", jobs[i], results[i]);
        good = false;
      } else if (::rename(beside(units[i].object).c_str(), units[i].object.c_str()) != 0) {
        good = cannotWrite(units[i].object);
      }
    }
    return good;
  }

  bool linkTo(const fs::path &linked, const std::vector<Unit> &units) {
    progress("linking", units.size(), units.size() + 1);
    Job job;
    job.command = {compiler_.string(),
                   options_.isStatic ? "-static" : "-shared",
                   "-o",
                   beside(linked).string(),
                   "-Wl,--gc-sections",
                   "-Wl,--build-id=none"};
    // Debian's cross compilers do not look for it.
    if (options_.target.empty() && !findProgram("ld.lld").empty())
      job.command.insert(job.command.begin() + 1, "-fuse-ld=lld");
    if (!options_.isStatic) {
      job.command.insert(job.command.end(), {"-Wl,--exclude-libs,ALL", "-Wl,-Bsymbolic"});
      job.command.insert(job.command.end(), installation_.linkFlags.begin(),
                         installation_.linkFlags.end());
    }
    for (const Unit &unit : units)
      job.command.push_back(unit.object.string());
    job.command.emplace_back("-Wl,--start-group");
    if (options_.isStatic)
      for (const fs::path &library : installation_.hostLibraries)
        job.command.push_back(library.string());
    for (const fs::path &library : installation_.libraries)
      job.command.push_back(library.string());
    job.command.emplace_back("-Wl,--end-group");
    if (options_.isStatic)
      job.command.insert(job.command.end(), installation_.staticFlags.begin(),
                         installation_.staticFlags.end());
    const std::vector<JobResult> results = runJobs({job});
    if (results[0].status != 0) {
      reportFailure("linking", job, results[0]);
      return false;
    }
    return ::rename(beside(linked).c_str(), linked.c_str()) == 0 || cannotWrite(linked);
  }

  void reportFailure(std::string_view step, const Job &job, const JobResult &result) {
    Diagnostic &d = diagnostics_.report(
        Code::compilerFailed, {},
        fmt::format("{} the generated C++ failed: this is a defect of Stride", step));
    d.note("to reproduce: " + shellQuoted(job.command));
    std::string_view output = result.output;
    for (int lines = 0; lines < 12 && !output.empty(); ++lines) {
      const std::size_t end = output.find('\n');
      d.note(std::string(output.substr(0, end)));
      output = end == std::string_view::npos ? std::string_view() : output.substr(end + 1);
    }
  }

  // Makes `to` the same file as the one in the cache, or a copy of it.
  bool place(const fs::path &from, const fs::path &to) {
    struct stat a {};
    struct stat b {};
    if (::stat(from.c_str(), &a) == 0 && ::stat(to.c_str(), &b) == 0 && a.st_dev == b.st_dev &&
        a.st_ino == b.st_ino)
      return true;
    std::error_code error;
    if (to.has_parent_path())
      fs::create_directories(to.parent_path(), error);
    const fs::path temporary = beside(to);
    fs::remove(temporary, error);
    if (::link(from.c_str(), temporary.c_str()) != 0) {
      error.clear();
      fs::copy_file(from, temporary, error);
      if (error)
        return cannotWrite(to, error.message());
    }
    if (::rename(temporary.c_str(), to.c_str()) == 0)
      return true;
    const std::string reason = lastError();
    fs::remove(temporary, error);
    return cannotWrite(to, reason);
  }

  void progress(std::string_view what, std::size_t done, std::size_t total) const {
    if (options_.progress)
      options_.progress(what, done, total);
  }

  Project &project_;
  const BuildOptions &options_;
  Diagnostics &diagnostics_;
  Installation installation_;
  fs::path compiler_;
  fs::path sources_;
  fs::path cache_;
  ContentHash base_;
  std::vector<GeneratedFile> files_;
  std::unordered_map<std::string, const GeneratedFile *> byPath_;
};

} // namespace

fs::path userCacheFolder() {
  if (const char *cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/')
    return fs::path(cache) / "stride";
  if (const char *home = std::getenv("HOME"); home != nullptr && *home == '/')
    return fs::path(home) / ".cache" / "stride";
  return fs::path("/tmp") / fmt::format("stride-{}", ::getuid());
}

fs::path retainFileOf(const Project &project) {
  const fs::path folder = project.isSingleFile() ? project.path().parent_path() : project.path();
  if (!project.retainFile().empty())
    return folder / project.retainFile();
  return project.isSingleFile() ? folder / (project.path().stem().string() + ".retain")
                                : folder / "retain" / project.name();
}

fs::path filesRootOf(const Project &project) {
  const fs::path folder = project.isSingleFile() ? project.path().parent_path() : project.path();
  return folder / (project.filesRoot().empty() ? "files" : project.filesRoot());
}

std::optional<BuildResult> build(Project &project, const BuildOptions &options) {
  return Builder(project, options).run();
}

} // namespace stc
