#include "compiler/codegen/type_table.hpp"

#include "compiler/codegen/layout_numbers.hpp"
#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/type_table.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <type_traits>

namespace stc::codegen {

using namespace ast;

std::string_view renamedFrom(const Attributes &attributes) {
  return attributeValue(attributes, AttributeId::RenamedFrom);
}

namespace {

// Values of runtime/app/abi.h.
constexpr unsigned kHasAddress = 1;
constexpr unsigned kExternal = 2;
constexpr unsigned kRange = 4;
constexpr size_t kMeasures = 3; // kind, size and alignment

/// Flags of a variable as runtime/app/abi.h has them in lines of symbols: letters, and the digit
/// that belongs to the one before it.
class Flags {
public:
  Flags &add(bool set, char letter) {
    if (set)
      text_ += letter;
    return *this;
  }
  Flags &addNumber(unsigned digit) {
    text_ += static_cast<char>('0' + digit);
    return *this;
  }
  [[nodiscard]] const std::string &text() const { return text_; }

private:
  std::string text_;
};

constexpr char kBase = 'B';
constexpr char kBit = 'b';
constexpr char kConstant = 'c';
constexpr char kHidden = 'h';
constexpr char kLocated = 'l';
constexpr char kSlot = 's';
constexpr char kTypeId = 't';

Flags symbolFlags(const VarSymbol *v, bool qualifiedOnly = false) {
  const unsigned qualifiers = v->decl == nullptr ? 0U : v->decl->qualifiers;
  Flags flags;
  flags.add(v->section == Section::Input, 'i')
      .add(v->section == Section::Output, 'o')
      .add(v->section == Section::InOut, 'x')
      .add((qualifiers & kQualRetain) != 0, 'r')
      .add((qualifiers & kQualPersistent) != 0, 'p')
      .add((qualifiers & kQualNonRetain) != 0, 'N')
      .add(v->isConstant, kConstant)
      .add(v->hidden, kHidden)
      .add(v->decl != nullptr && hasAttribute(v->decl->attributes, AttributeId::InitOnOnlineChange),
           'n')
      .add(qualifiedOnly, 'q');
  return flags;
}

/// Flags, offset and type of a variable in the process image are not those of an ordinary one.
Flags locatedFlags(const Location &at, Flags flags) {
  if (at.isSlot)
    flags.add(true, kSlot).addNumber(static_cast<unsigned>(at.area));
  else
    flags.add(true, kLocated);
  flags.add(at.bit >= 0, kBit);
  if (!at.isSlot && at.bit > 0)
    flags.addNumber(static_cast<unsigned>(at.bit));
  return flags;
}

Flags locatedFlags(const VarSymbol *v, Flags flags) {
  return v->location == nullptr ? flags : locatedFlags(*v->location, std::move(flags));
}

/// `offsetof(App__, image__m) + 6`
std::string placeInImage(const Location &at) {
  return std::string("offsetof(App__, image__") + "iqm"[static_cast<unsigned>(at.area)] + ") + " +
         std::to_string(at.byte);
}

/// A line of symbols (runtime/app/abi.h) without its end, as part of a C++ string literal.
class Line {
public:
  explicit Line(char kind, std::string_view flags = {}) {
    text_ += kind;
    text_ += flags;
  }
  Line &add(std::string_view column) {
    ++empty_;
    if (column.empty())
      return *this;
    for (; empty_ != 0; --empty_)
      text_ += "\\t";
    std::string plain(column);
    // Of a name that was written by hand: such a one is none.
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; },
        '?');
    text_ += escaped(plain);
    return *this;
  }
  template <class T>
  requires std::is_integral_v<T> Line &add(T number) { return add(std::to_string(number)); }
  /// Nothing for 0.
  template <class T>
  requires std::is_integral_v<T> Line &addSome(T number, int base = 10) {
    if (number == 0)
      return add({});
    std::array<char, 64> digits;
    return add({digits.data(), std::to_chars(digits.begin(), digits.end(), number, base).ptr});
  }
  std::string text() { return std::move(text_); }

private:
  std::string text_;
  size_t empty_ = 0; ///< columns that are not written yet
};

} // namespace

uint32_t TypeTable::index(const Type *type, bool inOut) {
  const auto [it, fresh] =
      indices_.try_emplace({type, inOut}, static_cast<uint32_t>(types_.size()));
  const uint32_t at = it->second;
  if (fresh) {
    types_.emplace_back();
    pending_.push_back({at, type, inOut});
    if (pending_.size() == 1)
      fillPending();
  }
  return at;
}

/// One after the other: pointers may make long chains of types.
void TypeTable::fillPending() {
  for (size_t i = 0; i < pending_.size(); ++i) {
    const Pending next = pending_[i];
    fill(next.at, next.type, next.inOut);
  }
  pending_.clear();
}

void TypeTable::fill(uint32_t at, const Type *type, bool inOut) {
  Row row;
  row.name = typeName(type);
  row.cppType = c_.names.type(type);
  includes_.complete(type);
  if (inOut) {
    fillInOut(row, type);
  } else {
    row.hash = c_.layouts.hash(type);
    if (c_.layouts.hasAddress(type))
      row.flags |= kHasAddress;
    fillKind(row, type);
  }
  types_[at] = std::move(row);
}

/// The slot of an in-out: an address, of an ARRAY[*] with its bounds.
void TypeTable::fillInOut(Row &row, const Type *type) {
  row.kind = "InOut";
  row.flags = kHasAddress;
  row.hash = Hash().add("in-out").add(row.name).value();
  if (type->kind == TypeKind::OpenArray) {
    row.element = index(typeAs<OpenArrayType>(type)->element);
  } else {
    row.cppType = "void *";
    row.element = index(type);
  }
}

void TypeTable::fillKind(Row &row, const Type *type) {
  switch (type->kind) {
  case TypeKind::Enumeration:
    return fillEnumeration(row, typeAs<EnumType>(type));
  case TypeKind::Array: {
    const auto *a = typeAs<ArrayType>(type);
    row.kind = "Array";
    row.lowerBound = a->low;
    row.elementCount = a->count();
    row.element = index(a->element);
    return;
  }
  case TypeKind::Pointer:
  case TypeKind::Reference: {
    const Type *pointee = typeAs<PointerType>(type)->pointee;
    row.kind = type->kind == TypeKind::Pointer ? "Pointer" : "Reference";
    row.cppType = "void *";
    if (pointee->kind != TypeKind::None)
      row.element = index(pointee);
    return;
  }
  case TypeKind::Interface:
    row.kind = "Interface";
    return;
  case TypeKind::Structure: {
    const auto *s = typeAs<StructType>(type);
    row.kind = s->isUnion ? "Union" : "Struct";
    row.renamedFrom = renamedFrom(s->symbol->decl->attributes);
    return members(row, type, s->base, row.cppType, {s->fields.begin(), s->fields.end()});
  }
  case TypeKind::FunctionBlock:
  case TypeKind::Program:
    return fillInstance(row, typeAs<PouType>(type));
  case TypeKind::Subrange: {
    const auto *range = typeAs<SubrangeType>(type);
    const Type *base = underlying(type);
    row.kind = Names::elementary(base->kind);
    row.flags |= kRange;
    row.element = index(base);
    row.lowerBound = range->low;
    row.elementCount = static_cast<uint64_t>(range->high);
    return;
  }
  default:
    row.kind = Names::elementary(type->kind);
    if (isString(type))
      row.stringLength = typeAs<StringType>(type)->length;
    else if (isCharacter(type))
      row.stringLength = 1;
    return;
  }
}

void TypeTable::fillEnumeration(Row &row, const EnumType *type) {
  row.kind = "Enum";
  row.element = index(type->base);
  if (type->symbol->decl != nullptr)
    row.renamedFrom = renamedFrom(type->symbol->decl->attributes);
  for (const EnumeratorSymbol *x : type->enumerators)
    row.lines.push_back(Line('E').add(x->name.text).add(x->value).text());
}

void TypeTable::fillInstance(Row &row, const PouType *type) {
  const PouSymbol *pou = type->symbol;
  row.kind = instanceKind(pou);
  if (hasOwnNumbers(pou))
    row.numbersOf = pou;
  row.renamedFrom = renamedFrom(pou->decl->attributes);
  if (pou->decl->external)
    row.flags |= kExternal;
  if (pou->isBlock() && hasTypeId(pou))
    row.typeId = c_.names.typeId(pou);
  members(row, type, pou->base == nullptr ? nullptr : pou->base->type, row.cppType,
          rootVariables({pou, false}), carriesTypeId(pou));
}

void TypeTable::memberRow(Row &row, const Type *type, const VarSymbol *v, uint32_t typeIndex,
                          const std::string &owner) {
  Flags flags = locatedFlags(v, symbolFlags(v));
  if (row.numbersOf != nullptr) {
    // they are there
  } else if (v->isBit) { // offsetof is not for bits
    const Storage::BitPlace at = storage_.bit(type, v);
    row.offsets.push_back(std::to_string(at.byte));
    flags.add(true, kBit).addNumber(at.bit);
  } else if (isPlaced(v)) {
    row.offsets.push_back(placeInImage(*v->location));
  } else {
    row.offsets.push_back(offsetOf(owner, fieldName(v)));
  }
  row.lines.push_back(Line('M', flags.text())
                          .add(v->storage.empty() ? v->name.text : v->storage)
                          .add(typeIndex)
                          .add(renamedFrom(v->decl->attributes))
                          .text());
}

void TypeTable::members(Row &row, const Type *type, const Type *base, const std::string &owner,
                        const std::vector<const VarSymbol *> &variables, bool typeId) {
  if (base != nullptr) {
    row.lines.push_back(
        Line('M', std::string(1, kBase)).add(typeName(base)).add(index(base)).text());
    if (row.numbersOf == nullptr)
      row.offsets.push_back(offsetOf(owner, "base__"));
  }
  if (typeId) {
    row.lines.push_back(Line('M', std::string({kTypeId, kHidden}))
                            .add("type__")
                            .add(index(elementaryType(TypeKind::Udint)))
                            .text());
    if (row.numbersOf == nullptr)
      row.offsets.push_back(offsetOf(owner, "type__"));
  }
  for (const VarSymbol *v : variables)
    memberRow(row, type, v, index(v->type, v->section == Section::InOut), owner);
}

/// task of a root.
static std::string taskColumn(std::optional<uint32_t> task) {
  return task ? std::to_string(*task) : std::string();
}

void TypeTable::addRoot(std::string_view list, const VarSymbol *variable, const std::string &place,
                        bool qualifiedOnly, std::string_view listRenamedFrom,
                        std::optional<uint32_t> task) {
  std::string renamed(variable->decl == nullptr ? std::string_view()
                                                : renamedFrom(variable->decl->attributes));
  if (renamed.empty() && !listRenamedFrom.empty())
    renamed.append(listRenamedFrom).append(".").append(variable->name.text);
  const uint32_t type = index(variable->type, variable->section == Section::InOut);
  rootLines_.push_back(
      Line('R', locatedFlags(variable, symbolFlags(variable, qualifiedOnly)).text())
          .add(variable->name.text)
          .add(type)
          .add(list)
          .add(taskColumn(task))
          .add(renamed)
          .text());
  rootOffsets_.push_back(isPlaced(variable) ? placeInImage(*variable->location)
                                            : offsetOf("App__", place));
}

void TypeTable::addImage() {
  const Image &image = c_.program.image;
  bool any = false;
  for (size_t area = 0; area < image.types.size(); ++area) {
    if (image.types[area] == nullptr)
      continue;
    any = true;
    const char letter = "iqm"[area];
    addHidden(std::string{'%', "IQM"[area]}, index(image.types[area]),
              std::string("image__") + letter);
  }
  if (!any)
    return;
  // Hosts show and set direct addresses as these.
  for (const TypeKind kind :
       {TypeKind::Boolean, TypeKind::Byte, TypeKind::Word, TypeKind::Dword, TypeKind::Lword})
    index(elementaryType(kind));
}

void TypeTable::addHidden(std::string_view name, uint32_t type, std::string_view place) {
  rootLines_.push_back(Line('R', std::string(1, kHidden)).add(name).add(type).text());
  rootOffsets_.push_back(offsetOf("App__", place));
}

void TypeTable::addAccess(const AccessPath &access) {
  Flags own;
  own.add(!access.decl->readWrite, kConstant);
  const bool isElsewhere = access.location == nullptr || access.location->isSlot;
  rootOffsets_.push_back(isElsewhere
                             ? offsetOf("App__", statePath(c_.names, access.path, c_.program.user))
                             : placeInImage(*access.location));
  const Flags flags =
      access.location != nullptr ? locatedFlags(*access.location, own) : own.add(true, kLocated);
  const uint32_t type = index(access.type);
  rootLines_.push_back(Line('R', flags.text()).add(access.decl->name.text).add(type).text());
}

void TypeTable::addPool(uint64_t size) {
  Row row;
  row.kind = "Array";
  row.name = "ARRAY [0.." + std::to_string(size - 1) + "] OF BYTE";
  row.cppType = "::stride::BYTE[" + std::to_string(size) + "]"; // the maps lie after
  row.hash = Hash().add("pool").add(size).value();
  row.element = index(elementaryType(TypeKind::Byte));
  row.elementCount = size;
  const auto type = static_cast<uint32_t>(types_.size());
  types_.push_back(std::move(row));
  addHidden("__pool", type, "pool__");
}

void TypeTable::addProgram(const PouSymbol *program, const std::string &place,
                           std::optional<uint32_t> task) {
  const uint32_t type = index(program->type);
  const bool hidden = hasAttribute(program->decl->attributes, AttributeId::Hide);
  rootLines_.push_back(Line('R', std::string(hidden ? 1 : 0, kHidden))
                           .add(program->name.text)
                           .add(type)
                           .add({})
                           .add(taskColumn(task))
                           .add(renamedFrom(program->decl->attributes))
                           .text());
  rootOffsets_.push_back(offsetOf("App__", place));
}

std::vector<const PouSymbol *> TypeTable::withOwnNumbers() const {
  std::vector<const PouSymbol *> found;
  for (const Row &row : types_)
    if (row.numbersOf != nullptr)
      found.push_back(row.numbersOf);
  return found;
}

/// The numbers of the application and of blocks, in the order of the lines.
class TypeTable::Numbers {
public:
  explicit Numbers(Context &context) : c_(context) {}

  void add(std::string_view number, size_t count = 1) {
    own_.append("    ").append(number).append(",\n");
    end_ += count;
  }
  void addOf(const PouSymbol *pou, size_t count) {
    endSlice();
    const std::string name = numbersName(c_, pou);
    const std::string space(c_.names.space(pou->library));
    declarations_.append("namespace st::").append(space).append(" {\n");
    declarations_.append("extern const uint64_t ").append(name).append("[];\n}\n");
    list("::st::" + space + "::" + name, count);
  }
  std::string declarations() { return std::move(declarations_); }
  std::string text() {
    endSlice();
    std::string out;
    if (!own_.empty())
      out.append("constexpr uint64_t kSymbolNumbers[] = {\n").append(own_).append("};\n");
    return out.append("constexpr ::stride::SymbolNumbers kNumberLists[] = {\n")
        .append(lists_)
        .append("};\n");
  }

private:
  void list(const std::string &place, size_t count) {
    lists_.append("    {").append(place).append(", ").append(std::to_string(count)).append("},\n");
  }
  void endSlice() {
    if (end_ != begin_)
      list("kSymbolNumbers + " + std::to_string(begin_), end_ - begin_);
    begin_ = end_;
  }

  Context &c_;
  std::string declarations_;
  std::string own_;
  std::string lists_;
  size_t begin_ = 0; // of what is not in a list yet
  size_t end_ = 0;
};

SymbolTexts TypeTable::texts() const {
  if (types_.empty())
    return {};
  std::string lines;
  Numbers numbers(c_);
  const auto line = [&](std::string_view text) {
    lines.append("\n    \"").append(text).append("\\n\"");
  };
  for (const Row &r : types_) {
    line(Line('T', std::to_string(r.flags))
             .add(r.name)
             .addSome(r.hash, 16)
             .add(r.element < 0 ? std::string() : std::to_string(r.element))
             .addSome(r.lowerBound)
             .addSome(r.elementCount)
             .addSome(r.stringLength)
             .addSome(r.typeId)
             .add(r.renamedFrom)
             .text());
    for (const std::string &own : r.lines)
      line(own);
    if (r.numbersOf != nullptr) {
      numbers.addOf(r.numbersOf, kMeasures + r.lines.size());
      continue;
    }
    numbers.add(measuresOf(r.kind, r.cppType), kMeasures);
    for (const std::string &offset : r.offsets)
      numbers.add(offset);
  }
  for (const std::string &root : rootLines_)
    line(root);
  for (const std::string &offset : rootOffsets_)
    numbers.add(offset);
  std::string text =
      "\n// Types, members, enumerators and roots, as runtime/app/abi.h has lines of symbols.\n"
      "constexpr char kSymbolText[] =" +
      lines + ";\n" + numbers.text() +
      "constexpr ::stride::SymbolLines kSymbols = {kSymbolText, sizeof(kSymbolText) - 1, "
      "kNumberLists, ::stride::tableSize(kNumberLists), 0};\n";
  return {numbers.declarations(), std::move(text)};
}

} // namespace stc::codegen
