#include "compiler/codegen/calls/instances.hpp"

#include "compiler/codegen/calls/methods.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/initial/initializers.hpp"
#include "compiler/codegen/initial/lifecycle.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/semantics/held.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// Kept whatever INI is asked for: what an in-out is bound to, a place of VAR_CONFIG.
bool isBinding(const VarSymbol *v) { return v->section == Section::InOut || isSlot(v); }

bool isRetained(const VarSymbol *v) {
  return v->decl != nullptr && (v->decl->qualifiers & (kQualRetain | kQualPersistent)) != 0;
}

/// A value of the type holds a field of which `matches` is true, not counting what unions share.
template <class Matches> bool holdsField(const Type *type, Matches &&matches) {
  return anyHeld(type, [&](const Type *t, const VarSymbol *v) {
    if (v != nullptr && !isField(v))
      return Held::Over;
    if (v != nullptr && matches(v))
      return Held::Found;
    return t->kind == TypeKind::Structure && typeAs<StructType>(t)->isUnion ? Held::Over
                                                                            : Held::Inside;
  });
}

/// The fields of a structure or block, those of its bases included.
std::vector<const VarSymbol *> allFields(const Type *type) {
  std::vector<const VarSymbol *> list;
  if (type->kind == TypeKind::Structure) {
    for (const auto *s = typeAs<StructType>(type); s != nullptr && !s->isUnion; s = s->base)
      list.insert(list.end(), s->fields.begin(), s->fields.end());
  } else if (isInstance(type)) {
    for (const PouSymbol *p = typeAs<PouType>(type)->symbol; p != nullptr; p = p->base)
      std::copy_if(p->variables.begin(), p->variables.end(), std::back_inserter(list), isField);
  }
  return list;
}

/// Structures and instances in a value of the type that satisfy `wanted`, what they hold before
/// them, each once.
template <class Wanted>
void collectHeld(const Type *type, Wanted &&wanted, std::vector<const Type *> &list) {
  type = innermost(type);
  if (!wanted(type) || std::find(list.begin(), list.end(), type) != list.end())
    return;
  for (const VarSymbol *v : allFields(type))
    if (!isBinding(v)) // what an in-out is bound to lies elsewhere
      collectHeld(v->type, wanted, list);
  list.push_back(type);
}

/// The value means the same wherever it is written.
bool isPlain(const Expr *value) {
  if (value == nullptr || value->constant != nullptr)
    return true;
  if (value->kind != ExprKind::Aggregate)
    return false;
  const auto &items = as<AggregateExpr>(value)->items;
  return std::all_of(items.begin(), items.end(), [](const AggregateItem &item) {
    return isPlain(item.value) &&
           std::all_of(item.values.begin(), item.values.end(),
                       [](const AggregateItem &v) { return isPlain(v.value); });
  });
}

/// The initial value and the inputs of FB_Init that a variable is declared with name nothing but
/// constants.
bool isPlainlyDeclared(const VarSymbol *variable) {
  if (!isPlain(variable->decl->init))
    return false;
  const TypeExpr *type = variable->decl->type;
  while (type->kind == TypeExprKind::Array)
    type = as<ArrayTypeExpr>(type)->element;
  if (type->kind != TypeExprKind::Named)
    return true;
  const auto *named = as<NamedTypeExpr>(type);
  const auto plain = [](const Argument &a) { return isPlain(a.value); };
  return std::all_of(named->arguments.begin(), named->arguments.end(), plain) &&
         std::all_of(named->elements.begin(), named->elements.end(), [&](const auto &list) {
           return std::all_of(list.begin(), list.end(), plain);
         });
}

/// What is done to the values of a type, as the name of a local function for each.
using HeldFunctions = std::unordered_map<const Type *, std::string>;

/// The field of a value of the type, through the bases that have it: `base__.x`.
std::string fieldPath(const Type *type, const VarSymbol *field) {
  return basePath(type, field) + fieldName(field);
}

/// Calls `statement(place of one instance)` for `target`, or in loops for its elements.
template <class Statement>
void forEachElement(EmitContext &cx, const std::string &target, const Type *type,
                    Statement &&statement) {
  if (type->kind != TypeKind::Array) {
    statement(target);
    return;
  }
  const std::string element = cx.temporary("element");
  cx.out << "for (auto &" << element << " : " << target << ".v) { ";
  forEachElement(cx, element, typeAs<ArrayType>(type)->element, statement);
  cx.out << "} ";
}

/// A copy is bound to nothing. One function for each type: a value may hold it at many places.
void emitUnbind(EmitContext &cx, const std::string &target, const Type *type) {
  std::vector<const Type *> types;
  collectHeld(type, holdsInOut, types);
  HeldFunctions functions;
  for (const Type *t : types) {
    const std::string function = cx.temporary("unbind");
    cx.out << "const auto " << function << " = [&](auto &it) { ";
    for (const VarSymbol *v : allFields(t)) {
      const auto inner = functions.find(innermost(v->type));
      if (v->section != Section::InOut && inner == functions.end())
        continue;
      const std::string field = "it." + fieldPath(t, v);
      if (v->section == Section::InOut)
        cx.out << field << " = {}; ";
      else
        forEachElement(cx, field, v->type, [&](const std::string &each) {
          cx.out << inner->second << '(' << each << "); ";
        });
    }
    cx.out << "}; ";
    functions.emplace(t, function);
  }
  if (const auto outer = functions.find(innermost(type)); outer != functions.end())
    forEachElement(cx, target, type, [&](const std::string &each) {
      cx.out << outer->second << '(' << each << "); ";
    });
}

// ------------------------------------------------------------------------------------------------
// INI

/// `target` is zero and gets its initial values: those of its declaration, where one is named, else
/// those of its type.
void emitInitialValues(EmitContext &cx, std::string_view target, const Type *type,
                       const VarSymbol *declared, bool here) {
  if (declared != nullptr && (here || isPlainlyDeclared(declared))) {
    initVariable(cx, target, declared);
    return;
  }
  initDefault(cx, target, type);
  constructPlain(cx, target, type);
  callAfterInit(cx, target, type);
}

/// INI leaves something in values of the type as it is: bindings, and what is retained.
bool keepsValues(const Type *type) {
  return holdsField(type, [](const VarSymbol *v) { return isBinding(v) || isRetained(v); });
}

/// A line of statements of INI.
void initLine(EmitContext &cx, const std::string &text) {
  cx.begin(cx.modes.init.span);
  cx.out << text;
  cx.end();
}

/// Calls the function of `functions` for `it` and `was`, or in loops for their elements.
void callForBoth(EmitContext &cx, const HeldFunctions &functions, const std::string &it,
                 const std::string &was, const Type *type) {
  if (type->kind != TypeKind::Array) {
    initLine(cx, functions.at(type) + '(' + it + ", " + was + ");");
    return;
  }
  const auto *array = typeAs<ArrayType>(type);
  const std::string i = cx.temporary("i");
  initLine(cx, "for (::stride::ULINT " + i + " = 0; " + i + " < " + std::to_string(array->count()) +
                   "; ++" + i + ") {");
  const std::string element = ".v[" + i + "]";
  callForBoth(cx, functions, it + element, was + element, array->element);
  initLine(cx, "}");
}

/// Puts that back from the copy `old`; what is retained only when not `all` are initialised. One
/// function for each type: a value may hold it at many places.
void keepValues(EmitContext &cx, const std::string &target, const std::string &old,
                const Type *type, const std::string &all) {
  std::vector<const Type *> types;
  collectHeld(type, keepsValues, types);
  HeldFunctions functions;
  for (const Type *t : types) {
    const std::string function = cx.temporary("keep");
    initLine(cx, "const auto " + function + " = [&](auto &it, const auto &was) {");
    for (const VarSymbol *v : allFields(t)) {
      const std::string field = "." + fieldPath(t, v);
      if (isBinding(v))
        initLine(cx, "it" + field + " = was" + field + ";");
      else if (isRetained(v))
        initLine(cx, "if (!" + all + ") it" + field + " = was" + field + ";");
      if (!isBinding(v) && functions.contains(innermost(v->type)))
        callForBoth(cx, functions, "it" + field, "was" + field, v->type);
    }
    initLine(cx, "};");
    functions.emplace(t, function);
  }
  callForBoth(cx, functions, target, old, type);
}

/// INI of one place, which is known to be of the type; `declared` is the variable that it is,
/// `here` the one that the call names.
struct Reinitialised {
  std::string place;
  const Type *type;
  const VarSymbol *declared = nullptr;
  bool here = false;
};

/// `all` is the name of what says that retained values are initialised, too.
void emitReinitialised(EmitContext &cx, const Reinitialised &one, const std::string &all,
                       Span span) {
  cx.inlined([&] {
    cx.modes.init.span = span;
    const std::string old = cx.temporary("old");
    const bool kept = keepsValues(one.type);
    cx.begin(span);
    if (kept)
      cx.out << "const auto " << old << " = " << one.place << "; ";
    cx.out << "__builtin_memset(&" << one.place << ", 0, sizeof " << one.place << ");";
    cx.end();
    emitInitialValues(cx, one.place, one.type, one.declared, one.here);
    if (kept)
      keepValues(cx, one.place, old, one.type, all);
  });
}

/// The blocks that an instance of the type may really be, besides its own.
std::vector<const PouSymbol *> possibleBlocks(const EmitContext &cx, const Type *type) {
  if (type->kind != TypeKind::FunctionBlock || !hasTypeId(typeAs<PouType>(type)->symbol))
    return {};
  return derivedBlocks(cx.run.program, typeAs<PouType>(type)->symbol);
}

/// The variable that the expression names, if it is that and nothing that extends it.
const VarSymbol *exactVariable(const Expr *instance) {
  const Symbol *symbol = symbolAt(instance);
  return isExact(instance) && symbol != nullptr && symbol->kind == SymbolKind::Variable
             ? static_cast<const VarSymbol *>(symbol)
             : nullptr;
}

/// One case for each block that the instance may be.
void emitReinitialisedByType(EmitContext &cx, const std::vector<const PouSymbol *> &blocks,
                             const Reinitialised &own, const std::string &all, Span span) {
  cx.out << "switch (" << own.place << '.' << pathToTypeId(typeAs<PouType>(own.type)->symbol)
         << ") { ";
  for (const PouSymbol *p : blocks) {
    const std::string real = cx.temporary("real");
    cx.out << "case " << cx.run.names.typeId(p) << "U: { auto &" << real << " = reinterpret_cast<"
           << cx.type(p->type) << " &>(" << own.place << "); ";
    emitReinitialised(cx, {real, p->type}, all, span);
    cx.out << "break; } ";
  }
  cx.out << "default: { ";
  emitReinitialised(cx, own, all, span);
  cx.out << "break; } } ";
}

} // namespace

std::vector<const PouSymbol *> derivedBlocks(const Program &program, const PouSymbol *base) {
  std::vector<const PouSymbol *> list;
  for (const auto &library : program.libraries) {
    for (const PouSymbol *p : library->pous) {
      if (p->isBlock() && !p->isAbstract() && p != base && derivesFrom(p, base))
        list.push_back(p);
    }
  }
  return list;
}

// ------------------------------------------------------------------------------------------------
// copies

bool holdsInOut(const Type *type) {
  return holdsField(type, [](const VarSymbol *v) { return v->section == Section::InOut; });
}

/// A structure, block or array as a value. A copy has the type id of what it is, not of what it was
/// taken from, and none of its bindings.
void emitCopy(EmitContext &cx, const Expr *e, const Type *type) {
  std::string path;
  const PouSymbol *renamed = nullptr; // a block whose type id may be that of another
  if (isInstance(type)) {
    const PouSymbol *from = typeAs<PouType>(e->type)->symbol;
    const PouSymbol *to = typeAs<PouType>(type)->symbol;
    path = baseSuffix(from, to);
    if (hasTypeId(to) && (from != to || !isExact(e)))
      renamed = to;
  }
  if (renamed == nullptr && !holdsInOut(type)) {
    emitRaw(cx, e);
    cx.out << path;
    return;
  }
  const std::string copy = cx.temporary("copy");
  cx.out << "[&] { auto " << copy << " = ";
  emitRaw(cx, e);
  cx.out << path << "; ";
  if (renamed != nullptr)
    cx.out << copy << '.' << pathToTypeId(renamed) << " = " << cx.run.names.typeId(renamed)
           << "U; ";
  emitUnbind(cx, copy, type);
  cx.out << "return " << copy << "; }()";
}

void emitReinitialise(EmitContext &cx, const CallExpr *e) {
  const Expr *instance = e->arguments[0].value;
  const Type *type = instance->type;
  const std::string target = cx.temporary("instance");
  const std::string all = cx.temporary("all");
  const std::string keep = cx.temporary("keep");
  cx.includes.complete(type);
  cx.out << "[&] { auto &" << target << " = ";
  emitPlace(cx, instance);
  cx.out << "; const ::stride::BOOL " << all << " = ";
  emitValue(cx, e->arguments[1].value);
  // FB_Init is told by the context.
  cx.out << "; const ::stride::BOOL " << keep << " = " << cx.ctx() << ".keepRetains; " << cx.ctx()
         << ".keepRetains = !" << all << "; const ::stride::AtEnd " << cx.temporary("end")
         << "{[&] { " << cx.ctx() << ".keepRetains = " << keep << "; }}; ";
  const VarSymbol *declared = exactVariable(instance);
  const std::vector<const PouSymbol *> blocks =
      isExact(instance) ? std::vector<const PouSymbol *>() : possibleBlocks(cx, type);
  const Reinitialised own{target, type, declared,
                          declared != nullptr && namedVariable(instance) == declared};
  if (blocks.empty())
    emitReinitialised(cx, own, all, e->span);
  else
    emitReinitialisedByType(cx, blocks, own, all, e->span);
  cx.out << "return ::stride::BOOL{1}; }()";
}

} // namespace stc::codegen
