// What several tasks use: what becomes atomic, and what is reported because nothing can make it
// one step.

#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/sharing/graph.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

bool counts(const NodeView &view, uint32_t task) {
  return view.tasks == nullptr || view.tasks->contains(task);
}

TaskUses together(const std::vector<NodeView> &views, bool inside) {
  TaskUses all;
  for (const NodeView &view : views) {
    for (const auto &[task, use] : inside ? view.node->inside : view.node->uses) {
      if (counts(view, task))
        all[task].merge(use);
    }
  }
  return all;
}

void add(TaskUses &to, const TaskUses &from, unsigned mask) {
  for (const auto &[task, use] : from) {
    if ((use.flags & mask) == 0)
      continue;
    TaskUse part = use;
    part.flags &= mask;
    to[task].merge(part);
  }
}

/// All that decides what a visit finds, but for the path that it names.
std::vector<uint64_t> keyOf(const std::vector<NodeView> &views, const TaskUses &inherited,
                            bool quiet) {
  std::vector<uint64_t> key{quiet ? 1U : 0U};
  for (const NodeView &view : views) {
    key.push_back(reinterpret_cast<uintptr_t>(view.node));
    key.push_back(view.tasks == nullptr ? ~uint64_t{0} : view.tasks->size());
    if (view.tasks != nullptr)
      key.insert(key.end(), view.tasks->begin(), view.tasks->end());
  }
  for (const auto &[task, use] : inherited)
    key.push_back(uint64_t{task} << 32U | use.flags);
  return key;
}

/// Instances of one block in the same situation that are looked at, and named in reports. They may
/// be many: instances of blocks that hold instances.
constexpr unsigned kMostAlike = 16;

Span firstOf(const TaskUse &use, bool writes) {
  if (writes && use.write.valid())
    return use.write;
  if (!writes && use.read.valid())
    return use.read;
  if (use.call.valid())
    return use.call;
  return use.write.valid() ? use.write : use.read;
}

} // namespace

bool SharingGraph::isUserPlace(Span span) const {
  return span.valid() && std::any_of(program_.files.begin(), program_.files.end(),
                                     [&](const File *file) { return file->id == span.file; });
}

void SharingGraph::visit(const std::vector<NodeView> &views, const Path &path,
                         const TaskUses &inherited, bool quiet) {
  const TaskUses inside = together(views, true);
  TaskUses users = inside;
  add(users, inherited, ~0U);
  if (users.size() < 2)
    return; // whatever is called there is called by one task
  if (++visits_[keyOf(views, inherited, quiet)] > kMostAlike)
    return;
  const TaskUses own = together(views, false);
  const Type *type = views.front().node->type;
  if (type != nullptr && isScalarValue(type)) {
    TaskUses all = own;
    add(all, inherited, ~0U);
    checkLeaf(*views.front().node, all);
    return;
  }
  if (!quiet)
    quiet = checkWhole(type, own, inside, path);
  TaskUses below = inherited;
  add(below, own, kInheritedAccess);
  visitInside(views, own, path, below, quiet);
}

void SharingGraph::visitInside(const std::vector<NodeView> &views, const TaskUses &own,
                               const Path &path, const TaskUses &inherited, bool quiet) {
  std::map<std::pair<const VarSymbol *, int64_t>, std::vector<NodeView>, DeclaredFirst> members;
  bool anyElement = false;
  for (const NodeView &view : views) {
    for (const auto &[step, child] : view.node->children)
      anyElement = anyElement || (step.first == nullptr && step.second == kAnyElement);
  }
  for (const NodeView &view : views) {
    for (const auto &[step, child] : view.node->children) {
      const bool any = anyElement && step.first == nullptr; // may be each of them
      members[{step.first, any ? kAnyElement : step.second}].push_back({child.get(), view.tasks});
    }
  }
  // What the body does to its own variables, for the tasks that call this instance.
  std::set<uint32_t> callers;
  for (const auto &[task, use] : own) {
    if ((use.flags & kAccessCall) != 0)
      callers.insert(task);
  }
  const Type *type = views.front().node->type;
  if (!callers.empty() && type != nullptr && isInstance(type)) {
    for (const PouSymbol *block = typeAs<PouType>(type)->symbol; block != nullptr;
         block = block->base) {
      for (const VarSymbol *v : block->variables) {
        if (const auto found = own_.find(v); found != own_.end())
          members[{v, 0}].push_back({found->second.get(), &callers});
      }
    }
  }
  std::map<uint32_t, Span> bitWriters;
  for (const auto &[step, memberViews] : members) {
    Path to = path;
    if (step.first != nullptr)
      to.text += "." + std::string(step.first->name.text);
    else
      to.text += step.second == kAnyElement ? "[…]" : "[" + std::to_string(step.second) + "]";
    if (step.first != nullptr && step.first->isBit) {
      for (const auto &[task, use] : together(memberViews, false)) {
        if (use.writes())
          bitWriters.try_emplace(task, use.write);
      }
    }
    visit(memberViews, to, inherited, quiet);
  }
  if (!quiet && bitWriters.size() > 1)
    reportBits(path, *bitWriters.begin(), *std::next(bitWriters.begin()));
}

void SharingGraph::checkLeaf(const PlaceNode &node, const TaskUses &uses) {
  bool shared = false;
  for (const auto &[writer, use] : uses) {
    if (!use.writes())
      continue;
    for (const auto &[other, otherUse] : uses)
      shared = shared || (other != writer && (otherUse.reads() || otherUse.writes()));
  }
  const VarSymbol *v = node.variable();
  if (!shared || v == nullptr)
    return;
  if (node.member != nullptr)
    program_.sharing.variables.insert(v);
  else
    program_.sharing.contents.insert(v);
}

/// Reports a conflict over the whole of an aggregate or an instance; true: there is one.
bool SharingGraph::checkWhole(const Type *type, const TaskUses &own, const TaskUses &inside,
                              const Path &path) {
  for (const auto &[task, use] : own) {
    for (const auto &[other, otherUse] : inside) {
      if (other == task)
        continue;
      const auto ownOther = own.find(other);
      const unsigned otherFlags = ownOther == own.end() ? 0 : ownOther->second.flags;
      if ((use.flags & otherFlags & kAccessCall) != 0) {
        reportInstance(path, {task, use}, {other, ownOther->second});
        return true;
      }
      if (isAxisType(type))
        continue;
      const bool otherWrites = otherUse.writes() || (otherUse.flags & kAccessCall) != 0;
      const bool writes =
          (use.flags & kAccessWholeWrite) != 0 || ((use.flags & otherFlags & kAccessUnknown) != 0);
      const bool reads = (use.flags & kAccessWholeRead) != 0;
      if (writes) {
        reportAggregate(path, {task, use}, {other, otherUse});
        return true;
      }
      if (reads && otherWrites) {
        reportAggregate(path, {other, otherUse}, {task, use});
        return true;
      }
    }
  }
  return false;
}

void SharingGraph::reportAggregate(const Path &path, const Use &writer, const Use &reader) {
  const Span written = firstOf(writer.second, true);
  const bool alsoWrites = reader.second.writes() && !reader.second.reads();
  const Span read = firstOf(reader.second, alsoWrites);
  const std::string &w = taskName(writer.first);
  const std::string &r = taskName(reader.first);
  const std::string verb = alsoWrites ? "written" : "read";
  const bool primary = isUserPlace(read);
  if (!primary && !isUserPlace(written))
    return;
  Diagnostic &d = program_.diagnostics.report(
      Code::SharedAggregate, primary ? read : written,
      "`" + path.text + "` is written in task `" + w + "` and " + verb + " in task `" + r +
          "`, but not in one step",
      primary ? verb + " in task `" + r + "`" : "written in task `" + w + "`");
  if (primary && isUserPlace(written))
    d.label(written, "written in task `" + w + "`");
  declaredAt(d, path);
  d.note("a cycle of one task may fall into the middle of the other's, which then finds a part of "
         "the old value and a part of the new one");
  d.help("do both in one task, or exchange single elementary variables and members: these are "
         "always whole");
  helpConsistent(d, path, read);
}

void SharingGraph::reportInstance(const Path &path, const Use &first, const Use &second) {
  const bool primary = isUserPlace(second.second.call);
  const Use &main = primary ? second : first;
  const Use &other = primary ? first : second;
  if (!isUserPlace(main.second.call))
    return; // tasks that call one PROGRAM: SE0822
  Diagnostic &d = program_.diagnostics.report(Code::SharedInstance, main.second.call,
                                              "`" + path.text + "` is called in two tasks, `" +
                                                  taskName(first.first) + "` and `" +
                                                  taskName(second.first) + "`",
                                              "called in task `" + taskName(main.first) + "`");
  if (isUserPlace(other.second.call))
    d.label(other.second.call, "called in task `" + taskName(other.first) + "`");
  declaredAt(d, path);
  d.note("an instance has one set of variables: a call of one task may fall into the middle of "
         "the other's call");
  d.help("give each task an instance of its own, or call it in one task and let the other use its "
         "inputs and outputs");
}

void SharingGraph::reportBits(const Path &path, const std::pair<const uint32_t, Span> &first,
                              const std::pair<const uint32_t, Span> &second) {
  if (!isUserPlace(second.second))
    return;
  Diagnostic &d = program_.diagnostics.report(Code::SharedAggregate, second.second,
                                              "two tasks, `" + taskName(first.first) + "` and `" +
                                                  taskName(second.first) + "`, write BITs of `" +
                                                  path.text + "`",
                                              "written in task `" + taskName(second.first) + "`");
  if (isUserPlace(first.second))
    d.label(first.second, "written in task `" + taskName(first.first) + "`");
  declaredAt(d, path);
  d.note("BITs share their byte: whoever writes one writes its neighbours back, and what another "
         "task has written meanwhile is lost");
  d.help("declare them as BOOL: each has a byte of its own then");
}

void SharingGraph::declaredAt(Diagnostic &d, const Path &path) const {
  if (isUserPlace(path.root->name.span))
    d.label(path.root->name.span, "`" + std::string(path.root->name.text) + "` is declared here");
}

void SharingGraph::reportOutputs() {
  const auto count = static_cast<uint32_t>(tasks_.size());
  constexpr auto kOutput = static_cast<size_t>(Area::Output);
  const auto where = [](const Bytes &bytes, uint32_t byte) {
    const auto behind = bytes.writeAt.upper_bound(byte);
    return behind == bytes.writeAt.begin() ? Span{} : std::prev(behind)->second;
  };
  for (uint32_t second = 1; second < count; ++second) {
    for (uint32_t first = 0; first < second; ++first) {
      const Bytes &a = image_[first][kOutput];
      const Bytes &b = image_[second][kOutput];
      for (uint32_t i = 0; i < a.write.size(); ++i) {
        if (!a.write[i] || !b.write[i])
          continue;
        Location at;
        at.area = Area::Output;
        at.byte = i;
        Diagnostic &d = program_.diagnostics.report(
            Code::OutputWriters, where(b, i),
            "output byte " + addressText(at, 1, program_.settings.addressing) +
                " is written by two tasks, `" + taskName(first) + "` and `" + taskName(second) +
                "`",
            "written in task `" + taskName(second) + "`");
        if (where(a, i).valid())
          d.label(where(a, i), "written in task `" + taskName(first) + "`");
        d.note("each task copies the output bytes that it writes to the device at the end of its "
               "cycle");
        d.help("write all outputs of the byte in one task; let the other task set a BOOL variable "
               "that this one copies");
        break; // one for each two tasks
      }
    }
  }
}

void SharingGraph::reportAxes(const DriveTask &taskOf) {
  const auto count = static_cast<uint32_t>(tasks_.size());
  for (uint32_t task = 0; task < count; ++task) {
    for (const PouSymbol *pou : reached_[task]) {
      for (const AxisCall &call : accessOf(pou).axes) {
        if (!isUserPlace(call.span))
          continue;
        for (const PlaceNode *node : nodesAt(call.axis, task)) {
          const VarSymbol *drive = node->parent == nullptr ? node->member : nullptr;
          const uint32_t own = drive == nullptr ? kNoTask : taskOf(drive);
          if (own == kNoTask || own == task)
            continue;
          const std::string name(call.block->name.text);
          Diagnostic &d = program_.diagnostics.report(
              Code::MotionTask, call.span,
              "`" + name + "` moves `" + std::string(drive->name.text) + "` in task `" +
                  taskName(task) + "`, but task `" + taskName(own) + "` serves the drive",
              "called in task `" + taskName(task) + "`");
          d.label(drive->name.span, "this drive belongs to task `" + taskName(own) + "`");
          d.note("a motion block that is not called in every cycle of the drive's task stops the "
                 "axis with error 30");
          d.help("call it in a PROGRAM of task `" + taskName(own) +
                 "`, or let `sTask` of the axis group name `" + taskName(task) + "`");
        }
      }
    }
  }
}

} // namespace stc
