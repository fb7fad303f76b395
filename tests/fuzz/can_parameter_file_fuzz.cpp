// Any bytes as a file with parameters of a drive: what is read is written as such a file, in both
// formats, and read again as the same.
#include "drivers/can/plan/drive_settings.hpp"
#include "drivers/can/plan/parameter_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

using namespace stride::can;

void expectSame(const std::vector<SdoWrite> &writes, const std::string &text) {
  const ParameterFile again = readParameterFile(text);
  if (!again.error.empty() || again.writes.size() != writes.size())
    std::abort();
  for (size_t i = 0; i < writes.size(); ++i)
    if (again.writes[i].object != writes[i].object || again.writes[i].value != writes[i].value ||
        again.writes[i].size != writes[i].size)
      std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const ParameterFile file =
      readParameterFile(std::string_view(reinterpret_cast<const char *>(data), size));
  std::string text = "drive;1\n";
  std::string xml = "<DriveParameters DriveId=\"1\">\n";
  for (const SdoWrite &write : file.writes) {
    if (!ownerOf(write.object).empty())
      std::abort(); // nobody else's objects are written
    const std::string number = std::to_string(write.object.index * 256 + write.object.sub);
    // A value with a sign is one that an object without a sign cannot have.
    const bool isSigned =
        write.size == 0 ? false
                        : static_cast<int32_t>(write.value) < 0 && formOf(write.object).isSigned;
    const std::string value =
        isSigned ? std::to_string(static_cast<int32_t>(write.value)) : std::to_string(write.value);
    text += number + ";" + value + ";;\n";
    xml += "<Parameter Number=\"" + number + "\">" + value + "</Parameter>\n";
  }
  expectSame(file.writes, text);
  expectSame(file.writes, xml + "</DriveParameters>\n");
  return 0;
}
