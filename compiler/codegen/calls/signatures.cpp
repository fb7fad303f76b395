#include "compiler/codegen/calls/signatures.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// `R name(::stride::Ctx &ctx__`
std::string openSignature(Context &context, const PouSymbol *pou, std::string_view name,
                          const Uses *definition) {
  const std::string_view result =
      pou->result != nullptr ? context.names.type(pou->result->type) : "void";
  return declared(result, name) + "(::stride::Ctx &" +
         (definition == nullptr || definition->context ? "ctx__" : "");
}

/// `, [[maybe_unused]] T &name`
std::string parameter(Context &context, const VarSymbol *p, const Uses *definition) {
  const bool byReference = p->section != Section::Input && p->type->kind != TypeKind::OpenArray;
  std::string type(context.names.type(p->type));
  if (byReference)
    type = declared(type, "&");
  return (definition != nullptr && !definition->has(p) ? ", [[maybe_unused]] " : ", ") +
         declared(type, definition != nullptr && p->section == Section::Input
                            ? inputName(context, p)
                            : mangle(p->name.text));
}

} // namespace

std::string functionSignature(Context &context, Includes &includes, const PouSymbol *function,
                              const Uses *definition) {
  if (function->result != nullptr)
    includes.complete(function->result->type);
  std::string out = openSignature(context, function, context.names.local(function), definition);
  for (const VarSymbol *p : function->parameters()) {
    if (p->section != Section::Input && p->type->kind != TypeKind::OpenArray)
      includes.pointed(p->type);
    else
      includes.complete(p->type);
    out += parameter(context, p, definition);
  }
  return out + ")";
}

std::string methodSignature(Context &context, Includes &includes, const PouSymbol *method,
                            std::string_view name, bool self, const Uses *definition) {
  if (method->result != nullptr)
    includes.pointed(method->result->type);
  std::string out = openSignature(context, method, name, definition);
  if (self)
    out += ", ::stride::Interface self__";
  for (const VarSymbol *p : method->parameters()) {
    includes.pointed(p->type);
    out += parameter(context, p, definition);
  }
  return out + ")";
}

std::string inputName(Context &context, const VarSymbol *input) {
  return mangle(input->name.text) + (context.addressed.onDataStack(input) ? "__in" : "");
}

} // namespace stc::codegen
