#include "runtime/app/units.hpp"

#include "runtime/common/quantity.hpp"
#include "runtime/common/text.hpp"

namespace stride::app {

std::string unitOf(const StrideAppV1 &app, std::string_view path) {
  const size_t dot = path.find('.');
  if (dot == std::string_view::npos)
    return {};
  const std::string name = common::lowerCase(path.substr(0, dot));
  for (uint32_t i = 0; i < app.driveCount; ++i) {
    const DriveDesc &drive = app.drives[i];
    if (common::lowerCase(drive.name) != name)
      continue;
    for (uint32_t p = 0; p < drive.parameterCount; ++p)
      if (const ParameterDesc &parameter = app.parameters[drive.firstParameter + p];
          std::string_view(parameter.name) == "unit" && parameter.text != nullptr)
        if (const common::QuantityRule *rule = common::findQuantity(path))
          return common::inUnit(rule->unit, parameter.text);
  }
  return {};
}

} // namespace stride::app
