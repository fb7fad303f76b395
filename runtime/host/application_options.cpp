#include "runtime/host/application_options.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/app/symbols.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

namespace stride::host {

namespace {

using Applications = std::vector<std::unique_ptr<app::Application>>;

bool has(const app::Application &application, const std::string &path) {
  try {
    (void)app::SymbolTable(application.description()).resolve(path);
    return true;
  } catch (const app::Error &) {
    return false;
  }
}

std::optional<size_t> find(const Applications &applications, const std::string &name) {
  for (size_t i = 0; i < applications.size(); ++i)
    if (applications[i]->name() == name)
      return i;
  return std::nullopt;
}

/// The application that a path belongs to; takes its name off the path.
size_t ownerOf(const Applications &applications, std::string &path) {
  if (const size_t colon = path.find(':'); colon != std::string::npos) {
    const std::string name = path.substr(0, colon);
    path.erase(0, colon + 1);
    if (const std::optional<size_t> found = find(applications, name))
      return *found;
    std::vector<std::string> names;
    for (const std::unique_ptr<app::Application> &application : applications)
      names.emplace_back(application->name());
    throw app::Error(fmt::format("'{}:{}': there is no application '{}'{}; there are {}", name,
                                 path, name, app::didYouMean(name, names), fmt::join(names, ", ")));
  }
  for (size_t i = 0; i < applications.size(); ++i)
    if (has(*applications[i], path))
      return i;
  return 0; // which says what is wrong with it
}

} // namespace

std::vector<ApplicationOptions> optionsByApplication(const Applications &applications,
                                                     const RunOptions &options) {
  std::vector<ApplicationOptions> result(applications.size());
  for (std::string path : options.print) {
    const size_t owner = ownerOf(applications, path);
    result[owner].print.push_back(std::move(path));
  }
  size_t traced = 0;
  for (std::string path : options.trace) {
    const size_t owner = ownerOf(applications, path);
    traced += result[owner].trace.empty() ? 1U : 0U;
    result[owner].trace.push_back(std::move(path));
  }
  const std::filesystem::path out(options.out);
  if (traced > 1 && (options.out.empty() || options.out == "-"))
    throw app::Error("--trace names variables of several applications, which have rows of their "
                     "own: give a file with --out, of which each gets its own");
  for (size_t i = 0; i < applications.size(); ++i)
    result[i].out =
        traced < 2
            ? options.out
            : (out.parent_path() / fmt::format("{}.{}{}", out.stem().string(),
                                               applications[i]->name(), out.extension().string()))
                  .string();
  for (const std::string &text : options.scripts) {
    const size_t equals = text.find('=');
    const std::optional<size_t> named =
        equals == std::string::npos ? std::nullopt : find(applications, text.substr(0, equals));
    std::string &script = result[named.value_or(0)].script;
    if (!script.empty())
      throw app::Error(
          fmt::format("--script '{}': the application '{}' has the script '{}' "
                      "already; write NAME=FILE for the script of the application NAME",
                      text, applications[named.value_or(0)]->name(), script));
    script = named ? text.substr(equals + 1) : text;
  }
  return result;
}

} // namespace stride::host
