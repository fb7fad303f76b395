#include "compiler/codegen/initial/lifecycle.hpp"

#include "compiler/codegen/calls/calls.hpp"
#include "compiler/codegen/calls/methods.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/initial/initializers.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

const PouSymbol *ownMethod(const PouSymbol *block, std::string_view lower) {
  for (const PouSymbol *m : block->methods) {
    if (m->property == nullptr && block->isBlock() && m->name.id->lower == lower)
      return m;
  }
  return nullptr;
}

/// The type as written, where it names a block; null: it does not.
const NamedTypeExpr *constructOf(const VarSymbol *variable) {
  if (variable->decl == nullptr || variable->decl->type == nullptr)
    return nullptr;
  const TypeExpr *type = variable->decl->type;
  while (type->kind == TypeExprKind::Array)
    type = as<ArrayTypeExpr>(type)->element;
  return type->kind == TypeExprKind::Named ? as<NamedTypeExpr>(type) : nullptr;
}

/// Something for each instance in (the arrays of) `target`; `each` gets its place.
template <class Each>
void forEachInstance(EmitContext &cx, std::string_view target, const Type *type, Each &&each) {
  if (type->kind != TypeKind::Array) {
    each(target);
    return;
  }
  const std::string element = cx.temporary("element");
  initLoop(
      cx, [&] { cx.out << "for (auto &" << element << " : " << target << ".v) {"; },
      [&] { forEachInstance(cx, element, typeAs<ArrayType>(type)->element, each); });
}

/// An input of FB_Init.
void emitConstructInput(EmitContext &cx, const VarSymbol *input,
                        std::span<const Argument> arguments) {
  const auto given = std::find_if(arguments.rbegin(), arguments.rend(), [&](const Argument &a) {
    return a.parameter != nullptr && a.parameter->name.id == input->name.id;
  });
  if (given == arguments.rend() || given->value == nullptr)
    emitDefaultArgument(cx, input);
  else if (given->value->kind == ExprKind::Aggregate)
    emitAggregateValue(cx, input->type, given->value);
  else if (input->type->kind == TypeKind::Reference)
    emitAddressAs(cx, given->value, typeAs<PointerType>(input->type)->pointee);
  else
    emitValueAs(cx, given->value, input->type);
}

/// The FB_Inits of one instance, the base's first.
void callInits(EmitContext &cx, std::string_view target, const PouSymbol *block,
               std::span<const Argument> arguments) {
  std::vector<const PouSymbol *> chain;
  for (const PouSymbol *p = block; p != nullptr; p = p->base)
    chain.push_back(p);
  for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
    const PouSymbol *init = ownMethod(*at, "fb_init");
    if (init == nullptr)
      continue;
    cx.begin(cx.modes.init.span);
    cx.out << target << '.' << pathToBase(block, *at) << methodName(init) << '(' << cx.ctx()
           << ", ctx__.keepRetains == 0, ctx__.inCopyCode";
    for (const VarSymbol *p : constructInputs(*at)) {
      cx.out << ", ";
      emitConstructInput(cx, p, arguments);
    }
    cx.out << ");";
    cx.end();
  }
}

/// The elements of an array with a list of inputs each: they are written one after the other, from
/// element `at` of all; gives the number of the next one.
size_t constructEach(EmitContext &cx, const std::string &target, const Type *type,
                     const NamedTypeExpr *written, size_t at) {
  if (type->kind != TypeKind::Array) {
    callInits(cx, target, typeAs<PouType>(type)->symbol,
              at < written->elements.size() ? written->elements[at] : std::span<Argument>());
    return at + 1;
  }
  const auto *array = typeAs<ArrayType>(type);
  for (uint64_t i = 0; i < array->count(); ++i)
    at = constructEach(cx, target + ".v[" + std::to_string(i) + "]", array->element, written, at);
  return at;
}

/// A method with {attribute 'call_after_init'}: it may have inputs with defaults, and outputs,
/// which nobody wants.
void callMethod(EmitContext &cx, std::string_view target, const PouSymbol *block,
                const PouSymbol *method) {
  cx.begin(cx.modes.init.span);
  const std::vector<VarSymbol *> parameters = method->parameters();
  const bool outputs = std::any_of(parameters.begin(), parameters.end(), [](const VarSymbol *p) {
    return p->section == Section::Output;
  });
  if (outputs)
    cx.out << "{ ";
  std::string arguments;
  for (const VarSymbol *p : parameters) {
    if (p->section == Section::Output) {
      const std::string out = cx.temporary("out");
      cx.out << cx.type(p->type) << ' ' << out << "{}; ";
      arguments += ", " + out;
    } else {
      arguments += ", " + cx.text([&] { emitDefaultArgument(cx, p); });
    }
  }
  cx.out << target << '.' << pathToBase(block, method->owner) << methodName(method) << '('
         << cx.ctx() << arguments << ");" << (outputs ? " }" : "");
  cx.end();
}

/// `exit`, `reinit` of `fb_exit`, `fb_reinit`
std::string_view withoutPrefix(std::string_view what) { return what.substr(3); }

/// What exit__ and reinit__ do with one variable.
void emitLifecycleOf(EmitContext &cx, std::string_view target, const Type *type,
                     std::string_view what) {
  if (!cx.run.layouts.hasLifecycle(type, what))
    return;
  cx.includes.complete(innermost(type));
  forEachInstance(cx, target, type, [&](std::string_view each) {
    initLine(cx, each, '.', withoutPrefix(what), "__(", cx.ctx(), ");");
  });
}

void emitMembers(EmitContext &cx, const std::vector<const VarSymbol *> &variables,
                 const std::string &path, std::string_view what) {
  for (const VarSymbol *v : variables) {
    if (v->section == Section::InOut)
      continue;
    const Scoped<Initialised> mode(cx.modes.init, {v->name.span});
    emitLifecycleOf(cx, path + fieldName(v), v->type, what);
  }
}

/// The method of `block` or a base of it itself; false: `at` has none.
bool callOwn(EmitContext &cx, const PouSymbol *block, const PouSymbol *at, std::string_view what) {
  const PouSymbol *method = ownMethod(at, what);
  if (method == nullptr)
    return false;
  cx.begin(method->name.span);
  cx.out << "this->" << pathToBase(block, at) << methodName(method) << '(' << cx.ctx()
         << (what == "fb_exit" ? ", ctx__.inCopyCode);" : ");");
  cx.end();
  return true;
}

/// The members of a block and its bases.
void emitBlockMembers(EmitContext &cx, const PouSymbol *block, std::string_view what) {
  for (const PouSymbol *p = block; p != nullptr; p = p->base) {
    std::vector<const VarSymbol *> fields;
    std::copy_if(p->variables.begin(), p->variables.end(), std::back_inserter(fields), isField);
    emitMembers(cx, fields, "this->" + pathToBase(block, p), what);
  }
}

} // namespace

void construct(EmitContext &cx, std::string_view target, const VarSymbol *variable) {
  const Type *type = innermost(variable->type);
  if (type->kind != TypeKind::FunctionBlock)
    return;
  const PouSymbol *block = typeAs<PouType>(type)->symbol;
  if (findInit(block) == nullptr)
    return;
  const NamedTypeExpr *written = constructOf(variable);
  if (written != nullptr && !written->elements.empty()) {
    constructEach(cx, std::string(target), variable->type, written, 0);
    return;
  }
  const std::span<const Argument> arguments =
      written == nullptr ? std::span<const Argument>() : written->arguments;
  forEachInstance(cx, target, variable->type,
                  [&](std::string_view each) { callInits(cx, each, block, arguments); });
}

void constructPlain(EmitContext &cx, std::string_view target, const Type *type) {
  constructWith(cx, target, type, {});
}

void constructWith(EmitContext &cx, std::string_view target, const Type *type,
                   std::span<const Argument> arguments) {
  const Type *element = innermost(type);
  if (element->kind != TypeKind::FunctionBlock ||
      findInit(typeAs<PouType>(element)->symbol) == nullptr)
    return;
  forEachInstance(cx, target, type, [&](std::string_view each) {
    callInits(cx, each, typeAs<PouType>(element)->symbol, arguments);
  });
}

void callAfterInit(EmitContext &cx, std::string_view target, const Type *type) {
  const Type *element = innermost(type);
  if (element->kind != TypeKind::FunctionBlock)
    return;
  const PouSymbol *block = typeAs<PouType>(element)->symbol;
  const std::vector<PouSymbol *> methods = afterInitMethods(block);
  if (methods.empty())
    return;
  forEachInstance(cx, target, type, [&](std::string_view each) {
    for (const PouSymbol *m : methods)
      callMethod(cx, each, block, m);
  });
}

void exitAtEnd(EmitContext &cx, const VarSymbol *variable) {
  if (!cx.run.layouts.hasLifecycle(variable->type, "fb_exit"))
    return;
  const Scoped<Initialised> mode(cx.modes.init, {variable->name.span});
  const std::string end = cx.temporary("end");
  initLine(cx, "const ::stride::AtEnd ", end, "{[&] {");
  cx.open();
  emitLifecycleOf(cx, mangle(variable->name.text), variable->type, "fb_exit");
  cx.close();
  initLine(cx, "}};");
}

void emitLifecycle(EmitContext &cx, const std::vector<const VarSymbol *> &variables,
                   std::string_view what, const Type *base, const PouSymbol *block) {
  // FB_Exit: derived before base, the owner before what it holds. FB_Reinit: the other way round,
  // and only the last one (it calls its base's itself).
  const bool isExit = what == "fb_exit";
  if (isExit) {
    for (const PouSymbol *p = block; p != nullptr; p = p->base)
      callOwn(cx, block, p, what);
  }
  if (base != nullptr && cx.run.layouts.hasLifecycle(base, what))
    initLine(cx, "this->base__.", withoutPrefix(what), "__(", cx.ctx(), ");");
  if (block == nullptr)
    emitMembers(cx, variables, "this->", what);
  else
    emitBlockMembers(cx, block, what);
  if (!isExit) {
    for (const PouSymbol *p = block; p != nullptr; p = p->base) {
      if (callOwn(cx, block, p, what))
        break;
    }
  }
}

} // namespace stc::codegen
