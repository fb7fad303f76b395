#include "compiler/semantics/type_table.hpp"

#include <array>
#include <limits>
#include <unordered_map>

namespace stc {

namespace {

constexpr std::size_t kKinds = static_cast<std::size_t>(TypeKind::anyReal) + 1;

struct ElementaryTypes {
  std::array<Type, kKinds> plain{};
  StringType string{{TypeKind::string}, 80};
  StringType wstring{{TypeKind::wstring}, 80};
  constexpr ElementaryTypes() {
    for (std::size_t i = 0; i < kKinds; ++i)
      plain[i].kind = static_cast<TypeKind>(i);
  }
};

constexpr ElementaryTypes kElementary;

} // namespace

const Type *elementaryType(TypeKind kind) {
  if (kind == TypeKind::string)
    return &kElementary.string;
  if (kind == TypeKind::wstring)
    return &kElementary.wstring;
  return &kElementary.plain[static_cast<std::size_t>(kind)];
}

const Type *findElementaryType(std::string_view lowerName) {
  using enum TypeKind;
  static const std::unordered_map<std::string_view, TypeKind> kNames = {
      {"bool", boolean},     {"sint", sint},     {"int", intT},           {"dint", dint},
      {"lint", lint},        {"usint", usint},   {"uint", uint},          {"udint", udint},
      {"ulint", ulint},      {"byte", byte},     {"word", word},          {"dword", dword},
      {"lword", lword},      {"real", real},     {"lreal", lreal},        {"time", time},
      {"ltime", ltime},      {"date", date},     {"ldate", ldate},        {"tod", tod},
      {"time_of_day", tod},  {"ltod", ltod},     {"ltime_of_day", ltod},  {"dt", dt},
      {"date_and_time", dt}, {"ldt", ldt},       {"ldate_and_time", ldt}, {"string", string},
      {"wstring", wstring},  {"char", charT},    {"wchar", wcharT},       {"__xword", lword},
      {"__xint", lint},      {"__uxint", ulint},
  };
  const auto it = kNames.find(lowerName);
  return it == kNames.end() ? nullptr : elementaryType(it->second);
}

IntegerRange integerRange(const Type *t) {
  if (t->kind == TypeKind::subrange)
    return {typeAs<SubrangeType>(t)->low, typeAs<SubrangeType>(t)->high};
  const Type *u = underlying(t);
  if (u->kind == TypeKind::boolean)
    return {0, 1};
  const unsigned width = bitWidth(u);
  if (isSignedInteger(u)) {
    const auto high = std::numeric_limits<std::int64_t>::max() >> (64 - width);
    return {-high - 1, high};
  }
  return {0, width == 64 ? -1 : (std::int64_t{1} << width) - 1};
}

const Type *TypeTable::string(bool wide, std::uint32_t length) {
  const TypeKind kind = wide ? TypeKind::wstring : TypeKind::string;
  if (length == 80)
    return elementaryType(kind);
  auto &slot = strings_[{wide, length}];
  if (slot == nullptr)
    slot = arena_.make<StringType>(Type{kind}, length);
  return slot;
}

const Type *TypeTable::array(const Type *element, std::int64_t low, std::int64_t high) {
  auto &slot = arrays_[{element, low, high}];
  if (slot == nullptr)
    slot = arena_.make<ArrayType>(Type{TypeKind::array}, element, low, high);
  return slot;
}

const Type *TypeTable::openArray(const Type *element, std::uint32_t dimensions) {
  const Type *rest = dimensions == 1 ? element : openArray(element, dimensions - 1);
  auto &slot = openArrays_[{element, dimensions}];
  if (slot == nullptr)
    slot = arena_.make<OpenArrayType>(Type{TypeKind::openArray}, element, dimensions, rest);
  return slot;
}

const Type *TypeTable::pointer(const Type *pointee) {
  auto &slot = pointers_[pointee];
  if (slot == nullptr)
    slot = arena_.make<PointerType>(Type{TypeKind::pointer}, pointee);
  return slot;
}

const Type *TypeTable::reference(const Type *pointee) {
  auto &slot = references_[pointee];
  if (slot == nullptr)
    slot = arena_.make<PointerType>(Type{TypeKind::reference}, pointee);
  return slot;
}

const Type *TypeTable::subrange(const Type *base, std::int64_t low, std::int64_t high) {
  auto &slot = subranges_[{base, low, high}];
  if (slot == nullptr)
    slot = arena_.make<SubrangeType>(Type{TypeKind::subrange}, base, low, high);
  return slot;
}

} // namespace stc
