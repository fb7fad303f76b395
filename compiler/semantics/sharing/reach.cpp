// Who calls whom: what a task reaches, what runs before all tasks, and which global variables and
// blocks that concerns.

#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/sharing/graph.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

std::vector<const PouSymbol *> SharingGraph::implementations(const CallEdge &call) const {
  std::vector<const PouSymbol *> result{call.pou};
  const PouSymbol *block = blockOf(call.pou);
  if (!call.open || (!block->isInterface() && !block->extended))
    return result;
  for (const PouSymbol *other : blocks_) {
    if (other == block || !convertsTo(other, block))
      continue;
    const PouSymbol *own = call.pou == block
                               ? (other->decl->kind == DeclKind::FunctionBlock ? other : nullptr)
                               : implementation(other, call.pou);
    if (own != nullptr && std::find(result.begin(), result.end(), own) == result.end())
      result.push_back(own);
  }
  return result;
}

void SharingGraph::closeOver(std::vector<const PouSymbol *> &all) {
  std::unordered_set<const PouSymbol *> known(all.begin(), all.end());
  for (size_t begin = 0; begin < all.size();) {
    const size_t end = all.size();
    readBodies(std::span(all).subspan(begin));
    for (; begin < end; ++begin) {
      for (const CallEdge &call : accessOf(all[begin]).calls) {
        for (const PouSymbol *pou : implementations(call))
          if (known.insert(pou).second)
            all.push_back(pou);
      }
    }
  }
}

void SharingGraph::reach(uint32_t task) {
  std::unordered_set<const PouSymbol *> known;
  for (const PouSymbol *pou : tasks_[task].pous)
    if (known.insert(pou).second)
      reached_[task].push_back(pou);
  closeOver(reached_[task]);
}

void SharingGraph::reachBefore() {
  for (const PouSymbol *block : blocks_)
    for (const PouSymbol *method : block->methods) {
      const std::string_view name = method->name.id->lower;
      if (name == "fb_init" || name == "fb_reinit" ||
          hasAttribute(method->decl->attributes, AttributeId::CallAfterInit))
        before_.push_back(method);
    }
  closeOver(before_);
}

void SharingGraph::findNamed() {
  std::unordered_set<const Symbol *> addressed;
  const auto takeAddresses = [&](const PouAccess &access) {
    for (const AddressFlow &flow : access.flows)
      if (flow.place.base == PlacePath::Base::Root)
        addressed.insert(flow.place.symbol);
  };
  takeAddresses(initial_);
  for (const PouSymbol *pou : before_)
    takeAddresses(accessOf(pou));
  named_.resize(tasks_.size());
  for (uint32_t task = 0; task < tasks_.size(); ++task) {
    std::unordered_set<const Symbol *> &named = named_[task];
    for (const PouSymbol *pou : reached_[task]) {
      for (const PouSymbol *block = blockOf(pou); block != nullptr; block = block->base)
        named.insert(block);
      const PouAccess &access = accessOf(pou);
      takeAddresses(access);
      const auto name = [&](const Symbol *symbol) {
        named.insert(symbol);
        if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
          return;
        if (const PouSymbol *owner = static_cast<const VarSymbol *>(symbol)->owner)
          named.insert(blockOf(owner)); // a member that is used from outside
      };
      for (const PlaceAccess &a : access.accesses) {
        name(a.place.symbol);
        for (const AccessStep &step : a.place.steps)
          name(step.member);
      }
      for (const AddressFlow &flow : access.flows) {
        name(flow.place.symbol);
        name(flow.from);
        name(flow.target);
      }
    }
  }
  for (std::unordered_set<const Symbol *> &named : named_)
    named.insert(addressed.begin(), addressed.end());
}

bool SharingGraph::concerns(uint32_t task, const AddressFlow &flow) const {
  return flow.declared == nullptr || named_[task].contains(flow.declared);
}

} // namespace stc
