#ifndef STRIDE_COMPILER_PROJECT_RUN_SOCKET_HPP
#define STRIDE_COMPILER_PROJECT_RUN_SOCKET_HPP
// Where `stride run --listen` and `stride ctl` of one project meet when nobody names a place.

#include <filesystem>
#include <optional>
#include <string>

namespace stc {

/// The folder of the project that the path names or lies in (findProjectFolder), or the path of a
/// single source file; absolute, without links. Empty when there is nothing of that name. `path`:
/// empty: the current folder.
[[nodiscard]] std::filesystem::path projectPlace(const std::filesystem::path &path);

/// The socket file for a run of the project: in the user's folder for such files, which is made,
/// and is nobody else's. Nothing when there can be none; `problem` says why.
[[nodiscard]] std::optional<std::filesystem::path> makeRunSocket(const std::filesystem::path &place,
                                                                 std::string &problem);

/// The socket file that a run of the project has made, or nothing.
[[nodiscard]] std::optional<std::filesystem::path>
findRunSocket(const std::filesystem::path &place);

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_RUN_SOCKET_HPP
