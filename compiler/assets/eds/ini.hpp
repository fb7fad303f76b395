// Files of sections with keys and values, as people and tools write them.
#ifndef STRIDE_COMPILER_ASSETS_EDS_INI_HPP
#define STRIDE_COMPILER_ASSETS_EDS_INI_HPP

#include "compiler/assets/eds/device.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace stc::eds {

struct IniValue {
  std::string text; ///< In UTF-8, without blanks around it.
  size_t line = 0;
};

/// Names of sections and keys are in lower case.
struct IniSection {
  std::string name;
  size_t line = 0;
  std::map<std::string, IniValue, std::less<>> keys;

  [[nodiscard]] const IniValue *find(std::string_view key) const;
};

/// Sections in their order. A section or a key that stands twice is noted; of keys the first one
/// counts.
std::vector<IniSection> readIni(std::string_view text, Device &notes);

/// Without blanks around it.
std::string_view trimmed(std::string_view text);

/// Bytes that are no UTF-8 are taken for Latin-1.
std::string inUtf8(std::string_view bytes);

} // namespace stc::eds

#endif
