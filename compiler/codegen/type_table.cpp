#include "compiler/codegen/type_table.hpp"

#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/type_table.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

std::string_view renamedFrom(const Attributes &attributes) {
  return attributeValue(attributes, AttributeId::RenamedFrom);
}

namespace {

// Values of runtime/app/abi.h.
constexpr unsigned kHasAddress = 1;
constexpr unsigned kExternal = 2;

/// The flags of a variable as an expression: `::stride::kSymInput | ::stride::kSymRetain`.
class Flags {
public:
  Flags &add(bool set, std::string_view name) {
    if (set)
      text_.append(text_.empty() ? "::stride::kSym" : " | ::stride::kSym").append(name);
    return *this;
  }
  /// `number << kSym…Shift`
  Flags &addNumber(unsigned number, std::string_view shift) {
    text_ += (text_.empty() ? "" : " | ") + std::to_string(number) + "U << ::stride::kSym";
    text_ += shift;
    return *this;
  }
  [[nodiscard]] std::string text() const { return text_.empty() ? "0" : text_; }

private:
  std::string text_;
};

Flags symbolFlags(const VarSymbol *v, bool qualifiedOnly = false) {
  const unsigned qualifiers = v->decl == nullptr ? 0U : v->decl->qualifiers;
  Flags flags;
  flags.add(v->section == Section::Input, "Input")
      .add(v->section == Section::Output, "Output")
      .add(v->section == Section::InOut, "InOut")
      .add((qualifiers & kQualRetain) != 0, "Retain")
      .add((qualifiers & kQualPersistent) != 0, "Persistent")
      .add((qualifiers & kQualNonRetain) != 0, "NonRetain")
      .add(v->isConstant, "Constant")
      .add(v->hidden, "Hidden")
      .add(v->decl != nullptr && hasAttribute(v->decl->attributes, AttributeId::InitOnOnlineChange),
           "InitOnChange")
      .add(qualifiedOnly, "QualifiedOnly");
  return flags;
}

/// Flags, offset and type of a variable in the process image are not those of an ordinary one.
Flags locatedFlags(const Location &at, Flags flags) {
  if (at.isSlot)
    flags.add(true, "Slot").addNumber(static_cast<unsigned>(at.area), "AreaShift");
  else
    flags.add(true, "Located");
  flags.add(at.bit >= 0, "Bit");
  if (!at.isSlot && at.bit > 0)
    flags.addNumber(static_cast<unsigned>(at.bit), "BitShift");
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

std::string quote(std::string_view text) { return '"' + escaped(text) + '"'; }

/// `, "old"` where there is one: the last column of a row.
std::string renamedColumn(std::string_view renamed) {
  return renamed.empty() ? std::string() : ", " + quote(renamed);
}

} // namespace

uint32_t TypeTable::index(const Type *type, bool inOut) {
  if (!inOut && type->kind == TypeKind::Subrange)
    type = underlying(type);
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
  row.firstMember = enumeratorRows_.size();
  row.memberCount = type->enumerators.size();
  if (type->symbol->decl != nullptr)
    row.renamedFrom = renamedFrom(type->symbol->decl->attributes);
  for (const EnumeratorSymbol *x : type->enumerators)
    enumeratorRows_.push_back("{" + quote(x->name.text) + ", " + std::to_string(x->value) + "}");
}

void TypeTable::fillInstance(Row &row, const PouType *type) {
  const PouSymbol *pou = type->symbol;
  row.kind = type->kind == TypeKind::Program ? "Program" : "FunctionBlock";
  row.renamedFrom = renamedFrom(pou->decl->attributes);
  if (pou->decl->external)
    row.flags |= kExternal;
  if (pou->isBlock() && hasTypeId(pou))
    row.typeId = c_.names.typeId(pou);
  members(row, type, pou->base == nullptr ? nullptr : pou->base->type, row.cppType,
          rootVariables({pou, false}), carriesTypeId(pou));
}

std::string TypeTable::memberRow(const Type *type, const VarSymbol *v, uint32_t typeIndex,
                                 const std::string &owner) {
  const Flags flags = locatedFlags(v, symbolFlags(v));
  std::string row = "{" + quote(v->storage.empty() ? v->name.text : v->storage) + ", ";
  std::string bit;
  if (v->isBit) { // offsetof is not for bits
    const Storage::BitPlace at = storage_.bit(type, v);
    row += std::to_string(at.byte);
    bit = " | ::stride::kSymBit | " + std::to_string(at.bit) + "U << ::stride::kSymBitShift";
  } else if (isPlaced(v)) {
    row += placeInImage(*v->location);
  } else {
    row.append("offsetof(").append(owner).append(", ").append(fieldName(v)).append(")");
  }
  row.append(", ").append(std::to_string(typeIndex)).append(", ").append(flags.text());
  return row.append(bit).append(renamedColumn(renamedFrom(v->decl->attributes))).append("}");
}

void TypeTable::members(Row &row, const Type *type, const Type *base, const std::string &owner,
                        const std::vector<const VarSymbol *> &variables, bool typeId) {
  std::vector<uint32_t> types;
  types.reserve(variables.size());
  const uint32_t baseIndex = base == nullptr ? 0 : index(base);
  const uint32_t idIndex = typeId ? index(elementaryType(TypeKind::Udint)) : 0;
  for (const VarSymbol *v : variables)
    types.push_back(index(v->type, v->section == Section::InOut));
  row.firstMember = memberRows_.size();
  if (base != nullptr)
    memberRows_.push_back("{" + quote(typeName(base)) + ", offsetof(" + owner + ", base__), " +
                          std::to_string(baseIndex) + ", ::stride::kSymBase}");
  if (typeId)
    memberRows_.push_back("{\"type__\", offsetof(" + owner + ", type__), " +
                          std::to_string(idIndex) +
                          ", ::stride::kSymTypeId | ::stride::kSymHidden}");
  for (size_t i = 0; i < variables.size(); ++i)
    memberRows_.push_back(memberRow(type, variables[i], types[i], owner));
  row.memberCount = memberRows_.size() - row.firstMember;
}

/// renamedFrom and task of a root.
static std::string lastColumns(std::string_view renamed, std::optional<uint32_t> task) {
  std::string column = renamedColumn(renamed);
  if (!task)
    return column;
  return (column.empty() ? ", nullptr" : column) + ", " + std::to_string(*task);
}

void TypeTable::addRoot(std::string_view list, const VarSymbol *variable, const std::string &place,
                        bool qualifiedOnly, std::string_view listRenamedFrom,
                        std::optional<uint32_t> task) {
  std::string renamed(variable->decl == nullptr ? std::string_view()
                                                : renamedFrom(variable->decl->attributes));
  if (renamed.empty() && !listRenamedFrom.empty())
    renamed.append(listRenamedFrom).append(".").append(variable->name.text);
  const uint32_t type = index(variable->type, variable->section == Section::InOut);
  const std::string offset =
      isPlaced(variable) ? placeInImage(*variable->location) : "offsetof(App__, " + place + ")";
  rootRows_.push_back("{" + (list.empty() ? std::string("nullptr") : quote(list)) + ", " +
                      quote(variable->name.text) + ", " + offset + ", " + std::to_string(type) +
                      ", " + locatedFlags(variable, symbolFlags(variable, qualifiedOnly)).text() +
                      lastColumns(renamed, task) + "}");
}

void TypeTable::addImage() {
  const Image &image = c_.program.image;
  bool any = false;
  for (size_t area = 0; area < image.types.size(); ++area) {
    if (image.types[area] == nullptr)
      continue;
    any = true;
    const char letter = "iqm"[area];
    rootRows_.push_back(std::string("{nullptr, \"%") + "IQM"[area] + "\", offsetof(App__, image__" +
                        letter + "), " + std::to_string(index(image.types[area])) +
                        ", ::stride::kSymHidden}");
  }
  if (!any)
    return;
  // Hosts show and set direct addresses as these.
  for (const TypeKind kind :
       {TypeKind::Boolean, TypeKind::Byte, TypeKind::Word, TypeKind::Dword, TypeKind::Lword})
    index(elementaryType(kind));
}

void TypeTable::addAccess(const AccessPath &access) {
  Flags own;
  own.add(!access.decl->readWrite, "Constant");
  std::string offset;
  if (access.location == nullptr || access.location->isSlot)
    offset = "offsetof(App__, " + statePath(c_.names, access.path, c_.program.user) + ")";
  else
    offset = placeInImage(*access.location);
  const std::string flags = access.location != nullptr ? locatedFlags(*access.location, own).text()
                                                       : "::stride::kSymLocated | " + own.text();
  const uint32_t type = index(access.type);
  rootRows_.push_back("{nullptr, " + quote(access.decl->name.text) + ", " + offset + ", " +
                      std::to_string(type) + ", " + flags + "}");
}

void TypeTable::addPool(uint64_t size) {
  Row row;
  row.kind = "Array";
  row.name = "ARRAY [0.." + std::to_string(size - 1) + "] OF BYTE";
  row.cppType = "::stride::BYTE[" + std::to_string(size) + "]"; // the maps lie after
  row.hash = Hash().add("pool").add(size).value();
  row.element = index(elementaryType(TypeKind::Byte));
  row.elementCount = size;
  const size_t type = types_.size();
  types_.push_back(std::move(row));
  rootRows_.push_back("{nullptr, \"__pool\", offsetof(App__, pool__), " + std::to_string(type) +
                      ", ::stride::kSymHidden}");
}

void TypeTable::addProgram(const PouSymbol *program, const std::string &place,
                           std::optional<uint32_t> task) {
  const uint32_t type = index(program->type);
  const bool hidden = hasAttribute(program->decl->attributes, AttributeId::Hide);
  rootRows_.push_back("{nullptr, " + quote(program->name.text) + ", offsetof(App__, " + place +
                      "), " + std::to_string(type) + (hidden ? ", ::stride::kSymHidden" : ", 0") +
                      lastColumns(renamedFrom(program->decl->attributes), task) + "}");
}

std::string TypeTable::text() const {
  std::string out;
  const auto table = [&](std::string_view type, std::string_view name,
                         const std::vector<std::string> &rows) {
    if (rows.empty())
      return;
    out.append("\nconstexpr ::stride::").append(type).append(" ").append(name).append("[] = {\n");
    for (const std::string &row : rows)
      out.append("    ").append(row).append(",\n");
    out.append("};\n");
  };
  std::vector<std::string> rows;
  rows.reserve(types_.size());
  for (const Row &r : types_) {
    rows.push_back("{Kind::" + r.kind + ", " + std::to_string(r.flags) + ", " + quote(r.name) +
                   ", sizeof(" + r.cppType + "), " + std::to_string(r.hash) + "ULL, alignof(" +
                   r.cppType + "), " + std::to_string(r.firstMember) + ", " +
                   std::to_string(r.memberCount) + ", " +
                   (r.element < 0 ? std::string("kNo") : std::to_string(r.element)) + ", " +
                   std::to_string(r.lowerBound) + ", " + std::to_string(r.elementCount) + ", " +
                   std::to_string(r.stringLength) + ", " + std::to_string(r.typeId) +
                   renamedColumn(r.renamedFrom) + "}");
  }
  out += "\n// {kind, flags, name, size, layoutHash, align, firstMember, memberCount, element, "
         "lowerBound,\n"
         "//  elementCount, stringLength, typeId, renamedFrom}";
  table("TypeDesc", "kTypes", rows);
  out += "\n// {name, offset, type, flags, renamedFrom}";
  table("MemberDesc", "kMembers", memberRows_);
  table("EnumeratorDesc", "kEnumerators", enumeratorRows_);
  out += "\n// {list, name, offset, type, flags, renamedFrom, task}";
  table("RootDesc", "kRoots", rootRows_);
  return out;
}

} // namespace stc::codegen
