// VAR_CONFIG: variables placed and initialised from the outside, instance by instance.

#include "compiler/semantics/config/config.hpp"

#include "compiler/semantics/config/internal.hpp"
#include "compiler/semantics/config/registers.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/types/resolve.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace stc::sema {

using namespace ast;

namespace {

constexpr size_t kMaxShown = 8;

/// Entries of VAR_CONFIG by their path in lower case.
using EntriesByPath = std::unordered_map<std::string, const VarDecl *>;

} // namespace

static void reportMismatch(Context &c, const PathTarget &target, Span where, std::string message,
                           std::string label) {
  auto &d = c.report(Code::ConfigMismatch, where, std::move(message), std::move(label));
  if (target.variable != nullptr)
    noteDeclaration(d, target.variable);
}

/// The slot that the entry is for; null: the variable is none, or (reported) has an entry already.
static SlotPlace *takeSlot(Context &c, VarDecl *decl, const std::string &path,
                           std::vector<SlotPlace> &slots, bool &isTaken) {
  const std::string key = lowerCase(path);
  const auto slot = std::find_if(slots.begin(), slots.end(), [&](const SlotPlace &s) {
    return lowerCase(pathText(s.path)) == key;
  });
  isTaken = slot != slots.end() && slot->decl != nullptr;
  if (isTaken) {
    auto &d = c.report(Code::ConfigMismatch, decl->path->span, "`" + path + "` gets a place twice",
                       "placed again here");
    d.label(slot->decl->path->span, "placed first here");
  }
  if (slot == slots.end() || isTaken)
    return nullptr;
  slot->decl = decl; // what has an entry, be it wrong, is not missing
  return &*slot;
}

/// Whether the address may be that of the slot's variable.
static bool fitsSlot(Context &c, const PathTarget &target, const std::string &path,
                     const DirectAddress &address) {
  if (address.incomplete) {
    reportMismatch(c, target, address.span,
                   "`" + std::string(address.text) + "` does not say where",
                   "a number is needed here");
    return false;
  }
  const char area = areaLetter(target.variable->location->area);
  if (address.area == area)
    return true;
  reportMismatch(c, target, address.span,
                 "`" + path + "` is declared as `%" + area + "*` and cannot lie at `" +
                     std::string(address.text) + "`",
                 "another area");
  return false;
}

/// Gives the slot the place of the address, if that is one for values of the type.
static void placeSlot(Context &c, SlotPlace &slot, const Type *type, const std::string &path,
                      const DirectAddress &address) {
  const bool isBool = type->kind == TypeKind::Boolean;
  const auto at = locate(c, address);
  if (!at)
    return;
  const StorageExtent extent = c.storage.of(type);
  if ((at->bit >= 0) != isBool) {
    auto &d =
        c.report(Code::AddressType, address.span,
                 isBool ? "`" + std::string(address.text) + "` is no single bit"
                        : "`" + std::string(address.text) + "` is a single bit, `" + path +
                              "` is " + typeName(type),
                 isBool ? "a BOOL declared with `*` needs a bit" : "only a BOOL fits into a bit");
    if (isBool)
      d.help("write the bit: `%" + std::string(1, address.area) + "X0.0`");
    return;
  }
  if (!isBool && at->byte % extent.align != 0) {
    c.report(Code::Misaligned, address.span,
             "`" + path + "` must lie at a multiple of " + std::to_string(extent.align) + " bytes",
             "this is byte " + std::to_string(at->byte))
        .note("the code of a function block is the same for all instances");
    return;
  }
  if (!reserve(c, address, at->byte, isBool ? 1 : extent.size))
    return;
  slot.at = *at;
  slot.placed = true;
}

/// Whether the variable's initial value may come from here; reports why not. `first` holds the
/// entries before it by path.
static bool takesValue(Context &c, VarDecl *decl, const PathTarget &target, const std::string &path,
                       EntriesByPath &first) {
  if (target.isConstant) {
    reportMismatch(c, target, decl->path->span, "`" + path + "` is a constant",
                   "it has the value of its declaration");
    return false;
  }
  const auto [entry, isNew] = first.emplace(lowerCase(path), decl);
  if (isNew)
    return true;
  c.report(Code::ConfigMismatch, decl->path->span, "`" + path + "` gets a value twice",
           "the second one")
      .label(entry->second->path->span, "the first one");
  return false;
}

static void checkConfigEntry(Context &c, VarDecl *decl, Module &module,
                             std::vector<SlotPlace> &slots, EntriesByPath &values) {
  const auto target = resolvePath(c, decl->path, module);
  const Type *type = resolveType(c, decl->type, "config");
  if (!target || isError(type) || isError(target->type))
    return;
  const std::string path = pathText(target->path);
  bool isTaken = false;
  SlotPlace *slot = takeSlot(c, decl, path, slots, isTaken);
  if (isTaken)
    return;
  if (type != target->type) {
    reportMismatch(c, *target, decl->type->span,
                   "`" + path + "` is " + typeName(target->type) + ", not " + typeName(type),
                   "this type differs from the variable's");
    return;
  }
  if (decl->init != nullptr)
    decl->init = checkInit(c, decl->init, type);
  if (slot == nullptr && decl->address == nullptr) {
    if (takesValue(c, decl, *target, path, values))
      c.program.slotPlaces.push_back({target->path, nullptr, {}, decl, true});
  } else if (decl->address == nullptr) {
    reportMismatch(c, *target, decl->path->span, "the entry for `" + path + "` gives no address",
                   "where does it lie?");
  } else if (slot == nullptr) {
    reportMismatch(c, *target, decl->address->span,
                   "`" + path + "` is not declared with `*`: it has a place already",
                   "another place");
  } else if (fitsSlot(c, *target, path, *decl->address)) {
    placeSlot(c, *slot, type, path, *decl->address);
  }
}

/// A place after everything that is used in the slot's area; false (reported): there is none.
static bool takeFreePlace(Context &c, SlotPlace &slot) {
  const VarSymbol *v = slot.variable;
  const StorageExtent extent = c.storage.of(v->type);
  const uint64_t used = c.program.image.bytes[static_cast<size_t>(v->location->area)];
  const uint64_t byte = (used + extent.align - 1) / extent.align * extent.align;
  slot.at = *v->location;
  slot.at.isSlot = false;
  slot.at.byte = static_cast<uint32_t>(byte);
  slot.placed = reserve(c, *v->decl->address, byte, std::max<uint64_t>(extent.size, 1));
  return slot.placed;
}

/// What VAR_CONFIG does not mention gets places of its own.
static void chooseMissingPlaces(Context &c, std::vector<SlotPlace> &slots) {
  if (slots.size() > kMaxSlots) {
    const VarSymbol *v = slots.back().variable;
    c.report(Code::PlaceMissing, v->decl->address->span,
             "more than " + std::to_string(kMaxSlots) + " variables need a place of VAR_CONFIG",
             "`" + std::string(v->name.text) + "` is one of them, in each instance");
    return;
  }
  std::map<const VarSymbol *, std::vector<const SlotPlace *>> missing;
  std::vector<const VarSymbol *> order;
  for (SlotPlace &slot : slots) {
    if (slot.decl != nullptr)
      continue;
    if (!takeFreePlace(c, slot))
      return;
    auto &list = missing[slot.variable];
    if (list.empty())
      order.push_back(slot.variable);
    list.push_back(&slot);
  }
  for (const VarSymbol *v : order) {
    const auto &list = missing[v];
    auto &d = c.report(Code::PlaceChosen, v->decl->address->span,
                       list.size() == 1 ? "VAR_CONFIG gives `" + pathText(list.front()->path) +
                                              "` no place: it lies after all others"
                                        : "VAR_CONFIG gives `" + std::string(v->name.text) +
                                              "` no place in " + std::to_string(list.size()) +
                                              " instances: they lie after all others",
                       "no device is known for it");
    std::string text = "say where, for example\nVAR_CONFIG\n";
    for (size_t i = 0; i < list.size() && i < kMaxShown; ++i)
      text += "  " + pathText(list[i]->path) + " AT " +
              addressText(list[i]->at, c.storage.of(v->type).align, c.program.settings.addressing) +
              " : " + typeName(v->type) + ";\n";
    if (list.size() > kMaxShown)
      text += "  // and " + std::to_string(list.size() - kMaxShown) + " more\n";
    d.help(text + "END_VAR");
  }
}

/// Reports variables that no path leads to, although they hold some declared `AT %I*`.
static void requirePlaces(Context &c, const PouSymbol &pou) {
  const auto require = [&](const VarSymbol *v) {
    if (v->section == Section::InOut || v->type == nullptr || !hasSlots(c, v->type))
      return;
    c.report(Code::PlaceMissing, v->name.span,
             "no VAR_CONFIG can place the variables of `" + std::string(v->name.text) + "`",
             "`" + typeName(v->type) + "` has variables declared with `*`")
        .help("declare the instance in the VAR of a program or function block, or in "
              "VAR_GLOBAL; a function takes it by VAR_IN_OUT");
  };
  for (const VarSymbol *v : pou.variables) {
    const bool perCall = pou.isFunction() || (pou.isMethod() && v->section != Section::Instance) ||
                         v->section == Section::Temp || v->section == Section::Stat;
    if (perCall)
      require(v);
  }
  if (pou.result != nullptr &&
      std::find(pou.variables.begin(), pou.variables.end(), pou.result) == pou.variables.end())
    require(pou.result);
}

void checkConfigured(Context &c, Module &module) {
  const ScopeGuard guard(c, {&module, nullptr});
  std::vector<SlotPlace> slots;
  for (PouSymbol *pou : module.library->pous) {
    if (pou->decl->kind == DeclKind::Program && !pou->isTemplate) {
      StatePath path{pou, {}};
      collectSlots(c, pou->type, path, slots);
    }
    requirePlaces(c, *pou);
    for (const PouSymbol *method : pou->methods)
      requirePlaces(c, *method);
  }
  for (GlobalsSymbol *list : module.library->globals) {
    for (VarSymbol *v : list->variables) {
      if (v->type == nullptr)
        continue;
      StatePath path{v, {}};
      if (v->location != nullptr && v->location->isSlot)
        slots.push_back({path, v, {}, nullptr, false});
      else
        collectSlots(c, v->type, path, slots);
    }
  }
  EntriesByPath values;
  for (GlobalsDecl *list : c.names.configuration().configs) {
    for (VarDecl *decl : list->variables) {
      if (decl->path != nullptr)
        checkConfigEntry(c, decl, module, slots, values);
    }
  }
  placeChannelFields(c, slots);
  chooseMissingPlaces(c, slots);
  for (SlotPlace &slot : slots) {
    if (slot.placed)
      c.program.slotPlaces.push_back(std::move(slot));
  }
  checkAccesses(c, module);
}

} // namespace stc::sema
