#include "compiler/semantics/program.hpp"

namespace stc {

size_t textBytes(const Program &program) {
  size_t bytes = 0;
  for (const ast::File *file : program.files)
    bytes += program.sources.file(file->id).text().size();
  return bytes;
}

std::string pathText(const StatePath &path) {
  std::string text(path.root->name.text);
  const Type *type = path.root->kind == SymbolKind::Pou
                         ? static_cast<const PouSymbol *>(path.root)->type
                         : static_cast<const VarSymbol *>(path.root)->type;
  for (const PathStep &step : path.steps) {
    if (step.member != nullptr) {
      text += "." + std::string(step.member->name.text);
      type = step.member->type;
      continue;
    }
    const auto *array = typeAs<ArrayType>(type);
    const std::string index = std::to_string(array->low + static_cast<int64_t>(step.element));
    if (text.back() == ']')
      text.replace(text.size() - 1, 1, "," + index + "]");
    else
      text += "[" + index + "]";
    type = array->element;
  }
  return text;
}

} // namespace stc
