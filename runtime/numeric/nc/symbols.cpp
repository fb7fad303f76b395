#include "runtime/numeric/nc/symbols.hpp"

namespace stride::nc {
namespace {

bool isKnown(int16_t type) noexcept {
  return (type >= 1 && type <= 6) || type == 11 || (type >= 14 && type <= 17) ||
         (type >= 22 && type <= 24);
}

} // namespace

ValueType typeOfVariable(uint8_t type) noexcept {
  if (type == kBoolVariable)
    return ValueType::Bool;
  if (type == kTextVariable)
    return ValueType::Text;
  return static_cast<cnc::VariableType>(type) == cnc::VariableType::Structure ? ValueType::Any
                                                                              : ValueType::Real;
}

int32_t findLocal(const Symbols &symbols, const Scope &scope, const ProgramLine &line,
                  const Token &name, ValueType &type) noexcept {
  int32_t at = scope.start;
  for (int32_t i = 0; i < scope.count; ++i) {
    const int32_t length = symbols.bytes[at];
    bool same = length == name.length;
    for (int32_t c = 0; same && c < length; ++c)
      same = static_cast<char>(symbols.bytes[at + 2 + c]) == upperCase(line.text[name.start + c]);
    if (same) {
      type = static_cast<ValueType>(symbols.bytes[at + 1]);
      return i;
    }
    at += 2 + length;
  }
  return -1;
}

bool addLocal(Symbols &symbols, Scope &scope, const ProgramLine &line, const Token &name,
              ValueType type) noexcept {
  if (symbols.used + 2 + name.length > kSymbolBytes)
    return false;
  uint8_t *const bytes = symbols.bytes + symbols.used;
  bytes[0] = static_cast<uint8_t>(name.length);
  bytes[1] = static_cast<uint8_t>(type);
  for (int32_t i = 0; i < name.length; ++i)
    bytes[2 + i] = static_cast<uint8_t>(upperCase(line.text[name.start + i]));
  symbols.used += 2 + name.length;
  ++scope.count;
  return true;
}

int32_t findVariable(const cnc::VariableList *list, const ProgramLine &line, const Token &name,
                     uint8_t &type) noexcept {
  if (list == nullptr || list->first == nullptr)
    return -1;
  for (int32_t i = 0; i < list->count; ++i) {
    const cnc::NamedVariable &variable = list->first[i];
    int32_t c = 0;
    while (c < name.length && variable.name[c] != 0 &&
           upperCase(variable.name[c]) == upperCase(line.text[name.start + c]))
      ++c;
    if (c != name.length || (c < kMostName && variable.name[c] != 0))
      continue;
    if (!isKnown(variable.type))
      return -1;
    type = static_cast<uint8_t>(variable.type);
    // Without an address it is one of the numbers beside it.
    return variable.address != nullptr || typeOfVariable(type) == ValueType::Real ? i : -1;
  }
  return -1;
}

} // namespace stride::nc
