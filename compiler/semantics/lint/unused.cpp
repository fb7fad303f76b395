// What is said about variables, results and POUs when all uses are known.

#include "compiler/semantics/lint/internal.hpp"

#include <algorithm>

namespace stc::lint {

using namespace ast;

static void reportVariable(Context &c, const Body &body, VarSymbol *variable);
static void reportUnused(Context &c, const Body &body, VarSymbol *variable);

namespace {

/// Methods that the language calls with fixed parameters.
bool isLifecycle(const PouDecl *decl) {
  const std::string_view name = decl->name.id == nullptr ? "" : decl->name.id->lower;
  return name == "fb_init" || name == "fb_exit" || name == "fb_reinit";
}

/// Instances whose FB_Init or FB_Exit does something need no other use.
bool doesSomethingItself(const Type *type) {
  while (type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (type->kind != TypeKind::FunctionBlock)
    return false;
  for (const PouSymbol *pou = typeAs<PouType>(type)->symbol; pou != nullptr; pou = pou->base) {
    if (std::any_of(pou->methods.begin(), pou->methods.end(),
                    [](const PouSymbol *method) { return isLifecycle(method->decl); }))
      return true;
  }
  return false;
}

/// Local variables end with the call, so nobody can see them from outside.
bool endsWithCall(const PouDecl *decl, const VarSymbol *v) {
  return v->section == Section::Temp ||
         ((decl->kind == DeclKind::Function || decl->kind == DeclKind::Method) &&
          v->section == Section::Local);
}

bool hasBody(const PouDecl *decl) {
  return std::any_of(decl->body.begin(), decl->body.end(),
                     [](const Stmt *s) { return s->kind != StmtKind::Empty; });
}

/// Written as an elementary type, so that its default is 0 and was not chosen by anybody.
bool hasPlainDefault(const VarSymbol *v) {
  if (v->decl == nullptr || v->decl->type == nullptr || v->decl->init != nullptr)
    return false;
  return v->decl->type->kind == TypeExprKind::String ||
         (v->decl->type->kind == TypeExprKind::Named && isElementary(v->type) &&
          v->type->kind != TypeKind::Enumeration && v->type->kind != TypeKind::Subrange &&
          as<NamedTypeExpr>(v->decl->type)->path.size() == 1 &&
          typeName(v->type).size() == as<NamedTypeExpr>(v->decl->type)->path[0].text.size());
}

} // namespace

void reportVariables(Context &c, const Body &body) {
  if (body.decl->external || (body.decl->modifiers & kModAbstract) != 0 ||
      body.decl->kind == DeclKind::Interface)
    return;
  for (const VarDecl *decl : body.decl->variables) {
    if (decl->symbol != nullptr && decl->symbol->type != nullptr && !isError(decl->symbol->type))
      reportVariable(c, body, decl->symbol);
  }
}

static void reportVariable(Context &c, const Body &body, VarSymbol *v) {
  if (c.usedOutside.contains(v) || v->hidden || v->decl->address != nullptr ||
      v->decl->access == Access::Public || !v->decl->attributes.empty())
    return;
  const PouDecl *decl = body.decl;
  const std::string name(v->name.text);
  const unsigned uses = usesOf(v);
  const bool written = (uses & (kUseWritten | kUseAddress)) != 0;
  const bool filled = decl->kind == DeclKind::Function || decl->kind == DeclKind::Method;
  switch (v->section) {
  case Section::Local:
  case Section::Temp:
  case Section::Stat:
  case Section::Instance:
    if (uses == 0 && !doesSomethingItself(v->type))
      report(c, Code::UnusedVariable, v->name.span, "`" + name + "` is never used", "only declared")
          .help("remove the declaration");
    else if (endsWithCall(decl, v) && (uses & kUseRead) == 0 && isElementary(v->type))
      report(c, Code::NeverRead, v->name.span, "`" + name + "` is assigned but never read",
             "its value is not used")
          .help("use the value, or remove the variable and its assignments");
    break;
  case Section::Input: {
    const bool free =
        decl == body.owner || (body.owner->interfaces.empty() && !body.pou->extended &&
                               body.owner->base.empty() && (decl->modifiers & kModOverride) == 0);
    const auto &checks = c.program.implicitChecks; // their inputs are prescribed
    const bool isCheck = std::find(checks.begin(), checks.end(), body.pou) != checks.end();
    if (filled && hasBody(decl) && free && !isLifecycle(decl) && !isCheck)
      reportUnused(c, body, v);
    break;
  }
  case Section::Output:
    if (!written && v->decl->init == nullptr && hasBody(decl) && body.owner == decl)
      report(c, Code::OutputNotAssigned, v->name.span,
             "the output `" + name + "` is never assigned", "always keeps its default value")
          .help("assign it in the body, or remove it");
    break;
  default:
    break;
  }
  if (v->earlyRead != nullptr && written && !body.hasLabels && hasPlainDefault(v) &&
      (endsWithCall(decl, v) || (filled && v->section == Section::Output)))
    report(c, Code::ReadBeforeWritten, v->earlyRead->span,
           "`" + name + "` is read before anything is assigned to it",
           isString(v->type) ? "always empty here" : "always has the default value here")
        .label(v->name.span, "declared without an initial value")
        .help("assign it first, or give it an initial value: `" + name + " : " + typeName(v->type) +
              " := …;`");
}

static void reportUnused(Context &c, const Body &body, VarSymbol *v) {
  if (usesOf(v) != 0)
    return;
  report(c, Code::UnusedParameter, v->name.span,
         "the input `" + std::string(v->name.text) + "` of `" + std::string(body.decl->name.text) +
             "` is never used",
         "its value has no effect")
      .help("use it, or remove it here and at the calls");
}

void reportResults(Context &c, const Body &body) {
  const PouDecl *decl = body.decl;
  if (decl->returnType == nullptr || decl->external || !hasBody(decl) ||
      (decl->modifiers & kModAbstract) != 0 || isLifecycle(decl) || c.resultsWritten.contains(decl))
    return;
  // Methods get a result type from an interface, or because a tool puts one there.
  const bool accessor =
      std::any_of(body.owner->properties.begin(), body.owner->properties.end(),
                  [decl](const PropertyDecl *property) { return property->get == decl; });
  if (decl->kind == DeclKind::Method && !accessor && !c.resultsTaken.contains(decl->name.id))
    return;
  // V2.3 demands a result type also where nobody wants a result.
  if (const auto calls = c.functionCalls.find(decl);
      calls != c.functionCalls.end() && calls->second.all == calls->second.asStatement)
    return;
  report(c, Code::ResultNotAssigned, decl->name.span,
         "the result of `" + std::string(decl->name.text) + "` is never assigned",
         "always gives the default value")
      .help("assign it to the function's name: `" + std::string(decl->name.text) + " := …;`");
}

void markUsed(Context &c, const Type *type) {
  // A list of those to come: chains of pointers may be long.
  for (std::vector<const Type *> pending{type}; !pending.empty();) {
    type = pending.back();
    pending.pop_back();
    if (type == nullptr || !c.usedTypes.insert(type).second)
      continue;
    switch (type->kind) {
    case TypeKind::Array:
      pending.push_back(typeAs<ArrayType>(type)->element);
      break;
    case TypeKind::Pointer:
    case TypeKind::Reference:
      pending.push_back(typeAs<PointerType>(type)->pointee);
      break;
    case TypeKind::FunctionBlock:
      c.usedPous.insert(typeAs<PouType>(type)->symbol);
      break;
    case TypeKind::Structure:
      for (const VarSymbol *field : typeAs<StructType>(type)->fields)
        pending.push_back(field->type);
      pending.push_back(typeAs<StructType>(type)->base);
      break;
    default:
      break;
    }
  }
}

void reportUnusedPous(Context &c, const Library &library) {
  for (const PouSymbol *pou : library.pous) {
    const DeclKind kind = pou->decl->kind;
    if ((kind != DeclKind::Function && kind != DeclKind::FunctionBlock) || c.usedPous.contains(pou))
      continue;
    const bool base =
        std::any_of(library.pous.begin(), library.pous.end(), [&](const PouSymbol *other) {
          return !other->decl->base.empty() && other->decl->base.back().id == pou->name.id;
        });
    if (!base)
      report(c, Code::UnusedPou, pou->name.span,
             "`" + std::string(pou->name.text) + "` is never used",
             kind == DeclKind::Function ? "nothing calls this function"
                                        : "there is no instance of this block");
  }
}

} // namespace stc::lint
