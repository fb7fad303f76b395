// Descriptions of applications made at run time: types and roots are declared, offsets follow from
// natural alignment. The state is plain memory without any program.
#ifndef STRIDE_TESTS_UNIT_APP_APP_MODEL_HPP
#define STRIDE_TESTS_UNIT_APP_APP_MODEL_HPP

#include "runtime/app/abi.h"

#include <cstddef>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace stride::test {

struct ModelType;

struct ModelField {
  std::string name;
  const ModelType *type;
  uint32_t flags = 0;
  std::string renamedFrom = {};
  int id = 0; ///< For the test's own use.
};

struct ModelType {
  Kind kind;
  std::string name;
  uint64_t size = 0;
  uint32_t align = 1;
  std::vector<ModelField> fields = {};
  std::vector<uint64_t> offsets = {};
  const ModelType *base = nullptr;
  const ModelType *element =
      nullptr; ///< Also what a pointer points to, also an enumeration's base.
  int64_t low = 0;
  uint64_t count = 0;
  uint32_t length = 0;
  std::vector<std::pair<std::string, int64_t>> enumerators = {};
  std::string renamedFrom = {};
  uint32_t flags = 0;
  uint64_t hash = 0;
  uint32_t typeId = 0;
};

struct ModelRoot {
  std::string list; ///< Empty: none.
  std::string name;
  const ModelType *type;
  uint32_t flags = 0;
  std::string renamedFrom = {};
  int id = 0; ///< For the test's own use.
  uint64_t offset = 0;
};

/// One application. Types live as long as the model; finish() once before app() is used.
class AppModel {
public:
  AppModel() = default;
  AppModel(const AppModel &) = delete;
  AppModel &operator=(const AppModel &) = delete;

  const ModelType *elementary(Kind kind) {
    const auto found = elementary_.find(kind);
    if (found != elementary_.end())
      return found->second;
    ModelType *type = fresh(kind, kindName(kind));
    type->size = sizeOf(kind);
    type->align = static_cast<uint32_t>(type->size);
    return elementary_[kind] = type;
  }
  const ModelType *subrange(Kind kind, int64_t low, int64_t high) {
    ModelType *type = fresh(kind, kindName(kind) + " (" + std::to_string(low) + ".." +
                                      std::to_string(high) + ")");
    type->element = elementary(kind);
    type->size = type->element->size;
    type->align = type->element->align;
    type->flags = kTypeRange;
    type->low = low;
    type->count = static_cast<uint64_t>(high);
    return type;
  }
  const ModelType *string(uint32_t length, bool wide = false) {
    const ModelType *&known = strings_[{length, wide}];
    if (known == nullptr) {
      ModelType *type = fresh(wide ? Kind::WSTRING : Kind::STRING,
                              (wide ? "WSTRING(" : "STRING(") + std::to_string(length) + ")");
      type->length = length;
      type->align = wide ? 2 : 1;
      type->size = (uint64_t{length} + 1) * type->align;
      known = type;
    }
    return known;
  }
  const ModelType *array(const ModelType *element, int64_t low, int64_t high) {
    ModelType *type = fresh(Kind::Array, "ARRAY[" + std::to_string(low) + ".." +
                                             std::to_string(high) + "] OF " + element->name);
    type->element = element;
    type->low = low;
    type->count = static_cast<uint64_t>(high - low + 1);
    type->size = type->count * element->size;
    type->align = element->align;
    return type;
  }
  const ModelType *enumeration(std::string name,
                               std::vector<std::pair<std::string, int64_t>> enumerators,
                               Kind base = Kind::INT) {
    ModelType *type = fresh(Kind::Enum, std::move(name));
    type->element = elementary(base);
    type->size = type->element->size;
    type->align = type->element->align;
    type->enumerators = std::move(enumerators);
    return type;
  }
  /// What it points to may be completed later.
  const ModelType *pointer(const ModelType *to, Kind kind = Kind::Pointer) {
    const ModelType *&known = pointers_[{to, kind}];
    if (known == nullptr) {
      ModelType *type = fresh(kind, to == nullptr ? "Interface" : "POINTER TO " + to->name);
      type->element = to;
      type->size = type->align = 8;
      type->flags = kTypeHasAddress;
      known = type;
    }
    return known;
  }
  ModelType *structure(std::string name, std::vector<ModelField> fields,
                       const ModelType *base = nullptr, Kind kind = Kind::Struct) {
    ModelType *type = fresh(kind, std::move(name));
    type->base = base;
    define(*type, std::move(fields));
    return type;
  }
  /// Gives a type its fields and so its layout.
  static void define(ModelType &type, std::vector<ModelField> fields) {
    type.fields = std::move(fields);
    type.offsets.clear();
    uint64_t end = 0;
    type.align = 1;
    if (type.base != nullptr) {
      end = type.base->size;
      type.align = type.base->align;
    }
    for (const ModelField &field : type.fields) {
      const uint64_t align = field.type->align;
      const uint64_t at = type.kind == Kind::Union ? 0 : (end + align - 1) / align * align;
      type.offsets.push_back(at);
      end = std::max(end, at + field.type->size);
      type.align = std::max(type.align, field.type->align);
    }
    type.size = std::max<uint64_t>((end + type.align - 1) / type.align * type.align, 1);
  }
  void root(std::string list, std::string name, const ModelType *type, uint32_t flags = 0,
            std::string renamedFrom = {}, int id = 0) {
    roots.push_back({std::move(list), std::move(name), type, flags, std::move(renamedFrom), id, 0});
  }

  /// Lays the roots out and writes the tables.
  const StrideAppV1 &finish() {
    uint64_t end = 0;
    for (ModelRoot &root : roots) {
      root.offset = (end + root.type->align - 1) / root.type->align * root.type->align;
      end = root.offset + root.type->size;
      const uint32_t type = index(root.type);
      rootRows_.push_back({root.list.empty() ? nullptr : root.list.c_str(), root.name.c_str(),
                           root.offset, type, root.flags, text(root.renamedFrom)});
    }
    app_.abiVersion = kAbiVersion;
    app_.magic = kAbiMagic;
    app_.size = sizeof app_;
    app_.name = "model";
    app_.compiler = "";
    app_.stateSize = (end + 15) / 16 * 16;
    app_.stateAlign = 16;
    app_.init = [](Ctx *) {};
    app_.types = types_.data();
    app_.typeCount = static_cast<uint32_t>(types_.size());
    app_.members = members_.data();
    app_.memberCount = static_cast<uint32_t>(members_.size());
    app_.enumerators = enumerators_.data();
    app_.enumeratorCount = static_cast<uint32_t>(enumerators_.size());
    app_.roots = rootRows_.data();
    app_.rootCount = static_cast<uint32_t>(rootRows_.size());
    return app_;
  }
  StrideAppV1 &app() { return app_; }

  std::vector<ModelRoot> roots;

  static uint64_t sizeOf(Kind kind) {
    switch (kind) {
    case Kind::BOOL:
    case Kind::SINT:
    case Kind::USINT:
    case Kind::BYTE:
      return 1;
    case Kind::INT:
    case Kind::UINT:
    case Kind::WORD:
      return 2;
    case Kind::DINT:
    case Kind::UDINT:
    case Kind::DWORD:
    case Kind::REAL:
    case Kind::TIME:
    case Kind::DATE:
    case Kind::TOD:
    case Kind::DT:
      return 4;
    default:
      return 8;
    }
  }
  static std::string kindName(Kind kind) {
    static constexpr const char *kNames[] = {"",      "BOOL",  "SINT",  "INT",   "DINT", "LINT",
                                             "USINT", "UINT",  "UDINT", "ULINT", "BYTE", "WORD",
                                             "DWORD", "LWORD", "REAL",  "LREAL", "TIME", "LTIME",
                                             "DATE",  "LDATE", "TOD",   "LTOD",  "DT",   "LDT"};
    return kNames[static_cast<uint32_t>(kind)];
  }

private:
  ModelType *fresh(Kind kind, std::string name) {
    ModelType type{};
    type.kind = kind;
    type.name = std::move(name);
    store_.push_back(std::move(type));
    return &store_.back();
  }
  static const char *text(const std::string &text) { return text.empty() ? nullptr : text.c_str(); }

  uint32_t index(const ModelType *type) {
    const auto [at, isNew] = indices_.try_emplace(type, static_cast<uint32_t>(types_.size()));
    const uint32_t own = at->second;
    if (!isNew)
      return own;
    types_.emplace_back();
    TypeDesc row{};
    row.kind = type->kind;
    row.flags = type->flags;
    row.name = type->name.c_str();
    row.size = type->size;
    row.layoutHash = type->hash;
    row.align = type->align;
    row.element = type->element == nullptr ? kNoIndex : index(type->element);
    row.lowerBound = type->low;
    row.elementCount = type->count;
    row.stringLength = type->length;
    row.typeId = type->typeId;
    row.renamedFrom = text(type->renamedFrom);
    if (type->kind == Kind::Enum) {
      row.firstMember = static_cast<uint32_t>(enumerators_.size());
      row.memberCount = static_cast<uint32_t>(type->enumerators.size());
      for (const auto &[name, value] : type->enumerators)
        enumerators_.push_back({name.c_str(), value});
    } else if (!type->fields.empty() || type->base != nullptr) {
      std::vector<MemberDesc> rows;
      if (type->base != nullptr)
        rows.push_back({type->base->name.c_str(), 0, index(type->base), kSymBase, nullptr});
      for (size_t i = 0; i < type->fields.size(); ++i) {
        const ModelField &field = type->fields[i];
        rows.push_back({field.name.c_str(), type->offsets[i], index(field.type), field.flags,
                        text(field.renamedFrom)});
      }
      row.firstMember = static_cast<uint32_t>(members_.size());
      row.memberCount = static_cast<uint32_t>(rows.size());
      members_.insert(members_.end(), rows.begin(), rows.end());
    }
    types_[own] = row;
    return own;
  }

  std::deque<ModelType> store_;
  std::map<Kind, const ModelType *> elementary_;
  std::map<std::pair<uint32_t, bool>, const ModelType *> strings_;
  std::map<std::pair<const ModelType *, Kind>, const ModelType *> pointers_;
  std::map<const ModelType *, uint32_t> indices_;
  std::vector<TypeDesc> types_;
  std::vector<MemberDesc> members_;
  std::vector<EnumeratorDesc> enumerators_;
  std::vector<RootDesc> rootRows_;
  StrideAppV1 app_{};
};

} // namespace stride::test

#endif
