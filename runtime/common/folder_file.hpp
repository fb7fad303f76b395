// Small files in a folder that no name leads out of.
#ifndef STRIDE_RUNTIME_COMMON_FOLDER_FILE_HPP
#define STRIDE_RUNTIME_COMMON_FOLDER_FILE_HPP

#include <optional>
#include <string>

namespace stride::common {

/// The text of a file of up to 1 MiB in that folder ("": the current one), which no name and no
/// link leads out of; nothing: it is not there, is none, or cannot be read.
std::optional<std::string> textOfFile(const std::string &folder, const std::string &name);

} // namespace stride::common

#endif
