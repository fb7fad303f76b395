#include "compiler/project/toolchain.hpp"

#include "compiler/project/file_system.hpp"
#include "compiler/project/job_pool.hpp"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace stc {

namespace fs = std::filesystem;

namespace {

// The dialect's semantics depend on these: DESIGN, section 4.
constexpr const char *kFixedFlags[] = {"-std=c++20",        "-fPIC",
                                       "-fwrapv",           "-fno-strict-aliasing",
                                       "-fno-finite-loops", "-fno-delete-null-pointer-checks",
                                       "-ffp-contract=off", "-fvisibility=hidden",
                                       "-fno-rtti"};

// Variables with which GCC finds other headers or parts of itself (GCC manual, section 3.21).
constexpr const char *kVariables[] = {
    "CPATH",        "C_INCLUDE_PATH",  "CPLUS_INCLUDE_PATH", "COMPILER_PATH",
    "LIBRARY_PATH", "GCC_EXEC_PREFIX", "SOURCE_DATE_EPOCH",  "LD_RUN_PATH"};

// By Launcher.
constexpr const char *kLauncherPrograms[] = {"", "ccache", "distcc", "icecc"};

// Parts of the compiler, as `-print-prog-name` knows them.
constexpr const char *kParts[] = {"cc1plus", "as", "ld", "ld.lld", "collect2"};

/// Stride's headers that generated code includes.
std::vector<fs::path> ownHeaders(const fs::path &include) {
  std::vector<fs::path> headers;
  std::error_code error;
  for (const char *folder : {"runtime/iec", "runtime/app", "st"})
    for (fs::recursive_directory_iterator at(include / folder, error), end; !error && at != end;
         at.increment(error))
      if (at->path().extension() == ".h")
        headers.push_back(at->path());
  std::sort(headers.begin(), headers.end());
  return headers;
}

/// Files named in a rule as `g++ -M` writes it: blanks in names have a backslash, `$` is doubled.
std::vector<std::string> filesOfRule(std::string_view rule) {
  std::vector<std::string> files;
  std::string name;
  const auto end = [&] {
    if (!name.empty() && name.back() != ':')
      files.push_back(name);
    name.clear();
  };
  for (size_t i = 0; i < rule.size(); ++i) {
    const char next = i + 1 < rule.size() ? rule[i + 1] : '\n';
    if (rule[i] == '\\' && (next == ' ' || next == '#'))
      name += rule[++i];
    else if (rule[i] == '\\' && next == '\n')
      ++i;
    else if (rule[i] == '$' && next == '$')
      name += rule[++i];
    else if (rule[i] == ' ' || rule[i] == '\n')
      end();
    else
      name += rule[i];
  }
  end();
  return files;
}

/// The system's headers and the parts of the compiler; empty when it does not say.
std::string askCompiler(const Toolchain &toolchain, const std::vector<fs::path> &headers,
                        const fs::path &work) {
  const fs::path probe = work / "headers.cpp";
  const fs::path &include = toolchain.installation.include;
  std::string text;
  for (const fs::path &header : headers)
    if (const std::string name = header.lexically_relative(include).string();
        name.starts_with("runtime/")) // those of libraries include nothing else
      text += "#include \"" + name + "\"\n";
  if (!writeFile(probe, text))
    return {};
  std::vector<Job> jobs(1);
  jobs[0].command = {toolchain.compiler.string()};
  jobs[0].command.insert(jobs[0].command.end(), toolchain.compileFlags.begin(),
                         toolchain.compileFlags.end());
  jobs[0].command.insert(jobs[0].command.end(), {"-I", include.string(), "-M", probe.string()});
  for (const char *part : kParts)
    jobs.push_back(
        {{toolchain.compiler.string(), std::string("-print-prog-name=") + part}, {}, {}});
  const std::vector<JobResult> results = runJobs(jobs);
  std::string list;
  for (const JobResult &result : results) {
    if (result.status != 0)
      return {};
    if (&result == &results.front()) {
      for (const std::string &file : filesOfRule(result.output))
        if (file.starts_with('/') && file != probe && !file.starts_with(include.string() + "/"))
          list += file + '\n';
    } else if (const fs::path part = findProgram(result.output.substr(0, result.output.find('\n')));
               !part.empty()) {
      list += part.string() + '\n';
    }
  }
  return list;
}

/// Adds the stamps of the files, one a line; false: one of them is gone.
bool addStamps(ContentHash &hash, std::string_view files) {
  while (!files.empty()) {
    const size_t end = files.find('\n');
    const std::string stamp = fileStamp(fs::path(files.substr(0, end)));
    if (stamp.empty() || end == std::string_view::npos)
      return false;
    hash.add(stamp);
    files.remove_prefix(end + 1);
  }
  return true;
}

} // namespace

fs::path findProgram(const std::string &name) {
  std::error_code error;
  if (name.find('/') != std::string::npos)
    return ::access(name.c_str(), X_OK) == 0 ? fs::absolute(name, error) : fs::path();
  const char *path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/bin:/bin";
  while (true) {
    const size_t end = rest.find(':');
    fs::path candidate = fs::absolute(fs::path(rest.substr(0, end)) / name, error);
    if (::access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate, error))
      return candidate;
    if (end == std::string_view::npos)
      return {};
    rest.remove_prefix(end + 1);
  }
}

bool findLauncher(Launcher launcher, Toolchain &toolchain, Diagnostics &diagnostics) {
  if (launcher == Launcher::None)
    return true;
  const std::string name = kLauncherPrograms[static_cast<size_t>(launcher)];
  toolchain.launcher = findProgram(name);
  if (!toolchain.launcher.empty())
    return true;
  diagnostics
      .report(Code::ToolchainMissing, {},
              fmt::format("`{}`, the launcher that stride.toml names, was not found", name))
      .help(fmt::format(
          "install it (Debian: apt-get install {}), or remove `launcher` from [build]", name));
  return false;
}

static std::vector<std::string> flagsFor(const Installation &installation, bool debug,
                                         bool runsOnce, bool isNumeric) {
  std::vector<std::string> flags(std::begin(kFixedFlags), std::end(kFixedFlags));
  if (debug)
    flags.insert(flags.end(), {"-O0", "-g"});
  else
    // Aligned, so that the speed of a loop does not depend on what lies before it; with line
    // tables and all frames, so that an exception can say where it came from; a part of a function
    // that is inlined into the rest of it would look like a recursion there. Pairs of numbers
    // that are put into one register on their way through memory wait for each other (n_body runs
    // twice as long), and the elimination of common subexpressions on RTL finds next to nothing
    // that other passes have left: tests/bench/st measures both.
    flags.insert(flags.end(), {"-O2", "-g1", "-fno-optimize-sibling-calls", "-fno-partial-inlining",
                               "-falign-functions=64", "-falign-loops=32",
                               "-fno-tree-slp-vectorize", "-fno-gcse"});
  // What -O2 adds takes a third of the time and pays in loops; so do the passes of -O1 that are
  // left out. They look for what straight code that works on the memory of an instance does not
  // have, or what the passes on RTL find as well.
  if (!debug && runsOnce)
    flags.insert(flags.end(),
                 {"-O1", "-fno-tree-fre", "-fno-tree-dominator-opts", "-fno-tree-dse",
                  "-fno-tree-pta", "-fno-ipa-modref", "-fno-tree-sink", "-fno-tree-forwprop"});
  // Sums in loops wait less for each other (fft takes 0.94 of the time); it costs 3 to 5 % of the
  // compiler's time, and no other loops are quicker.
  if (!debug && isNumeric)
    flags.emplace_back("-frename-registers");
  // The installation has the last word: one with sanitizers does not optimise.
  flags.insert(flags.end(), installation.compileFlags.begin(), installation.compileFlags.end());
  return flags;
}

void setFlags(Toolchain &toolchain, const Installation &installation, bool debug) {
  toolchain.compileFlags = flagsFor(installation, debug, false, false);
  toolchain.onceFlags = flagsFor(installation, debug, true, false);
  toolchain.numericFlags = flagsFor(installation, debug, false, true);
}

std::vector<std::string> linkCommand(const Toolchain &toolchain, bool isStatic, bool isCross,
                                     const fs::path &linked, const std::vector<fs::path> &objects) {
  const Installation &installation = toolchain.installation;
  std::vector<std::string> command = {toolchain.compiler.string()};
  const auto add = [&command](const auto &words) {
    command.insert(command.end(), words.begin(), words.end());
  };
  if (!isCross && !findProgram("ld.lld").empty()) // Debian's cross compilers do not look for it
    command.emplace_back("-fuse-ld=lld");
  command.emplace_back(isStatic ? "-static" : "-shared");
  command.insert(command.end(),
                 {"-o", linked.string(), "-Wl,--gc-sections", "-Wl,--build-id=none"});
  if (!isStatic) {
    command.insert(command.end(), {"-Wl,--exclude-libs,ALL", "-Wl,-Bsymbolic"});
    add(installation.linkFlags);
  }
  add(objects);
  command.emplace_back("-Wl,--start-group");
  if (isStatic)
    add(installation.hostLibraries);
  add(installation.libraries);
  command.emplace_back("-Wl,--end-group");
  if (isStatic)
    add(installation.staticFlags);
  return command;
}

ContentHash identityOf(const Toolchain &toolchain, const UserCache &cache, const fs::path &work) {
  std::error_code error;
  ContentHash hash;
  hash.add(fileStamp(fs::canonical(toolchain.compiler, error)));
  for (const std::string &flag : toolchain.compileFlags)
    hash.add(flag);
  for (const std::string &flag : toolchain.onceFlags)
    hash.add(flag);
  for (const std::string &flag : toolchain.numericFlags)
    hash.add(flag);
  hash.add(toolchain.launcher.filename().string()); // another machine may have compiled it
  for (const char *variable : kVariables)
    if (const char *value = std::getenv(variable))
      hash.add(variable).add(value);
  const std::vector<fs::path> headers = ownHeaders(toolchain.installation.include);
  for (const fs::path &header : headers)
    hash.add(fileStamp(header));

  const std::string key = hash.hex();
  const ContentHash known = hash;
  if (const std::optional<std::string> list = cache.note(key);
      list && !list->empty() && addStamps(hash, *list))
    return hash;
  hash = known;
  const std::string list = askCompiler(toolchain, headers, work);
  if (!list.empty() && addStamps(hash, list))
    cache.setNote(key, list);
  return hash;
}

} // namespace stc
