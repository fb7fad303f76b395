// Elements of arrays, characters of strings, what lies beside the target of a pointer.

#include "compiler/codegen/emitter.hpp"

namespace stc::codegen {

using namespace ast;

/// An argument list takes what is indexed, and C++ would be free to read it after the index. Begins
/// a lambda that takes it first; gives what stands for it there.
std::string Emitter::openBase(const std::string &base, const Type *type) {
  const std::string name = temporary("base");
  w_ << "[&]() -> decltype(auto) { " << (isString(type) ? "auto &&" : "const auto ") << name
     << " = " << base << "; return ";
  return name;
}

/// `at(ctx__, base, i)`: an element of an ARRAY[*], or a row.
void Emitter::openElement(std::string base, const OpenArrayType *array, const Expr *i,
                          bool takesBase) {
  includes_.complete(array);
  includes_.complete(array->element);
  const PouSymbol *own = ownCheck(ImplicitCheck::bounds);
  const bool opens = takesBase || own != nullptr; // the bounds are those of the array passed
  if (opens)
    base = openBase(base, array);
  w_ << "::stride::at" << (checks() ? "(" : "Place(");
  if (checks())
    w_ << ctx() << ", ";
  w_ << base << ", ";
  if (own != nullptr)
    w_ << c_.names.qualified(own) << '(' << ctx() << ", static_cast<::stride::DINT>(";
  value(i);
  if (own != nullptr)
    w_ << "), static_cast<::stride::DINT>(" << base << ".lo[0]), static_cast<::stride::DINT>("
       << base << ".hi[0]))";
  if (checks()) {
    w_ << ", ";
    position(i->span);
  }
  w_ << (opens ? "); }()" : ")");
}

/// `element(ctx__, p, i)`, `character(ctx__, s, i)`.
void Emitter::pointedElement(std::string base, const Type *type, const Expr *i, bool takesBase) {
  const bool points = type->kind == TypeKind::pointer;
  if (points)
    includes_.complete(typeAs<PointerType>(type)->pointee);
  const bool text = isString(points ? typeAs<PointerType>(type)->pointee : type);
  if (takesBase)
    base = openBase(base, type);
  w_ << "::stride::" << (text ? "character" : "element") << (checks() ? "(" : "At(");
  if (checks())
    w_ << ctx() << ", ";
  w_ << base << ", ";
  value(i);
  if (checks()) {
    w_ << ", ";
    position(i->span);
  }
  w_ << (takesBase ? "); }()" : ")");
}

/// `.v[i]`: C++ evaluates what is in front of the brackets first.
void Emitter::arrayElement(const ArrayType *array, const Expr *i) {
  w_ << ".v[";
  if (inBounds(i, array)) {
    w_ << i->constant->integer - array->low;
  } else if (array->low == 0 && c_.analysis.provenIndex(i, array)) {
    value(i);
  } else if (checks() && !c_.analysis.provenIndex(i, array)) {
    w_ << "::stride::index<" << array->low << ", " << array->high << ">(" << ctx() << ", ";
    checkedIndex(i, array);
    w_ << ", ";
    position(i->span);
    w_ << ')';
  } else {
    w_ << "::stride::place<" << array->low << ">(";
    value(i);
    w_ << ')';
  }
  w_ << ']';
}

void Emitter::index(const IndexExpr *e, bool slotOnly) {
  const std::size_t start = w_.size();
  includes_.complete(e->base->type); // C++ must know the size of the elements
  const Type *t = e->base->type;
  const bool points = t->kind == TypeKind::pointer;
  if (points && checks())
    checkedPointer(e->base);
  else if (points)
    value(e->base);
  else
    place(e->base);
  unsigned before = points ? effects(e->base) : c_.analysis.placeEffects(e->base, pou_);
  for (const Expr *i : e->indices) {
    if (t->kind == TypeKind::reference) {
      t = typeAs<PointerType>(t)->pointee;
      followReference(start, t, e->span);
    }
    const unsigned own = effects(i);
    const bool takesBase = Analysis::orderShows(before, own);
    before |= own;
    if (t->kind == TypeKind::array)
      arrayElement(typeAs<ArrayType>(t), i);
    else if (t->kind == TypeKind::openArray)
      openElement(w_.cut(start), typeAs<OpenArrayType>(t), i, takesBase);
    else
      pointedElement(w_.cut(start), t, i, takesBase);
    t = indexStep(t);
  }
  if (t->kind == TypeKind::reference && !slotOnly)
    followReference(start, typeAs<PointerType>(t)->pointee, e->span);
}

} // namespace stc::codegen
