#ifndef STRIDE_COMPILER_IMPORT_EXP_TASKS_HPP
#define STRIDE_COMPILER_IMPORT_EXP_TASKS_HPP
// RESOURCE of a CoDeSys V2.3 export: tasks and system events.

#include "compiler/import/model.hpp"

#include <string>
#include <vector>

namespace stc::import {

/// Adds the tasks between RESOURCE and END_RESOURCE. `origin`: of the first line.
void readExpTasks(const std::vector<std::string> &lines, const Origin &origin, Model &model);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_EXP_TASKS_HPP
