// FB_Init, FB_Exit, FB_Reinit, 'call_after_init', and instances as declarations make them.

#include "compiler/semantics/classes/classes.hpp"

#include "compiler/semantics/classes/internal.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/declarations/declarations.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/attributes.hpp"

#include <unordered_set>

namespace stc::sema {

using namespace ast;

namespace {

/// The innermost type as written, `FB` of `ARRAY [1..3] OF FB`.
TypeExpr *innermost(TypeExpr *type) {
  while (type->kind == TypeExprKind::Array)
    type = as<ArrayTypeExpr>(type)->element;
  return type;
}

} // namespace

void checkConstruct(Context &c, VarSymbol *variable) {
  if (variable->section == Section::InOut || variable->decl == nullptr)
    return;
  const Type *type = variable->type;
  uint64_t count = 1;
  while (type->kind == TypeKind::Array) {
    count *= typeAs<ArrayType>(type)->count();
    type = typeAs<ArrayType>(type)->element;
  }
  TypeExpr *written = innermost(variable->decl->type);
  auto *named = written->kind == TypeExprKind::Named ? as<NamedTypeExpr>(written) : nullptr;
  if (type->kind != TypeKind::FunctionBlock) {
    if (named != nullptr && (named->hasArguments || !named->elements.empty()) && !isError(type))
      c.report(Code::WrongConstruct, written->span, typeName(type) + " takes no inputs here",
               "only instances of function blocks do")
          .help("write the initial value after the type: `:= …`");
    return;
  }
  PouSymbol *pou = typeAs<PouType>(type)->symbol;
  declare(c, pou);
  if (pou->isAbstract()) {
    auto &d = c.report(Code::AbstractInstance, variable->name.span,
                       "`" + std::string(pou->name.text) + "` is ABSTRACT: there are no instances",
                       "declared with an abstract block");
    noteDeclaration(d, pou);
    const std::string missing = missingMethods(pou);
    if (!missing.empty())
      d.note("it does not implement " + missing);
    d.help("use a block that extends it, or hold a POINTER TO or REFERENCE TO `" +
           std::string(pou->name.text) + "`");
    return;
  }
  if (named == nullptr || named->elements.empty()) {
    bindConstruct(c, named == nullptr ? std::span<Argument>() : named->arguments, pou,
                  written->span);
    return;
  }
  if (named->elements.size() != count)
    c.report(Code::WrongConstruct, written->span,
             std::to_string(named->elements.size()) + " lists of inputs for " +
                 std::to_string(count) + (count == 1 ? " instance" : " instances"),
             "one `(…)` for each element");
  for (const std::span<Argument> arguments : named->elements)
    bindConstruct(c, arguments, pou, written->span);
}

void bindConstruct(Context &c, std::span<Argument> arguments, PouSymbol *pou, Span span) {
  if (isIncomplete(pou))
    return; // its FB_Init may be one of those that are not there
  const std::vector<VarSymbol *> inputs = constructInputs(pou);
  const std::string name(pou->name.text);
  std::unordered_set<const VarSymbol *> given;
  bool failed = false;
  for (size_t i = 0; i < arguments.size(); ++i) {
    Argument &a = arguments[i];
    VarSymbol *input = !a.name && i < inputs.size() ? inputs[i] : nullptr;
    for (VarSymbol *v : inputs) {
      if (a.name && v->name.id == a.name.id)
        input = v;
    }
    if (input == nullptr || a.output) {
      failed = true;
      auto &d = c.report(
          Code::WrongConstruct, a.name ? a.name.span : a.span,
          inputs.empty() ? "the FB_Init of `" + name + "` takes nothing"
          : a.name ? "the FB_Init of `" + name + "` has no input `" + std::string(a.name.text) + "`"
                   : "the FB_Init of `" + name + "` has " + std::to_string(inputs.size()) +
                         (inputs.size() == 1 ? " input" : " inputs"),
          a.name ? "unknown input" : "one too many");
      std::vector<std::string_view> names;
      for (const VarSymbol *v : inputs)
        names.push_back(v->name.text);
      const auto similar = a.name ? nearest(a.name.text, names) : std::string_view();
      if (!similar.empty())
        d.help("a similar one exists: `" + std::string(similar) + "`");
      else if (VarSymbol *field = a.name ? findVariable(pou, a.name.id) : nullptr;
               field != nullptr && field->section == Section::Input)
        d.help("inputs of the block itself are initialised after the type: `: " + name + " := (" +
               std::string(a.name.text) + " := …)`");
      if (a.value != nullptr && a.value->kind != ExprKind::Aggregate)
        check(c, a.value);
      continue;
    }
    if (!given.insert(input).second)
      c.report(Code::DuplicateArgument, a.span,
               "`" + std::string(input->name.text) + "` is given twice", "given again here");
    a.parameter = input;
    if (a.value != nullptr)
      a.value = checkInit(c, a.value, typeOf(c, input));
  }
  std::string missing;
  for (const VarSymbol *v : inputs) {
    if (!given.contains(v) && v->decl->init == nullptr)
      missing += (missing.empty() ? "`" : ", `") + std::string(v->name.text) + "`";
  }
  if (missing.empty() || failed)
    return;
  auto &d = c.report(Code::WrongConstruct, span, "an instance of `" + name + "` needs " + missing,
                     "its FB_Init has inputs");
  d.label(inputs.front()->name.span, "declared here");
  std::string example;
  for (const VarSymbol *v : inputs)
    example += (example.empty() ? "" : ", ") + std::string(v->name.text) + " := …";
  d.help("give them with the type: `" + name + "(" + example + ")`");
}

void checkLifecycle(Context &c, PouSymbol *method) {
  const std::string_view lower = method->name.id->lower;
  const std::string name(method->name.text);
  const PouSymbol *owner = method->owner;
  std::vector<VarSymbol *> inputs;
  for (VarSymbol *v : method->parameters()) {
    if (v->section != Section::Input) {
      c.report(Code::WrongLifecycle, v->name.span,
               name + " is called by itself: it has only inputs", "not possible here");
      return;
    }
    inputs.push_back(v);
  }
  const Type *boolean = elementaryType(TypeKind::Boolean);
  const auto matches = [&](size_t i, std::string_view wanted) {
    return i < inputs.size() && inputs[i]->name.id->lower == wanted && inputs[i]->type == boolean;
  };
  std::string_view expected;
  if (lower == "fb_init" && (!matches(0, "binitretains") || !matches(1, "bincopycode")))
    expected = "bInitRetains : BOOL; bInCopyCode : BOOL";
  else if (lower == "fb_exit" && (inputs.size() != 1 || !matches(0, "bincopycode")))
    expected = "bInCopyCode : BOOL";
  else if (lower == "fb_reinit" && !inputs.empty())
    expected = "nothing";
  if (!expected.empty()) {
    c.report(Code::WrongLifecycle, method->name.span,
             expected == "nothing"
                 ? name + " has no inputs"
                 : name + " begins with the inputs `" + std::string(expected) + "`",
             "it is called by itself with these")
        .help("declare it as `METHOD " + name + " : BOOL` with `VAR_INPUT " +
              (expected == "nothing" ? std::string() : std::string(expected) + "; ") + "END_VAR`");
    return;
  }
  if (lower != "fb_init" || owner->base == nullptr)
    return;
  // The base's FB_Init is called with the inputs of the same names.
  for (const VarSymbol *b : constructInputs(owner->base)) {
    const auto it = method->scope.find(b->name.id);
    if (it != method->scope.end() && it->second->section == Section::Input &&
        it->second->type == b->type)
      continue;
    auto &d = c.report(Code::WrongLifecycle, method->name.span,
                       "this FB_Init lacks the input `" + std::string(b->name.text) + " : " +
                           typeName(b->type) + "` that the FB_Init of `" +
                           std::string(owner->base->name.text) + "` needs",
                       "the base's FB_Init is called first, with the same inputs");
    d.label(b->name.span, "declared here");
    return;
  }
}

void checkAfterInit(Context &c, PouSymbol *method) {
  if (!hasAttribute(method->decl->attributes, AttributeId::CallAfterInit) ||
      method->property != nullptr)
    return;
  for (const VarSymbol *v : method->parameters()) {
    if (v->section == Section::Output || v->decl->init != nullptr)
      continue;
    auto &d = c.report(Code::WrongLifecycle, v->name.span,
                       "`" + std::string(method->name.text) +
                           "` is called by itself after the initialisation",
                       "nobody gives it this input");
    d.help("remove the input, or the attribute 'call_after_init'");
    return;
  }
}

} // namespace stc::sema
