// Instances as a whole: copies of them, INI, which gives them their initial values once more, and
// those of __NEW.

#include "compiler/codegen/units.hpp"
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
  const std::vector<const VarSymbol *> fields = allFields(innermost(type));
  return std::any_of(fields.begin(), fields.end(), [](const VarSymbol *v) {
    return v->section == Section::inOut || holdsInOut(v->type);
  });
}

/// A copy is bound to nothing.
void Emitter::unbind(std::string_view target, const Type *type) {
  if (!holdsInOut(type))
    return;
  if (type->kind == TypeKind::array) {
    const std::string element = temporary("element");
    w_ << "for (auto &" << element << " : " << target << ".v) { ";
    unbind(element, typeAs<ArrayType>(type)->element);
    w_ << "} ";
    return;
  }
  for (const VarSymbol *v : allFields(type)) {
    const std::size_t start = w_.size();
    w_ << '.';
    basePath(type, v);
    w_ << fieldName(v);
    const std::string field = std::string(target) + w_.cut(start);
    if (v->section == Section::inOut)
      w_ << field << " = {}; ";
    else
      unbind(field, v->type);
  }
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

/// INI leaves something in values of the type as it is: bindings, and what is `retained`.
bool Emitter::keeps(const Type *type, bool retained) {
  const std::vector<const VarSymbol *> fields = allFields(innermost(type));
  return std::any_of(fields.begin(), fields.end(), [&](const VarSymbol *v) {
    return isBinding(v) || (retained && isRetained(v)) || keeps(v->type, retained);
  });
}

/// Puts that back from the copy `old`; what is retained only when not `all` are initialised.
void Emitter::keepValues(std::string_view target, std::string_view old, const Type *type,
                         std::string_view all) {
  if (!keeps(type, true))
    return;
  if (type->kind == TypeKind::array) {
    const std::string i = temporary("i");
    begin(initSpan_);
    w_ << "for (::stride::ULINT " << i << " = 0; " << i << " < " << typeAs<ArrayType>(type)->count()
       << "; ++" << i << ") {";
    end();
    const std::string element = ".v[" + i + "]";
    keepValues(std::string(target) + element, std::string(old) + element,
               typeAs<ArrayType>(type)->element, all);
    begin(initSpan_);
    w_ << '}';
    end();
    return;
  }
  for (const VarSymbol *v : allFields(type)) {
    const std::size_t start = w_.size();
    w_ << '.';
    basePath(type, v);
    w_ << fieldName(v);
    const std::string field = w_.cut(start);
    if (isBinding(v) || isRetained(v)) {
      begin(initSpan_);
      if (!isBinding(v))
        w_ << "if (!" << all << ") ";
      w_ << target << field << " = " << old << field << ';';
      end();
    }
    if (!isBinding(v))
      keepValues(std::string(target) + field, std::string(old) + field, v->type, all);
  }
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
      const bool kept = keeps(t, true);
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
