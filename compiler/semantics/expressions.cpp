// Expressions without operators and calls: names, members, elements.

#include "compiler/semantics/alignment.hpp"
#include "compiler/semantics/checker.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/fold_builtins.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lint.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/semantics/suggest.hpp"
#include "compiler/source/stack.hpp"

namespace stc {

using namespace ast;

const Type *Checker::check(Expr *expr, const Type *expected) {
  if (expected != nullptr && expected->kind == TypeKind::subrange)
    expected = typeAs<SubrangeType>(expected)->base;
  const Type *type = elementaryType(TypeKind::error);
  if (stackIsShort(stackEnd_)) { // constants in the values of constants add up
    report(Code::tooDeep, expr->span, "this depends on too many other declarations",
           "one leads to the next");
    expr->type = type;
    return type;
  }
  switch (expr->kind) {
  case ExprKind::literal:
    type = checkLiteral(as<Literal>(expr));
    break;
  case ExprKind::name:
    type = checkName(as<NameExpr>(expr), expected);
    break;
  case ExprKind::member:
    type = checkMember(as<MemberExpr>(expr));
    break;
  case ExprKind::index:
    type = checkIndex(as<IndexExpr>(expr));
    break;
  case ExprKind::deref:
    type = checkDeref(as<DerefExpr>(expr));
    break;
  case ExprKind::call: {
    type = checkCall(as<CallExpr>(expr), false);
    break;
  }
  case ExprKind::unary:
    type = checkUnary(as<UnaryExpr>(expr), expected);
    break;
  case ExprKind::binary:
    type = checkBinary(as<BinaryExpr>(expr), expected);
    break;
  case ExprKind::enumLiteral:
    type = checkEnumLiteral(as<EnumLiteralExpr>(expr));
    break;
  case ExprKind::aggregate:
    report(Code::aggregateNotAllowed, expr->span, "a list of values can only be an initial value",
           "not an expression")
        .help("assign the elements one by one");
    break;
  case ExprKind::direct:
    type = checkDirect(as<DirectExpr>(expr));
    break;
  case ExprKind::typeName:
    report(Code::notAVariable, expr->span, "a type is not a value", "a type stands here");
    break;
  case ExprKind::error:
    break;
  }
  expr->type = type;
  return type;
}

void Checker::checkAs(Expr *expr, const Type *type, std::string_view what) {
  check(expr, type);
  coerce(expr, type, what);
}

void Checker::checkCondition(Expr *expr, std::string_view what) {
  const Type *boolean = elementaryType(TypeKind::boolean);
  const Type *type = check(expr, boolean);
  if (isError(type) || type == boolean)
    return;
  auto &d = report(Code::conditionNotBool, expr->span,
                   std::string(what) + " must be BOOL, this is " + typeName(type), "expected BOOL");
  if (isInteger(underlying(type)) || isReal(type) || type->kind == TypeKind::anyInteger ||
      type->kind == TypeKind::pointer) {
    const Span behind{expr->span.file, expr->span.end, expr->span.end};
    const std::string_view text = program_.sources.text(expr->span);
    d.suggest("compare it with a value: `" + (text.size() <= 40 ? std::string(text) : "…") +
                  " <> 0`",
              behind, " <> 0");
  }
}

// -------------------------------------------------------------------------------------------------------
// names

const Type *Checker::useSymbol(Expr *expr, Symbol *symbol, const Name &name) {
  switch (symbol->kind) {
  case SymbolKind::variable: {
    auto *variable = static_cast<VarSymbol *>(symbol);
    const Type *type = typeOf(variable);
    // A constant parameter has the caller's value.
    const bool parameter =
        variable->section == Section::input || variable->section == Section::inOut;
    if (variable->isConstant && !parameter && isElementary(type)) {
      checkInitOf(variable);
      expr->constant = variable->constant;
    }
    if (type->kind == TypeKind::reference)
      type = typeAs<PointerType>(type)->pointee;
    return type;
  }
  case SymbolKind::enumerator: {
    const auto *e = static_cast<EnumeratorSymbol *>(symbol);
    expr->constant = makeConstant(integerValue(e->value));
    return e->type;
  }
  case SymbolKind::pou: {
    auto *pou = static_cast<PouSymbol *>(symbol);
    if (pou->decl->kind == DeclKind::program) {
      if (pou->isTemplate) {
        reportTemplate(name, pou);
        return elementaryType(TypeKind::error);
      }
      declare(pou);
      return pou->type;
    }
    if (pou->isMethod()) {
      auto &d = report(Code::methodNotCalled, name.span,
                       "`" + std::string(name.text) + "` is " + describe(pou) + ", not a value",
                       "it has to be called");
      noteDeclaration(d, pou);
      d.help("call it: `" + std::string(name.text) + "()`");
      return elementaryType(TypeKind::error);
    }
    break;
  }
  case SymbolKind::property:
    return useProperty(expr, static_cast<PropertySymbol *>(symbol), name);
  case SymbolKind::self: {
    auto *self = static_cast<SelfSymbol *>(symbol);
    declare(self->block);
    return types_.pointer(self->block->type);
  }
  default:
    break;
  }
  auto &d = report(Code::notAVariable, name.span, "`" + std::string(name.text) + "` is not a value",
                   "this is " + describe(symbol));
  noteDeclaration(d, symbol);
  if (symbol->kind == SymbolKind::pou && static_cast<PouSymbol *>(symbol)->isFunction())
    d.help("call it: `" + std::string(name.text) + "(…)`");
  else if (symbol->kind == SymbolKind::pou && static_cast<PouSymbol *>(symbol)->isInterface())
    d.help("declare a variable of it: `x : " + std::string(name.text) + ";`");
  else if (symbol->kind == SymbolKind::pou)
    d.help("declare an instance of it: `x : " + std::string(name.text) + ";`");
  else if (symbol->kind == SymbolKind::builtin)
    d.help("call it: `" + std::string(name.text) + "(…)`");
  return elementaryType(TypeKind::error);
}

const Type *Checker::checkName(NameExpr *expr, const Type *expected) {
  Symbol *symbol = lookup(expr->name);
  const bool isValue = symbol != nullptr &&
                       (symbol->kind == SymbolKind::variable || symbol->kind == SymbolKind::pou ||
                        symbol->kind == SymbolKind::property || symbol->kind == SymbolKind::self);
  if (!isValue) {
    bool ambiguous = false;
    if (EnumeratorSymbol *e = lookupEnumerator(expr->name, expected, ambiguous)) {
      if (ambiguous) {
        auto &d = report(Code::ambiguousName, expr->name.span,
                         "`" + std::string(expr->name.text) + "` is an enumerator of several types",
                         "which one is meant?");
        for (EnumeratorSymbol *other : scope_.module->enumerators[expr->name.id])
          d.label(other->name.span, "of `" + typeName(other->type) + "`");
        d.help("write the type too: `" + typeName(e->type) + "." + std::string(expr->name.text) +
               "`");
        return elementaryType(TypeKind::error);
      }
      symbol = e;
    }
  }
  if (symbol == nullptr && expr->name.id->lower == "null") { // edition 3: the pointer to nothing
    expr->constant = makeConstant({});
    return types_.pointer(elementaryType(TypeKind::none));
  }
  if (symbol == nullptr) {
    if (!reportUnqualified(expr->name, expected))
      reportUnknown(expr->name, false);
    return elementaryType(TypeKind::error);
  }
  expr->symbol = symbol;
  return useSymbol(expr, symbol, expr->name);
}

Symbol *Checker::resolveNamespace(Expr *expr) {
  if (expr->kind == ExprKind::name) {
    auto *name = as<NameExpr>(expr);
    Symbol *symbol = lookup(name->name);
    if (symbol != nullptr && symbol->kind == SymbolKind::variable &&
        isElementary(typeOf(static_cast<VarSymbol *>(symbol)))) {
      // `color : Color := Color.red`: a variable without members does not hide a type, list or
      // library.
      Symbol *other = lookupDeclared(name->name);
      if (other == symbol || other == nullptr)
        other = lookupInLibraries(name->name.id);
      if (other != nullptr && other->kind == SymbolKind::type)
        symbol = other;
    }
    // `GVL.x`, although a variable or a POU may have the list's name, is not decided here: the
    // value wins.
    if (symbol != nullptr &&
        (symbol->kind == SymbolKind::type || symbol->kind == SymbolKind::library ||
         symbol->kind == SymbolKind::globals || symbol->kind == SymbolKind::space)) {
      name->symbol = symbol;
      return symbol;
    }
    return nullptr;
  }
  if (expr->kind == ExprKind::member) { // Library.Enum.value, Library.GVL.x
    auto *member = as<MemberExpr>(expr);
    if (member->bit >= 0)
      return nullptr;
    Symbol *base = resolveNamespace(member->base);
    if (base == nullptr)
      return nullptr;
    Symbol *symbol = nameInSpace(base, member->name);
    if (symbol != nullptr &&
        (symbol->kind == SymbolKind::type || symbol->kind == SymbolKind::space ||
         symbol->kind == SymbolKind::globals)) {
      member->symbol = symbol;
      return symbol;
    }
  }
  return nullptr;
}

/// `THIS^` or `SUPER^`
static bool isSelf(const Expr *expr) {
  if (expr->kind != ExprKind::deref)
    return false;
  const Expr *pointer = as<DerefExpr>(expr)->base;
  if (pointer->kind != ExprKind::name)
    return false;
  const Symbol *symbol = as<NameExpr>(pointer)->symbol;
  return symbol != nullptr && symbol->kind == SymbolKind::self;
}

const Type *Checker::checkMember(MemberExpr *expr) {
  if (expr->bit >= 0)
    return checkBit(expr);
  followSelf(expr->base);
  const std::string name(expr->name.text);
  if (Symbol *space = resolveNamespace(expr->base)) {
    Symbol *found = nullptr;
    std::vector<std::string_view> candidates;
    if (space->kind == SymbolKind::type) {
      auto *type = static_cast<TypeSymbol *>(space);
      resolve(type);
      if (type->type->kind == TypeKind::enumeration)
        found = findEnumerator(typeAs<EnumType>(type->type), expr->name.id);
      candidates = memberNames(type->type);
      if (type->type->kind != TypeKind::enumeration) {
        auto &d = report(Code::notAVariable, expr->base->span,
                         "`" + std::string(space->name.text) + "` is a type, not a variable",
                         "only variables have members");
        d.help("declare a variable: `x : " + std::string(space->name.text) + ";`");
        return elementaryType(TypeKind::error);
      }
    } else if (space->kind == SymbolKind::globals) {
      auto *list = static_cast<GlobalsSymbol *>(space);
      const auto it = list->scope.find(expr->name.id);
      found = it == list->scope.end() ? nullptr : it->second;
      for (const VarSymbol *v : list->variables)
        candidates.push_back(v->name.text);
    } else {
      found = nameInSpace(space, expr->name);
      if (space->kind == SymbolKind::space)
        for (const auto &[id, symbol] : static_cast<NamespaceSymbol *>(space)->names)
          candidates.push_back(symbol->name.text);
    }
    if (found == nullptr) {
      const Code code =
          space->kind == SymbolKind::type ? Code::unknownEnumerator : Code::unknownMember;
      auto &d = report(code, expr->name.span,
                       "`" + std::string(space->name.text) + "` has no `" + name + "`",
                       "not found in " + describe(space));
      helpMembers(d, expr->name, candidates);
      return elementaryType(TypeKind::error);
    }
    expr->symbol = found;
    return useSymbol(expr, found, expr->name);
  }
  const Type *base = check(expr->base);
  if (isSelf(expr->base))
    throughSelf_.emplace(scope_.pou, expr->name.id);
  return checkMemberOf(expr, base);
}

const Type *Checker::checkMemberOf(MemberExpr *expr, const Type *base) {
  const std::string name(expr->name.text);
  if (isError(base))
    return base;
  if (bitByName(expr))
    return checkBit(expr);
  if (isInstance(base) || base->kind == TypeKind::interface) {
    PouSymbol *pou = typeAs<PouType>(base)->symbol;
    declare(pou);
    if (Symbol *member = memberNamed(pou, expr->name.id)) {
      expr->symbol = member;
      return useSymbol(expr, member, expr->name);
    }
  }
  if (base->kind != TypeKind::structure && !isInstance(base) && base->kind != TypeKind::interface) {
    auto &d = report(Code::unknownMember, expr->name.span, typeName(base) + " has no members",
                     "`." + name + "` is not possible here");
    if (base->kind == TypeKind::pointer)
      d.help("follow the pointer first: `" + std::string(program_.sources.text(expr->base->span)) +
             "^." + name + "`");
    else if (isInteger(underlying(base)))
      d.help("a bit is selected by its number, `.3`, or by the name of an integer constant");
    return elementaryType(TypeKind::error);
  }
  VarSymbol *member = findMember(base, expr->name.id);
  if (member != nullptr &&
      (member->isResult || (member->owner == nullptr && member->globals != nullptr)))
    member = nullptr; // names that are only visible inside the POU
  if (member == nullptr) {
    // `w.cBit`: a bit by the name of a constant belongs to integers, which were handled above.
    auto &d = report(Code::unknownMember, expr->name.span,
                     "`" + typeName(base) + "` has no member `" + name + "`", "unknown member");
    helpMembers(d, expr->name, memberNames(base));
    return elementaryType(TypeKind::error);
  }
  const Access access = member->decl == nullptr ? Access::none : member->decl->access;
  if (access == Access::privateA && member->owner != nullptr &&
      !requireAccess(expr->name.span, member, member->owner, access))
    return elementaryType(TypeKind::error);
  if (member->owner != nullptr && access != Access::publicA && !insideOf(member->owner) &&
      (member->section == Section::temp ||
       (member->section == Section::local && base->kind == TypeKind::functionBlock))) {
    auto &d = report(Code::notAccessible, expr->name.span,
                     "`" + name + "` is private to `" + typeName(base) + "`",
                     "only its own code can use it");
    noteDeclaration(d, member);
    d.help("make it a VAR_OUTPUT (or VAR_INPUT) of `" + typeName(base) + "`");
    return elementaryType(TypeKind::error);
  }
  expr->symbol = member;
  return useSymbol(expr, member, expr->name);
}

bool Checker::bitByName(MemberExpr *expr) {
  const Type *base = underlying(expr->base->type);
  if (!isInteger(base))
    return false;
  Symbol *symbol = lookup(expr->name);
  if (symbol == nullptr || symbol->kind != SymbolKind::variable)
    return false;
  auto *variable = static_cast<VarSymbol *>(symbol);
  if (!variable->isConstant || !isInteger(underlying(typeOf(variable))))
    return false;
  checkInitOf(variable);
  if (variable->constant == nullptr)
    return false;
  const std::int64_t bit = variable->constant->integer;
  if (bit < 0 || bit >= bitWidth(base)) {
    auto &d = report(Code::bitOutOfRange, expr->name.span,
                     typeName(expr->base->type) + " has no bit " + std::to_string(bit),
                     "the bits are 0 to " + std::to_string(bitWidth(base) - 1));
    noteDeclaration(d, variable);
    expr->bit = 0;
    return true;
  }
  expr->bit = static_cast<std::int32_t>(bit);
  variable->uses |= useRead; // the bit's number is all that is left of the name
  return true;
}

const Type *Checker::checkBit(MemberExpr *expr) {
  const Type *base = expr->name ? expr->base->type : check(expr->base);
  if (isError(base))
    return base;
  const Type *u = underlying(base);
  const bool part = expr->width > 1;
  const std::string what = part ? "part" : "bit";
  if (!isInteger(u) || base->kind == TypeKind::enumeration) {
    auto &d =
        report(Code::bitOutOfRange, expr->span, typeName(base) + " has no " + what + "s to select",
               "only possible on integers and bit strings");
    if (isReal(u))
      d.help("look at the bytes of a REAL through a UNION or a pointer");
    else if (base->kind == TypeKind::enumeration)
      d.help("convert it first: `" + typeName(u) + "_TO_WORD(…)`");
    return elementaryType(TypeKind::error);
  }
  const unsigned count = bitWidth(u) / expr->width;
  if (static_cast<unsigned>(expr->bit) >= count) {
    static constexpr std::string_view kParts[] = {"", "byte", "word", "double word", "long word"};
    const std::string_view name = kParts[expr->width == 8    ? 1
                                         : expr->width == 16 ? 2
                                         : expr->width == 32 ? 3
                                         : expr->width == 64 ? 4
                                                             : 0];
    const std::string noun = part ? std::string(name) : what;
    report(Code::bitOutOfRange, expr->span,
           typeName(base) + " has no " + noun + " " + std::to_string(expr->bit),
           count == 0   ? "it is narrower than that"
           : count == 1 ? "there is only " + noun + " 0"
                        : "the " + noun + "s are 0 to " + std::to_string(count - 1));
    return elementaryType(TypeKind::error);
  }
  switch (expr->width) {
  case 8:
    return elementaryType(TypeKind::byte);
  case 16:
    return elementaryType(TypeKind::word);
  case 32:
    return elementaryType(TypeKind::dword);
  case 64:
    return elementaryType(TypeKind::lword);
  default:
    return elementaryType(TypeKind::boolean);
  }
}

const Type *Checker::checkIndex(IndexExpr *expr) {
  const Type *type = check(expr->base);
  bool bad = isError(type);
  for (std::size_t i = 0; i < expr->indices.size(); ++i) {
    Expr *index = expr->indices[i];
    const Type *indexType = check(index);
    if (bad)
      continue;
    const Type *next = indexStep(type);
    if (next == nullptr) {
      auto &d = report(Code::notIndexable, i == 0 ? expr->base->span : index->span,
                       i == 0 ? typeName(type) + " is not an array"
                              : "too many indices: the array has " + std::to_string(i) +
                                    (i == 1 ? " dimension" : " dimensions"),
                       i == 0 ? "cannot be indexed" : "one index too many");
      if (type->kind == TypeKind::pointer)
        d.help("nothing is known about what a POINTER TO VOID points to: use POINTER TO BYTE");
      bad = true;
      continue;
    }
    const Type *indexed =
        type->kind == TypeKind::reference ? typeAs<PointerType>(type)->pointee : type;
    type = next;
    if (isError(indexType))
      continue;
    if (!isInteger(underlying(indexType)) && indexType->kind != TypeKind::anyInteger) {
      report(Code::indexNotInteger, index->span,
             "an index must be an integer, this is " + typeName(indexType), "expected an integer");
      continue;
    }
    if (index->constant != nullptr && (indexed->kind == TypeKind::array || isString(indexed))) {
      const std::int64_t value = index->constant->integer;
      const bool isArray = indexed->kind == TypeKind::array;
      const std::int64_t low = isArray ? typeAs<ArrayType>(indexed)->low : 0;
      const std::int64_t high = isArray ? typeAs<ArrayType>(indexed)->high
                                        : std::int64_t{typeAs<StringType>(indexed)->length};
      if (value < low || value > high)
        report(Code::indexOutOfRange, index->span,
               "index " + std::to_string(value) + " is outside of the " +
                   (isArray ? "array" : "string"),
               "the bounds are " + std::to_string(low) + ".." + std::to_string(high));
    }
    if (indexType->kind == TypeKind::anyInteger)
      settle(index);
  }
  if (bad)
    return elementaryType(TypeKind::error);
  return type->kind == TypeKind::reference ? typeAs<PointerType>(type)->pointee : type;
}

const Type *Checker::checkDeref(DerefExpr *expr) {
  const Type *base = check(expr->base);
  if (isError(base))
    return base;
  if (base->kind != TypeKind::pointer) {
    report(Code::notAPointer, expr->span, typeName(base) + " is not a pointer",
           "`^` needs a POINTER TO …");
    return elementaryType(TypeKind::error);
  }
  const Type *pointee = typeAs<PointerType>(base)->pointee;
  if (pointee->kind == TypeKind::none) {
    report(Code::notAPointer, expr->span, "a POINTER TO VOID cannot be followed",
           "nothing is known about what is there")
        .help("assign it to a pointer of the right type first");
    return elementaryType(TypeKind::error);
  }
  return pointee;
}

// ------------------------------------------------------------------------------------------------------
// variables

bool Checker::requireVariable(Expr *expr, std::string_view what) {
  const std::string action(what);
  if (const PropertySymbol *property = propertyOf(expr);
      property != nullptr && (what == "assign to" || property->type == nullptr ||
                              property->type->kind == TypeKind::reference))
    return true; // the checker of names has seen to it that it has a SET
  if (rejectProperty(expr, what))
    return false;
  switch (expr->kind) {
  case ExprKind::deref:
  case ExprKind::error:
    return true;
  case ExprKind::direct:
    if (const Location *at = as<DirectExpr>(expr)->location; at != nullptr && what == "assign to")
      reportInputWritten(expr, *at);
    return true;
  case ExprKind::index: // what a pointer points to is a variable, even if the pointer is constant
    if (as<IndexExpr>(expr)->base->type != nullptr &&
        as<IndexExpr>(expr)->base->type->kind == TypeKind::pointer)
      return true;
    return requireVariable(as<IndexExpr>(expr)->base, what);
  case ExprKind::name:
  case ExprKind::member: {
    Symbol *symbol =
        expr->kind == ExprKind::name ? as<NameExpr>(expr)->symbol : as<MemberExpr>(expr)->symbol;
    if (expr->kind == ExprKind::member && as<MemberExpr>(expr)->bit >= 0)
      return requireVariable(as<MemberExpr>(expr)->base, what);
    if (symbol == nullptr || isError(expr->type))
      return true; // reported before
    if (symbol->kind != SymbolKind::variable) {
      auto &d = report(Code::notAssignable, expr->span,
                       "cannot " + action + " this: it is " + describe(symbol),
                       "a variable is needed here");
      noteDeclaration(d, symbol);
      return false;
    }
    auto *variable = static_cast<VarSymbol *>(symbol);
    if (variable->isConstant) {
      auto &d =
          report(Code::assignToConstant, expr->span,
                 "cannot " + action + " the constant `" + std::string(variable->name.text) + "`",
                 "declared CONSTANT");
      noteDeclaration(d, variable);
      return false;
    }
    if (variable->location != nullptr && what == "assign to")
      reportInputWritten(expr, *variable->location);
    if (expr->kind == ExprKind::member && variable->section == Section::output &&
        !insideOf(variable->owner)) {
      if (what == "pass")
        return true; // outputs of a block may be passed on as in-outs (TimeAxis.Axis)
      auto &d = report(Code::assignToOutput, expr->span,
                       "cannot " + action + " the output `" + std::string(variable->name.text) +
                           "` of `" + std::string(variable->owner->name.text) + "`",
                       "only the block itself writes its outputs");
      noteDeclaration(d, variable);
      return false;
    }
    // A field of a constant structure is constant, a field of a POU's variable is not.
    if (expr->kind == ExprKind::member && variable->owner == nullptr &&
        variable->globals == nullptr)
      return requireVariable(as<MemberExpr>(expr)->base, what);
    return true;
  }
  default:
    report(Code::notAssignable, expr->span, "cannot " + action + " an expression",
           "this is not a variable");
    return false;
  }
}

bool Checker::requireAligned(const Expr *expr, std::string_view what) {
  if (!isMisaligned(expr))
    return true;
  const unsigned align = alignmentOf(expr->type);
  auto &d =
      report(Code::misaligned, expr->span,
             "cannot " + std::string(what) + " this variable: it does not lie at a multiple of " +
                 std::to_string(align) + " bytes",
             "misaligned");
  if (locationOf(expr) != nullptr)
    d.note("its address is not a multiple of the size of " + typeName(expr->type));
  else
    d.note("a structure with pack_mode around it leaves no gaps that would align it");
  d.help("copy it into a variable of its own first, and back afterwards");
  return false;
}

} // namespace stc
