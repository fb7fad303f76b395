#include "compiler/codegen/layout_numbers.hpp"

#include "compiler/codegen/units.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/storage.hpp"

#include <algorithm>
#include <unordered_map>

namespace stc::codegen {

/// An array and its declaration cost g++ as much as the offsets of so many members. That it depends
/// on the type alone keeps sources as they are when other types come.
static constexpr size_t kFewestMembers = 16;

std::string offsetOf(std::string_view type, std::string_view member) {
  std::string out = "offsetof(";
  return out.append(type).append(", ").append(member).append(")");
}

std::string measuresOf(std::string_view kind, std::string_view type) {
  std::string out = "uint64_t(::stride::Kind::";
  return out.append(kind)
      .append("), sizeof(")
      .append(type)
      .append("), alignof(")
      .append(type)
      .append(")");
}

std::string_view instanceKind(const PouSymbol *pou) {
  return pou->type->kind == TypeKind::Program ? "Program" : "FunctionBlock";
}

bool hasOwnNumbers(const PouSymbol *pou) {
  if ((!pou->library->isUser && !pou->library->isBuilt) || pou->decl->external ||
      pou->isFunction() || pou->isInterface() || pou->isTemplate)
    return false;
  const std::vector<const VarSymbol *> variables = rootVariables({pou, false});
  // The others are not members of the structure, or have no address.
  return variables.size() >= kFewestMembers &&
         std::none_of(variables.begin(), variables.end(),
                      [](const VarSymbol *v) { return v->isBit || isPlaced(v); });
}

std::string numbersName(Context &context, const PouSymbol *pou) {
  return std::string(context.names.local(pou)) + "__numbers";
}

/// The definition of its numbers.
static std::string ownNumbers(Context &context, const PouSymbol *pou) {
  const std::string type(context.names.local(pou));
  const std::string name = numbersName(context, pou);
  std::string out = "\n#pragma GCC diagnostic ignored \"-Winvalid-offsetof\"\nnamespace st::";
  out.append(context.names.space(pou->library)).append(" {\n/// For the symbols in app.cpp.\n");
  out.append("extern const uint64_t ").append(name).append("[];\nconst uint64_t ").append(name);
  out.append("[] = {\n    ").append(measuresOf(instanceKind(pou), type)).append(",\n");
  const auto offset = [&](std::string_view member) {
    out.append("    ").append(offsetOf(type, member)).append(",\n");
  };
  if (pou->base != nullptr)
    offset("base__");
  if (carriesTypeId(pou))
    offset("type__");
  for (const VarSymbol *v : rootVariables({pou, false}))
    offset(fieldName(v));
  return out + "};\n}\n";
}

void addOwnNumbers(Context &context, const std::vector<const PouSymbol *> &pous,
                   std::vector<GeneratedFile> &files) {
  std::unordered_map<std::string, const PouSymbol *> byPath;
  for (const PouSymbol *pou : pous)
    byPath.emplace(context.names.source(pou), pou);
  for (GeneratedFile &file : files) {
    const auto found = byPath.find(file.path);
    if (found == byPath.end())
      continue;
    const std::string numbers = ownNumbers(context, found->second);
    file.text += numbers;
    file.tables = numbers.size();
  }
}

} // namespace stc::codegen
