// Bodies of PLCopen XML: text is taken as it is, charts become textual SFC.
#include "compiler/import/exp_lines.hpp"
#include "compiler/import/plcopen_context.hpp"

#include <fmt/format.h>

namespace stc::import::plcopen {

namespace {

/// A body that is drawn: CODESYS puts a CFC into the body's addData.
Node drawing(const Node &body) {
  for (const Extra &each : extrasOf(body))
    if (localName(each.element) == "CFC")
      return each.element;
  return {};
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
    else if (kind == "FBD" || kind == "LD") {
      context.leftOut(each, object, fmt::format("its body is drawn ({})", kind));
      text += errorPragma(kind);
    }
  }
  if (const Node drawn = drawing(body)) {
    context.leftOut(drawn, object, "its body is drawn (CFC)");
    text += errorPragma("CFC");
  }
  return comment + text;
}

} // namespace stc::import::plcopen
