#include "compiler/codegen/calls/calls.hpp"

#include "compiler/codegen/calls/methods.hpp"
#include "compiler/codegen/expressions/conversions.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/initial/initializers.hpp"
#include "compiler/codegen/places/located.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/codegen/statements/assignments.hpp"
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
  case ExprKind::Index:
  case ExprKind::Deref:
    return true;
  case ExprKind::Name:
    symbol = as<NameExpr>(e)->symbol;
    break;
  case ExprKind::Member:
    symbol = as<MemberExpr>(e)->symbol;
    break;
  default:
    return false;
  }
  return symbol == nullptr || symbol->kind != SymbolKind::Enumerator;
}

/// A VAR_IN_OUT CONSTANT may be bound to a string of another length or to a value, some to a number
/// of another type: then it gets a copy.
bool needsCopy(const Argument &a) {
  if (a.parameter->section != Section::InOut)
    return false;
  return a.copied || (isString(a.parameter->type) && a.value->type != a.parameter->type) ||
         (a.parameter->isConstant && !isPlace(a.value));
}

/// What the call has left in the copy goes back to where it was taken from.
bool isGivenBack(const Argument &a) {
  return a.copied && a.parameter != nullptr && !a.parameter->isConstant;
}

std::string formerValue(const std::string &copy) { return copy + "__was"; }

/// The place that a copy is taken from is found once.
void findCopied(EmitContext &cx, Found &found, const Argument &a) {
  if (isGivenBack(a))
    findTarget(cx, found, a.value);
}

/// `T copy; copy = value; `
void takeCopy(EmitContext &cx, const Argument &a, const std::string &copy) {
  const VarSymbol *p = a.parameter;
  declareTemporary(cx, p->type, copy, cx.run.addressed.onDataStack(p));
  emitStoreTo(cx, copy, p->type, a.value);
  cx.out << ' ';
  if (isGivenBack(a))
    cx.out << "const auto " << formerValue(copy) << " = " << copy << "; ";
}

/// A value that has not been changed keeps the digits that the copy has not.
void giveBack(EmitContext &cx, const Argument &a, const std::string &copy) {
  cx.out << " if (" << copy << " != " << formerValue(copy) << ") { ";
  emitOutputTo(cx, a.value, copy, a.parameter->type, a.span);
  cx.out << " }";
}

/// What is written so that arguments are evaluated in their order.
struct CallOrder {
  unsigned effects = 0;    ///< of all arguments
  bool statements = false; ///< the call takes more than a C++ expression
  bool arguments = false;  ///< their order shows
  bool object = false;     ///< the instance must be found before them
};

/// What stands for the arguments of a call, by parameter; empty: they are written where they are
/// passed.
struct CallNames {
  explicit CallNames(const PouSymbol *pou)
      : parameters(pou->parameters()), names(parameters.size()) {}
  std::string &operator[](const VarSymbol *parameter) {
    return names[static_cast<size_t>(std::find(parameters.begin(), parameters.end(), parameter) -
                                     parameters.begin())];
  }

  std::vector<VarSymbol *> parameters;
  std::vector<std::string> names;
};

/// What is passed to a function or method.
void emitArgument(EmitContext &cx, const Argument &a) {
  const VarSymbol *p = a.parameter;
  if (p->type->kind == TypeKind::OpenArray)
    emitOpenArray(cx, a.value, typeAs<OpenArrayType>(p->type));
  else if (p->section == Section::InOut)
    emitPlaceAs(cx, a.value, p->type);
  else if (p->type->kind == TypeKind::Reference)
    emitAddressAs(cx, a.value, typeAs<PointerType>(p->type)->pointee);
  else
    emitValueAs(cx, a.value, p->type);
}

/// `::st::user::F(ctx__, …)`; `names` holds, by parameter, what stands for a value (or a place)
/// that has been taken before.
void emitFunctionArguments(EmitContext &cx, const CallExpr *e,
                           const std::vector<std::string> &names) {
  if (e->resolved == Callee::Method) {
    openMethodCall(cx, objectOf(e), e->pou, e->callee->span);
  } else {
    cx.includes.called(e->pou, cx.run.repetition.callsOften(cx.pou, e->pou));
    cx.out << cx.run.names.qualified(e->pou) << '(' << cx.ctx();
  }
  size_t k = 0;
  for (const VarSymbol *p : e->pou->parameters()) {
    cx.out << ", ";
    const Argument *a = argumentFor(e, p);
    if (k < names.size() && !names[k].empty())
      cx.out << names[k];
    else if (a == nullptr || a->value == nullptr)
      emitDefaultArgument(cx, p);
    else
      emitArgument(cx, *a);
    ++k;
  }
  cx.out << ')';
}

/// Effects of what a call does for the argument before it: a value is computed, or a place found.
unsigned argumentEffects(EmitContext &cx, const Argument &a) {
  if (a.output)
    return cx.run.analysis.targetEffects(a.value, cx.pou);
  if (isGivenBack(a))
    return cx.run.analysis.targetEffects(a.value, cx.pou) | cx.effects(a.value);
  const VarSymbol *p = a.parameter;
  const bool isAddress = p != nullptr && !needsCopy(a) && isIndirect(p);
  return isAddress ? cx.run.analysis.placeEffects(a.value, cx.pou) : cx.effects(a.value);
}

/// C++ leaves the order of arguments open, ST does not.
CallOrder callOrder(EmitContext &cx, const CallExpr *e) {
  CallOrder order;
  for (const Argument &a : e->arguments) {
    if (a.value == nullptr)
      continue;
    order.statements = order.statements || (a.parameter != nullptr && needsCopy(a));
    const unsigned own = argumentEffects(cx, a);
    order.arguments = order.arguments || Analysis::orderShows(order.effects, own);
    order.effects |= own;
  }
  const Expr *object = e->resolved == Callee::Method ? objectOf(e) : nullptr;
  order.object = object != nullptr &&
                 Analysis::orderShows(cx.run.analysis.objectEffects(object, cx.pou), order.effects);
  for (const VarSymbol *p : e->pou->parameters())
    order.statements = order.statements || p->section == Section::Output;
  order.statements = order.statements || order.arguments || order.object;
  return order;
}

/// Takes the argument's value, or finds its place, ahead of the call; gives its name, which is
/// empty where nothing is to be done before the call itself.
std::string takeArgument(EmitContext &cx, Found &found, const Argument &a, const CallOrder &order) {
  const VarSymbol *p = a.parameter;
  std::string name;
  if (a.output) {
    findTarget(cx, found, a.value);
  } else if (needsCopy(a)) {
    name = cx.temporary("copy");
    findCopied(cx, found, a);
    takeCopy(cx, a, name);
  } else if (order.arguments && argumentEffects(cx, a) != kEffectNone) {
    name = cx.temporary("in");
    if (p->type->kind == TypeKind::OpenArray)
      cx.out << "const auto " << name;
    else if (p->section == Section::InOut)
      cx.out << cx.type(p->type) << " &" << name;
    else // nothing changes it before the call? Then it is copied only there
      cx.out << cx.type(p->type) << ((order.effects & kEffectCalls) != 0 ? " const " : " const &")
             << name;
    cx.out << " = ";
    emitArgument(cx, a);
    cx.out << "; ";
  }
  return name;
}

/// What is done before the call: in the order of the call its arguments are taken, then every
/// output gets a variable of its own.
void takeArguments(EmitContext &cx, Found &found, const CallExpr *e, const CallOrder &order,
                   CallNames &names) {
  if (order.object)
    findObject(cx, found, objectOf(e));
  for (const Argument &a : e->arguments) {
    if (a.value != nullptr && a.parameter != nullptr)
      names[a.parameter] = takeArgument(cx, found, a, order);
  }
  for (const VarSymbol *p : names.parameters) {
    if (p->section != Section::Output)
      continue;
    names[p] = cx.temporary("out");
    declareTemporary(cx, p->type, names[p], cx.run.addressed.onDataStack(p));
  }
}

/// Those outputs that are asked for are copied after the call, and what it has changed of copies.
void giveOutputs(EmitContext &cx, const CallExpr *e, CallNames &names) {
  for (const Argument &a : e->arguments) {
    if (isGivenBack(a))
      giveBack(cx, a, names[a.parameter]);
    if (a.value == nullptr || !a.output || a.parameter == nullptr)
      continue;
    cx.out << ' ';
    emitOutputTo(cx, a.value, names[a.parameter], a.parameter->type, a.span);
  }
}

/// One input or in-out of an instance's call. Gives the name of the copy, if it gets one.
std::string passToInstance(EmitContext &cx, const Argument &a, const std::string &field) {
  const VarSymbol *p = a.parameter;
  if (needsCopy(a)) {
    std::string copy = cx.temporary("copy");
    takeCopy(cx, a, copy);
    cx.out << field << " = &" << copy << ';';
    return copy;
  }
  if (!isIndirect(p)) {
    emitStoreTo(cx, cx.isShared(p) ? "::stride::shared(" + field + ")" : field, p->type, a.value);
    return {};
  }
  cx.out << field << " = ";
  if (p->type->kind == TypeKind::OpenArray)
    emitOpenArray(cx, a.value, typeAs<OpenArrayType>(p->type));
  else
    emitAddressAs(cx, a.value,
                  p->section == Section::InOut ? p->type : typeAs<PointerType>(p->type)->pointee);
  cx.out << ';';
  return {};
}

/// An instance's call, in parts: each on its line of the ST.
class InstanceCall {
public:
  InstanceCall(EmitContext &cx, const CallExpr *e)
      : cx_(cx), e_(e), found_(cx), isProgram_(e->resolved == Callee::Program) {}

  /// The instance is found, then each argument is evaluated and passed in the order of the call.
  void emit(Span span) {
    const bool braces = takesScope();
    cx_.out << (braces ? "{ " : "");
    if (!isProgram_)
      findPlace(cx_, found_, e_->callee, true);
    instance_ = isProgram_ ? std::string(cx_.root({e_->pou, false})) : placeText(cx_, e_->callee);
    pass();
    part(first_ ? span : Span{});
    const bool dispatch =
        isBodyDispatched(e_->pou) && !isExact(e_->callee) && !isSuper(e_->callee); // SUPER^()
    const bool ends = !isProgram_ && !dispatch && cx_.run.plainCalls.alwaysEnds(e_->pou);
    cx_.out << instance_ << (dispatch ? ".body__call(" : ".body__(")
            << (ends ? contextWhereBound() : std::string(cx_.ctx())) << ");";
    give();
    cx_.out << (braces ? " }" : "");
  }

private:
  /// Something is found, or copied, for the statement only. The instance is found once, however
  /// many inputs are set.
  [[nodiscard]] bool takesScope() const {
    Analysis &analysis = cx_.run.analysis;
    const auto takes = [&](const Argument &a) {
      if (a.value == nullptr || a.parameter == nullptr)
        return false;
      return a.output ? analysis.targetEffects(a.value, cx_.pou) != kEffectNone : needsCopy(a);
    };
    return (!isProgram_ && (containerOf(e_->callee)->kind == ExprKind::Index ||
                            analysis.placeEffects(e_->callee, cx_.pou) != kEffectNone)) ||
           std::any_of(e_->arguments.begin(), e_->arguments.end(), takes);
  }

  /// What stands for the context of a body that always ends where its in-outs are bound: where one
  /// is not, that which puts the loop's locals back.
  [[nodiscard]] std::string contextWhereBound() {
    std::string isUnbound;
    for (const VarSymbol *v : e_->pou->variables)
      if (v->section == Section::InOut)
        isUnbound += (isUnbound.empty() ? "" : " || ") + field(v) + " == nullptr";
    if (isUnbound.empty() || cx_.modes.loops.locals.empty())
      return std::string(isUnbound.empty() ? cx_.plainContext() : cx_.ctx());
    const std::string saving(cx_.ctx());
    return isUnbound + " ? static_cast<::stride::Ctx &>(" + saving +
           ") : " + std::string(cx_.plainContext());
  }

  [[nodiscard]] std::string field(const VarSymbol *p) const {
    return instance_ + "." + pathToBase(e_->pou, p->owner) + fieldName(p);
  }

  void part(Span where) {
    if (!first_)
      cx_.next(where);
    first_ = false;
  }

  void pass() {
    for (const Argument &a : e_->arguments) {
      if (a.value == nullptr || a.parameter == nullptr)
        continue;
      if (a.output) {
        findTarget(cx_, found_, a.value);
        continue;
      }
      part(a.span);
      findCopied(cx_, found_, a);
      const std::string copy = passToInstance(cx_, a, field(a.parameter));
      if (isGivenBack(a))
        givenBack_.emplace_back(&a, copy);
    }
  }

  /// The outputs, what has been changed in copies, and the end of copies that in-outs are bound to.
  void give() {
    for (const auto &[argument, copy] : givenBack_)
      giveBack(cx_, *argument, copy);
    for (const Argument &a : e_->arguments) {
      if (a.value == nullptr || !a.output || a.parameter == nullptr)
        continue;
      part(a.span);
      const std::string output = field(a.parameter);
      emitOutputTo(cx_, a.value,
                   cx_.isShared(a.parameter) ? "::stride::load(" + output + ")" : output,
                   a.parameter->type, a.span);
    }
    for (const Argument &a : e_->arguments) {
      if (a.value != nullptr && !a.output && a.parameter != nullptr && needsCopy(a))
        cx_.out << ' ' << field(a.parameter) << " = nullptr;";
    }
  }

  EmitContext &cx_;
  const CallExpr *e_;
  Found found_;
  bool isProgram_;
  std::string instance_;                                            ///< the C++ of it
  bool first_ = true;                                               ///< no part has been written
  std::vector<std::pair<const Argument *, std::string>> givenBack_; ///< With their copies.
};

} // namespace

/// The value of an input that the call leaves out.
void emitDefaultArgument(EmitContext &cx, const VarSymbol *parameter) {
  const Expr *init = cx.run.layouts.initOf(parameter);
  if (init != nullptr && init->kind != ExprKind::Aggregate && init->type != nullptr) {
    if (parameter->type->kind == TypeKind::Reference)
      emitAddress(cx, init);
    else
      emitValueAs(cx, init, parameter->type);
    return;
  }
  const std::string_view type = cx.type(parameter->type);
  if (init == nullptr && !cx.run.layouts.needsInit(parameter->type)) {
    cx.out << type << "{}";
    return;
  }
  const std::string name = cx.temporary("default");
  cx.out << "[&] { ";
  declareTemporary(cx, parameter->type, name, Addressed::holdsBlock(parameter->type));
  cx.inlined([&] { initVariable(cx, name, parameter); });
  cx.out << "return " << name << "; }()";
}

void emitFunctionCall(EmitContext &cx, const CallExpr *e, bool asStatement) {
  const PouSymbol *pou = e->pou;
  const CallOrder order = callOrder(cx, e);
  if (!order.statements) {
    emitFunctionArguments(cx, e, {});
    if (asStatement)
      cx.out << ';';
    return;
  }
  Found found(cx);
  CallNames names(pou);
  cx.out << (asStatement ? "{ " : "[&] { ");
  takeArguments(cx, found, e, order, names);
  const bool hasResult = !asStatement && pou->result != nullptr;
  const std::string result = hasResult ? cx.temporary("result") : std::string();
  if (hasResult)
    cx.out << cx.type(pou->result->type) << " const " << result << " = ";
  emitFunctionArguments(cx, e, names.names);
  cx.out << ';';
  giveOutputs(cx, e, names);
  if (hasResult)
    cx.out << " return " << result << ';';
  cx.out << (asStatement ? " }" : " }()");
}

/// `target = source;` from an output of type `sourceType` to the variable after `=>`.
void emitOutputTo(EmitContext &cx, const Expr *target, std::string_view source,
                  const Type *sourceType, Span span) {
  const bool reference = sourceType->kind == TypeKind::Reference;
  std::string pointee;
  if (reference) { // the value it refers to
    sourceType = typeAs<PointerType>(sourceType)->pointee;
    pointee = "(*" + std::string(source) + ")";
    source = pointee;
  }
  const Type *type = target->type;
  if (writtenProperty(target) != nullptr) {
    emitPropertySet(cx, target, [&] { emitConvertedText(cx, source, sourceType, type, span); });
    return;
  }
  if (isBitPlace(target)) {
    emitBitStore(cx, target, [&] { emitConvertedText(cx, source, sourceType, type, span); });
    return;
  }
  if (isString(type) && type != sourceType) {
    cx.out << "::stride::assign(";
    emitPlace(cx, target);
    cx.out << ", " << source << ");";
    return;
  }
  const bool bindings = cx.run.layouts.hasBindings(type);
  if (bindings)
    cx.out << "::stride::assignBound(" << cx.ctx() << ", ";
  cx.out << writableText(cx, target) << (bindings ? ", " : " = ");
  emitConvertedText(cx, source, sourceType, type, span);
  cx.out << (bindings ? ");" : ";");
}

void emitInstanceCall(EmitContext &cx, const CallExpr *e, Span span) {
  cx.includes.called(e->pou, cx.run.repetition.callsOften(cx.pou, e->pou));
  InstanceCall(cx, e).emit(span);
}

} // namespace stc::codegen
