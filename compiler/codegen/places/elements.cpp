#include "compiler/codegen/places/elements.hpp"

#include "compiler/codegen/expressions/expressions.hpp"
#include "compiler/codegen/places/own_checks.hpp"
#include "compiler/codegen/places/places.hpp"

#include <algorithm>

namespace stc::codegen {

using namespace ast;

namespace {

/// An argument list takes what is indexed, and C++ would be free to read it after the index. Begins
/// a lambda that takes it first; gives what stands for it there.
std::string openBase(EmitContext &cx, const std::string &base, const Type *type) {
  std::string name = cx.temporary("base");
  cx.out << "[&]() -> decltype(auto) { " << (isString(type) ? "auto &&" : "const auto ") << name
         << " = " << base << "; return ";
  return name;
}

/// `at(ctx__, base, i)`: an element of an ARRAY[*], or a row.
void emitOpenElement(EmitContext &cx, std::string base, const OpenArrayType *array, const Expr *i,
                     bool takesBase) {
  cx.includes.complete(array);
  cx.includes.complete(array->element);
  const PouSymbol *own = ownCheck(cx, ImplicitCheck::Bounds);
  const bool opens = takesBase || own != nullptr; // the bounds are those of the array passed
  if (opens)
    base = openBase(cx, base, array);
  cx.out << "::stride::at" << (cx.checks() ? "(" : "Place(");
  if (cx.checks())
    cx.out << cx.ctx() << ", ";
  cx.out << base << ", ";
  if (own != nullptr)
    cx.out << cx.run.names.qualified(own) << '(' << cx.ctx() << ", static_cast<::stride::DINT>(";
  emitValue(cx, i);
  if (own != nullptr)
    cx.out << "), static_cast<::stride::DINT>(" << base << ".lo[0]), static_cast<::stride::DINT>("
           << base << ".hi[0]))";
  if (cx.checks()) {
    cx.out << ", ";
    cx.position(i->span);
  }
  cx.out << (opens ? "); }()" : ")");
}

/// `element(ctx__, p, i)`, `character(ctx__, s, i)`.
void emitPointedElement(EmitContext &cx, std::string base, const Type *type, const Expr *i,
                        bool takesBase) {
  const bool points = type->kind == TypeKind::Pointer;
  if (points)
    cx.includes.complete(typeAs<PointerType>(type)->pointee);
  const bool text = isString(points ? typeAs<PointerType>(type)->pointee : type);
  if (takesBase)
    base = openBase(cx, base, type);
  cx.out << "::stride::" << (text ? "character" : "element") << (cx.checks() ? "(" : "At(");
  if (cx.checks())
    cx.out << cx.ctx() << ", ";
  cx.out << base << ", ";
  emitValue(cx, i);
  if (cx.checks()) {
    cx.out << ", ";
    cx.position(i->span);
  }
  cx.out << (takesBase ? "); }()" : ")");
}

/// `.v[i]`: C++ evaluates what stands before the brackets first.
void emitArrayElement(EmitContext &cx, const ArrayType *array, const Expr *i) {
  cx.out << ".v[";
  if (inBounds(i, array)) {
    cx.out << i->constant->integer - array->low;
  } else if (array->low == 0 && cx.run.analysis.provenIndex(i, array)) {
    emitValue(cx, i);
  } else if (cx.checks() && !cx.run.analysis.provenIndex(i, array)) {
    cx.out << "::stride::index<" << array->low << ", " << array->high << ">(" << cx.ctx() << ", ";
    emitCheckedIndex(cx, i, array);
    cx.out << ", ";
    cx.position(i->span);
    cx.out << ')';
  } else {
    cx.out << "::stride::place<" << array->low << ">(";
    emitValue(cx, i);
    cx.out << ')';
  }
  cx.out << ']';
}

/// The C++ of what is indexed, and its type: each index makes another one of it.
struct Indexed {
  std::string code;
  const Type *type;
};

void follow(EmitContext &cx, Indexed &at, Span span) {
  at.type = typeAs<PointerType>(at.type)->pointee;
  cx.includes.complete(at.type);
  at.code = cx.text([&] { emitFollowed(cx, Slot::Reference, span, [&] { cx.out << at.code; }); });
}

/// What the expression begins with: the place of the array, or the value of the pointer.
void emitBase(EmitContext &cx, const Expr *base) {
  cx.includes.complete(base->type); // C++ must know the size of the elements
  if (base->type->kind == TypeKind::Pointer)
    emitCheckedPointer(cx, base);
  else
    emitPlace(cx, base);
}

void step(EmitContext &cx, Indexed &at, const Expr *i, bool takesBase) {
  if (at.type->kind == TypeKind::Array)
    at.code += cx.text([&] { emitArrayElement(cx, typeAs<ArrayType>(at.type), i); });
  else if (at.type->kind == TypeKind::OpenArray)
    at.code = cx.text(
        [&] { emitOpenElement(cx, at.code, typeAs<OpenArrayType>(at.type), i, takesBase); });
  else
    at.code = cx.text([&] { emitPointedElement(cx, at.code, at.type, i, takesBase); });
  at.type = indexStep(at.type);
}

/// Each index is written after what it is an index into: nothing goes around it.
bool isPlain(const IndexExpr *e) {
  const Type *t = e->base->type;
  for (size_t i = 0; i < e->indices.size(); ++i) {
    if (t->kind != TypeKind::Array)
      return false;
    t = typeAs<ArrayType>(t)->element;
  }
  return t->kind != TypeKind::Reference;
}

} // namespace

void emitIndex(EmitContext &cx, const IndexExpr *e, bool slotOnly) {
  const Type *type = e->base->type;
  if (isPlain(e)) {
    emitBase(cx, e->base);
    for (const Expr *i : e->indices) {
      emitArrayElement(cx, typeAs<ArrayType>(type), i);
      type = typeAs<ArrayType>(type)->element;
    }
    return;
  }
  Indexed at{cx.text([&] { emitBase(cx, e->base); }), type};
  unsigned before = type->kind == TypeKind::Pointer ? cx.effects(e->base)
                                                    : cx.run.analysis.placeEffects(e->base, cx.pou);
  for (const Expr *i : e->indices) {
    if (at.type->kind == TypeKind::Reference)
      follow(cx, at, e->span);
    const unsigned own = cx.effects(i);
    step(cx, at, i, Analysis::orderShows(before, own));
    before |= own;
  }
  if (at.type->kind == TypeKind::Reference && !slotOnly)
    follow(cx, at, e->span);
  cx.out << at.code;
}

} // namespace stc::codegen
