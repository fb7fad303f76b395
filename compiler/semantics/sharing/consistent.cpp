// Which variables one task alone writes. Of those with {attribute 'consistent'} each other task
// that names one reads a copy of its own.

#include "compiler/semantics/sharing/graph.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

/// Events are asked in any task: code that they call reads what everyone reads.
void SharingGraph::findEvents() {
  std::vector<const PouSymbol *> open;
  for (const TaskEntry &task : tasks_) {
    for (const PouSymbol *pou : task.pous) {
      if (pou->decl->kind != DeclKind::Program)
        open.push_back(pou);
    }
  }
  while (!open.empty()) {
    const PouSymbol *pou = open.back();
    open.pop_back();
    if (!ofEvents_.insert(pou).second)
      continue;
    for (const CallEdge &call : accessOf(pou).calls) {
      for (const PouSymbol *called : implementations(call))
        open.push_back(called);
    }
  }
}

/// True: the access is to the task's own copy, and concerns nobody else.
bool SharingGraph::readsCopy(uint32_t task, const PouSymbol *pou, const PlaceAccess &access) {
  if (access.named == nullptr)
    return false;
  const auto *v = static_cast<const VarSymbol *>(access.place.symbol);
  if (!v->isConsistent || ofEvents_.contains(pou)) {
    namedReads_.emplace(access.span.file, access.span.begin);
    return false;
  }
  CopyReads &reads = copyReads_[v];
  reads.tasks.insert(task);
  reads.places.push_back(access.named);
  return true;
}

void SharingGraph::concludeWriters() {
  for (const auto &[symbol, node] : roots_) {
    uint32_t writer = kNoTask;
    unsigned writers = 0;
    for (const auto &[task, use] : node->inside) {
      if ((use.flags & (kAccessWrite | kAccessWholeWrite | kAccessUnknown | kAccessCall)) == 0)
        continue;
      writer = task;
      ++writers;
    }
    if (writers == 1)
      program_.sharing.writers.emplace(symbol, writer);
  }
}

void SharingGraph::concludeConsistent() {
  for (const Symbol *symbol : rootOrder_) {
    if (symbol->kind != SymbolKind::Variable ||
        !static_cast<const VarSymbol *>(symbol)->isConsistent)
      continue;
    const auto *v = static_cast<const VarSymbol *>(symbol);
    std::vector<std::pair<uint32_t, TaskUse>> writers;
    for (const auto &[task, use] : roots_.at(symbol)->inside) {
      if (use.writes())
        writers.emplace_back(task, use);
    }
    if (writers.size() > 1)
      reportConsistentWriters(v, writers[0], writers[1]);
    const auto reads = copyReads_.find(v);
    if (writers.size() != 1 || reads == copyReads_.end())
      continue;
    ConsistentVariable found{v, writers.front().first, {}};
    for (const uint32_t task : reads->second.tasks) {
      if (task != found.writer)
        found.readers.push_back(task);
    }
    if (found.readers.empty())
      continue;
    program_.sharing.consistent.push_back(std::move(found));
    program_.sharing.copies.insert(reads->second.places.begin(), reads->second.places.end());
  }
}

void SharingGraph::reportConsistentWriters(const VarSymbol *v, const Use &first,
                                           const Use &second) {
  const std::string name(v->name.text);
  Diagnostic &d = program_.diagnostics.report(
      Code::ConsistentWriters,
      isUserPlace(second.second.write) ? second.second.write : v->name.span,
      "`" + name + "` is declared 'consistent', but two tasks write it, `" + taskName(first.first) +
          "` and `" + taskName(second.first) + "`",
      isUserPlace(second.second.write) ? "written in task `" + taskName(second.first) + "`"
                                       : "written in both");
  if (isUserPlace(first.second.write))
    d.label(first.second.write, "written in task `" + taskName(first.first) + "`");
  if (isUserPlace(second.second.write))
    d.label(v->name.span, "`" + name + "` is declared here");
  d.note("the other tasks get the value that the writing task has at the end of its cycle: there "
         "can be only one");
  d.help("write it in one task, and give the other task a variable of its own that this one takes "
         "over");
}

/// How {attribute 'consistent'} would help, or why it did not.
void SharingGraph::helpConsistent(Diagnostic &d, const Path &path, Span read) const {
  if (path.root->kind != SymbolKind::Variable)
    return;
  const auto *v = static_cast<const VarSymbol *>(path.root);
  if (v->isConsistent) {
    d.help("'consistent' holds where `" + std::string(v->name.text) +
           "` is named, not for addresses of it: copy it into a variable first");
    return;
  }
  const bool user = v->library != nullptr && v->library->isUser;
  if (v->globals == nullptr || !user || v->location != nullptr || !isPlainData(v->type) ||
      !program_.sharing.writers.contains(v) || !namedReads_.contains({read.file, read.begin}))
    return;
  d.help("or write `{attribute 'consistent'}` before `" + std::string(v->name.text) +
         "`: other tasks then read the value that it had at the end of a cycle");
}

} // namespace stc
