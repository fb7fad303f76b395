// Axes that a program or [[axis]] of stride.toml declares: has each of them a cycle time and an
// MC_Power, which serves it?

#include "compiler/semantics/hierarchy.hpp"
#include "compiler/semantics/lint/internal.hpp"
#include "compiler/syntax/attributes.hpp"
#include "compiler/syntax/visit.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

namespace stc::lint {

using namespace ast;

namespace {

/// What happens to a variable that is an axis, or an array of axes.
struct AxisUse {
  const Argument *moved = nullptr; ///< where a block of the library gets it that does not only look
  bool powered = false;            ///< MC_Power gets it
  bool timed = false;              ///< fTaskCycle is set
  bool unknown = false;            ///< the program does with it what nobody can follow
  std::vector<const VarSymbol *> passedTo; ///< in-outs of the project's own POUs
};

/// Members that a program writes which serves an axis itself.
constexpr std::array<std::string_view, 7> kServed = {
    "fsetposition",        "factposition",   "fsetvelocity", "factvelocity",
    "bregulatorrealstate", "bcommunication", "naxisstate"};

bool isAxis(const Type *type) {
  while (type != nullptr && type->kind == TypeKind::Array)
    type = typeAs<ArrayType>(type)->element;
  if (type == nullptr || type->kind != TypeKind::Structure)
    return false;
  const TypeSymbol *symbol = typeAs<StructType>(type)->symbol;
  return symbol->library != nullptr && !symbol->library->isUser &&
         symbol->name.id->lower == "axis_ref";
}

/// The value of a member that an initial value gives, or null.
const Expr *given(const Expr *init, std::string_view member) {
  if (init == nullptr || init->kind != ExprKind::Aggregate)
    return nullptr;
  for (const AggregateItem &item : as<AggregateExpr>(init)->items) {
    if (item.symbol != nullptr && item.symbol->name.id->lower == member)
      return item.value;
    if (const Expr *found = given(item.value, member))
      return found;
    for (const AggregateItem &repeated : item.values)
      if (const Expr *found = given(repeated.value, member))
        return found;
  }
  return nullptr;
}

class AxisUses {
public:
  AxisUses(const Context &c, const Library &library) {
    for (const GlobalsSymbol *globals : library.globals)
      for (const VarSymbol *variable : globals->variables)
        if (variable->decl != nullptr && variable->decl->init != nullptr)
          look(variable->decl->init);
    for (const Body &body : c.bodies) {
      for (const VarDecl *variable : body.decl->variables)
        if (variable->init != nullptr)
          look(variable->init);
      walkStatements(body.decl->body, [this](const Stmt *stmt) { statement(stmt); });
    }
  }

  /// What happens to the variable, by itself and under the names that POUs give it.
  [[nodiscard]] AxisUse sum(const VarSymbol *variable) const {
    AxisUse all;
    std::vector<const VarSymbol *> names{variable};
    for (size_t i = 0; i < names.size(); ++i) {
      const auto found = uses_.find(names[i]);
      if (found == uses_.end())
        continue;
      const AxisUse &use = found->second;
      all.moved = all.moved != nullptr ? all.moved : use.moved;
      all.powered = all.powered || use.powered;
      all.timed = all.timed || use.timed;
      all.unknown = all.unknown || use.unknown;
      for (const VarSymbol *next : use.passedTo)
        if (std::find(names.begin(), names.end(), next) == names.end())
          names.push_back(next);
    }
    return all;
  }

private:
  void statement(const Stmt *stmt) {
    const bool writes =
        stmt->kind == StmtKind::Assign && as<AssignStmt>(stmt)->op != AssignOp::Reference;
    if (writes)
      for (const Expr *target : as<AssignStmt>(stmt)->targets)
        written(target);
    forEachChild(
        stmt, [this](Expr *expr) { look(expr); }, [](Block) {});
  }

  /// `V.fTaskCycle := …`
  void written(const Expr *target) {
    if (target->kind != ExprKind::Member || !isAxis(as<MemberExpr>(target)->base->type))
      return;
    const auto *member = as<MemberExpr>(target);
    AxisUse *use = useOf(member->base);
    if (use == nullptr || member->symbol == nullptr)
      return;
    const std::string_view name = member->symbol->name.id->lower;
    use->timed = use->timed || name == "ftaskcycle";
    use->unknown = use->unknown || std::find(kServed.begin(), kServed.end(), name) != kServed.end();
  }

  void look(Expr *expr) {
    walk(expr, [this](Expr *e) { return visit(e); });
  }

  /// False: what is below has been looked at.
  bool visit(const Expr *e) {
    if (e->kind == ExprKind::Call)
      return call(as<CallExpr>(e));
    if (e->kind == ExprKind::Member && isAxis(as<MemberExpr>(e)->base->type)) {
      indices(as<MemberExpr>(e)->base);
      return false;
    }
    const bool place =
        e->kind == ExprKind::Name || e->kind == ExprKind::Member || e->kind == ExprKind::Index;
    if (!place || !isAxis(e->type))
      return true;
    if (AxisUse *use = useOf(e)) // its address is taken, or all of it is copied
      use->unknown = true;
    return true;
  }

  bool call(const CallExpr *e) {
    look(e->callee);
    for (const Argument &argument : e->arguments) {
      if (argument.value == nullptr)
        continue;
      const VarSymbol *parameter = argument.parameter;
      if (parameter != nullptr && parameter->section == Section::InOut &&
          isAxis(argument.value->type)) {
        indices(argument.value);
        bind(e, argument);
      } else {
        look(argument.value);
      }
    }
    return false;
  }

  void bind(const CallExpr *e, const Argument &argument) {
    AxisUse *use = useOf(argument.value);
    if (use == nullptr || e->pou == nullptr)
      return;
    const PouSymbol *block = blockOf(e->pou);
    if (block->library == nullptr || block->library->isUser)
      use->passedTo.push_back(argument.parameter);
    else if (!block->library->name.starts_with("SM_")) // one of somebody else: what is in it?
      use->unknown = true;
    else if (block->name.id->lower == "mc_power")
      use->powered = true;
    else if (use->moved == nullptr && !hasAttribute(block->decl->attributes, AttributeId::AnyTask))
      use->moved = &argument;
  }

  /// What is computed within the name of a place.
  void indices(const Expr *place) {
    while (place->kind == ExprKind::Index || place->kind == ExprKind::Member) {
      if (place->kind == ExprKind::Member) {
        place = as<MemberExpr>(place)->base;
        continue;
      }
      for (Expr *index : as<IndexExpr>(place)->indices)
        look(index);
      place = as<IndexExpr>(place)->base;
    }
  }

  AxisUse *useOf(const Expr *place) {
    const VarSymbol *root = rootVariable(place);
    return root != nullptr && isAxis(root->type) ? &uses_[root] : nullptr;
  }

  std::map<const VarSymbol *, AxisUse> uses_;
};

/// The initial value that makes a drive of it; null: none.
const Expr *realDrive(const VarSymbol *variable) {
  return given(variable->decl->init, "brealdrive");
}

/// A program's own axis, which somebody has to serve.
bool isOwnAxis(const VarSymbol *variable) {
  if (variable->decl == nullptr || !isAxis(variable->type) || variable->section == Section::InOut ||
      variable->section == Section::External)
    return false;
  const Expr *real = realDrive(variable); // is one of the PLC configuration, unless it is 0
  return real == nullptr || real->constant == nullptr || real->constant->integer == 0;
}

void reportAxis(Context &c, const VarSymbol *variable, const AxisUses &uses) {
  const Expr *init = variable->decl->init;
  const Expr *real = realDrive(variable);
  AxisUse use = uses.sum(variable);
  use.timed = use.timed || given(init, "ftaskcycle") != nullptr;
  // One of stride.toml is there to be served, others perhaps to be looked at.
  const bool wanted = use.moved != nullptr || use.powered || real != nullptr;
  if (!wanted || use.unknown || (use.powered && use.timed))
    return;
  const std::string name(variable->name.text);
  Diagnostic &d =
      report(c, Code::UnservedAxis, variable->name.span, "nobody serves the axis `" + name + "`",
             use.timed ? "no MC_Power gets it" : "it has no cycle time");
  if (use.moved != nullptr)
    d.label(use.moved->span, "this block gets it");
  if (!use.timed)
    d.help("give it the interval of its task in seconds: `" + name +
           " : AXIS_REF := (fTaskCycle := 0.01)`");
  if (!use.powered)
    d.help("call an MC_Power with `Axis := " + name + "` in every cycle of that task");
  d.note("an axis without a drive of the PLC configuration is served by its MC_Power");
}

} // namespace

void reportAxes(Context &c, const Library &library) {
  std::vector<const VarSymbol *> axes;
  const auto add = [&](const auto &variables) {
    std::copy_if(variables.begin(), variables.end(), std::back_inserter(axes), isOwnAxis);
  };
  for (const GlobalsSymbol *globals : library.globals)
    add(globals->variables);
  for (const PouSymbol *pou : library.pous) {
    add(pou->variables);
    for (const PouSymbol *method : pou->methods)
      add(method->variables);
  }
  if (axes.empty())
    return; // without looking at every statement
  const AxisUses uses(c, library);
  for (const VarSymbol *axis : axes)
    reportAxis(c, axis, uses);
}

} // namespace stc::lint
