#include "compiler/codegen/emitter.hpp"

namespace stc::codegen {

using namespace ast;

Emitter::Emitter(Context &context, const PouSymbol *pou)
    : c_(context), pou_(pou), w_(context.program.sources), includes_(context.names) {
  if (pou == nullptr)
    return;
  for (const Attribute &a : pou->decl->attributes)
    noCheck_ = noCheck_ || a.name == "no_check";
  for (const PouSymbol *check : context.program.implicitChecks)
    isCheck_ = isCheck_ || check == pou;
}

void Emitter::forgetUses() {
  used_.clear();
  lastUsed_ = nullptr;
  usesContext_ = false;
  usesBudget_ = false;
}

Writer Emitter::takeWriter() {
  Writer done = std::move(w_);
  w_ = Writer(c_.program.sources);
  return done;
}

void Emitter::begin(Span span) {
  w_.from(span);
  currentLine_ = w_.place(span).line;
  w_.line();
}

void Emitter::next(Span span) {
  const std::uint32_t line = span.valid() ? w_.place(span).line : currentLine_;
  if (line == currentLine_) {
    w_ << ' ';
    return;
  }
  w_.endLine();
  begin(span);
}

std::string Emitter::fileName(FileId file) {
  std::size_t i = 0;
  while (i < files_.size() && files_[i] != file)
    ++i;
  if (i == files_.size())
    files_.push_back(file);
  return fileConstant(i);
}

void Emitter::position(Span span) {
  const Place at = w_.place(span);
  if (files_.size() == 1 && files_[0] == span.file)
    w_ << "file__";
  else
    w_ << fileName(span.file);
  w_ << ", " << at.line << ", " << at.column;
}

std::string Emitter::temporary(std::string_view stem) {
  return std::string(stem) + "__" + std::to_string(++next_);
}

std::string rootType(Names &names, const Root &root) {
  std::string name(names.qualified(root.symbol));
  return root.isStatic ? name + "__static__" : name;
}

std::string rootPlace(Names &names, const Root &root) {
  std::string name = rootType(names, root);
  if (!name.ends_with("__"))
    name += "__";
  return name + "at__";
}

std::string rootName(Names &names, const Root &root, const Library *own) {
  std::string name;
  if (root.symbol->library != own)
    name = std::string(names.space(root.symbol->library)) + "__";
  std::string local(names.local(root.symbol));
  if (root.symbol->kind == SymbolKind::globals)
    return name + local.erase(local.find("__globals__"), 9); // `GVL__`
  return name + local + (root.isStatic ? "__static" : "__program");
}

bool hasStatics(const PouSymbol *pou) {
  for (const VarSymbol *v : pou->variables) {
    if (v->section == Section::stat)
      return true;
  }
  return false;
}

std::string_view Emitter::root(const Root &root) {
  for (const RootUse &use : roots_) {
    if (use.root == root)
      return use.reference;
  }
  usesContext_ = true;
  includes_.symbol(root.symbol);
  std::string name = rootName(c_.names, root, c_.own);
  roots_.push_back({root, std::move(name)});
  return roots_.back().reference;
}

} // namespace stc::codegen
