#ifndef STRIDE_COMPILER_PROJECT_LIBRARY_CONFIG_HPP
#define STRIDE_COMPILER_PROJECT_LIBRARY_CONFIG_HPP
// What stride.toml says of libraries: [library] of one, [[library]] of what a project uses.

#include "compiler/source/diagnostic.hpp"
#include "compiler/toml/schema.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

/// `1.2.3`: one to four numbers; those that are not written are 0.
using Version = std::array<uint32_t, 4>;

[[nodiscard]] std::optional<Version> parseVersion(std::string_view text);
/// Whether a version is what somebody wants: `1.2` is 1.2 or later, as long as the first number
/// that is not 0 stays; `=1.2.3` is that one; empty and `*`: any. The request is a valid one.
[[nodiscard]] bool fits(const Version &version, std::string_view request);

/// [library]
struct LibraryInfo {
  ConfigName name;
  ConfigName version; ///< as it is written
  Version number{};
  ConfigName nameSpace; ///< its own, or the name
  std::string title;
  std::string description;
  std::string company;
  std::string license;
  bool qualifiedOnly = false;
};

/// A value of `parameters`.
struct LibraryValue {
  std::string list; ///< empty: the list is not said
  ConfigName name;
  std::string text; ///< ST
  Span span;
  bool isText = false; ///< it stands in quotation marks
};

/// [[library]]
struct LibraryUse {
  ConfigName name;
  ConfigName path;      ///< empty: the library is installed
  ConfigName version;   ///< see fits()
  ConfigName nameSpace; ///< how it is called here; empty: as it calls itself
  Span section;
  std::vector<LibraryValue> parameters;
};

/// What the library's documentation begins with: its title and version, whose it is, what it does.
[[nodiscard]] std::string about(const LibraryInfo &info);

/// Wrong values have been reported and are left out.
[[nodiscard]] LibraryInfo readLibraryInfo(const CheckedSection &section, Diagnostics &diagnostics);
[[nodiscard]] LibraryUse readLibraryUse(const CheckedSection &section, Diagnostics &diagnostics);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_LIBRARY_CONFIG_HPP
