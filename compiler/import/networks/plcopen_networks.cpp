#include "compiler/import/networks/plcopen_networks.hpp"
#include "runtime/common/text.hpp"

#include "compiler/import/networks/exp_pins.hpp"
#include "compiler/import/networks/text.hpp"
#include "compiler/import/networks/xml_nodes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace stc::import::networks {

using stride::common::upperCase;

namespace {

using pugi::xml_node;

std::string expressionIn(const xml_node &node, std::string_view name) {
  return std::string(trim(import::textOf(child(node, name))));
}

Edge edgeIn(const xml_node &node) {
  const std::string_view value = node.attribute("edge").value();
  return value == "rising" ? Edge::Rising : value == "falling" ? Edge::Falling : Edge::None;
}

Storage storageIn(const xml_node &node) {
  const std::string_view value = node.attribute("storage").value();
  return value == "set" ? Storage::Set : value == "reset" ? Storage::Reset : Storage::None;
}

/// Text of an element `name` in one of the node's addData.
std::optional<std::string> addedText(const xml_node &node, std::string_view name) {
  for (const xml_node data : child(node, "addData").children())
    if (const xml_node found = child(data, name))
      return import::textOf(found);
  return std::nullopt;
}

bool isTitle(const xml_node &node) {
  return localName(node) == "vendorElement" &&
         addedText(node, "ElementType").value_or("") == "networktitle";
}

constexpr std::array<std::pair<std::string_view, NodeKind>, 13> kKinds = {{
    {"inVariable", NodeKind::Input},
    {"outVariable", NodeKind::Output},
    {"inOutVariable", NodeKind::InOut},
    {"contact", NodeKind::Contact},
    {"coil", NodeKind::Coil},
    {"leftPowerRail", NodeKind::Rail},
    {"block", NodeKind::Value},
    {"connector", NodeKind::Link},
    {"continuation", NodeKind::Link},
    {"jump", NodeKind::Jump},
    {"return", NodeKind::Return},
    {"label", NodeKind::Label},
    {"comment", NodeKind::Comment},
}};

constexpr size_t kInOutChain = 200; // of blocks that pass one variable on

class DrawingReader {
public:
  DrawingReader(const xml_node &drawing, const LineOf &lineOf, std::vector<Problem> &problems)
      : drawing_(drawing), lineOf_(lineOf), problems_(problems) {}

  Body read() {
    bool titled = false;
    for (const xml_node each : drawing_.children())
      titled = titled || isTitle(each);
    body_.networks.emplace_back();
    for (xml_node each = drawing_.first_child(); each; each = each.next_sibling())
      if (each.type() == pugi::node_element)
        readElement(each, titled);
    for (const auto &[index, node] : elements_)
      connectInOuts(index, 0);
    for (const auto &[index, node] : elements_)
      connect(index, node);
    body_.sequence = titled ? Sequence::Document : Sequence::Position;
    chooseOrder();
    return std::move(body_);
  }

private:
  void problem(const xml_node &node, std::string text) {
    problems_.push_back({lineOf_(node), std::move(text)});
  }

  void readElement(const xml_node &node, bool titled) {
    const std::string_view name = localName(node);
    if (name == "vendorElement")
      return readVendorElement(node);
    if (name == "rightPowerRail" || name == "addData" || name == "documentation")
      return;
    const auto found =
        std::ranges::find(kKinds, name, &std::pair<std::string_view, NodeKind>::first);
    if (found == kKinds.end())
      return problem(node, fmt::format("the element `{}` is not imported in a drawing", name));
    if (titled && (name == "comment" || name == "label") && readHead(node, name))
      return;
    add(node, found->second);
  }

  /// A comment or a label directly before a network's title belongs to that network.
  bool readHead(const xml_node &node, std::string_view name) {
    xml_node next = node.next_sibling();
    while (next && (localName(next) == "comment" || localName(next) == "label"))
      next = next.next_sibling();
    if (!next || !isTitle(next))
      return false;
    if (name == "label")
      head_.label = node.attribute("label").value();
    else
      head_.comment += (head_.comment.empty() ? "" : "\n") + import::textOf(child(node, "content"));
    return true;
  }

  void readVendorElement(const xml_node &node) {
    const std::string type = addedText(node, "ElementType").value_or("");
    const std::string text(trim(import::textOf(child(node, "alternativeText"))));
    if (type == "networktitle") {
      head_.title = text;
      head_.line = lineOf_(node);
      body_.networks.push_back(std::exchange(head_, {}));
    } else if (type == "sourceConnectionMark" || type == "sinkConnectionMark") {
      const NodeIndex index = add(node, NodeKind::Link);
      body_.nodes[index].text = text;
      if (type == "sinkConnectionMark")
        body_.nodes[index].inputs.clear();
    } else if (child(node, "inputVariables") || child(node, "connectionPointIn") ||
               child(node, "outputVariables")) {
      problem(node, fmt::format("the element `{}` is not imported in a drawing", type));
    }
  }

  NodeIndex add(const xml_node &xml, NodeKind kind) {
    Node node;
    node.kind = kind;
    node.line = lineOf_(xml);
    node.negated = isTrue(xml, "negated");
    node.edge = edgeIn(xml);
    node.storage = storageIn(xml);
    const xml_node position = child(xml, "position");
    node.x = position.attribute("x").as_double();
    node.y = position.attribute("y").as_double();
    if (const pugi::xml_attribute order = xml.attribute("executionOrderId"))
      node.order = numberIn(order.value());
    readText(xml, node);
    if (localName(xml) == "block")
      readBlock(xml, node);
    else
      readPins(xml, node);
    const std::string id = xml.attribute("localId").value();
    const NodeIndex index = body_.nodes.size();
    if (!id.empty() && !ids_.emplace(id, index).second && kind != NodeKind::Comment)
      problem(xml, fmt::format("two elements have the localId {}", id));
    elements_.emplace_back(index, xml);
    body_.networks.back().nodes.push_back(index);
    body_.nodes.push_back(std::move(node));
    return index;
  }

  static void readText(const xml_node &xml, Node &node) {
    switch (node.kind) {
    case NodeKind::Contact:
    case NodeKind::Coil:
      node.text = expressionIn(xml, "variable");
      break;
    case NodeKind::Link:
      node.text = xml.attribute("name").value();
      break;
    case NodeKind::Jump:
    case NodeKind::Label:
      node.text = xml.attribute("label").value();
      break;
    case NodeKind::Comment:
      node.text = import::textOf(child(xml, "content"));
      break;
    default:
      node.text = expressionIn(xml, "expression");
    }
  }

  /// Pins of what is no box: at most one on each side. A rail has one output however many it shows.
  static void readPins(const xml_node &xml, Node &node) {
    node.outputs.resize(1);
    node.inputs.clear();
    const std::string_view name = localName(xml);
    if (child(xml, "connectionPointIn") || name == "vendorElement" || name == "connector")
      node.inputs.resize(1);
    if (node.kind == NodeKind::InOut && node.inputs.size() == 1) {
      node.inputs.front().negated = isTrue(xml, "negatedIn");
      node.negated = false;
    }
  }

  void readBlock(const xml_node &xml, Node &node) {
    const std::string type = xml.attribute("typeName").value();
    const std::string instance = xml.attribute("instanceName").value();
    const std::string call = addedText(xml, "CallType").value_or("");
    const std::optional<std::string> code = addedText(xml, "STCode");
    node.text = type;
    if (code) {
      node.kind = NodeKind::Code;
      node.text = *code;
    } else if (!instance.empty()) {
      node.kind = NodeKind::Call;
      node.text = instance;
      node.type = type;
    } else if (call == "program" || call == "action") {
      node.kind = NodeKind::Call;
    }
    if (code && call != "execute" && !call.empty())
      problem(xml, fmt::format("a box of the kind `{}` with statements inside", call));
    readBlockPins(xml, node);
  }

  static void readBlockPins(const xml_node &xml, Node &node) {
    for (const std::string_view group : {"inputVariables", "inOutVariables"})
      for (const xml_node each : child(xml, group).children()) {
        if (localName(each) != "variable")
          continue;
        InPin pin;
        pin.name = each.attribute("formalParameter").value();
        pin.negated = isTrue(each, "negated");
        pin.edge = edgeIn(each);
        pin.inOut = group == "inOutVariables";
        pin.enable = upperCase(pin.name) == "EN";
        node.inputs.push_back(std::move(pin));
      }
    for (const xml_node each : child(xml, "outputVariables").children()) {
      if (localName(each) != "variable")
        continue;
      OutPin pin;
      pin.name = each.attribute("formalParameter").value();
      pin.negated = isTrue(each, "negated");
      pin.storage = storageIn(each);
      pin.enable = upperCase(pin.name) == "ENO";
      const std::string target = expressionIn(child(each, "connectionPointOut"), "expression");
      pin.target = isBlankOperand(target) ? std::string() : target;
      node.outputs.push_back(std::move(pin));
    }
  }

  void connect(NodeIndex index, const xml_node &xml) {
    if (localName(xml) != "block") {
      if (!body_.nodes[index].inputs.empty()) {
        xml_node point = child(xml, "connectionPointIn");
        if (!point)
          point = child(child(child(xml, "inputVariables"), "variable"), "connectionPointIn");
        connectPin(body_.nodes[index].inputs.front(), point);
      }
      return;
    }
    size_t at = 0;
    for (const xml_node each : child(xml, "inputVariables").children())
      if (localName(each) == "variable")
        connectPin(body_.nodes[index].inputs[at++], child(each, "connectionPointIn"));
  }

  /// Before all else, for others read their right sides; those that these read come first.
  void connectInOuts(NodeIndex index, size_t depth) {
    const xml_node xml = elements_[index].second;
    if (depth == kInOutChain || localName(xml) != "block" || !inOutsDone_.insert(index).second)
      return;
    std::vector<InPin> &pins = body_.nodes[index].inputs;
    auto pin = std::ranges::find_if(pins, &InPin::inOut);
    for (const xml_node each : child(xml, "inOutVariables").children()) {
      if (localName(each) != "variable")
        continue;
      const xml_node point = child(each, "connectionPointIn");
      for (const xml_node connection : point.children())
        if (const auto from = ids_.find(connection.attribute("refLocalId").value());
            from != ids_.end())
          connectInOuts(from->second, depth + 1);
      connectPin(*pin++, point);
    }
  }

  void connectPin(InPin &pin, const xml_node &point) {
    for (const xml_node connection : point.children()) {
      if (localName(connection) != "connection")
        continue;
      const std::string id = connection.attribute("refLocalId").value();
      const auto found = ids_.find(id);
      if (found == ids_.end()) {
        problem(connection, fmt::format("no element has the localId {}", id));
        continue;
      }
      const Node &source = body_.nodes[found->second];
      if (source.kind == NodeKind::Input && isBlankOperand(source.text))
        continue;
      const std::optional<Wire> wire = wireFrom(found->second, connection);
      if (wire)
        pin.wires.push_back(*wire);
    }
  }

  std::optional<Wire> wireFrom(NodeIndex from, const xml_node &connection) {
    Node &source = body_.nodes[from];
    const std::string pin = connection.attribute("formalParameter").value();
    if (source.kind != NodeKind::Value && source.kind != NodeKind::Call &&
        source.kind != NodeKind::Code)
      return Wire{from, 0};
    for (size_t i = 0; i < source.outputs.size(); ++i)
      if (upperCase(source.outputs[i].name) == upperCase(pin))
        return Wire{from, i};
    // Without a name: the only output, or the first that is not ENO.
    for (size_t i = 0; i < source.outputs.size() && pin.empty(); ++i)
      if (!source.outputs[i].enable || source.outputs.size() == 1)
        return Wire{from, i};
    // The right side of an in-out is the variable on its left.
    for (const InPin &each : source.inputs)
      if (each.inOut && upperCase(each.name) == upperCase(pin) && each.wires.size() == 1)
        return each.wires.front();
    problem(connection, fmt::format("`{}` has no output `{}`", source.text, pin));
    return std::nullopt;
  }

  /// Numbers above 0 are an order; where there are such, a single 0 is the first of it.
  void chooseOrder() {
    const bool chart = localName(drawing_) == "CFC";
    size_t zeros = 0;
    bool numbered = chart;
    for (const Node &node : body_.nodes) {
      numbered = numbered || node.order.value_or(0) > 0;
      zeros += node.order == 0 && node.kind != NodeKind::Input ? 1 : 0;
    }
    for (Node &node : body_.nodes)
      if (!numbered || (node.order == 0 && zeros > 1) || node.kind == NodeKind::Input)
        node.order.reset();
    if (numbered)
      body_.sequence = Sequence::Explicit;
  }

  xml_node drawing_;
  const LineOf &lineOf_;
  std::vector<Problem> &problems_;
  Body body_;
  Network head_; ///< of the network that begins next
  std::map<std::string, NodeIndex> ids_;
  std::vector<std::pair<NodeIndex, xml_node>> elements_;
  std::set<NodeIndex> inOutsDone_;
};

} // namespace

xml_node drawingIn(const xml_node &body) {
  for (const std::string_view name : {"FBD", "LD", "CFC"})
    if (const xml_node found = child(body, name))
      return found;
  for (const xml_node data : child(body, "addData").children())
    if (const xml_node found = child(data, "CFC"))
      return found;
  return {};
}

Body readPlcOpenBody(const xml_node &body, const LineOf &lineOf, std::vector<Problem> &problems) {
  const xml_node drawing = drawingIn(body);
  if (!drawing) {
    problems.push_back({lineOf(body), "no drawing that is known"});
    return {};
  }
  return DrawingReader(drawing, lineOf, problems).read();
}

} // namespace stc::import::networks
