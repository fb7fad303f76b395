// Any bytes as what the user has on disk: one source or several files, through check, fmt and code
// generation, errors or not.
#include "tests/fuzz/commands.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                              ("stride-project-fuzz-" + std::to_string(::getpid()));
  stride::fuzz::runCommands({reinterpret_cast<const char *>(data), size}, folder);
  return 0;
}
