// stride-libgen OUT: writes the C++ of the standard library below OUT: headers
// `st/<Library>/<Name>.h`, the bodies that are written in ST, and one source `<Library>.cpp` per
// library that includes its bodies; and the table of the axis parameters. Runs when Stride is
// built; files that would not change are left alone, those of sources that are gone are removed:
// else an include of them would be found until somebody builds in an empty folder.

#include "compiler/codegen/codegen.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/library_index.hpp"
#include "compiler/project/tools/axis_parameters.hpp"
#include "compiler/source/content_hash.hpp"
#include "compiler/source/render.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <set>
#include <vector>

namespace fs = std::filesystem;

namespace {

class LibraryGenerator {
public:
  explicit LibraryGenerator(fs::path out) : out_(std::move(out)) {}

  bool generate(std::string_view name) {
    stc::Program program;
    stc::checkLibrary(program, name, index_);
    stc::Diagnostics sorted = program.diagnostics;
    sorted.sort();
    for (const stc::Diagnostic &diagnostic : sorted.all())
      std::fputs(renderText(diagnostic, program.sources).c_str(), stderr);
    if (program.diagnostics.hasErrors())
      return false;
    const auto library =
        std::find_if(program.libraries.begin(), program.libraries.end(),
                     [&](const auto &candidate) { return candidate->name == name; });
    if (library == program.libraries.end()) {
      std::fprintf(stderr, "stride-libgen: nothing found of %s\n", std::string(name).c_str());
      return false;
    }
    std::string unity;
    stc::ContentHash contents;
    std::set<std::string> headers;
    for (const stc::GeneratedFile &file : generateLibrary(program, **library)) {
      if (!write(file.path, file.text))
        return false;
      contents.add(file.text);
      if (file.path.ends_with(".cpp"))
        unity += fmt::format("#include \"{}\"\n", file.path);
      else
        headers.insert(file.path);
    }
    if (!writeAxisParameters(**library))
      return false;
    // The build system counts on a header per source file.
    for (const stc::LibraryIndex::Entry &entry : index_.files(name)) {
      const std::string stem = fs::path(entry.fileName).stem().string();
      const std::string header = fmt::format("st/{}/{}.h", name, stem);
      if (!headers.contains(header) &&
          !write(header,
                 fmt::format("// {} declares nothing that needs a header of this name.\n", stem)))
        return false;
    }
    // The build system compiles this file anew only when it has changed itself: the hash stands for
    // all it includes.
    return write(fmt::format("{}.cpp", name),
                 fmt::format("// The bodies of {} that are written in ST: {}\n{}", name,
                             contents.hex(), unity));
  }

  bool all() {
    bool good = true;
    for (const std::string_view library : index_.libraries())
      good = generate(library) && good;
    return good && removeLeftovers();
  }

private:
  bool writeAxisParameters(const stc::Library &library) {
    const stc::TypeSymbol *axisRef = findAxisRef(library);
    if (axisRef == nullptr)
      return true;
    std::string error;
    const std::string table = axisParameterTable(*axisRef, error);
    if (!error.empty()) {
      std::fprintf(stderr, "stride-libgen: %s\n", error.c_str());
      return false;
    }
    return write("st/SM_DriveBasic/AXIS_REF_parameters.h", table);
  }

  // Removes what an earlier run has written into the folders of this one and this one has not.
  bool removeLeftovers() {
    std::set<std::string> folders;
    for (const std::string &path : written_)
      if (const size_t slash = path.find('/'); slash != std::string::npos)
        folders.insert(path.substr(0, slash));
    std::vector<fs::path> leftovers;
    for (const std::string &folder : folders)
      for (const fs::directory_entry &entry : fs::recursive_directory_iterator(out_ / folder))
        if (entry.is_regular_file() && !written_.contains(entry.path().lexically_relative(out_)))
          leftovers.push_back(entry.path());
    for (const fs::path &path : leftovers) {
      std::error_code error;
      if (!fs::remove(path, error)) {
        std::fprintf(stderr, "stride-libgen: %s: %s\n", path.c_str(), error.message().c_str());
        return false;
      }
    }
    return true;
  }

  bool write(const std::string &path, const std::string &text) {
    written_.insert(path);
    if (stc::writeIfDifferent(out_ / path, text))
      return true;
    std::fprintf(stderr, "stride-libgen: %s: %s\n", (out_ / path).c_str(),
                 stc::lastError().c_str());
    return false;
  }

  fs::path out_;
  std::set<std::string> written_; // paths below out_
  stc::EmbeddedLibraryIndex index_{stc::standardLibrary()};
};

} // namespace

int main(int argc, char **argv) {
  if (argc != 2) {
    std::fputs("usage: stride-libgen OUT\n", stderr);
    return 2;
  }
  return LibraryGenerator(argv[1]).all() ? 0 : 1;
}
