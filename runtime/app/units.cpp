#include "runtime/app/units.hpp"

#include "runtime/common/quantity.hpp"
#include "runtime/common/text.hpp"

namespace stride::app {

std::string unitOf(const StrideAppV1 &app, std::string_view path) {
  const size_t dot = path.find('.');
  if (dot == std::string_view::npos)
    return {};
  const std::string name = common::lowerCase(path.substr(0, dot));
  for (uint32_t i = 0; i < app.unitCount; ++i)
    if (const UnitDesc &unit = app.units[i]; common::lowerCase(unit.variable) == name)
      if (const common::QuantityRule *rule = common::findQuantity(path))
        return common::inUnit(rule->unit, unit.unit);
  return {};
}

} // namespace stride::app
