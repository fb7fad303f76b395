#ifndef STRIDE_COMPILER_IMPORT_DRAWN_BODIES_HPP
#define STRIDE_COMPILER_IMPORT_DRAWN_BODIES_HPP
// Bodies that are drawn (LD, FBD, CFC): readers leave a mark, and when all files are read,
// statements take its place. What the blocks around declare is known only then.

#include "compiler/import/model.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace stc::import {

/// Makes statements with the declarations around the body; the POU has been entered.
using DrawnTranslator = std::function<networks::Translation(networks::Scope &)>;

/// Notes a body that is drawn and returns the line that stands for it in the POU's text, directly
/// after the POU's (or the action's, the method's) declarations. `kind` is `LD`, `FBD` or `CFC`;
/// `kept` is the body's text, which is kept where it cannot be translated (empty path: nothing is).
/// Lines of its problems are lines of the file.
[[nodiscard]] std::string markDrawnBody(Model &model, Origin origin, std::string object,
                                        std::string kind, DrawnTranslator translate,
                                        KeptText kept = {});

/// Puts statements in the place of all marks; variables that they need are added to the POU's.
/// Where there are none, `{error …}` stands there, so that nothing is lost in silence. `libraries`
/// are texts with the declarations of libraries' blocks.
void translateDrawnBodies(Model &model, std::span<const std::string_view> libraries);

} // namespace stc::import

#endif // STRIDE_COMPILER_IMPORT_DRAWN_BODIES_HPP
