// VAR_CONFIG and VAR_ACCESS: variables named from the outside, instance by instance.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/suggest.hpp"
#include "compiler/source/identifier.hpp"

#include <algorithm>
#include <map>

namespace stc {

using namespace ast;

namespace {

constexpr std::size_t kMaxShown = 8;
/// Variables that VAR_CONFIG can place.
constexpr std::size_t kMaxSlots = 65536;

} // namespace

std::string pathText(const StatePath &path) {
  std::string text(path.root->name.text);
  const Type *type = path.root->kind == SymbolKind::pou
                         ? static_cast<const PouSymbol *>(path.root)->type
                         : static_cast<const VarSymbol *>(path.root)->type;
  for (const PathStep &step : path.steps) {
    if (step.member != nullptr) {
      text += "." + std::string(step.member->name.text);
      type = step.member->type;
      continue;
    }
    const auto *array = typeAs<ArrayType>(type);
    const std::string index = std::to_string(array->low + static_cast<std::int64_t>(step.element));
    if (text.back() == ']')
      text.replace(text.size() - 1, 1, "," + index + "]");
    else
      text += "[" + index + "]";
    type = array->element;
  }
  return text;
}

/// Calls `visit(member)` for what an instance of the type holds by value.
template <class Visit> void Checker::visitHeld(const Type *type, Visit &&visit) {
  if (type->kind == TypeKind::structure) {
    const auto *s = typeAs<StructType>(type);
    if (s->base != nullptr)
      visitHeld(s->base, visit);
    for (VarSymbol *field : s->fields)
      visit(field);
  } else if (isInstance(type)) {
    PouSymbol *pou = typeAs<PouType>(type)->symbol;
    declare(pou);
    if (pou->base != nullptr)
      visitHeld(pou->base->type, visit);
    for (VarSymbol *v : pou->variables) {
      if (v->section != Section::inOut && v->section != Section::temp &&
          v->section != Section::stat)
        visit(v);
    }
  }
}

bool Checker::hasSlots(const Type *type) {
  while (type->kind == TypeKind::array)
    type = typeAs<ArrayType>(type)->element;
  if (type->kind != TypeKind::structure && !isInstance(type))
    return false;
  const auto [it, fresh] = hasSlots_.try_emplace(type, false);
  if (!fresh)
    return it->second;
  bool result = false;
  visitHeld(type, [&](VarSymbol *v) {
    result = result || (v->location != nullptr && v->location->isSlot) ||
             (v->type != nullptr && hasSlots(v->type));
  });
  hasSlots_[type] = result;
  return result;
}

void Checker::collectSlots(const Type *type, StatePath &path, std::vector<SlotPlace> &out) {
  if (type->kind == TypeKind::array) {
    const auto *array = typeAs<ArrayType>(type);
    for (std::uint64_t i = 0;
         hasSlots(array->element) && i < array->count() && out.size() <= kMaxSlots; ++i) {
      path.steps.push_back({nullptr, i});
      collectSlots(array->element, path, out);
      path.steps.pop_back();
    }
    return;
  }
  if (!hasSlots(type))
    return;
  visitHeld(type, [&](VarSymbol *v) {
    if (out.size() > kMaxSlots) // instances in instances soon are too many to list
      return;
    path.steps.push_back({v, 0});
    if (v->location != nullptr && v->location->isSlot)
      out.push_back({path, v, {}, nullptr, false});
    else if (v->type != nullptr)
      collectSlots(v->type, path, out);
    path.steps.pop_back();
  });
}

/// The object of a path's first name; null (and reported) when there is none.
Symbol *Checker::pathRoot(const Name &name, Module &module) {
  Symbol *symbol = lookupInModule(module, name.id);
  if (symbol == nullptr) {
    for (const auto &[id, list] : module.lists) {
      const auto it = list->scope.find(name.id);
      if (it != list->scope.end())
        symbol = it->second;
    }
  }
  const bool good =
      symbol != nullptr && (symbol->kind == SymbolKind::variable ||
                            (symbol->kind == SymbolKind::pou &&
                             static_cast<PouSymbol *>(symbol)->decl->kind == DeclKind::program));
  if (good)
    return symbol;
  auto &d = report(Code::configPath, name.span,
                   "there is no program or global variable `" + std::string(name.text) + "`",
                   symbol == nullptr ? "not found" : "this is " + describe(symbol));
  std::vector<std::string_view> names;
  for (const auto &[id, other] : module.names) {
    if (other->kind == SymbolKind::variable ||
        (other->kind == SymbolKind::pou &&
         static_cast<PouSymbol *>(other)->decl->kind == DeclKind::program))
      names.push_back(other->name.text);
  }
  std::sort(names.begin(), names.end());
  if (const auto similar = nearest(name.text, names); !similar.empty())
    d.help("a similar name exists: `" + std::string(similar) + "`");
  return nullptr;
}

/// The path of a program's own variable; nothing if it has none of that name.
std::optional<Checker::PathTarget> Checker::ownVariable(const PouDecl &program, const Name &name,
                                                        Module &module) {
  const auto found = module.names.find(program.name.id);
  if (found == module.names.end() || found->second->kind != SymbolKind::pou)
    return std::nullopt;
  auto *pou = static_cast<PouSymbol *>(found->second);
  declare(pou);
  VarSymbol *variable = pou->isTemplate ? nullptr : findMember(pou->type, name.id);
  if (variable == nullptr || variable->section == Section::temp ||
      variable->section == Section::stat || variable->section == Section::external)
    return std::nullopt;
  PathTarget target;
  target.path = {pou, {{variable, 0}}};
  target.variable = variable;
  target.type = typeOf(variable);
  return target;
}

std::optional<Checker::PathTarget> Checker::resolvePath(Expr *expr, Module &module,
                                                        const PouDecl *inside) {
  const auto start = [&](const Name &name) -> std::optional<PathTarget> {
    if (auto own = inside == nullptr ? std::nullopt : ownVariable(*inside, name, module))
      return own;
    Symbol *root = pathRoot(name, module);
    if (root == nullptr)
      return std::nullopt;
    PathTarget target;
    target.path.root = root;
    if (root->kind == SymbolKind::variable) {
      target.variable = static_cast<VarSymbol *>(root);
      target.type = typeOf(target.variable);
    } else {
      declare(static_cast<PouSymbol *>(root));
      target.type = static_cast<PouSymbol *>(root)->type;
    }
    return target;
  };
  switch (expr->kind) {
  case ExprKind::name:
    return start(as<NameExpr>(expr)->name);
  case ExprKind::member: {
    auto *member = as<MemberExpr>(expr);
    if (!member->name)
      break;
    // In front may stand the configuration's, a resource's or a variable list's name.
    if (member->base->kind == ExprKind::name) {
      const Name &first = as<NameExpr>(member->base)->name;
      if (lookupInModule(module, first.id) == nullptr &&
          (resourceNames_.contains(first.id) || module.lists.contains(first.id)))
        return start(member->name);
    } else if (member->base->kind == ExprKind::member) {
      auto *second = as<MemberExpr>(member->base);
      if (second->base->kind == ExprKind::name && second->name &&
          resourceNames_.contains(as<NameExpr>(second->base)->name.id) &&
          resourceNames_.contains(second->name.id))
        return start(member->name);
    }
    auto base = resolvePath(member->base, module, inside);
    if (!base || isError(base->type))
      return std::nullopt;
    VarSymbol *found = findMember(base->type, member->name.id);
    if (found == nullptr || found->section == Section::inOut || found->section == Section::temp ||
        found->section == Section::stat || found->section == Section::external || found->isResult) {
      auto &d =
          report(Code::configPath, member->name.span,
                 "`" + typeName(base->type) + "` has no variable `" +
                     std::string(member->name.text) + "`" + (found != nullptr ? " of its own" : ""),
                 "not found");
      if (found == nullptr)
        helpMembers(d, member->name, memberNames(base->type));
      return std::nullopt;
    }
    base->type = typeOf(found);
    base->variable = found;
    base->path.steps.push_back({found, 0});
    return base;
  }
  case ExprKind::index: {
    auto *index = as<IndexExpr>(expr);
    auto base = resolvePath(index->base, module, inside);
    for (Expr *i : index->indices) {
      const auto value = constantInteger(i, "an index in a path");
      if (!value || !base || isError(base->type))
        return std::nullopt;
      if (base->type->kind != TypeKind::array) {
        report(Code::configPath, index->base->span, typeName(base->type) + " is not an array",
               "cannot be indexed");
        return std::nullopt;
      }
      const auto *array = typeAs<ArrayType>(base->type);
      if (*value < array->low || *value > array->high) {
        report(Code::configPath, i->span,
               "index " + std::to_string(*value) + " is outside of the array",
               "the bounds are " + std::to_string(array->low) + ".." + std::to_string(array->high));
        return std::nullopt;
      }
      base->path.steps.push_back({nullptr, static_cast<std::uint64_t>(*value - array->low)});
      base->type = array->element;
    }
    return base;
  }
  case ExprKind::error:
    return std::nullopt;
  default:
    break;
  }
  report(Code::configPath, expr->span, "this is not the path of a variable",
         "write `Program.instance.variable`");
  return std::nullopt;
}

void Checker::checkConfigEntry(VarDecl *decl, Module &module, std::vector<SlotPlace> &slots) {
  const auto target = resolvePath(decl->path, module);
  const Type *type = resolveType(decl->type, "config");
  if (!target || isError(type) || isError(target->type))
    return;
  VarSymbol *variable = target->variable;
  const std::string path = pathText(target->path);
  const auto mismatch = [&](Span where, std::string message, std::string label) {
    auto &d = report(Code::configMismatch, where, std::move(message), std::move(label));
    if (variable != nullptr)
      noteDeclaration(d, variable);
  };
  // What has an entry, be it wrong, is not missing.
  const std::string key = lowerCase(path);
  const auto slot = std::find_if(slots.begin(), slots.end(), [&](const SlotPlace &s) {
    return lowerCase(pathText(s.path)) == key;
  });
  if (slot != slots.end()) {
    if (slot->decl != nullptr) {
      auto &d = report(Code::configMismatch, decl->path->span, "`" + path + "` gets a place twice",
                       "placed again here");
      d.label(slot->decl->path->span, "placed first here");
      return;
    }
    slot->decl = decl;
  }
  if (type != target->type) {
    mismatch(decl->type->span,
             "`" + path + "` is " + typeName(target->type) + ", not " + typeName(type),
             "this type differs from the variable's");
    return;
  }
  if (decl->init != nullptr)
    decl->init = checkInit(decl->init, type);
  const bool isSlot = slot != slots.end();
  if (decl->address == nullptr) {
    if (isSlot)
      mismatch(decl->path->span, "the entry for `" + path + "` gives no address",
               "where does it lie?");
    else
      program_.slotPlaces.push_back({target->path, nullptr, {}, decl, true});
    return;
  }
  const DirectAddress &address = *decl->address;
  if (!isSlot) {
    mismatch(address.span, "`" + path + "` is not declared with `*`: it has a place already",
             "another place");
    return;
  }
  if (address.incomplete) {
    mismatch(address.span, "`" + std::string(address.text) + "` does not say where",
             "a number is needed here");
    return;
  }
  if (address.area != areaLetter(variable->location->area)) {
    mismatch(address.span,
             "`" + path + "` is declared as `%" + areaLetter(variable->location->area) +
                 "*` and cannot lie at `" + std::string(address.text) + "`",
             "another area");
    return;
  }
  const bool isBool = type->kind == TypeKind::boolean;
  const auto at = locate(address);
  if (!at)
    return;
  const StorageExtent extent = storage_.of(type);
  if ((at->bit >= 0) != isBool) {
    auto &d =
        report(Code::addressType, address.span,
               isBool ? "`" + std::string(address.text) + "` is no single bit"
                      : "`" + std::string(address.text) + "` is a single bit, `" + path + "` is " +
                            typeName(type),
               isBool ? "a BOOL declared with `*` needs a bit" : "only a BOOL fits into a bit");
    if (isBool)
      d.help("write the bit: `%" + std::string(1, address.area) + "X0.0`");
    return;
  }
  if (!isBool && at->byte % extent.align != 0) {
    report(Code::misaligned, address.span,
           "`" + path + "` must lie at a multiple of " + std::to_string(extent.align) + " bytes",
           "this is byte " + std::to_string(at->byte))
        .note("the code of a function block is the same for all instances");
    return;
  }
  if (!reserve(address, at->byte, isBool ? 1 : extent.size))
    return;
  slot->at = *at;
  slot->placed = true;
}

void Checker::reportMissingPlaces(const std::vector<SlotPlace> &slots) {
  std::map<const VarSymbol *, std::vector<const SlotPlace *>> missing;
  std::vector<const VarSymbol *> order;
  for (const SlotPlace &slot : slots) {
    if (slot.decl != nullptr)
      continue;
    auto &list = missing[slot.variable];
    if (list.empty())
      order.push_back(slot.variable);
    list.push_back(&slot);
  }
  std::array<std::uint64_t, 3> next{}; // proposals lie behind everything that is used
  for (std::size_t area = 0; area < next.size(); ++area)
    next[area] = program_.image.bytes[area];
  if (slots.size() > kMaxSlots) {
    const VarSymbol *v = slots.back().variable;
    report(Code::placeMissing, v->decl->address->span,
           "more than " + std::to_string(kMaxSlots) + " variables need a place of VAR_CONFIG",
           "`" + std::string(v->name.text) + "` is one of them, in each instance");
    return;
  }
  for (const VarSymbol *v : order) {
    const auto &list = missing[v];
    auto &d = report(Code::placeMissing, v->decl->address->span,
                     list.size() == 1 ? "`" + pathText(list.front()->path) + "` has no place"
                                      : "`" + std::string(v->name.text) + "` has no place in " +
                                            std::to_string(list.size()) + " instances",
                     "VAR_CONFIG must say where it lies");
    std::string text = "add\nVAR_CONFIG\n";
    std::uint64_t &free = next[static_cast<std::size_t>(v->location->area)];
    for (std::size_t i = 0; i < list.size() && i < kMaxShown; ++i) {
      Location at = *v->location;
      at.isSlot = false;
      const StorageExtent extent = storage_.of(v->type);
      free = (free + extent.align - 1) / extent.align * extent.align;
      at.byte = static_cast<std::uint32_t>(free);
      free += std::max<std::uint64_t>(extent.size, 1);
      text += "  " + pathText(list[i]->path) + " AT " +
              addressText(at, extent.align, program_.settings.addressing) + " : " +
              typeName(v->type) + ";\n";
    }
    if (list.size() > kMaxShown)
      text += "  // and " + std::to_string(list.size() - kMaxShown) + " more\n";
    d.help(text + "END_VAR");
  }
}

void Checker::checkConfigured(Module &module) {
  const ScopeGuard guard(*this, {&module, nullptr});
  std::vector<SlotPlace> slots;
  for (PouSymbol *pou : module.library->pous) {
    if (pou->decl->kind == DeclKind::program && !pou->isTemplate) {
      StatePath path{pou, {}};
      collectSlots(pou->type, path, slots);
    }
    for (const VarSymbol *v : pou->variables) {
      const bool perCall = pou->isFunction() || v->section == Section::temp;
      if ((perCall || v->section == Section::stat) && v->section != Section::inOut &&
          v->type != nullptr && hasSlots(v->type))
        report(Code::placeMissing, v->name.span,
               "no VAR_CONFIG can place the variables of `" + std::string(v->name.text) + "`",
               "`" + typeName(v->type) + "` has variables declared with `*`")
            .help("declare the instance in the VAR of a program or function block, or in "
                  "VAR_GLOBAL");
    }
  }
  for (GlobalsSymbol *list : module.library->globals) {
    for (VarSymbol *v : list->variables) {
      if (v->type == nullptr)
        continue;
      StatePath path{v, {}};
      if (v->location != nullptr && v->location->isSlot)
        slots.push_back({path, v, {}, nullptr, false});
      else
        collectSlots(v->type, path, slots);
    }
  }
  for (GlobalsDecl *list : configs_) {
    for (VarDecl *decl : list->variables) {
      if (decl->path != nullptr)
        checkConfigEntry(decl, module, slots);
    }
  }
  reportMissingPlaces(slots);
  for (SlotPlace &slot : slots) {
    if (slot.placed)
      program_.slotPlaces.push_back(std::move(slot));
  }
  checkAccesses(module);
}

void Checker::checkAccesses(Module &module) {
  std::unordered_map<Ident, const VarDecl *> names;
  for (GlobalsDecl *list : accesses_) {
    for (VarDecl *decl : list->variables) {
      const auto [first, fresh] = names.emplace(decl->name.id, decl);
      if (!fresh) {
        auto &d = report(Code::duplicateName, decl->name.span,
                         "the access path `" + std::string(decl->name.text) + "` is declared twice",
                         "declared again here");
        d.label(first->second->name.span, "first declared here");
        continue;
      }
      if (decl->path == nullptr || decl->type == nullptr)
        continue;
      const Type *type = resolveType(decl->type, "access");
      AccessPath access;
      access.decl = decl;
      if (decl->path->kind == ExprKind::direct) {
        auto *direct = as<DirectExpr>(decl->path);
        access.type = check(direct);
        access.location = direct->location;
      } else if (auto target = resolvePath(decl->path, module, list->program)) {
        access.path = std::move(target->path);
        access.type = target->type;
        if (target->variable != nullptr)
          access.location = target->variable->location;
        const auto inImage = [](const Symbol *s) {
          return s != nullptr && s->kind == SymbolKind::variable &&
                 static_cast<const VarSymbol *>(s)->location != nullptr;
        };
        bool inside = inImage(access.path.root) && access.path.root != target->variable;
        for (const PathStep &step : access.path.steps)
          inside = inside || (inImage(step.member) && step.member != target->variable) ||
                   (step.member == nullptr && access.location != nullptr);
        if (inside) {
          report(Code::configMismatch, decl->path->span,
                 "an access path cannot lead into a variable of the process image",
                 "a part of such a variable")
              .help("give the address of the part: `%MB4`");
          continue;
        }
        if (target->variable != nullptr && target->variable->isBit) {
          report(Code::configMismatch, decl->path->span, "an access path cannot lead to a BIT",
                 "a bit has no address")
              .help("declare `" + std::string(target->variable->name.text) + "` as BOOL");
          continue;
        }
        if (access.type->kind == TypeKind::reference || access.type->kind == TypeKind::pointer) {
          report(Code::configMismatch, decl->path->span, "an access path cannot lead to an address",
                 "this is " + typeName(access.type));
          continue;
        }
      }
      if (access.type == nullptr || isError(access.type) || isError(type))
        continue;
      if (type != access.type) {
        report(Code::configMismatch, decl->type->span,
               "`" + std::string(program_.sources.text(decl->path->span)) + "` is " +
                   typeName(access.type) + ", not " + typeName(type),
               "this type differs from the variable's");
        continue;
      }
      program_.accessPaths.push_back(std::move(access));
    }
  }
}

} // namespace stc
