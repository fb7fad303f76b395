// Declarations: types as written become types, VAR sections become variables.

#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/source/stack.hpp"
#include "compiler/syntax/parser.hpp"

#include <algorithm>

namespace stc {

using namespace ast;

namespace {

constexpr std::int64_t kMaxArrayElements = std::int64_t{1} << 28;
constexpr std::int64_t kMaxStringLength = 65535;

bool hasAttribute(const Attributes &attributes, std::string_view name) {
  for (const Attribute &a : attributes) {
    if (a.name == name)
      return true;
  }
  return false;
}

} // namespace

// -------------------------------------------------------------------------------------------------
// named types

void Checker::resolve(TypeSymbol *symbol) {
  if (symbol->type != nullptr)
    return;
  if (symbol->resolving) {
    auto &d = report(Code::recursiveType, symbol->name.span,
                     "type `" + std::string(symbol->name.text) + "` is defined by itself",
                     "this definition is a circle");
    d.help("break the circle, for instance with POINTER TO");
    symbol->type = elementaryType(TypeKind::error);
    return;
  }
  if (isTooDeep(symbol->name)) {
    symbol->type = elementaryType(TypeKind::error);
    return;
  }
  symbol->resolving = true;
  const ScopeGuard guard(*this, {&moduleOf(symbol), nullptr, symbol->decl});
  switch (symbol->decl->kind) {
  case DeclKind::structure:
    resolveStruct(symbol, as<StructDecl>(symbol->decl));
    break;
  case DeclKind::enumeration: {
    auto *decl = as<EnumDecl>(symbol->decl);
    symbol->init = decl->init;
    symbol->type = makeEnum(decl->type, symbol);
    break;
  }
  default: {
    auto *decl = as<AliasDecl>(symbol->decl);
    const Type *type = resolveType(decl->type, symbol->name.text);
    if (symbol->type == nullptr) // a circle has set it to error
      symbol->type = type;
    symbol->init = decl->init;
    break;
  }
  }
  symbol->resolving = false;
  symbol->library->types.push_back(symbol);
}

unsigned Checker::packMode(const Attributes &attributes, unsigned otherwise) {
  for (const Attribute &a : attributes) {
    if (a.name != "pack_mode")
      continue;
    if (a.value == "0" || a.value == "1")
      return 1;
    if (a.value == "2" || a.value == "4" || a.value == "8")
      return static_cast<unsigned>(a.value[0] - '0');
    report(Code::packMode, a.span,
           "`" + std::string(a.value) + "` is no way to align the members of a structure",
           "0, 1, 2, 4 or 8 is possible")
        .note("0 and 1 leave no gaps; 2, 4 and 8 align each member to that many bytes at most");
  }
  return otherwise;
}

bool Checker::isTooDeep(const Name &name) {
  if (!stackIsShort(stackEnd_))
    return false;
  report(Code::tooDeep, name.span,
         "`" + std::string(name.text) + "` depends on too many other declarations",
         "one leads to the next");
  return true;
}

void Checker::extendStruct(StructType *type, const Name &baseName, const StructType *base) {
  if (base->bases >= kMaxNesting) {
    report(Code::tooDeep, baseName.span,
           "`" + std::string(baseName.text) + "` extends too many other structures",
           "more than " + std::to_string(kMaxNesting));
    return;
  }
  type->base = base;
  type->bases = base->bases + 1;
  type->symbol->fields = base->symbol->fields;
}

void Checker::resolveStruct(TypeSymbol *symbol, StructDecl *decl) {
  auto *type = arena_.make<StructType>();
  type->kind = TypeKind::structure;
  type->symbol = symbol;
  type->isUnion = decl->isUnion;
  symbol->type = type; // members may point back to it
  type->pack = packMode(decl->attributes, symbol->library->isUser ? program_.settings.pack : 0);
  if (!decl->base.empty()) {
    const Name &baseName = decl->base.back();
    Symbol *base = lookupPath(decl->base, true);
    if (base == nullptr) {
      type->base = nullptr; // reported
    } else if (base->kind == SymbolKind::type) {
      auto *baseSymbol = static_cast<TypeSymbol *>(base);
      const bool circle = baseSymbol->resolving;
      resolve(baseSymbol);
      if (!circle && baseSymbol->type->kind == TypeKind::structure) {
        extendStruct(type, baseName, typeAs<StructType>(baseSymbol->type));
      } else if (!isError(baseSymbol->type)) {
        report(circle ? Code::recursiveType : Code::wrongBase, baseName.span,
               circle ? "`" + std::string(symbol->name.text) + "` extends itself"
                      : "`" + std::string(baseName.text) + "` is not a structure",
               "a structure can only extend another structure");
      }
    } else {
      auto &d = report(Code::wrongBase, baseName.span,
                       "`" + std::string(baseName.text) + "` is not a structure",
                       "this is " + describe(base));
      noteDeclaration(d, base);
    }
  }
  std::vector<VarSymbol *> fields;
  for (VarDecl *f : decl->fields) {
    VarSymbol *field = makeVariable(f, moduleOf(symbol), nullptr);
    field->home = decl;
    const auto [it, fresh] = symbol->fields.emplace(f->name.id, field);
    if (!fresh) {
      auto &d = report(Code::duplicateName, f->name.span,
                       "the field `" + std::string(f->name.text) + "` is declared twice",
                       "declared again here");
      d.label(it->second->name.span, "first declared here");
      continue;
    }
    const std::string hint = std::string(symbol->name.text) + "__" + std::string(f->name.text);
    field->type = decl->isUnion ? resolveType(f->type, hint) : resolveMember(field, hint);
    if (f->address != nullptr)
      placeVariable(field);
    fields.push_back(field);
    for (const Attribute &a : f->attributes) { // a second name of the same field
      if (a.name == "alias")
        symbol->fields.emplace(program_.interner.intern(a.value), field);
    }
  }
  type->fields = arena_.copy(fields);
}

const EnumType *Checker::makeEnum(EnumTypeExpr *expr, TypeSymbol *symbol) {
  auto *type = arena_.make<EnumType>();
  type->kind = TypeKind::enumeration;
  type->symbol = symbol;
  symbol->type = type;
  type->base = elementaryType(TypeKind::intT);
  if (expr->base != nullptr) {
    const Type *base = resolveType(expr->base, {});
    if (isInteger(base))
      type->base = base;
    else if (!isError(base))
      report(Code::wrongBase, expr->base->span,
             "an enumeration cannot be based on " + typeName(base),
             "an integer or bit-string type is expected here");
  }
  if (symbol->decl != nullptr)
    type->strict = hasAttribute(symbol->decl->attributes, "strict");
  if (symbol->decl != nullptr)
    type->named = hasAttribute(symbol->decl->attributes, "to_string");
  Module &module = moduleOf(symbol);
  std::vector<EnumeratorSymbol *> list;
  std::unordered_map<Ident, EnumeratorSymbol *> seen;
  std::int64_t next = 0;
  for (EnumeratorDecl &e : expr->enumerators) {
    auto *enumerator = arena_.make<EnumeratorSymbol>();
    enumerator->kind = SymbolKind::enumerator;
    enumerator->name = e.name;
    enumerator->library = symbol->library;
    enumerator->space = symbol->space;
    enumerator->type = type;
    if (e.value != nullptr) {
      if (const auto value = constantInteger(e.value, "the value of an enumerator"))
        next = *value;
    }
    enumerator->value = next;
    const ConstValue value = integerValue(next);
    if (!constantFits(value, elementaryType(TypeKind::anyInteger), type->base))
      report(Code::constantOverflow, e.name.span,
             "the value " + std::to_string(next) + " of `" + std::string(e.name.text) +
                 "` does not fit into " + typeName(type->base))
          .help("give the enumeration a larger base type: `(…) DINT`");
    ++next;
    const auto [it, fresh] = seen.emplace(e.name.id, enumerator);
    if (!fresh) {
      auto &d = report(Code::duplicateName, e.name.span,
                       "the enumerator `" + std::string(e.name.text) + "` is declared twice",
                       "declared again here");
      d.label(it->second->name.span, "first declared here");
      continue;
    }
    list.push_back(enumerator);
    if (symbol->decl == nullptr || !hasAttribute(symbol->decl->attributes, "qualified_only"))
      (symbol->space == nullptr ? module.enumerators : symbol->space->enumerators)[e.name.id]
          .push_back(enumerator);
  }
  type->enumerators = arena_.copy(list);
  type->initial = list.empty() ? nullptr : list.front();
  if (symbol->init != nullptr) {
    check(symbol->init, type);
    coerce(symbol->init, type, "the initial value");
    if (symbol->init->constant != nullptr && !isError(symbol->init->type)) {
      for (EnumeratorSymbol *e : list) {
        if (e->value == symbol->init->constant->integer)
          type->initial = e;
      }
    }
  }
  // Its own declaration may use the plain names.
  type->qualifiedOnly =
      symbol->decl != nullptr && hasAttribute(symbol->decl->attributes, "qualified_only");
  return type;
}

// ----------------------------------------------------------------------------------------------
// types as written

const Type *Checker::resolveType(TypeExpr *expr, std::string_view hint) {
  switch (expr->kind) {
  case TypeExprKind::named:
    return resolveNamed(as<NamedTypeExpr>(expr));
  case TypeExprKind::array:
    return resolveArray(as<ArrayTypeExpr>(expr), hint);
  case TypeExprKind::string:
    return resolveString(as<StringTypeExpr>(expr));
  case TypeExprKind::subrange:
    return resolveSubrange(as<SubrangeTypeExpr>(expr), hint);
  case TypeExprKind::pointer:
  case TypeExprKind::reference:
    return resolvePointer(as<PointerTypeExpr>(expr), hint);
  case TypeExprKind::enumeration: {
    // An enumeration in line gets a name of its own, made of the variable's.
    TypeSymbol &symbol = program_.typeStorage.emplace_back();
    symbol.kind = SymbolKind::type;
    symbol.name.text = arena_.copy(hint);
    symbol.name.id = program_.interner.intern(hint);
    symbol.name.span = expr->span;
    symbol.library = scope_.module->library;
    const Type *type = makeEnum(as<EnumTypeExpr>(expr), &symbol);
    symbol.library->types.push_back(&symbol);
    return type;
  }
  case TypeExprKind::error:
    break;
  }
  return elementaryType(TypeKind::error);
}

bool Checker::namesBit(const TypeExpr *expr) {
  if (expr->kind != TypeExprKind::named || as<NamedTypeExpr>(expr)->path.size() != 1)
    return false;
  const Name &name = as<NamedTypeExpr>(expr)->path.front();
  if (name.id->lower != "bit")
    return false;
  const Symbol *own = lookupDeclared(name);
  return own == nullptr || own->kind == SymbolKind::variable;
}

const Type *Checker::resolveMember(VarSymbol *variable, std::string_view hint) {
  const VarDecl *decl = variable->decl;
  if (!namesBit(decl->type))
    return resolveType(decl->type, hint);
  if (decl->address != nullptr) {
    report(Code::bitNotPossible, decl->type->span, "a BIT cannot have an address of its own",
           "declared with AT")
        .help("write `BOOL`: a BOOL at `%IX0.0` is a single bit");
    return elementaryType(TypeKind::boolean);
  }
  variable->isBit = !variable->isConstant;
  return elementaryType(TypeKind::boolean);
}

const Type *Checker::resolveNamed(NamedTypeExpr *expr) {
  const Name &name = expr->path.back();
  Symbol *symbol = nullptr;
  if (expr->path.size() == 1) {
    const auto elementary = elementary_.find(name.id);
    if (elementary != elementary_.end()) {
      if (elementary->second != nullptr)
        return elementary->second;
    } else {
      const Type *type = findElementaryType(name.id->lower);
      if (type != nullptr && isCharacter(type)) { // V2.3 programs have types of this name
        const Symbol *own = lookupInModule(*scope_.module, name.id);
        if (own != nullptr && own->kind == SymbolKind::type)
          type = nullptr;
      }
      elementary_.emplace(name.id, type);
      if (type != nullptr)
        return type;
    }
    // Types are not hidden by variables of the same name (`TON : TON`).
    symbol = lookupDeclared(name);
    if (symbol == nullptr || symbol->kind == SymbolKind::variable) {
      Symbol *inLibrary = lookupInLibraries(name.id);
      symbol = inLibrary != nullptr ? inLibrary : symbol;
    }
    if (symbol == nullptr && scope_.pou != nullptr && scope_.pou->scope.contains(name.id))
      symbol = scope_.pou->scope.at(name.id);
  } else {
    symbol = lookupPath(expr->path, true);
    if (symbol == nullptr)
      return elementaryType(TypeKind::error);
  }
  if (symbol == nullptr) {
    if (!namesBit(expr)) {
      reportUnknown(name, true);
      return elementaryType(TypeKind::error);
    }
    report(Code::bitNotPossible, name.span, "there is no BIT here",
           "only fields of a STRUCT and variables of a FUNCTION_BLOCK can be BIT")
        .note(
            "a BIT shares its byte with others and has no address, so that there are no arrays of "
            "BIT and no pointers to it")
        .help("write `BOOL`");
    return elementaryType(TypeKind::error);
  }
  if (symbol->kind == SymbolKind::type) {
    auto *type = static_cast<TypeSymbol *>(symbol);
    resolve(type);
    return type->type;
  }
  if (symbol->kind == SymbolKind::pou && (static_cast<PouSymbol *>(symbol)->isBlock() ||
                                          static_cast<PouSymbol *>(symbol)->isInterface())) {
    auto *pou = static_cast<PouSymbol *>(symbol);
    link(pou);
    if (pou->space == nullptr) // of a namespace: see nameInSpace()
      requireAccess(name.span, pou, pou, pou->decl->access);
    return pou->type;
  }
  if (programTypes_ && symbol->kind == SymbolKind::pou &&
      static_cast<PouSymbol *>(symbol)->decl->kind == DeclKind::program)
    return static_cast<PouSymbol *>(symbol)->type;
  auto &d = report(Code::notAType, name.span, "`" + std::string(name.text) + "` is not a type",
                   "this is " + describe(symbol));
  noteDeclaration(d, symbol);
  return elementaryType(TypeKind::error);
}

bool Checker::isProgramInstance(const VarSymbol *variable) {
  return std::any_of(variable->decl->attributes.begin(), variable->decl->attributes.end(),
                     [](const Attribute &a) { return a.name == kProgramInstance; });
}

/// `Main.x` where all instances of the program have other names.
void Checker::reportTemplate(const Name &name, const PouSymbol *program) {
  std::vector<std::string_view> names;
  for (GlobalsSymbol *list : program->library->globals) {
    for (VarSymbol *v : list->variables) {
      if (isProgramInstance(v) && v->type == program->type)
        names.push_back(v->name.text);
    }
  }
  auto &d = report(Code::configurationProgram, name.span,
                   "which `" + std::string(name.text) + "`? Its instances have other names",
                   "the CONFIGURATION makes instances of it");
  std::string list;
  for (const std::string_view n : names)
    list += (list.empty() ? "`" : ", `") + std::string(n) + "`";
  d.help("write the name of an instance: " + list);
}

void Checker::resolveInstances(Module &module) {
  for (GlobalsSymbol *list : module.library->globals) {
    for (VarSymbol *v : list->variables) {
      if (!isProgramInstance(v))
        continue;
      const Type *type = typeOf(v);
      if (type->kind == TypeKind::program && v->decl->attributes.front().value != "also")
        typeAs<PouType>(type)->symbol->isTemplate = true;
    }
  }
}

const Type *Checker::resolveArray(ArrayTypeExpr *expr, std::string_view hint) {
  const Type *type = resolveType(expr->element, hint);
  for (const ArrayRange &range : expr->ranges) {
    if (range.low == nullptr)
      return resolveOpenArray(expr, type);
  }
  std::int64_t total = 1;
  for (std::size_t i = expr->ranges.size(); i-- > 0;) {
    ArrayRange &range = expr->ranges[i];
    const auto low = constantInteger(range.low, "an array bound");
    const auto high = constantInteger(range.high, "an array bound");
    if (!low || !high || isError(type))
      return elementaryType(TypeKind::error);
    std::int64_t count = 0;
    if (*high < *low || __builtin_sub_overflow(*high, *low, &count) || count >= kMaxArrayElements ||
        __builtin_mul_overflow(total, count + 1, &total) || total > kMaxArrayElements) {
      auto &d =
          report(Code::invalidArrayBounds, range.span,
                 *high < *low ? "the upper bound " + std::to_string(*high) +
                                    " is below the lower bound " + std::to_string(*low)
                              : std::string("the array is too large"),
                 *high < *low ? "these bounds hold no element" : "more than 268,435,456 elements");
      if (*high < *low)
        d.help("write the lower bound first: `" + std::to_string(*high) + ".." +
               std::to_string(*low) + "`");
      return elementaryType(TypeKind::error);
    }
    type = types_.array(type, *low, *high);
  }
  return type;
}

const Type *Checker::resolveString(StringTypeExpr *expr) {
  if (expr->length == nullptr)
    return types_.string(expr->wide, 80);
  const auto length = constantInteger(expr->length, "the length of a string");
  if (!length)
    return elementaryType(TypeKind::error);
  if (*length < 1 || *length > kMaxStringLength) {
    report(Code::invalidStringLength, expr->length->span,
           "a string cannot have the length " + std::to_string(*length), "1 to 65535 is possible");
    return elementaryType(TypeKind::error);
  }
  return types_.string(expr->wide, static_cast<std::uint32_t>(*length));
}

const Type *Checker::resolveSubrange(SubrangeTypeExpr *expr, std::string_view hint) {
  const Type *base = resolveType(expr->base, hint);
  const auto low = constantInteger(expr->low, "a bound of the range");
  const auto high = constantInteger(expr->high, "a bound of the range");
  if (isError(base) || !low || !high)
    return elementaryType(TypeKind::error);
  if (!isInteger(base)) {
    report(Code::invalidSubrange, expr->base->span,
           typeName(base) + " cannot be limited to a range", "an integer type is expected here");
    return elementaryType(TypeKind::error);
  }
  const Type *any = elementaryType(TypeKind::anyInteger);
  const bool fits =
      constantFits(integerValue(*low), any, base) && constantFits(integerValue(*high), any, base);
  if (*high < *low || !fits) {
    report(Code::invalidSubrange, expr->low->span.to(expr->high->span),
           *high < *low ? "the range holds no value"
                        : "the range does not fit into " + typeName(base),
           *high < *low ? "the upper bound is below the lower one"
                        : typeName(base) + " goes from " + std::to_string(integerRange(base).low) +
                              " to " + std::to_string(integerRange(base).high));
    return elementaryType(TypeKind::error);
  }
  return types_.subrange(base, *low, *high);
}

std::optional<std::int64_t> Checker::constantInteger(Expr *expr, std::string_view what) {
  const Type *type = check(expr);
  if (isError(type))
    return std::nullopt;
  if (expr->constant == nullptr || expr->constant->kind != ConstKind::integer ||
      !(type->kind == TypeKind::anyInteger || isInteger(underlying(type)))) {
    report(Code::notConstant, expr->span, std::string(what) + " must be an integer constant",
           expr->constant == nullptr ? "its value is only known at run time"
                                     : "this is " + typeName(type))
        .help("use a literal, or a variable declared in VAR CONSTANT or VAR_GLOBAL CONSTANT");
    return std::nullopt;
  }
  if (type->kind == TypeKind::anyInteger)
    settle(expr);
  return expr->constant->integer;
}

// ------------------------------------------------------------------------------------------------------
// variables

VarSymbol *Checker::makeVariable(VarDecl *decl, Module &module, PouSymbol *owner) {
  auto *symbol = arena_.make<VarSymbol>();
  symbol->kind = SymbolKind::variable;
  symbol->name = decl->name;
  symbol->library = module.library;
  symbol->decl = decl;
  symbol->section = decl->section;
  symbol->owner = owner;
  symbol->isConstant = (decl->qualifiers & qualConstant) != 0;
  symbol->hidden = hasAttribute(decl->attributes, "hide");
  decl->symbol = symbol;
  return symbol;
}

void Checker::declare(GlobalsSymbol *globals) {
  for (VarSymbol *v : globals->variables)
    typeOf(v);
}

const Type *Checker::typeOf(VarSymbol *variable) {
  if (variable->type != nullptr)
    return variable->type;
  if (variable->typeRunning) {
    report(Code::circularConstant, variable->name.span,
           "the type of `" + std::string(variable->name.text) + "` depends on its own value",
           "declared here");
    variable->type = elementaryType(TypeKind::error);
    return variable->type;
  }
  variable->typeRunning = true;
  programTypes_ = isProgramInstance(variable);
  const ScopeGuard guard(*this, {&moduleOf(variable), variable->owner, variable->home});
  openArrayAllowed_ = variable->section == Section::inOut ? variable->decl->type : nullptr;
  const Symbol *home =
      variable->owner != nullptr ? static_cast<const Symbol *>(variable->owner) : variable->globals;
  const std::string hint = std::string(home->name.text) + "__" + std::string(variable->name.text);
  const bool ofBlock =
      variable->owner != nullptr && variable->owner->isBlock() &&
      (variable->section == Section::local || variable->section == Section::input ||
       variable->section == Section::output);
  const Type *type =
      ofBlock ? resolveMember(variable, hint) : resolveType(variable->decl->type, hint);
  programTypes_ = false;
  if (variable->type == nullptr)
    variable->type = type;
  variable->typeRunning = false;
  if (variable->decl->address != nullptr)
    placeVariable(variable);
  checkRetain(variable);
  return variable->type;
}

void Checker::bindExternal(PouSymbol *pou, VarDecl *decl) {
  Symbol *global = lookupInModule(*scope_.module, decl->name.id);
  if (global == nullptr)
    global = lookupInLibraries(decl->name.id);
  if (global == nullptr || global->kind != SymbolKind::variable) {
    report(Code::externalMismatch, decl->name.span,
           "there is no global variable `" + std::string(decl->name.text) + "`",
           "declared as external here")
        .help("declare it in a VAR_GLOBAL list");
    return;
  }
  auto *variable = static_cast<VarSymbol *>(global);
  typeOf(variable);
  const Type *type = resolveType(decl->type, {});
  if (type != variable->type && !isError(type) && !isError(variable->type)) {
    auto &d = report(Code::externalMismatch, decl->type->span,
                     "`" + std::string(decl->name.text) + "` is " + typeName(variable->type) +
                         ", not " + typeName(type),
                     "this type differs from the global variable's");
    noteDeclaration(d, variable);
  }
  pou->scope.emplace(decl->name.id, variable);
}

void Checker::declare(PouSymbol *pou) {
  if (pou->declared)
    return;
  pou->declared = true;
  link(pou);
  if (pou->base != nullptr)
    declare(pou->base);
  for (PouSymbol *interface : pou->interfaces)
    declare(interface);
  Module &home = moduleOf(pou);
  const ScopeGuard guard(*this, {&home, pou});
  std::vector<VarSymbol *> variables;
  PouDecl *decl = pou->decl;
  for (VarDecl *v : decl->variables) {
    if (v->section == Section::external) {
      bindExternal(pou, v);
      continue;
    }
    if (v->section == Section::global || v->section == Section::config ||
        v->section == Section::access) {
      report(Code::sectionNotAllowed, v->name.span,
             std::string(v->section == Section::global ? "VAR_GLOBAL" : "this VAR section") +
                 " cannot stand inside of " + describe(pou),
             "declared here")
          .help("move it out of the POU");
      continue;
    }
    if (v->section == Section::instance && !pou->isMethod()) {
      report(Code::sectionNotAllowed, v->name.span, "VAR_INST is only possible in a METHOD",
             "declared here")
          .help("use VAR: the variables of " + describe(pou) +
                (pou->isFunction() ? " live as long as its call" : " are kept anyway"));
      continue;
    }
    if (pou->isInterface() || (pou->decl->kind == DeclKind::classD &&
                               v->section != Section::local && v->section != Section::stat)) {
      report(Code::sectionNotAllowed, v->name.span, describe(pou) + " has no such variables",
             "declared here")
          .help(pou->isInterface() ? "declare a PROPERTY" : "use VAR, a METHOD or a PROPERTY");
      continue;
    }
    VarSymbol *symbol = makeVariable(v, home, pou);
    const auto [it, fresh] = pou->scope.emplace(v->name.id, symbol);
    if (!fresh) {
      auto &d = report(Code::duplicateName, v->name.span,
                       "the name `" + std::string(v->name.text) + "` is declared twice",
                       "declared again here");
      d.label(it->second->name.span, "first declared here");
      continue;
    }
    variables.push_back(symbol);
  }
  TypeExpr *returnType = decl->returnType;
  if (pou->property != nullptr && pou->property->get == pou)
    returnType = pou->property->decl->type;
  if ((pou->isFunction() || pou->isMethod()) && returnType != nullptr) {
    auto *result = arena_.make<VarSymbol>();
    result->kind = SymbolKind::variable;
    result->name = pou->name;
    result->library = pou->library;
    result->owner = pou;
    result->isResult = true;
    const auto [it, fresh] = pou->scope.emplace(pou->name.id, result);
    if (!fresh) {
      auto &d = report(Code::duplicateName, it->second->name.span,
                       "a variable of `" + std::string(pou->name.text) + "` has " +
                           (pou->isMethod() ? "its" : "the function's") + " own name",
                       "this name stands for the result");
      d.label(pou->name.span, pou->isFunction()          ? "the function"
                              : pou->property != nullptr ? "the property"
                                                         : "the method");
    }
    result->type = resolveType(returnType, std::string(pou->name.text) + "__result");
    pou->result = result;
  }
  if (!pou->isMethod())
    declareMembers(pou, variables);
  pou->variables = arena_.copy(variables);
  // Types after names: an array bound may use a constant of the same POU.
  for (VarSymbol *v : variables) {
    typeOf(v);
    if (v->section == Section::inOut && v->decl->init != nullptr) {
      report(Code::inOutWithInit, v->decl->init->span,
             "a VAR_IN_OUT variable cannot have an initial value",
             "it always stands for the caller's variable")
          .help("remove the value, or make the variable a VAR_INPUT");
      v->decl->init = nullptr;
    }
  }
  if (!home.library->isUser && (pou->isFunction() || pou->isMethod())) {
    for (VarSymbol *v : variables)
      checkInitOf(v); // callers use the default values
  }
}

} // namespace stc
