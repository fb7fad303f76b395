#ifndef STRIDE_COMPILER_IMPORT_NETWORKS_NETWORK_HPP
#define STRIDE_COMPILER_IMPORT_NETWORKS_NETWORK_HPP
// Drawn bodies as nodes with pins and wires, whatever file they come from.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace stc::import::networks {

using NodeIndex = size_t; ///< in Body::nodes

/// Edge detection at a pin, a contact or a coil.
enum class Edge { None, Rising, Falling };

/// How an output stores: assignment, set while TRUE, reset while TRUE.
enum class Storage { None, Set, Reset };

/// What a node is.
enum class NodeKind {
  Input,   ///< an expression that others read
  Output,  ///< a variable that is assigned; InOut: also read
  InOut,   ///< a variable for a pin of VAR_IN_OUT
  Contact, ///< passes its input on while the variable is TRUE
  Coil,    ///< stores its input and passes it on
  Rail,    ///< the left power rail
  Value,   ///< a box that is an operator or a function
  Call,    ///< a box that calls an instance, a program or an action
  Code,    ///< a box with statements inside (EXECUTE)
  Link,    ///< a connector (with an input) or a continuation (without), joined by the name
  Jump,
  Return,
  Label,
  Comment,
};

/// The end of a wire at the node that it comes from.
struct Wire {
  NodeIndex node = 0;
  size_t pin = 0; ///< index of the node's output
};

/// Where wires arrive. Several wires are joined by OR (wired-or of ladder diagrams).
struct InPin {
  std::string name; ///< formal parameter; empty: by position
  std::vector<Wire> wires;
  bool negated = false;
  Edge edge = Edge::None;
  bool enable = false; ///< EN
  bool inOut = false;  ///< VAR_IN_OUT
};

/// Where wires begin.
struct OutPin {
  std::string name; ///< formal parameter; empty: by position
  bool negated = false;
  Storage storage = Storage::None;
  std::string target;  ///< a variable written at the pin itself; empty: none
  bool enable = false; ///< ENO
};

/// An element of a drawing.
struct Node {
  NodeKind kind = NodeKind::Input;
  /// Input, Output, InOut, Contact, Coil: the expression or variable. Value: the operator or
  /// function. Call: what is called. Code: the statements. Link, Jump, Label: the name. Comment:
  /// it.
  std::string text;
  std::string type; ///< Call: the function block's type; empty: a program or an action
  std::vector<InPin> inputs;
  std::vector<OutPin> outputs;
  bool negated = false; ///< of Input, Contact, Output and Coil
  Edge edge = Edge::None;
  Storage storage = Storage::None;
  bool boolean = false;      ///< its value is known to be a BOOL
  std::optional<long> order; ///< explicit execution order
  double x = 0;
  double y = 0;
  size_t line = 0;
};

/// Nodes under one number in the editor; without numbers: all of a body.
struct Network {
  std::string title;
  std::string comment;
  std::string label;
  std::vector<NodeIndex> nodes; ///< in the file's order
  size_t line = 0;
};

/// What decides the order of execution, beside that values are computed before they are used.
enum class Sequence {
  Document, ///< networks and outputs as in the file
  Position, ///< outputs from the top to the bottom, from the left to the right
  Explicit, ///< Node::order
};

/// A drawn body.
struct Body {
  std::vector<Node> nodes;
  std::vector<Network> networks;
  Sequence sequence = Sequence::Document;
};

} // namespace stc::import::networks

#endif // STRIDE_COMPILER_IMPORT_NETWORKS_NETWORK_HPP
