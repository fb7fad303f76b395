// Any bytes as an export of CoDeSys V2.3: what is made of them lies inside the project's folder,
// the words of sources that are taken stay what they were, and the report names every object.
#include "compiler/import/encoding.hpp"
#include "compiler/import/exp_reader.hpp"
#include "compiler/import/finish.hpp"
#include "compiler/import/project_files.hpp"
#include "compiler/import/report.hpp"
#include "compiler/import/st_words.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

namespace {

namespace import = stc::import;

void require(bool good) {
  if (!good)
    std::abort();
}

bool staysInside(const std::string &path) {
  const std::filesystem::path file(path);
  if (path.empty() || file.is_absolute() || path.find('\0') != std::string::npos)
    return false;
  for (const std::filesystem::path &part : file)
    if (part == ".." || part == "." || part.empty() || part.string().size() > 255)
      return false;
  return true;
}

std::string lowerOf(std::string text) {
  for (char &c : text)
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

void checkFiles(const import::Model &model, const import::ProjectSettings &settings) {
  const std::vector<import::ProjectFile> files = import::projectFiles(model, settings);
  require(files.size() >= model.objects.size() + 1);
  std::set<std::string> paths;
  for (const import::ProjectFile &file : files) {
    require(staysInside(file.path));
    require(paths.insert(lowerOf(file.path)).second);
    require(import::validUtf8(file.text) == file.text.size());
  }
  const std::string report = import::reportOf(model, settings, files, {});
  for (const import::ProjectFile &file : files)
    require(file.path == "stride.toml" || file.path == "Inputs_Outputs.st" ||
            report.find(file.path) != std::string::npos || !model.channels.empty());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string bytes(reinterpret_cast<const char *>(data), size);
  const import::DecodedText text = import::decoded(bytes, "");
  if (!text.problem.empty())
    return 0;
  require(import::validUtf8(text.text) == text.text.size());
  import::Model model;
  import::readExp("a.EXP", text.text, model);
  import::readExp("b.EXP", text.text, model); // everything is there twice
  for (const import::Object &object : model.objects)
    for (const import::StWord &word : import::wordsOf(object.text))
      require(word.begin < word.end && word.end <= object.text.size());
  import::FinishSettings settings;
  settings.library = (size & 1U) != 0;
  settings.addressing = (size & 2U) != 0 ? "bytes" : "";
  settings.own = {[](std::string_view name) { return name.size() % 2 == 0; },
                  [](std::string_view name) { return name.size() % 3 == 0; }};
  require(import::finish(model, settings).empty());
  checkFiles(model, {"Line", settings.library});
  return 0;
}
