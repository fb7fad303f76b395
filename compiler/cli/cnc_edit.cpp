#include "compiler/cli/cnc_edit.hpp"

#include "compiler/assets/cnc/cnc_source.hpp"
#include "compiler/assets/cnc_edit/reverse.hpp"
#include "compiler/assets/cnc_edit/transform.hpp"
#include "compiler/cli/cnc_project.hpp"
#include "compiler/project/file_system.hpp"
#include "compiler/source/sources.hpp"

#include <algorithm>
#include <bit>
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

CncTransform transformOf(const CncOptions &options) {
  const CncMoveOptions &move = options.move;
  if (options.action == CncAction::Rotate)
    return cncRotation(move.angle, move.places);
  if (options.action == CncAction::Scale)
    return cncScale(move.factor, move.places);
  if (options.action == CncAction::Shift)
    return cncShift(move.places);
  const int axis = std::countr_zero(move.axes);
  return cncReflection(axis, move.places[axis]);
}

CncStart startOf(const CncOptions &options) {
  CncStart start;
  std::copy(std::begin(options.move.places), std::end(options.move.places),
            std::begin(start.position.coordinate));
  start.position.axes = options.move.axes;
  start.softMotion3 = projectSettings(options.files.front(), options.softMotion).softMotion3;
  return start;
}

std::optional<std::string> edited(const SourceFile &file, const CncOptions &options,
                                  Diagnostics &diagnostics) {
  switch (options.action) {
  case CncAction::Number:
    return numberCnc(file, options.numbering, diagnostics);
  case CncAction::Reverse:
    return reverseCnc(file, startOf(options), diagnostics);
  case CncAction::Split:
    return splitCnc(file, options.split, diagnostics);
  case CncAction::Expand:
    return expandCnc(file, options.expansion, diagnostics);
  default:
    return transformCnc(file, transformOf(options), diagnostics);
  }
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
  } else if (const auto text = edited(sources.file(*id), options, diagnostics)) {
    putEdited(path, *text, *text != sources.file(*id).text(), options, diagnostics);
  }
  diagnostics.sort();
  return show(diagnostics.all(), sources, options.output);
}

} // namespace stc::cli
