#include "compiler/codegen/context/context.hpp"

#include "compiler/syntax/attributes.hpp"

#include <algorithm>

namespace stc::codegen {

EmitContext::EmitContext(Context &context, const PouSymbol *body)
    : run(context), pou(body), out(context.program.sources), includes(context.names) {
  if (body == nullptr)
    return;
  noCheck_ = hasAttribute(body->decl->attributes, ast::AttributeId::NoCheck);
  for (const PouSymbol *check : context.program.implicitChecks)
    isCheck_ = isCheck_ || check == body;
}

void EmitContext::begin(Span span) {
  out.from(span);
  line_ = out.place(span).line;
  out.line();
}

void EmitContext::next(Span span) {
  const uint32_t line = span.valid() ? out.place(span).line : line_;
  if (line == line_) {
    out << ' ';
    return;
  }
  out.endLine();
  begin(span);
}

std::string Uses::fileName(FileId file) {
  const auto at = std::find(files.begin(), files.end(), file);
  const auto index = static_cast<size_t>(at - files.begin());
  if (at == files.end())
    files.push_back(file);
  return fileConstant(index);
}

void EmitContext::position(Span span) {
  const Place at = out.place(span);
  if (uses.files.size() == 1 && uses.files[0] == span.file)
    out << "file__";
  else
    out << uses.fileName(span.file);
  out << ", " << at.line << ", " << at.column;
}

std::string EmitContext::temporary(std::string_view stem) {
  return std::string(stem) + "__" + std::to_string(++counter_);
}

std::string_view EmitContext::root(const Root &root) {
  for (const Uses::RootUse &use : uses.roots) {
    if (use.root == root)
      return use.reference;
  }
  uses.context = true;
  includes.symbol(root.symbol);
  uses.roots.push_back({root, rootName(run.names, root, run.own)});
  return uses.roots.back().reference;
}

std::string_view EmitContext::area(Area area) {
  static constexpr std::string_view kNames[] = {"image__i", "image__q", "image__m"};
  const auto index = static_cast<size_t>(area);
  uses.areas |= 1U << index;
  uses.context = true;
  return kNames[index];
}

} // namespace stc::codegen
