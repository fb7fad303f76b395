#ifndef STRIDE_COMPILER_IMPORT_REPORT_HPP
#define STRIDE_COMPILER_IMPORT_REPORT_HPP
// import-report.md: what was converted, changed, left out, and what is to be done.

#include "compiler/import/model.hpp"
#include "compiler/import/project_files.hpp"

#include <string>
#include <vector>

namespace stc::import {

inline constexpr const char *kReportFile = "import-report.md";

/// How often the check of the result reports a diagnostic.
struct CheckCount {
  std::string code;  ///< `SE0301`
  std::string title; ///< what the code means
  size_t errors = 0;
  size_t warnings = 0;
  std::vector<std::string> places; ///< the first few: `Motion/Main.st:3:1: message`
};

/// The report, in Markdown. `files`: those of projectFiles(model, settings).
[[nodiscard]] std::string reportOf(const Model &model, const ProjectSettings &settings,
                                   const std::vector<ProjectFile> &files,
                                   const std::vector<CheckCount> &checked);

/// How many things the report asks the user to look at.
[[nodiscard]] size_t toLookAt(const Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_REPORT_HPP
