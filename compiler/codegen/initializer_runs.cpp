// Many initial values that are alike, as tables and loops: g++ takes long for long functions.

#include "compiler/codegen/emitter.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

constexpr std::size_t kShortestRun = 8;

bool isPlainField(const VarSymbol *v) {
  return v->location == nullptr && v->decl != nullptr && v->decl->address == nullptr && isField(v);
}

/// The global variable whose address the value is, or null.
const VarSymbol *addressed(const Expr *value, const Type *pointer) {
  if (value == nullptr || value->kind != ExprKind::call || value->constant != nullptr)
    return nullptr;
  const auto *call = as<CallExpr>(value);
  if (call->resolved != Callee::builtin || call->builtin != Builtin::adr ||
      call->arguments.size() != 1 || pointer->kind != TypeKind::pointer)
    return nullptr;
  const VarSymbol *v = namedVariable(call->arguments[0].value);
  const bool plain = v != nullptr && v->globals != nullptr && isPlainField(v) && !isIndirect(v) &&
                     !v->isBit && !v->isConsistent;
  return plain && v->type == typeAs<PointerType>(pointer)->pointee ? v : nullptr;
}

} // namespace

/// The variables that begin the list, have one type, and set the same places to constants.
std::vector<std::vector<Emitter::Leaf>>
Emitter::similarValues(std::span<const VarSymbol *const> variables) {
  std::vector<std::vector<Leaf>> rows;
  const Type *type = variables.front()->type;
  if (type->kind != TypeKind::structure || Addressed::holdsBlock(type) ||
      typeAs<StructType>(type)->isUnion)
    return rows;
  for (const VarSymbol *v : variables) {
    if (v->type != type || !isPlainField(v))
      break;
    const Expr *init = c_.layouts.initOf(v);
    std::vector<Leaf> row;
    if (init == nullptr || init->kind != ExprKind::aggregate ||
        !constantLeaves(type, init, {}, row))
      break;
    if (!rows.empty() && !std::equal(row.begin(), row.end(), rows[0].begin(), rows[0].end(),
                                     [](const Leaf &a, const Leaf &b) { return a.path == b.path; }))
      break;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::size_t Emitter::initRun(std::span<const VarSymbol *const> variables, std::string_view owner) {
  const std::vector<std::vector<Leaf>> rows = similarValues(variables);
  if (rows.size() < kShortestRun)
    return 0;
  const VarSymbol *first = variables.front();
  initSpan_ = first->name.span;
  const std::string_view type = this->type(first->type);
  includes_.complete(first->type);
  begin(initSpan_);
  w_ << "static_assert(offsetof(" << owner << ", " << fieldName(variables[rows.size() - 1])
     << ") == offsetof(" << owner << ", " << fieldName(first) << ") + " << rows.size() - 1
     << " * sizeof(" << type << "), \"one after the other\");";
  end();
  std::vector<std::string> sources; // of each place's value
  for (std::size_t column = 0; column < rows[0].size(); ++column)
    sources.push_back(columnOf(rows, column));
  begin(initSpan_);
  w_ << "for (::stride::ULINT i__ = 0; i__ < " << rows.size() << "; ++i__) {";
  end();
  open();
  const std::string element = temporary("element");
  begin(initSpan_);
  w_ << "auto &" << element << " = *::stride::advance(&this->" << fieldName(first)
     << ", i__ * sizeof(" << type << "));";
  end();
  typeDefault(element, first->type);
  for (std::size_t column = 0; column < sources.size(); ++column) {
    begin(initSpan_);
    w_ << element << rows[0][column].path << " = " << sources[column] << ';';
    end();
  }
  close();
  begin(initSpan_);
  w_ << '}';
  end();
  return rows.size();
}

/// One place's values in all rows: what they have in common, or the element of a table that is
/// written here.
std::string Emitter::columnOf(const std::vector<std::vector<Leaf>> &rows, std::size_t column) {
  const Type *type = rows[0][column].type;
  std::vector<std::string> texts;
  for (const std::vector<Leaf> &row : rows) {
    const std::size_t start = w_.size();
    valueAs(row[column].value, type);
    texts.push_back(w_.cut(start));
  }
  if (std::all_of(texts.begin(), texts.end(),
                  [&](const std::string &text) { return text == texts[0]; }))
    return texts[0];
  const std::string table = temporary("table");
  begin(initSpan_);
  w_ << "static constexpr " << this->type(type) << ' ' << table << "[] = {";
  for (std::size_t i = 0; i < texts.size(); ++i)
    w_ << (i == 0 ? "" : ", ") << texts[i];
  w_ << "};";
  end();
  return table + "[i__]";
}

bool Emitter::addressTable(std::string_view target, const ArrayType *type,
                           const AggregateExpr *init) {
  if (init->items.size() < kShortestRun)
    return false;
  std::vector<const VarSymbol *> variables;
  for (const AggregateItem &item : init->items) {
    const VarSymbol *v = item.repeat == nullptr ? addressed(item.value, type->element) : nullptr;
    if (v == nullptr || v->globals != addressed(init->items[0].value, type->element)->globals)
      return false;
    variables.push_back(v);
  }
  const Root list{variables[0]->globals, false};
  const std::string owner = rootType(c_.names, list);
  const std::string table = temporary("table");
  begin(initSpan_);
  w_ << "static constexpr ::stride::ULINT " << table << "[] = {";
  for (std::size_t i = 0; i < variables.size(); ++i)
    w_ << (i == 0 ? "" : ", ") << "offsetof(" << owner << ", " << fieldName(variables[i]) << ')';
  w_ << "};";
  end();
  begin(initSpan_);
  w_ << "for (::stride::ULINT i__ = 0; i__ < " << variables.size() << "; ++i__) " << target
     << ".v[i__] = reinterpret_cast<" << this->type(type->element) << ">(reinterpret_cast<char *>(&"
     << root(list) << ") + " << table << "[i__]);";
  end();
  return true;
}

} // namespace stc::codegen
