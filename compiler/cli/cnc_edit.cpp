#include "compiler/cli/cnc_edit.hpp"

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/source/sources.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace stc::cli {

namespace {

/// Puts the edited program where the command says. A file that is there is replaced only if the
/// command names it.
void putEdited(const std::string &path, const std::string &text, bool changed,
               const CncOptions &options, Diagnostics &diagnostics) {
  if (!options.inPlace && options.out.empty()) {
    print(text);
    return;
  }
  const std::string &out = options.inPlace ? path : options.out;
  if (std::error_code unknown;
      !options.inPlace && std::filesystem::equivalent(path, out, unknown)) {
    diagnostics
        .report(Code::CannotWrite, {},
                fmt::format("`{}` is the program: it is not overwritten", out))
        .help("say --in-place if it shall be");
    return;
  }
  if (options.inPlace && !changed)
    return;
  if (!writeFile(out, text))
    diagnostics.report(Code::CannotWrite, {},
                       fmt::format("`{}` cannot be written: {}", out, lastError()));
}

} // namespace

int editCnc(const CncOptions &options) {
  const std::string &path = options.files.front();
  Sources sources;
  Diagnostics diagnostics;
  const std::optional<FileId> id = sources.load(path, path, kMaxCncBytes);
  if (!id) {
    diagnostics.report(Code::UnreadableFile, {},
                       fmt::format("`{}` cannot be read: {}", path, readSourceError(kMaxCncBytes)));
  } else if (const auto edited = numberCnc(sources.file(*id), options.numbering, diagnostics)) {
    putEdited(path, *edited, *edited != sources.file(*id).text(), options, diagnostics);
  }
  diagnostics.sort();
  return show(diagnostics.all(), sources, options.output);
}

} // namespace stc::cli
