#ifndef STRIDE_COMPILER_CLI_CNC_DRAWING_HPP
#define STRIDE_COMPILER_CLI_CNC_DRAWING_HPP
// stride cnc import-dxf, export-dxf

#include "compiler/cli/commands.hpp"

namespace stc::cli {

/// Makes programs of a drawing, and writes them into a folder.
int importDrawing(const CncOptions &options);

/// Writes the drawing of the program in the file `path`.
void exportDrawing(const std::string &path, const CncProgram &program, const CncOptions &options,
                   Diagnostics &diagnostics);

} // namespace stc::cli

#endif // STRIDE_COMPILER_CLI_CNC_DRAWING_HPP
