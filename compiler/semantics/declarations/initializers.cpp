// Initial values of variables, array elements, fields and instances.

#include "compiler/semantics/declarations/declarations.hpp"

#include "compiler/semantics/calls/calls.hpp"
#include "compiler/semantics/classes/classes.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/expressions/expressions.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/names/names.hpp"

#include <algorithm>
#include <unordered_set>

namespace stc::sema {

using namespace ast;

static Expr *checkArrayInit(Context &c, AggregateExpr *init, const ArrayType *type);
static void checkFieldInit(Context &c, AggregateExpr *init, const Type *type);

namespace {

constexpr uint64_t kMaxExpanded = 1U << 20;

AggregateExpr *aggregate(Expr *e) {
  return e->kind == ExprKind::Aggregate ? as<AggregateExpr>(e) : nullptr;
}

} // namespace

void checkInitOf(Context &c, VarSymbol *variable) {
  if (variable->decl == nullptr)
    return;
  if (variable->initRunning) {
    c.report(Code::CircularConstant, variable->name.span,
             "the value of `" + std::string(variable->name.text) + "` depends on itself",
             "this definition is a circle");
    variable->initRunning = false;
    variable->constant = c.makeConstant({}); // known, so that nothing more is said about it
    return;
  }
  if (variable->initChecked)
    return;
  variable->initChecked = true;
  if (isTooDeep(c, variable->name)) {
    variable->constant = c.makeConstant({});
    return;
  }
  const Type *type = typeOf(c, variable);
  const ScopeGuard guard(c, {&c.names.moduleOf(variable), variable->owner, variable->home});
  checkConstruct(c, variable);
  if (variable->decl->init == nullptr) {
    if (variable->isConstant && variable->section != Section::Input &&
        variable->section != Section::InOut && !isError(type) && variable->library->isUser)
      c.report(Code::ConstantWithoutValue, variable->name.span,
               "the constant `" + std::string(variable->name.text) + "` has no value",
               "declared CONSTANT")
          .help("give it one: `" + std::string(variable->name.text) + " : " + typeName(type) +
                " := …;`");
    if (variable->isConstant && isElementary(type) && !isString(type) && !isError(type))
      variable->constant =
          c.makeConstant(isReal(type) ? ConstValue{ConstKind::Real, 0, 0, {}} : ConstValue{});
    return;
  }
  variable->initRunning = true;
  variable->decl->init = checkInit(c, variable->decl->init, type);
  variable->initRunning = false;
  if (!variable->isConstant || !isElementary(type) || isError(type) ||
      variable->constant != nullptr || variable->section == Section::Input)
    return;
  const Expr *init = variable->decl->init;
  if (isError(init->type))
    return;
  if (init->constant == nullptr) {
    c.report(Code::NotConstant, init->span, "the value of a constant must be known at compile time",
             "only known at run time");
    return;
  }
  if (const auto value = convertConstant(*init->constant, init->type, type))
    variable->constant = c.makeConstant(*value);
}

Expr *checkInit(Context &c, Expr *init, const Type *type) {
  if (isError(type))
    return init;
  AggregateExpr *list = aggregate(init);
  if (type->kind == TypeKind::Array) {
    if (list == nullptr) {
      check(c, init, type);
      if (isError(init->type) || init->type == type)
        return init; // `a : T := b` copies
      c.report(Code::WrongInitializer, init->span, "an array needs a list of values",
               "this is one value")
          .help("write `[…]`, for instance `[" + typeName(type).substr(0, 0) +
                "3(0)]` for three zeros");
      init->type = elementaryType(TypeKind::Error);
      return init;
    }
    if (list->isStruct) { // V2.3: one structure without brackets around it
      auto *outer = c.arena.make<AggregateExpr>();
      outer->span = list->span;
      AggregateItem item;
      item.value = list;
      item.span = list->span;
      outer->items = c.arena.copy(std::vector<AggregateItem>{item});
      list = outer;
    }
    return checkArrayInit(c, list, typeAs<ArrayType>(type));
  }
  if (type->kind == TypeKind::Structure || isInstance(type)) {
    if (list == nullptr) {
      check(c, init, type);
      if (type->kind == TypeKind::Structure)
        coerce(c, init, type, "the initial value");
      else if (!isError(init->type))
        c.report(Code::WrongInitializer, init->span, "an instance needs named values",
                 "not `name := value`")
            .help("write `(input := value, …)`");
      return init;
    }
    checkFieldInit(c, list, type);
    return list;
  }
  if (list != nullptr) {
    c.report(Code::WrongInitializer, init->span, typeName(type) + " cannot take a list of values",
             "expected one value of type " + typeName(type));
    init->type = elementaryType(TypeKind::Error);
    return init;
  }
  if (type->kind == TypeKind::Reference) {
    checkReference(c, init, typeAs<PointerType>(type)->pointee);
    return init;
  }
  checkAs(c, init, type, "the initial value");
  return init;
}

/// `n(0)` with a constant n is a repetition, not a call; only the names tell.
static void asRepetition(Context &c, AggregateItem &item) {
  if (item.value == nullptr || item.value->kind != ExprKind::Call)
    return;
  auto *call = as<CallExpr>(item.value);
  if (call->callee->kind != ExprKind::Name)
    return;
  Symbol *symbol = lookup(c, as<NameExpr>(call->callee)->name);
  if (symbol == nullptr || symbol->kind != SymbolKind::Variable ||
      static_cast<VarSymbol *>(symbol)->isResult ||
      isInstance(typeOf(c, static_cast<VarSymbol *>(symbol))))
    return;
  std::vector<AggregateItem> values;
  for (const Argument &a : call->arguments) {
    if (a.name || a.value == nullptr)
      return;
    AggregateItem inner;
    inner.value = a.value;
    inner.span = a.span;
    values.push_back(inner);
  }
  item.repeat = call->callee;
  item.value = values.size() == 1 ? values.front().value : nullptr;
  if (values.size() > 1)
    item.values = c.arena.copy(values);
}

static void checkItem(Context &c, AggregateItem &item, const Type *type) {
  asRepetition(c, item);
  if (item.repeat != nullptr) {
    const auto count = constantInteger(c, item.repeat, "the repetition of an initial value");
    if (count && *count < 0)
      c.report(Code::WrongInitializer, item.repeat->span,
               "a value cannot be repeated " + std::to_string(*count) + " times", "0 or more");
  }
  if (item.value != nullptr)
    item.value = checkInit(c, item.value, type);
  for (AggregateItem &inner : item.values)
    checkItem(c, inner, type);
}

namespace {

/// How many elements an item stands for; its repetition has been checked to be a constant.
uint64_t elements(const AggregateItem &item) {
  uint64_t own = 1;
  if (!item.values.empty()) {
    own = 0;
    for (const AggregateItem &inner : item.values)
      own += elements(inner);
  }
  if (item.repeat == nullptr)
    return own;
  if (item.repeat->constant == nullptr || item.repeat->constant->integer < 0)
    return 0;
  return own * static_cast<uint64_t>(item.repeat->constant->integer);
}

bool scalarsOnly(const std::span<AggregateItem> &items) {
  for (const AggregateItem &item : items) {
    if (item.value != nullptr && item.value->kind == ExprKind::Aggregate &&
        !as<AggregateExpr>(item.value)->isStruct)
      return false;
    if (!scalarsOnly(item.values))
      return false;
  }
  return true;
}

void expand(const AggregateItem &item, std::vector<AggregateItem> &out) {
  uint64_t count = 1;
  if (item.repeat != nullptr) // without a value it has been reported
    count = item.repeat->constant == nullptr
                ? 0
                : static_cast<uint64_t>(std::max<int64_t>(0, item.repeat->constant->integer));
  for (uint64_t i = 0; i < count; ++i) {
    if (item.values.empty()) {
      AggregateItem one = item;
      one.repeat = nullptr;
      out.push_back(one);
    } else {
      for (const AggregateItem &inner : item.values)
        expand(inner, out);
    }
  }
}

} // namespace

static Expr *checkArrayInit(Context &c, AggregateExpr *init, const ArrayType *type);

/// A flat list for an array of more dimensions: gives each row its part.
static void checkFlatInit(Context &c, AggregateExpr *init, const ArrayType *type) {
  const Type *scalar = type->element;
  uint64_t perRow = 1;
  while (scalar->kind == TypeKind::Array) {
    perRow *= typeAs<ArrayType>(scalar)->count();
    scalar = typeAs<ArrayType>(scalar)->element;
  }
  uint64_t total = 0;
  for (AggregateItem &item : init->items) {
    checkItem(c, item, scalar);
    total += elements(item);
  }
  if (total > perRow * type->count() || total > kMaxExpanded) {
    c.report(Code::TooManyValues, init->span,
             "the array has " + std::to_string(perRow * type->count()) + " elements, the list " +
                 std::to_string(total) + " values",
             total > kMaxExpanded ? "nest long lists: one `[…]` for each row" : "too many values");
    return;
  }
  std::vector<AggregateItem> flat;
  for (const AggregateItem &item : init->items)
    expand(item, flat);
  std::vector<AggregateItem> rows;
  for (size_t at = 0; at < flat.size(); at += perRow) {
    auto *row = c.arena.make<AggregateExpr>();
    row->span = flat[at].span;
    row->items = c.arena.copy(std::vector<AggregateItem>(
        flat.begin() + static_cast<ptrdiff_t>(at),
        flat.begin() + static_cast<ptrdiff_t>(std::min<uint64_t>(at + perRow, flat.size()))));
    AggregateItem item;
    item.value = checkArrayInit(c, row, typeAs<ArrayType>(type->element));
    item.span = row->span;
    rows.push_back(item);
  }
  init->items = c.arena.copy(rows);
}

static Expr *checkArrayInit(Context &c, AggregateExpr *init, const ArrayType *type) {
  init->type = type;
  for (AggregateItem &item : init->items) {
    if (item.field) {
      c.report(Code::WrongInitializer, item.field.span, "array elements have no names",
               "only values are possible here");
      return init;
    }
  }
  if (type->element->kind == TypeKind::Array && scalarsOnly(init->items)) {
    checkFlatInit(c, init, type);
    return init;
  }
  uint64_t total = 0;
  for (AggregateItem &item : init->items) {
    checkItem(c, item, type->element);
    const uint64_t before = total;
    total += elements(item);
    if (total > type->count() && before <= type->count()) {
      c.report(Code::TooManyValues, item.span.valid() ? item.span : init->span,
               "the array has " + std::to_string(type->count()) + " elements",
               "there is no element for this value");
      return init;
    }
  }
  return init;
}

static void checkFieldInit(Context &c, AggregateExpr *init, const Type *type) {
  init->type = type;
  if (isInstance(type))
    declare(c, typeAs<PouType>(type)->symbol);
  std::unordered_set<VarSymbol *> seen;
  if (type->kind == TypeKind::Structure && typeAs<StructType>(type)->isUnion &&
      init->items.size() > 1) {
    c.report(Code::UnionInit, init->items[1].span.valid() ? init->items[1].span : init->span,
             "only one member of a UNION can have an initial value",
             "this would overwrite the other one");
    return;
  }
  for (AggregateItem &item : init->items) {
    if (!item.field) {
      c.report(Code::WrongInitializer, item.span.valid() ? item.span : init->span,
               "the fields of " + typeName(type) + " are initialised by name", "which field?")
          .help("write `(field := value, …)`");
      return;
    }
    VarSymbol *field = findMember(c, type, item.field.id);
    if (field == nullptr || field->isResult || field->section == Section::Temp) {
      auto &d =
          c.report(Code::UnknownMember, item.field.span,
                   "`" + typeName(type) + "` has no member `" + std::string(item.field.text) + "`",
                   "unknown member");
      helpMembers(d, item.field, memberNames(type));
      if (item.value != nullptr && item.value->kind != ExprKind::Aggregate)
        check(c, item.value);
      continue;
    }
    if (!seen.insert(field).second) {
      c.report(Code::DuplicateArgument, item.field.span,
               "`" + std::string(item.field.text) + "` is given twice", "given again here");
      continue;
    }
    if (field->section == Section::InOut) {
      auto &d =
          c.report(Code::InOutWithInit, item.field.span,
                   "the VAR_IN_OUT `" + std::string(item.field.text) + "` cannot be initialised",
                   "it is bound at each call");
      noteDeclaration(d, field);
      continue;
    }
    item.symbol = field;
    if (item.value != nullptr)
      item.value = checkInit(c, item.value, typeOf(c, field));
  }
}

} // namespace stc::sema
