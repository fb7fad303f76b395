#include "compiler/codegen/initial/initializer_tables.hpp"

#include "compiler/codegen/expressions/constants.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/initial/initializers.hpp"
#include "compiler/codegen/places/places.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

constexpr size_t kMinTable = 8;
constexpr size_t kMostColumns = 32;

/// A step into a structure or an array.
struct Step {
  const VarSymbol *field = nullptr; ///< null: an element
  const Type *type = nullptr;       ///< what it is a step into
  size_t element = 0;
  bool operator==(const Step &) const = default;
};
using Way = std::vector<Step>;

/// A constant inside of an initial value: where, and as what.
struct Leaf {
  Way way;
  const Type *type;
  const Expr *value;
};

/// `.base__.x.v[3]`
std::string pathOf(const Way &way) {
  std::string path;
  for (const Step &step : way)
    path += step.field != nullptr ? "." + basePath(step.type, step.field) + fieldName(step.field)
                                  : ".v[" + std::to_string(step.element) + "]";
  return path;
}

bool sameWays(const std::vector<Leaf> &a, const std::vector<Leaf> &b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Leaf &x, const Leaf &y) { return x.way == y.way; });
}

/// Appends the constants of the value, in its order; false: there is something else in it, or too
/// much.
bool constantLeaves(const Type *type, const Expr *init, const Way &way, std::vector<Leaf> &leaves) {
  if (leaves.size() > kMostColumns)
    return false;
  if (init->kind != ExprKind::Aggregate) {
    leaves.push_back({way, type, init});
    return init->constant != nullptr && !isString(type) &&
           (isElementary(type) || type->kind == TypeKind::Enumeration);
  }
  const bool isArray = type->kind == TypeKind::Array;
  size_t place = 0;
  for (const AggregateItem &item : as<AggregateExpr>(init)->items) {
    if (item.repeat != nullptr || item.value == nullptr || !item.values.empty() ||
        (!isArray && (item.symbol == nullptr || item.symbol->isBit)))
      return false;
    Way inner = way;
    if (isArray)
      inner.push_back({nullptr, type, place++});
    else
      inner.push_back({item.symbol, type, 0});
    const Type *innerType = isArray ? typeAs<ArrayType>(type)->element : item.symbol->type;
    if (!constantLeaves(innerType, item.value, inner, leaves))
      return false;
  }
  return true;
}

/// `static constexpr T table__1[] = {…};` with what `element(i)` writes; gives its name.
template <class Element>
std::string declareTable(EmitContext &cx, std::string_view type, size_t size, Element &&element) {
  std::string table = cx.temporary("table");
  cx.begin(cx.modes.init.span);
  cx.out << "static constexpr " << type << ' ' << table << "[] = {";
  for (size_t i = 0; i < size; ++i) {
    cx.out << (i == 0 ? "" : ", ");
    element(i);
  }
  cx.out << "};";
  cx.end();
  return table;
}

std::string forEach(size_t count) {
  return "for (::stride::ULINT i__ = 0; i__ < " + std::to_string(count) + "; ++i__) ";
}

// -------------------------------------------------------------------------------------------------
// arrays

bool initFromConstants(EmitContext &cx, std::string_view target, const ArrayType *type,
                       const AggregateExpr *init) {
  const Type *element = type->element;
  const auto &items = init->items;
  if (items.size() < kMinTable || !isElementary(element) || isString(element) ||
      !std::all_of(items.begin(), items.end(), [](const AggregateItem &item) {
        return item.repeat == nullptr && item.value != nullptr && item.value->constant != nullptr;
      }))
    return false;
  const std::string table = declareTable(cx, cx.type(element), items.size(), [&](size_t i) {
    emitValueAs(cx, items[i].value, element);
  });
  initLine(cx, forEach(items.size()), target, ".v[i__] = ", table, "[i__];");
  return true;
}

/// The constants of each item, which all set the same places; empty: they do not.
std::vector<std::vector<Leaf>> similarItems(const ArrayType *type, const AggregateExpr *init) {
  std::vector<std::vector<Leaf>> rows;
  for (const AggregateItem &item : init->items) {
    std::vector<Leaf> row;
    if (item.repeat != nullptr || item.value == nullptr || !item.values.empty() ||
        item.value->kind != ExprKind::Aggregate ||
        !constantLeaves(type->element, item.value, {}, row) || row.empty() ||
        (!rows.empty() && !sameWays(row, rows[0])))
      return {};
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A long list of structures or arrays that all set the same places to constants: a table for each
/// of these places.
bool initFromColumns(EmitContext &cx, std::string_view target, const ArrayType *type,
                     const AggregateExpr *init) {
  if (init->items.size() < kMinTable || isElementary(type->element))
    return false;
  const std::vector<std::vector<Leaf>> rows = similarItems(type, init);
  if (rows.empty())
    return false;
  for (size_t column = 0; column < rows[0].size(); ++column) {
    const Type *columnType = rows[0][column].type;
    const std::string table = declareTable(cx, cx.type(columnType), rows.size(), [&](size_t i) {
      emitValueAs(cx, rows[i][column].value, columnType);
    });
    initLine(cx, forEach(rows.size()), target, ".v[i__]", pathOf(rows[0][column].way), " = ", table,
             "[i__];");
  }
  return true;
}

bool isPlainField(const VarSymbol *v) {
  return v->location == nullptr && v->decl != nullptr && v->decl->address == nullptr && isField(v);
}

/// The global variable whose address the value is, or null.
const VarSymbol *pointedGlobal(const Expr *value, const Type *pointer) {
  const Expr *place = addressed(value);
  if (place == nullptr || value->constant != nullptr || pointer->kind != TypeKind::Pointer)
    return nullptr;
  const VarSymbol *v = namedVariable(place);
  const bool plain = v != nullptr && v->globals != nullptr && isPlainField(v) && !isIndirect(v) &&
                     !v->isBit && !v->isConsistent;
  return plain && v->type == typeAs<PointerType>(pointer)->pointee ? v : nullptr;
}

/// A long list of addresses of variables of one list: a table of their places.
bool initFromAddresses(EmitContext &cx, std::string_view target, const ArrayType *type,
                       const AggregateExpr *init) {
  if (init->items.size() < kMinTable)
    return false;
  std::vector<const VarSymbol *> variables;
  for (const AggregateItem &item : init->items) {
    const VarSymbol *v =
        item.repeat == nullptr ? pointedGlobal(item.value, type->element) : nullptr;
    if (v == nullptr || (!variables.empty() && v->globals != variables[0]->globals))
      return false;
    variables.push_back(v);
  }
  const Root list{variables[0]->globals, false};
  const std::string owner = rootType(cx.run.names, list);
  const std::string table = declareTable(cx, "::stride::ULINT", variables.size(), [&](size_t i) {
    cx.out << "offsetof(" << owner << ", " << fieldName(variables[i]) << ')';
  });
  initLine(cx, forEach(variables.size()), target, ".v[i__] = reinterpret_cast<",
           cx.type(type->element), ">(reinterpret_cast<char *>(&", cx.root(list), ") + ", table,
           "[i__]);");
  return true;
}

// -------------------------------------------------------------------------------------------------
// variables one after the other

/// The variables that begin the list, have one type, and set the same places to constants.
std::vector<std::vector<Leaf>> similarValues(EmitContext &cx,
                                             std::span<const VarSymbol *const> variables) {
  std::vector<std::vector<Leaf>> rows;
  const Type *type = variables.front()->type;
  if (type->kind != TypeKind::Structure || Addressed::holdsBlock(type) ||
      typeAs<StructType>(type)->isUnion)
    return rows;
  for (const VarSymbol *v : variables) {
    if (v->type != type || !isPlainField(v))
      break;
    const Expr *init = cx.run.layouts.initOf(v);
    std::vector<Leaf> row;
    if (init == nullptr || init->kind != ExprKind::Aggregate ||
        !constantLeaves(type, init, {}, row) || (!rows.empty() && !sameWays(row, rows[0])))
      break;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// One place's values in all rows: what they have in common, or the element of a table that is
/// written here.
std::string columnOf(EmitContext &cx, const std::vector<std::vector<Leaf>> &rows, size_t column) {
  const Type *type = rows[0][column].type;
  const Constant first = constantOf(rows[0][column].value, type);
  if (std::all_of(rows.begin(), rows.end(), [&](const std::vector<Leaf> &row) {
        return constantOf(row[column].value, type) == first;
      }))
    return cx.text([&] { emitConstant(cx, first); });
  return declareTable(cx, cx.type(type), rows.size(),
                      [&](size_t i) { emitValueAs(cx, rows[i][column].value, type); }) +
         "[i__]";
}

} // namespace

bool initFromTable(EmitContext &cx, std::string_view target, const ArrayType *type,
                   const AggregateExpr *init) {
  return initFromConstants(cx, target, type, init) || initFromColumns(cx, target, type, init) ||
         initFromAddresses(cx, target, type, init);
}

size_t initRun(EmitContext &cx, std::span<const VarSymbol *const> variables,
               std::string_view owner) {
  const std::vector<std::vector<Leaf>> rows = similarValues(cx, variables);
  if (rows.size() < kMinTable)
    return 0;
  const VarSymbol *first = variables.front();
  const Scoped<Initialised> mode(cx.modes.init, {first->name.span});
  const std::string_view type = cx.type(first->type);
  const std::string name = fieldName(first);
  initLine(cx, "static_assert(offsetof(", owner, ", ", fieldName(variables[rows.size() - 1]),
           ") == offsetof(", owner, ", ", name, ") + ", rows.size() - 1, " * sizeof(", type,
           "), \"one after the other\");");
  std::vector<std::string> sources; // of each place's value
  for (size_t column = 0; column < rows[0].size(); ++column)
    sources.push_back(columnOf(cx, rows, column));
  const std::string loop = forEach(rows.size());
  initLoop(
      cx, [&] { cx.out << loop << '{'; },
      [&] {
        const std::string element = cx.temporary("element");
        initLine(cx, "auto &", element, " = *::stride::advance(&this->", name, ", i__ * sizeof(",
                 type, "));");
        initDefault(cx, element, first->type);
        for (size_t column = 0; column < sources.size(); ++column)
          initLine(cx, element, pathOf(rows[0][column].way), " = ", sources[column], ';');
      });
  return rows.size();
}

} // namespace stc::codegen
