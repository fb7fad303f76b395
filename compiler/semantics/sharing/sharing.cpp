#include "compiler/semantics/sharing.hpp"

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/sharing/graph.hpp"
#include "compiler/source/workers.hpp"

#include <algorithm>
#include <tuple>

namespace stc {

using namespace ast;

namespace {

constexpr int kMaxDepth = 32;

const Type *memberType(const Type *type) {
  while (type != nullptr && type->kind == TypeKind::Reference)
    type = typeAs<PointerType>(type)->pointee;
  return type;
}

bool isSharedVariable(const Sharing &sharing, const VarSymbol *v) {
  const bool alias = v->section == Section::InOut || v->type->kind == TypeKind::Reference;
  return alias ? sharing.contents.contains(v) : sharing.variables.contains(v);
}

/// Of its text.
size_t bytesOf(Block block) {
  return block.empty() ? 0 : block.back()->span.end - block.front()->span.begin;
}

const VarSymbol *variableOf(const Expr *e) {
  const Symbol *symbol = e->kind == ExprKind::Name     ? as<NameExpr>(e)->symbol
                         : e->kind == ExprKind::Member ? as<MemberExpr>(e)->symbol
                                                       : nullptr;
  return symbol != nullptr && symbol->kind == SymbolKind::Variable
             ? static_cast<const VarSymbol *>(symbol)
             : nullptr;
}

} // namespace

// ----------------------------------------------------------------------------------------------------
// the result

bool Sharing::shares(const Location &at, uint64_t bytes) const {
  const std::vector<bool> &area = imageBytes[static_cast<size_t>(at.area)];
  for (uint64_t i = at.byte; i < at.byte + bytes && i < area.size(); ++i) {
    if (area[i])
      return true;
  }
  return false;
}

bool Sharing::holds(const Expr *e) const {
  if (empty() || e->type == nullptr || e->constant != nullptr)
    return false;
  if (!isScalarValue(e->type))
    return false;
  if (const Location *at = locationOf(e)) {
    if (at->isSlot)
      return variables.contains(locatedVariable(e));
    const uint64_t bytes = at->bit >= 0 ? 1 : std::max<uint64_t>(bitWidth(e->type) / 8, 1);
    return at->byte % bytes == 0 && shares(*at, bytes);
  }
  switch (e->kind) {
  case ExprKind::Name:
  case ExprKind::Member: {
    const VarSymbol *v = variableOf(e);
    return v != nullptr && !v->isBit && isSharedVariable(*this, v) && !isMisaligned(e);
  }
  case ExprKind::Index: {
    const Expr *base = as<IndexExpr>(e)->base;
    const Type *type = memberType(base->type);
    if (type != nullptr && isString(type))
      return false;
    const VarSymbol *v = variableOf(base);
    return v != nullptr && contents.contains(v) && !isMisaligned(e);
  }
  case ExprKind::Deref: {
    const Expr *pointer = as<DerefExpr>(e)->base;
    while (pointer->kind == ExprKind::Index)
      pointer = as<IndexExpr>(pointer)->base;
    const VarSymbol *v = variableOf(pointer);
    return v != nullptr && contents.contains(v);
  }
  default:
    return false;
  }
}

void TaskUse::add(unsigned more, Span span) {
  flags |= more;
  if ((more & (kAccessRead | kAccessWholeRead)) != 0 && !read.valid())
    read = span;
  if ((more & (kAccessWrite | kAccessWholeWrite | kAccessUnknown)) != 0 && !write.valid())
    write = span;
  if ((more & kAccessUnknown) != 0 && !read.valid())
    read = span;
  if ((more & kAccessCall) != 0 && !call.valid())
    call = span;
}

void TaskUse::merge(const TaskUse &other) {
  flags |= other.flags;
  if (!read.valid())
    read = other.read;
  if (!write.valid())
    write = other.write;
  if (!call.valid())
    call = other.call;
}

// ----------------------------------------------------------------------------------------------------
// the trees

bool DeclaredFirst::isBefore(const VarSymbol *a, const VarSymbol *b) {
  if (a == nullptr || b == nullptr)
    return a == nullptr && b != nullptr;
  const auto place = [](const VarSymbol *v) {
    return std::tuple(v->name.span.file, v->name.span.begin, v->name.id->lower, v);
  };
  return place(a) < place(b);
}

PlaceNode &PlaceNode::child(const AccessStep &step) {
  int depth = 0;
  for (const PlaceNode *n = this; n != nullptr; n = n->parent)
    ++depth;
  if (depth > kMaxDepth)
    return *this;
  std::unique_ptr<PlaceNode> &found = children[{step.member, step.element}];
  if (found == nullptr) {
    found = std::make_unique<PlaceNode>();
    found->parent = this;
    found->member = step.member;
    found->element = step.element;
    found->type = step.member != nullptr ? memberType(step.member->type)
                  : type == nullptr      ? nullptr
                                         : indexStep(type);
  }
  return *found;
}

void PlaceNode::use(uint32_t task, unsigned flags, Span span) {
  uses[task].add(flags, span);
  for (PlaceNode *n = this; n != nullptr; n = n->parent)
    n->inside[task].add(flags, span);
}

const VarSymbol *PlaceNode::variable() const {
  const PlaceNode *n = this;
  while (n != nullptr && n->member == nullptr)
    n = n->parent;
  return n == nullptr ? nullptr : n->member;
}

// ----------------------------------------------------------------------------------------------------
// who calls whom

SharingGraph::SharingGraph(Program &program, const std::vector<TaskEntry> &tasks)
    : program_(program), tasks_(tasks), reached_(tasks.size()), image_(tasks.size()),
      outputs_(tasks.size()) {
  std::vector<const VarSymbol *> variables;
  const auto addVariables = [&](const PouSymbol *pou) {
    variables.insert(variables.end(), pou->variables.begin(), pou->variables.end());
  };
  for (const std::unique_ptr<Library> &library : program.libraries) {
    for (PouSymbol *pou : library->pous) {
      if (pou->isBlock())
        blocks_.push_back(pou);
      addVariables(pou);
      for (const PouSymbol *method : pou->methods)
        addVariables(method);
    }
    for (const GlobalsSymbol *list : library->globals)
      variables.insert(variables.end(), list->variables.begin(), list->variables.end());
  }
  if (tasks.size() > 1)
    initial_ = readInitial(storage_, variables);
  for (std::array<Bytes, 3> &areas : image_) {
    for (size_t area = 0; area < 3; ++area) {
      areas[area].read.resize(program.image.bytes[area]);
      areas[area].write.resize(program.image.bytes[area]);
    }
  }
}

const PouAccess &SharingGraph::accessOf(const PouSymbol *pou) {
  if (const auto found = read_.find(pou); found != read_.end())
    return found->second;
  readBodies({&pou, 1});
  return read_.at(pou);
}

void SharingGraph::readBodies(std::span<const PouSymbol *const> pous) {
  std::vector<const PouSymbol *> fresh;
  size_t bytes = 0;
  for (const PouSymbol *pou : pous) {
    if (!read_.try_emplace(pou).second || !pou->checked || pou->decl->external)
      continue;
    fresh.push_back(pou);
    bytes += bytesOf(pou->decl->body);
  }
  // Of a single task only what it writes is asked.
  const AccessDetail detail = tasks_.size() == 1 ? AccessDetail::Writes : AccessDetail::Places;
  const unsigned threads = Workers(program_.settings.jobs).threadsFor(fresh.size(), bytes);
  std::vector<Storage> others(threads - 1);
  Workers::each(fresh.size(), threads, [&](size_t i, unsigned thread) {
    read_.at(fresh[i]) = readAccess(thread == 0 ? storage_ : others[thread - 1], fresh[i], detail);
  });
}

// ----------------------------------------------------------------------------------------------------
// where addresses lead

/// An address that is kept in a variable of the whole project leads for every task wherever one of
/// them has let it lead; those of blocks and functions are told apart by task.
std::pair<const VarSymbol *, uint32_t> SharingGraph::key(const VarSymbol *v, uint32_t task) const {
  const bool ofAll = v->owner == nullptr || v->section == Section::Stat ||
                     v->owner->decl->kind == DeclKind::Program;
  return {v, ofAll ? kNoTask : task};
}

PlaceNode &SharingGraph::rootNode(const Symbol *symbol) {
  std::unique_ptr<PlaceNode> &node = roots_[symbol];
  if (node == nullptr) {
    node = std::make_unique<PlaceNode>();
    rootOrder_.push_back(symbol);
    if (symbol->kind == SymbolKind::Variable) {
      node->member = static_cast<const VarSymbol *>(symbol);
      node->type = memberType(node->member->type);
    } else {
      node->type = static_cast<const PouSymbol *>(symbol)->type;
    }
  }
  return *node;
}

PlaceNode &SharingGraph::madeNode(const CallExpr *call, uint32_t task) {
  std::unique_ptr<PlaceNode> &node = made_[{call->span.file, call->span.begin, task}];
  if (node == nullptr) {
    node = std::make_unique<PlaceNode>();
    node->type = memberType(typeAs<PointerType>(call->type)->pointee);
  }
  return *node;
}

SharingGraph::Nodes SharingGraph::nodesAt(const PlacePath &place, uint32_t task) {
  Nodes nodes;
  switch (place.base) {
  case PlacePath::Base::None:
    return nodes;
  case PlacePath::Base::Root:
    nodes.insert(&rootNode(place.symbol));
    break;
  case PlacePath::Base::Self: {
    if (place.symbol == nullptr)
      return nodes;
    std::unique_ptr<PlaceNode> &node = own_[place.symbol];
    if (node == nullptr) {
      node = std::make_unique<PlaceNode>();
      node->member = static_cast<const VarSymbol *>(place.symbol);
      node->type = memberType(node->member->type);
    }
    nodes.insert(node.get());
    break;
  }
  case PlacePath::Base::Address: {
    const auto found = leads_.find(key(static_cast<const VarSymbol *>(place.symbol), task));
    if (found == leads_.end())
      return nodes;
    nodes = found->second;
    break;
  }
  case PlacePath::Base::Made:
    nodes.insert(&madeNode(place.made, task));
    break;
  }
  for (const AccessStep &step : place.steps) {
    Nodes next;
    for (PlaceNode *node : nodes)
      next.insert(&node->child(step));
    nodes = std::move(next);
  }
  return nodes;
}

bool SharingGraph::flowOnce(uint32_t task, const PouAccess &access) {
  bool changed = false;
  for (const AddressFlow &flow : access.flows) {
    if (!concerns(task, flow))
      continue;
    Nodes from;
    if (flow.from != nullptr) {
      const auto found = leads_.find(key(flow.from, task));
      if (found == leads_.end())
        continue;
      from = found->second;
    } else {
      from = nodesAt(flow.place, task);
    }
    Nodes &to = leads_[key(flow.target, task)];
    for (PlaceNode *node : from)
      changed = to.insert(node).second || changed;
  }
  return changed;
}

/// Where in a variable or program a single task writes, and by which address, does not matter.
void SharingGraph::useRoot(const PlaceAccess &access) {
  if (access.place.base == PlacePath::Base::Root)
    rootNode(access.place.symbol).use(0, access.flags, access.span);
}

void SharingGraph::solve() {
  const auto count = static_cast<uint32_t>(tasks_.size());
  for (uint32_t task = 0; task < count; ++task)
    reach(task);
  if (count > 1) {
    reachBefore();
    findNamed();
    constexpr int kRounds = 100; // chains of pointers are not longer
    bool changed = true;
    for (int round = 0; changed && round < kRounds; ++round) {
      changed = false;
      for (uint32_t task = 0; task < count; ++task) {
        changed = flowOnce(task, initial_) || changed;
        for (const PouSymbol *pou : before_)
          changed = flowOnce(task, accessOf(pou)) || changed;
        for (const PouSymbol *pou : reached_[task])
          changed = flowOnce(task, accessOf(pou)) || changed;
      }
    }
  }
  findEvents();
  for (uint32_t task = 0; task < count; ++task) {
    for (const PouSymbol *pou : tasks_[task].pous) {
      if (pou->decl->kind == DeclKind::Program)
        rootNode(pou).use(task, kAccessCall, {});
    }
    for (const PouSymbol *pou : reached_[task]) {
      const PouAccess &access = accessOf(pou);
      for (const PlaceAccess &a : access.accesses) {
        if (count == 1)
          useRoot(a);
        else if (!readsCopy(task, pou, a))
          for (PlaceNode *node : nodesAt(a.place, task))
            node->use(task, a.flags, a.span);
      }
      for (const ImageAccess &a : access.image)
        useImage(task, a);
    }
  }
}

// ----------------------------------------------------------------------------------------------------
// the process image

void SharingGraph::useImage(uint32_t task, const ImageAccess &access) {
  const auto mark = [&](const Location &at) {
    const uint64_t first = at.byte;
    Bytes &bytes = image_[task][static_cast<size_t>(at.area)];
    std::vector<bool> &used = access.writes ? bytes.write : bytes.read;
    for (uint64_t i = first; i < first + access.bytes && i < used.size(); ++i)
      used[i] = true;
    if (!access.writes)
      return;
    bytes.writeAt.try_emplace(at.byte, access.span);
    noteOutput(task, at, access);
  };
  if (access.slot == nullptr) {
    mark(*access.at);
    return;
  }
  for (const SlotPlace &slot : program_.slotPlaces) {
    if (slot.variable == access.slot && slot.placed)
      mark(slot.at);
  }
}

void SharingGraph::concludeImage() {
  Sharing &sharing = program_.sharing;
  const auto count = static_cast<uint32_t>(tasks_.size());
  for (uint32_t task = 0; task < count; ++task) {
    for (size_t area = 0; area < 3; ++area) {
      for (const bool writes : {false, true}) {
        const Bytes &bytes = image_[task][area];
        const std::vector<bool> &used = writes ? bytes.write : bytes.read;
        for (size_t i = 0; i < used.size(); ++i) {
          if (!used[i])
            continue;
          size_t end = i;
          while (end < used.size() && used[end])
            ++end;
          sharing.imageUses.push_back({task, static_cast<uint8_t>(area), writes,
                                       static_cast<uint32_t>(i), static_cast<uint32_t>(end - i)});
          i = end;
        }
      }
    }
  }
  if (count < 2)
    return;
  for (size_t area = 0; area < 3; ++area) {
    const size_t size = program_.image.bytes[area];
    std::vector<bool> shared(size);
    for (size_t i = 0; i < size; ++i) {
      unsigned users = 0;
      bool written = area == static_cast<size_t>(Area::Input); // by the devices
      for (uint32_t task = 0; task < count; ++task) {
        const Bytes &bytes = image_[task][area];
        written = written || bytes.write[i];
        users += bytes.write[i] || bytes.read[i] ? 1U : 0U;
      }
      shared[i] = written && users > 1;
    }
    if (std::find(shared.begin(), shared.end(), true) != shared.end())
      sharing.imageBytes[area] = std::move(shared);
  }
  for (const SlotPlace &slot : program_.slotPlaces) {
    if (slot.variable != nullptr && slot.placed &&
        sharing.shares(slot.at, slot.at.bit >= 0 ? 1 : storage_.of(slot.variable->type).size))
      sharing.variables.insert(slot.variable);
  }
}

// ----------------------------------------------------------------------------------------------------
// conclusions

/// Whoever follows an address to something shared does it atomically, too.
void SharingGraph::concludeAddresses() {
  Sharing &sharing = program_.sharing;
  for (const auto &[key, nodes] : leads_) {
    for (const PlaceNode *node : nodes) {
      const VarSymbol *v = node->variable();
      if (v == nullptr)
        continue;
      const bool element = node->member == nullptr;
      const bool array = node->type != nullptr && node->type->kind == TypeKind::Array;
      if (element || array ? sharing.contents.contains(v) : sharing.variables.contains(v))
        sharing.contents.insert(key.first);
    }
  }
}

/// What an object of __NEW is declared as; null: a number or text, which no member leads to.
static const Symbol *symbolOfType(const Type *type) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (isInstance(type))
    return typeAs<PouType>(type)->symbol;
  return type->kind == TypeKind::Structure ? typeAs<StructType>(type)->symbol : nullptr;
}

void SharingGraph::conclude() {
  concludeImage();
  reportOverlaps();
  concludeWriters();
  if (tasks_.size() < 2)
    return;
  concludeConsistent();
  for (const Symbol *symbol : rootOrder_)
    visit({{roots_.at(symbol).get(), nullptr}}, {std::string(symbol->name.text), symbol}, {},
          false);
  for (const auto &[place, node] : made_)
    if (const Symbol *type = symbolOfType(node->type); type != nullptr)
      visit({{node.get(), nullptr}}, {"__NEW(" + std::string(type->name.text) + ")", type}, {},
            false);
  concludeAddresses();
  reportOutputs();
}

void findSharing(Program &program, const std::vector<TaskEntry> &tasks,
                 const DriveTask &taskOfDrive) {
  SharingGraph graph(program, tasks);
  graph.solve();
  graph.conclude();
  if (tasks.size() > 1)
    graph.reportAxes(taskOfDrive);
}

} // namespace stc
