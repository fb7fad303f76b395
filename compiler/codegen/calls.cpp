// Calls of functions, function blocks and programs.

#include "compiler/codegen/emitter.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/locations.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

const Argument *argumentFor(const CallExpr *e, const VarSymbol *parameter) {
  for (const Argument &a : e->arguments) {
    if (a.parameter == parameter)
      return &a;
  }
  return nullptr;
}

/// The expression names memory, not just a value.
bool isPlace(const Expr *e) {
  const Symbol *symbol = nullptr;
  switch (e->kind) {
  case ExprKind::index:
  case ExprKind::deref:
    return true;
  case ExprKind::name:
    symbol = as<NameExpr>(e)->symbol;
    break;
  case ExprKind::member:
    symbol = as<MemberExpr>(e)->symbol;
    break;
  default:
    return false;
  }
  return symbol == nullptr || symbol->kind != SymbolKind::enumerator;
}

/// A VAR_IN_OUT CONSTANT may be bound to a string of another length or to a value: then it gets a
/// copy.
bool needsCopy(const Argument &a) {
  if (a.parameter->section != Section::inOut)
    return false;
  return (isString(a.parameter->type) && a.value->type != a.parameter->type) ||
         (a.parameter->isConstant && !isPlace(a.value));
}

bool isInput(const VarSymbol *p) { return p->section == Section::input; }

} // namespace

/// The value of an input that the call leaves out.
void Emitter::defaultArgument(const VarSymbol *parameter) {
  const Expr *init = c_.layouts.initOf(parameter);
  if (init != nullptr && init->kind != ExprKind::aggregate && init->type != nullptr) {
    if (parameter->type->kind == TypeKind::reference)
      address(init);
    else
      valueAs(init, parameter->type);
    return;
  }
  const std::string_view type = this->type(parameter->type);
  if (init == nullptr && !c_.layouts.needsInit(parameter->type)) {
    w_ << type << "{}";
    return;
  }
  const std::string name = temporary("default");
  w_ << "[&] { ";
  declareTemporary(parameter->type, name, Addressed::holdsBlock(parameter->type));
  inlineStatements([&](Emitter &inner) { inner.initVariable(name, parameter); });
  w_ << "return " << name << "; }()";
}

void Emitter::inlineStatements(const std::function<void(Emitter &)> &write) {
  const std::uint32_t line = currentLine_;
  Emitter inner(c_, pou_); // statements, gathered on this line
  inner.next_ = next_ + 100;
  write(inner);
  std::string statements = inner.w_.take();
  for (std::size_t at = 0; at < statements.size();) {
    std::size_t lineEnd = statements.find('\n', at);
    lineEnd = lineEnd == std::string::npos ? statements.size() : lineEnd;
    std::string_view one = std::string_view(statements).substr(at, lineEnd - at);
    while (!one.empty() && one.front() == ' ')
      one.remove_prefix(1);
    if (!one.empty() && one.front() != '#')
      w_ << one << ' ';
    at = lineEnd + 1;
  }
  for (const FileId file : inner.files_)
    fileName(file);
  usesContext_ = usesContext_ || inner.usesContext_;
  includes_.merge(inner.includes_);
  currentLine_ = line;
}

/// A list of values as a value.
void Emitter::aggregateValue(const Type *type, const Expr *init) {
  const std::string name = temporary("value");
  w_ << "[&] { ";
  declareTemporary(type, name, Addressed::holdsBlock(type));
  inlineStatements([&](Emitter &inner) {
    inner.typeDefault(name, type);
    inner.initValue(name, type, init);
  });
  w_ << "return " << name << "; }()";
}

/// `::st::user::F(ctx__, …)`; `names` holds, by parameter, what stands for a value that has been
/// taken before.
void Emitter::functionArguments(const CallExpr *e, const std::vector<std::string> &names) {
  if (e->resolved == Callee::method) {
    const bool taken = names.size() > e->pou->parameters().size();
    methodPrefix(objectOf(e), e->pou, taken ? std::string_view(names.back()) : std::string_view(),
                 e->callee->span);
  } else {
    includes_.called(e->pou);
    w_ << c_.names.qualified(e->pou) << '(' << ctx();
  }
  std::size_t k = 0;
  for (const VarSymbol *p : e->pou->parameters()) {
    w_ << ", ";
    const Argument *a = argumentFor(e, p);
    if (k < names.size() && !names[k].empty())
      w_ << names[k];
    else if (a == nullptr || a->value == nullptr)
      defaultArgument(p);
    else if (p->type->kind == TypeKind::openArray)
      openArray(a->value, typeAs<OpenArrayType>(p->type));
    else if (p->section == Section::inOut)
      placeAs(a->value, p->type);
    else if (p->type->kind == TypeKind::reference)
      addressAs(a->value, typeAs<PointerType>(p->type)->pointee);
    else
      valueAs(a->value, p->type);
    ++k;
  }
  w_ << ')';
}

void Emitter::functionCall(const CallExpr *e, bool asStatement) {
  const PouSymbol *pou = e->pou;
  // Temporaries are needed for outputs, and where the order of the arguments matters.
  bool outputs = false;
  bool copies = false;
  const std::vector<VarSymbol *> parameters = pou->parameters();
  for (const VarSymbol *p : parameters)
    outputs = outputs || p->section == Section::output;
  bool order = false;
  unsigned before = effectNone;
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr)
      continue;
    copies = copies || needsCopy(a);
    if (a.output)
      continue;
    const unsigned after = effects(a.value);
    order = order || (before != effectNone && Analysis::orderMatters(before, after));
    before |= after;
  }
  // The instance is found before its arguments are evaluated.
  const Expr *object = e->resolved == Callee::method ? objectOf(e) : nullptr;
  const bool takeObject =
      object != nullptr && before != effectNone && Analysis::orderMatters(effects(object), before);
  if (!outputs && !order && !copies && !takeObject) {
    functionArguments(e, {});
    if (asStatement)
      w_ << ';';
    return;
  }
  std::vector<std::string> names(parameters.size());
  w_ << (asStatement ? "{ " : "[&] { ");
  if (takeObject) {
    names.push_back(temporary("object"));
    includes_.complete(object->type);
    const bool isValue = object->type->kind == TypeKind::interface ||
                         object->kind == ExprKind::call || writtenProperty(object) != nullptr;
    const bool placed = isValue && isInstance(object->type);
    if (placed)
      w_ << "::stride::OnDataStack<" << type(object->type) << "> " << names.back() << "__local("
         << ctx() << ", ";
    else
      w_ << (isValue ? "auto " : "auto &") << names.back() << " = ";
    raw(object);
    w_ << (placed ? "); " : "; ");
    if (placed)
      w_ << "auto &" << names.back() << " = " << names.back() << "__local.value(); ";
  }
  for (const Argument &a : e->arguments) { // in the order of the call
    const VarSymbol *p = a.parameter;
    if (a.value == nullptr || a.output || p == nullptr)
      continue;
    std::string &name = names[static_cast<std::size_t>(
        std::find(parameters.begin(), parameters.end(), p) - parameters.begin())];
    if (p->section == Section::inOut) {
      if (!needsCopy(a))
        continue;
      name = temporary("copy");
      declareTemporary(p->type, name, c_.addressed.onDataStack(p));
      storeTo(name, p->type, a.value);
      w_ << ' ';
    } else if (order && isInput(p) && a.value->constant == nullptr) {
      name = temporary("in");
      w_ << type(p->type) << " const " << name << " = ";
      if (p->type->kind == TypeKind::reference)
        addressAs(a.value, typeAs<PointerType>(p->type)->pointee);
      else
        valueAs(a.value, p->type);
      w_ << "; ";
    }
  }
  // Every output gets a variable of its own; those asked for are copied after the call.
  std::vector<std::pair<const Argument *, std::string>> results;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const VarSymbol *p = parameters[k];
    if (p->section != Section::output)
      continue;
    names[k] = temporary("out");
    declareTemporary(p->type, names[k], c_.addressed.onDataStack(p));
    const Argument *a = argumentFor(e, p);
    if (a != nullptr && a->value != nullptr)
      results.emplace_back(a, names[k]);
  }
  const bool hasResult = !asStatement && pou->result != nullptr;
  const std::string result = hasResult ? temporary("result") : std::string();
  if (hasResult)
    w_ << type(pou->result->type) << " const " << result << " = ";
  functionArguments(e, names);
  w_ << ';';
  for (const auto &[a, name] : results) {
    w_ << ' ';
    outputTo(a->value, name, a->parameter->type, a->span);
  }
  if (hasResult)
    w_ << " return " << result << ';';
  w_ << (asStatement ? " }" : " }()");
}

/// `target = source;` from an output of type `sourceType` to the variable behind `=>`.
void Emitter::outputTo(const Expr *target, std::string_view source, const Type *sourceType,
                       Span span) {
  const bool reference = sourceType->kind == TypeKind::reference;
  std::string pointee;
  if (reference) { // the value it refers to
    sourceType = typeAs<PointerType>(sourceType)->pointee;
    pointee = "(*" + std::string(source) + ")";
    source = pointee;
  }
  const Type *type = target->type;
  if (writtenProperty(target) != nullptr) {
    propertySet(target, [&] { convertedText(source, sourceType, type, span); });
    return;
  }
  if (isBitPlace(target)) {
    bitStore(target, {}, [&] { convertedText(source, sourceType, type, span); });
    return;
  }
  if (isString(type) && type != sourceType) {
    w_ << "::stride::assign(";
    place(target);
    w_ << ", " << source << ");";
    return;
  }
  const bool bindings = c_.layouts.hasBindings(type);
  w_ << (bindings ? "::stride::assignBound(" : "") << writableText(target)
     << (bindings ? ", " : " = ");
  convertedText(source, sourceType, type, span);
  w_ << (bindings ? ");" : ";");
}

void Emitter::instanceCall(const CallExpr *e, Span span) {
  const PouSymbol *pou = e->pou;
  includes_.called(pou);
  std::string instance;
  bool braces = false;
  if (e->resolved == Callee::program) {
    instance = std::string(root({pou, false}));
  } else {
    instance = placeText(e->callee);
    if (instance.find('(') != std::string::npos || instance.find('[') != std::string::npos) {
      // Found once, however many inputs are set.
      const std::string name = temporary("fb");
      w_ << "{ auto &" << name << " = " << instance << "; ";
      instance = name;
      braces = true;
    }
  }
  bool first = true;
  const auto part = [&](Span where) {
    if (!first)
      next(where);
    first = false;
  };
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr || a.output || a.parameter == nullptr)
      continue;
    part(a.span);
    const VarSymbol *p = a.parameter;
    const std::string field = instance + "." + pathToBase(pou, p->owner) + fieldName(p);
    if (needsCopy(a)) {
      const std::string copy = temporary("copy");
      if (!braces)
        w_ << "{ ";
      braces = true;
      declareTemporary(p->type, copy, c_.addressed.onDataStack(p));
      storeTo(copy, p->type, a.value);
      w_ << ' ' << field << " = &" << copy << ';';
    } else if (isIndirect(p)) {
      w_ << field << " = ";
      if (p->type->kind == TypeKind::openArray)
        openArray(a.value, typeAs<OpenArrayType>(p->type));
      else
        addressAs(a.value,
                  p->section == Section::inOut ? p->type : typeAs<PointerType>(p->type)->pointee);
      w_ << ';';
    } else {
      storeTo(isShared(p) ? "::stride::shared(" + field + ")" : field, p->type, a.value);
    }
  }
  part(first ? span : Span{});
  const bool dispatch =
      isBodyDispatched(pou) && !isExact(e->callee) &&
      !(e->callee->kind == ExprKind::deref && instance == "this->base__"); // SUPER^()
  w_ << instance << (dispatch ? ".body__call(" : ".body__(") << ctx() << ");";
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr || !a.output || a.parameter == nullptr)
      continue;
    part(a.span);
    const std::string output =
        instance + "." + pathToBase(pou, a.parameter->owner) + fieldName(a.parameter);
    outputTo(a.value, isShared(a.parameter) ? "::stride::load(" + output + ")" : output,
             a.parameter->type, a.span);
  }
  for (const Argument &a : e->arguments) { // copies end with the statement
    if (a.value != nullptr && !a.output && a.parameter != nullptr && needsCopy(a))
      w_ << ' ' << instance << '.' << pathToBase(pou, a.parameter->owner) << fieldName(a.parameter)
         << " = nullptr;";
  }
  if (braces)
    w_ << " }";
}

} // namespace stc::codegen
