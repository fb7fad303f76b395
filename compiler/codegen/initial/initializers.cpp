#include "compiler/codegen/initial/initializers.hpp"

#include "compiler/codegen/calls/signatures.hpp"
#include "compiler/codegen/expressions/constants.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/initial/initializer_tables.hpp"
#include "compiler/codegen/initial/lifecycle.hpp"
#include "compiler/codegen/places/located.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/codegen/statements/assignments.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

constexpr uint64_t kMaxUnrolled = 16;

/// The value of an attribute `softmotion3` in C++.
std::string_view literalOf(const ast::Attribute &attribute) {
  if (attribute.value == "TRUE")
    return "1";
  return attribute.value == "FALSE" ? "0" : attribute.value;
}

/// `target = its address;`
void initReference(EmitContext &cx, std::string_view target, const Expr *value) {
  cx.begin(cx.modes.init.span);
  cx.out << target << " = ";
  emitAddress(cx, value);
  cx.out << ';';
  cx.end();
}

/// The type's default as one statement.
void emitDefault(EmitContext &cx, std::string_view target, const Type *type) {
  switch (type->kind) {
  case TypeKind::Enumeration: {
    const EnumeratorSymbol *initial = typeAs<EnumType>(type)->initial;
    cx.out << target << " = ";
    emitLiteral(cx, integerValue(initial->value), type, type, initial);
    cx.out << ';';
    return;
  }
  case TypeKind::Subrange:
    cx.out << target << " = ";
    emitNumber(cx, subrangeDefault(typeAs<SubrangeType>(type)), type);
    cx.out << ';';
    return;
  case TypeKind::Array: {
    const std::string element = cx.temporary("element");
    cx.out << "for (auto &" << element << " : " << target << ".v) ";
    emitDefault(cx, element, typeAs<ArrayType>(type)->element);
    return;
  }
  default:
    cx.includes.complete(type);
    cx.out << target << ".init__(" << cx.ctx() << ");";
    return;
  }
}

// -------------------------------------------------------------------------------------------------
// lists of values

void initFields(EmitContext &cx, std::string_view target, const Type *type,
                const AggregateExpr *list) {
  for (const AggregateItem &item : list->items) {
    if (item.symbol == nullptr || item.value == nullptr)
      continue;
    const std::string field =
        std::string(target) + '.' + basePath(type, item.symbol) + fieldName(item.symbol);
    if (item.symbol->type->kind == TypeKind::Reference) {
      initReference(cx, field, item.value);
      continue;
    }
    const Span span = item.span.valid() ? item.span : cx.modes.init.span;
    const Scoped<Span> own(cx.modes.init.span, span);
    initValue(cx, field, item.symbol->type, item.value);
  }
}

/// The elements of an array, one after the other.
struct Elements {
  std::string_view target;
  const ArrayType *type;
};

uint64_t initItems(EmitContext &cx, const Elements &array, std::span<AggregateItem> items,
                   const std::string &base, uint64_t at);

uint64_t repetition(const AggregateItem &item) {
  return item.repeat == nullptr ? 1 : static_cast<uint64_t>(item.repeat->constant->integer);
}

/// How many elements the items stand for.
uint64_t widthOf(std::span<AggregateItem> items) {
  uint64_t total = 0;
  for (const AggregateItem &item : items)
    total += repetition(item) * (item.values.empty() ? 1 : widthOf(item.values));
  return total;
}

/// `for (::stride::ULINT i = 0; i < count; ++i) `
void openCount(EmitContext &cx, const std::string &i, uint64_t count) {
  cx.out << "for (::stride::ULINT " << i << " = 0; " << i << " < " << count << "; ++" << i << ") ";
}

/// One value, `count` times from element `base` + `at` on.
void initRepeated(EmitContext &cx, const Elements &array, const Expr *value, uint64_t count,
                  const std::string &base, uint64_t at) {
  const std::string place = std::string(array.target) + ".v[" + base;
  if (count == 1) {
    initValue(cx, place + std::to_string(at) + "]", array.type->element, value);
    return;
  }
  const std::string i = cx.temporary("i");
  const std::string each = place + i + " + " + std::to_string(at) + "]";
  if (value->kind == ExprKind::Aggregate) {
    initLoop(
        cx,
        [&] {
          openCount(cx, i, count);
          cx.out << '{';
        },
        [&] { initValue(cx, each, array.type->element, value); });
    return;
  }
  cx.begin(cx.modes.init.span);
  openCount(cx, i, count);
  emitStoreTo(cx, each, array.type->element, value);
  cx.end();
}

/// Several values, `count` times; gives the next element.
uint64_t initRepeatedList(EmitContext &cx, const Elements &array, std::span<AggregateItem> values,
                          uint64_t count, const std::string &base, uint64_t at) {
  if (count <= kMaxUnrolled) {
    for (uint64_t i = 0; i < count; ++i)
      at = initItems(cx, array, values, base, at);
    return at;
  }
  const uint64_t width = widthOf(values);
  const std::string i = cx.temporary("i");
  initLoop(
      cx,
      [&] {
        openCount(cx, i, count);
        cx.out << '{';
      },
      [&] { initItems(cx, array, values, base + i + " * " + std::to_string(width) + " + ", at); });
  return at + count * width;
}

/// Places are `base` and a number, from `at` on; gives the number after the last one.
uint64_t initItems(EmitContext &cx, const Elements &array, std::span<AggregateItem> items,
                   const std::string &base, uint64_t at) {
  for (const AggregateItem &item : items) {
    const uint64_t count = repetition(item);
    if (!item.values.empty()) {
      at = initRepeatedList(cx, array, item.values, count, base, at);
      continue;
    }
    const bool skip = item.value == nullptr || (cx.modes.init.zeroed && isZero(item.value));
    if (!skip && count > 0)
      initRepeated(cx, array, item.value, count, base, at);
    at += count;
  }
  return at;
}

} // namespace

// -------------------------------------------------------------------------------------------------
// variables

void initVariable(EmitContext &cx, std::string_view target, const VarSymbol *variable) {
  if (variable->section == Section::InOut)
    return;
  Layouts &layouts = cx.run.layouts;
  const Scoped<Initialised> mode(cx.modes.init, {variable->name.span});
  if (variable->location != nullptr) {
    initLocated(cx, target, variable);
    return;
  }
  const Expr *init = layouts.initOf(variable);
  if (init != nullptr && variable->type->kind == TypeKind::Reference) {
    if (init->constant == nullptr)
      initReference(cx, target, init);
    return;
  }
  const bool whole =
      init != nullptr && init->kind != ExprKind::Aggregate; // replaces the type's default
  const Written written = Layouts::written(variable);
  if (!whole)
    initWritten(cx, target, variable->type, written);
  construct(cx, target, variable);
  cx.modes.init.zeroed = whole || (!layouts.needsInit(variable->type) &&
                                   !layouts.elementsHaveDefaults(written, variable->type));
  if (init != nullptr)
    initValue(cx, target, variable->type, init);
  if (const ast::Attribute *other = softMotion3Default(variable))
    initLine(cx, "if (", cx.ctx(), ".softMotion3 != 0) ", target, " = ", literalOf(*other), ';');
  callAfterInit(cx, target, variable->type);
}

void initWritten(EmitContext &cx, std::string_view target, const Type *type,
                 const Written &written) {
  initDefault(cx, target, type);
  Layouts &layouts = cx.run.layouts;
  if (!layouts.elementsHaveDefaults(written, type))
    return;
  const Written inner = layouts.elementOf(written, type);
  const Type *elementType = typeAs<ArrayType>(type)->element;
  const std::string element = cx.temporary("element");
  initLoop(
      cx, [&] { cx.out << "for (auto &" << element << " : " << target << ".v) {"; },
      [&] {
        if (const Expr *init = layouts.aliasDefault(inner, elementType)) {
          const Scoped<bool> zeroed(cx.modes.init.zeroed, !layouts.needsInit(elementType));
          initValue(cx, element, elementType, init);
        } else {
          initWritten(cx, element, elementType, inner);
        }
      });
}

void initDefault(EmitContext &cx, std::string_view target, const Type *type) {
  if (!cx.run.layouts.needsInit(type))
    return;
  cx.begin(cx.modes.init.span);
  emitDefault(cx, target, type);
  cx.end();
}

void initValue(EmitContext &cx, std::string_view target, const Type *type, const Expr *init) {
  if (init->kind != ExprKind::Aggregate) {
    if (cx.modes.init.zeroed && isZero(init))
      return;
    cx.begin(cx.modes.init.span);
    emitStoreTo(cx, target, type, init);
    cx.end();
    return;
  }
  const auto *list = as<AggregateExpr>(init);
  if (type->kind != TypeKind::Array) {
    initFields(cx, target, type, list);
    return;
  }
  const auto *array = typeAs<ArrayType>(type);
  if (!initFromTable(cx, target, array, list))
    initItems(cx, {target, array}, list->items, {}, 0);
}

void emitAggregateValue(EmitContext &cx, const Type *type, const Expr *init) {
  const std::string name = cx.temporary("value");
  cx.out << "[&] { ";
  declareTemporary(cx, type, name, Addressed::holdsBlock(type));
  cx.inlined([&] {
    initDefault(cx, name, type);
    initValue(cx, name, type, init);
  });
  cx.out << "return " << name << "; }()";
}

// -------------------------------------------------------------------------------------------------
// declarations

void declareLocal(EmitContext &cx, const VarSymbol *variable, Span start) {
  const std::string name = mangle(variable->name.text);
  const Expr *init = cx.run.layouts.initOf(variable);
  cx.begin(init == nullptr && start.valid() ? start : variable->name.span);
  if (cx.run.addressed.onDataStack(variable)) {
    declareTemporary(cx, variable->type, name, true);
  } else {
    if (!cx.uses.has(variable))
      cx.out << "[[maybe_unused]] ";
    cx.out << declared(cx.type(variable->type), name);
    if (init != nullptr && init->constant != nullptr && !isString(variable->type) &&
        isElementary(variable->type)) {
      cx.out << " = ";
      emitValueAs(cx, init, variable->type);
      cx.out << ';';
      cx.end();
      return;
    }
    cx.out << "{};";
  }
  cx.end();
  initVariable(cx, name, variable);
  if (!variable->isResult)
    exitAtEnd(cx, variable);
}

void declareInput(EmitContext &cx, const VarSymbol *input, Span start) {
  if (!cx.run.addressed.onDataStack(input))
    return;
  const std::string name = mangle(input->name.text);
  cx.begin(start.valid() ? start : input->name.span);
  cx.out << "::stride::OnDataStack<" << cx.type(input->type) << "> " << name << "__local("
         << cx.ctx() << ", " << inputName(cx.run, input) << "); [[maybe_unused]] auto &" << name
         << " = " << name << "__local.value();";
  cx.end();
}

void declareTemporary(EmitContext &cx, const Type *type, std::string_view name, bool onDataStack) {
  if (!onDataStack) {
    cx.out << cx.type(type) << ' ' << name << "{}; ";
    return;
  }
  cx.out << "::stride::OnDataStack<" << cx.type(type) << "> " << name << "__local(" << cx.ctx()
         << "); [[maybe_unused]] auto &" << name << " = " << name << "__local.value(); ";
}

} // namespace stc::codegen
