// The kinds of tasks in words.
#ifndef STRIDE_RUNTIME_TASK_TASK_KIND_HPP
#define STRIDE_RUNTIME_TASK_TASK_KIND_HPP

#include "runtime/app/abi.h"

namespace stride::task {

/// As stride.toml spells it: "cyclic", "freewheeling", "event", "status".
inline const char *kindName(TaskKind kind) noexcept {
  switch (kind) {
  case TaskKind::Cyclic:
    return "cyclic";
  case TaskKind::Freewheeling:
    return "freewheeling";
  case TaskKind::Event:
    return "event";
  case TaskKind::Status:
    return "status";
  }
  return "unknown";
}

} // namespace stride::task

#endif
