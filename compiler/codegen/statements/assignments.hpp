#ifndef STRIDE_COMPILER_CODEGEN_STATEMENTS_ASSIGNMENTS_HPP
#define STRIDE_COMPILER_CODEGEN_STATEMENTS_ASSIGNMENTS_HPP
// Assignments: the place is found before the value is computed, whatever the value's calls do to
// what leads to the place.

#include "compiler/codegen/context/context.hpp"

namespace stc::codegen {

/// What has been found before its use, until the scope ends.
class Found {
public:
  explicit Found(EmitContext &cx) : found_(cx.found) {}
  ~Found() {
    for (const ast::Expr *e : places_)
      found_.erase(e);
  }
  Found(const Found &) = delete;
  Found &operator=(const Found &) = delete;
  /// From now on `name` is written for the place.
  void set(const ast::Expr *place, std::string name) {
    found_.insert_or_assign(place, std::move(name));
    places_.push_back(place);
  }

private:
  FoundPlaces &found_;
  std::vector<const ast::Expr *> places_;
};

/// Writes `auto &to = a[i]; ` where finding the place takes more than its name; until `found`
/// ends, `to` stands for it. With `always` also where the order does not show, for brevity.
void findPlace(EmitContext &cx, Found &found, const ast::Expr *place, bool always = false);
/// The same of the target of an assignment: of a property that is set, its object is found.
void findTarget(EmitContext &cx, Found &found, const ast::Expr *target);
/// The same of the instance, or the (checked) interface, whose method is called.
void findObject(EmitContext &cx, Found &found, const ast::Expr *object);

void emitAssignment(EmitContext &cx, const ast::AssignStmt *s);
/// `target = value;` where `target` is the C++ of a place of the type.
void emitStoreTo(EmitContext &cx, std::string_view target, const Type *type,
                 const ast::Expr *value);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_STATEMENTS_ASSIGNMENTS_HPP
