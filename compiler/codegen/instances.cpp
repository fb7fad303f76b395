// Instances as a whole: copies of them, INI, which gives them their initial values once more, and
// those of __NEW.

#include "compiler/codegen/units.hpp"
#include "compiler/semantics/held.hpp"
#include "compiler/semantics/hierarchy.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// Kept whatever INI is asked for: what an in-out is bound to, a place of VAR_CONFIG.
bool isBinding(const VarSymbol *v) { return v->section == Section::inOut || isSlot(v); }

bool isRetained(const VarSymbol *v) {
  return v->decl != nullptr && (v->decl->qualifiers & (qualRetain | qualPersistent)) != 0;
}

/// A value of the type holds a field of which `matches` is true, not counting what unions share.
template <class Matches> bool holdsField(const Type *type, Matches &&matches) {
  return anyHeld(type, [&](const Type *t, const VarSymbol *v) {
    if (v != nullptr && !isField(v))
      return Held::over;
    if (v != nullptr && matches(v))
      return Held::found;
    return t->kind == TypeKind::structure && typeAs<StructType>(t)->isUnion ? Held::over
                                                                            : Held::inside;
  });
}

/// The fields of a structure or block, those of its bases included.
std::vector<const VarSymbol *> allFields(const Type *type) {
  std::vector<const VarSymbol *> list;
  if (type->kind == TypeKind::structure) {
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
  if (value->kind != ExprKind::aggregate)
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
  while (type->kind == TypeExprKind::array)
    type = as<ArrayTypeExpr>(type)->element;
  if (type->kind != TypeExprKind::named)
    return true;
  const auto *named = as<NamedTypeExpr>(type);
  const auto plain = [](const Argument &a) { return isPlain(a.value); };
  return std::all_of(named->arguments.begin(), named->arguments.end(), plain) &&
         std::all_of(named->elements.begin(), named->elements.end(), [&](const auto &list) {
           return std::all_of(list.begin(), list.end(), plain);
         });
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
  return holdsField(type, [](const VarSymbol *v) { return v->section == Section::inOut; });
}

/// Calls `statement(place of one instance)` for `target`, or in loops for its elements.
template <class Statement>
void Emitter::eachElement(const std::string &target, const Type *type, Statement &&statement) {
  if (type->kind != TypeKind::array) {
    statement(target);
    return;
  }
  const std::string element = temporary("element");
  w_ << "for (auto &" << element << " : " << target << ".v) { ";
  eachElement(element, typeAs<ArrayType>(type)->element, statement);
  w_ << "} ";
}

/// A copy is bound to nothing. One function for each type: a value may hold it at many places.
void Emitter::unbind(const std::string &target, const Type *type) {
  std::vector<const Type *> types;
  collectHeld(type, holdsInOut, types);
  HeldFunctions functions;
  for (const Type *t : types) {
    const std::string function = temporary("unbind");
    w_ << "const auto " << function << " = [&](auto &it) { ";
    for (const VarSymbol *v : allFields(t)) {
      const auto inner = functions.find(innermost(v->type));
      if (v->section != Section::inOut && inner == functions.end())
        continue;
      const std::string field = "it." + fieldPath(t, v);
      if (v->section == Section::inOut)
        w_ << field << " = {}; ";
      else
        eachElement(field, v->type,
                    [&](const std::string &each) { w_ << inner->second << '(' << each << "); "; });
    }
    w_ << "}; ";
    functions.emplace(t, function);
  }
  if (const auto outer = functions.find(innermost(type)); outer != functions.end())
    eachElement(target, type,
                [&](const std::string &each) { w_ << outer->second << '(' << each << "); "; });
}

/// The field of a value of the type, through the bases that have it: `base__.x`.
std::string Emitter::fieldPath(const Type *type, const VarSymbol *field) {
  const std::size_t start = w_.size();
  basePath(type, field);
  w_ << fieldName(field);
  return w_.cut(start);
}

/// A structure, block or array as a value. A copy has the type id of what it is, not of what it was
/// taken from, and none of its bindings.
void Emitter::copyOf(const Expr *e, const Type *type) {
  std::string path;
  const PouSymbol *renamed = nullptr; // a block whose type id may be that of another
  if (isInstance(type)) {
    const PouSymbol *from = typeAs<PouType>(e->type)->symbol;
    const PouSymbol *to = typeAs<PouType>(type)->symbol;
    path = pathToBase(from, to);
    if (!path.empty())
      path = "." + path.substr(0, path.size() - 1);
    if (hasTypeId(to) && (from != to || !isExact(e)))
      renamed = to;
  }
  if (renamed == nullptr && !holdsInOut(type)) {
    raw(e);
    w_ << path;
    return;
  }
  const std::string copy = temporary("copy");
  w_ << "[&] { auto " << copy << " = ";
  raw(e);
  w_ << path << "; ";
  if (renamed != nullptr)
    w_ << copy << '.' << pathToTypeId(renamed) << " = " << c_.names.typeId(renamed) << "U; ";
  unbind(copy, type);
  w_ << "return " << copy << "; }()";
}

// ------------------------------------------------------------------------------------------------
// INI

/// `target` is zero and gets its initial values: those of its declaration, where one is named, else
/// those of its type.
void Emitter::initialValues(std::string_view target, const Type *type, const VarSymbol *declared,
                            bool here) {
  if (declared != nullptr && (here || isPlainlyDeclared(declared))) {
    initVariable(target, declared);
    return;
  }
  typeDefault(target, type);
  constructPlain(target, type);
  afterInit(target, type);
}

/// INI leaves something in values of the type as it is: bindings, and what is retained.
static bool keepsValues(const Type *type) {
  return holdsField(type, [](const VarSymbol *v) { return isBinding(v) || isRetained(v); });
}

/// A line of statements of INI.
void Emitter::initLine(const std::string &text) {
  begin(initSpan_);
  w_ << text;
  end();
}

/// Calls the function of `functions` for `it` and `was`, or in loops for their elements.
void Emitter::callForBoth(const HeldFunctions &functions, const std::string &it,
                          const std::string &was, const Type *type) {
  if (type->kind != TypeKind::array) {
    initLine(functions.at(type) + '(' + it + ", " + was + ");");
    return;
  }
  const auto *array = typeAs<ArrayType>(type);
  const std::string i = temporary("i");
  initLine("for (::stride::ULINT " + i + " = 0; " + i + " < " + std::to_string(array->count()) +
           "; ++" + i + ") {");
  const std::string element = ".v[" + i + "]";
  callForBoth(functions, it + element, was + element, array->element);
  initLine("}");
}

/// Puts that back from the copy `old`; what is retained only when not `all` are initialised. One
/// function for each type: a value may hold it at many places.
void Emitter::keepValues(const std::string &target, const std::string &old, const Type *type,
                         const std::string &all) {
  std::vector<const Type *> types;
  collectHeld(type, keepsValues, types);
  HeldFunctions functions;
  for (const Type *t : types) {
    const std::string function = temporary("keep");
    initLine("const auto " + function + " = [&](auto &it, const auto &was) {");
    for (const VarSymbol *v : allFields(t)) {
      const std::string field = "." + fieldPath(t, v);
      if (isBinding(v))
        initLine("it" + field + " = was" + field + ";");
      else if (isRetained(v))
        initLine("if (!" + all + ") it" + field + " = was" + field + ";");
      if (!isBinding(v) && functions.contains(innermost(v->type)))
        callForBoth(functions, "it" + field, "was" + field, v->type);
    }
    initLine("};");
    functions.emplace(t, function);
  }
  callForBoth(functions, target, old, type);
}

void Emitter::reinitialise(const CallExpr *e) {
  const Expr *instance = e->arguments[0].value;
  const Type *type = instance->type;
  const std::string target = temporary("instance");
  const std::string all = temporary("all");
  const std::string keep = temporary("keep");
  includes_.complete(type);
  w_ << "[&] { auto &" << target << " = ";
  place(instance);
  w_ << "; const ::stride::BOOL " << all << " = ";
  value(e->arguments[1].value);
  // FB_Init is told by the context.
  w_ << "; const ::stride::BOOL " << keep << " = " << ctx() << ".keepRetains; " << ctx()
     << ".keepRetains = !" << all << "; const ::stride::AtEnd " << temporary("end") << "{[&] { "
     << ctx() << ".keepRetains = " << keep << "; }}; ";
  const auto each = [&](const std::string &place, const Type *t, const VarSymbol *declared) {
    inlineStatements([&](Emitter &inner) {
      inner.initSpan_ = e->span;
      const std::string old = inner.temporary("old");
      const bool kept = keepsValues(t);
      inner.begin(e->span);
      if (kept)
        inner.w_ << "const auto " << old << " = " << place << "; ";
      inner.w_ << "__builtin_memset(&" << place << ", 0, sizeof " << place << ");";
      inner.end();
      inner.initialValues(place, t, declared,
                          declared != nullptr && namedVariable(instance) == declared);
      inner.initSpan_ = e->span;
      if (kept)
        inner.keepValues(place, old, t, all);
    });
  };
  const bool exact = isExact(instance);
  const Symbol *symbol = instance->kind == ExprKind::name     ? as<NameExpr>(instance)->symbol
                         : instance->kind == ExprKind::member ? as<MemberExpr>(instance)->symbol
                                                              : nullptr;
  const auto *declared = exact && symbol != nullptr && symbol->kind == SymbolKind::variable
                             ? static_cast<const VarSymbol *>(symbol)
                             : nullptr;
  std::vector<const PouSymbol *> derived;
  if (!exact && type->kind == TypeKind::functionBlock && hasTypeId(typeAs<PouType>(type)->symbol))
    derived = derivedBlocks(c_.program, typeAs<PouType>(type)->symbol);
  if (derived.empty()) {
    each(target, type, declared);
    w_ << "return ::stride::BOOL{1}; }()";
    return;
  }
  w_ << "switch (" << target << '.' << pathToTypeId(typeAs<PouType>(type)->symbol) << ") { ";
  for (const PouSymbol *p : derived) {
    const std::string real = temporary("real");
    w_ << "case " << c_.names.typeId(p) << "U: { auto &" << real << " = reinterpret_cast<"
       << this->type(p->type) << " &>(" << target << "); ";
    each(real, p->type, nullptr);
    w_ << "break; } ";
  }
  w_ << "default: { ";
  each(target, type, nullptr);
  w_ << "break; } } return ::stride::BOOL{1}; }()";
}

// -------------------------------------------------------------------------------------------------
// __NEW, __DELETE

/// Memory of the pool, with the defaults of its type.
void Emitter::newObject(const CallExpr *e) {
  const Type *t = e->arguments[0].value->type;
  const bool initialise = c_.layouts.needsInit(t);
  const std::string objects = temporary("objects");
  const std::string count = temporary("count");
  if (initialise) {
    w_ << "[&] { const ::stride::LINT " << count << " = ";
    if (e->arguments.size() > 1)
      value(e->arguments[1].value);
    else
      w_ << '1';
    w_ << "; auto *const " << objects << " = ";
  }
  w_ << "::stride::newObjects<" << type(t) << ">(" << ctx() << ", ";
  if (initialise)
    w_ << count;
  else if (e->arguments.size() > 1)
    value(e->arguments[1].value);
  else
    w_ << '1';
  w_ << ", " << c_.layouts.hash(t) << "ULL)";
  if (!initialise)
    return;
  const std::string i = temporary("i");
  w_ << "; for (::stride::LINT " << i << " = 0; " << objects << " != nullptr && " << i << " < "
     << count << "; ++" << i << ") { ";
  const std::string object = objects + "[" + i + "]";
  inlineStatements([&](Emitter &inner) {
    inner.initSpan_ = e->span;
    inner.typeDefault(object, t);
    inner.constructPlain(object, t);
    inner.afterInit(object, t);
  });
  w_ << "} return " << objects << "; }()";
}

/// The pointer is followed once, and 0 afterwards.
void Emitter::deleteObject(const CallExpr *e) {
  const std::string pointer = temporary("pointer");
  const Expr *variable = e->arguments[0].value;
  w_ << "{ auto &" << pointer << " = ";
  place(variable);
  w_ << "; ";
  const Type *pointee = typeAs<PointerType>(variable->type)->pointee;
  const auto exits = [&](const Type *real, const std::string &first) {
    if (!c_.layouts.hasLifecycle(real, "fb_exit"))
      return;
    includes_.complete(real);
    const std::string i = temporary("i");
    w_ << "for (::stride::ULINT " << i << " = 0; " << i << " < ::stride::poolCount(" << ctx()
       << ", " << pointer << "); ++" << i << ") " << first << '[' << i << "].exit__(" << ctx()
       << "); ";
  };
  // What was created may be a block that extends the one pointed to.
  std::vector<const PouSymbol *> derived;
  if (pointee->kind == TypeKind::functionBlock && hasTypeId(typeAs<PouType>(pointee)->symbol)) {
    for (const PouSymbol *p : derivedBlocks(c_.program, typeAs<PouType>(pointee)->symbol)) {
      if (c_.layouts.hasLifecycle(p->type, "fb_exit"))
        derived.push_back(p);
    }
  }
  if (derived.empty()) {
    exits(pointee, pointer);
  } else {
    includes_.complete(pointee);
    w_ << "if (::stride::poolCount(" << ctx() << ", " << pointer << ") != 0) { switch (" << pointer
       << "->" << pathToTypeId(typeAs<PouType>(pointee)->symbol) << ") { ";
    for (const PouSymbol *p : derived) {
      const std::string real = temporary("real");
      w_ << "case " << c_.names.typeId(p) << "U: { auto *const " << real << " = reinterpret_cast<"
         << type(p->type) << " *>(" << pointer << "); ";
      exits(p->type, real);
      w_ << "break; } ";
    }
    w_ << "default: ";
    exits(pointee, pointer);
    w_ << "break; } } ";
  }
  w_ << "::stride::poolDelete(" << ctx() << ", " << pointer << ", ";
  position(e->span);
  w_ << "); " << pointer << " = nullptr; }";
}

} // namespace stc::codegen
