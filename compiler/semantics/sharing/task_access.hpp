#ifndef STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_HPP
#define STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_HPP
// What one POU does to variables: its accesses, which addresses it passes on, whom it calls. The
// same whoever calls it; sharing.cpp puts it together for each task.

#include "compiler/semantics/builtins.hpp"
#include "compiler/semantics/plain_data.hpp"
#include "compiler/semantics/program.hpp"
#include "compiler/semantics/storage.hpp"

#include <limits>
#include <unordered_map>
#include <vector>

namespace stc {

/// Bits of an access.
enum AccessFlag : unsigned {
  kAccessRead = 1,       ///< a value that fits a register
  kAccessWrite = 2,      ///< the same
  kAccessWholeRead = 4,  ///< a string, an array, a structure, an instance as a whole
  kAccessWholeWrite = 8, ///< the same
  kAccessCall = 16,      ///< the body or a method of the instance runs
  kAccessUnknown = 32,   ///< native code or an address leads there: anything inside of it
};

/// What anything inside of it may be when an access has one of these bits.
inline constexpr unsigned kInheritedAccess = kAccessWholeRead | kAccessWholeWrite | kAccessUnknown;

/// One step from a variable to something inside of it.
struct AccessStep {
  const VarSymbol *member = nullptr; ///< null: an element
  int64_t element = 0;               ///< its index, or kAnyElement
  bool operator==(const AccessStep &) const = default;
};
inline constexpr int64_t kAnyElement = std::numeric_limits<int64_t>::min();

/// A place as the code of a POU names it.
struct PlacePath {
  enum class Base : uint8_t {
    None,    ///< a variable on the stack, or nothing that is known
    Root,    ///< a global variable, a VAR_STAT, a program
    Self,    ///< a variable of the instance that runs
    Address, ///< what `symbol` (a pointer, reference, in-out or interface) leads to
    Made,    ///< what `made`, a call of __NEW, makes
  };
  Base base = Base::None;
  const Symbol *symbol = nullptr;
  std::vector<AccessStep> steps;
  const ast::CallExpr *made = nullptr;
};

struct PlaceAccess {
  PlacePath place;
  unsigned flags = 0;
  Span span;
  /// Where a read names a global variable itself; null: it is written, or found by an address.
  const ast::Expr *named = nullptr;
};

/// `target` may lead to the place, or to wherever `from` leads.
struct AddressFlow {
  const VarSymbol *target = nullptr;
  PlacePath place;
  const VarSymbol *from = nullptr;
  /// Of initial values: the POU whose variable it is, or the global variable; null: any task's.
  const Symbol *declared = nullptr;
};

struct CallEdge {
  const PouSymbol *pou = nullptr;
  bool open = false; ///< the instance's type decides which method or body it is
};

struct ImageAccess {
  const Location *at = nullptr;
  const VarSymbol *slot = nullptr; ///< `AT %I*`: VAR_CONFIG says where
  uint64_t bytes = 1;
  bool writes = false;
  Span span;
  bool isNumber = false; ///< signed or real: its bits mean nothing by themselves
};

/// A call of a library's block with an axis.
struct AxisCall {
  const PouSymbol *block = nullptr;
  PlacePath axis;
  Span span;
};

struct PouAccess {
  std::vector<PlaceAccess> accesses;
  std::vector<AddressFlow> flows;
  std::vector<CallEdge> calls;
  std::vector<ImageAccess> image;
  std::vector<AxisCall> axes;
};

/// How much of a body's accesses is asked.
enum class AccessDetail : uint8_t {
  Places, ///< all of them, and where inside of a variable they are
  Writes, ///< which global variables and programs are written or called: those of a single task
};

/// What the body of a POU does.
[[nodiscard]] PouAccess readAccess(Storage &storage, const PouSymbol *pou, AccessDetail detail);
/// What initial values bind: they hold before any task runs.
[[nodiscard]] PouAccess readInitial(Storage &storage,
                                    const std::vector<const VarSymbol *> &variables);

} // namespace stc

#endif // STRIDE_COMPILER_SEMANTICS_SHARING_TASK_ACCESS_HPP
