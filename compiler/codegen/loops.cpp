// Loops.

#include "compiler/codegen/emitter.hpp"
#include "compiler/semantics/locations.hpp"

namespace stc::codegen {

using namespace ast;

namespace {

/// RETURN, or (with `exits`) EXIT of the loop around: it may end before its last round.
bool mayLeave(Block block, bool exits) {
  const auto leaves = [exits](Block b) { return mayLeave(b, exits); };
  for (const Stmt *s : block) {
    switch (s->kind) {
    case StmtKind::returnS:
      return true;
    case StmtKind::exit:
      if (exits)
        return true;
      break;
    case StmtKind::ifS: {
      const auto *i = as<IfStmt>(s);
      for (const IfBranch &b : i->branches) {
        if (leaves(b.body))
          return true;
      }
      if (leaves(i->elseBody))
        return true;
      break;
    }
    case StmtKind::caseS: {
      const auto *c = as<CaseStmt>(s);
      for (const CaseBranch &b : c->branches) {
        if (leaves(b.body))
          return true;
      }
      if (leaves(c->elseBody))
        return true;
      break;
    }
    case StmtKind::forS:
      if (mayLeave(as<ForStmt>(s)->body, false))
        return true;
      break;
    case StmtKind::whileS:
      if (mayLeave(as<WhileStmt>(s)->body, false))
        return true;
      break;
    case StmtKind::repeatS:
      if (mayLeave(as<RepeatStmt>(s)->body, false))
        return true;
      break;
    default:
      break;
    }
  }
  return false;
}

} // namespace

/// A loop, the variables that only it can reach meanwhile in C++ locals.
void Emitter::loop(const Stmt *s) {
  const bool outermost = loopLocals_.empty();
  if (outermost)
    loopLocals_ = c_.loopLocals.of(s, pou_);
  if (!outermost || loopLocals_.empty()) {
    loopStatement(s);
    return;
  }
  begin(s->span);
  w_ << '{';
  std::string back;
  for (const VarSymbol *v : loopLocals_) {
    const std::string name = mangle(v->name.text);
    w_ << ' ' << type(v->type) << ' ' << name << " = this->" << name << ';';
    // Neighbouring reals would be gathered in vectors, whose loads wait for the stores of halves.
    back += " this->" + name + " = " +
            (isReal(underlying(v->type)) ? "::stride::single(" + name + ")" : name) + ";";
  }
  const std::string context = temporary("loop");
  w_ << " const ::stride::LoopContext " << context << '{' << ctx()
     << ", [&]() __attribute__((always_inline)) {" << back << " }};";
  end();
  open();
  context_ = context;
  loopStatement(s);
  context_ = kContext;
  w_.line() << context << ".save();";
  end();
  close();
  loopLocals_.clear();
  w_.line() << '}';
  end();
}

void Emitter::loopStatement(const Stmt *s) {
  if (s->kind == StmtKind::forS) {
    forStatement(as<ForStmt>(s));
    return;
  }
  const std::string run = temporary("run");
  begin(s->span);
  refillLoop(run, "true", s->span);
  if (s->kind == StmtKind::whileS) {
    const auto *loop = as<WhileStmt>(s);
    w_ << "while (--budget__.left >= 0 && (" << run << " = ";
    condition(loop->condition);
    w_ << ")) {";
    end();
    loopBody(loop->body, true);
    return;
  }
  const auto *loop = as<RepeatStmt>(s);
  w_ << "for (; " << run << " && --budget__.left >= 0; " << run << " = !(";
  condition(loop->until);
  w_ << ")) {";
  end();
  loopBody(loop->body, true);
}

/// The outer one of a loop's two C++ loops.
void Emitter::refillLoop(std::string_view run, std::string_view first, Span span) {
  usesBudget_ = true;
  w_ << "for (bool " << run << " = " << first << "; " << run << "; budget__.refill(" << run << ", "
     << ctx() << ", ";
  position(span);
  w_ << ")) ";
}

/// The body with its closing brace and, behind it, the label that EXIT jumps to.
void Emitter::loopBody(Block body, bool isDouble) {
  loops_.push_back({++next_, isDouble});
  open();
  block(body);
  close();
  w_.line() << '}';
  end();
  if (loops_.back().labelled) {
    w_.line() << "exit__" << loops_.back().id << ":;";
    end();
  }
  loops_.pop_back();
}

/// `for (i = 1; i <= 10; ++i)`, where that means the same: the body does not change the variable,
/// and it does not wrap behind the end.
void Emitter::countedLoop(const ForStmt *s, const std::string &variable, std::int64_t step) {
  const Type *type = underlying(s->variable->type);
  w_ << "for (";
  storeTo(variable, s->variable->type, s->from);
  w_ << ' ' << variable << (step > 0 ? " <= " : " >= ");
  valueAs(s->to, type);
  w_ << "; ";
  if (step == 1 || step == -1)
    w_ << (step > 0 ? "++" : "--") << variable;
  else if (bitWidth(type) < 32)
    w_ << variable << " = static_cast<" << this->type(type) << ">(" << variable
       << (step > 0 ? " + " : " - ") << (step > 0 ? step : -step) << ')';
  else
    w_ << variable << (step > 0 ? " += " : " -= ") << (step > 0 ? step : -step);
  w_ << ") {";
  end();
  loopBody(s->body, false);
}

void Emitter::forStatement(const ForStmt *s) {
  const Type *type = underlying(s->variable->type);
  const std::string number = std::to_string(++next_);
  begin(s->span);
  std::string variable = writableText(s->variable);
  // Found once, before the bounds are computed; and followed once where that takes a call.
  if (c_.analysis.placeEffects(s->variable, pou_) != effectNone || isShared(s->variable) ||
      locationOf(s->variable) != nullptr) {
    w_ << (isShared(s->variable) ? "const auto counter__" : "auto &counter__") << number << " = "
       << variable << "; ";
    variable = "counter__" + number;
  }
  const bool constantStep = s->by == nullptr || s->by->constant != nullptr;
  const std::int64_t step = s->by == nullptr ? 1 : constantStep ? s->by->constant->integer : 0;
  const bool isShort = c_.analysis.shortLoop(s);
  const bool countsAlone = !isShort && c_.loopLocals.countsAlone(s, pou_);
  // Rounds that are taken from the budget and not made would count as made.
  const bool atOnce = countsAlone && c_.analysis.fewRounds(s) && !mayLeave(s->body, true);
  if ((isShort || atOnce) && c_.analysis.endsInside(s)) {
    if (!isShort) {
      // All rounds are taken from the loop budget at once.
      usesBudget_ = true;
      w_ << "budget__.refill((budget__.left -= " << c_.analysis.ownRounds(s) << ") < 0, " << ctx()
         << ", ";
      position(s->span);
      w_ << "); ";
    }
    c_.analysis.enterLoop(s, countsAlone);
    countedLoop(s, variable, step);
    c_.analysis.leaveLoop();
    return;
  }
  storeTo(variable, s->variable->type, s->from);
  w_ << ' ';
  // The end and the step are evaluated once.
  std::string last;
  const std::size_t start = w_.size();
  valueAs(s->to, type);
  last = w_.cut(start);
  if (s->to->constant == nullptr) {
    w_ << "const " << this->type(type) << " end__" << number << " = " << last << "; ";
    last = "end__" + number;
  }
  if (!constantStep) {
    w_ << "const ::stride::LINT step__" << number << " = ";
    value(s->by);
    w_ << "; ";
  }
  const std::string run = "run__" + number;
  std::size_t from = w_.size();
  if (constantStep)
    w_ << variable << (step >= 0 ? " <= " : " >= ") << last;
  else
    w_ << "::stride::forFirst<" << this->type(type) << ">(" << variable << ", " << last
       << ", step__" << number << ')';
  const std::string first = w_.cut(from);
  from = w_.size();
  w_ << run << " = ::stride::"
     << (!constantStep ? "forNext<"
         : step >= 0   ? "forUp<"
                       : "forDown<")
     << this->type(type) << ">(" << variable << ", " << last;
  if (constantStep && step != 1 && step != -1)
    w_ << ", "
       << (step >= 0 ? static_cast<std::uint64_t>(step) : 0 - static_cast<std::uint64_t>(step))
       << 'U';
  else if (!constantStep)
    w_ << ", step__" << number;
  w_ << ')';
  const std::string advance = w_.cut(from);
  if (isShort) {
    w_ << "for (bool " << run << " = " << first << "; " << run << "; " << advance << ") {";
  } else {
    refillLoop(run, first, s->span);
    w_ << "for (; budget__.left > 0 && " << run << "; --budget__.left, " << advance << ") {";
  }
  end();
  c_.analysis.enterLoop(s, countsAlone);
  loopBody(s->body, !isShort);
  c_.analysis.leaveLoop();
}

} // namespace stc::codegen
