#ifndef STRIDE_COMPILER_IMPORT_PLCOPEN_CONDITIONS_HPP
#define STRIDE_COMPILER_IMPORT_PLCOPEN_CONDITIONS_HPP
// Conditions of a chart's transitions that are drawn with blocks. Internal to compiler/import.

#include "compiler/import/plcopen_context.hpp"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stc::import::plcopen {

/// Elements of a chart by their localId.
using ChartElements = std::map<std::string, Node>;

/// Makes expressions of drawn conditions. A drawing that is an expression becomes one in the
/// transition. What needs statements (function blocks, edges) is computed by an action of the chart
/// that runs in each cycle: the transition reads a variable with the result.
class DrawnConditions {
public:
  DrawnConditions(Context &context, const Node &pou, std::string object)
      : context_(context), pou_(pou), object_(std::move(object)) {}

  /// The condition at the end of the lines that lead to `condition`, which is in `transition`.
  [[nodiscard]] std::string ofLines(const Node &transition, const Node &condition,
                                    const ChartElements &elements);
  /// The condition that a drawing assigns to the transition's name; empty: it assigns none.
  [[nodiscard]] std::string ofBody(const Node &body, const Node &transition, std::string_view name);
  /// Adds the action to the POU's members, and gives its name; empty: no condition needs one.
  [[nodiscard]] std::string finish(std::string &members);
  /// A name like `wish` that is nowhere in the POU; it is in use from now on.
  [[nodiscard]] std::string freshName(const std::string &wish);

private:
  struct Drawing {
    std::vector<Node> elements;
    Node output; ///< assigns the condition; null: `condition` is where the lines end
    Node condition;
    Node transition;
    std::string prefix; ///< of localIds: other drawings may have the same ones
  };
  std::string valueOf(const Drawing &drawing);
  void copy(const Drawing &drawing, const std::string &target, Node into,
            std::set<std::string> &known) const;
  void readNames(const Node &node);

  Context &context_;
  const Node pou_;
  const std::string object_;
  pugi::xml_document all_;              ///< the drawings that need statements
  std::set<std::string> known_;         ///< localIds in it
  std::map<std::string, size_t> lines_; ///< of these in the file
  std::vector<std::string> results_;    ///< names of variables
  std::set<std::string> names_;         ///< lower case; empty: not read yet
  size_t drawings_ = 0;
};

} // namespace stc::import::plcopen

#endif // STRIDE_COMPILER_IMPORT_PLCOPEN_CONDITIONS_HPP
