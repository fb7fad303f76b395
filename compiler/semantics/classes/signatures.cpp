// What the declaration of a method says, compared and as text.

#include "compiler/semantics/classes/classes.hpp"

#include "compiler/semantics/classes/internal.hpp"
#include "compiler/semantics/context/context.hpp"

namespace stc::sema {

using namespace ast;

namespace {

bool isSpecial(const PouSymbol *method, std::string_view lower) {
  return method->property == nullptr && method->name.id->lower == lower;
}

} // namespace

bool isLifecycle(const PouSymbol *method) {
  return isSpecial(method, "fb_init") || isSpecial(method, "fb_exit") ||
         isSpecial(method, "fb_reinit");
}

namespace {

std::string sectionWord(const VarSymbol *v) {
  std::string word = v->section == Section::Input    ? "VAR_INPUT"
                     : v->section == Section::Output ? "VAR_OUTPUT"
                                                     : "VAR_IN_OUT";
  if (v->isConstant)
    word += " CONSTANT";
  return word;
}

} // namespace

std::string signatureText(const PouSymbol *method) {
  if (method->property != nullptr)
    return "PROPERTY " + std::string(method->property->name.text) + " : " +
           (method->property->type == nullptr ? "?" : typeName(method->property->type)) +
           (method->property->get == method ? " (GET)" : " (SET)");
  if (method->decl->kind == DeclKind::Action)
    return "ACTION " + std::string(method->name.text);
  std::string text = "METHOD " + std::string(method->name.text);
  if (method->result != nullptr)
    text += " : " + typeName(method->result->type);
  std::string parameters;
  for (const VarSymbol *p : method->parameters()) {
    parameters += parameters.empty() ? "" : "; ";
    parameters += sectionWord(p) + " " + std::string(p->name.text) + " : " + typeName(p->type);
  }
  return parameters.empty() ? text : text + " (" + parameters + ")";
}

bool sameSignature(const PouSymbol *a, const PouSymbol *b) {
  const Type *ra = a->result == nullptr ? nullptr : a->result->type;
  const Type *rb = b->result == nullptr ? nullptr : b->result->type;
  if (ra != rb)
    return (ra != nullptr && isError(ra)) || (rb != nullptr && isError(rb));
  const auto pa = a->parameters();
  const auto pb = b->parameters();
  if (pa.size() != pb.size())
    return false;
  for (size_t i = 0; i < pa.size(); ++i) {
    if (isError(pa[i]->type) || isError(pb[i]->type))
      continue;
    if (pa[i]->section != pb[i]->section || pa[i]->type != pb[i]->type ||
        pa[i]->isConstant != pb[i]->isConstant ||
        (pa[i]->name.id != pb[i]->name.id && a->property == nullptr))
      return false;
  }
  return true;
}

std::string memberName(const PouSymbol *method) {
  return std::string(method->owner->name.text) + "." +
         std::string(method->property != nullptr ? method->property->name.text : method->name.text);
}

Access memberAccess(const PouSymbol *method) {
  const Access own = method->decl->access;
  if (own != Access::None || method->property == nullptr)
    return own;
  return method->property->decl->access;
}

} // namespace stc::sema
