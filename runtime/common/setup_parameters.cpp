#include "runtime/common/setup_parameters.hpp"

namespace stride::common {

namespace {

const Parameter *findIn(std::span<const Parameter> rows, std::string_view name) {
  for (const Parameter &row : rows)
    if (row.name == name)
      return &row;
  return nullptr;
}

} // namespace

const Parameter *SectionRows::find(std::string_view name) const {
  if (const size_t dot = name.find('.'); dot != std::string_view::npos) {
    for (const ParameterTable &table : tables)
      if (table.name == name.substr(0, dot))
        return findIn(table.parameters, name.substr(dot + 1));
    return nullptr;
  }
  const Parameter *row = findIn(own, name);
  return row != nullptr ? row : findIn(general, name);
}

const SetupParameter *SetupParameters::find(std::string_view name) const {
  for (const SetupParameter &parameter : list_)
    if (parameter.name == name)
      return &parameter;
  return nullptr;
}

double SetupParameters::number(std::string_view name) const {
  if (const SetupParameter *given = find(name))
    return given->number;
  const Parameter *row = rows_.find(name);
  if (row == nullptr)
    return 0;
  return row->otherwise.computed != nullptr ? row->otherwise.computed(*this)
                                            : row->otherwise.number;
}

std::string SetupParameters::text(std::string_view name) const {
  if (const SetupParameter *given = find(name))
    return given->text;
  const Parameter *row = rows_.find(name);
  if (row == nullptr)
    return {};
  for (const Choice &choice : row->choices)
    if (row->otherwise.any && static_cast<double>(choice.value) == row->otherwise.number)
      return std::string(choice.name);
  return row->otherwise.computed != nullptr ? std::string() : std::string(row->otherwise.text);
}

} // namespace stride::common
