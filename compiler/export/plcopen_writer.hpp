#ifndef STRIDE_COMPILER_EXPORT_PLCOPEN_WRITER_HPP
#define STRIDE_COMPILER_EXPORT_PLCOPEN_WRITER_HPP
// A project as PLCopen XML (TC6 2.01), with what CODESYS adds to it for methods, properties and the
// like.

#include "compiler/project/project.hpp"

#include <string>
#include <vector>

namespace stc::exporting {

/// The namespace: TC6 2.01, or 2.0 as CODESYS writes it. Nothing else differs.
enum class PlcOpenVersion { V200, V201 };

struct PlcOpenOptions {
  PlcOpenVersion version = PlcOpenVersion::V201;
  std::string date; ///< xsd:dateTime of the export
};

struct PlcOpenFile {
  std::string xml;
  std::vector<std::string> notes; ///< what other tools do not get, a sentence each
};

/// `project` has been checked, without errors. What stands in stride.toml beside the tasks (axes,
/// buses, cams, libraries) is not part of the format.
[[nodiscard]] PlcOpenFile plcOpenFile(const Project &project, const PlcOpenOptions &options);

} // namespace stc::exporting

#endif // STRIDE_COMPILER_EXPORT_PLCOPEN_WRITER_HPP
