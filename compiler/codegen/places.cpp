// Places that are no plain C++ variables: the process image, bits and parts.

#include "compiler/codegen/emitter.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

std::string_view Emitter::area(Area area) {
  static constexpr std::string_view kNames[] = {"image__i", "image__q", "image__m"};
  const auto index = static_cast<std::size_t>(area);
  areas_ |= 1U << index;
  usesContext_ = true;
  return kNames[index];
}

const Expr *Emitter::bitOwner(const Expr *e) {
  while (e->kind == ExprKind::member && as<MemberExpr>(e)->bit >= 0)
    e = as<MemberExpr>(e)->base;
  return e;
}

void Emitter::bitAccess(const Expr *e, bool writes) {
  const bool shared = isShared(bitOwner(e));
  const std::string_view kind = shared && writes ? "Shared" : "";
  const bool loads = shared && !writes;
  if (const Location *at = locationOf(e)) {
    const std::string_view base = area(at->area);
    if (!at->isSlot) {
      w_ << kind << "Bit(" << (loads ? "::stride::load(" : "") << base << '[' << at->byte
         << (loads ? "]), " : "], ") << int{at->bit};
      return;
    }
    w_ << (shared ? "SharedBitAt(" : "BitAt(") << base << ", ";
    if (e->kind == ExprKind::member && !isNamespace(as<MemberExpr>(e)->base))
      slotOf(as<MemberExpr>(e));
    else
      field(locatedVariable(e));
    return;
  }
  // `lw.%W1.%B0` is one part of lw.
  std::uint64_t first = 0;
  for (const Expr *part = e; part != bitOwner(e); part = as<MemberExpr>(part)->base)
    first += static_cast<std::uint64_t>(as<MemberExpr>(part)->bit) * as<MemberExpr>(part)->width;
  const unsigned width = as<MemberExpr>(e)->width;
  if (width == 1)
    w_ << kind << "Bit(";
  else
    w_ << kind << "Part<" << type(e->type) << ">(";
  w_ << (loads ? "::stride::load(" : "");
  place(bitOwner(e));
  w_ << (loads ? ")" : "") << ", " << first / width;
}

void Emitter::bitValue(const Expr *e) {
  w_ << "::stride::get";
  bitAccess(e, false);
  w_ << ')';
}

void Emitter::initLocated(std::string_view target, const VarSymbol *variable) {
  const Location &at = *variable->location;
  const Expr *init = c_.layouts.initOf(variable);
  if (at.bit >= 0) {
    if (init == nullptr)
      return;
    begin(initSpan_);
    const std::string_view base = area(at.area);
    if (at.isSlot)
      w_ << "::stride::setBitAt(" << base << ", " << target;
    else
      w_ << "::stride::setBit(" << base << '[' << at.byte << "], " << int{at.bit};
    w_ << ", ";
    valueAs(init, variable->type);
    w_ << ");";
    end();
    return;
  }
  const std::size_t start = w_.size();
  located(at, variable->type, [&] { w_ << target; });
  const std::string place = w_.cut(start);
  if (init == nullptr || init->kind == ExprKind::aggregate) {
    writtenDefault(place, variable->type, Layouts::written(variable));
    if (init != nullptr)
      initValue(place, variable->type, init);
    return;
  }
  begin(initSpan_);
  storeTo(place, variable->type, init);
  end();
}

void Emitter::initConfigured(const SlotPlace &entry) {
  initSpan_ = entry.decl->name.span.valid() ? entry.decl->name.span : entry.decl->path->span;
  const Expr *init = entry.decl->init;
  std::string place;
  const Type *type = init->target != nullptr ? init->target : init->type;
  if (entry.placed && entry.variable != nullptr) {
    type = entry.variable->type;
    if (entry.at.bit >= 0) {
      begin(initSpan_);
      w_ << "::stride::setBit(" << area(entry.at.area) << '[' << entry.at.byte << "], "
         << int{entry.at.bit} << ", ";
      valueAs(init, type);
      w_ << ");";
      end();
      return;
    }
    const std::size_t start = w_.size();
    located(entry.at, type, [] {});
    place = w_.cut(start);
  } else {
    const Root owner = rootOf(entry.path);
    const std::string_view reference = root(owner);
    type = entry.path.steps.empty() ? static_cast<const VarSymbol *>(entry.path.root)->type
                                    : typeAt(entry.path);
    const std::string path = statePath(c_.names, entry.path, c_.own);
    place = std::string(reference) + path.substr(rootName(c_.names, owner, c_.own).size());
  }
  if (init->kind == ExprKind::aggregate) {
    initValue(place, type, init);
    return;
  }
  begin(initSpan_);
  storeTo(place, type, init);
  end();
}

Root rootOf(const StatePath &path) {
  if (path.root->kind == SymbolKind::pou)
    return {path.root, false};
  return {static_cast<const VarSymbol *>(path.root)->globals, false};
}

const Type *typeAt(const StatePath &path) {
  const Type *type = path.root->kind == SymbolKind::pou
                         ? static_cast<const PouSymbol *>(path.root)->type
                         : static_cast<const VarSymbol *>(path.root)->type;
  for (const PathStep &step : path.steps)
    type = step.member != nullptr ? step.member->type : typeAs<ArrayType>(type)->element;
  return type;
}

std::string statePath(Names &names, const StatePath &path, const Library *own) {
  std::string text = rootName(names, rootOf(path), own);
  const Type *type = nullptr;
  if (path.root->kind == SymbolKind::variable) {
    text += "." + mangle(path.root->name.text);
    type = static_cast<const VarSymbol *>(path.root)->type;
  } else {
    type = static_cast<const PouSymbol *>(path.root)->type;
  }
  for (const PathStep &step : path.steps) {
    if (step.member == nullptr) {
      text += ".v[" + std::to_string(step.element) + "]";
      type = typeAs<ArrayType>(type)->element;
      continue;
    }
    text += ".";
    if (type->kind == TypeKind::structure) {
      for (const auto *s = typeAs<StructType>(type); s->base != nullptr; s = s->base) {
        if (std::find(s->fields.begin(), s->fields.end(), step.member) != s->fields.end())
          break;
        text += "base__.";
      }
    }
    if (isInstance(type) && step.member->owner != nullptr)
      text += pathToBase(typeAs<PouType>(type)->symbol, blockOf(step.member->owner));
    text += fieldName(step.member);
    type = step.member->type;
  }
  return text;
}

} // namespace stc::codegen
