// Bodies of PLCopen XML: text is taken as it is, charts become textual SFC.
#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/networks/plcopen_networks.hpp"
#include "compiler/import/networks/print.hpp"
#include "compiler/import/plcopen_context.hpp"

#include <utility>
#include <vector>

namespace stc::import::plcopen {

namespace {

/// A body that is drawn: CODESYS puts a CFC into the body's addData.
Node drawing(const Node &body) {
  for (const Extra &each : extrasOf(body))
    if (localName(each.element) == "CFC")
      return each.element;
  return {};
}

/// The mark of a drawing: what the blocks in it declare may stand further on in the file.
std::string drawnBody(Context &context, const Node &body, const Node &drawn,
                      const std::string &object) {
  std::vector<networks::Problem> problems;
  networks::Body read = networks::readPlcOpenBody(
      body, [&](const Node &node) { return context.originOf(node).line; }, problems);
  return markDrawnBody(context.model(), context.originOf(drawn), object,
                       std::string(localName(drawn)),
                       [read = std::move(read), problems](const networks::Scope &scope) {
                         networks::Translation result;
                         result.problems = problems;
                         return result.ok() ? networks::translated(read, scope) : result;
                       });
}

} // namespace

std::string errorPragma(std::string_view why) {
  std::string text = "{error 'body not imported: ";
  for (const char c : why)
    text += c == '\'' || c == '}' || c == '{' || c == '\n' ? ' ' : c;
  return text + "'}\n";
}

std::string bodyText(Context &context, const Node &body, const Node &pou, const std::string &object,
                     std::string &members) {
  context.leaveOutUnknown(body, {"ST", "IL", "SFC", "FBD", "LD", "documentation"});
  context.leaveOutUnknownExtras(body, {"CFC"});
  const std::string comment = commentLines(linesOf(child(body, "documentation")), {}, "//");
  std::string text;
  for (const Node &each : children(body)) {
    const std::string_view kind = localName(each);
    if (kind == "ST" || kind == "IL")
      text += linesOf(each);
    else if (kind == "SFC")
      text += chartText(context, each, pou, object, members);
    else if (kind == "FBD" || kind == "LD")
      text += drawnBody(context, body, each, object);
  }
  if (const Node drawn = drawing(body))
    text += drawnBody(context, body, drawn, object);
  return comment + text;
}

} // namespace stc::import::plcopen
