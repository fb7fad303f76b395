// Variables of the project that CNC programs name.

#include "compiler/assets/cnc/cnc_source.hpp"

#include <array>

namespace stc {

namespace {

using stride::cnc::VariableType;

struct TypeName {
  std::string_view name;
  VariableType type;
};
constexpr std::array<TypeName, 12> kTypes = {{{"int", VariableType::Int},
                                              {"byte", VariableType::Byte},
                                              {"word", VariableType::Word},
                                              {"dint", VariableType::Dint},
                                              {"dword", VariableType::Dword},
                                              {"real", VariableType::Real},
                                              {"smc_m_parameters", VariableType::Structure},
                                              {"sint", VariableType::Sint},
                                              {"usint", VariableType::Usint},
                                              {"uint", VariableType::Uint},
                                              {"udint", VariableType::Udint},
                                              {"lreal", VariableType::Lreal}}};

std::optional<VariableType> typeOf(const ast::VarDecl &variable) {
  if (variable.type == nullptr || variable.type->kind != ast::TypeExprKind::Named)
    return std::nullopt;
  const auto *named = ast::as<ast::NamedTypeExpr>(variable.type);
  if (named->path.empty())
    return std::nullopt;
  const std::string name = lowerCase(named->path.back().text);
  for (const TypeName &type : kTypes)
    if (type.name == name)
      return type.type;
  return std::nullopt;
}

template <class Variables>
const ast::VarDecl *find(const Variables &variables, std::string_view lower) {
  for (const ast::VarDecl *variable : variables)
    if (lowerCase(variable->name.text) == lower)
      return variable;
  return nullptr;
}

/// `list`: of the list of globals, or the program, of this name; empty: any list.
const ast::VarDecl *findIn(const ast::Decl &decl, std::string_view list, std::string_view lower) {
  if (!decl.space.empty())
    return nullptr;
  if (decl.kind == ast::DeclKind::Globals && (list.empty() || lowerCase(decl.name.text) == list))
    return find(ast::as<ast::GlobalsDecl>(&decl)->variables, lower);
  if (decl.kind == ast::DeclKind::Program && !list.empty() && lowerCase(decl.name.text) == list)
    return find(ast::as<ast::PouDecl>(&decl)->variables, lower);
  return nullptr;
}

} // namespace

std::optional<VariableType> cncVariableType(const std::vector<ast::File *> &files,
                                            std::string_view name) {
  const std::string lower = lowerCase(name);
  if (lower == "gsmc_mparameters")
    return VariableType::Structure;
  const size_t dot = lower.find('.');
  const std::string list = dot == std::string::npos ? std::string() : lower.substr(0, dot);
  const std::string own = dot == std::string::npos ? lower : lower.substr(dot + 1);
  for (const ast::File *file : files)
    for (const ast::Decl *decl : file->declarations)
      if (const ast::VarDecl *variable = findIn(*decl, list, own))
        return typeOf(*variable);
  return std::nullopt;
}

} // namespace stc
