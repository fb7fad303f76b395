#ifndef STRIDE_COMPILER_SEMANTICS_SHARING_HPP
#define STRIDE_COMPILER_SEMANTICS_SHARING_HPP
// Which tasks reach which variables: found by following the calls from the tasks' programs. It
// decides what generated code reads and writes atomically and what the runtime copies for a task.

#include "compiler/semantics/types.hpp"
#include "compiler/syntax/ast.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc {

struct Program;
struct Location;

/// A task and what it calls.
struct TaskEntry {
  std::string name;
  std::vector<const PouSymbol *> pous; ///< in the order of the calls
};

/// Bytes of the process image that a task uses.
struct ImageUse {
  uint32_t task = 0;
  uint8_t area = 0;    ///< Area
  bool writes = false; ///< else it reads them
  uint32_t first = 0;
  uint32_t count = 0;
};

inline constexpr uint32_t kNoTask = 0xFFFFFFFF;

/// A variable with {attribute 'consistent'} that other tasks than the one that writes it read.
struct ConsistentVariable {
  const VarSymbol *variable = nullptr;
  uint32_t writer = 0;
  std::vector<uint32_t> readers;
};

/// What a program's tasks have in common. Empty for a program with one task, but for imageUses and
/// writers.
struct Sharing {
  /// Variables and members with values that fit a register, written in one task and used in
  /// another: every access is atomic.
  std::unordered_set<const VarSymbol *> variables;
  /// The same for what is inside of them: elements of arrays, what pointers, references and in-outs
  /// lead to.
  std::unordered_set<const VarSymbol *> contents;
  /// By Area, then by byte.
  std::array<std::vector<bool>, 3> imageBytes;
  /// Sorted by task, area, direction and place.
  std::vector<ImageUse> imageUses;
  std::vector<ConsistentVariable> consistent;
  /// Where these are named and read: each task reads its own copy.
  std::unordered_set<const ast::Expr *> copies;
  /// The one task that writes (or calls) a global variable or program; absent: none, or several.
  std::unordered_map<const Symbol *, uint32_t> writers;

  [[nodiscard]] bool empty() const {
    return variables.empty() && contents.empty() && imageBytes[0].empty() &&
           imageBytes[1].empty() && imageBytes[2].empty();
  }
  /// Some of the bytes of the process image are shared.
  [[nodiscard]] bool shares(const Location &at, uint64_t bytes) const;
  /// The place that the expression names is read and written atomically.
  [[nodiscard]] bool holds(const ast::Expr *place) const;
};

/// The index of the task that serves a drive; kNoTask for what is none.
using DriveTask = std::function<uint32_t(const VarSymbol *drive)>;

/// Follows the calls of the tasks through a program without errors, notes the result in
/// program.sharing, and reports what several tasks must not share.
void findSharing(Program &program, const std::vector<TaskEntry> &tasks,
                 const DriveTask &taskOfDrive);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_SHARING_HPP
