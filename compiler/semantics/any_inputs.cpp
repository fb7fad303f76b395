#include "compiler/semantics/any_inputs.hpp"

#include <algorithm>
#include <iterator>

namespace stc {

namespace {

struct GroupName {
  std::string_view lower;
  AnyGroup group;
};

constexpr GroupName kGroups[] = {
    {"any", AnyGroup::Any},           {"any_elementary", AnyGroup::Elementary},
    {"any_num", AnyGroup::Num},       {"any_magnitude", AnyGroup::Magnitude},
    {"any_real", AnyGroup::Real},     {"any_int", AnyGroup::Int},
    {"any_signed", AnyGroup::Signed}, {"any_unsigned", AnyGroup::Unsigned},
    {"any_bit", AnyGroup::Bit},       {"any_string", AnyGroup::Text},
    {"any_date", AnyGroup::Date}};

struct ClassOf {
  TypeKind kind;
  uint32_t number;
};

constexpr ClassOf kClasses[] = {
    {TypeKind::Boolean, 0},  {TypeKind::Byte, 2},      {TypeKind::Word, 3},
    {TypeKind::Dword, 4},    {TypeKind::Lword, 5},     {TypeKind::Sint, 6},
    {TypeKind::Int, 7},      {TypeKind::Dint, 8},      {TypeKind::Lint, 9},
    {TypeKind::Usint, 10},   {TypeKind::Uint, 11},     {TypeKind::Udint, 12},
    {TypeKind::Ulint, 13},   {TypeKind::Real, 14},     {TypeKind::Lreal, 15},
    {TypeKind::String, 16},  {TypeKind::Wstring, 17},  {TypeKind::Time, 18},
    {TypeKind::Date, 19},    {TypeKind::Dt, 20},       {TypeKind::Tod, 21},
    {TypeKind::Pointer, 22}, {TypeKind::Subrange, 24}, {TypeKind::Enumeration, 25},
    {TypeKind::Array, 26},   {TypeKind::Ltime, 37},    {TypeKind::Ldate, 46},
    {TypeKind::Ldt, 47},     {TypeKind::Ltod, 48}};

constexpr uint32_t kUserDefined = 28;

} // namespace

AnyGroup findAnyGroup(std::string_view lowerName) {
  const auto *const at = std::find_if(std::begin(kGroups), std::end(kGroups),
                                      [&](const GroupName &one) { return one.lower == lowerName; });
  return at == std::end(kGroups) ? AnyGroup::None : at->group;
}

bool isInGroup(AnyGroup group, const Type *type) {
  const Type *t = underlying(type);
  const bool isNumeric = (isInteger(t) && !isBitString(t)) || isReal(t);
  switch (group) {
  case AnyGroup::None:
    return false;
  case AnyGroup::Any:
    return true;
  case AnyGroup::Elementary:
    return isElementary(t);
  case AnyGroup::Magnitude:
    return isNumeric || isDuration(t);
  case AnyGroup::Num:
    return isNumeric;
  case AnyGroup::Real:
    return isReal(t);
  case AnyGroup::Int:
    return isInteger(t) && !isBitString(t);
  case AnyGroup::Signed:
    return isSignedInteger(t);
  case AnyGroup::Unsigned:
    return isUnsignedInteger(t);
  case AnyGroup::Bit:
    return isBitString(t) || t->kind == TypeKind::Boolean;
  case AnyGroup::Text:
    return isString(t);
  case AnyGroup::Date:
    return isTimeOrDate(t) && !isDuration(t);
  }
  return false;
}

uint32_t typeClassOf(const Type *type) {
  const auto *const at = std::find_if(std::begin(kClasses), std::end(kClasses),
                                      [&](const ClassOf &one) { return one.kind == type->kind; });
  return at == std::end(kClasses) ? kUserDefined : at->number;
}

} // namespace stc
