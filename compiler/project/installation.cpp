#include "compiler/project/installation.hpp"

#include "compiler/project/file_system.hpp"

namespace stc {

namespace fs = std::filesystem;

// Lines `library NAME`, `host NAME`, `compile FLAG`, `link FLAG`, `static FLAG`.
static void readToolchain(std::string_view text, const fs::path &libraries, Installation &to) {
  while (!text.empty()) {
    const size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    const size_t space = line.find(' ');
    if (space == std::string_view::npos)
      continue;
    const std::string_view word = line.substr(0, space);
    const std::string_view value = line.substr(space + 1);
    if (word == "library")
      to.libraries.push_back(libraries / value);
    else if (word == "host")
      to.hostLibraries.push_back(libraries / value);
    else if (word == "static")
      to.staticFlags.emplace_back(value);
    else if (word == "compile")
      to.compileFlags.emplace_back(value);
    else if (word == "link")
      to.linkFlags.emplace_back(value);
  }
}

std::optional<Installation> findInstallation(std::string &missing, const std::string &target) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path folder = program.parent_path();
  struct Layout {
    fs::path root;
    fs::path libraries;
  };
  const Layout layouts[] = {{folder, folder / "lib"},
                            {folder.parent_path(), folder.parent_path() / "lib" / "stride"}};
  for (const Layout &layout : layouts) {
    const fs::path share = layout.root / "share" / "stride";
    const fs::path toolchain =
        share / (target.empty() ? "toolchain.txt" : "toolchain-" + target + ".txt");
    const std::optional<std::string> list = readFile(toolchain);
    if (!list) {
      missing = toolchain.string();
      continue;
    }
    Installation found;
    found.include = share / "include";
    found.host = folder / "stride-host";
    found.canTool = folder / "stride-can";
    found.debugScript = share / "gdb" / "stride.py";
    readToolchain(*list, layout.libraries / target, found);
    for (const fs::path &library : found.libraries)
      if (!fs::exists(library, error)) {
        missing = library.string();
        return std::nullopt;
      }
    return found;
  }
  return std::nullopt;
}

} // namespace stc
