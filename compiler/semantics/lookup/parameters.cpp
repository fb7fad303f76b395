// Constants of libraries that a project sets: VAR_GLOBAL CONSTANT with {attribute 'parameterlist'}.

#include "compiler/semantics/attributes.hpp"
#include "compiler/semantics/lookup/lookup.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/st_text.hpp"

namespace stc {

using namespace ast;

namespace {

bool isParameterList(const GlobalsDecl *decl) {
  return hasAttribute(decl->attributes, AttributeId::ParameterList);
}

bool isParameter(const VarDecl *v) { return (v->qualifiers & kQualConstant) != 0; }

} // namespace

void Lookup::setParameters(const Module &module, const Name &list, GlobalsDecl *decl) {
  if (module.library->isUser || !isParameterList(decl))
    return;
  for (ParameterValue &parameter : program_.parameters) {
    if (parameter.library != module.library->name ||
        (!parameter.list.empty() && parameter.list != list.id->lower))
      continue;
    for (VarDecl *v : decl->variables) {
      if (!isParameter(v) || !equalIgnoringCase(v->name.text, parameter.name))
        continue;
      if (parameter.isSet)
        reporter_
            .report(Code::LibraryParameter, parameter.place,
                    "`" + parameter.name + "` is in several parameter lists of `" +
                        module.library->name + "`",
                    "which one is meant?")
            .help("write the list before it, `" + std::string(list.text) + "." + parameter.name +
                  " = …`");
      const bool isText = v->type != nullptr && v->type->kind == TypeExprKind::String;
      Expr *value = isText && parameter.quoted != nullptr ? parameter.quoted : parameter.value;
      if (value == nullptr)
        reporter_
            .report(Code::LibraryParameter, parameter.place,
                    "`" + parameter.name + "` cannot have this value", "not a value of its type")
            .help("write numbers and `true` without quotes, other values as in ST: \"T#5s\"");
      else
        v->init = value;
      parameter.isSet = true;
    }
  }
}

void Lookup::reportUnknownParameters() {
  for (const ParameterValue &parameter : program_.parameters) {
    if (parameter.isSet)
      continue;
    auto &d = reporter_.report(Code::LibraryParameter, parameter.place,
                               "the library `" + parameter.library + "` has no parameter `" +
                                   (parameter.list.empty() ? "" : parameter.list + ".") +
                                   parameter.name + "`",
                               "unknown parameter");
    std::vector<std::string_view> names;
    for (const GlobalsSymbol *list : module(parameter.library).library->globals)
      for (const VarSymbol *v : list->variables)
        if (v->home != nullptr && isParameterList(as<GlobalsDecl>(v->home)) && isParameter(v->decl))
          names.push_back(v->name.text);
    if (const std::string_view near = nearest(parameter.name, names); !near.empty())
      d.help("did you mean `" + std::string(near) + "`?");
    std::string all;
    for (const std::string_view name : names)
      all += (all.empty() ? "`" : ", `") + std::string(name) + "`";
    d.note(all.empty() ? "it has no list of constants with {attribute 'parameterlist'}"
                       : "its parameters: " + all);
  }
}

} // namespace stc
