// Initial values. Memory is zero before, so that only what differs from zero is written.

#include "compiler/codegen/emitter.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

constexpr std::size_t kMinTable = 8;
constexpr std::uint64_t kMaxUnrolled = 16;
constexpr std::size_t kMostColumns = 32;

std::uint64_t repetition(const AggregateItem &item) {
  return item.repeat == nullptr ? 1 : static_cast<std::uint64_t>(item.repeat->constant->integer);
}

} // namespace

void Emitter::initVariable(std::string_view target, const VarSymbol *variable) {
  if (variable->section == Section::inOut)
    return;
  initSpan_ = variable->name.span;
  if (variable->location != nullptr) {
    initLocated(target, variable);
    return;
  }
  const Expr *init = c_.layouts.initOf(variable);
  if (init != nullptr && variable->type->kind == TypeKind::reference) {
    if (init->constant != nullptr)
      return;
    begin(initSpan_);
    w_ << target << " = ";
    address(init);
    w_ << ';';
    end();
    return;
  }
  const bool whole =
      init != nullptr && init->kind != ExprKind::aggregate; // replaces the type's default
  if (!whole)
    writtenDefault(target, variable->type, Layouts::written(variable));
  construct(target, variable);
  zeroed_ = whole || (!c_.layouts.needsInit(variable->type) &&
                      !c_.layouts.elementsHaveDefaults(Layouts::written(variable), variable->type));
  if (init != nullptr)
    initValue(target, variable->type, init);
  afterInit(target, variable->type);
}

/// The type's default, with those of aliases that array elements are declared with.
void Emitter::writtenDefault(std::string_view target, const Type *type, const Written &written) {
  typeDefault(target, type);
  if (!c_.layouts.elementsHaveDefaults(written, type))
    return;
  const Written inner = c_.layouts.elementOf(written, type);
  const Type *elementType = typeAs<ArrayType>(type)->element;
  const std::string element = temporary("element");
  begin(initSpan_);
  w_ << "for (auto &" << element << " : " << target << ".v) {";
  end();
  open();
  if (const Expr *init = c_.layouts.aliasDefault(inner, elementType)) {
    zeroed_ = !c_.layouts.needsInit(elementType);
    initValue(element, elementType, init);
  } else
    writtenDefault(element, elementType, inner);
  close();
  begin(initSpan_);
  w_ << '}';
  end();
}

void Emitter::typeDefault(std::string_view target, const Type *type) {
  if (!c_.layouts.needsInit(type))
    return;
  begin(initSpan_);
  defaultStatement(target, type);
  end();
}

/// One statement.
void Emitter::defaultStatement(std::string_view target, const Type *type) {
  switch (type->kind) {
  case TypeKind::enumeration: {
    const EnumeratorSymbol *initial = typeAs<EnumType>(type)->initial;
    w_ << target << " = ";
    literal(integerValue(initial->value), type, type, initial);
    w_ << ';';
    return;
  }
  case TypeKind::subrange:
    w_ << target << " = ";
    number(subrangeDefault(typeAs<SubrangeType>(type)), type);
    w_ << ';';
    return;
  case TypeKind::array: {
    const std::string element = temporary("element");
    w_ << "for (auto &" << element << " : " << target << ".v) ";
    defaultStatement(element, typeAs<ArrayType>(type)->element);
    return;
  }
  default:
    includes_.complete(type);
    w_ << target << ".init__(" << ctx() << ");";
    return;
  }
}

void Emitter::initValue(std::string_view target, const Type *type, const Expr *init) {
  if (init->kind != ExprKind::aggregate) {
    if (zeroed_ && isZero(init))
      return;
    begin(initSpan_);
    storeTo(target, type, init);
    end();
    return;
  }
  const auto *list = as<AggregateExpr>(init);
  if (type->kind == TypeKind::array) {
    const auto *array = typeAs<ArrayType>(type);
    if (!constantTable(target, array, list) && !constantColumns(target, array, list) &&
        !addressTable(target, array, list))
      arrayValues(target, array, list->items, {}, 0);
    return;
  }
  for (const AggregateItem &item : list->items) {
    if (item.symbol == nullptr || item.value == nullptr)
      continue;
    std::string field(target);
    field += '.';
    const std::size_t start = w_.size();
    basePath(type, item.symbol);
    field += w_.cut(start);
    field += fieldName(item.symbol);
    if (item.symbol->type->kind == TypeKind::reference) {
      begin(initSpan_);
      w_ << field << " = ";
      address(item.value);
      w_ << ';';
      end();
      continue;
    }
    const Span whole = initSpan_;
    if (item.span.valid())
      initSpan_ = item.span;
    initValue(field, item.symbol->type, item.value);
    initSpan_ = whole;
  }
}

bool Emitter::constantTable(std::string_view target, const ArrayType *type,
                            const AggregateExpr *init) {
  const Type *element = type->element;
  if (init->items.size() < kMinTable || !isElementary(element) || isString(element))
    return false;
  for (const AggregateItem &item : init->items) {
    if (item.repeat != nullptr || item.value == nullptr || item.value->constant == nullptr)
      return false;
  }
  const std::string table = temporary("table");
  begin(initSpan_);
  w_ << "static constexpr " << this->type(element) << ' ' << table << "[] = {";
  for (std::size_t i = 0; i < init->items.size(); ++i) {
    w_ << (i == 0 ? "" : ", ");
    valueAs(init->items[i].value, element);
  }
  w_ << "};";
  end();
  begin(initSpan_);
  w_ << "for (::stride::ULINT i__ = 0; i__ < " << init->items.size() << "; ++i__) " << target
     << ".v[i__] = " << table << "[i__];";
  end();
  return true;
}

bool Emitter::constantLeaves(const Type *type, const Expr *init, const std::string &path,
                             std::vector<Leaf> &leaves) {
  if (leaves.size() > kMostColumns)
    return false;
  if (init->kind != ExprKind::aggregate) {
    leaves.push_back({path, type, init});
    return init->constant != nullptr && !isString(type) &&
           (isElementary(type) || type->kind == TypeKind::enumeration);
  }
  const auto *list = as<AggregateExpr>(init);
  const bool isArray = type->kind == TypeKind::array;
  std::size_t place = 0;
  for (const AggregateItem &item : list->items) {
    if (item.repeat != nullptr || item.value == nullptr || !item.values.empty() ||
        (!isArray && (item.symbol == nullptr || item.symbol->isBit)))
      return false;
    std::string inner = path;
    if (isArray) {
      inner += ".v[" + std::to_string(place++) + "]";
    } else {
      const std::size_t start = w_.size();
      basePath(type, item.symbol);
      inner += "." + w_.cut(start) + fieldName(item.symbol);
    }
    const Type *innerType = isArray ? typeAs<ArrayType>(type)->element : item.symbol->type;
    if (!constantLeaves(innerType, item.value, inner, leaves))
      return false;
  }
  return true;
}

/// A long list of structures or arrays that all set the same places to constants: a table for each
/// of these places.
bool Emitter::constantColumns(std::string_view target, const ArrayType *type,
                              const AggregateExpr *init) {
  if (init->items.size() < kMinTable || isElementary(type->element))
    return false;
  std::vector<Leaf> columns;
  std::vector<const Expr *> values; // row by row
  for (const AggregateItem &item : init->items) {
    std::vector<Leaf> row;
    if (item.repeat != nullptr || item.value == nullptr || !item.values.empty() ||
        item.value->kind != ExprKind::aggregate ||
        !constantLeaves(type->element, item.value, {}, row))
      return false;
    if (columns.empty())
      columns = row;
    if (row.size() != columns.size() || row.empty())
      return false;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i].path != columns[i].path)
        return false;
      values.push_back(row[i].value);
    }
  }
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const std::string table = temporary("table");
    begin(initSpan_);
    w_ << "static constexpr " << this->type(columns[column].type) << ' ' << table << "[] = {";
    for (std::size_t i = column; i < values.size(); i += columns.size()) {
      w_ << (i == column ? "" : ", ");
      valueAs(values[i], columns[column].type);
    }
    w_ << "};";
    end();
    begin(initSpan_);
    w_ << "for (::stride::ULINT i__ = 0; i__ < " << init->items.size() << "; ++i__) " << target
       << ".v[i__]" << columns[column].path << " = " << table << "[i__];";
    end();
  }
  return true;
}

std::uint64_t Emitter::arrayValues(std::string_view target, const ArrayType *type,
                                   std::span<AggregateItem> items, const std::string &base,
                                   std::uint64_t at) {
  const auto element = [&](std::uint64_t place) {
    return std::string(target) + ".v[" + base + std::to_string(place) + "]";
  };
  for (const AggregateItem &item : items) {
    const std::uint64_t count = repetition(item);
    if (item.values.empty()) {
      const bool skip = item.value == nullptr || (zeroed_ && isZero(item.value));
      if (!skip && count == 1) {
        initValue(element(at), type->element, item.value);
      } else if (!skip && count > 1) {
        const std::string i = temporary("i");
        const std::string each =
            std::string(target) + ".v[" + base + i + " + " + std::to_string(at) + "]";
        begin(initSpan_);
        w_ << "for (::stride::ULINT " << i << " = 0; " << i << " < " << count << "; ++" << i
           << ") ";
        if (item.value->kind != ExprKind::aggregate) {
          storeTo(each, type->element, item.value);
          end();
          at += count;
          continue;
        }
        w_ << '{';
        end();
        open();
        initValue(each, type->element, item.value);
        close();
        begin(initSpan_);
        w_ << '}';
        end();
      }
      at += count;
      continue;
    }
    if (count <= kMaxUnrolled) {
      for (std::uint64_t i = 0; i < count; ++i)
        at = arrayValues(target, type, item.values, base, at);
      continue;
    }
    std::uint64_t width = 0; // of one repetition
    const auto measure = [](auto &&self, std::span<AggregateItem> list) -> std::uint64_t {
      std::uint64_t total = 0;
      for (const AggregateItem &inner : list)
        total += repetition(inner) * (inner.values.empty() ? 1 : self(self, inner.values));
      return total;
    };
    width = measure(measure, item.values);
    const std::string i = temporary("i");
    begin(initSpan_);
    w_ << "for (::stride::ULINT " << i << " = 0; " << i << " < " << count << "; ++" << i << ") {";
    end();
    open();
    arrayValues(target, type, item.values, base + i + " * " + std::to_string(width) + " + ", at);
    close();
    begin(initSpan_);
    w_ << '}';
    end();
    at += count * width;
  }
  return at;
}

void Emitter::declareLocal(const VarSymbol *variable, Span start) {
  const std::string name = mangle(variable->name.text);
  const Expr *init = c_.layouts.initOf(variable);
  begin(init == nullptr && start.valid() ? start : variable->name.span);
  if (c_.addressed.onDataStack(variable)) {
    declareTemporary(variable->type, name, true);
    end();
    initVariable(name, variable);
    if (!variable->isResult)
      exitAtEnd(variable);
    return;
  }
  if (!used(variable))
    w_ << "[[maybe_unused]] ";
  w_ << type(variable->type) << (c_.names.type(variable->type).back() == '*' ? "" : " ") << name;
  if (init != nullptr && init->constant != nullptr && !isString(variable->type) &&
      isElementary(variable->type)) {
    w_ << " = ";
    valueAs(init, variable->type);
    w_ << ';';
    end();
    return;
  }
  w_ << "{};";
  end();
  initVariable(name, variable);
  if (!variable->isResult)
    exitAtEnd(variable);
}

std::string Emitter::inputName(Context &context, const VarSymbol *input) {
  return mangle(input->name.text) + (context.addressed.onDataStack(input) ? "__in" : "");
}

void Emitter::declareInput(const VarSymbol *input, Span start) {
  if (!c_.addressed.onDataStack(input))
    return;
  const std::string name = mangle(input->name.text);
  begin(start.valid() ? start : input->name.span);
  w_ << "::stride::OnDataStack<" << type(input->type) << "> " << name << "__local(" << ctx() << ", "
     << inputName(c_, input) << "); [[maybe_unused]] auto &" << name << " = " << name
     << "__local.value();";
  end();
}

void Emitter::declareTemporary(const Type *type, std::string_view name, bool onDataStack) {
  if (!onDataStack) {
    w_ << this->type(type) << ' ' << name << "{}; ";
    return;
  }
  includes_.complete(type);
  w_ << "::stride::OnDataStack<" << this->type(type) << "> " << name << "__local(" << ctx()
     << "); [[maybe_unused]] auto &" << name << " = " << name << "__local.value(); ";
}

} // namespace stc::codegen
