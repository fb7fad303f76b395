#ifndef STRIDE_COMPILER_SEMANTICS_SHARING_GRAPH_HPP
#define STRIDE_COMPILER_SEMANTICS_SHARING_GRAPH_HPP
// All places that tasks use, as trees below variables and programs, with who uses them how.

#include "compiler/semantics/sharing/task_access.hpp"

#include <map>
#include <memory>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc {

/// How one task uses a place; where it does each first.
struct TaskUse {
  unsigned flags = 0;
  Span read;
  Span write;
  Span call;
  void add(unsigned more, Span span);
  void merge(const TaskUse &other);
  [[nodiscard]] bool reads() const {
    return (flags & (kAccessRead | kAccessWholeRead | kAccessUnknown)) != 0;
  }
  [[nodiscard]] bool writes() const {
    return (flags & (kAccessWrite | kAccessWholeWrite | kAccessUnknown)) != 0;
  }
};
using TaskUses = std::map<uint32_t, TaskUse>;

/// A variable, or something inside of it.
struct PlaceNode {
  PlaceNode *parent = nullptr;
  const VarSymbol *member = nullptr; ///< null: an element, or a program
  int64_t element = 0;
  const Type *type = nullptr;
  TaskUses uses;   ///< of the place itself
  TaskUses inside; ///< of it and all below
  std::map<std::pair<const VarSymbol *, int64_t>, std::unique_ptr<PlaceNode>> children;

  PlaceNode &child(const AccessStep &step);
  void use(uint32_t task, unsigned flags, Span span);
  /// The last variable on the way to it.
  [[nodiscard]] const VarSymbol *variable() const;
};

/// By the place of the declaration, so that results do not depend on where symbols lie.
struct DeclaredFirst {
  template <class Rest>
  bool operator()(const std::pair<const VarSymbol *, Rest> &a,
                  const std::pair<const VarSymbol *, Rest> &b) const {
    return a.first != b.first ? isBefore(a.first, b.first) : a.second < b.second;
  }

private:
  static bool isBefore(const VarSymbol *a, const VarSymbol *b);
};

/// A node as the tasks in question use it.
struct NodeView {
  const PlaceNode *node = nullptr;
  const std::set<uint32_t> *tasks = nullptr; ///< null: all
};

/// An output as the program names it.
struct WrittenOutput {
  Location at;
  uint64_t bytes = 1;
  bool isNumber = false; ///< nobody looks at its bits
  bool operator<(const WrittenOutput &other) const;
};

class SharingGraph {
public:
  SharingGraph(Program &program, const std::vector<TaskEntry> &tasks);

  /// Follows all calls.
  void solve();
  /// Fills program.sharing and reports aggregates, instances and outputs that several tasks use.
  void conclude();
  /// Reports motion blocks that are called in other tasks.
  void reportAxes(const DriveTask &taskOf);

private:
  using Nodes = std::set<PlaceNode *>;

  const PouAccess &accessOf(const PouSymbol *pou);
  /// Those of them that have not been read, by several threads.
  void readBodies(std::span<const PouSymbol *const> pous);
  void reach(uint32_t task);
  /// What runs before the tasks, and between them in an online change: FB_Init and the like.
  void reachBefore();
  /// Adds what the POUs call.
  void closeOver(std::vector<const PouSymbol *> &all);
  [[nodiscard]] std::vector<const PouSymbol *> implementations(const CallEdge &call) const;
  /// Which variables' initial values and arguments for FB_Init concern a task.
  void findNamed();
  [[nodiscard]] bool concerns(uint32_t task, const AddressFlow &flow) const;
  bool flowOnce(uint32_t task, const PouAccess &access);
  [[nodiscard]] std::pair<const VarSymbol *, uint32_t> key(const VarSymbol *v, uint32_t task) const;
  Nodes nodesAt(const PlacePath &place, uint32_t task);
  PlaceNode &rootNode(const Symbol *symbol);
  PlaceNode &madeNode(const ast::CallExpr *call, uint32_t task);
  void useRoot(const PlaceAccess &access);
  void useImage(uint32_t task, const ImageAccess &access);
  void concludeImage();
  void concludeWriters();
  void concludeAddresses();

  // consistent.cpp
  void findEvents();
  bool readsCopy(uint32_t task, const PouSymbol *pou, const PlaceAccess &access);
  void concludeConsistent();

  struct Path {
    std::string text;
    const Symbol *root;
  };
  using Use = std::pair<uint32_t, TaskUse>;
  void visit(const std::vector<NodeView> &views, const Path &path, const TaskUses &inherited,
             bool quiet);
  void visitInside(const std::vector<NodeView> &views, const TaskUses &own, const Path &path,
                   const TaskUses &inherited, bool quiet);
  void checkLeaf(const PlaceNode &node, const TaskUses &uses);
  bool checkWhole(const Type *type, const TaskUses &own, const TaskUses &inside, const Path &path);
  void reportAggregate(const Path &path, const Use &writer, const Use &reader);
  void reportInstance(const Path &path, const Use &first, const Use &second);
  void reportBits(const Path &path, const std::pair<const uint32_t, Span> &first,
                  const std::pair<const uint32_t, Span> &second);
  void reportOutputs();

  // overlaps.cpp
  void noteOutput(uint32_t task, const Location &at, const ImageAccess &access);
  void reportOverlaps() const;
  void reportOverlap(const std::pair<const WrittenOutput, Span> &one,
                     const std::pair<const WrittenOutput, Span> &other) const;

  void reportConsistentWriters(const VarSymbol *v, const Use &first, const Use &second);
  void helpConsistent(Diagnostic &d, const Path &path, Span read) const;
  void declaredAt(Diagnostic &d, const Path &path) const;
  [[nodiscard]] bool isUserPlace(Span span) const;
  [[nodiscard]] const std::string &taskName(uint32_t task) const { return tasks_[task].name; }

  Program &program_;
  const std::vector<TaskEntry> &tasks_;
  Storage storage_;
  std::unordered_map<const PouSymbol *, PouAccess> read_;
  PouAccess initial_;
  std::vector<std::vector<const PouSymbol *>> reached_; ///< by task
  /// By task: the blocks whose code runs, and the global variables that it names or anybody's
  /// address may lead to.
  std::vector<std::unordered_set<const Symbol *>> named_;
  std::vector<const PouSymbol *> before_; ///< before the tasks: the addresses that it keeps count
  std::vector<PouSymbol *> blocks_;       ///< all of the program
  std::unordered_map<const Symbol *, std::unique_ptr<PlaceNode>> roots_;
  std::vector<const Symbol *> rootOrder_;
  /// Objects of __NEW, by the place of the call and the task that makes them.
  std::map<std::tuple<FileId, uint32_t, uint32_t>, std::unique_ptr<PlaceNode>> made_;
  /// What the bodies of blocks and programs do to their own variables, for all instances.
  std::unordered_map<const Symbol *, std::unique_ptr<PlaceNode>> own_;
  std::map<std::pair<const VarSymbol *, uint32_t>, Nodes, DeclaredFirst> leads_;
  std::unordered_set<const PouSymbol *> ofEvents_; ///< what asking an event calls
  struct CopyReads {
    std::set<uint32_t> tasks;
    std::vector<const ast::Expr *> places; ///< that name the variable
  };
  std::unordered_map<const VarSymbol *, CopyReads> copyReads_; ///< of 'consistent' variables
  std::set<std::pair<FileId, uint32_t>> namedReads_;           ///< where others are named
  struct Bytes {
    std::vector<bool> read;
    std::vector<bool> write;
    std::map<uint32_t, Span> writeAt; ///< by first byte: where
  };
  std::vector<std::array<Bytes, 3>> image_;            ///< by task, area
  std::vector<std::map<WrittenOutput, Span>> outputs_; ///< by task: where each is written first
  std::map<std::vector<uint64_t>, unsigned> visits_;   ///< of visit(): what it was given
};

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_SHARING_GRAPH_HPP
