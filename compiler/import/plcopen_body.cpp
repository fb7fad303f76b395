// Bodies of PLCopen XML: text is taken as it is, charts become textual SFC.
#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/networks/plcopen_networks.hpp"
#include "compiler/import/networks/print.hpp"
#include "compiler/import/plcopen_context.hpp"
#include "compiler/import/st_scan.hpp"

#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

/// A name for the file that keeps what cannot be translated.
std::string keptNameOf(const std::string &object, size_t line) {
  std::string name = fmt::format("{}_{}", object, line);
  for (char &c : name)
    if (!isName(std::string("_") + c))
      c = '_';
  return name;
}

/// The line that stands for a drawing until everything is declared that it may name.
std::string drawingText(Context &context, const Node &body, const Node &drawing,
                        const std::string &object) {
  std::vector<networks::Problem> problems;
  networks::Body content = networks::readPlcOpenBody(
      body, [&](const Node &node) { return context.originOf(node).line; }, problems);
  std::ostringstream kept;
  drawing.print(kept, "  ");
  const Origin origin = context.originOf(drawing);
  return markDrawnBody(
      context.model(), origin, object, std::string(localName(drawing)),
      [content = std::move(content), problems = std::move(problems)](networks::Scope &scope) {
        if (problems.empty())
          return networks::translated(content, scope);
        networks::Translation refused;
        refused.problems = problems;
        return refused;
      },
      {keptNameOf(object, origin.line), kept.str()});
}

} // namespace

std::string errorPragma(std::string_view why) {
  std::string text = quotedForSt(why);
  for (char &c : text) // not all that looks for the end of a pragma knows texts
    c = c == '}' || c == '{' ? ' ' : c;
  return fmt::format("{{error 'body not imported: {}'}}\n", text);
}

void leaveOutMembers(Context &context, const Node &node, const std::string &object,
                     const std::string &members) {
  if (!members.empty())
    context.leftOut(node, object,
                    "the actions in its chart (SFC): only programs and blocks have actions");
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
  }
  if (const Node drawing = networks::drawingIn(body))
    text += drawingText(context, body, drawing, object);
  return comment + text;
}

} // namespace stc::import::plcopen
