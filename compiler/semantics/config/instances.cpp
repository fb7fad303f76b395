// Instances of programs that a CONFIGURATION makes.

#include "compiler/semantics/config/config.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

bool isProgramInstance(const VarSymbol *variable) {
  return hasAttribute(variable->decl->attributes, AttributeId::ProgramInstance);
}

void reportTemplate(Context &c, const Name &name, const PouSymbol *program) {
  std::vector<std::string_view> names;
  for (GlobalsSymbol *list : program->library->globals) {
    for (VarSymbol *v : list->variables) {
      if (isProgramInstance(v) && v->type == program->type)
        names.push_back(v->name.text);
    }
  }
  auto &d = c.report(Code::ConfigurationProgram, name.span,
                     "which `" + std::string(name.text) + "`? Its instances have other names",
                     "the CONFIGURATION makes instances of it");
  std::string list;
  for (const std::string_view n : names)
    list += (list.empty() ? "`" : ", `") + std::string(n) + "`";
  d.help("write the name of an instance: " + list);
}

void resolveInstances(Context &c, Module &module) {
  for (GlobalsSymbol *list : module.library->globals) {
    for (VarSymbol *v : list->variables) {
      if (!isProgramInstance(v))
        continue;
      const Type *type = typeOf(c, v);
      if (type->kind == TypeKind::Program &&
          attributeValue(v->decl->attributes, AttributeId::ProgramInstance) != "also")
        typeAs<PouType>(type)->symbol->isTemplate = true;
    }
  }
}

} // namespace stc::sema
