#include "compiler/project/format_project.hpp"

#include "compiler/project/config_reader.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/project/source_files.hpp"
#include "compiler/source/read_source.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace stc {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF";

/// The characters of UTF-8 text as bytes of Latin-1, from which the text was read.
std::string toLatin1(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x80 || i + 1 == text.size()) {
      out += text[i];
    } else {
      const auto next = static_cast<unsigned char>(text[++i]);
      out += static_cast<char>(((byte & 0x03U) << 6U) | (next & 0x3FU));
    }
  }
  return out;
}

/// What there is to format in a file.
struct Formattable {
  bool wellFormed; ///< free of syntax errors; an `{error …}` is none
  bool otherText;  ///< the lines of instruction lists and charts must stay as they are
};

Formattable formattable(const SourceFile &source, const ParseOptions &options) {
  Interner interner;
  Arena arena;
  Diagnostics found;
  const ast::File *file = parse(source, interner, arena, found, &options);
  const bool wellFormed =
      std::none_of(found.all().begin(), found.all().end(), [](const Diagnostic &diagnostic) {
        return diagnostic.severity == Severity::Error && diagnostic.code != Code::ErrorPragma;
      });
  return {wellFormed, file->hasInstructions || file->hasChart};
}

} // namespace

FormatSettings readFormatSettings(const fs::path &place, Sources &sources,
                                  Diagnostics &diagnostics) {
  FormatSettings settings;
  std::error_code error;
  fs::path folder = fs::absolute(place.empty() ? fs::path(".") : place, error).lexically_normal();
  if (!fs::is_directory(folder, error))
    folder = folder.parent_path();
  folder = findProjectFolder(folder);
  const fs::path manifest = folder / "stride.toml";
  if (!fs::exists(manifest, error))
    return settings;
  const std::optional<FileId> id = sources.load(manifest, manifest.filename().string());
  if (!id) {
    diagnostics.report(
        Code::UnreadableFile, {},
        fmt::format("`{}` cannot be read: {}", manifest.string(), readSourceError()));
    return settings;
  }
  const std::unique_ptr<TomlNode> document = parseToml(sources.file(*id), diagnostics);
  if (document == nullptr)
    return settings;
  Diagnostics ignored; // what else is wrong with the project does not matter here
  const ProjectConfig config = readConfig(sources.file(*id), ignored);
  settings.defines = config.defines;
  settings.folder = folder;
  settings.sources = config.sources;
  const TomlNode *table = document->find("fmt");
  if (table == nullptr || table->kind != TomlKind::Table)
    return settings;
  const CheckedSection section(*table, formatSchema(), diagnostics, &projectSchema());
  FormatStyle &style = settings.style;
  style.width = static_cast<unsigned>(section.integer("width", style.width));
  style.indent = static_cast<unsigned>(section.integer("indent", style.indent));
  style.tabs = section.boolean("tabs", style.tabs);
  style.align = section.boolean("align", style.align);
  style.keywords =
      static_cast<KeywordCase>(section.choice("keywords", static_cast<int64_t>(style.keywords)));
  return settings;
}

void formatFiles(std::vector<FormattedFile> &files, const FormatSettings &settings,
                 Sources &sources, Diagnostics &diagnostics) {
  std::vector<FileId> ids;
  for (const FormattedFile &file : files)
    ids.push_back(sources.addBytes(file.name, file.before));
  DeclaredNames names(sources, ids);
  const ParseOptions options{settings.defines, &names};
  for (size_t i = 0; i < files.size(); ++i) {
    FormattedFile &file = files[i];
    file.after = file.before;
    const SourceFile &source = sources.file(ids[i]);
    const Formattable what = formattable(source, options);
    if (!what.wellFormed) {
      Interner interner;
      Arena arena;
      parse(source, interner, arena, diagnostics, &options);
      continue;
    }
    if (what.otherText)
      continue;
    std::optional<std::string> text = format(source, settings.style);
    if (!text)
      throw std::logic_error(fmt::format("formatting `{}` would change what it says", file.name));
    const bool mark = file.before.starts_with(kMark);
    const bool latin1 = source.text() != std::string_view(file.before).substr(mark ? 3 : 0);
    file.after = (mark ? std::string(kMark) : std::string()) + (latin1 ? toLatin1(*text) : *text);
  }
}

/// The sources of a project, or all that lie in a folder.
static std::vector<fs::path> sourcesBelow(const fs::path &folder, const FormatSettings &settings,
                                          const Sources &sources, Diagnostics &diagnostics) {
  std::error_code error;
  std::vector<fs::path> roots{folder};
  if (!settings.sources.empty() && fs::equivalent(folder, settings.folder, error)) {
    roots.clear();
    findRoots(folder, settings.sources, sources, diagnostics, roots);
    std::erase_if(roots, [&](const fs::path &root) { // they belong to others, too
      const fs::path relative = root.lexically_relative(folder.lexically_normal());
      return relative.empty() || *relative.begin() == "..";
    });
  }
  const FoundFiles found = findSources(sources, roots);
  if (reportUnfound(found, folder, diagnostics) && found.files.empty())
    diagnostics.report(Code::NoSources, {},
                       fmt::format("there are no `.st` files in `{}`", folder.string()));
  return found.files;
}

std::vector<FormattedFile> formatPath(const fs::path &path, Sources &sources,
                                      Diagnostics &diagnostics) {
  std::vector<FormattedFile> files;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    diagnostics.report(Code::PathNotFound, {},
                       fmt::format("there is no file or folder `{}`", path.string()));
    return files;
  }
  const FormatSettings settings = readFormatSettings(path, sources, diagnostics);
  std::vector<fs::path> paths{path};
  if (fs::is_directory(status))
    paths = sourcesBelow(path, settings, sources, diagnostics);
  if (diagnostics.hasErrors())
    return files;
  for (const fs::path &one : paths) {
    std::optional<std::string> bytes = sources.read(one);
    if (!bytes) {
      diagnostics.report(Code::UnreadableFile, {},
                         fmt::format("`{}` cannot be read: {}", one.string(), readSourceError()));
      continue;
    }
    const std::string name = one.lexically_normal().string();
    files.push_back(
        {one, name, fs::is_directory(status) && leadsOut(path, one), std::move(*bytes), {}});
  }
  formatFiles(files, settings, sources, diagnostics);
  return files;
}

} // namespace stc
