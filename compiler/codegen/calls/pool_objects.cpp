#include "compiler/codegen/calls/pool_objects.hpp"

#include "compiler/codegen/calls/instances.hpp"
#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/initial/initializers.hpp"
#include "compiler/codegen/initial/lifecycle.hpp"
#include "compiler/codegen/places/places.hpp"
#include "compiler/semantics/hierarchy.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// How many are created.
void emitCount(EmitContext &cx, const CallExpr *e) {
  if (e->arguments.size() > 1 && e->arguments[1].parameter == nullptr)
    emitValue(cx, e->arguments[1].value);
  else
    cx.out << '1';
}

/// The end of __NEW's first constant: `objects` are `count` of the type.
void emitMemory(EmitContext &cx, const Type *t, Part count) {
  cx.out << "::stride::newObjects<" << cx.type(t) << ">(" << cx.ctx() << ", ";
  count();
  cx.out << ", " << cx.run.layouts.hash(t) << "ULL)";
}

/// FB_Exit of the objects at `pointer`, which are of the type `real`; `first` is a pointer to that.
void emitExits(EmitContext &cx, const std::string &pointer, const Type *real,
               const std::string &first) {
  if (!cx.run.layouts.hasLifecycle(real, "fb_exit"))
    return;
  cx.includes.complete(real);
  const std::string i = cx.temporary("i");
  cx.out << "for (::stride::ULINT " << i << " = 0; " << i << " < ::stride::poolCount(" << cx.ctx()
         << ", " << pointer << "); ++" << i << ") " << first << '[' << i << "].exit__(" << cx.ctx()
         << "); ";
}

/// What was created may be a block that extends the one pointed to: those with an FB_Exit.
std::vector<const PouSymbol *> derivedWithExit(EmitContext &cx, const Type *pointee) {
  std::vector<const PouSymbol *> derived;
  if (pointee->kind != TypeKind::FunctionBlock || !hasTypeId(typeAs<PouType>(pointee)->symbol))
    return derived;
  for (const PouSymbol *p : derivedBlocks(cx.run.program, typeAs<PouType>(pointee)->symbol)) {
    if (cx.run.layouts.hasLifecycle(p->type, "fb_exit"))
      derived.push_back(p);
  }
  return derived;
}

void emitExitsByType(EmitContext &cx, const std::string &pointer, const Type *pointee,
                     const std::vector<const PouSymbol *> &derived) {
  cx.includes.complete(pointee);
  cx.out << "if (::stride::poolCount(" << cx.ctx() << ", " << pointer << ") != 0) { switch ("
         << pointer << "->" << pathToTypeId(typeAs<PouType>(pointee)->symbol) << ") { ";
  for (const PouSymbol *p : derived) {
    const std::string real = cx.temporary("real");
    cx.out << "case " << cx.run.names.typeId(p) << "U: { auto *const " << real
           << " = reinterpret_cast<" << cx.type(p->type) << " *>(" << pointer << "); ";
    emitExits(cx, pointer, p->type, real);
    cx.out << "break; } ";
  }
  cx.out << "default: ";
  emitExits(cx, pointer, pointee, pointer);
  cx.out << "break; } } ";
}

} // namespace

void emitNew(EmitContext &cx, const CallExpr *e) {
  const Type *t = e->arguments[0].value->type;
  const std::string objects = cx.temporary("objects");
  const std::string count = cx.temporary("count");
  if (!cx.run.layouts.needsInit(t)) {
    emitMemory(cx, t, [&] { emitCount(cx, e); });
    return;
  }
  cx.out << "[&] { const ::stride::LINT " << count << " = ";
  emitCount(cx, e);
  cx.out << "; auto *const " << objects << " = ";
  emitMemory(cx, t, [&] { cx.out << count; });
  const std::string i = cx.temporary("i");
  cx.out << "; for (::stride::LINT " << i << " = 0; " << objects << " != nullptr && " << i << " < "
         << count << "; ++" << i << ") { ";
  const std::string object = objects + "[" + i + "]";
  cx.inlined([&] {
    cx.modes.init.span = e->span;
    initDefault(cx, object, t);
    constructWith(cx, object, t, e->arguments);
    callAfterInit(cx, object, t);
  });
  cx.out << "} return " << objects << "; }()";
}

void emitDelete(EmitContext &cx, const CallExpr *e) {
  const std::string pointer = cx.temporary("pointer");
  const Expr *variable = e->arguments[0].value;
  cx.out << "{ auto &" << pointer << " = ";
  emitPlace(cx, variable);
  cx.out << "; ";
  const Type *pointee = typeAs<PointerType>(variable->type)->pointee;
  if (const std::vector<const PouSymbol *> derived = derivedWithExit(cx, pointee); derived.empty())
    emitExits(cx, pointer, pointee, pointer);
  else
    emitExitsByType(cx, pointer, pointee, derived);
  cx.out << "::stride::poolDelete(" << cx.ctx() << ", " << pointer << ", ";
  cx.position(e->span);
  cx.out << "); " << pointer << " = nullptr; }";
}

} // namespace stc::codegen
