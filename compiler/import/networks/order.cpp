#include "compiler/import/networks/order.hpp"

#include "runtime/common/text.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace stc::import::networks {

namespace {

constexpr size_t kLinksInAChain = 1000;
constexpr size_t kWiresOfAPin = 1000;
constexpr size_t kStepsBesideAComment = 2000; // that are looked at

bool isStep(const Node &node) {
  switch (node.kind) {
  case NodeKind::Input:
  case NodeKind::Rail:
  case NodeKind::Link:
  case NodeKind::Comment:
    return false;
  case NodeKind::InOut:
    return !node.inputs.empty() && !node.inputs.front().wires.empty();
  default:
    return true;
  }
}

/// Puts the nodes of networks in order. Without recursion: drawings can be deep.
class Scheduler {
public:
  explicit Scheduler(const Body &body)
      : body_(body), state_(body.nodes.size(), State::New), read_(body.nodes.size(), false) {
    for (const Node &node : body_.nodes)
      for (const InPin &pin : node.inputs)
        for (const Wire &wire : pin.wires)
          read_[wire.node] = true;
  }

  std::vector<NodeIndex> run(const Network &network) {
    steps_.clear();
    std::vector<NodeIndex> roots;
    std::vector<NodeIndex> others; // in circles that nothing outside reads
    for (const NodeIndex index : network.nodes)
      if (isStep(body_.nodes[index]))
        (isRoot(index, read_[index]) ? roots : others).push_back(index);
    for (std::vector<NodeIndex> *list : {&roots, &others}) {
      sort(*list);
      for (const NodeIndex index : *list)
        visit(index);
    }
    placeComments(network);
    return steps_;
  }

private:
  enum class State { New, Open, Done };

  [[nodiscard]] bool isExplicit(NodeIndex index) const {
    return body_.sequence == Sequence::Explicit && body_.nodes[index].order.has_value();
  }

  [[nodiscard]] bool isRoot(NodeIndex index, bool read) const {
    return body_.sequence == Sequence::Explicit ? isExplicit(index) || !read : !read;
  }

  void sort(std::vector<NodeIndex> &list) const {
    if (body_.sequence == Sequence::Document)
      return;
    std::ranges::stable_sort(list, {}, [&](NodeIndex index) {
      const Node &node = body_.nodes[index];
      const bool ordered = isExplicit(index);
      return std::tuple(!ordered, ordered ? *node.order : 0, node.y, node.x);
    });
  }

  struct Visit {
    NodeIndex node;
    size_t pin = 0;
    size_t wire = 0;
  };

  /// The node after everything that it reads and that has no place of its own.
  void visit(NodeIndex first) {
    std::vector<Visit> stack;
    const auto open = [&](NodeIndex index) {
      if (state_[index] != State::New || !isStep(body_.nodes[index]))
        return;
      state_[index] = State::Open;
      stack.push_back({index});
    };
    open(first);
    while (!stack.empty()) {
      Visit &top = stack.back();
      const std::vector<InPin> &pins = body_.nodes[top.node].inputs;
      if (top.pin == pins.size()) {
        state_[top.node] = State::Done;
        steps_.push_back(top.node);
        stack.pop_back();
      } else if (top.wire == pins[top.pin].wires.size()) {
        ++top.pin;
        top.wire = 0;
      } else {
        const NodeIndex from = pins[top.pin].wires[top.wire++].node;
        if (!isExplicit(from))
          open(from); // `top` may be gone now
      }
    }
  }

  void placeComments(const Network &network) {
    std::map<size_t, std::vector<NodeIndex>> before; // place in steps_ -> comments
    for (const NodeIndex index : network.nodes) {
      const Node &comment = body_.nodes[index];
      if (comment.kind != NodeKind::Comment)
        continue;
      size_t best = 0;
      double nearest = -1;
      for (size_t i = 0; i < std::min(steps_.size(), kStepsBesideAComment); ++i) {
        const Node &node = body_.nodes[steps_[i]];
        const double dx = node.x - comment.x;
        const double dy = node.y - comment.y;
        const double distance = dx * dx + dy * dy;
        if (nearest < 0 || distance < nearest) {
          nearest = distance;
          best = i;
        }
      }
      before[best].push_back(index);
    }
    std::vector<NodeIndex> all;
    for (size_t i = 0; i <= steps_.size(); ++i) {
      if (const auto found = before.find(i); found != before.end())
        all.insert(all.end(), found->second.begin(), found->second.end());
      if (i < steps_.size())
        all.push_back(steps_[i]);
    }
    steps_ = std::move(all);
  }

  const Body &body_;
  std::vector<State> state_;
  std::vector<bool> read_; ///< whether a wire begins there
  std::vector<NodeIndex> steps_;
};

} // namespace

void resolveLinks(Body &body, std::vector<Problem> &problems) {
  std::map<std::string, NodeIndex> sources; // connectors by name
  for (NodeIndex i = 0; i < body.nodes.size(); ++i)
    if (body.nodes[i].kind == NodeKind::Link && !body.nodes[i].inputs.empty())
      sources.emplace(stride::common::lowerCase(body.nodes[i].text), i);
  for (Node &node : body.nodes)
    for (InPin &pin : node.inputs)
      for (size_t i = 0; i < pin.wires.size(); ++i)
        for (size_t n = 0; body.nodes[pin.wires[i].node].kind == NodeKind::Link; ++n) {
          const Node *link = &body.nodes[pin.wires[i].node];
          const auto source = sources.find(stride::common::lowerCase(link->text));
          if (link->inputs.empty() && source != sources.end())
            link = &body.nodes[source->second];
          if (link->inputs.empty() || n == kLinksInAChain || pin.wires.size() > kWiresOfAPin) {
            problems.push_back(
                {link->line,
                 link->inputs.empty()
                     ? fmt::format("no connector `{}` for this continuation", link->text)
                     : fmt::format("connector `{}` leads to itself", link->text)});
            pin.wires.clear();
            break;
          }
          const std::vector<Wire> from = link->inputs.front().wires;
          pin.wires.erase(pin.wires.begin() + static_cast<ptrdiff_t>(i));
          pin.wires.insert(pin.wires.begin() + static_cast<ptrdiff_t>(i), from.begin(), from.end());
          if (i >= pin.wires.size())
            break;
        }
}

std::vector<std::vector<NodeIndex>> scheduleOf(const Body &body) {
  std::vector<std::vector<NodeIndex>> result;
  Scheduler scheduler(body);
  for (const Network &network : body.networks)
    result.push_back(scheduler.run(network));
  return result;
}

} // namespace stc::import::networks
