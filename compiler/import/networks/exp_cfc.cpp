#include "compiler/import/networks/exp_networks.hpp"
#include "compiler/import/networks/exp_pins.hpp"
#include "compiler/import/networks/text.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

namespace stc::import::networks {

namespace {

/// `_KEY: value` lines of an element, a pin `_IN` or a pin `_OUT`.
struct Section {
  size_t line = 0;
  std::map<std::string, std::string> values;
  std::vector<Section> inputs;
  std::vector<Section> outputs;

  [[nodiscard]] std::string value(const std::string &key) const {
    const auto found = values.find(key);
    return found == values.end() ? std::string() : found->second;
  }
  [[nodiscard]] bool flag(const std::string &key) const { return value(key) == "1"; }
};

constexpr std::array<std::string_view, 18> kKeys = {
    "_ID",         "_MACROID",      "_POS",      "_TYPE",     "_TEXT",      "_NEGATE",
    "_INSTANCE",   "_INSTANCENAME", "_TYPENAME", "_ENENO",    "_INPUTS",    "_OUTPUTS",
    "_PARAMETERS", "_INPUTID",      "_INPUTIDX", "_SETRESET", "_CONNECTOR", "_COMMENT"};

/// Reads the elements of a continuous function chart.
class ChartReader {
public:
  ChartReader(const std::vector<NumberedLine> &lines, const Scope &scope,
              std::vector<Problem> &problems)
      : lines_(lines), scope_(scope), problems_(problems) {}

  Body read() {
    readSections();
    if (!problems_.empty())
      return {};
    body_.sequence = Sequence::Explicit;
    body_.networks.emplace_back();
    body_.networks.front().line = lines_.front().line;
    for (const Section &element : elements_)
      addNode(element);
    for (size_t i = 0; i < elements_.size() && problems_.empty(); ++i)
      connect(elements_[i], body_.nodes[i]);
    if (hasConnectors_ && hasOpenInputs_)
      problem(lines_.front().line, "connectors by name beside inputs without a connection");
    return std::move(body_);
  }

private:
  void problem(size_t line, std::string text) { problems_.push_back({line, std::move(text)}); }

  void readSections() {
    std::vector<Section *> open;
    for (size_t at = 1; at < lines_.size() && problems_.empty(); ++at) {
      const std::string_view text = trim(lines_[at].text);
      const size_t line = lines_[at].line;
      if (text.empty())
        continue;
      if (text == "_ELEMENT" && open.empty()) {
        elements_.push_back({line, {}, {}, {}});
        open = {&elements_.back()};
      } else if ((text == "_IN" || text == "_OUT") && open.size() == 1) {
        std::vector<Section> &pins = text == "_IN" ? open[0]->inputs : open[0]->outputs;
        pins.push_back({line, {}, {}, {}});
        open.push_back(&pins.back());
      } else if (text == "_END" && !open.empty()) {
        open.pop_back();
      } else if (!open.empty()) {
        readValue(*open.back(), text, line);
      } else {
        problem(line, unknown(text));
      }
    }
    if (!open.empty() && problems_.empty())
      problem(lines_.back().line, "the body ends in the middle of an element");
  }

  static std::string unknown(std::string_view text) {
    return fmt::format("`{}`: no published export shows what it means; change the body to ST and "
                       "export it again",
                       text);
  }

  void readValue(Section &section, std::string_view text, size_t line) {
    const size_t colon = text.find(':');
    const std::string key(text.substr(0, std::min(colon, text.size())));
    if (colon == std::string_view::npos || std::ranges::find(kKeys, key) == kKeys.end())
      return problem(line, unknown(text));
    section.values[key] = trim(text.substr(colon + 1));
  }

  void addNode(const Section &element) {
    const std::string type = element.value("_TYPE");
    Node node;
    node.line = element.line;
    node.text = element.value("_TEXT");
    readPosition(element.value("_POS"), node);
    if (element.value("_MACROID") != "-1" && !element.value("_MACROID").empty())
      problem(element.line, "macros are not imported: resolve them and export again");
    if (type == "_INPUT") {
      node.negated = element.flag("_NEGATE");
      node.outputs.resize(1);
      hasConnectors_ = hasConnectors_ || !element.value("_CONNECTOR").empty();
    } else if (type == "_OUTPUT") {
      node.kind = NodeKind::Output;
      node.order = static_cast<long>(body_.nodes.size());
      readStorage(element, node);
    } else if (type == "_BOX") {
      addBox(element, node);
    } else {
      problem(element.line, unknown("_TYPE: " + type));
    }
    ids_[element.value("_ID")] = body_.nodes.size();
    body_.networks.front().nodes.push_back(body_.nodes.size());
    body_.nodes.push_back(std::move(node));
  }

  void readPosition(const std::string &text, Node &node) {
    const size_t comma = text.find(',');
    if (comma == std::string::npos)
      return;
    node.x =
        static_cast<double>(numberIn(trim(std::string_view(text).substr(0, comma))).value_or(0));
    node.y =
        static_cast<double>(numberIn(trim(std::string_view(text).substr(comma + 1))).value_or(0));
  }

  void readStorage(const Section &element, Node &node) {
    const std::string storage = element.value("_SETRESET");
    if (storage == "_SET")
      node.storage = Storage::Set;
    else if (storage == "_RESET")
      node.storage = Storage::Reset;
    else if (!storage.empty() && storage != "_NONE" && storage != "_NO_SET" && storage != "0")
      problem(element.line, unknown("_SETRESET: " + storage));
  }

  void addBox(const Section &element, Node &node) {
    const std::string type = element.value("_TYPENAME");
    const Interface *declared = scope_.interfaceOf(type);
    const bool instance = element.flag("_INSTANCE");
    const bool program =
        declared != nullptr ? declared->kind == Interface::Kind::Program : element.outputs.empty();
    node.kind = instance || program ? NodeKind::Call : NodeKind::Value;
    node.text = instance ? element.value("_INSTANCENAME") : type;
    node.type = instance ? type : std::string();
    node.order = static_cast<long>(body_.nodes.size());
    if (element.flag("_ENENO"))
      problem(element.line, "no published export shows how EN and ENO of a chart's box are stored; "
                            "change the body to ST and export it again");
    if (element.value("_PARAMETERS") != "0" && !element.value("_PARAMETERS").empty())
      problem(element.line, "parameters of a box are not imported");
    for (const Section &output : element.outputs) {
      OutPin pin;
      pin.negated = output.flag("_NEGATE");
      hasConnectors_ = hasConnectors_ || !output.value("_CONNECTOR").empty();
      node.outputs.push_back(std::move(pin));
    }
    node.inputs.resize(element.inputs.size());
    if (node.kind == NodeKind::Call && !namePins(node, declared))
      problem(element.line, fmt::format("`{}` has more pins than its declaration", type));
  }

  void connect(const Section &element, Node &node) {
    if (node.kind == NodeKind::Output) {
      node.inputs.resize(1);
      connectPin(element, node.inputs.front());
      return;
    }
    for (size_t i = 0; i < element.inputs.size() && i < node.inputs.size(); ++i)
      connectPin(element.inputs[i], node.inputs[i]);
  }

  void connectPin(const Section &section, InPin &pin) {
    pin.negated = section.flag("_NEGATE");
    const std::string id = section.value("_INPUTID");
    const auto from = ids_.find(id);
    if (from == ids_.end()) {
      hasOpenInputs_ = true;
      if (!id.empty() && id != "-1")
        problem(section.line, fmt::format("no element has the number {}", id));
      return;
    }
    const long index = numberIn(section.value("_INPUTIDX")).value_or(-1);
    const Node &source = body_.nodes[from->second];
    if (index < 0 || static_cast<size_t>(index) >= source.outputs.size())
      return problem(section.line,
                     fmt::format("element {} has no output {}", id, section.value("_INPUTIDX")));
    if (source.kind == NodeKind::Input && isBlankOperand(source.text)) {
      hasOpenInputs_ = true;
      return;
    }
    pin.wires = {{from->second, static_cast<size_t>(index)}};
  }

  const std::vector<NumberedLine> &lines_;
  const Scope &scope_;
  std::vector<Problem> &problems_;
  std::vector<Section> elements_;
  std::map<std::string, NodeIndex> ids_;
  Body body_;
  bool hasConnectors_ = false;
  bool hasOpenInputs_ = false;
};

} // namespace

Body readExpChart(const std::vector<NumberedLine> &lines, const Scope &scope,
                  std::vector<Problem> &problems) {
  Body body = ChartReader(lines, scope, problems).read();
  return problems.empty() ? std::move(body) : Body{};
}

} // namespace stc::import::networks
