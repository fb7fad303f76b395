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

/// What is passed to a function or method.
void Emitter::argument(const Argument &a) {
  const VarSymbol *p = a.parameter;
  if (p->type->kind == TypeKind::openArray)
    openArray(a.value, typeAs<OpenArrayType>(p->type));
  else if (p->section == Section::inOut)
    placeAs(a.value, p->type);
  else if (p->type->kind == TypeKind::reference)
    addressAs(a.value, typeAs<PointerType>(p->type)->pointee);
  else
    valueAs(a.value, p->type);
}

/// `::st::user::F(ctx__, …)`; `names` holds, by parameter, what stands for a value (or a place)
/// that has been taken before.
void Emitter::functionArguments(const CallExpr *e, const std::vector<std::string> &names) {
  if (e->resolved == Callee::method) {
    methodPrefix(objectOf(e), e->pou, e->callee->span);
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
    else
      argument(*a);
    ++k;
  }
  w_ << ')';
}

/// Effects of what a call does for the argument before it: a value is computed, or a place found.
unsigned Emitter::argumentEffects(const Argument &a) {
  if (a.output)
    return c_.analysis.targetEffects(a.value, pou_);
  const VarSymbol *p = a.parameter;
  const bool isAddress = p != nullptr && !needsCopy(a) && isIndirect(p);
  return isAddress ? c_.analysis.placeEffects(a.value, pou_) : effects(a.value);
}

/// C++ leaves the order of arguments open, ST does not.
Emitter::CallOrder Emitter::callOrder(const CallExpr *e) {
  CallOrder order;
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr)
      continue;
    order.statements = order.statements || (a.parameter != nullptr && needsCopy(a));
    const unsigned own = argumentEffects(a);
    order.arguments = order.arguments || Analysis::orderShows(order.effects, own);
    order.effects |= own;
  }
  const Expr *object = e->resolved == Callee::method ? objectOf(e) : nullptr;
  order.object = object != nullptr &&
                 Analysis::orderShows(c_.analysis.objectEffects(object, pou_), order.effects);
  for (const VarSymbol *p : e->pou->parameters())
    order.statements = order.statements || p->section == Section::output;
  order.statements = order.statements || order.arguments || order.object;
  return order;
}

/// Takes the argument's value, or finds its place, ahead of the call; gives its name, which is
/// empty where nothing is to be done before the call itself.
std::string Emitter::takeArgument(Found &found, const Argument &a, const CallOrder &order) {
  const VarSymbol *p = a.parameter;
  std::string name;
  if (a.output) {
    findTarget(found, a.value);
  } else if (needsCopy(a)) {
    name = temporary("copy");
    declareTemporary(p->type, name, c_.addressed.onDataStack(p));
    storeTo(name, p->type, a.value);
    w_ << ' ';
  } else if (order.arguments && argumentEffects(a) != effectNone) {
    name = temporary("in");
    if (p->type->kind == TypeKind::openArray)
      w_ << "const auto " << name;
    else if (p->section == Section::inOut)
      w_ << type(p->type) << " &" << name;
    else // nothing changes it before the call? Then it is copied only there
      w_ << type(p->type) << ((order.effects & effectCalls) != 0 ? " const " : " const &") << name;
    w_ << " = ";
    argument(a);
    w_ << "; ";
  }
  return name;
}

void Emitter::functionCall(const CallExpr *e, bool asStatement) {
  const PouSymbol *pou = e->pou;
  const CallOrder order = callOrder(e);
  if (!order.statements) {
    functionArguments(e, {});
    if (asStatement)
      w_ << ';';
    return;
  }
  const std::vector<VarSymbol *> parameters = pou->parameters();
  std::vector<std::string> names(parameters.size());
  const auto nameOf = [&](const VarSymbol *p) -> std::string & {
    return names[static_cast<std::size_t>(std::find(parameters.begin(), parameters.end(), p) -
                                          parameters.begin())];
  };
  Found found(*this);
  w_ << (asStatement ? "{ " : "[&] { ");
  if (order.object)
    findObject(found, objectOf(e));
  for (const Argument &a : e->arguments) { // in the order of the call
    if (a.value != nullptr && a.parameter != nullptr)
      nameOf(a.parameter) = takeArgument(found, a, order);
  }
  // Every output gets a variable of its own; those asked for are copied after the call.
  for (const VarSymbol *p : parameters) {
    if (p->section != Section::output)
      continue;
    nameOf(p) = temporary("out");
    declareTemporary(p->type, nameOf(p), c_.addressed.onDataStack(p));
  }
  const bool hasResult = !asStatement && pou->result != nullptr;
  const std::string result = hasResult ? temporary("result") : std::string();
  if (hasResult)
    w_ << type(pou->result->type) << " const " << result << " = ";
  functionArguments(e, names);
  w_ << ';';
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr || !a.output || a.parameter == nullptr)
      continue;
    w_ << ' ';
    outputTo(a.value, nameOf(a.parameter), a.parameter->type, a.span);
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
    bitStore(target, [&] { convertedText(source, sourceType, type, span); });
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

/// One input or in-out of an instance's call.
void Emitter::passToInstance(const Argument &a, const std::string &field) {
  const VarSymbol *p = a.parameter;
  if (needsCopy(a)) {
    const std::string copy = temporary("copy");
    declareTemporary(p->type, copy, c_.addressed.onDataStack(p));
    storeTo(copy, p->type, a.value);
    w_ << ' ' << field << " = &" << copy << ';';
    return;
  }
  if (!isIndirect(p)) {
    storeTo(isShared(p) ? "::stride::shared(" + field + ")" : field, p->type, a.value);
    return;
  }
  w_ << field << " = ";
  if (p->type->kind == TypeKind::openArray)
    openArray(a.value, typeAs<OpenArrayType>(p->type));
  else
    addressAs(a.value,
              p->section == Section::inOut ? p->type : typeAs<PointerType>(p->type)->pointee);
  w_ << ';';
}

/// The instance is found, then each argument is evaluated and passed in the order of the call.
void Emitter::instanceCall(const CallExpr *e, Span span) {
  const PouSymbol *pou = e->pou;
  includes_.called(pou);
  const bool isProgram = e->resolved == Callee::program;
  // Found once, however many inputs are set.
  bool braces = !isProgram && (containerOf(e->callee)->kind == ExprKind::index ||
                               c_.analysis.placeEffects(e->callee, pou_) != effectNone);
  for (const Argument &a : e->arguments) {
    if (a.value != nullptr && a.parameter != nullptr)
      braces = braces ||
               (a.output ? c_.analysis.targetEffects(a.value, pou_) != effectNone : needsCopy(a));
  }
  Found found(*this);
  w_ << (braces ? "{ " : "");
  if (!isProgram)
    findPlace(found, e->callee, true);
  const std::string instance = isProgram ? std::string(root({pou, false})) : placeText(e->callee);
  const auto field = [&](const VarSymbol *p) {
    return instance + "." + pathToBase(pou, p->owner) + fieldName(p);
  };
  bool first = true;
  const auto part = [&](Span where) {
    if (!first)
      next(where);
    first = false;
  };
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr || a.parameter == nullptr)
      continue;
    if (a.output) {
      findTarget(found, a.value);
      continue;
    }
    part(a.span);
    passToInstance(a, field(a.parameter));
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
    const std::string output = field(a.parameter);
    outputTo(a.value, isShared(a.parameter) ? "::stride::load(" + output + ")" : output,
             a.parameter->type, a.span);
  }
  for (const Argument &a : e->arguments) { // copies end with the statement
    if (a.value != nullptr && !a.output && a.parameter != nullptr && needsCopy(a))
      w_ << ' ' << field(a.parameter) << " = nullptr;";
  }
  w_ << (braces ? " }" : "");
}

} // namespace stc::codegen
