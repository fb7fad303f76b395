#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_PRINTER_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_PRINTER_HPP
// What print.cpp works with: the text that grows, and the values on the wires.

#include "compiler/import/networks/expression.hpp"
#include "compiler/import/networks/network.hpp"
#include "compiler/import/networks/scope.hpp"
#include "compiler/import/networks/translation.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stc::import::networks {

/// Lines of statements and the variables declared for them.
class Writer {
public:
  void line(std::string_view text);
  /// `IF condition THEN`; nothing where the condition is TRUE.
  void open(const Expression &condition);
  void close(const Expression &condition);
  /// An empty line between what stands above and what follows.
  void gap();
  void declare(std::string name, std::string type);
  [[nodiscard]] std::string declarations() const;
  [[nodiscard]] const std::string &statements() const { return text_; }

private:
  std::string text_;
  size_t indent_ = 0;
  std::vector<Declared> declared_;
};

/// The values on the wires while the nodes are executed one after the other. A value is an
/// expression until something forces it into a variable.
class Values {
public:
  Values(const Body &body, Scope &scope, Writer &writer, Translation &result);

  /// What arrives at a pin; none: it is not connected.
  [[nodiscard]] std::optional<Expression> read(const InPin &pin, size_t line);
  /// The instance of an edge detection gets the value; what it says.
  [[nodiscard]] Expression edgeOf(Edge edge, const Expression &value, size_t line);
  /// A node was executed: what comes out. `further` counts readers that are no wires.
  void set(Wire from, Expression value, size_t further = 0);
  /// As set(), but always in a variable, with the given type.
  void setVariable(Wire from, const Expression &value, const std::string &type);
  /// A node was executed that wrote the variable of keptName() itself.
  void setKept(Wire from);
  /// Takes one use of an output's value, which is there.
  [[nodiscard]] Expression take(Wire from);
  /// The variable that holds an output's value from cycle to cycle.
  [[nodiscard]] std::string keptName(Wire from);
  /// A new variable with the value, assigned here.
  [[nodiscard]] Expression stored(std::string_view wish, const Expression &value,
                                  const std::string &type);
  /// Before these variables are written: values that read them and are still needed are stored.
  void beforeWriting(const std::set<std::string> &written);
  /// Before a place where execution may go elsewhere: all values are stored.
  void storeAll();
  [[nodiscard]] size_t readers(Wire from) const;
  [[nodiscard]] const std::vector<NodeIndex> &readingNodes(Wire from) const;
  /// Type of an output, from what it is or from what it is assigned to; empty: not known.
  [[nodiscard]] std::string typeOf(Wire from) const;

private:
  using Port = std::pair<NodeIndex, size_t>;
  struct Value {
    Expression expression;
    size_t uses = 0;
    bool stored = false; ///< in a variable of its own
  };
  [[nodiscard]] static Port portOf(Wire wire) { return {wire.node, wire.pin}; }
  [[nodiscard]] Expression wireValue(Wire wire);
  [[nodiscard]] bool mustBeStored(Wire from, const Expression &value, size_t uses) const;
  [[nodiscard]] bool reachesOneStatement(Wire from) const;
  [[nodiscard]] std::string expectedBy(const Node &reader, Wire from) const;
  [[nodiscard]] std::string wishFor(Wire from) const;
  bool store(Port port, Value &value);

  const Body &body_;
  Scope &scope_;
  Writer &writer_;
  Translation &result_;
  std::map<Port, std::vector<NodeIndex>> readers_;
  std::map<Port, Value> values_;
  std::map<Port, std::string> kept_;
};

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_PRINTER_HPP
