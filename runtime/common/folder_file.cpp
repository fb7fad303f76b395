#include "runtime/common/folder_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace stride::common {

std::optional<std::string> textOfFile(const std::string &folder, const std::string &name) {
  namespace fs = std::filesystem;
  constexpr uintmax_t kMostBytes = uintmax_t{1} << 20U;
  std::error_code error;
  const fs::path root = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  const fs::path path = fs::weakly_canonical(root / name, error);
  const auto parted = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
  if (error || parted.first != root.end() || !fs::is_regular_file(path, error) ||
      fs::file_size(path, error) > kMostBytes)
    return std::nullopt;
  const std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return file ? std::optional(text.str()) : std::nullopt;
}

} // namespace stride::common
