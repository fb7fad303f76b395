#include "compiler/semantics/type_table.hpp"

#include <array>
#include <limits>
#include <unordered_map>

namespace stc {

namespace {

constexpr size_t kKinds = static_cast<size_t>(TypeKind::AnyReal) + 1;

struct ElementaryTypes {
  std::array<Type, kKinds> plain{};
  StringType string{{TypeKind::String}, 80};
  StringType wstring{{TypeKind::Wstring}, 80};
  constexpr ElementaryTypes() {
    for (size_t i = 0; i < kKinds; ++i)
      plain[i].kind = static_cast<TypeKind>(i);
  }
};

constexpr ElementaryTypes kElementary;

} // namespace

const Type *elementaryType(TypeKind kind) {
  if (kind == TypeKind::String)
    return &kElementary.string;
  if (kind == TypeKind::Wstring)
    return &kElementary.wstring;
  return &kElementary.plain[static_cast<size_t>(kind)];
}

const Type *findElementaryType(std::string_view lowerName) {
  using enum TypeKind;
  static const std::unordered_map<std::string_view, TypeKind> kNames = {
      {"bool", Boolean},     {"sint", Sint},         {"int", Int},
      {"dint", Dint},        {"lint", Lint},         {"usint", Usint},
      {"uint", Uint},        {"udint", Udint},       {"ulint", Ulint},
      {"byte", Byte},        {"word", Word},         {"dword", Dword},
      {"lword", Lword},      {"real", Real},         {"lreal", Lreal},
      {"time", Time},        {"ltime", Ltime},       {"date", Date},
      {"ldate", Ldate},      {"tod", Tod},           {"time_of_day", Tod},
      {"ltod", Ltod},        {"ltime_of_day", Ltod}, {"dt", Dt},
      {"date_and_time", Dt}, {"ldt", Ldt},           {"ldate_and_time", Ldt},
      {"string", String},    {"wstring", Wstring},   {"char", Char},
      {"wchar", Wchar},      {"__xword", Lword},     {"__xint", Lint},
      {"__uxint", Ulint},
  };
  const auto it = kNames.find(lowerName);
  return it == kNames.end() ? nullptr : elementaryType(it->second);
}

IntegerRange integerRange(const Type *t) {
  if (t->kind == TypeKind::Subrange)
    return {typeAs<SubrangeType>(t)->low, typeAs<SubrangeType>(t)->high};
  const Type *u = underlying(t);
  if (u->kind == TypeKind::Boolean)
    return {0, 1};
  const unsigned width = bitWidth(u);
  if (isSignedInteger(u)) {
    const auto high = std::numeric_limits<int64_t>::max() >> (64 - width);
    return {-high - 1, high};
  }
  return {0, width == 64 ? -1 : (int64_t{1} << width) - 1};
}

const Type *TypeTable::string(bool wide, uint32_t length) {
  const TypeKind kind = wide ? TypeKind::Wstring : TypeKind::String;
  if (length == 80)
    return elementaryType(kind);
  auto &slot = strings_[{wide, length}];
  if (slot == nullptr)
    slot = arena_.make<StringType>(Type{kind}, length);
  return slot;
}

const Type *TypeTable::array(const Type *element, int64_t low, int64_t high) {
  auto &slot = arrays_[{element, low, high}];
  if (slot == nullptr)
    slot = arena_.make<ArrayType>(Type{TypeKind::Array}, element, low, high);
  return slot;
}

const Type *TypeTable::openArray(const Type *element, uint32_t dimensions) {
  const Type *rest = dimensions == 1 ? element : openArray(element, dimensions - 1);
  auto &slot = openArrays_[{element, dimensions}];
  if (slot == nullptr)
    slot = arena_.make<OpenArrayType>(Type{TypeKind::OpenArray}, element, dimensions, rest);
  return slot;
}

const Type *TypeTable::pointer(const Type *pointee) {
  auto &slot = pointers_[pointee];
  if (slot == nullptr)
    slot = arena_.make<PointerType>(Type{TypeKind::Pointer}, pointee);
  return slot;
}

const Type *TypeTable::reference(const Type *pointee) {
  auto &slot = references_[pointee];
  if (slot == nullptr)
    slot = arena_.make<PointerType>(Type{TypeKind::Reference}, pointee);
  return slot;
}

const Type *TypeTable::subrange(const Type *base, int64_t low, int64_t high) {
  auto &slot = subranges_[{base, low, high}];
  if (slot == nullptr)
    slot = arena_.make<SubrangeType>(Type{TypeKind::Subrange}, base, low, high);
  return slot;
}

} // namespace stc
